#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "lascaux/sketch/sketch.h"

/// @file
/// Writing SVG: numbers and paths.

namespace lascaux {

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
