#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "lascaux/skeleton/creature.h"
#include "skeleton/built_parts.h"
#include "skeleton/chains.h"
#include "skeleton/index.h"
#include "skeleton/ring.h"

namespace lascaux {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// How deep the middle of an island lies under the surface, in its radii: 0.6 of them show.
constexpr double kIslandDepth = 0.4;
/// A part holds to its parent when one of its discs reaches this share of its radius into it.
constexpr double kHold = 0.5;
/// Halvings of an interval of a few radii: the surface is found to 1e-9 of one.
constexpr int kHalvings = 32;

/// The surface of one part by itself, in sketch coordinates and depth.
class PartSurface {
 public:
  explicit PartSurface(const CreaturePart& part) : z_(part.z) {
    const ModelFrame sketch_frame = SketchFrame();
    FieldPart field;
    field.z0 = part.z;
    field.depth_scale = part.depth_scale;
    for (const Chain& chain : part.chains) {
      field.chains.push_back(MakeFieldChain(chain, sketch_frame, part.z));
      for (const SkeletonVertex& v : chain.vertices) {
        reach_ = std::max(reach_, kSupportRadii * part.depth_scale * v.radius);
      }
    }
    field_.parts.push_back(std::move(field));
  }

  FieldSample At(const Vector2d& point, double z) const {
    return Evaluate(field_, Vector3d(point.x(), -point.y(), z));
  }

  double Distance(const Vector2d& point, double z) const { return SignedDistance(At(point, z)); }

  /// Depth at which the ray from `point` towards the viewer leaves the part, if it meets it. A
  /// planar skeleton's field falls with the distance from its plane.
  std::optional<double> Front(const Vector2d& point) const {
    if (At(point, z_).value < kIsoValue) return std::nullopt;
    double inside = z_, outside = z_ + reach_;
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = (inside + outside) / 2;
      (At(point, middle).value >= kIsoValue ? inside : outside) = middle;
    }
    return inside;
  }

  /// How much of the surface's normal at (point, z) points to the viewer, 0 to 1.
  double Facing(const Vector2d& point, double z) const {
    const Vector3d gradient = At(point, z).gradient;
    const double length = gradient.norm();
    return length > 0 ? std::clamp(-gradient.z() / length, 0.0, 1.0) : 1.0;
  }

  double z() const { return z_; }

 private:
  /// y up and no scale: depths are in sketch units.
  static ModelFrame SketchFrame() { return {}; }

  Field field_;
  double z_ = 0;
  double reach_ = 0;
};

template <typename Visit>
void ForEachDisc(const CreaturePart& part, Visit visit) {
  for (const Chain& chain : part.chains) {
    for (const SkeletonVertex& v : chain.vertices) visit(v);
  }
}

/// The disc that holds a limb: the one that touches its outline nearest the middle of its
/// completion inside the parent, or the one deepest in the parent's outline when the limb has none.
/// Not simply the nearest end of a chain: where the completion has corners, ends are tips of no
/// radius.
SkeletonVertex TopOf(const CreaturePart& limb, const Part& part, const Ring& parent) {
  Vector2d middle = Vector2d::Zero();
  const bool has_root = part.root && !part.root->open_completion.empty();
  if (has_root) {
    // By length, not by count: completions are not sampled evenly.
    double total = 0;
    const std::vector<Vector2d>& curve = part.root->open_completion;
    for (std::size_t i = 0; i + 1 < curve.size(); ++i) {
      const double step = (curve[i + 1] - curve[i]).norm();
      middle += step * (curve[i] + curve[i + 1]) / 2;
      total += step;
    }
    middle = total > 0 ? Vector2d(middle / total) : curve.front();
  }
  SkeletonVertex best;
  double least = std::numeric_limits<double>::infinity();
  ForEachDisc(limb, [&](const SkeletonVertex& v) {
    const double cost = has_root ? (v.position - middle).norm() - v.radius
                                 : SignedDistanceToRing(parent, v.position);
    if (cost < least) least = cost, best = v;
  });
  return best;
}

SkeletonVertex LargestDisc(const CreaturePart& part) {
  SkeletonVertex best;
  ForEachDisc(part, [&](const SkeletonVertex& v) {
    if (v.radius > best.radius) best = v;
  });
  return best;
}

/// The largest radius of the limb where it is clear of its parent's outline; 0 when it is not.
double FreeRadius(const CreaturePart& limb, const Ring& parent) {
  double radius = 0;
  ForEachDisc(limb, [&](const SkeletonVertex& v) {
    if (v.radius > radius && !Contains(parent, v.position)) radius = v.radius;
  });
  return radius;
}

/// A parent by its surface and, in its own plane, by its outline, which is what it will be fitted
/// to.
struct Support {
  const PartSurface& surface;
  const Ring& outline;

  double Distance(const Vector2d& point, double z) const {
    const double distance = surface.Distance(point, z);
    if (z != surface.z()) return distance;
    return std::min(distance, SignedDistanceToRing(outline, point));
  }
};

/// Whether the part, moved to depth z, reaches into its parent.
bool Holds(const CreaturePart& part, double z, const Support& parent) {
  bool holds = false;
  ForEachDisc(part, [&](const SkeletonVertex& v) {
    holds = holds || parent.Distance(v.position, z) < (1 - kHold) * v.radius;
  });
  return holds;
}

