#include "volume/render/grid_coloring.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace lascaux {
namespace {

/// Linear albedo of paint that is white on the drawing's page: not whiter than plaster.
constexpr float kPaint = 0.80F;

/// From one grid's voxels to another's.
Eigen::Affine3f Between(const openvdb::GridBase& from, const openvdb::GridBase& to) {
  const auto map = [&](const openvdb::Vec3d& p) {
    const openvdb::Vec3d q = to.worldToIndex(from.indexToWorld(p));
    return Eigen::Vector3d(q.x(), q.y(), q.z());
  };
  const Eigen::Vector3d origin = map({0, 0, 0});
  Eigen::Affine3d affine;
  affine.translation() = origin;
  affine.linear().col(0) = map({1, 0, 0}) - origin;
  affine.linear().col(1) = map({0, 1, 0}) - origin;
  affine.linear().col(2) = map({0, 0, 1}) - origin;
  return affine.cast<float>();
}

/// Calls `use(value, weight)` for the active ones of the eight voxels around a place.
template <typename Grid, typename Use>
void ForVoxelsAround(const Grid& grid, const Eigen::Vector3f& place, Use&& use) {
  // Not registered with the tree, which would cost more than the look.
  const openvdb::tree::ValueAccessor<const typename Grid::TreeType, /*IsSafe=*/false> voxels(
      grid.tree());
  const Eigen::Vector3f low = place.array().floor();
  const Eigen::Vector3f f = place - low;
  const Eigen::Vector3i c = low.cast<int>();
  typename Grid::ValueType value;
  for (int corner = 0; corner < 8; ++corner) {
    const int x = corner & 1, y = corner >> 1 & 1, z = corner >> 2;
    if (!voxels.probeValue({c.x() + x, c.y() + y, c.z() + z}, value)) continue;
    use(value,
        (x != 0 ? f.x() : 1 - f.x()) * (y != 0 ? f.y() : 1 - f.y()) * (z != 0 ? f.z() : 1 - f.z()));
  }
}

}  // namespace

GridColoring::GridColoring(const ShownModel& model, Material material)
    : material_(material), color_(model.color.get()), part_(model.part.get()) {
  if (color_ != nullptr) to_color_ = Between(*model.surface, *color_);
  if (part_ == nullptr) return;
  to_part_ = Between(*model.surface, *part_);
  for (const auto& [r, g, b] : model.palette) palette_.emplace_back(r, g, b);
}

Color GridColoring::AlbedoAt(const Eigen::Vector3f& place) const noexcept {
  Color sum(0, 0, 0);
  float total = 0;
  if (material_ == Material::kDrawing) {
    ForVoxelsAround(*color_, to_color_ * place, [&](const openvdb::Vec3f& c, float weight) {
      sum += weight * kPaint * Color(c.x(), c.y(), c.z());
      total += weight;
    });
  } else if (material_ == Material::kParts) {
    ForVoxelsAround(*part_, to_part_ * place, [&](float part, float weight) {
      const auto index = static_cast<std::size_t>(std::max(part, 0.F));
      sum += weight * (part >= 0 && index < palette_.size() ? palette_[index] : Clay());
      total += weight;
    });
  }
  // Where nothing is said, clay.
  return total > 0 ? Color(sum / total) : Clay();
}

float GridColoring::PartAt(const Eigen::Vector3f& place) const noexcept {
  if (part_ == nullptr) return -1;
  struct Share {
    float part, weight;
  };
  std::array<Share, 8> shares;
  std::size_t count = 0;
  ForVoxelsAround(*part_, to_part_ * place, [&](float part, float weight) {
    const auto end = shares.begin() + static_cast<std::ptrdiff_t>(count);
    const auto known =
        std::find_if(shares.begin(), end, [&](const Share& s) { return s.part == part; });
    if (known != end) {
      known->weight += weight;
    } else {
      shares[count++] = {part, weight};
    }
  });
  if (count == 0) return -1;
  return std::max_element(shares.begin(), shares.begin() + static_cast<std::ptrdiff_t>(count),
                          [](const Share& a, const Share& b) { return a.weight < b.weight; })
      ->part;
}

}  // namespace lascaux
