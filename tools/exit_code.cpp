#include "exit_code.h"

#include <algorithm>
#include <array>

namespace lascaux {
namespace {

constexpr std::array kWorstFirst = {
    ExitCode::kBug,   ExitCode::kInterrupted,   ExitCode::kOutput, ExitCode::kMesh,
    ExitCode::kInput, ExitCode::kUnderstanding, ExitCode::kUsage,  ExitCode::kSuccess};

}  // namespace

ExitCode ExitCodeOf(FailureKind failure) noexcept {
  switch (failure) {
    case FailureKind::kUsage:
      return ExitCode::kUsage;
    case FailureKind::kInput:
      return ExitCode::kInput;
    case FailureKind::kUnderstanding:
      return ExitCode::kUnderstanding;
    case FailureKind::kOutput:
      return ExitCode::kOutput;
    case FailureKind::kMesh:
      return ExitCode::kMesh;
    case FailureKind::kInterrupted:
      return ExitCode::kInterrupted;
    case FailureKind::kNone:
    case FailureKind::kBug:
      break;
  }
  return ExitCode::kBug;
}

ExitCode Worse(ExitCode a, ExitCode b) noexcept {
  const auto rank = [](ExitCode code) {
    return std::find(kWorstFirst.begin(), kWorstFirst.end(), code) - kWorstFirst.begin();
  };
  return rank(a) <= rank(b) ? a : b;
}

ExitCode ExitCodeOf(const Diagnostics& diagnostics) noexcept {
  ExitCode worst = ExitCode::kSuccess;
  for (const Diagnostic& d : diagnostics)
    if (d.severity == Severity::kError) worst = Worse(worst, ExitCodeOf(d.failure));
  return worst;
}

}  // namespace lascaux
