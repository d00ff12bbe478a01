#include <algorithm>
#include <array>

#include "sketch/parts/limb_cut.h"

namespace lascaux {
namespace {

using Eigen::Vector2d;

/// The limb runs on into its parent by this share of its width.
constexpr double kRootDepth = 0.7;
/// Ends of a cut that somebody asked for lie this near to the outline, share of the diagonal.
constexpr double kOnOutline = 0.02;

/// A flank of the root: from a closed end on into the parent, straight and deep or, where that
/// leaves the face, towards the root's axis and shorter.
Polyline RootFlank(const FaceView& face, const Vector2d& closed, const Vector2d& root,
                   const Vector2d& inwards) {
  for (const double depth : {1.0, 0.6, 0.3}) {
    for (const double taper : {0.1, 0.4, 0.7}) {
      const Vector2d way = depth * inwards + taper * (root - closed);
      const auto is_inside = [&](double share) {
        return Contains(face.line.points, closed + share * way);
      };
      if (is_inside(0.25) && is_inside(0.5) && is_inside(0.75) && is_inside(1.0))
        return {closed, closed + 0.5 * way, closed + way};
    }
  }
  return {};
}

}  // namespace

std::optional<LimbCut> CutAcross(const FaceView& face, double from, double to) {
  const Polyline own = Stretch(face.line, from, to).points;
  const Vector2d a = own.front(), b = own.back(), root = 0.5 * (a + b);
  const Vector2d tip =
      *std::max_element(own.begin(), own.end(), [&](const Vector2d& p, const Vector2d& q) {
        return (p - root).squaredNorm() < (q - root).squaredNorm();
      });
  const Vector2d inwards = kRootDepth * (b - a).norm() * (root - tip).stableNormalized();
  LimbCut limb;
  limb.from = from;
  limb.to = to;
  limb.from_curve = RootFlank(face, a, root, inwards);
  limb.to_curve = RootFlank(face, b, root, inwards);
  limb.from_kind = limb.to_kind = OutlineKind::kCompletion;
  if (limb.from_curve.empty() || limb.to_curve.empty()) return std::nullopt;
  return limb;
}

std::optional<LimbCut> CutAsAsked(const FaceView& face, const std::array<Vector2d, 2>& ends) {
  const auto [from, from_distance] = NearestPlace(face.line, ends[0]);
  const auto [to, to_distance] = NearestPlace(face.line, ends[1]);
  if (std::max(from_distance, to_distance) > kOnOutline * face.map.diagonal || from == to)
    return std::nullopt;
  const bool ahead = std::abs(SignedArea(Stretch(face.line, from, to).points)) <=
                     std::abs(SignedArea(Stretch(face.line, to, from).points));
  auto limb = ahead ? CutAcross(face, from, to) : CutAcross(face, to, from);
  if (limb) limb->evidence = LimbEvidence::kOverride;
  return limb;
}

}  // namespace lascaux
