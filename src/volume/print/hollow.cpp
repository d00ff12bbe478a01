#include "volume/print/hollow.h"

#include <openvdb/tools/Composite.h>
#include <openvdb/tools/LevelSetMeasure.h>
#include <openvdb/tools/LevelSetRebuild.h>
#include <openvdb/tools/LevelSetUtil.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include "lascaux/volume/narrow_band.h"
#include "volume/print/stamp.h"

namespace lascaux {
namespace {

using Eigen::Vector3d;
using openvdb::Coord;
using openvdb::FloatGrid;

constexpr double kDrain = 4;        // mm across: resin still runs out of it
constexpr double kDrainVoxels = 4;  // a narrower hole would be a matter of luck
constexpr double kHidden = 0.25;    // voxels by which something else must at least be as low
constexpr int kAround = 8;          // places on the drain's rim that are looked at
constexpr double kFlat = 0.866;     // cos 30 degrees: how steep the outside is around a drain

/// The lowest voxel inside of each column along y.
class Floor {
 public:
  explicit Floor(const FloatGrid& grid) {
    for (auto value = grid.cbeginValueOn(); value; ++value) {
      if (*value >= 0) continue;
      const Coord at = value.getCoord();
      const double y = at.y() + static_cast<double>(*value) / grid.voxelSize().x();
      const auto [entry, is_new] = lowest_[at.x()].try_emplace(at.z(), y);
      if (!is_new) entry->second = std::min(entry->second, y);
    }
  }

  /// Would a hole of that radius in voxels around the column not change the view along z?
  bool Hides(const Coord& column, double radius) const {
    const int reach = static_cast<int>(std::ceil(radius));
    for (int x = column.x() - reach; x <= column.x() + reach; ++x) {
      const auto slice = lowest_.find(x);
      if (slice == lowest_.end()) continue;
      double all = std::numeric_limits<double>::infinity(), others = all;
      for (const auto& [z, y] : slice->second) {
        all = std::min(all, y);
        if (std::abs(z - column.z()) > radius + 1) others = std::min(others, y);
      }
      if (others > all + kHidden) return false;
    }
    return true;
  }

 private:
  std::map<int, std::map<int, double>> lowest_;  // of x, then of z
};

struct Drain {
  Coord from;         // in the cavity
  int to = 0;         // the voxel in y below which it is outside
  double radius = 0;  // in voxels
};

/// The solid's signed distances, as deep as a drain with a wall around it. In voxels.
struct Depths {
  const FloatGrid& grid;
  double radius = 0, wall = 0;
};

/// Finds where the drain goes.
class DrainSearch {
 public:
  DrainSearch(const FloatGrid& solid, const FloatGrid& cavity, const Depths& depths)
      : solid_(solid.getConstAccessor()),
        cavity_(cavity.getConstAccessor()),
        depth_(depths.grid.getConstAccessor()),
        floor_(solid),
        radius_(depths.radius),
        voxel_(solid.voxelSize().x()),
        least_depth_(voxel_ * (depths.radius + depths.wall)),
        bottom_(solid.evalActiveVoxelBoundingBox().min().y()) {}

  /// The lowest of the places (the widest of equally low ones, nearest to the middle plane) from
  /// which a drain can go; one that shows from the side only where there is no other.
  std::optional<Drain> Find(std::vector<Coord> places) const {
    const auto order = [this](const Coord& at) {
      return std::tuple(at.y(), depth_.getValue(at), std::abs(at.z()), at.x(), at.z());
    };
    std::sort(places.begin(), places.end(),
              [&order](const Coord& a, const Coord& b) { return order(a) < order(b); });
    std::optional<Drain> seen;
    for (const Coord& place : places) {
      if (!(cavity_.getValue(place) < 0)) continue;
      const std::optional<int> end = EndBelow(place);
      if (!end) continue;
      const bool is_hidden = floor_.Hides(place, radius_);
      if (seen && !is_hidden) continue;
      const Drain drain = {place, *end, radius_};
      if (is_hidden) return drain;
      seen = drain;
    }
    return seen;
  }

 private:
  /// Where a drain straight down has come out all around; none where it would leave a thin wall or
  /// a sharp edge, run along another part of the body, or open right before one.
  std::optional<int> EndBelow(const Coord& place) const {
    const std::optional<int> middle = ExitBelow(place);
    if (!middle || !HasWallsAround(place, *middle)) return std::nullopt;
    int lowest = *middle;
    for (int i = 0; i < kAround; ++i) {
      const double angle = 2 * M_PI * i / kAround;
      const auto exit =
          ExitBelow(place.offsetBy(static_cast<int>(std::lround(radius_ * std::cos(angle))), 0,
                                   static_cast<int>(std::lround(radius_ * std::sin(angle)))));
      if (!exit || *exit < *middle - 2 * radius_) return std::nullopt;
      lowest = std::min(lowest, *exit);
    }
    return lowest;
  }

