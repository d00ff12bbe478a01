#include "print_facts.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>

namespace lascaux {
namespace {

constexpr double kUnseenTilt = 2;   // degrees: as feet that are drawn by hand differ
constexpr double kSlightTilt = 10;  // degrees: it still stands for what was drawn

std::string PlaceText(const Eigen::Vector3d& p) {
  return fmt::format("({:.1f}, {:.1f}, {:.1f})", p.x(), p.y(), p.z());
}

/// The name of the part that a wall belongs to; empty: unknown.
std::string PartOf(const std::optional<Wall>& wall, const MeshDetails& details) {
  if (!wall || details.triangle_parts.empty()) return {};
  return details.parts[details.triangle_parts[wall->triangle]].name;
}

/// Of what rolls.
Diagnostic TiltDiagnostic(const Stability& stability) {
  if (stability.tilt <= kSlightTilt)
    return Note("leans", fmt::format("it rolls by {:.0f} degrees before it comes to rest; --base "
                                     "puts a plate under it",
                                     stability.tilt));
  return Warning("falls-over",
                 fmt::format("the centre of mass is {:.1f} mm outside of the feet: it falls over, "
                             "by {}; print it with --base",
                             -stability.margin,
                             stability.tilt < kFarthestTilt
                                 ? fmt::format("{:.0f} degrees", stability.tilt)
                                 : fmt::format("{:.0f} degrees or more", kFarthestTilt)));
}

}  // namespace

PrintFacts MeasureForPrint(const Mesh& mesh, const MeshDetails& details, double millimetres,
                           const Execution& execution) {
  PrintFacts facts;
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3f& v : mesh.vertices) box.extend(v.cast<double>());
  if (!box.isEmpty()) facts.size = millimetres * box.sizes();
  const WallFacts walls = MeasureWalls(mesh, kThinWall / millimetres, execution);
  facts.wall = walls.smallest;
  facts.thin = walls.thin;
  facts.wall_part = PartOf(facts.wall, details);
  facts.thin_part = PartOf(facts.thin.wall ? facts.thin.wall : facts.thin.tip, details);
  for (std::optional<Wall>* const wall : {&facts.wall, &facts.thin.wall, &facts.thin.tip}) {
    if (!*wall) continue;
    (*wall)->thickness *= millimetres;
    (*wall)->middle *= millimetres;
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
  const std::string part = facts.thin_part.empty() ? "the mesh" : facts.thin_part;
  if (const auto& wall = facts.thin.wall) {
    warnings.push_back(Warning(
        "wall-thin",
        fmt::format("{} is {:.2f} mm thin at {}, under {} mm: it may break or not be printed; "
                    "print it larger, or with --min-wall {}",
                    part, wall->thickness, PlaceText(wall->middle), kThinWall, kThinWall)));
  } else if (const auto& tip = facts.thin.tip) {
    warnings.push_back(
        Note("tip-thin", fmt::format("{} ends thinner than {} mm at {}: its tip will be blunt",
                                     part, kThinWall, PlaceText(tip->middle))));
  }
  if (facts.stability && facts.stability->tilt > kUnseenTilt)
    warnings.push_back(TiltDiagnostic(*facts.stability));
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
                         {"tilt", stability->tilt},
                         {"stands", stability->Stands()}};
  return json;
}

}  // namespace lascaux
