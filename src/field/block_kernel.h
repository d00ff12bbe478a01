#pragma once

#include <cstdint>

#include "lattice_scheme.h"

/// @file
/// What the vector code gets and gives: plain structs and pointers, since it is compiled once for
/// each instruction set and must not share an inline function with code that is not.

namespace lascaux::internal {

/// Points are taken this many at a time: their samples stay in the first-level cache, and the
/// set-up of a primitive is shared by many. A multiple of every vector's width.
inline constexpr int kTile = 64;

/// A tile that is not full is filled up to a multiple of this: the widest vector.
inline constexpr int kGroup = 16;

/// Primitives whose bounds are computed together.
inline constexpr int kBoundTile = 16;

/// A box, as offsets from a block's origin.
struct KernelBox {
  float low[3], high[3];
};

/// A segment seen from a block's origin, in units of its larger end's radius (see
/// segment_integral.h).
struct KernelSegment {
  KernelBox support;
  float x, y, z;     ///< (origin - A) / tau0
  float ux, uy, uz;  ///< unit direction from the larger end
  float inv_tau;     ///< 1 / tau0
  float slope;       ///< g <= 0
  float y_end;       ///< length / smaller radius
};

/// A point primitive seen from a block's origin.
struct KernelPoint {
  KernelBox support;
  float x, y, z;  ///< (origin - center) / radius
  float inv_radius;
  float norm;  ///< weight times N0
};

/// A spline's places are kept within so many cells of its table: beyond, nothing changes.
inline constexpr int kTableReach = 2;

/// One or two uniform bicubic splines over the same cells of the plane, seen from a block's origin.
/// The coefficients go on by kTableReach + 1 cells before the table and two more behind it, so that
/// nobody asks where it ends.
struct KernelTable {
  const float* coefficients;  ///< of cell (-kTableReach - 1, -kTableReach - 1); null for none
  int channels, columns, rows, stride;  ///< columns and rows of the table itself
  int column, row;                      ///< cell of the origin
  float x, y;                           ///< the origin in that cell, 0 to 1
  float inv_cell;
  float shift;  ///< is taken from the first spline's coefficients
};

/// Cells of a table: at least 4 columns, those around it included.
struct KernelRectangle {
  int column, row, columns, rows;
};

/// The depth map of a part: middles, seen from the one at the origin, and steepness.
struct KernelMap {
  KernelTable table;
  float above;        ///< of the origin above table.shift
  float flat_origin;  ///< z of the origin in the part's flat space, from z0
};

/// Ranges of primitives that are added.
struct KernelChain {
  std::uint32_t segments_begin, segments_end, points_begin, points_end;
};

/// Chains that are blended, and what to do with the result.
struct KernelPart {
  std::uint32_t chains_begin, chains_end;
  std::uint32_t slot;       ///< where its samples are kept for its children: its depth in the tree
  bool blends_with_parent;  ///< the samples in slot - 1 are its parent's
  float inv_depth_scale;
  int map;  ///< index in the maps, or -1 when inv_depth_scale is all there is
};

/// A Ricci exponent: 2^squarings, or any n when squarings is negative.
struct KernelExponent {
  int squarings;
  float n;
};

/// A field, or the part of it that reaches a block.
struct KernelProgram {
  const KernelSegment* segments;
  const KernelPoint* points;
  const KernelChain* chains;
  const KernelPart* parts;
  std::uint32_t part_count;
  KernelExponent chain_exponent, part_exponent;
  const KernelMap* maps;
  KernelTable gain;
};

/// Up to kTile values and gradients, aligned to 64 bytes.
struct alignas(64) KernelSamples {
  float value[kTile], x[kTile], y[kTile], z[kTile];
  int count;
};

/// Up to kTile points as offsets from the origin, a multiple of kGroup.
struct alignas(64) KernelPoints {
  float x[kTile], y[kTile], z[kTile];
  int count;
};

/// A block's lattice, z fastest, with steps of length 1.
struct KernelLattice {
  int side;               ///< of the scheme that it is interpolated by
  KernelPoints tiles[2];  ///< the scheme's nodes and checks; the second may be empty
  KernelPoints columns;   ///< the places in the plane, each for a line of the lattice
};

/// Values on a lattice, layer by layer along x, with what they may be off by.
struct KernelLatticeValues {
  KernelSamples layer[kLatticeSide];
  float error;
};

/// Which of a lattice's points are inside is asked.
struct KernelLatticeQuestion {
  const KernelLattice* lattice;
  float step;
  float least_error;  ///< that interpolated values are taken to be off by
};

/// One bit a point, one word a layer: inside, or too near to the surface to tell.
struct KernelLatticeSides {
  std::uint64_t inside[kLatticeSide], unsure[kLatticeSide];
};

/// kBoundTile segments seen from the centre of a ball each, lengths in units of their larger radii.
struct alignas(64) KernelBalls {
  float x[kBoundTile], y[kBoundTile], z[kBoundTile];  ///< (center - A) / tau0
  float ux[kBoundTile], uy[kBoundTile], uz[kBoundTile];
  float slope[kBoundTile], y_end[kBoundTile];
  float length[kBoundTile];  ///< of the segment
  float radius[kBoundTile];  ///< of the ball
};

struct alignas(64) KernelBounds {
  float lower[kBoundTile], upper[kBoundTile];
};

/// One build of the vector code.
struct BlockKernel {
  /// F at a tile's points, gradients left alone. `slots` is memory for one set of samples a depth
  /// and one more.
  void (*values)(const KernelProgram&, const KernelPoints&, KernelSamples* slots,
                 KernelSamples* result);
  /// F and its gradient.
  void (*samples)(const KernelProgram&, const KernelPoints&, KernelSamples* slots,
                  KernelSamples* result);
  /// Sides of a lattice's points: each chain's field is interpolated, the rest as it is. `slots` as
  /// for values.
  void (*lattice)(const KernelProgram&, const KernelLatticeQuestion&, KernelLatticeValues* slots,
                  KernelLatticeSides* sides);
  /// Bounds of each segment's field on its ball.
  void (*bounds)(const KernelBalls&, KernelBounds* bounds);
  /// Signed distances of a tile's samples, clamped to [-limit, limit].
  void (*distances)(const KernelSamples&, float limit, float* distances);
  /// Least and greatest coefficient of each spline of a table in a rectangle.
  void (*extent)(const KernelTable&, const KernelRectangle&, float* low, float* high);
};

const BlockKernel& BaselineKernel();
#ifdef LASCAUX_X86_KERNELS
const BlockKernel& Avx2Kernel();
const BlockKernel& Avx512Kernel();
#endif

}  // namespace lascaux::internal
