#include "skeleton/shape_limb.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "skeleton/smoothstep.h"

namespace lascaux {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// A limb hangs when its tip is below its root by this share of their distance: such legs stand
/// straight.
constexpr double kHanging = 0.5;
/// Tangent of the most that a limb leans outwards: all of it when its tip is above its root by that
/// share of their distance, none when it hangs.
constexpr double kMostLean = 0.7, kUpright = 0.5;
/// What is longer than so many times its width leans less, so that its tip is no further out: long
/// ears and horns stand straighter than short ones.
constexpr double kLeaning = 2;
/// Slope at which a hanging limb goes out to the flank.
constexpr double kSpread = 1.0;
/// Thickness in z over width: of limbs as long as wide, and that much more for each width of
/// length.
constexpr double kFlat = 0.65, kRounder = 0.1;
/// No limb is thinner, where it lies on its parent and where it is free.
constexpr double kThinnest = 0.3, kThinnestFree = 0.9;
/// The way to the flank is walked in steps of that share of the top's radius, so many at most, and
/// has passed it when the depth falls to that share.
constexpr double kStride = 0.5, kRidge = 0.97;
constexpr int kStrides = 64;
/// A shoulder's discs keep within the parent's outline by this share of their distance from it, and
/// begin where that lets them have this share of the top's radius.
constexpr double kWithin = 0.9, kLeastShoulder = 0.6;
/// No limb stands further out of its parent, as a share of that one's half depth: haunches are
/// flush.
constexpr double kMostRelief = 0.12;
/// Islands: thickness in z over width, and how deep their middle lies under the surface, in radii.
constexpr double kLens = 0.5, kLensDepth = 0.15;
/// Steepest slope of its parent that an island or a limb follows.
constexpr double kSteepest = 0.7;
constexpr double kReach = 0.8;  ///< of a station, in radii

template <typename Visit>
void ForEachDisc(const CreaturePart& part, Visit visit) {
  for (const Chain& chain : part.axis) {
    for (const SkeletonVertex& v : chain.vertices) visit(v);
  }
}

/// The middle of a polyline by length: completions are not sampled evenly.
Vector2d MiddleOf(const std::vector<Vector2d>& curve) {
  Vector2d middle = Vector2d::Zero();
  double total = 0;
  for (std::size_t i = 0; i + 1 < curve.size(); ++i) {
    const double step = (curve[i + 1] - curve[i]).norm();
    middle += step * (curve[i] + curve[i + 1]) / 2;
    total += step;
  }
  return total > 0 ? Vector2d(middle / total) : curve.front();
}

/// The disc that holds a limb: the one that touches its outline nearest the middle of its
/// completion inside the parent, or the one deepest in the parent's outline when the limb has none.
/// Not simply the nearest end of a chain: where the completion has corners, ends are tips of no
/// radius.
SkeletonVertex TopOf(const CreaturePart& limb, const Part& part, const Ring& parent) {
  const bool has_root = part.root && !part.root->open_completion.empty();
  const Vector2d middle = has_root ? MiddleOf(part.root->open_completion) : Vector2d::Zero();
  SkeletonVertex best;
  double least = std::numeric_limits<double>::infinity();
  ForEachDisc(limb, [&](const SkeletonVertex& v) {
    const double cost = has_root ? (v.position - middle).norm() - v.radius
                                 : SignedDistanceToRing(parent, v.position);
    if (cost < least) least = cost, best = v;
  });
  return best;
}

/// A disc of the limb, seen from its parent.
struct Place {
  SkeletonVertex disc;
  double outside = 0;  ///< distance from the parent's outline, negative inside
  double away = 0;     ///< from the top
  std::optional<double> front;
};

/// Change by place of the depth of the parent's surface, `front` there.
Vector2d SlopeOf(const LimbParent& parent, const Vector2d& place, double front) {
  const Vector3d normal = parent.surface.Normal(place, front);
  const double flat = normal.head<2>().norm();
  if (!(flat > 0)) return Vector2d::Zero();
  return -normal.head<2>() / std::max(normal.z(), flat / kSteepest);
}

class LimbShaper {
 public:
  LimbShaper(const CreaturePart& limb, const Part& part, const LimbParent& parent,
             const PlaceInDepthOptions& options)
      : parent_(parent), options_(options), top_(TopOf(limb, part, parent.outline)) {
    ForEachDisc(limb, [&](const SkeletonVertex& v) {
      places_.push_back({v, SignedDistanceToRing(parent.outline, v.position),
                         (v.position - top_.position).norm(), parent.surface.Front(v.position)});
    });
    tip_ = &*std::max_element(places_.begin(), places_.end(), [](const Place& a, const Place& b) {
      return a.away + a.disc.radius < b.away + b.disc.radius;
    });
    front_ = parent.surface.Front(top_.position);
  }

