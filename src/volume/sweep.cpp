#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "lascaux/volume/level_set.h"
#include "volume/band.h"

namespace lascaux {
namespace {

using Lines = std::array<float, kBlockVoxels>;

/// What lies around a block: pointers to the values of the six neighbours.
struct Around {
  const float* own;
  std::array<const float*, 6> beside;
  bool mirrors;  // z = -1 is z = 1
};

// Four lanes: what every x86-64 and ARM processor has, in the notation that g++ and clang share.
constexpr std::size_t kLanes = 4;
using Lanes [[gnu::vector_size(4 * kLanes)]] = float;

inline Lanes All(float value) { return Lanes{} + value; }

inline Lanes Load(const float* from) {
  Lanes lanes;
  std::memcpy(&lanes, from, sizeof lanes);
  return lanes;
}

inline Lanes Min(Lanes a, Lanes b) { return a < b ? a : b; }
inline Lanes Max(Lanes a, Lanes b) { return a < b ? b : a; }

/// Square root of what is positive, 0 of the rest.
inline Lanes Root(Lanes a) {
  a = Max(a, Lanes{});
  for (std::size_t k = 0; k < kLanes; ++k) a[k] = std::sqrt(a[k]);
  return a;
}

/// The solution of Godunov's scheme from the smaller neighbour along each axis.
inline Lanes Solve(Lanes x, Lanes y, Lanes z) {
  const Lanes low = Min(x, y), high = Max(x, y);
  const Lanes a = Min(low, z);
  // Relative to the smallest, so that no digits are lost in squares.
  const Lanes b = Max(low, Min(high, z)) - a, c = Max(high, z) - a;
  const Lanes two = 0.5F * (b + Root(2.0F - b * b));
  const Lanes sum = b + c;
  const Lanes three = (1.0F / 3.0F) * (sum + Root(sum * sum - 3.0F * (b * b + c * c - 1.0F)));
  const Lanes beyond_b = two > c ? three : two;
  return a + (b < 1.0F ? beyond_b : All(1));
}

/// Where the values of a line of eight and of the lines beside it are.
struct Line {
  const float* own;
  std::array<const float*, 4> beside;  // at -x, +x, -y, +y
  float before, after;                 // at -z and +z of its ends
};

/// The new values of a line; `fixed` is below kFar where a value is given. Returns whether a value
/// within the band changed.
inline bool UpdateLine(const Line& line, const float* fixed, float* out) {
  std::array<float, 10> z;
  z[0] = line.before;
  std::memcpy(&z[1], line.own, 8 * sizeof(float));
  z[9] = line.after;
  Lanes largest_change{};
  for (std::size_t k = 0; k < 8; k += kLanes) {
    const Lanes own = Load(line.own + k), given = Load(fixed + k);
    const Lanes solved = Solve(Min(Load(line.beside[0] + k), Load(line.beside[1] + k)),
                               Min(Load(line.beside[2] + k), Load(line.beside[3] + k)),
                               Min(Load(&z[k]), Load(&z[k + 2])));
    const Lanes next = given < kFar ? given : Min(solved, own);
    const Lanes change = next < static_cast<float>(kBandVoxels) ? own - next : Lanes{};
    largest_change = Max(largest_change, change);
    std::memcpy(out + k, &next, sizeof next);
  }
  float largest = 0;
  for (std::size_t k = 0; k < kLanes; ++k) largest = std::max(largest, largest_change[k]);
  return largest > 0;
}

/// One bit a line of eight along z: bit 8 x + y.
using LineMask = std::uint64_t;

/// Lines that have a line in `changed` beside them, or are in it.
LineMask LinesToUpdate(const Band& band, std::size_t block, const std::vector<LineMask>& changed) {
  constexpr LineMask kFirstY = 0x0101010101010101, kLastY = kFirstY << 7;
  const auto beside = [&](std::size_t side) {
    const std::int32_t n = band.neighbours[block][side];
    return n == kNoBlock ? LineMask{0} : changed[static_cast<std::size_t>(n)];
  };
  const LineMask own = changed[block];
  const LineMask along_x = own << 8 | own >> 8 | beside(0) >> 56 | beside(1) << 56;
  const LineMask along_y = (own << 1 & ~kFirstY) | (own >> 1 & ~kLastY) |
                           (beside(2) >> 7 & kFirstY) | (beside(3) << 7 & kLastY);
  return own | along_x | along_y | beside(4) | beside(5);
}

/// One iteration of the lines in `lines` of one block: to `out`, from the values around it. Returns
/// the lines in which a value within the band changed.
LineMask Iterate(const Around& around, LineMask lines, const float* fixed, float* out) {
  LineMask changed = 0;
  for (; lines != 0; lines &= lines - 1) {
    const auto bit = static_cast<std::size_t>(std::countr_zero(lines));
    const std::size_t x = bit / 8, y = bit % 8, at = 8 * bit;
    Line line;
    line.own = around.own + at;
    line.beside = {x > 0 ? line.own - 64 : around.beside[0] + at + 7 * 64,
                   x < 7 ? line.own + 64 : around.beside[1] + at - 7 * 64,
                   y > 0 ? line.own - 8 : around.beside[2] + at + 7 * 8,
                   y < 7 ? line.own + 8 : around.beside[3] + at - 7 * 8};
    line.before = around.mirrors ? line.own[1] : around.beside[4][at + 7];
    line.after = around.beside[5][at];
    if (UpdateLine(line, fixed + at, out + at)) changed |= LineMask{1} << bit;
  }
  return changed;
}

/// Distances known at the crossings, kFar elsewhere. Returns for each block the lines with some.
std::vector<LineMask> FixCrossings(Band& band, const std::vector<VoxelMask>& crossings) {
  std::vector<LineMask> lines(band.size(), 0);
  tbb::parallel_for(std::size_t{0}, band.size(), [&](std::size_t b) {
    for (std::size_t i = 0; i < kBlockVoxels; ++i) {
      const bool crosses = (crossings[b][i / 64] >> i % 64 & 1) != 0;
      float& d = band.distance[kBlockVoxels * b + i];
      d = crosses ? std::min(d, 1.0F) : kFar;
      if (crosses) lines[b] |= LineMask{1} << i / 8;
    }
  });
  return lines;
}

}  // namespace

void SweepDistances(Band& band, const std::vector<VoxelMask>& crossings,
                    const Execution& execution) {
  static const Lines kNothing = [] {
    Lines lines;
    lines.fill(kFar);
    return lines;
  }();
  std::vector<LineMask> changed = FixCrossings(band, crossings), changes(band.size());
  const std::vector<float> fixed = band.distance;
  std::vector<float> next = band.distance;
  const auto is_settled = [](LineMask mask) { return mask == 0; };
  while (!std::all_of(changed.begin(), changed.end(), is_settled) && !execution.IsCancelled()) {
    // A line that is left out has not changed in the last iteration, so `next` holds its values.
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
      changes[b] = Iterate(around, LinesToUpdate(band, b, changed), fixed.data() + kBlockVoxels * b,
                           next.data() + kBlockVoxels * b);
    });
    std::swap(band.distance, next);
    std::swap(changed, changes);
  }
}

}  // namespace lascaux
