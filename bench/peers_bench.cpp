// The volume stages beside what else does the same, on one body, as JSON: milliseconds, medians.
//
//     bench_peers bench/data/animal.txt [RESOLUTION...] [--dense FILE]
//
// scripts/bench.py runs it and prints the ratios. --dense writes the field on a grid of all voxels
// of the first resolution, for peers that want one: three 32-bit sizes (z fastest), then floats.

#include <openvdb/tools/ParticlesToLevelSet.h>
#include <openvdb/tools/VolumeToMesh.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <fstream>
#include <functional>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "body.h"
#include "lascaux/field/compiled_field.h"
#include "lascaux/volume/check_mesh.h"
#include "lascaux/volume/extract_mesh.h"
#include "lascaux/volume/level_set.h"
#include "volume/band.h"
#include "volume/find_blocks.h"

namespace {

using namespace lascaux;
using Clock = std::chrono::steady_clock;

double MillisecondsOf(const std::function<void()>& work) {
  const auto start = Clock::now();
  work();
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// Median of as many runs as fit in about a second, five at least, or three of what takes long.
double Median(const std::function<void()>& work) {
  std::vector<double> runs;
  double total = 0;
  while (runs.size() < 3 || (runs.size() < 5 && total < 5000) ||
         (total < 1000 && runs.size() < 31)) {
    runs.push_back(MillisecondsOf(work));
    total += runs.back();
  }
  std::nth_element(runs.begin(), runs.begin() + static_cast<std::ptrdiff_t>(runs.size() / 2),
                   runs.end());
  return runs[runs.size() / 2];
}

#if defined(__x86_64__)
using Wide [[gnu::vector_size(64)]] = float;

/// So many fused multiplications and additions of 16 numbers that the unit is never idle.
[[gnu::target("avx512f,fma")]] float MultiplyAndAdd(int rounds) {
  std::array<Wide, 16> sums;  // all different, or one chain would do for all
  for (std::size_t k = 0; k < sums.size(); ++k) sums[k] = Wide{} + static_cast<float>(k);
  const Wide factor = Wide{} + 0.999F, term = Wide{} + 1e-3F;
  for (int i = 0; i < rounds; ++i) {
    for (Wide& sum : sums) sum = sum * factor + term;
  }
  float total = 0;
  for (const Wide& sum : sums) total += sum[0];
  return total;
}

/// Most floating-point operations that two threads do in a millisecond; 0 where not known.
double OperationsAMillisecond() {
  if (!IsSupported(Isa::kAvx512)) return 0;
  constexpr int kRounds = 2'000'000;
  const auto work = [] {
    const float result = MultiplyAndAdd(kRounds);
    asm volatile("" : : "m"(result));  // somebody reads it, or it would not be computed
  };
  const double elapsed = Median([&] {
    std::thread other(work);
    work();
    other.join();
  });
  return 2.0 * kRounds * 16 * 16 * 2 / elapsed;
}
#else
double OperationsAMillisecond() { return 0; }
#endif

/// Mean number of segments whose field reaches an active voxel, from every 64th.
double SegmentsAVoxel(const Field& field, const NarrowBand& band) {
  double sum = 0;
  int count = 0;
  for (std::size_t b = 0; b < band.size(); ++b) {
    for (std::size_t i = b % 64; i < kBlockVoxels; i += 64) {
      if ((band.active[b][i / 64] >> i % 64 & 1) == 0) continue;
      const Eigen::Vector3i in_block(static_cast<int>(i / 64), static_cast<int>(i / 8 % 8),
                                     static_cast<int>(i % 8));
      const Eigen::Vector3d p =
          band.origin + band.voxel_size * (band.blocks[b] + in_block).cast<double>();
      for (const Segment& s : field.parts[0].chains[0].segments) sum += Evaluate(s, p).value > 0;
      ++count;
    }
  }
  return sum / count;
}

// Of a value and its gradient, by hand.
constexpr double kOperationsASegment = 130;

/// Distances of the mesh's vertices from the exact surface, in voxels: the 99th percentile of every
/// 16th.
double VertexDistance(const Field& field, const Mesh& mesh, double voxel_size) {
  std::vector<double> distances(mesh.vertices.size() / 16);
  if (distances.empty()) return 0;
  tbb::parallel_for(std::size_t{0}, distances.size(), [&](std::size_t i) {
    const FieldSample sample = Evaluate(field, mesh.vertices[16 * i].cast<double>());
    distances[i] = std::abs(SignedDistance(sample)) / voxel_size;
  });
  const auto at =
      distances.begin() + static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(distances.size()));
  std::nth_element(distances.begin(), at, distances.end());
  return *at;
}

void EvaluateAllBlocks(const Field& field, double voxel_size) {
  const CompiledField compiled(field);
  BlockSearch search;
  search.voxel_size = voxel_size;
  search.margin = kBandVoxels + 0.5;
  search.upper_half = false;
  const FoundBlocks found = FindBlocks(compiled, search, {});
  FindInside({compiled, found.blocks, voxel_size}, {});
}

/// Spheres so close that their union has the segments' shape to a tenth of a voxel.
struct Spheres {
  using PosType = openvdb::Vec3R;
  std::vector<std::pair<openvdb::Vec3R, openvdb::Real>> all;