  LimbShape Run() {
    if (tip_->outside + tip_->disc.radius < 0) return Lying();
    const Vector2d way = tip_->disc.position - top_.position;
    return way.y() > kHanging * way.norm() ? Hanging() : Rising();
  }

 private:
  double Apart(double radius, double scale) const {
    return radius * (scale + options_.pair_gap / 2);
  }

  double FrontAtTop() const { return front_.value_or(parent_.surface.Middle(top_.position)); }

  /// The deepest place of the parent on the way on from the limb's tip through its top: up the
  /// flank that a leg hangs from, to the ridge of the head that a tusk grows out of and no further.
  struct Flank {
    double depth = 0;
    std::vector<Vector2d> way;  ///< steps from the top to the place
  };
  Flank FindFlank() const {
    Flank flank{FrontAtTop(), {}};
    const Vector2d way = top_.position - tip_->disc.position;
    if (!(way.norm() > 0)) return flank;
    const Vector2d step = kStride * top_.radius * way.normalized();
    bool entered = front_.has_value();
    std::vector<Vector2d> passed;
    for (int i = 1; i <= kStrides; ++i) {
      passed.push_back(top_.position + i * step);
      const std::optional<double> here = parent_.surface.Front(passed.back());
      if (entered && (!here || *here < kRidge * flank.depth)) break;
      if (!here) continue;
      entered = true;
      if (*here > flank.depth) flank = {*here, passed};
    }
    return flank;
  }

  /// Discs from the top up to the flank, at the depth `z`: they are inside of the parent's outline
  /// and no deeper than `face`.
  void AddShoulder(const Flank& flank, double z, double face, LimbShape& shape) const {
    Chain chain;
    for (const Vector2d& place : flank.way) {
      const double room = -kWithin * SignedDistanceToRing(parent_.outline, place);
      if (room < kLeastShoulder * top_.radius) {
        if (chain.vertices.empty()) continue;
        break;
      }
      const double radius = std::min(room, top_.radius);
      chain.vertices.push_back({place, radius});
      const double scale = std::clamp((face - z) / radius, kThinnest, options_.limb_depth);
      shape.stations.push_back({place, kReach * radius, z, scale});
    }
    if (!chain.vertices.empty()) shape.shoulder = std::move(chain);
  }

  /// Lets the limb's end, whose middle is at the depth `root` at the top, go under the parent's
  /// surface as a shoulder blade does, and not stand on it like a peg.
  void Sink(double root, LimbShape& shape) const {
    const Vector2d way = top_.position - tip_->disc.position;
    const Vector2d end = top_.position + top_.radius * way.stableNormalized();
    const std::optional<double> front = parent_.surface.Front(end);
    if (!front) return;
    const double z = std::min(root, *front - kThinnest * top_.radius);
    shape.stations.push_back({end, kReach * top_.radius, z, kThinnest});
  }

  /// Mean radius where the limb is clear of its parent; of all of it when it is nowhere.
  double FreeRadius() const {
    double sum = 0, count = 0;
    for (const Place& p : places_) {
      if (p.outside > 0) sum += p.disc.radius, ++count;
    }
    if (count > 0) return sum / count;
    for (const Place& p : places_) sum += p.disc.radius, ++count;
    return sum / count;
  }

  /// Distance from the top at which the limb leaves its parent's outline.
  double Exit() const {
    double exit = tip_->away;
    for (const Place& p : places_) {
      if (p.outside > 0) exit = std::min(exit, p.away);
    }
    return std::max(exit, top_.radius);
  }

  LimbShape Hanging() {
    const Flank on_parent = FindFlank();
    const double flank = on_parent.depth, radius = FreeRadius(), exit = Exit();
    const double size = std::max(radius, top_.radius);
    const double wanted = flank - options_.limb_depth * radius;
    const double foot = std::max(wanted, std::min(Apart(radius, options_.limb_depth), flank));
    const double foot_face = foot + options_.limb_depth * radius;
    // A root at the belly, where the parent is thin, stands over its foot and has a shoulder.
    const double surface = FrontAtTop() - options_.embed * size;
    const double root = std::max(surface, foot);
    const double root_face =
        std::max(FrontAtTop() + std::min(options_.relief * size, kMostRelief * flank), foot_face);
    // Smoothstep's steepest slope is 3/2.
    const double way = std::max(exit, 1.5 * std::abs(foot - root) / kSpread);
    LimbShape shape;
    shape.pushed = (foot - wanted) / radius;
    for (const Place& p : places_) {
      const double share = Smoothstep(p.away / way);
      const double z = root + share * (foot - root);
      if (&p == tip_) shape.z = z;
      const double face = root_face + share * (foot_face - root_face);
      double scale = (face - z) / p.disc.radius;
      const bool lies = p.outside <= 0 && p.front && *p.front > z;
      if (!lies) {
        scale = std::clamp(std::min(scale, z / p.disc.radius - options_.pair_gap / 2),
                           kThinnestFree, options_.limb_depth);
      }
      scale = std::clamp(scale, kThinnest, options_.limb_depth);
      const Vector2d tilt =
          lies ? Vector2d((1 - share) * SlopeOf(parent_, p.disc.position, *p.front))
               : Vector2d(Vector2d::Zero());
      shape.stations.push_back({p.disc.position, kReach * p.disc.radius, z, scale, tilt});
    }
    if (surface < foot) {
      AddShoulder(on_parent, foot, flank, shape);
    } else {
      Sink(root, shape);
    }
    return shape;
  }

