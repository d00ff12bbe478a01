#include "skeleton/shape_torso.h"

#include <algorithm>
#include <cmath>

#include "skeleton/smoothstep.h"

namespace lascaux {
namespace {

using Eigen::Vector2d;

/// Sections of this share of the largest radius begin to belong to the torso; those of the second
/// do.
constexpr double kThin = 0.4, kThick = 0.7;
/// The belly is that far from the middle, and a station reaches so far, in radii.
constexpr double kBelly = 0.75, kReach = 0.8;
/// A section's depth follows its neighbours' over so many radii to either side.
constexpr double kNeighbourhood = 1.5;
/// What a section may get by that.
constexpr double kLeastShare = 0.6, kMostShare = 1.15;
/// What stands out of the back by less than this share of the torso's radius is no fin.
constexpr double kLeastRise = 0.2;
/// A fin is no taller than so many times its width, and rises within 45 degrees of straight up.
constexpr double kTallest = 1.6, kUpright = 0.7;
/// Thickness of a fin's tip over its width.
constexpr double kFin = 0.4;

class Shaper {
 public:
  Shaper(const std::vector<Chain>& chains, const PlaceInDepthOptions& options)
      : chains_(chains), spine_(chains[0].vertices), options_(options) {
    for (const SkeletonVertex& v : spine_) largest_ = std::max(largest_, v.radius);
    arcs_.assign(spine_.size(), 0);
    for (std::size_t i = 1; i < spine_.size(); ++i) {
      arcs_[i] = arcs_[i - 1] + (spine_[i].position - spine_[i - 1].position).norm();
    }
  }

  std::vector<DepthStation> Run() {
    for (std::size_t i = 0; i < spine_.size(); ++i) AddSection(i);
    for (std::size_t k = 1; k < chains_.size(); ++k) AddBranch(chains_[k].vertices);
    return std::move(stations_);
  }

 private:
  /// How much a section of that radius belongs to the torso, 0 to 1.
  double Torso(double radius) const {
    return Smoothstep((radius / largest_ - kThin) / (kThick - kThin));
  }

  /// Mean radius of the neighbourhood over the radius.
  double Evenness(std::size_t i) const {
    double sum = 0, weights = 0;
    for (std::size_t j = 0; j < spine_.size(); ++j) {
      const double away = (arcs_[j] - arcs_[i]) / (kNeighbourhood * spine_[i].radius);
      const double length = (arcs_[std::min(j + 1, spine_.size() - 1)] - arcs_[j > 0 ? j - 1 : 0]);
      const double weight = length * std::exp(-away * away);
      sum += weight * spine_[j].radius;
      weights += weight;
    }
    return weights > 0 ? std::clamp(sum / weights / spine_[i].radius, kLeastShare, kMostShare)
                       : 1.0;
  }

  double ScaleAt(std::size_t i) const {
    const double torso = Torso(spine_[i].radius);
    return std::pow(options_.torso_depth * Evenness(i), torso);
  }

  void AddSection(std::size_t i) {
    const SkeletonVertex& v = spine_[i];
    DepthStation station{v.position, kReach * v.radius, 0, ScaleAt(i)};
    const std::size_t before = i > 0 ? i - 1 : 0, after = std::min(i + 1, spine_.size() - 1);
    const Vector2d along = spine_[after].position - spine_[before].position;
    if (along.norm() > 0) {
      // Down is where y grows.
      const Vector2d down =
          Vector2d(-along.y(), along.x()) * (along.x() >= 0 ? 1 : -1) / along.norm();
      station.belly = down / (kBelly * v.radius);
      station.fuller = std::pow(options_.belly, Torso(v.radius) * down.y());
    }
    stations_.push_back(station);
  }

  /// Thickness of the branch's tip over its width; `torso` where the branch begins.
  double TipScale(const std::vector<SkeletonVertex>& branch, double torso) const {
    const SkeletonVertex &base = branch.front(), &tip = branch.back();
    const Vector2d way = tip.position - base.position;
    const double length = way.norm(), rise = length + tip.radius - base.radius;
    const bool upright = -way.y() > kUpright * length;
    if (rise < kLeastRise * base.radius) return torso;
    if (!upright) return 1;
    // Its half width where it leaves the torso.
    double width = tip.radius;
    for (const SkeletonVertex& v : branch) {
      if ((v.position - base.position).norm() >= base.radius) {
        width = v.radius;
        break;
      }
    }
    const bool fin = rise < kTallest * 2 * std::max(width, tip.radius);
    return fin ? 1 + (kFin - 1) * Torso(base.radius) : 1;
  }

  void AddBranch(const std::vector<SkeletonVertex>& branch) {
    std::size_t nearest = 0;
    for (std::size_t i = 0; i < spine_.size(); ++i) {
      if ((spine_[i].position - branch[0].position).norm() <
          (spine_[nearest].position - branch[0].position).norm())
        nearest = i;
    }
    const double from = ScaleAt(nearest), to = TipScale(branch, from);
    const double reach = (branch.back().position - branch[0].position).norm();
    for (std::size_t i = 1; i < branch.size(); ++i) {
      const double way = (branch[i].position - branch[0].position).norm();
      const double share = Smoothstep(way / std::min(reach, 1.5 * branch[0].radius));
      stations_.push_back({branch[i].position, kReach * branch[i].radius, 0,
                           std::pow(from, 1 - share) * std::pow(to, share)});
    }
  }

  const std::vector<Chain>& chains_;
  const std::vector<SkeletonVertex>& spine_;
  const PlaceInDepthOptions& options_;
  double largest_ = 0;
  std::vector<double> arcs_;
  std::vector<DepthStation> stations_;
};

}  // namespace

std::vector<DepthStation> ShapeTorso(const std::vector<Chain>& chains,
                                     const PlaceInDepthOptions& options) {
  return Shaper(chains, options).Run();
}

}  // namespace lascaux
