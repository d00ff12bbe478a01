#include "settle.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "grid.h"
#include "record_print.h"

namespace lascaux {

void StandOnGround(Model& model) {
  float lowest = std::numeric_limits<float>::infinity();
  for (const Eigen::Vector3f& vertex : model.mesh->vertices) lowest = std::min(lowest, vertex.y());
  if (model.mesh->vertices.empty()) return;
  for (Eigen::Vector3f& vertex : model.mesh->vertices) vertex.y() -= lowest;
  model.grid->surface.origin.y() -= static_cast<double>(lowest);
  model.frame->shift.y() -= static_cast<double>(lowest);
  model.lift -= static_cast<double>(lowest);
  if (model.print_record) Lift(*model.print_record, -static_cast<double>(lowest));
}

std::vector<std::vector<Eigen::Vector2d>> BuiltOutlines(const Model& model) {
  std::vector<std::vector<Eigen::Vector2d>> rings;
  for (std::size_t i = 0; i < model.parts->parts.size(); ++i) {
    std::vector<Eigen::Vector2d>& ring = rings.emplace_back();
    const PartRole role = model.graph->nodes[i].role;
    if (role == PartRole::kBackground || role == PartRole::kIgnored) continue;
    for (const Eigen::Vector2d& point : model.parts->parts[i].outline.points)
      ring.push_back(model.frame->ToModel(point));
  }
  if (model.print_record && model.print_record->changes.plate)
    rings.push_back(model.print_record->changes.plate->SideView());
  return rings;
}

HeadEnd FindHead(const Model& model) {
  constexpr double kMiddle = 0.05;  // of the animal's length, to both sides of its centre
  Eigen::AlignedBox2d animal, eyes;
  for (std::size_t i = 0; i < model.parts->parts.size(); ++i)
    for (const Eigen::Vector2d& point : model.parts->parts[i].outline.points) {
      animal.extend(point);
      if (model.graph->nodes[i].role == PartRole::kIsland) eyes.extend(point);
    }
  if (eyes.isEmpty()) return HeadEnd::kUnknown;
  const double offset = (eyes.center().x() - animal.center().x()) / animal.sizes().x();
  if (!(std::abs(offset) > kMiddle)) return HeadEnd::kUnknown;
  return offset > 0 ? HeadEnd::kRight : HeadEnd::kLeft;
}

}  // namespace lascaux