  /// All of it lies on the parent: a folded wing, an ear that hangs down.
  LimbShape Lying() {
    LimbShape shape;
    shape.z = FrontAtTop() - options_.embed * top_.radius;
    for (const Place& p : places_) {
      const double z = p.front.value_or(shape.z) - options_.embed * p.disc.radius;
      shape.stations.push_back(
          {p.disc.position, kReach * p.disc.radius, z, options_.embed + options_.relief});
    }
    return shape;
  }

  /// Tangent of the lean of the parent's normal out of the plane.
  double Lean() const {
    if (!front_) return 0;
    const Vector3d normal = parent_.surface.Normal(top_.position, *front_);
    const double flat = normal.head<2>().norm();
    const double lean =
        normal.z() < kMostLean * flat ? std::max(normal.z(), 0.0) / flat : kMostLean;
    const Vector2d way = tip_->disc.position - top_.position;
    const double down = way.norm() > 0 ? way.y() / way.norm() : 0;
    return lean * Smoothstep((kHanging - down) / (kHanging + kUpright));
  }

  /// Greatest half width, and length in whole ones.
  double Widest() const {
    double widest = 0;
    for (const Place& p : places_) widest = std::max(widest, p.disc.radius);
    return widest;
  }
  double Slenderness() const {
    return (tip_->away + tip_->disc.radius + top_.radius) / (2 * Widest());
  }

  /// Half of its thickness where it is as wide as anywhere: plates are as thick all over.
  double PlateThickness() const {
    return Widest() *
           std::clamp(kFlat + kRounder * (Slenderness() - 1), kFlat, options_.limb_depth);
  }

  LimbShape Rising() {
    const double thickness = PlateThickness();
    const double lean = Lean() * std::min(1.0, kLeaning / Slenderness());
    const double root = FrontAtTop() - options_.embed * top_.radius;
    LimbShape shape;
    shape.z = root;
    for (const Place& p : places_) {
      const double scale = std::min(1.0, thickness / p.disc.radius);
      double z = root + lean * std::max(p.outside, 0.0);
      if (p.outside <= 0 && p.front) z = std::max(z, *p.front - options_.embed * p.disc.radius);
      if (p.outside > 0) z = std::max(z, Apart(p.disc.radius, scale));
      shape.z = std::max(shape.z, z);
      shape.stations.push_back({p.disc.position, kReach * p.disc.radius, z, scale});
    }
    return shape;
  }

  const LimbParent& parent_;
  const PlaceInDepthOptions& options_;
  SkeletonVertex top_;
  std::vector<Place> places_;
  const Place* tip_ = nullptr;
  std::optional<double> front_;
};

}  // namespace

LimbShape ShapeLimb(const CreaturePart& limb, const Part& part, const LimbParent& parent,
                    const PlaceInDepthOptions& options) {
  return LimbShaper(limb, part, parent, options).Run();
}

LimbShape ShapeIsland(const CreaturePart& island, const LimbParent& parent) {
  const SkeletonVertex disc = LargestDisc(island);
  LimbShape shape;
  const std::optional<double> front = parent.surface.Front(disc.position);
  shape.z = parent.surface.Middle(disc.position);
  Vector2d slope = Vector2d::Zero();
  if (front) {
    shape.z = *front - kLensDepth * disc.radius;
    slope = SlopeOf(parent, disc.position, *front);
  }
  ForEachDisc(island, [&](const SkeletonVertex& v) {
    const double z = shape.z + slope.dot(v.position - disc.position);
    shape.stations.push_back({v.position, v.radius, z, kLens, slope});
  });
  return shape;
}

SkeletonVertex LargestDisc(const CreaturePart& part) {
  SkeletonVertex best;
  ForEachDisc(part, [&](const SkeletonVertex& v) {
    if (v.radius > best.radius) best = v;
  });
  return best;
}

}  // namespace lascaux
