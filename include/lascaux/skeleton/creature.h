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

/// How a part lies in depth near a place of its plane. Between stations the depths and the
/// logarithms of the scales that they say are averaged, each with the weight (1 + d^2 / reach^2)^-3
/// at the distance d.
struct DepthStation {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  double reach = 1;                                 ///< sketch units, > 0
  double z = 0;                                     ///< of the part's middle, towards the viewer
  double scale = 1;                                 ///< thickness in z over thickness in the plane
  Eigen::Vector2d tilt = Eigen::Vector2d::Zero();   ///< change of z by place
  Eigen::Vector2d belly = Eigen::Vector2d::Zero();  ///< towards the belly, 1 / its distance
  double fuller = 1;                                ///< factor of the scale at the belly

  bool operator==(const DepthStation&) const = default;
};

/// One part, ready to become a field.
struct CreaturePart {
  int part = 0;               ///< index in Parts::parts
  std::vector<Chain> chains;  ///< longest first; each reproduces its own discs
  std::optional<int> parent;  ///< index in Creature::parts of the part that it blends with
  double z = 0;               ///< depth of the drawn side, towards the viewer, in sketch units; of
                              ///< its free end where it varies
  bool mirrored = false;      ///< there is a second one at -z
  double depth_scale = 1;     ///< thickness in z over thickness in the plane (lambda)
  std::vector<DepthStation> stations = {};  ///< z and depth_scale from place to place; or none
  std::vector<Chain> axis = {};  ///< the chains before the fit: discs that touch the outline, and
                                 ///< shoulders

  bool operator==(const CreaturePart&) const = default;
};

/// All parts, parents first.
struct Creature {
  std::vector<CreaturePart> parts;

  bool operator==(const Creature&) const = default;
};

/// The skeletons cut into chains, parts in the order of the graph, all in the plane z = 0. Radii
/// are the skeletons'; edges longer than their mean radius get vertices in between.
Creature AssembleCreature(const DepthGraph& graph, const std::vector<Skeleton>& skeletons);

struct PlaceInDepthOptions {
  double torso_depth = 1.0;  ///< thickness of the body in z over its height
  double belly = 1.25;       ///< at its belly, as a factor on that
  double limb_depth = 1.0;   ///< thickness of a limb's free end in z over its width
  double embed = 0.25;  ///< how deep a limb's middle lies under its parent's surface, in its radii
  double relief = 0.3;  ///< how far it stands out of that surface, in its radii
  double pair_gap = 0.3;     ///< least distance between the two limbs of a pair, in their radii
  double flat_depth = 0.35;  ///< thickness in z over width of parts that are flat (DepthNode::flat)

  bool operator==(const PlaceInDepthOptions&) const = default;
};

/// Finds the depth of every part of a creature, after the fit: sizes are measured on the axes, and
/// the parts are put on each other's surfaces as the fit left them. Nothing of it changes the view
/// from the side (field/depth_map.h).
///
/// The body and sagittal parts lie in the plane z = 0. The body's sections are torso_depth times as
/// deep as they are tall, fuller below the middle; where it rises over its back for a short stretch
/// (a hump, a fin), its depth doesn't follow.
///
/// A limb over its parent has its root in the parent's surface, at the disc nearest its completion
/// there, and is flattened where it lies on the parent. A hanging one (a leg, an arm) is tilted
/// there as the surface is, so that it stands out of it along both of its sides, and its end goes
/// under the surface. It goes out to where its outer face is flush with the deepest place of the
/// parent near it, and on straight; where its root would be nearer to the plane, as at the line of
/// the belly, all of it is straight and goes up to that place by a chain of discs more (a
/// shoulder), which the parent's outline hides. A rising one (an ear, a horn, a wing) leans out
/// along the parent's normal, by 35 degrees at most and less where it is long and slender, and is
/// the flatter the shorter it is for its width; one that ends on its parent lies on it. Where a
/// limb is clear of its parent's outline, its middle keeps (1 + pair_gap / 2) times its radius in z
/// from the sagittal plane; if it has to, by moving out further, as far as its parent's deepest
/// place. Islands are lenses in the surface. What sits on a part out of the plane has its parent's
/// depths and its mirror image.
///
/// Between the discs of a chain, and beyond its ends, depths go on as they change along it.
///
/// Parts that are said to be flat are at most flat_depth times as deep as wide.
///
/// Notes: "pair-close" for a limb that had to move out. Warnings: "part-loose" for a part that
/// reaches into its parent at no depth. Errors: "bad-primitive", as of FitToDrawing(). Cost: about
/// 1 ms.
Outcome<Creature> PlaceInDepth(const Parts& parts, const DepthGraph& graph, Creature creature,
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