  std::optional<int> ExitBelow(Coord at) const {
    while (at.y() >= bottom_ && solid_.getValue(at) < 0) --at.y();
    const int exit = at.y(), clear = exit - static_cast<int>(std::ceil(2 * radius_));
    for (; at.y() >= std::max(clear, bottom_); --at.y())
      if (solid_.getValue(at) < 0) return std::nullopt;
    return exit;
  }

  /// Does a drain from the place to below `exit` have walls all the way, to an outside that is flat
  /// enough around it?
  bool HasWallsAround(Coord at, int exit) const {
    for (; at.y() > exit; --at.y()) {
      const double above = voxel_ * (at.y() - exit - 1);
      if (-static_cast<double>(depth_.getValue(at)) < std::min(least_depth_, kFlat * above))
        return false;
    }
    return true;
  }

  FloatGrid::ConstAccessor solid_, cavity_, depth_;
  Floor floor_;
  double radius_;               // in voxels
  double voxel_, least_depth_;  // in the solid's unit
  int bottom_;
};

/// Voxels at which a ball of the radius is within the cavity, those beside narrower places: the
/// lowest ones are among them.
std::vector<Coord> WidePlaces(const FloatGrid& depth, double least) {
  std::vector<Coord> places;
  for (auto value = depth.cbeginValueOn(); value; ++value)
    if (static_cast<double>(*value) <= -least) places.push_back(value.getCoord());
  return places;
}

Vector3d Opening(const FloatGrid& grid, const Drain& drain) {
  const openvdb::Vec3d p = grid.indexToWorld(Coord(drain.from.x(), drain.to, drain.from.z()));
  return {p.x(), p.y(), p.z()};
}

/// An upright cylinder from the cavity to below the opening.
void Drill(FloatGrid& cavity, const Drain& drain) {
  const double voxel = cavity.voxelSize().x(), radius = drain.radius * voxel;
  const openvdb::Vec3d top = cavity.indexToWorld(drain.from);
  const double low = Opening(cavity, drain).y() - 2 * voxel;
  const double middle = (top.y() + low) / 2, half = (top.y() - low) / 2;
  const Eigen::AlignedBox3d box(Vector3d(top.x() - radius, low, top.z() - radius),
                                Vector3d(top.x() + radius, top.y(), top.z() + radius));
  Stamp(cavity, box, [&](const Vector3d& p) {
    const Eigen::Vector2d q(std::hypot(p.x() - top.x(), p.z() - top.z()) - radius,
                            std::abs(p.y() - middle) - half);
    return q.cwiseMax(0).norm() + std::min(q.maxCoeff(), 0.0);
  });
}

}  // namespace

std::optional<Cavity> Hollow(FloatGrid& grid, double wall) {
  const double voxel = grid.voxelSize().x();
  const double radius = std::max(kDrain / 2, kDrainVoxels / 2 * voxel);
  const double deepest = (wall + radius) / voxel + kBandVoxels;
  const auto depth = openvdb::tools::levelSetRebuild(grid, 0.0F, static_cast<float>(kBandVoxels),
                                                     static_cast<float>(deepest));
  std::vector<Coord> places = WidePlaces(*depth, wall + radius);
  if (places.empty()) return std::nullopt;
  const auto inner = openvdb::tools::levelSetRebuild(*depth, static_cast<float>(-wall),
                                                     static_cast<float>(kBandVoxels));
  std::vector<FloatGrid::Ptr> cavities;  // the largest first
  openvdb::tools::segmentSDF(*inner, cavities);
  for (const FloatGrid::Ptr& cavity : cavities) {
    const Depths depths = {*depth, radius / voxel, wall / voxel};
    const auto drain = DrainSearch(grid, *cavity, depths).Find(places);
    if (!drain) continue;
    Cavity made;
    made.saved = openvdb::tools::levelSetVolume(*cavity) / openvdb::tools::levelSetVolume(grid);
    made.drain = 2 * radius;
    made.opening = Opening(grid, *drain);
    Drill(*cavity, *drain);
    openvdb::tools::csgDifference(grid, *cavity);
    return made;
  }
  return std::nullopt;
}

}  // namespace lascaux
