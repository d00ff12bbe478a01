#pragma once

#include <algorithm>

namespace lascaux {

/// 0 up to 0, 1 from 1 on, and a smooth cubic between.
inline double Smoothstep(double x) {
  const double t = std::clamp(x, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

}  // namespace lascaux
