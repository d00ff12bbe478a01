#include <benchmark/benchmark.h>

#include <Eigen/Core>
#include <numeric>
#include <random>
#include <span>
#include <vector>

#include "lascaux/field/compiled_field.h"

/// @file
/// How many segments a second one core evaluates, at points that all lie within reach of the
/// segments.

namespace lascaux {
namespace {

constexpr int kSegments = 100;
constexpr int kPoints = 512;  ///< one leaf of a grid

/// One chain of short pieces in a ball of about one radius, so that every primitive reaches every
/// point.
Field Tangle(int parts) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-0.5, 0.5);
  const auto place = [&] {
    return Eigen::Vector3d(uniform(random), uniform(random), uniform(random));
  };
  Field field;
  for (int p = 0; p < parts; ++p) {
    FieldChain chain;
    for (int i = 0; i < kSegments / parts; ++i) {
      chain.segments.push_back(
          {place(), place(), 1 + 0.3 * uniform(random), 1 + 0.3 * uniform(random)});
    }
    FieldPart part;
    part.chains.push_back(chain);
    if (p > 0) part.parent = 0;
    field.parts.push_back(part);
  }
  return field;
}

struct Leaf {
  std::vector<float> x, y, z, value, gx, gy, gz, distance;

  explicit Leaf(unsigned seed = 0) {
    std::mt19937 random(2 + seed);
    std::uniform_real_distribution<float> uniform(-0.5f, 0.5f);
    for (std::vector<float>* column : {&x, &y, &z, &value, &gx, &gy, &gz, &distance}) {
      column->resize(kPoints);
      for (float& v : *column) v = uniform(random);
    }
  }
  PointBlock points() const { return {Eigen::Vector3d::Zero(), x, y, z}; }
  SampleBlock samples() { return {value, gx, gy, gz}; }
};

bool Skips(benchmark::State& state, Isa isa) {
  if (!IsSupported(isa)) state.SkipWithError("not on this processor");
  return !IsSupported(isa);
}

void CountSegments(benchmark::State& state) {
  state.counters["segments"] = benchmark::Counter(
      static_cast<double>(state.iterations()) * kSegments * kPoints, benchmark::Counter::kIsRate);
}

void Values(benchmark::State& state, Isa isa, int parts) {
  if (Skips(state, isa)) return;
  const CompiledField field(Tangle(parts), isa);
  const ActiveSet all = field.All();
  Leaf leaf;
  for (auto _ : state) {
    field.EvaluateValues(leaf.points(), all, leaf.value);
    benchmark::DoNotOptimize(leaf.value.data());
  }
  CountSegments(state);
}

void Samples(benchmark::State& state, Isa isa, int parts) {
  if (Skips(state, isa)) return;
  const CompiledField field(Tangle(parts), isa);
  const ActiveSet all = field.All();
  Leaf leaf;
  for (auto _ : state) {
    field.EvaluateSamples(leaf.points(), all, leaf.samples());
    benchmark::DoNotOptimize(leaf.value.data());
  }
  CountSegments(state);
}

/// 100 segments at a million points: as many leaves, with points of their own, as that takes.
void MillionPoints(benchmark::State& state, Isa isa) {
  if (Skips(state, isa)) return;
  const CompiledField field(Tangle(1), isa);
  const ActiveSet all = field.All();
  constexpr int kLeaves = (1'000'000 + kPoints - 1) / kPoints;
  std::vector<Leaf> leaves;
  for (unsigned i = 0; i < kLeaves; ++i) leaves.emplace_back(i);
  for (auto _ : state) {
    for (Leaf& leaf : leaves) field.EvaluateValues(leaf.points(), all, leaf.value);
    benchmark::ClobberMemory();
  }
  state.counters["segments"] =
      benchmark::Counter(static_cast<double>(state.iterations()) * kSegments * kPoints * kLeaves,
                         benchmark::Counter::kIsRate);
}

void DoublePrecision(benchmark::State& state) {
  const Field field = Tangle(1);
  const std::vector<Segment>& segments = field.parts[0].chains[0].segments;
  const Leaf leaf;
  std::size_t i = 0;
  for (auto _ : state) {
    i = (i + 1) % kPoints;
    const Eigen::Vector3d point(leaf.x[i], leaf.y[i], leaf.z[i]);
    for (const Segment& segment : segments) {
      FieldSample sample = Evaluate(segment, point);
      benchmark::DoNotOptimize(sample);
    }
  }
  state.counters["segments"] = benchmark::Counter(
      static_cast<double>(state.iterations()) * kSegments, benchmark::Counter::kIsRate);
}

void Bounds(benchmark::State& state, Isa isa) {
  if (Skips(state, isa)) return;
  const CompiledField field(Tangle(1), isa);
  const ActiveSet all = field.All();
  ActiveSet reuse;
  for (auto _ : state) {
    BallBounds found = field.BoundOnBall({{0.1, 0.8, 0.3}, 0.2}, all, std::move(reuse));
    benchmark::DoNotOptimize(found.bounds);
    reuse = std::move(found.active);
  }
  state.counters["segments"] = benchmark::Counter(
      static_cast<double>(state.iterations()) * kSegments, benchmark::Counter::kIsRate);
}

void Distances(benchmark::State& state, Isa isa) {
  if (Skips(state, isa)) return;
  Leaf leaf;
  for (float& v : leaf.value) v += 1;
  for (auto _ : state) {
    SignedDistances(leaf.samples(), 0.2f, leaf.distance, isa);
    benchmark::DoNotOptimize(leaf.distance.data());
  }
  state.counters["points"] = benchmark::Counter(static_cast<double>(state.iterations()) * kPoints,
                                                benchmark::Counter::kIsRate);
}

BENCHMARK(DoublePrecision);
BENCHMARK_CAPTURE(Values, baseline, Isa::kBaseline, 1);
BENCHMARK_CAPTURE(Values, avx2, Isa::kAvx2, 1);
BENCHMARK_CAPTURE(Values, avx512, Isa::kAvx512, 1);
BENCHMARK_CAPTURE(MillionPoints, baseline, Isa::kBaseline)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(MillionPoints, avx2, Isa::kAvx2)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(MillionPoints, avx512, Isa::kAvx512)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Samples, baseline, Isa::kBaseline, 1);
BENCHMARK_CAPTURE(Samples, avx2, Isa::kAvx2, 1);
BENCHMARK_CAPTURE(Samples, avx512, Isa::kAvx512, 1);
BENCHMARK_CAPTURE(Samples, avx2_10_parts, Isa::kAvx2, 10);
BENCHMARK_CAPTURE(Samples, avx512_10_parts, Isa::kAvx512, 10);
BENCHMARK_CAPTURE(Bounds, baseline, Isa::kBaseline);
BENCHMARK_CAPTURE(Bounds, avx2, Isa::kAvx2);
BENCHMARK_CAPTURE(Bounds, avx512, Isa::kAvx512);
BENCHMARK_CAPTURE(Distances, baseline, Isa::kBaseline);
BENCHMARK_CAPTURE(Distances, avx2, Isa::kAvx2);
BENCHMARK_CAPTURE(Distances, avx512, Isa::kAvx512);

}  // namespace
}  // namespace lascaux

BENCHMARK_MAIN();
