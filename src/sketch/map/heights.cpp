#include "sketch/map/heights.h"

#include <algorithm>

namespace lascaux {

Heights HeightsOf(const PlanarMap& map) {
  Heights heights{map.nodes.front().position.y(), map.nodes.front().position.y()};
  for (const MapEdge& edge : map.edges) {
    for (const Eigen::Vector2d& p : edge.points) {
      heights.top = std::min(heights.top, p.y());
      heights.bottom = std::max(heights.bottom, p.y());
    }
  }
  return heights;
}

}  // namespace lascaux