  std::size_t size() const { return all.size(); }
  void getPos(std::size_t n, openvdb::Vec3R& at) const { at = all[n].first; }
  void getPosRad(std::size_t n, openvdb::Vec3R& at, openvdb::Real& radius) const {
    std::tie(at, radius) = all[n];
  }
};

Spheres SweptSpheres(const Field& field, double voxel_size) {
  Spheres spheres;
  for (const Segment& s : field.parts[0].chains[0].segments) {
    const double step = std::sqrt(8 * 0.1 * voxel_size * std::min(s.radius_a, s.radius_b));
    const int count = std::max(1, static_cast<int>(std::ceil((s.b - s.a).norm() / step)));
    for (int k = 0; k <= count; ++k) {
      const double t = static_cast<double>(k) / count;
      const Eigen::Vector3d p = s.a + t * (s.b - s.a);
      spheres.all.push_back({{p.x(), p.y(), p.z()}, s.radius_a + t * (s.radius_b - s.radius_a)});
    }
  }
  return spheres;
}

openvdb::FloatGrid::Ptr ByParticles(const Spheres& spheres, double voxel_size) {
  const auto grid = openvdb::createLevelSet<openvdb::FloatGrid>(static_cast<float>(voxel_size), 3);
  openvdb::tools::ParticlesToLevelSet<openvdb::FloatGrid> raster(*grid);
  raster.setGrainSize(1);
  raster.rasterizeSpheres(spheres);
  raster.finalize(true);
  return grid;
}

void MeshByOpenVdb(const openvdb::FloatGrid& grid) {
  std::vector<openvdb::Vec3s> points;
  std::vector<openvdb::Vec4I> quads;
  openvdb::tools::volumeToMesh(grid, points, quads, 0.0);
}

/// All voxels of the body's box.
struct Dense {
  std::array<std::int32_t, 3> size{};
  std::vector<float> values;
};

Dense EvaluateDensely(const Field& field, double voxel_size) {
  const CompiledField compiled(field);
  const ActiveSet all = compiled.All();
  const Eigen::AlignedBox3d box = Bounds(field);
  Dense dense;
  for (int axis = 0; axis < 3; ++axis)
    dense.size[static_cast<std::size_t>(axis)] =
        static_cast<std::int32_t>(std::ceil(box.sizes()[axis] / voxel_size)) + 1;
  const auto [nx, ny, nz] = dense.size;
  const auto row = static_cast<std::size_t>(nz);
  dense.values.resize(static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny) * row);
  tbb::parallel_for(0, nx * ny, [&](int line) {
    const Eigen::Vector3d start = box.min() + voxel_size * Eigen::Vector3d(line / ny, line % ny, 0);
    std::vector<float> zero(row, 0), z(row);
    for (std::size_t k = 0; k < row; ++k)
      z[k] = static_cast<float>(voxel_size * static_cast<double>(k));
    compiled.EvaluateValues(
        {start, zero, zero, z}, all,
        std::span(dense.values).subspan(static_cast<std::size_t>(line) * row, row));
  });
  return dense;
}

