#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "lascaux/base/execution.h"
#include "lascaux/base/outcome.h"
#include "lascaux/field/field.h"
#include "lascaux/skeleton/skeleton.h"
#include "lascaux/sketch/depth_graph.h"
#include "lascaux/sketch/parts.h"

/// @file
/// The creature: chains of every part, placed in depth, and the field that they make.
///
/// Source: Entem et al. 2015, section 6.3.

namespace lascaux {

/// A polyline of the skeleton with the radius of the outline at each vertex. In its part's plane,
/// sketch units.
struct Chain {
  std::vector<SkeletonVertex> vertices;

  bool operator==(const Chain&) const = default;
};

/// One part, ready to become a field.
struct CreaturePart {
  int part = 0;               ///< index in Parts::parts
  std::vector<Chain> chains;  ///< longest first; each reproduces its own discs
  std::optional<int> parent;  ///< index in Creature::parts of the part that it blends with
  double z = 0;               ///< depth of the drawn side, towards the viewer, in sketch units
  bool mirrored = false;      ///< there is a second one at -z
  double depth_scale = 1;     ///< thickness in z over thickness in the plane (lambda)

  bool operator==(const CreaturePart&) const = default;
};

/// All parts, parents first.
struct Creature {
  std::vector<CreaturePart> parts;

  bool operator==(const Creature&) const = default;
};

struct PlaceInDepthOptions {
  double embed_min =
      0.35;  ///< smallest share s of a limb's radius that its axis lies inside its parent's surface
  double embed_max = 1.0;  ///< largest share s: the paper's, the limb's top is flush with the flank
  double pair_gap = 0.3;   ///< least distance between the two limbs of a pair, in limb radii
  double torso_depth = 1.0;  ///< depth_scale of the body
  double flat_depth = 0.35;  ///< depth_scale of parts that are flat (DepthNode::flat)

  bool operator==(const PlaceInDepthOptions&) const = default;
};

/// Cuts the skeletons into chains and finds the depth of every part; parts come in the order of the
/// graph.
///
/// The body and sagittal parts lie in the plane z = 0. A foreground part's depth is that of its top
/// disc (where its completion inside the parent is): the parent's surface above it, less the share
/// s of its radius along the surface's normal. s is the largest in [embed_min, embed_max] that
/// keeps the part, where it is clear of the parent's outline, pair_gap / 2 of its radius away from
/// the sagittal plane; when none does, the part moves out further, while one of its discs still
/// reaches half of its radius into the parent. Islands lie 0.4 radii under the surface. What sits
/// on a part out of the plane has the depth of its parent, and its mirror image. Radii are the
/// skeleton's; edges longer than their mean radius get vertices in between.
///
/// Notes: "pair-close" for a limb that had to move out. Warnings: "part-loose" for a part that
/// reaches into its parent at no depth. Cost: less than 1 ms.
Outcome<Creature> PlaceInDepth(const Parts& parts, const DepthGraph& graph,
                               const std::vector<Skeleton>& skeletons,
                               const PlaceInDepthOptions& options = {});

/// Takes sketch coordinates to the model's: x right and y up as drawn, millimetres.
struct ModelFrame {
  double scale = 1;                                 ///< millimetres a sketch unit
  Eigen::Vector2d shift = Eigen::Vector2d::Zero();  ///< model = (scale x, -scale y) + shift

  Eigen::Vector2d ToModel(const Eigen::Vector2d& sketch) const {
    return Eigen::Vector2d(scale * sketch.x(), -scale * sketch.y()) + shift;
  }
  Eigen::Vector2d ToSketch(const Eigen::Vector2d& model) const {
    const Eigen::Vector2d d = model - shift;
    return {d.x() / scale, -d.y() / scale};
  }
  bool operator==(const ModelFrame&) const = default;
};

/// The frame in which the outlines of the parts that are built are `size` millimetres along their
/// longest side, centred in x and standing on y = 0 (provisional: the mesh's lowest vertex decides
/// in the end).
ModelFrame FrameOf(const Parts& parts, const DepthGraph& graph, double size);

/// The field of the creature in model units: each chain one integral, capped at its ends so that it
/// ends in a half ball (a chain of one vertex is a ball); mirrored parts twice, at z and -z, each
/// blending with its parent's image on the same side. Chains of a part blend by Ricci with exponent
/// 4, parts with their parents with `blend_exponent`.
Field MakeField(const Creature& creature, const ModelFrame& frame, double blend_exponent = 4);

}  // namespace lascaux
