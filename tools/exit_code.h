#pragma once

#include <vector>

#include "lascaux/base/diagnostic.h"

namespace lascaux {

/// The program's exit codes; scripts rely on them.
enum class ExitCode : int {
  kSuccess = 0,
  kBug = 1,
  kUsage = 2,
  kInput = 3,
  kUnderstanding = 4,
  kOutput = 5,
  kMesh = 6,
  kInterrupted = 130,
};

/// The exit code that a kind of failure leads to.
ExitCode ExitCodeOf(FailureKind failure) noexcept;

/// The worse of two: 1, 130, 5, 6, 3, 4, 2, 0, worst first.
ExitCode Worse(ExitCode a, ExitCode b) noexcept;

/// The worst of a run's errors; success when there are only notes and warnings.
ExitCode ExitCodeOf(const Diagnostics& diagnostics) noexcept;

}  // namespace lascaux
