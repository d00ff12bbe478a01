#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <string>
#include <string_view>

#include "lascaux/base/outcome.h"
#include "lascaux/sketch/sketch.h"

/// @file
/// What every outcome of ReadSvg() must be, whatever the bytes were; for tests and the fuzzer.

namespace lascaux::testing {

/// What is wrong with a stroke; empty when nothing is.
inline std::string WrongWith(const Stroke& stroke) {
  if (stroke.pieces.empty()) return "a stroke without pieces";
  if (stroke.is_dot && stroke.pieces.size() != 1) return "a dot of several pieces";
  if (!(stroke.width >= 0) || stroke.width > 1e300) return "a width that is none";
  for (std::size_t i = 0; i < stroke.pieces.size(); ++i) {
    const auto& p = stroke.pieces[i].p;
    for (const Eigen::Vector2d& point : p) {
      if (!point.allFinite()) return "a coordinate that is not finite";
    }
    const bool is_point = p[0] == p[1] && p[0] == p[2] && p[0] == p[3];
    if (is_point != stroke.is_dot) return "a piece of no length, or a dot with one";
    if (i > 0 && stroke.pieces[i - 1].p[3] != p[0]) return "pieces that don't join";
  }
  if (stroke.closed && stroke.pieces.front().p[0] != stroke.pieces.back().p[3]) {
    return "a closed stroke that is open";
  }
  return {};
}

/// What is wrong with the outcome of a reading; empty when nothing is.
inline std::string WrongWith(const Outcome<Sketch>& outcome) {
  constexpr std::string_view kErrors[] = {"not-svg", "broken-xml", "no-strokes", "not-finite",
                                          "too-large"};
  constexpr std::string_view kOthers[] = {"bad-path-data",    "bad-attribute", "bad-reference",
                                          "duplicate-stroke", "hidden-line",   "zero-length-piece",
                                          "ignored-element",  "ink-outlines"};
  const auto contains = [](const auto& list, std::string_view code) {
    return std::find(std::begin(list), std::end(list), code) != std::end(list);
  };
  for (const Diagnostic& d : outcome.diagnostics()) {
    const bool is_error = d.severity == Severity::kError;
    if (is_error && d.failure != FailureKind::kInput) return "an error that is not the input's";
    if (!contains(kErrors, d.code) && (is_error || !contains(kOthers, d.code))) {
      return "an unknown code " + d.code;
    }
    if (d.message.empty() || d.message.find('\n') != std::string::npos) return "a bad message";
    const bool has_stroke = outcome.ok() && d.stroke && *d.stroke >= 0 &&
                            static_cast<std::size_t>(*d.stroke) < outcome->strokes.size();
    if (outcome.ok() && d.stroke && !has_stroke) return "a diagnostic for a stroke that is not";
  }
  if (outcome.ok() == HasError(outcome.diagnostics())) return "a result with an error, or none";
  if (!outcome.ok()) return {};
  if (outcome->strokes.empty()) return "a sketch without strokes";
  for (const Stroke& stroke : outcome->strokes) {
    const std::string wrong = WrongWith(stroke);
    if (!wrong.empty()) return wrong;
  }
  return {};
}

}  // namespace lascaux::testing
