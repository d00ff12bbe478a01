#pragma once

#include <atomic>
#include <functional>
#include <string_view>

/// @file
/// How to run a stage, as opposed to what to compute. It never changes a result: the same bits for
/// one thread or many.

namespace lascaux {

/// Threads, cancellation and progress of a run. Plain value; copies refer to the same cancel flag.
struct Execution {
  /// Number of worker threads; 0 takes all that the machine offers.
  int threads = 0;
  /// Set by another thread (or a signal handler) to stop the run; stages look at it between pieces
  /// of work.
  const std::atomic<bool>* cancel = nullptr;
  /// Called with the stage's name and the fraction that is done, 0 to 1, from one thread at a time.
  std::function<void(std::string_view stage, double fraction)> progress;

  bool IsCancelled() const noexcept {
    return cancel != nullptr && cancel->load(std::memory_order_relaxed);
  }
  void Report(std::string_view stage, double fraction) const {
    if (progress) progress(stage, fraction);
  }
};

}  // namespace lascaux
