#include "settle.h"

#include <algorithm>
#include <limits>

#include "grid.h"

namespace lascaux {

void StandOnGround(Model& model) {
  float lowest = std::numeric_limits<float>::infinity();
  for (const Eigen::Vector3f& vertex : model.mesh->vertices) lowest = std::min(lowest, vertex.y());
  if (model.mesh->vertices.empty()) return;
  for (Eigen::Vector3f& vertex : model.mesh->vertices) vertex.y() -= lowest;
  model.grid->surface->transform().postTranslate(
      openvdb::Vec3d(0, -static_cast<double>(lowest), 0));
  model.frame->shift.y() -= static_cast<double>(lowest);
}

std::vector<std::vector<Eigen::Vector2d>> BuiltOutlines(const Model& model) {
  std::vector<std::vector<Eigen::Vector2d>> rings;
  for (std::size_t i = 0; i < model.parts->parts.size(); ++i) {
    const PartRole role = model.graph->nodes[i].role;
    if (role == PartRole::kBackground || role == PartRole::kIgnored) continue;
    std::vector<Eigen::Vector2d>& ring = rings.emplace_back();
    for (const Eigen::Vector2d& point : model.parts->parts[i].outline.points)
      ring.push_back(model.frame->ToModel(point));
  }
  return rings;
}

}  // namespace lascaux
