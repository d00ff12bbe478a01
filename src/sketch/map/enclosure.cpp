#include "sketch/map/enclosure.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "sketch/map/min_cut.h"

namespace lascaux {
namespace {

/// Flows are whole numbers, so that the cut does not hang on rounding: this many units a squared
/// diagonal.
constexpr double kUnits = 1e12;

std::int64_t Units(double share) { return static_cast<std::int64_t>(share * kUnits); }

/// The face on whose boundary a cycle lies: itself, the one around a hole, or -1 for the outside.
int FaceOf(const PlanarMap& map, int half_edge) {
  const int c = map.cycle[static_cast<std::size_t>(half_edge)];
  const MapCycle& cycle = map.cycles[static_cast<std::size_t>(c)];
  if (cycle.area > 0) return c;
  return cycle.inside.value_or(-1);
}

}  // namespace

Outcome<std::vector<std::size_t>> ChooseClosures(std::vector<ArrangementLine> lines,
                                                 const std::vector<Closure>& closures,
                                                 double diagonal) {
  // Closure i is drawn as a stroke of the number -2 - i.
  for (std::size_t i = 0; i < closures.size(); ++i) {
    lines.push_back({{closures[i].from, closures[i].to}, -2 - static_cast<int>(i), false, 0});
  }
  Diagnostics log;
  const auto map = Arrange(lines, diagonal).MoveInto(log);
  if (!map) return Outcome<std::vector<std::size_t>>::Failure(std::move(log));

  const int outside = static_cast<int>(map->cycles.size()), inside = outside + 1;
  CutGraph graph(outside + 2);
  const double square = diagonal * diagonal;
  for (int c = 0; c < outside; ++c) {
    const MapCycle& cycle = map->cycles[static_cast<std::size_t>(c)];
    if (cycle.area > 0) graph.Link(c, inside, Units(cycle.area / square), 0);
  }
  const auto face = [&](int h) {
    const int f = FaceOf(*map, h);
    return f < 0 ? outside : f;
  };
  for (int e = 0; e < static_cast<int>(map->edges.size()); ++e) {
    const MapEdge& edge = map->edges[static_cast<std::size_t>(e)];
    const int a = face(2 * e), b = face(2 * e + 1);
    if (edge.stroke > -2 || a == b) continue;
    const Closure& closure = closures[static_cast<std::size_t>(-2 - edge.stroke)];
    const std::int64_t price =
        Units(closure.price * std::min(1.0, Length(edge.points) / closure.Length()) / square);
    graph.Link(a, b, price, price);
  }
  const std::vector<bool> stays_outside = graph.SourceSide(outside, inside);
  const auto is_outside = [&](int h) { return stays_outside[static_cast<std::size_t>(face(h))]; };
  std::vector<std::size_t> chosen;
  for (int e = 0; e < static_cast<int>(map->edges.size()); ++e) {
    const int stroke = map->edges[static_cast<std::size_t>(e)].stroke;
    if (stroke <= -2 && is_outside(2 * e) != is_outside(2 * e + 1))
      chosen.push_back(static_cast<std::size_t>(-2 - stroke));
  }
  std::sort(chosen.begin(), chosen.end());
  chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
  return {std::move(chosen), std::move(log)};
}

}  // namespace lascaux
