#include "print_facts.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>

namespace lascaux {
namespace {

std::string PlaceText(const Eigen::Vector3d& p) {
  return fmt::format("({:.1f}, {:.1f}, {:.1f})", p.x(), p.y(), p.z());
}

}  // namespace

PrintFacts MeasureForPrint(const Mesh& mesh, const MeshDetails& details, double millimetres,
                           const Execution& execution) {
  PrintFacts facts;
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3f& v : mesh.vertices) box.extend(v.cast<double>());
  if (!box.isEmpty()) facts.size = millimetres * box.sizes();
  facts.wall = SmallestWall(mesh, execution);
  if (facts.wall) {
    facts.wall->thickness *= millimetres;
    facts.wall->middle *= millimetres;
    if (!details.triangle_parts.empty())
      facts.wall_part = details.parts[details.triangle_parts[facts.wall->triangle]].name;
  }
  facts.stability = MeasureStability(mesh, kContact / millimetres);
  if (facts.stability) {
    facts.stability->center_of_mass *= millimetres;
    facts.stability->margin *= millimetres;
  }
  return facts;
}

Diagnostics PrintWarnings(const PrintFacts& facts) {
  Diagnostics warnings;
  if (facts.wall && facts.wall->thickness < kThinWall) {
    warnings.push_back(Warning(
        "wall-thin",
        fmt::format("{} is {:.2f} mm thin at {}, under {} mm: it may break or not be printed; "
                    "print it larger",
                    facts.wall_part.empty() ? "the mesh" : facts.wall_part, facts.wall->thickness,
                    PlaceText(facts.wall->middle), kThinWall)));
  }
  if (facts.stability && !facts.stability->Stands()) {
    warnings.push_back(
        Warning("falls-over",
                fmt::format("the centre of mass is {:.1f} mm outside of the feet: it falls over",
                            -facts.stability->margin)));
  }
  return warnings;
}

Json PrintFactsJson(const std::optional<PrintFacts>& facts) {
  Json json = {{"size", nullptr}, {"smallest_wall", nullptr}, {"stability", nullptr}};
  if (!facts) return json;
  json["size"] = PlaceJson(facts->size);
  if (const auto& wall = facts->wall)
    json["smallest_wall"] = {{"thickness", wall->thickness},
                             {"at", PlaceJson(wall->middle)},
                             {"part", facts->wall_part.empty() ? Json() : Json(facts->wall_part)}};
  if (const auto& stability = facts->stability)
    json["stability"] = {{"center_of_mass", PlaceJson(stability->center_of_mass)},
                         {"margin", stability->margin},
                         {"stands", stability->Stands()}};
  return json;
}

}  // namespace lascaux
