#include "skeleton/union_outline.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "skeleton/index.h"
#include "skeleton/ring.h"

namespace lascaux {
namespace {

using Eigen::Vector2d;

/// A sample lies on the boundary if nothing is built this far outside of it, in spacings.
constexpr double kOutside = 0.6;

struct BuiltRing {
  Ring ring;
  Eigen::AlignedBox2d box;
};

/// What is built, less islands: they lie inside of others.
bool IsOutlined(PartRole role) {
  return role != PartRole::kBackground && role != PartRole::kIgnored && role != PartRole::kIsland;
}

/// The rings of all that is outlined, coarsened to the spacing.
std::vector<BuiltRing> BuiltRings(const Parts& parts, const DepthGraph& graph, double spacing) {
  std::vector<BuiltRing> rings;
  for (std::size_t i = 0; i < parts.parts.size(); ++i) {
    if (!IsOutlined(graph.nodes[i].role)) continue;
    BuiltRing& built = rings.emplace_back();
    for (const Vector2d& p : parts.parts[i].outline.points) {
      built.box.extend(p);
      if (built.ring.empty() || (p - built.ring.back()).norm() > 0.25 * spacing)
        built.ring.push_back(p);
    }
  }
  return rings;
}

bool IsCovered(const std::vector<BuiltRing>& rings, const Vector2d& point) {
  return std::any_of(rings.begin(), rings.end(), [&](const BuiltRing& built) {
    return built.box.contains(point) && Contains(built.ring, point);
  });
}

}  // namespace

Eigen::AlignedBox2d BuiltBox(const Parts& parts, const DepthGraph& graph) {
  Eigen::AlignedBox2d box;
  for (std::size_t i = 0; i < parts.parts.size(); ++i) {
    if (!IsOutlined(graph.nodes[i].role)) continue;
    for (const Vector2d& p : parts.parts[i].outline.points) box.extend(p);
  }
  return box;
}

std::vector<std::vector<Vector2d>> UnionOutline(const Parts& parts, const DepthGraph& graph,
                                                double spacing) {
  const std::vector<BuiltRing> rings = BuiltRings(parts, graph, spacing);
  std::vector<std::vector<Vector2d>> runs;
  for (std::size_t i = 0; i < parts.parts.size(); ++i) {
    if (!IsOutlined(graph.nodes[i].role)) continue;
    const std::vector<OutlineSample> samples = SampleOutline(parts.parts[i].outline, spacing);
    runs.emplace_back();
    for (std::size_t k = 0; k <= samples.size(); ++k) {
      const OutlineSample& here = samples[k % samples.size()];
      const OutlineSample& next = samples[(k + 1) % samples.size()];
      const Vector2d along = next.point - here.point;
      // Positive area: the inside is to the left of the walk, the outside to the right.
      const Vector2d outward = Vector2d(along.y(), -along.x()).stableNormalized();
      const bool boundary =
          here.kind != OutlineKind::kCompletion &&
          !IsCovered(rings, here.point + 0.5 * along + kOutside * spacing * outward);
      if (boundary) {
        if (runs.back().empty()) runs.back().push_back(here.point);
        if (k < samples.size()) runs.back().push_back(next.point);
      } else if (!runs.back().empty()) {
        runs.emplace_back();
      }
    }
  }
  std::erase_if(runs, [](const auto& run) { return run.size() < 2; });
  return runs;
}

}  // namespace lascaux
