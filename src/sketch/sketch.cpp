#include "lascaux/sketch/sketch.h"

namespace lascaux {

Eigen::AlignedBox2d Bounds(const Sketch& sketch) {
  Eigen::AlignedBox2d box;
  for (const Stroke& stroke : sketch.strokes) {
    for (const CubicBezier& piece : stroke.pieces) box.extend(Bounds(piece));
  }
  return box;
}

}  // namespace lascaux
