#include "lascaux/base/diagnostic.h"

#include <algorithm>
#include <utility>

namespace lascaux {

const char* Name(Severity severity) noexcept {
  switch (severity) {
    case Severity::kNote:
      return "note";
    case Severity::kWarning:
      return "warning";
    case Severity::kError:
      break;
  }
  return "error";
}

bool HasError(const Diagnostics& diagnostics) noexcept {
  return std::any_of(diagnostics.begin(), diagnostics.end(),
                     [](const Diagnostic& d) { return d.severity == Severity::kError; });
}

Diagnostic Note(std::string code, std::string message) {
  return {Severity::kNote, FailureKind::kNone, std::move(code), std::move(message), {}, {}};
}

Diagnostic Warning(std::string code, std::string message) {
  return {Severity::kWarning, FailureKind::kNone, std::move(code), std::move(message), {}, {}};
}

Diagnostic Error(FailureKind failure, std::string code, std::string message) {
  return {Severity::kError, failure, std::move(code), std::move(message), {}, {}};
}

Diagnostic At(Diagnostic diagnostic, const Eigen::Vector2d& place) {
  diagnostic.at = place;
  return diagnostic;
}

Diagnostic OnStroke(Diagnostic diagnostic, int stroke) {
  diagnostic.stroke = stroke;
  return diagnostic;
}

}  // namespace lascaux
