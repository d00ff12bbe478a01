#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

/// @file
/// What a stage has to say about its input: one sentence, drawn at its place on the sketch.

namespace lascaux {

/// How much a diagnostic matters: a note is for the curious, a warning is a guess, an error means
/// that there is no result.
enum class Severity { kNote, kWarning, kError };

/// The program's exit code that an error leads to (docs/diagnostics.md has the table of codes).
enum class FailureKind {
  kNone,
  kUsage,
  kInput,
  kUnderstanding,
  kOutput,
  kMesh,
  kBug,
  kInterrupted
};

/// One finding. `code` is stable and meant for scripts, `message` is for people: what, where, with
/// the numbers, and the remedy.
struct Diagnostic {
  Severity severity = Severity::kNote;
  FailureKind failure = FailureKind::kNone;  ///< only for errors
  std::string code;                          ///< kebab-case, such as "gap-closed"
  std::string message;
  std::optional<int> stroke;          ///< index of the stroke in Sketch::strokes
  std::optional<Eigen::Vector2d> at;  ///< place in sketch units

  bool operator==(const Diagnostic&) const = default;
};

using Diagnostics = std::vector<Diagnostic>;

/// "note", "warning" or "error".
const char* Name(Severity severity) noexcept;

/// True when one of them is an error.
bool HasError(const Diagnostics& diagnostics) noexcept;

/// A note, a warning, an error: shorthands that read like what they say.
Diagnostic Note(std::string code, std::string message);
Diagnostic Warning(std::string code, std::string message);
Diagnostic Error(FailureKind failure, std::string code, std::string message);

/// The same diagnostic with its place on the sketch, and with its stroke.
Diagnostic At(Diagnostic diagnostic, const Eigen::Vector2d& place);
Diagnostic OnStroke(Diagnostic diagnostic, int stroke);

}  // namespace lascaux
