#pragma once

#include <tbb/task_arena.h>

#include <functional>

#include "lascaux/base/execution.h"

namespace lascaux {

/// Runs `work` with as many threads as the execution asks for; parallel loops in there stay within
/// them.
inline void RunInArena(const Execution& execution, const std::function<void()>& work) {
  tbb::task_arena arena(execution.threads > 0 ? execution.threads : tbb::task_arena::automatic);
  arena.execute(work);
}

}  // namespace lascaux
