#pragma once

#include <chrono>
#include <string>
#include <utility>

#include "model.h"

namespace lascaux {

/// Adds the time between its construction and its destruction to a run's timings.
class Stopwatch {
 public:
  Stopwatch(Timings& timings, std::string stage)
      : timings_(timings), stage_(std::move(stage)), start_(Clock::now()) {}
  ~Stopwatch() { timings_.stages.emplace_back(std::move(stage_), Milliseconds()); }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  using Clock = std::chrono::steady_clock;

  double Milliseconds() const {
    return std::chrono::duration<double, std::milli>(Clock::now() - start_).count();
  }

  Timings& timings_;
  std::string stage_;
  Clock::time_point start_;
};

}  // namespace lascaux
