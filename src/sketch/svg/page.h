#pragma once

#include <string>
#include <vector>

#include "lascaux/base/outcome.h"
#include "lascaux/sketch/sketch.h"
#include "sketch/svg/reading.h"
#include "sketch/svg/strokes.h"

/// @file
/// From everything that was painted to what is seen of it.

namespace lascaux::svg {

/// Coordinates up to this can be squared and squared again without overflow; drawings above its
/// inverse without underflow.
inline constexpr double kMaxCoordinate = 1e75;

/// The error "not-finite" for an element of that name.
Diagnostic OutOfRange(const std::string& name);

/// What StrokeCollector::Finish() returns, but for elements that are out of range.
Outcome<Sketch> DrawPage(std::vector<PaintedSubpath> painted, Reading& reading);

}  // namespace lascaux::svg
