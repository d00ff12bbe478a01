#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "sketch/map/heights.h"
#include "sketch/parts/evidence.h"
#include "sketch/parts/limb_cut.h"

namespace lascaux {
namespace {

using Eigen::Vector2d;

/// Steps along the contour, share of the diagonal.
constexpr double kStep = 5e-3;
/// A contour that is longer than this many steps is fur: it is sampled more coarsely, to save time.
constexpr int kMostSamples = 3000;
/// A crotch turns into the animal by at least this much.
constexpr double kCrotch = 25 * std::numbers::pi / 180;
/// Width of a leg's root, share of the diagonal: below it is a hair, above it half the animal.
constexpr double kLeastWidth = 8e-3, kMostWidth = 0.25;
/// The contour goes at least this many times as far from a crotch as the way back to it across the
/// leg; a leg has at most this share of the face's area.
constexpr double kLeastReach = 1.05, kMostArea = 0.15;
/// Shorter lobes, as a share of the diagonal, are toes.
constexpr double kLeastLength = 0.06;
/// It stands in the lowest part of the drawing, this share of its height.
constexpr double kGround = 0.15;
/// Past the narrowest place the contour has to widen by this much, or the neck is none.
constexpr double kWidening = 1.25;
/// Legs whose roots are nearer to each other than this share of the animal's width are the two of a
/// pair.
constexpr double kSamePair = 0.2;
/// Pairs of legs that an animal stands on: what hangs down besides is a trunk, a beard, a tail.
constexpr std::size_t kPairs = 2;
/// How far a leg without any line on the flank reaches up into it, in widths of its root.
constexpr double kTop = 0.6;

/// The contour of a face, evenly sampled.
struct Contour {
  const FaceView& face;
  double step = 0, width = 0;
  int size = 0;
  std::vector<Vector2d> points;

