#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <bit>

#include "volume/band.h"
#include "volume/band_view.h"
#include "volume/lanes.h"
#include "volume/side_words.h"

namespace lascaux {
namespace {

/// The solution of Godunov's scheme from the smaller neighbour along each axis.
LASCAUX_INLINE Lanes Solve(Lanes x, Lanes y, Lanes z) {
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

LASCAUX_INLINE bool IsAnyBelow(Lanes a, Lanes b) {
  using Words [[gnu::vector_size(4 * kLanes)]] = long long;
  const auto below = (Words)(a < b);
  return ((below[0] | below[1]) | (below[2] | below[3])) != 0;
}

/// Lines wait for no smaller changes, in voxels: what the scheme errs by is ten times that.
constexpr float kSettled = 1e-2F;

/// Replaces a line's values, but those of the voxels in `given`, one bit each. Returns whether a
/// value within the band changed.
LASCAUX_INLINE bool UpdateLine(const BandView& view, std::size_t at, std::uint64_t given,
                               float* out) {
  const std::array<const float*, 4> beside = view.LinesBeside(at);
  const Lanes own = Load(view.Line(at));
  const Lanes along_x = Min(Load(beside[0]), Load(beside[1]));
  const Lanes along_y = Min(Load(beside[2]), Load(beside[3]));
  const Lanes along_z = Min(Before(own, view.BeforeLine(at)), After(own, view.AfterLine(at)));
  // Nothing within the band comes from beyond it.
  if (!IsAnyBelow(Min(Min(along_x, along_y), along_z), All(kSweepVoxels))) return false;
  const Lanes solved = Solve(along_x, along_y, along_z);
  const Lanes next = LanesIn(given) ? own : Min(solved, own);
  Store(next, out + at);
  return IsAnyBelow(next < kSweepVoxels ? next + kSettled : All(kFar), own);
}

/// One bit a line of eight along z, 8 bits for each x: y = 0, 2, 4, 6, then 1, 3, 5, 7. Lines that
/// are updated one after the other don't wait for each other's values, then.
using LineMask = std::uint64_t;

constexpr LineMask kEveryX = 0x0101010101010101;
constexpr LineMask kEven = 0x0F * kEveryX, kOdd = 0xF0 * kEveryX;
constexpr LineMask kFirstY = kEveryX, kLastY = 0x80 * kEveryX;

/// The first voxel of the line with this bit.
constexpr std::size_t VoxelOf(std::size_t bit) {
  return bit / 8 * 64 + 8 * (bit % 4 * 2 + bit / 4 % 2);
}

/// Lines beside those in `lines`, in the same block.
LineMask BesideInBlock(LineMask lines) {
  const LineMask even = lines & kEven, odd = lines & kOdd;
  return lines << 8 | lines >> 8 | even << 4 | (even & ~kFirstY) << 3 | odd >> 4 |
         (odd & ~kLastY) >> 3;
}

/// Lines of a block beside those in `changed` in its neighbours.
LineMask BesideOtherBlocks(const Band& band, std::size_t block,
                           const std::vector<LineMask>& changed) {
  const auto beside = [&](std::size_t side) {
    const std::int32_t n = band.neighbours[block][side];
    return n == kNoBlock ? LineMask{0} : changed[static_cast<std::size_t>(n)];
  };
  return beside(0) >> 56 | beside(1) << 56 | (beside(2) >> 7 & kFirstY) |
         (beside(3) << 7 & kLastY) | beside(4) | beside(5);
}

/// Values of one block while it is swept.
struct BlockSweep {
  BandView view;
  const VoxelMask& given;  // voxels that stay as they are
  float* out;              // what the view shows
  LineMask pending;        // lines whose surroundings changed since they were last updated
  LineMask changed = 0;    // lines in which a value that matters changed

  /// Updates the pending lines from first to last, with those that become pending ahead.
  LASCAUX_INLINE void Forward() {
    for (LineMask ahead = pending; ahead != 0;) {
      const LineMask line = ahead & -ahead;
      ahead ^= line;
      ahead |= Update(line) & ~(line | (line - 1));
    }
  }

  /// The same from last to first.
  LASCAUX_INLINE void Backward() {
    for (LineMask ahead = pending; ahead != 0;) {
      const LineMask line = std::bit_floor(ahead);
      ahead ^= line;
      ahead |= Update(line) & (line - 1);
    }
  }

 private:
  /// Returns the lines that are pending because of this one.
  LASCAUX_INLINE LineMask Update(LineMask line) {
    pending &= ~line;
    const std::size_t at = VoxelOf(static_cast<std::size_t>(std::countr_zero(line)));
    if (!UpdateLine(view, at, given[at / 64] >> at % 64 & 0xFF, out)) return 0;
    changed |= line;
    const LineMask touched = line | BesideInBlock(line);
    pending |= touched;
    return touched;
  }
};

LASCAUX_INLINE void SweepBothWays(BlockSweep& sweep) {
  sweep.Forward();
  sweep.Backward();
}

// The same code twice. Without fused multiplications, which AVX2 by itself has not, the bits agree.
void RunBaseline(BlockSweep& sweep) { SweepBothWays(sweep); }
#if defined(__x86_64__)
[[gnu::target("avx2")]] void RunAvx2(BlockSweep& sweep) { SweepBothWays(sweep); }
#else
constexpr auto RunAvx2 = RunBaseline;
#endif

/// The distance at a crossing. Along an axis, the distances of two voxels on different sides can't
/// add up to more than the voxel between them; where they do, in creases that one of them does not
/// see, they are scaled down.
float DistanceAtCrossing(const BandView& view, std::size_t i,
                         const std::array<std::uint64_t, 6>& crossed) {
  const float own = std::min(view.At(i), 1.0F);
  float most = own;
  for (std::size_t side = 0; side < 6; ++side) {
    if ((crossed[side] >> i % 64 & 1) == 0) continue;
    const float beyond = std::min(view.Beside(i, side), 1.0F);
    if (own + beyond > 1) most = std::min(most, own / (own + beyond));
  }
  return most;
}

/// A voxel's new distance.
struct Change {
  std::size_t voxel;
  float distance;
};

/// Scales the distances at a band's crossings down where they don't fit each other.
void FitCrossings(Band& band, const std::vector<VoxelMask>& crossings) {
  // All are found before any is made, so that the order does not matter.
  std::vector<std::vector<Change>> changes(band.size());
  tbb::parallel_for(std::size_t{0}, band.size(), [&](std::size_t b) {
    const BandView view(band, band.distance, b);
    for (std::size_t x = 0; x < 8; ++x) {
      if (crossings[b][x] == 0) continue;
      const auto crossed = CrossedSides(band, b, x);
      for (std::uint64_t word = crossings[b][x]; word != 0; word &= word - 1) {
        const std::size_t i = 64 * x + static_cast<std::size_t>(std::countr_zero(word));
        const float fitting = DistanceAtCrossing(view, i, crossed);
        if (fitting < view.At(i)) changes[b].push_back({kBlockVoxels * b + i, fitting});
      }
    }
  });
  for (const std::vector<Change>& list : changes) {
    for (const Change& change : list) band.distance[change.voxel] = change.distance;
  }
}

/// The lines that hold some of the voxels.
LineMask LinesOf(const VoxelMask& voxels) {
  LineMask lines = 0;
  for (std::size_t line = 0; line < 64; ++line) {
    const std::size_t at = VoxelOf(line);
    lines |= LineMask{(voxels[at / 64] >> at % 64 & 0xFF) != 0} << line;
  }
  return lines;
}

/// A band's blocks like the fields of a chessboard: none is beside another of its colour.
std::array<std::vector<std::size_t>, 2> ByColour(const Band& band) {
  std::array<std::vector<std::size_t>, 2> blocks;
  for (std::size_t b = 0; b < band.size(); ++b)
    blocks[static_cast<std::size_t>(band.origins[b].sum() / kBlockSide & 1)].push_back(b);
  return blocks;
}

}  // namespace

void SweepDistances(Band& band, const std::vector<VoxelMask>& crossings, Isa isa,
                    const Execution& execution) {
  FitCrossings(band, crossings);
  std::vector<LineMask> changed(band.size()), pending(band.size());
  tbb::parallel_for(std::size_t{0}, band.size(), [&](std::size_t b) {
    changed[b] = LinesOf(crossings[b]);
    pending[b] = changed[b] | BesideInBlock(changed[b]);
  });
  const auto run = isa == Isa::kBaseline ? RunBaseline : RunAvx2;
  const auto sweep_block = [&](std::size_t b) {
    const LineMask lines = pending[b] | BesideOtherBlocks(band, b, changed);
    changed[b] = 0;
    if (lines == 0) return false;
    BlockSweep sweep = {BandView(band, band.distance, b), crossings[b],
                        band.distance.data() + kBlockVoxels * b, lines};
    run(sweep);
    pending[b] = sweep.pending;
    changed[b] = sweep.changed;
    return true;
  };
  const auto blocks = ByColour(band);
  // A round without work leaves no block with work for the next.
  for (std::size_t idle = 0, colour = 0; idle < 2 && !execution.IsCancelled(); colour ^= 1) {
    std::atomic<bool> is_busy = false;
    tbb::parallel_for(std::size_t{0}, blocks[colour].size(), [&](std::size_t i) {
      if (sweep_block(blocks[colour][i])) is_busy.store(true, std::memory_order_relaxed);
    });
    idle = is_busy ? 0 : idle + 1;
  }
}

}  // namespace lascaux
