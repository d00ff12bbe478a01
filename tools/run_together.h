#pragma once

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <tbb/task_arena.h>

#include <cstddef>

#include "lascaux/base/arena.h"
#include "lascaux/base/execution.h"

namespace lascaux {

/// Runs all, side by side where the execution has more than one thread: the first and the last
/// begin. What one throws comes out when all are over.
template <typename... Works>
void RunTogether(const Execution& execution, const Works&... works) {
  if (execution.threads == 1) {
    (works(), ...);
    return;
  }
  RunInArena(execution, [&] { tbb::parallel_invoke(works...); });
}

/// Runs work(0) to work(count - 1), side by side where the execution has more than one thread.
template <typename Work>
void ForEachTogether(const Execution& execution, std::size_t count, const Work& work) {
  if (execution.threads == 1 || count < 2) {
    for (std::size_t i = 0; i < count; ++i) work(i);
    return;
  }
  RunInArena(execution, [&] { tbb::parallel_for(std::size_t{0}, count, work); });
}

/// Starts the threads that later work will be shared with. Until it has started, which takes a few
/// ms, a thread takes nothing over.
inline void WakeWorkers(const Execution& execution) {
  if (execution.threads == 1) return;
  tbb::task_arena arena(execution.threads > 0 ? execution.threads : tbb::task_arena::automatic);
  arena.enqueue([] {});
}

}  // namespace lascaux
