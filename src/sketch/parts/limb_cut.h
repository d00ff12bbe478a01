#pragma once

#include <array>
#include <optional>
#include <vector>

#include "lascaux/sketch/parts.h"
#include "sketch/parts/boundary_line.h"

/// @file
/// How limbs are cut from a face: which stretch of its boundary is a limb, and by which curves it
/// ends.

namespace lascaux {

/// A limb on a boundary: it owns the walk from `from` to `to`.
struct LimbCut {
  double from = 0, to = 0;  ///< places of the closed ends on the BoundaryLine
  Polyline from_curve,
      to_curve;  ///< closed end to open end; an inferred one is contour or a mirror image
  OutlineKind from_kind = OutlineKind::kDrawn, to_kind = OutlineKind::kDrawn;
  LimbEvidence evidence = LimbEvidence::kTwoCurves;
  double energy = 0;
  double score = 1;  ///< as Part::score
  int far_of = -1;   ///< index, among the cuts of the face, of the limb whose far side it is
};

/// Everything that the rules look at, for one face.
struct FaceView {
  const PlanarMap& map;
  const BoundaryLine& line;
  const std::vector<SuggestiveCurve>& curves;
};

/// Pairs of suggestive curves, by the assignment of least total energy over the whole face (§4.2,
/// eq. 2).
///
/// For curves i and j and both ways to connect their closed ends, E = p_i p_j (E_o + E_c): E_o and
/// E_c are the energies of the completions of the open and of the closed ends, p = min(alpha /
/// beta, 1) kept above 0.05, alpha the angle between the direction in which the outer edge arrives
/// at a closed end and the chord to the other one, beta the angle between that direction and the
/// suggestive curve. A curve may stay single for options.single_cost. Curves that the outline runs
/// past smoothly (a mouth, a wrinkle) take no part. Limbs never cross; they may nest. O(n^3) in the
/// curves of the face.
struct Pairing {
  std::vector<LimbCut> limbs;
  std::vector<int> single;  ///< curves left over that could be one side of a limb, as indices in
                            ///< FaceView::curves
};
Pairing PairCurves(const FaceView& face, const FindPartsOptions& options);

/// Limbs with one suggestive curve: the other side is the contour. The second closed end is the
/// place beyond the limb's tip that is nearest to the first, moved to a corner or a junction close
/// by. From there the flank follows the contour, if that runs along with the drawn curve (a thigh's
/// rump); else it is the drawn curve's mirror image.
std::vector<LimbCut> OneCurveLimbs(const FaceView& face, const Pairing& pairing);

/// Limbs that no suggestive curve shows, but their far side does: a cell behind the face, and
/// beside it a bump of the contour that is as long and points the same way. It is cut across its
/// narrowest place. `known` limbs are left alone, and so are cells that touch one. O(n) in the
/// points of the boundary for each cell.
std::vector<LimbCut> LimbsBesideCells(const FaceView& face, const std::vector<LimbCut>& known);

/// Legs without any suggestive curve: lobes of the contour that hang down to the ground, parted
/// from the rest where the contour comes nearest to a crotch, as long as they and the standing ones
/// among `limbs` are no more than an animal has. Of two side by side the lower one is the near one,
/// the other its far side (`far_of` counts among what is returned). That a part ends at the
/// shortest line from a crotch is Singh, Seyranian and Hoffman's rule (1999).
std::vector<LimbCut> NeckLimbs(const FaceView& face, const std::vector<LimbCut>& limbs);

/// The limb that owns the walk from one place to another, its flanks carried on into the parent;
/// none if the face leaves no room for them.
std::optional<LimbCut> CutAcross(const FaceView& face, double from, double to);

/// The limb that somebody asked for by the ends of its root; none if they do not lie on this face's
/// outline.
std::optional<LimbCut> CutAsAsked(const FaceView& face, const std::array<Eigen::Vector2d, 2>& ends);

/// The parts of one face: first what is left of the face itself, then its limbs, parents before
/// children. `first_id` is the id that the first of them will have.
std::vector<Part> CutFace(const FaceView& face, int cycle, const std::vector<LimbCut>& limbs,
                          int first_id);

}  // namespace lascaux
