#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

#include "lascaux/sketch/sketch.h"

/// @file
/// Writing SVG: numbers, paths, escaped text.

namespace lascaux {

/// Text with the characters that XML reserves escaped, and those that it forbids left out.
std::string EscapeXml(std::string_view text);

/// Numbers and paths for a picture of a given size: as many decimals as a hundred-thousandth of its
/// diagonal needs.
class SvgNumbers {
 public:
  explicit SvgNumbers(double diagonal);

  std::string operator()(double value) const;
  /// "x,y".
  std::string operator()(const Eigen::Vector2d& point) const;

  /// Path data of a polyline, and of a closed ring.
  std::string Line(const std::vector<Eigen::Vector2d>& points) const;
  std::string Ring(const std::vector<Eigen::Vector2d>& points) const;
  /// Path data of a stroke's own curves.
  std::string Curve(const Stroke& stroke) const;

 private:
  int decimals_;
};

}  // namespace lascaux
