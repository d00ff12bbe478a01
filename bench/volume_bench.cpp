// The volume stages on a body read from a file: a line "ax ay az ra  bx by bz rb  part" a segment.
//
//     bench_volume bench/data/animal.txt [Google Benchmark's options]
//
// The argument after each name is the number of voxels along the longest side.

#include <benchmark/benchmark.h>

#include <iostream>

#include "body.h"
#include "lascaux/field/field.h"
#include "lascaux/volume/check_mesh.h"
#include "lascaux/volume/extract_mesh.h"
#include "lascaux/volume/fidelity.h"
#include "lascaux/volume/level_set.h"
#include "lascaux/volume/render_grids.h"

namespace {

using namespace lascaux;

Field g_field;

double VoxelSize(const benchmark::State& state) {
  return Bounds(g_field).sizes().maxCoeff() / static_cast<double>(state.range(0));
}

openvdb::FloatGrid::Ptr Grid(const benchmark::State& state) {
  auto grid = Rasterise(g_field, {VoxelSize(state)});
  return grid.ok() ? *grid : nullptr;
}

void BM_Rasterise(benchmark::State& state) {
  std::int64_t active = 0;
  for (auto _ : state) {
    const auto grid = Grid(state);
    if (grid == nullptr) return state.SkipWithError("no grid");
    state.PauseTiming();
    active = static_cast<std::int64_t>(grid->activeVoxelCount());
    state.ResumeTiming();
  }
  state.counters["active"] = static_cast<double>(active);
}

void BM_ExtractMesh(benchmark::State& state) {
  const auto grid = Grid(state);
  if (grid == nullptr) return state.SkipWithError("no grid");
  std::size_t triangles = 0;
  for (auto _ : state) triangles = ExtractMesh(*grid)->triangles.size();
  state.counters["triangles"] = static_cast<double>(triangles);
}

void BM_CheckMesh(benchmark::State& state) {
  const auto grid = Grid(state);
  if (grid == nullptr) return state.SkipWithError("no grid");
  const Mesh mesh = *ExtractMesh(*grid);
  for (auto _ : state) benchmark::DoNotOptimize(CheckMesh(mesh));
}

/// A picture of 512 x 512 pixels of a level set in memory.
void BM_Render(benchmark::State& state) {
  const auto grid = Grid(state);
  if (grid == nullptr) return state.SkipWithError("no grid");
  for (auto _ : state) benchmark::DoNotOptimize(Render({grid}));
}

void BM_MeasureFidelity(benchmark::State& state) {
  const auto grid = Grid(state);
  if (grid == nullptr) return state.SkipWithError("no grid");
  const Mesh mesh = *ExtractMesh(*grid);
  const Eigen::AlignedBox3d box = Bounds(g_field);
  const std::vector<std::vector<Eigen::Vector2d>> rings = {{{box.min().x(), box.min().y()},
                                                            {box.max().x(), box.min().y()},
                                                            {box.max().x(), box.max().y()},
                                                            {box.min().x(), box.max().y()}}};
  for (auto _ : state) benchmark::DoNotOptimize(MeasureFidelity(mesh, rings));
}

BENCHMARK(BM_Rasterise)
    ->RangeMultiplier(2)
    ->Range(128, 1024)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(BM_ExtractMesh)
    ->RangeMultiplier(2)
    ->Range(128, 512)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(BM_CheckMesh)
    ->RangeMultiplier(2)
    ->Range(128, 512)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(BM_Render)
    ->Arg(256)
    ->Arg(1024)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime();
BENCHMARK(BM_MeasureFidelity)->Arg(256)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (argc != 2) {
    std::cerr << "usage: bench_volume FILE [--benchmark_...]\n";
    return 2;
  }
  g_field = ReadBody(argv[1], BodyBlend::kParts);
  if (g_field.parts.empty()) {
    std::cerr << argv[1] << ": no segments\n";
    return 3;
  }
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
