#pragma once

#include <chrono>
#include <string>
#include <utility>

#include "model.h"

namespace lascaux {

inline double MillisecondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
      .count();
}

/// Adds the time between its construction and its destruction to a run's timings.
class Stopwatch {
 public:
  Stopwatch(Timings& timings, std::string stage)
      : timings_(timings), stage_(std::move(stage)), start_(std::chrono::steady_clock::now()) {}
  ~Stopwatch() { timings_.stages.emplace_back(std::move(stage_), MillisecondsSince(start_)); }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  Timings& timings_;
  std::string stage_;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace lascaux
