#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "lascaux/volume/level_set.h"
#include "volume/band.h"

namespace lascaux {
namespace {

// Information moves one voxel an iteration. The end of the band is 3 sqrt(3) steps away along the
// axes and bends in crotches; a scheme that has not settled by then would be a bug.
constexpr int kMaxIterations = 32;

using Lines = std::array<float, kBlockVoxels>;

/// What lies around a block: pointers to the values of the six neighbours.
struct Around {
  const float* own;
  std::array<const float*, 6> beside;
  bool mirrors;  // z = -1 is z = 1
};

/// The solution of Godunov's scheme from the smaller neighbour along each axis.
inline float Solve(float x, float y, float z) {
  const float a = std::min(x, std::min(y, z));
  const float c0 = std::max(x, std::max(y, z));
  const float b0 = std::max(std::min(x, y), std::min(std::max(x, y), z));
  const float b = b0 - a, c = c0 - a;  // relative, so that no digits are lost in squares
  const float two = 0.5F * (b + std::sqrt(std::max(2.0F - b * b, 0.0F)));
  const float sum = b + c;
  const float root = sum * sum - 3.0F * (b * b + c * c - 1.0F);
  const float three = (sum + std::sqrt(std::max(root, 0.0F))) * (1.0F / 3.0F);
  const float beyond_b = two > c ? three : two;
  return a + (b < 1.0F ? beyond_b : 1.0F);
}

/// One iteration of one block: to `out`, from the values around it. `fixed` is below kFar where a
/// value is given. Returns whether one within the band changed.
bool Iterate(const Around& around, const float* fixed, float* out) {
  float largest_change = 0;
  for (std::size_t x = 0; x < 8; ++x) {
    for (std::size_t y = 0; y < 8; ++y) {
      const std::size_t line = 64 * x + 8 * y;
      const float* const own = around.own + line;
      const float* const low_x = x > 0 ? own - 64 : around.beside[0] + line + 7 * 64;
      const float* const high_x = x < 7 ? own + 64 : around.beside[1] + line - 7 * 64;
      const float* const low_y = y > 0 ? own - 8 : around.beside[2] + line + 7 * 8;
      const float* const high_y = y < 7 ? own + 8 : around.beside[3] + line - 7 * 8;
      std::array<float, 10> z;
      z[0] = around.mirrors ? own[1] : around.beside[4][line + 7];
      for (std::size_t k = 0; k < 8; ++k) z[k + 1] = own[k];
      z[9] = around.beside[5][line];
      for (std::size_t k = 0; k < 8; ++k) {
        const float solved = Solve(std::min(low_x[k], high_x[k]), std::min(low_y[k], high_y[k]),
                                   std::min(z[k], z[k + 2]));
        const float next = fixed[line + k] < kFar ? fixed[line + k] : std::min(solved, own[k]);
        const float change = next < static_cast<float>(kBandVoxels) ? own[k] - next : 0.0F;
        largest_change = std::max(largest_change, change);
        out[line + k] = next;
      }
    }
  }
  return largest_change > 0;
}

}  // namespace

void SweepDistances(Band& band, const std::vector<VoxelMask>& crossings,
                    const Execution& execution) {
  static const Lines kNothing = [] {
    Lines lines;
    lines.fill(kFar);
    return lines;
  }();
  std::vector<float> fixed(band.distance.size()), next(band.distance.size());
  tbb::parallel_for(std::size_t{0}, band.size(), [&](std::size_t b) {
    for (std::size_t i = 0; i < kBlockVoxels; ++i) {
      const bool crosses = (crossings[b][i / 64] >> i % 64 & 1) != 0;
      float& d = band.distance[kBlockVoxels * b + i];
      d = crosses ? std::min(d, 1.0F) : kFar;
      fixed[kBlockVoxels * b + i] = d;
    }
  });
  for (int iteration = 0; iteration < kMaxIterations && !execution.IsCancelled(); ++iteration) {
    std::atomic<bool> changed = false;
    tbb::parallel_for(std::size_t{0}, band.size(), [&](std::size_t b) {
      Around around;
      around.own = band.distance.data() + kBlockVoxels * b;
      for (std::size_t side = 0; side < 6; ++side) {
        const std::int32_t n = band.neighbours[b][side];
        around.beside[side] =
            n == kNoBlock ? kNothing.data()
                          : band.distance.data() + kBlockVoxels * static_cast<std::size_t>(n);
      }
      around.mirrors = band.upper_half && band.origins[b].z() == 0;
      if (Iterate(around, fixed.data() + kBlockVoxels * b, next.data() + kBlockVoxels * b)) {
        changed.store(true, std::memory_order_relaxed);
      }
    });
    std::swap(band.distance, next);
    if (!changed) break;
  }
}

}  // namespace lascaux
