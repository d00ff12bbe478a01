#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>
#include <string>
#include <vector>

#include "sketch/structure_invariants.h"
#include "support/cases.h"

namespace lascaux {
namespace {

using testing::ForSeeds;
using testing::Random;
using testing::SketchFrom;
using testing::WrongWithStructureOf;

struct CorpusFile {
  std::string name;
  std::vector<std::uint8_t> bytes;
};

std::vector<CorpusFile> Corpus() {
  std::vector<CorpusFile> files;
  for (const auto& entry : std::filesystem::directory_iterator(LASCAUX_STRUCTURE_CORPUS)) {
    std::ifstream in(entry.path(), std::ios::binary);
    files.push_back({entry.path().filename().string(),
                     {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()}});
  }
  std::sort(files.begin(), files.end(),
            [](const auto& a, const auto& b) { return a.name < b.name; });
  return files;
}

TEST(StructureCorpus, EveryFileGivesASoundStructureOrAnError) {
  const std::vector<CorpusFile> corpus = Corpus();
  EXPECT_GE(corpus.size(), 20u);
  for (const CorpusFile& file : corpus) {
    EXPECT_EQ(WrongWithStructureOf(SketchFrom(file.bytes.data(), file.bytes.size())), "")
        << file.name;
  }
}

TEST(StructureCorpus, EveryDamagedFileDoes) {
  const std::vector<CorpusFile> corpus = Corpus();
  ForSeeds(200, [&](Random& random) {
    const int pick = random.Integer(0, static_cast<int>(corpus.size()) - 1);
    std::vector<std::uint8_t> bytes = corpus[static_cast<std::size_t>(pick)].bytes;
    const int last = static_cast<int>(bytes.size()) - 1;
    for (int i = 0; i < 5 && last >= 0; ++i) {
      bytes[static_cast<std::size_t>(random.Integer(0, last))] =
          static_cast<std::uint8_t>(random.Integer(0, 255));
    }
    ASSERT_EQ(WrongWithStructureOf(SketchFrom(bytes.data(), bytes.size())), "")
        << corpus[static_cast<std::size_t>(pick)].name;
  });
}

/// A wobbling ring of that many points, with some hairs beside it.
Sketch Furry(int points) {
  Sketch sketch;
  Stroke ring;
  ring.closed = true;
  ring.width = 0.01;
  const auto at = [&](int i, double radius) {
    const double angle = 2 * std::numbers::pi * i / points;
    return Eigen::Vector2d(radius * std::cos(angle), radius * std::sin(angle));
  };
  for (int i = 0; i < points; ++i) {
    const auto radius = [&](int k) { return 100 + 0.05 * std::sin(900.0 * (k % points) / points); };
    ring.pieces.push_back(Line(at(i, radius(i)), at((i + 1) % points, radius(i + 1))));
  }
  sketch.strokes.push_back(ring);
  constexpr int kHairs = 40;
  for (int i = 0; i < points; i += points / kHairs) {
    Stroke hair;
    hair.width = 0.01;
    hair.pieces.push_back(Line(at(i, 101), at(i, 104)));
    sketch.strokes.push_back(hair);
  }
  return sketch;
}

Stroke Polyline(const std::vector<Eigen::Vector2d>& points) {
  Stroke stroke;
  stroke.width = 0.01;
  for (std::size_t i = 0; i + 1 < points.size(); ++i)
    stroke.pieces.push_back(Line(points[i], points[i + 1]));
  return stroke;
}

/// A comb of one line that encloses nothing: many long lines side by side, all of them upright.
Sketch Comb(int points) {
  std::vector<Eigen::Vector2d> line;
  for (int i = 0; i < points; ++i) line.emplace_back(200.0 * (i / 2) / points, i % 4 < 2 ? 0 : 100);
  return {.strokes = {Polyline(line)}};
}

/// Hairs that stand upright on an arc, which leaves the outline open.
Sketch OpenFur(int hairs) {
  Sketch sketch;
  std::vector<Eigen::Vector2d> back;
  for (int i = 0; i < hairs; ++i) {
    const double angle = std::numbers::pi * i / hairs;
    back.emplace_back(100 * std::cos(angle), 20 * std::sin(angle));
    sketch.strokes.push_back(Polyline({back.back(), back.back() + Eigen::Vector2d(0.3, 6)}));
  }
  sketch.strokes.push_back(Polyline(back));
  return sketch;
}

/// The processor's time, the least of some runs: other programs don't count.
double SecondsFor(const Sketch& sketch) {
  double best = 1e9;
  for (int run = 0; run < 3; ++run) {
    const std::clock_t start = std::clock();
    EXPECT_EQ(WrongWithStructureOf(sketch), "");
    best = std::min(best, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  return best;
}

/// Eight times the points: n^2 would be 64 times, n log n is 10.
template <typename Draw>
void ExpectNearlyLinear(const char* name, int points, Draw draw) {
  const double small = SecondsFor(draw(points)), large = SecondsFor(draw(8 * points));
  std::printf("%s: %d points %.1f ms, %d points %.1f ms\n", name, points, 1e3 * small, 8 * points,
              1e3 * large);
  EXPECT_LT(large, 32 * small + 0.05) << name;
}

TEST(StructureTime, IsNearlyLinearInThePoints) {
  ExpectNearlyLinear("ring with hairs", 4'000, Furry);
}

TEST(StructureTime, IsNearlyLinearForDrawingsThatAreRefused) {
  ASSERT_FALSE(BuildPlanarMap(Comb(64)));
  ASSERT_FALSE(BuildPlanarMap(OpenFur(64)));
  ExpectNearlyLinear("comb", 64, Comb);
  ExpectNearlyLinear("open fur", 250, OpenFur);
}

}  // namespace
}  // namespace lascaux
