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

TEST(StructureTime, IsNearlyLinearInThePoints) {
  // The processor's time, the least of some runs: other programs don't count.
  const auto seconds = [](int points) {
    const Sketch sketch = Furry(points);
    double best = 1e9;
    for (int run = 0; run < 3; ++run) {
      const std::clock_t start = std::clock();
      EXPECT_EQ(WrongWithStructureOf(sketch), "");
      best = std::min(best, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    }
    return best;
  };
  const double small = seconds(4'000), large = seconds(32'000);
  std::printf("4000 points %.1f ms, 32000 points %.1f ms\n", 1e3 * small, 1e3 * large);
  // Eight times the points: n^2 would be 64 times, n log n is 10.
  EXPECT_LT(large, 32 * small + 0.05);
}

}  // namespace
}  // namespace lascaux
