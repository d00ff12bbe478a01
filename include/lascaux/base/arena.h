#pragma once

#include <tbb/info.h>
#include <tbb/task_arena.h>

#include <functional>

#include "lascaux/base/execution.h"

/// @file
/// Where parallel loops run.

namespace lascaux {

/// Runs `work` with as many threads as the execution asks for; parallel loops in there stay within
/// them.
///
/// Inside of such a call the same threads are shared, so that what runs side by side helps one
/// another: a thread that waits in one arena takes no work from others.
inline void RunInArena(const Execution& execution, const std::function<void()>& work) {
  const int threads = execution.threads > 0 ? execution.threads : tbb::info::default_concurrency();
  const bool is_inside =
      tbb::this_task_arena::current_thread_index() != tbb::task_arena::not_initialized &&
      tbb::this_task_arena::max_concurrency() == threads;
  if (is_inside) return work();
  tbb::task_arena arena(threads);
  arena.execute(work);
}

}  // namespace lascaux