void Write(const Dense& dense, const std::string& path) {
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(dense.size.data()), sizeof dense.size);
  file.write(reinterpret_cast<const char*>(dense.values.data()),
             static_cast<std::streamsize>(dense.values.size() * sizeof(float)));
}

nlohmann::json Measure(const Field& sum, int resolution, double operations) {
  const double h = Bounds(sum).sizes().maxCoeff() / resolution;
  const NarrowBand band = *RasteriseBand(sum, {h});
  const auto grid = ToLevelSet(band);
  const Mesh mesh = *ExtractMesh(band);
  nlohmann::json ms;
  ms["blocks"] = Median([&] { EvaluateAllBlocks(sum, h); });
  {
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    ms["blocks_one_thread"] = Median([&] { EvaluateAllBlocks(sum, h); });
    ms["rasterise_one_thread"] = Median([&] { (void)RasteriseBand(sum, {h}); });
  }
  ms["rasterise"] = Median([&] { (void)RasteriseBand(sum, {h}); });
  ms["mesh"] = Median([&] { (void)ExtractMesh(band); });
  ms["mesh_on_surface"] = Median([&] { (void)ExtractMesh(band, sum); });
  ms["check"] = Median([&] { (void)CheckMesh(mesh, {band.origin, band.voxel_size}); });
  ms["volume_to_mesh"] = Median([&] { MeshByOpenVdb(*grid); });
  if (operations > 0) {
    ms["floor"] = static_cast<double>(CountActive(band)) * SegmentsAVoxel(sum, band) *
                  kOperationsASegment / operations;
  }
  const Spheres spheres = SweptSpheres(sum, h);
  if (resolution <= 1024) {
    const auto union_grid = ByParticles(spheres, h);
    ms["particles"] = Median([&] { ByParticles(spheres, h); });
    ms["particles_mesh"] = Median([&] { MeshByOpenVdb(*union_grid); });
  }
  if (resolution <= 512) ms["dense"] = Median([&] { EvaluateDensely(sum, h); });
  return {{"resolution", resolution},
          {"active_voxels", CountActive(band)},
          {"triangles", mesh.triangles.size()},
          {"vertex_distance", VertexDistance(sum, *ExtractMesh(band, sum), h)},
          {"ms", ms}};
}

}  // namespace

int main(int argc, char** argv) {
  std::string body, dense;
  std::vector<int> resolutions;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--dense") == 0 && i + 1 < argc) {
      dense = argv[++i];
    } else if (body.empty()) {
      body = argv[i];
    } else {
      resolutions.push_back(std::atoi(argv[i]));
    }
  }
  const Field field = ReadBody(body, BodyBlend::kPlainSum);
  if (field.parts.empty() || resolutions.empty()) {
    std::cerr << "usage: bench_peers BODY RESOLUTION... [--dense FILE]\n";
    return 2;
  }
  openvdb::initialize();
  const double operations = OperationsAMillisecond();
  nlohmann::json result = {{"operations_per_ms", operations}, {"runs", nlohmann::json::array()}};
  for (const int resolution : resolutions)
    result["runs"].push_back(Measure(field, resolution, operations));
  if (!dense.empty())
    Write(EvaluateDensely(field, Bounds(field).sizes().maxCoeff() / resolutions.front()), dense);
  std::cout << result.dump(1) << '\n';
}
