#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lascaux/base/execution.h"
#include "lascaux/base/outcome.h"
#include "lascaux/sketch/planar_map.h"

/// @file
/// Structural parts: the closed outlines that the drawing's cycles, suggestive curves and
/// completions make.
///
/// Source: Entem et al. 2015, sections 4.1 and 4.2.

namespace lascaux {

/// Where a piece of an outline comes from: drawn and visible, invented to close the part, or shared
/// with another part (a fit has to follow the first kind alone).
enum class OutlineKind : std::uint8_t { kDrawn, kCompletion, kShared };

/// A closed ring in sketch units; the last point is joined to the first, no point is repeated.
///
/// `kinds[i]` belongs to the piece from `points[i]` to the next point. Positive area in the sketch
/// frame's own (x right, y down) shoelace formula, that is, clockwise as seen on the page.
struct Outline {
  std::vector<Eigen::Vector2d> points;
  std::vector<OutlineKind> kinds;

  bool operator==(const Outline&) const = default;
};

/// How a limb was cut from its parent: two suggestive curves, or one and a partner that was
/// inferred, or a neck, or a far side that is drawn beside it, or somebody said so.
enum class LimbEvidence : std::uint8_t { kTwoCurves, kOneCurve, kNeck, kFarSide, kOverride };

/// A limb that its far side shows is at most so unlike it (docs/structure.md): its energy.
constexpr double kMostUnlikeFarSide = 1.4;

/// The place where a limb grows out of its parent.
struct LimbRoot {
  std::array<Eigen::Vector2d, 2>
      closed;  ///< closed ends: where the suggestive curves leave the parent's outline
  std::array<Eigen::Vector2d, 2> open;  ///< open ends, same order
  std::vector<Eigen::Vector2d>
      closed_completion;  ///< parent's outline under the limb, closed[0] to closed[1]
  std::vector<Eigen::Vector2d>
      open_completion;  ///< limb's outline inside the parent, open[0] to open[1]
  LimbEvidence evidence = LimbEvidence::kTwoCurves;
  double energy = 0;  ///< pairing energy, scale free; small is good

  bool operator==(const LimbRoot&) const = default;
};

/// What kind of cycle a part comes from, before anything is known about depth.
enum class PartKind : std::uint8_t {
  kBorder,  ///< a cycle with an edge on the outside, after the limbs over it were cut off
  kLimb,    ///< cut from `over` along suggestive curves
  kIsland,  ///< a closed curve that touches nothing
  kInner,   ///< an enclosed cycle that is no island: merged, ignored or kept by the depth stage
};

/// One structural part. Its index in Parts::parts is its id everywhere after.
struct Part {
  PartKind kind = PartKind::kBorder;
  Outline outline;                 ///< completed where the drawing leaves it open
  std::optional<int> over;         ///< for limbs: the part that it was cut from and lies over
  std::optional<LimbRoot> root;    ///< for limbs
  std::optional<int> far_side_of;  ///< for a leg that shows beside this limb in one outline
  /// For these and for limbs how well the evidence bears them out, 0 to 1: the least clearance of
  /// all that had to hold, as a share of the larger of measure and limit. 0: just so.
  double score = 0;
  std::vector<int>
      cycles;  ///< cycles of the planar map that it covers (a limb: the one it was cut from)
  /// Half-edges of the planar map on its outline, in order: one list for each stretch between
  /// completions.
  std::vector<std::vector<int>> stretches;
  std::vector<int> strokes;  ///< strokes that bound it, ascending

  bool operator==(const Part&) const = default;
};

/// All parts of a drawing.
struct Parts {
  std::vector<Part> parts;

  bool operator==(const Parts&) const = default;
};

/// How to read suggestive curves. Lengths are relative to the diagonal of the drawing.
struct FindPartsOptions {
  /// What it costs, in units of the scale-free energy, to leave a suggestive curve without a
  /// partner.
  double single_cost = 1.5;
  /// Limbs to cut off where the rules find none: for each the two ends of its root, on (or within
  /// 2 % of) the outline of one face. The side with the smaller area is the limb.
  std::vector<std::array<Eigen::Vector2d, 2>> cuts;

  bool operator==(const FindPartsOptions&) const = default;
};

/// Cuts the cycles of `map` into structural parts: every border cycle, less its limbs, then the
/// limbs cut from it, parents before children; then islands, and enclosed cells.
///
/// A limb is a stretch of outline between two suggestive curves (paired by least total energy over
/// the whole cycle), between one and the contour, a bump beside a cell that is its far side, or a
/// lobe of the contour that comes down to the ground (docs/structure.md). A limb that crosses one
/// of options.cuts gives way to it. Every map gives parts; the only error is "override-not-there"
/// (understanding), with its place: one of options.cuts that no face can be cut by.
Outcome<Parts> FindParts(const PlanarMap& map, const FindPartsOptions& options = {},
                         const Execution& execution = {});

/// "two-curves", "one-curve", "neck", "far-side", "override".
const char* Name(LimbEvidence evidence) noexcept;

/// Signed area of a ring (shoelace in the sketch frame), positive for an Outline.
double SignedArea(const std::vector<Eigen::Vector2d>& ring);

/// True when `point` lies inside the ring (even-odd rule).
bool Contains(const std::vector<Eigen::Vector2d>& ring, const Eigen::Vector2d& point);

}  // namespace lascaux