  const Vector2d& At(int i) const {
    return points[static_cast<std::size_t>(((i % size) + size) % size)];
  }
};

/// A stretch of the contour that a neck parts from the rest: samples `from` to `to`, which may
/// exceed the contour's size.
struct Lobe {
  int from = 0, to = 0;
  double width = 0, length = 0;
  Vector2d root, tip;
  double score = 0;  ///< how much like a leg it is (Evidence)
};

Contour Sampled(const FaceView& face) {
  Contour contour{face, 0, 0, 0, {}};
  contour.size = std::clamp(
      static_cast<int>(std::ceil(face.line.length / (kStep * face.map.diagonal))), 8, kMostSamples);
  contour.step = face.line.length / contour.size;
  for (int i = 0; i < contour.size; ++i) contour.points.push_back(face.line.At(i * contour.step));
  const auto [left, right] =
      std::minmax_element(contour.points.begin(), contour.points.end(),
                          [](const Vector2d& a, const Vector2d& b) { return a.x() < b.x(); });
  contour.width = right->x() - left->x();
  return contour;
}

/// Turn of the contour at a sample, over `reach` samples to both sides; negative where it turns
/// into the animal.
double TurnAt(const Contour& contour, int i, int reach) {
  const Vector2d before = contour.At(i) - contour.At(i - reach),
                 after = contour.At(i + reach) - contour.At(i);
  return std::atan2(Cross(before, after), before.dot(after));
}

/// Places that turn into the animal most within `reach` samples.
std::vector<int> Crotches(const Contour& contour, int reach) {
  std::vector<double> turns;
  for (int i = 0; i < contour.size; ++i) turns.push_back(TurnAt(contour, i, reach));
  const auto turn = [&](int i) {
    return turns[static_cast<std::size_t>(((i % contour.size) + contour.size) % contour.size)];
  };
  std::vector<int> crotches;
  for (int i = 0; i < contour.size; ++i) {
    bool sharpest = turn(i) < -kCrotch;
    for (int k = 1; k <= reach && sharpest; ++k)
      sharpest = turn(i) < turn(i - k) && turn(i) <= turn(i + k);
    if (sharpest) crotches.push_back(i);
  }
  return crotches;
}

/// The sample, walking from a crotch one way, at which the contour comes back nearest to it before
/// it goes off into the rest of the animal.
std::optional<int> Opposite(const Contour& contour, int crotch, int way) {
  const Vector2d& origin = contour.At(crotch);
  double farthest = 0, nearest = 0;
  int place = 0;  // steps to the nearest so far; none yet
  for (int k = 1; k < 3 * contour.size / 4; ++k) {
    const double d = (contour.At(crotch + way * k) - origin).norm();
    if (place == 0 && d >= farthest) {
      farthest = d;
    } else if (place == 0 || d < nearest) {
      place = k;
      nearest = d;
    } else if (d > kWidening * nearest && nearest < farthest / kLeastReach) {
      return crotch + way * place;
    } else if (d > farthest) {
      // The waist was none: the way leads on outward.
      farthest = d;
      place = 0;
    }
  }
  return std::nullopt;
}

double AreaOf(const Contour& contour, const Lobe& lobe) {
  double twice = 0;
  const Vector2d& origin = contour.At(lobe.from);
  for (int i = lobe.from; i < lobe.to; ++i)
    twice += Cross(contour.At(i) - origin, contour.At(i + 1) - origin);
  return 0.5 * twice;
}

bool ChordIsInside(const FaceView& face, const Vector2d& a, const Vector2d& b) {
  for (const double share : {0.1, 0.3, 0.5, 0.7, 0.9}) {
    if (!Contains(face.line.points, a + share * (b - a))) return false;
  }
  return true;
}

/// How plainly a leg has to show.
struct Plainness {
  double reach;  ///< way over which a crotch turns, share of the diagonal
  double swing;  ///< angle between leg and vertical
  double least;  ///< length to the corner of its foot, in widths of its root
};

constexpr double kDegree = std::numbers::pi / 180;
/// Sharp crotches and legs that point down and are longer than wide; only an animal without any
/// such leg has them stand forward, and if there are none either, stout ones between rounded
/// crotches.
constexpr std::array kPlainness = {Plainness{0.02, 50 * kDegree, 1.05},
                                   Plainness{0.02, 75 * kDegree, 1.05},
                                   Plainness{0.04, 75 * kDegree, 0.85}};

/// How much like a leg a lobe is that points down within `swing` (Evidence).
double LegScore(const Contour& contour, const Lobe& lobe, const Heights& heights,
                const Plainness& plain) {
  const double diagonal = contour.face.map.diagonal, area = AreaOf(contour, lobe);
  const double score =
      Evidence()
          .AtLeast(lobe.width, kLeastWidth * diagonal)
          .AtMost(lobe.width, kMostWidth * diagonal)
          .AtLeast(lobe.length, plain.least * lobe.width)
          .AtLeast(lobe.length, kLeastLength * diagonal)
          .AtMost(heights.bottom - lobe.tip.y(), kGround * (heights.bottom - heights.top))
          .AtMost(AngleBetween(lobe.tip - lobe.root, {0, 1}), plain.swing)
          .AtMost(area, kMostArea * SignedArea(contour.face.line.points))
          .Score();
  if (score < 0 || area <= 0) return -1;
  return ChordIsInside(contour.face, contour.At(lobe.from), contour.At(lobe.to)) ? score : -1;
}

Lobe LobeBetween(const Contour& contour, int from, int to) {
  Lobe lobe{from,
            to,
            (contour.At(to) - contour.At(from)).norm(),
            0,
            0.5 * (contour.At(from) + contour.At(to)),
            contour.At(from),
            0};
  for (int i = from; i <= to; ++i) {
    const double d = (contour.At(i) - lobe.root).norm();
    if (d <= lobe.length) continue;
    lobe.length = d;
    lobe.tip = contour.At(i);
  }
  return lobe;
}

bool Overlap(const Contour& contour, const Lobe& a, const Lobe& b) {
  const auto holds = [&](const Lobe& lobe, int i) {
    return ((i - lobe.from) % contour.size + contour.size) % contour.size < lobe.to - lobe.from;
  };
  return holds(a, b.from) || holds(b, a.from);
}

/// The legs of the contour, in its order.
std::vector<Lobe> FindLegs(const Contour& contour, const Plainness& plainness) {
  const Heights heights = HeightsOf(contour.face.map);
  const int reach = static_cast<int>(std::lround(plainness.reach / kStep));
  std::vector<Lobe> found;
  for (const int crotch : Crotches(contour, reach)) {
    for (const int way : {1, -1}) {
      const auto opposite = Opposite(contour, crotch, way);
      if (!opposite) continue;
      Lobe lobe = way > 0 ? LobeBetween(contour, crotch, *opposite)
                          : LobeBetween(contour, *opposite, crotch);
      lobe.score = LegScore(contour, lobe, heights, plainness);
      if (lobe.score >= 0) found.push_back(lobe);
    }
  }
  // Of two cuts through one leg the one that parts more of it at a narrower place.
  std::stable_sort(found.begin(), found.end(), [](const Lobe& a, const Lobe& b) {
    return a.length * a.length / a.width > b.length * b.length / b.width;
  });
  std::vector<Lobe> legs;
  for (const Lobe& lobe : found) {
    const bool taken = std::any_of(
        legs.begin(), legs.end(), [&](const Lobe& other) { return Overlap(contour, lobe, other); });
    if (!taken) legs.push_back(lobe);
  }
  std::stable_sort(legs.begin(), legs.end(),
                   [](const Lobe& a, const Lobe& b) { return a.from < b.from; });
  return legs;
}

/// A line from a closed end up into the animal: `up` as far as there is room.
Polyline Upward(const FaceView& face, const Vector2d& closed, const Vector2d& up) {
  double share = 1;
  while (share > 0.2 && !ChordIsInside(face, closed, closed + share * up)) share *= 0.8;
  return {closed, closed + share * up};
}

LimbCut CutAt(const Contour& contour, const Lobe& leg) {
  const FaceView& face = contour.face;
  const Vector2d up = kTop * leg.width * (leg.root - leg.tip).stableNormalized();
  LimbCut cut;
  cut.from = face.line.Wrap(leg.from * contour.step);
  cut.to = face.line.Wrap(leg.to * contour.step);
  cut.from_curve = Upward(face, face.line.At(cut.from), up);
  cut.to_curve = Upward(face, face.line.At(cut.to), up);
  cut.from_kind = cut.to_kind = OutlineKind::kCompletion;
  cut.evidence = LimbEvidence::kNeck;
  cut.score = leg.score;
  return cut;
}

/// Two lobes nearer to each other than legs of different pairs are.
bool AreOnePair(const Contour& contour, const Lobe& a, const Lobe& b) {
  return (a.root - b.root).norm() < kSamePair * contour.width;
}

/// Legs that stand side by side, by their indices in ascending order.
std::vector<std::vector<std::size_t>> Groups(const Contour& contour,
                                             const std::vector<Lobe>& legs) {
  std::vector<std::vector<std::size_t>> groups;
  for (std::size_t i = 0; i < legs.size(); ++i) {
    if (i > 0 && AreOnePair(contour, legs[i - 1], legs[i])) {
      groups.back().push_back(i);
    } else {
      groups.push_back({i});
    }
  }
  const bool around = groups.size() > 1 && AreOnePair(contour, legs.back(), legs.front());
  if (around) {
    groups.front().insert(groups.front().end(), groups.back().begin(), groups.back().end());
    groups.pop_back();
  }
  return groups;
}

/// Known limbs that stand on the ground.
std::size_t StandingLimbs(const FaceView& face, const std::vector<LimbCut>& limbs) {
  const Heights heights = HeightsOf(face.map);
  const double ground = heights.bottom - kGround * (heights.bottom - heights.top);
  return static_cast<std::size_t>(
      std::count_if(limbs.begin(), limbs.end(), [&](const LimbCut& limb) {
        const double own = face.line.Ahead(limb.from, limb.to), step = kStep * face.map.diagonal;
        for (double s = 0; s < own; s += step) {
          if (face.line.At(limb.from + s).y() > ground) return true;
        }
        return false;
      }));
}

bool IsFree(const FaceView& face, const LimbCut& cut, const std::vector<LimbCut>& limbs) {
  const double own = face.line.Ahead(cut.from, cut.to);
  return std::none_of(limbs.begin(), limbs.end(), [&](const LimbCut& limb) {
    return face.line.Ahead(cut.from, limb.from) < own ||
           face.line.Ahead(limb.from, cut.from) < face.line.Ahead(limb.from, limb.to);
  });
}

/// Free legs, in the contour's order: as plain ones as there are. None are enough if some of
/// `limbs` stand.
std::vector<Lobe> FreeLegs(const Contour& contour, const std::vector<LimbCut>& limbs,
                           std::size_t standing) {
  std::vector<Lobe> legs;
  for (const Plainness& plainness : kPlainness) {
    legs = FindLegs(contour, plainness);
    std::erase_if(
        legs, [&](const Lobe& leg) { return !IsFree(contour.face, CutAt(contour, leg), limbs); });
    if (standing > 0 || !legs.empty()) break;
  }
  return legs;
}

}  // namespace

std::vector<LimbCut> NeckLimbs(const FaceView& face, const std::vector<LimbCut>& limbs) {
  const std::size_t standing = StandingLimbs(face, limbs);
  if (standing >= kPairs) return {};
  const Contour contour = Sampled(face);
  const std::vector<Lobe> legs = FreeLegs(contour, limbs, standing);
  std::vector<std::vector<std::size_t>> groups = Groups(contour, legs);
  std::vector<LimbCut> cuts;
  // What comes down lower on the page is nearer: the near leg of a pair, and legs before trunks.
  const auto lower = [&](std::size_t a, std::size_t b) {
    return legs[a].tip.y() > legs[b].tip.y();
  };
  for (std::vector<std::size_t>& group : groups)
    std::stable_sort(group.begin(), group.end(), lower);
  std::stable_sort(groups.begin(), groups.end(),
                   [&](const auto& a, const auto& b) { return lower(a.front(), b.front()); });
  groups.resize(std::min(groups.size(), kPairs - standing));
  for (const std::vector<std::size_t>& group : groups) {
    const int near = static_cast<int>(cuts.size());
    cuts.push_back(CutAt(contour, legs[group.front()]));
    if (group.size() == 1) continue;
    LimbCut far = CutAt(contour, legs[group[1]]);
    far.far_of = near;
    cuts.push_back(std::move(far));
  }
  return cuts;
}

}  // namespace lascaux
