#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "sketch/map/heights.h"
#include "sketch/parts/completion.h"
#include "sketch/parts/evidence.h"
#include "sketch/parts/limb_cut.h"

namespace lascaux {
namespace {

using Eigen::Vector2d;

/// A lone curve speaks for a limb if it is at least this long (share of the diagonal) ...
constexpr double kShortestAlone = 0.02;
/// ... and its limb's edge runs on from it this straight.
constexpr double kStraightOn = std::numbers::pi / 4;
/// ... or, if nothing that it runs straight on from is a limb, turns into it at most so far: the
/// belly's line that ends on the leg.
constexpr double kTurnsInto = std::numbers::pi / 3;
/// The limb reaches at least this many times the width of its root away from it.
constexpr double kLeastReach = 1.2;
/// The contour is the limb's other flank if it leaves its closed end within this angle of the drawn
/// curve's direction.
constexpr double kAlong = std::numbers::pi / 3.6;
/// Width of the root, share of the diagonal: below it is a hair, above it is half the animal.
constexpr double kLeastWidth = 0.015, kMostWidth = 0.26;
/// How much wider than at its narrowest the root may be at a corner or junction that is taken for
/// its end.
constexpr double kFeatureSlack = 1.15;
/// One curve alone is weak evidence: only of legs is it common. A leg reaches the lowest part of
/// the drawing, this share of its height.
constexpr double kGround = 0.35;
/// Share of the face: more is the animal, not its limb.
constexpr double kMostShare = 0.25;
/// From the middle of its root the limb reaches so many times its root's width: less is a bulge,
/// more a tail.
constexpr double kLeastTip = 0.8, kMostTip = 5.0;
/// An ear is at most this share of the face, and points up (sine of the angle).
constexpr double kMostEar = 0.08, kUpright = 0.5;
/// A curve that leaves the contour this near to the second closed end, in widths of the root, is
/// the other flank.
constexpr double kSamePlace = 0.25;
/// Steps of the search along the contour, share of the diagonal.
constexpr double kStep = 2.5e-3;
/// Turn of the contour that counts as a corner.
constexpr double kCorner = std::numbers::pi / 6;

/// The contour seen from a closed end: `sign` +1 walks ahead, -1 back.
struct Walker {
  const FaceView& face;
  double start = 0;
  int sign = 1;
  double limit = 0;  ///< how far it may go without meeting another limb

