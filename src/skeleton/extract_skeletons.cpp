#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <cmath>
#include <optional>
#include <utility>

#include "lascaux/base/arena.h"
#include "lascaux/skeleton/skeleton.h"
#include "skeleton/built_parts.h"
#include "skeleton/extend_outline.h"
#include "skeleton/index.h"
#include "skeleton/medial_axis.h"
#include "skeleton/ring.h"
#include "skeleton/scale_axis.h"
#include "skeleton/simplify_skeleton.h"

namespace lascaux {
namespace {

using Eigen::Vector2d;

/// Small outlines get at least this many samples, whatever the drawing's size.
constexpr double kLeastSamples = 96;
/// Area over squared perimeter (a disc has 0.08) below which an outline is a line.
constexpr double kThinnest = 1e-6;

/// Middle of the finite points of a ring.
Vector2d MiddleOf(const Ring& ring) {
  Vector2d sum = Vector2d::Zero();
  double count = 0;
  for (const Vector2d& p : ring) {
    if (p.allFinite()) sum += p, ++count;
  }
  return count > 0 ? Vector2d(sum / count) : sum;
}

bool IsDegenerate(const Outline& outline) {
  if (outline.points.size() < 3 || outline.kinds.size() != outline.points.size()) return true;
  for (const Vector2d& p : outline.points) {
    if (!p.allFinite()) return true;
  }
  const double perimeter = Perimeter(outline.points);
  const double area = std::abs(SignedArea(outline.points));
  return !(area > kThinnest * perimeter * perimeter);
}

Diagnostic DegenerateOutline(int part, const DepthNode& node, const Ring& ring) {
  return At(Error(FailureKind::kUnderstanding, "degenerate-outline",
                  fmt::format("the outline of part {} ({}), {} points, encloses no area; draw it "
                              "as a closed shape or remove its strokes",
                              part, node.name, ring.size())),
            MiddleOf(ring));
}

double DrawingDiagonal(const Parts& parts) {
  Eigen::AlignedBox2d box;
  for (const Part& part : parts.parts) {
    for (const Vector2d& p : part.outline.points) {
      if (p.allFinite()) box.extend(p);
    }
  }
  return box.isEmpty() ? 0.0 : box.diagonal().norm();
}

std::optional<Skeleton> SkeletonOf(const Outline& outline, double spacing,
                                   const ExtractSkeletonsOptions& options) {
  const double step = std::min(spacing, Perimeter(outline.points) / kLeastSamples);
  Ring ring;
  for (const OutlineSample& sample : SampleOutline(outline, step)) ring.push_back(sample.point);
  const Skeleton axis = MedialAxis(ring);
  if (axis.vertices.empty()) return std::nullopt;
  return Simplify(ScaleAxis(axis, options.scale_axis), options.simplify);
}

}  // namespace

std::vector<char> BuiltParts(const DepthGraph& graph) {
  std::vector<char> built(graph.nodes.size(), 0);
  for (const int part : graph.order) {
    const DepthNode& node = graph.nodes[Index(part)];
    if (node.role == PartRole::kBackground || node.role == PartRole::kIgnored) continue;
    built[Index(part)] = !node.parent || built[Index(*node.parent)] ? 1 : 0;
  }
  return built;
}

Outcome<std::vector<Skeleton>> ExtractSkeletons(const Parts& parts, const DepthGraph& graph,
                                                const ExtractSkeletonsOptions& options,
                                                const Execution& execution) {
  const std::vector<char> built = BuiltParts(graph);
  Diagnostics diagnostics;
  std::vector<int> todo;
  for (std::size_t p = 0; p < parts.parts.size(); ++p) {
    const DepthNode& node = graph.nodes[p];
    const Outline& outline = parts.parts[p].outline;
    const bool wanted = node.role != PartRole::kBackground && node.role != PartRole::kIgnored;
    if (wanted && !built[p]) {
      diagnostics.push_back(At(
          Note("part-not-built",
               fmt::format("part {} ({}) is not built because the part that it is placed by is not",
                           p, node.name)),
          MiddleOf(outline.points)));
    }
    if (!built[p]) continue;
    todo.push_back(static_cast<int>(p));
    if (IsDegenerate(outline)) {
      diagnostics.push_back(DegenerateOutline(static_cast<int>(p), node, outline.points));
    }
  }
  if (HasError(diagnostics)) {
    return Outcome<std::vector<Skeleton>>::Failure(std::move(diagnostics));
  }
  const double spacing = options.sample_spacing * DrawingDiagonal(parts);
  std::vector<std::optional<Skeleton>> found(todo.size());
  RunInArena(execution, [&] {
    tbb::parallel_for(std::size_t{0}, todo.size(), [&](std::size_t i) {
      const int part = todo[i];
      const std::optional<int> parent = graph.nodes[Index(part)].parent;
      const Outline outline =
          parent ? OutlineToFill(parts, part, *parent) : parts.parts[Index(part)].outline;
      found[i] = SkeletonOf(outline, spacing, options);
      if (found[i]) found[i]->part = part;
    });
  });
  std::vector<Skeleton> skeletons;
  for (std::size_t i = 0; i < todo.size(); ++i) {
    if (found[i]) {
      skeletons.push_back(std::move(*found[i]));
    } else {
      diagnostics.push_back(DegenerateOutline(todo[i], graph.nodes[Index(todo[i])],
                                              parts.parts[Index(todo[i])].outline.points));
    }
  }
  if (HasError(diagnostics)) {
    return Outcome<std::vector<Skeleton>>::Failure(std::move(diagnostics));
  }
  return {std::move(skeletons), std::move(diagnostics)};
}

}  // namespace lascaux
