#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "lascaux/skeleton/creature.h"
#include "skeleton/built_parts.h"
#include "skeleton/chains.h"
#include "skeleton/check_creature.h"
#include "skeleton/index.h"
#include "skeleton/part_surface.h"
#include "skeleton/ring.h"
#include "skeleton/shape_limb.h"
#include "skeleton/shape_torso.h"

namespace lascaux {
namespace {

using Eigen::Vector2d;

/// A part holds to its parent when one of its discs reaches this share of its radius into it.
constexpr double kHold = 0.5;
/// Halvings of an interval of a few radii: the surface is found to 1e-9 of one.
constexpr int kHalvings = 32;

template <typename Visit>
void ForEachDisc(const CreaturePart& part, Visit visit) {
  for (const Chain& chain : part.axis) {
    for (const SkeletonVertex& v : chain.vertices) visit(v);
  }
}

/// The least reach of a station, as a share of the way to the nearest one on its chain: tips have
/// no radius, and a station that reached nowhere would be a spike between its neighbours.
constexpr double kLeastReach = 0.8;
/// Steepest slope along a chain that stations carry on: 45 degrees.
constexpr double kSteepestTilt = 1.0;

/// Stations of one chain, the first of them `stations[0]`, carry on how the depth changes along it:
/// averages of depths alone would be steps, and turn back towards the middle beyond the last disc.
/// How it changes across the chain stays.
void CarryOn(std::span<DepthStation> stations) {
  for (std::size_t i = 0; i < stations.size(); ++i) {
    const DepthStation& before = stations[i > 0 ? i - 1 : i];
    const DepthStation& after = stations[std::min(i + 1, stations.size() - 1)];
    const Eigen::Vector2d way = after.position - before.position;
    const double squared = way.squaredNorm();
    if (!(squared > 0)) continue;
    DepthStation& here = stations[i];
    const Eigen::Vector2d across = here.tilt - here.tilt.dot(way) / squared * way;
    here.tilt = (after.z - before.z) / squared * way + across;
    const double slope = here.tilt.norm();
    if (slope > kSteepestTilt) here.tilt *= kSteepestTilt / slope;
    double nearest = way.norm();
    for (const DepthStation* other : {&before, &after}) {
      const double distance = (other->position - here.position).norm();
      if (distance > 0) nearest = std::min(nearest, distance);
    }
    here.reach = std::max(here.reach, kLeastReach * nearest);
  }
}

/// The same for all chains of a part.
void CarryOn(CreaturePart& part) {
  std::size_t first = 0;
  for (const Chain& chain : part.axis) {
    CarryOn(std::span(part.stations).subspan(first, chain.vertices.size()));
    first += chain.vertices.size();
  }
}

/// Depth of the part's middle at a disc.
double DepthAt(const CreaturePart& part, std::size_t disc) {
  return part.stations.empty() ? part.z : part.stations[disc].z;
}

/// Whether the part, moved by `shift`, reaches into its parent.
bool Holds(const CreaturePart& part, double shift, const LimbParent& parent) {
  std::size_t disc = 0;
  bool holds = false;
  ForEachDisc(part, [&](const SkeletonVertex& v) {
    const double z = DepthAt(part, disc++) + shift;
    double distance = parent.surface.Distance(v.position, z);
    if (z == parent.surface.Middle(v.position)) {
      distance = std::min(distance, SignedDistanceToRing(parent.outline, v.position));
    }
    holds = holds || distance < (1 - kHold) * v.radius;
  });
  return holds;
}

/// The least move towards the parent's depth by which the part holds; none when there is none.
std::optional<double> ShiftToHold(const CreaturePart& part, const LimbParent& parent) {
  if (Holds(part, 0, parent)) return 0;
  double loose = 0, held = parent.part.z - part.z;
  if (!Holds(part, held, parent)) return std::nullopt;
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

  Outcome<Creature> Place(Creature creature) {
    for (CreaturePart& part : creature.parts) {
      if (part.part == graph_.body) part.stations = ShapeTorso(part.axis, options_);
      if (part.parent) PlaceOn(creature.parts[Index(*part.parent)], part);
      if (graph_.nodes[Index(part.part)].flat) Flatten(part);
    }
    return {std::move(creature), std::move(diagnostics_)};
  }

 private:
  void PlaceOn(const CreaturePart& parent_part, CreaturePart& part) {
    const PartSurface surface(parent_part);
    const LimbParent parent{parent_part, surface,
                            parts_.parts[Index(parent_part.part)].outline.points};
    const PartRole role = graph_.nodes[Index(part.part)].role;
    part.mirrored =
        parent_part.mirrored || role == PartRole::kForeground || role == PartRole::kIsland;
    // More of a limb (a hoof) stays at the limb's depth.
    const bool over = graph_.nodes[Index(part.part)].relation == Relation::kOver;
    if (role == PartRole::kForeground && over) {
      LimbShape shape = ShapeLimb(part, parts_.parts[Index(part.part)], parent, options_);
      if (shape.pushed > 0) NotePair(part, shape);
      Take(std::move(shape), part);
      CarryOn(part);
    } else if (role == PartRole::kIsland) {
      Take(ShapeIsland(part, parent), part);
    } else {
      part.z = parent_part.z;
      if (parent_part.mirrored) Follow(surface, part);
    }
    const std::optional<double> shift = ShiftToHold(part, parent);
    if (shift) {
      part.z += *shift;
      for (DepthStation& station : part.stations) station.z += *shift;
      return;
    }
    diagnostics_.push_back(At(
        Warning("part-loose", fmt::format("part {} does not reach into part {} and may come off; "
                                          "let their outlines meet",
                                          NameOf(part), NameOf(parent_part))),
        LargestDisc(part).position));
  }

  void NotePair(const CreaturePart& part, const LimbShape& shape) {
    diagnostics_.push_back(
        At(Note("pair-close",
                fmt::format("{} sits {:.2f} of its radius further out than its parent's flank "
                            "suggests, to stand apart from its mirror image",
                            NameOf(part), shape.pushed)),
           LargestDisc(part).position));
  }

  static void Take(LimbShape shape, CreaturePart& part) {
    part.z = shape.z;
    part.stations = std::move(shape.stations);
    if (!shape.shoulder) return;
    part.axis.push_back(*shape.shoulder);
    part.chains.push_back(std::move(*shape.shoulder));
  }

  void Flatten(CreaturePart& part) const {
    part.depth_scale = options_.flat_depth;
    for (DepthStation& station : part.stations) {
      station.scale = std::min(station.scale, options_.flat_depth);
    }
  }

  /// What sits on a part out of the plane goes where that goes.
  static void Follow(const PartSurface& surface, CreaturePart& part) {
    ForEachDisc(part, [&](const SkeletonVertex& v) {
      part.stations.push_back(
          {v.position, v.radius, surface.Middle(v.position), surface.Scale(v.position)});
    });
    CarryOn(part);
  }

  const std::string& NameOf(const CreaturePart& part) const {
    return graph_.nodes[Index(part.part)].name;
  }

  const Parts& parts_;
  const DepthGraph& graph_;
  const PlaceInDepthOptions& options_;
  Diagnostics diagnostics_;
};

}  // namespace

Creature AssembleCreature(const DepthGraph& graph, const std::vector<Skeleton>& skeletons) {
  std::vector<const Skeleton*> skeleton_of(graph.nodes.size(), nullptr);
  for (const Skeleton& s : skeletons) skeleton_of[Index(s.part)] = &s;
  const std::vector<char> built = BuiltParts(graph);
  std::vector<int> index_of(graph.nodes.size(), -1);
  Creature creature;
  for (const int part : graph.order) {
    if (!built[Index(part)] || skeleton_of[Index(part)] == nullptr) continue;
    CreaturePart made;
    made.part = part;
    for (const Chain& chain : CutIntoChains(*skeleton_of[Index(part)])) {
      made.chains.push_back(Refined(chain));
    }
    made.axis = made.chains;
    const std::optional<int> parent = graph.nodes[Index(part)].parent;
    if (parent && index_of[Index(*parent)] >= 0) made.parent = index_of[Index(*parent)];
    index_of[Index(part)] = static_cast<int>(creature.parts.size());
    creature.parts.push_back(std::move(made));
  }
  return creature;
}

Outcome<Creature> PlaceInDepth(const Parts& parts, const DepthGraph& graph, Creature creature,
                               const PlaceInDepthOptions& options) {
  if (Diagnostics wrong = CheckCreature(parts, creature); HasError(wrong)) {
    return Outcome<Creature>::Failure(std::move(wrong));
  }
  return Placer(parts, graph, options).Place(std::move(creature));
}

}  // namespace lascaux