/// Depth nearest to `wanted`, on the way from it to `safe`, at which the part holds; `safe` when it
/// does nowhere.
double HeldDepth(const CreaturePart& part, const Support& parent, double wanted, double safe) {
  if (Holds(part, wanted, parent)) return wanted;
  double loose = wanted, held = safe;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = (loose + held) / 2;
    (Holds(part, middle, parent) ? held : loose) = middle;
  }
  return held;
}

class Placer {
 public:
  Placer(const Parts& parts, const DepthGraph& graph, const PlaceInDepthOptions& options)
      : parts_(parts), graph_(graph), options_(options) {}

  Outcome<Creature> Place(const std::vector<Skeleton>& skeletons) {
    std::vector<const Skeleton*> skeleton_of(parts_.parts.size(), nullptr);
    for (const Skeleton& s : skeletons) skeleton_of[Index(s.part)] = &s;
    const std::vector<char> built = BuiltParts(graph_);
    std::vector<int> index_of(parts_.parts.size(), -1);
    for (const int part : graph_.order) {
      if (!built[Index(part)] || skeleton_of[Index(part)] == nullptr) continue;
      CreaturePart made;
      made.part = part;
      for (const Chain& chain : CutIntoChains(*skeleton_of[Index(part)])) {
        made.chains.push_back(Refined(chain));
      }
      const std::optional<int> parent = graph_.nodes[Index(part)].parent;
      if (parent && index_of[Index(*parent)] >= 0) made.parent = index_of[Index(*parent)];
      if (part == graph_.body) made.depth_scale = options_.torso_depth;
      if (graph_.nodes[Index(part)].flat) made.depth_scale = options_.flat_depth;
      if (made.parent) PlaceOn(creature_.parts[Index(*made.parent)], made);
      index_of[Index(part)] = static_cast<int>(creature_.parts.size());
      creature_.parts.push_back(std::move(made));
    }
    return {std::move(creature_), std::move(diagnostics_)};
  }

 private:
  void PlaceOn(const CreaturePart& parent, CreaturePart& part) {
    const PartSurface surface(parent);
    const PartRole role = graph_.nodes[Index(part.part)].role;
    part.mirrored = parent.mirrored || role == PartRole::kForeground || role == PartRole::kIsland;
    part.z = parent.z;
    // More of a limb (a hoof) stays at the limb's depth.
    const bool over = graph_.nodes[Index(part.part)].relation == Relation::kOver;
    if (role == PartRole::kForeground && over) part.z = LimbDepth(parent, surface, part);
    if (role == PartRole::kIsland) part.z = IslandDepth(surface, part);
    const Support support{surface, parts_.parts[Index(parent.part)].outline.points};
    part.z = HeldDepth(part, support, part.z, parent.z);
    if (!Holds(part, part.z, support)) {
      const SkeletonVertex disc = LargestDisc(part);
      diagnostics_.push_back(At(
          Warning("part-loose", fmt::format("part {} does not reach into part {} and may come off; "
                                            "let their outlines meet",
                                            NameOf(part), NameOf(parent))),
          disc.position));
    }
  }

  double LimbDepth(const CreaturePart& parent, const PartSurface& surface,
                   const CreaturePart& limb) {
    const Ring& outline = parts_.parts[Index(parent.part)].outline.points;
    const SkeletonVertex top = TopOf(limb, parts_.parts[Index(limb.part)], outline);
    const std::optional<double> front = surface.Front(top.position);
    const double hit = front.value_or(surface.z());
    // Where the ray misses, the nearest outline point's normal lies in the plane: no share of it
    // goes into depth.
    const double slope = front ? top.radius * surface.Facing(top.position, hit) : 0;
    const double free_radius = FreeRadius(limb, outline);
    const double apart = free_radius > 0 ? free_radius * (1 + options_.pair_gap / 2) : 0;
    const double flush = hit - options_.embed_max * slope;
    const double shallow = hit - options_.embed_min * slope;
    if (apart <= flush) return flush;
    if (apart <= shallow) return apart;
    const double z = HeldDepth(limb, {surface, outline}, apart, shallow);
    diagnostics_.push_back(
        At(Note("pair-close",
                fmt::format("{} sits {:.2f} of its radius further out than its parent's surface "
                            "suggests, to stand {:.2f} radii from its mirror image",
                            NameOf(limb), (z - shallow) / top.radius,
                            2 * (z - free_radius) / free_radius)),
           top.position));
    return z;
  }

  double IslandDepth(const PartSurface& surface, const CreaturePart& island) const {
    const SkeletonVertex disc = LargestDisc(island);
    const std::optional<double> front = surface.Front(disc.position);
    if (!front) return surface.z();
    return *front - kIslandDepth * disc.radius * surface.Facing(disc.position, *front);
  }

  const std::string& NameOf(const CreaturePart& part) const {
    return graph_.nodes[Index(part.part)].name;
  }

  const Parts& parts_;
  const DepthGraph& graph_;
  const PlaceInDepthOptions& options_;
  Creature creature_;
  Diagnostics diagnostics_;
};

}  // namespace

Outcome<Creature> PlaceInDepth(const Parts& parts, const DepthGraph& graph,
                               const std::vector<Skeleton>& skeletons,
                               const PlaceInDepthOptions& options) {
  return Placer(parts, graph, options).Place(skeletons);
}

}  // namespace lascaux