  Vector2d At(double s) const { return face.line.At(start + sign * s); }
};

/// How far the walk may go from `start` before it meets a closed end of a limb that it would have
/// to cross. Limbs that lie wholly on the way are stepped over by the caller's geometry: they end
/// where they begin.
double FreeWay(const FaceView& face, const Pairing& pairing, double start, int sign) {
  double limit = 0.75 * face.line.length;
  for (const LimbCut& limb : pairing.limbs) {
    const double enter =
        sign > 0 ? face.line.Ahead(start, limb.from) : face.line.Ahead(limb.to, start);
    const double leave =
        sign > 0 ? face.line.Ahead(start, limb.to) : face.line.Ahead(limb.from, start);
    // Starting inside another limb's stretch: stay in it. Else: stop where the other begins.
    limit = std::min(limit, std::min(enter, leave));
  }
  return limit;
}

/// The place beyond the tip where the contour comes nearest to the closed end.
std::optional<double> NearestBeyondTip(const Walker& walker, double step) {
  const Vector2d origin = walker.At(0);
  double farthest = 0, nearest = 0;
  std::optional<double> place;
  for (double s = step; s < walker.limit; s += step) {
    const double d = (walker.At(s) - origin).norm();
    if (d > farthest && !(place && nearest < farthest / kLeastReach)) {
      farthest = d;
      place.reset();
      continue;
    }
    if (!place || d < nearest) {
      place = s;
      nearest = d;
    } else if (d > 1.6 * nearest && nearest < farthest / kLeastReach) {
      break;  // past the waist: what comes now belongs to the parent
    }
  }
  if (!place || nearest > farthest / kLeastReach) return std::nullopt;
  return place;
}

/// A corner or a junction of the contour near the narrowest place, if there is one.
double MovedToFeature(const Walker& walker, double place, double step) {
  const Vector2d origin = walker.At(0);
  const double width = (walker.At(place) - origin).norm(), reach = TangentReach(walker.face.map);
  double best = place, sharpest = kCorner;
  for (double s = std::max(step, place - width); s < std::min(walker.limit, place + width);
       s += step) {
    if ((walker.At(s) - origin).norm() > kFeatureSlack * width) continue;
    const Vector2d before = walker.At(s) - walker.At(s - reach),
                   after = walker.At(s + reach) - walker.At(s);
    const double turn = AngleBetween(before, after);
    if (turn > sharpest) {
      sharpest = turn;
      best = s;
    }
  }
  return best;
}

/// The stretch of contour from the closed end to `place`, as a limb: which way it points, where it
/// ends, how much of the face it is.
struct Protrusion {
  Vector2d tip;       ///< from the middle of its root
  double lowest = 0;  ///< y of its lowest point
  double share = 0;   ///< of the face's area
};

Protrusion ProtrusionOf(const Walker& walker, double place, double step) {
  Polyline own;
  for (double s = 0; s < place; s += step) own.push_back(walker.At(s));
  own.push_back(walker.At(place));
  const Vector2d root = 0.5 * (own.front() + own.back());
  Protrusion result{Vector2d::Zero(), -std::numeric_limits<double>::infinity(), 0};
  for (const Vector2d& p : own) {
    if ((p - root).squaredNorm() > result.tip.squaredNorm()) result.tip = p - root;
    result.lowest = std::max(result.lowest, p.y());
  }
  result.share = std::abs(SignedArea(own) / SignedArea(walker.face.line.points));
  return result;
}

/// A leg comes down to where the animal stands, an ear is small and stands up; neither is the
/// larger half of the animal. `width` is that of the root.
Evidence EvidenceOf(const FaceView& face, const Protrusion& limb, double width) {
  const Heights heights = HeightsOf(face.map);
  const double reach = limb.tip.norm(), diagonal = face.map.diagonal;
  const double leg =
      Evidence()
          .AtMost(heights.bottom - limb.lowest, kGround * (heights.bottom - heights.top))
          .Score();
  const double ear =
      Evidence().AtMost(limb.share, kMostEar).AtLeast(-limb.tip.y(), kUpright * reach).Score();
  return Evidence()
      .AtLeast(width, kLeastWidth * diagonal)
      .AtMost(width, kMostWidth * diagonal)
      .AtLeast(reach, kLeastTip * width)
      .AtMost(reach, kMostTip * width)
      .AtMost(limb.share, kMostShare)
      .And(std::max(leg, ear));
}

bool IsInsideFace(const FaceView& face, const Vector2d& a, const Vector2d& b) {
  for (const double share : {0.2, 0.35, 0.5, 0.65, 0.8}) {
    if (!Contains(face.line.points, a + share * (b - a))) return false;
  }
  return true;
}

/// The other flank, from its closed end, and whether it was drawn.
struct Flank {
  Polyline points;
  OutlineKind kind = OutlineKind::kDrawn;
};

/// The stretch of contour beyond the second closed end, as long as the drawn curve if there is
/// room.
Polyline ContourFlank(const Walker& walker, double place, double length) {
  const double step = kStep * walker.face.map.diagonal,
               flank = std::min(length, walker.limit - place);
  Polyline contour;
  for (double s = 0; s < flank; s += step) Append(contour, {walker.At(place + s)});
  Append(contour, {walker.At(place + flank)});
  return contour;
}

/// The drawn curve reflected so that its closed end falls on `closed`; its first part that stays
/// inside the face.
Polyline MirroredFlank(const FaceView& face, const Polyline& curve, const Vector2d& closed) {
  const Vector2d across = (closed - curve.front()).stableNormalized(),
                 middle = 0.5 * (closed + curve.front());
  Polyline mirrored;
  for (const Vector2d& p : curve) {
    const Vector2d q = p - 2 * (p - middle).dot(across) * across;
    if (!mirrored.empty() && !Contains(face.line.points, q)) break;
    Append(mirrored, {q});
  }
  return mirrored;
}

Flank OtherFlank(const Walker& walker, double place, const SuggestiveCurve& curve) {
  const Polyline contour = ContourFlank(walker, place, curve.length);
  const Polyline mirrored = MirroredFlank(walker.face, curve.points, contour.front());
  const Vector2d drawn = curve.points.back() - curve.points.front();
  const bool along = AngleBetween(contour.back() - contour.front(), drawn) < kAlong;
  // A mirror image that leaves the face at once leaves the contour as the only flank there is.
  if (along || Length(mirrored) < 0.3 * curve.length) return {contour, OutlineKind::kDrawn};
  return {mirrored, OutlineKind::kCompletion};
}

/// Another single curve whose closed end is that place, at most a quarter of the limb's width away:
/// the pairing left both alone, but the contour joins them.
std::optional<int> CurveAt(const FaceView& face, const Pairing& pairing, double arc, double width) {
  std::optional<int> best;
  double nearest = kSamePlace * width;
  for (const int i : pairing.single) {
    const double other = face.curves[static_cast<std::size_t>(i)].arc;
    const double apart = std::min(face.line.Ahead(arc, other), face.line.Ahead(other, arc));
    if (apart >= nearest) continue;
    nearest = apart;
    best = i;
  }
  return best;
}

std::optional<LimbCut> LimbTowards(const FaceView& face, const Pairing& pairing,
                                   const SuggestiveCurve& curve, int sign) {
  const double step = kStep * face.map.diagonal, start = curve.arc;
  const Walker walker{face, start, sign, FreeWay(face, pairing, start, sign)};
  const auto nearest = NearestBeyondTip(walker, step);
  if (!nearest) return std::nullopt;
  const double place = MovedToFeature(walker, *nearest, step);
  const Vector2d a = walker.At(0), b = walker.At(place);
  const double width = (b - a).norm();
  const Evidence evidence = EvidenceOf(face, ProtrusionOf(walker, place, step), width);
  if (!evidence.Holds() || !IsInsideFace(face, a, b)) return std::nullopt;
  double end = face.line.Wrap(start + sign * place);
  const auto partner = CurveAt(face, pairing, end, width);
  Flank flank;
  if (partner) {
    const SuggestiveCurve& other = face.curves[static_cast<std::size_t>(*partner)];
    end = other.arc;
    flank = {other.points, OutlineKind::kDrawn};
  } else {
    flank = OtherFlank(walker, place, curve);
  }
  const Vector2d tip = ArrivalDirection(flank.points, TangentReach(face.map));
  const double energy =
      Complete({curve.points.back(), curve.tip}, {flank.points.back(), tip}).energy;
  LimbCut limb{start,
               end,
               curve.points,
               std::move(flank.points),
               OutlineKind::kDrawn,
               flank.kind,
               partner ? LimbEvidence::kTwoCurves : LimbEvidence::kOneCurve,
               energy,
               evidence.Score()};
  if (sign < 0) {
    std::swap(limb.from, limb.to);
    std::swap(limb.from_curve, limb.to_curve);
    std::swap(limb.from_kind, limb.to_kind);
  }
  return limb;
}

/// The limb on the side whose contour runs on into the curve straighter, or the one on the other
/// side.
std::optional<LimbCut> LimbOf(const FaceView& face, const Pairing& pairing,
                              const SuggestiveCurve& curve) {
  if (curve.length < kShortestAlone * face.map.diagonal) return std::nullopt;
  const bool ahead = curve.turn_after < curve.turn_before;
  const int straight = ahead ? 1 : -1;
  const auto [small, large] = std::minmax(curve.turn_before, curve.turn_after);
  if (small > kStraightOn) return std::nullopt;
  if (auto limb = LimbTowards(face, pairing, curve, straight)) return limb;
  return large < kTurnsInto ? LimbTowards(face, pairing, curve, -straight) : std::nullopt;
}

}  // namespace

std::vector<LimbCut> OneCurveLimbs(const FaceView& face, const Pairing& pairing) {
  // Long curves first: they are the surer limbs, and each limb found is an obstacle for the next.
  std::vector<int> order = pairing.single;
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return face.curves[static_cast<std::size_t>(a)].length >
           face.curves[static_cast<std::size_t>(b)].length;
  });
  Pairing known = pairing;
  std::vector<LimbCut> found;
  for (const int i : order) {
    if (std::find(known.single.begin(), known.single.end(), i) == known.single.end()) continue;
    std::erase(known.single, i);
    const auto limb = LimbOf(face, known, face.curves[static_cast<std::size_t>(i)]);
    if (!limb) continue;
    found.push_back(*limb);
    known.limbs.push_back(*limb);
    if (limb->evidence == LimbEvidence::kTwoCurves) {
      std::erase_if(known.single, [&](int k) {
        const double arc = face.curves[static_cast<std::size_t>(k)].arc;
        return arc == limb->from || arc == limb->to;
      });
    }
  }
  return found;
}

}  // namespace lascaux
