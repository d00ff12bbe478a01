#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "lascaux/volume/narrow_band.h"

namespace lascaux {
namespace {

using std::numbers::pi;

// The whole band of a block must fit beside a thin part: that many voxels are added to each radius.
constexpr double kBandRadius = 4;
// Blocks that the bounds leave in doubt, for each voxel face of surface: 0.03 to 0.05 were
// measured.
constexpr double kBlocksPerFace = 0.06;
// A block's leaf (2.1 KB), three arrays of distances (6.1 KB), its list of primitives, and what the
// mesher needs for about 50 quadrilaterals (8 KB).
constexpr double kBytesPerBlock = 18e3;
constexpr double kFixedBytes = 16e6;  // OpenVDB's upper nodes, tables of the threads

double AreaOf(const FieldChain& chain, double margin) {
  double area = 0, largest = 0;
  for (const Segment& s : chain.segments) {
    const double radius = std::max(s.radius_a, s.radius_b);
    largest = std::max(largest, radius);
    area += 2 * pi * (radius + margin) * (s.b - s.a).norm();
  }
  // Ends without a point are rounded too.
  if (chain.points.empty()) area += 4 * pi * (largest + margin) * (largest + margin);
  for (const PointPrimitive& p : chain.points) {
    area += 4 * pi * (p.radius + margin) * (p.radius + margin);
  }
  return area;
}

double MostDepthScale(const FieldPart& part) {
  if (!part.depth) return part.depth_scale;
  return 1 / static_cast<double>(
                 *std::min_element(part.depth->steepness.begin(), part.depth->steepness.end()));
}

}  // namespace

std::size_t EstimateBytes(const Field& field, const RasteriseOptions& options) {
  const double h = options.voxel_size;
  double area = 0;
  for (const FieldPart& part : field.parts) {
    for (const FieldChain& chain : part.chains) {
      area += std::max(1.0, MostDepthScale(part)) * AreaOf(chain, kBandRadius * h);
    }
  }
  const double bytes = kFixedBytes + kBytesPerBlock * kBlocksPerFace * area / (h * h);
  constexpr auto kMost = std::numeric_limits<std::size_t>::max();
  return bytes < 1e18 ? static_cast<std::size_t>(bytes) : kMost;
}

}  // namespace lascaux
