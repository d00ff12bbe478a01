#include "sketch/depth/body.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <string>

namespace lascaux {
namespace {

using Eigen::Vector2d;

/// Scores of parts that cannot be the body are 0.
std::vector<double> Scores(const Parts& parts, const Adjacency& adjacency) {
  Eigen::AlignedBox2d box;
  for (const Part& part : parts.parts) {
    for (const Vector2d& p : part.outline.points) box.extend(p);
  }
  std::vector<double> scores(parts.parts.size(), 0);
  for (std::size_t i = 0; i < parts.parts.size(); ++i) {
    const Part& part = parts.parts[i];
    if (part.kind != PartKind::kBorder) continue;
    double neighbours = 1 + 0.5 * static_cast<double>(adjacency.shared[i].size());
    for (const Part& other : parts.parts) neighbours += other.over == static_cast<int>(i) ? 1 : 0;
    const Vector2d away = (Centroid(part.outline.points) - box.center()).cwiseQuotient(box.sizes());
    scores[i] = SignedArea(part.outline.points) * neighbours * (1 - away.norm());
  }
  return scores;
}

std::optional<int> PartAt(const Parts& parts, const Vector2d& point) {
  std::optional<int> best;
  for (std::size_t i = 0; i < parts.parts.size(); ++i) {
    const Part& part = parts.parts[i];
    if (part.kind != PartKind::kBorder || !Contains(part.outline.points, point)) continue;
    best = static_cast<int>(i);
  }
  return best;
}

}  // namespace

Outcome<BodyChoice> FindBody(const Parts& parts, const Adjacency& adjacency,
                             const OrderByDepthOptions& options) {
  const std::vector<double> scores = Scores(parts, adjacency);
  const auto best = std::max_element(scores.begin(), scores.end());
  if (best == scores.end() || *best <= 0) {
    return Outcome<BodyChoice>::Failure(
        Error(FailureKind::kUnderstanding, "no-body",
              "no closed part of the drawing can be a body; draw the torso's outline closed"));
  }
  BodyChoice choice{static_cast<int>(best - scores.begin()), 1};
  for (std::size_t i = 0; i < scores.size(); ++i) {
    if (static_cast<int>(i) != choice.part)
      choice.margin = std::min(choice.margin, 1 - scores[i] / *best);
  }
  if (options.body_part) {
    const int part = *options.body_part;
    const bool there = part >= 0 && part < static_cast<int>(parts.parts.size()) &&
                       parts.parts[static_cast<std::size_t>(part)].kind == PartKind::kBorder;
    if (there) return BodyChoice{part, choice.margin};
    return Outcome<BodyChoice>::Failure(Error(
        FailureKind::kUnderstanding, "body-not-there",
        "part " + std::to_string(part) + " can't be the body; name a closed part that is no limb"));
  }
  if (!options.body) return choice;
  const auto chosen = PartAt(parts, *options.body);
  if (!chosen) {
    char text[160];
    std::snprintf(
        text, sizeof text,
        "no part that could be a body holds the point (%.6g, %.6g); give a point inside the torso",
        options.body->x(), options.body->y());
    return Outcome<BodyChoice>::Failure(
        At(Error(FailureKind::kUnderstanding, "body-not-there", text), *options.body));
  }
  return BodyChoice{*chosen, choice.margin};
}

}  // namespace lascaux
