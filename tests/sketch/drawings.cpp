#include "sketch/drawings.h"

#include <algorithm>

namespace lascaux::testing {

using Eigen::Vector2d;

Stroke Straight(const Points& points) {
  Stroke stroke;
  for (std::size_t i = 0; i + 1 < points.size(); ++i)
    stroke.pieces.push_back(Line(points[i], points[i + 1]));
  stroke.width = 1;
  return stroke;
}

Stroke Loop(Points points) {
  points.push_back(points.front());
  Stroke stroke = Straight(points);
  stroke.closed = true;
  return stroke;
}

Stroke Circle(const Vector2d& center, double radius) {
  constexpr double kHandle =
      0.5522847498;  // the classic handle of a quarter circle, 2.7e-4 of the radius off
  const auto at = [&](double x, double y) { return Vector2d(center + radius * Vector2d(x, y)); };
  Stroke stroke;
  stroke.pieces = {{{at(1, 0), at(1, kHandle), at(kHandle, 1), at(0, 1)}},
                   {{at(0, 1), at(-kHandle, 1), at(-1, kHandle), at(-1, 0)}},
                   {{at(-1, 0), at(-1, -kHandle), at(-kHandle, -1), at(0, -1)}},
                   {{at(0, -1), at(kHandle, -1), at(1, -kHandle), at(1, 0)}}};
  stroke.closed = true;
  stroke.width = 1;
  return stroke;
}

int Count(const PlanarMap& map, CycleKind kind) {
  return static_cast<int>(std::count_if(map.cycles.begin(), map.cycles.end(),
                                        [&](const MapCycle& c) { return c.kind == kind; }));
}

Sketch SketchOf(std::initializer_list<Stroke> strokes) { return {strokes}; }

Sketch Moved(Sketch sketch, double scale, const Vector2d& shift) {
  for (Stroke& stroke : sketch.strokes) {
    stroke.width *= scale;
    for (CubicBezier& piece : stroke.pieces) {
      for (Vector2d& p : piece.p) p = scale * p + shift;
    }
  }
  return sketch;
}

Sketch Mirrored(Sketch sketch) {
  for (Stroke& stroke : sketch.strokes) {
    for (CubicBezier& piece : stroke.pieces) {
      for (Vector2d& p : piece.p) p.x() = -p.x();
    }
  }
  return sketch;
}

Sketch Quadruped() {
  // The torso's outline, clockwise on the page from the near leg's front, open where that leg
  // leaves it.
  const Stroke outline = Straight({{100, 200},
                                   {40, 180},
                                   {20, 120},
                                   {40, 60},
                                   {200, 40},
                                   {360, 60},
                                   {400, 90},
                                   {400, 130},
                                   {380, 180},
                                   {200, 200},
                                   {190, 200},
                                   {150, 200}});
  const Stroke near_front = Straight({{105, 130}, {101, 170}, {100, 200}, {98, 320}, {130, 320}});
  const Stroke near_rear = Straight({{145, 130}, {149, 170}, {150, 200}, {148, 320}, {130, 320}});
  const Stroke far_leg = Straight({{190, 200}, {196, 310}, {166, 310}, {149.1, 254}});
  const Stroke tail = Straight({{400, 90}, {480, 60}, {490, 80}, {400, 130}});
  return SketchOf({outline, near_front, near_rear, far_leg, tail, Circle({60, 100}, 8)});
}

}  // namespace lascaux::testing
