#include "volume/self_intersections.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>

#include "volume/triangle_pair.h"

namespace lascaux {
namespace {

using Eigen::AlignedBox3f;
using Eigen::Vector3d;
using Eigen::Vector3f;

using Cell = Eigen::Array3i;

constexpr int kCellBits = 21;  // three coordinates in one 64-bit key
// A triangle may lie in this many cells on average; cells grow until that holds, so that a few big
// triangles among many small ones don't fill the memory.
constexpr std::size_t kCellsPerTriangle = 12;

/// A triangle in one of the cells that its box touches.
struct Entry {
  std::uint64_t cell;
  std::uint32_t item;
};

/// Equal cells over the triangles' boxes, kept in buckets by their key's hash.
class CellGrid {
 public:
  explicit CellGrid(const std::vector<AlignedBox3f>& boxes) : boxes_(boxes) {
    AlignedBox3f all;
    double extents = 0;
    for (const AlignedBox3f& box : boxes) {
      all.extend(box);
      extents += static_cast<double>(box.sizes().maxCoeff());
    }
    low_ = all.min().cast<double>();
    const double whole = (all.max().cast<double>() - low_).maxCoeff();
    cell_size_ = std::max(extents / static_cast<double>(boxes.size()), std::ldexp(whole, -20));
    while (CountEntries() > kCellsPerTriangle * boxes.size()) cell_size_ *= 1.5;
    Fill();
  }

  std::size_t buckets() const noexcept { return first_.size() - 1; }

  /// Calls visit(i, j) once for each pair of boxes that overlap and meet first in this bucket.
  template <typename Visit>
  void ForPairs(std::size_t bucket, Visit&& visit) const {
    for (std::size_t m = first_[bucket]; m < first_[bucket + 1]; ++m) {
      for (std::size_t n = m + 1; n < first_[bucket + 1]; ++n) {
        const Entry &a = entries_[m], &b = entries_[n];
        if (a.cell != b.cell || !boxes_[a.item].intersects(boxes_[b.item])) continue;
        const Vector3f corner = boxes_[a.item].min().cwiseMax(boxes_[b.item].min());
        if (Key(CellOf(corner)) == a.cell) visit(a.item, b.item);
      }
    }
  }

 private:
  Cell CellOf(const Vector3f& p) const {
    return ((p.cast<double>() - low_) / cell_size_).array().cast<int>();
  }

  static std::uint64_t Key(const Cell& c) {
    return static_cast<std::uint64_t>(c.x()) | static_cast<std::uint64_t>(c.y()) << kCellBits |
           static_cast<std::uint64_t>(c.z()) << (2 * kCellBits);
  }

  std::size_t CountEntries() const {
    double count = 0;  // in floating point: a bad first guess of the size must not overflow
    for (const AlignedBox3f& box : boxes_) {
      const Cell low = CellOf(box.min()), high = CellOf(box.max());
      count += (high - low + 1).cast<double>().prod();
    }
    return count < 1e15 ? static_cast<std::size_t>(count) : std::size_t{1} << 50;
  }

  template <typename Visit>
  void ForEntries(Visit&& visit) const {
    for (std::uint32_t item = 0; item < boxes_.size(); ++item) {
      const Cell low = CellOf(boxes_[item].min()), high = CellOf(boxes_[item].max());
      for (int x = low.x(); x <= high.x(); ++x) {
        for (int y = low.y(); y <= high.y(); ++y) {
          for (int z = low.z(); z <= high.z(); ++z) visit(Entry{Key({x, y, z}), item});
        }
      }
    }
  }

  void Fill() {
    const std::size_t size = std::bit_ceil(2 * boxes_.size());
    const int shift = 64 - std::countr_zero(size);
    const auto bucket = [shift](std::uint64_t key) {
      return static_cast<std::size_t>(key * 0x9E3779B97F4A7C15u >> shift);  // Fibonacci hashing
    };
    first_.assign(size + 1, 0);
    ForEntries([&](const Entry& e) { ++first_[bucket(e.cell) + 1]; });
    for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
    entries_.resize(first_.back());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    ForEntries([&](const Entry& e) { entries_[next[bucket(e.cell)]++] = e; });
  }

  const std::vector<AlignedBox3f>& boxes_;
  Vector3d low_ = Vector3d::Zero();
  double cell_size_ = 0;
  std::vector<std::size_t> first_;
  std::vector<Entry> entries_;
};

}  // namespace

std::optional<std::int64_t> CountSelfIntersections(const Mesh& mesh,
                                                   const std::vector<std::uint32_t>& of,
                                                   const Execution& execution) {
  if (of.size() < 2) return 0;
  std::vector<AlignedBox3f> boxes(of.size());
  tbb::parallel_for(std::size_t{0}, of.size(), [&](std::size_t i) {
    for (const std::uint32_t v : mesh.triangles[of[i]]) boxes[i].extend(mesh.vertices[v]);
  });
  const CellGrid cells(boxes);
  const auto count = [&](const tbb::blocked_range<std::size_t>& range, std::int64_t sum) {
    if (execution.IsCancelled()) return sum;
    for (std::size_t bucket = range.begin(); bucket < range.end(); ++bucket) {
      cells.ForPairs(bucket, [&](std::uint32_t i, std::uint32_t j) {
        sum += PairIntersects(mesh, mesh.triangles[of[i]], mesh.triangles[of[j]]) ? 1 : 0;
      });
    }
    return sum;
  };
  const std::int64_t pairs =
      tbb::parallel_reduce(tbb::blocked_range<std::size_t>(0, cells.buckets(), 1024),
                           std::int64_t{0}, count, std::plus<>());
  if (execution.IsCancelled()) return std::nullopt;
  return pairs;
}

}  // namespace lascaux
