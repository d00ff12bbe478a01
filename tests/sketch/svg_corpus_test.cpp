#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "lascaux/sketch/read_svg.h"
#include "sketch/sketch_invariants.h"
#include "support/cases.h"

namespace lascaux {
namespace {

using testing::ForSeeds;
using testing::Random;
using testing::WrongWith;

/// Small, so that entities and uses that grow without bound meet it soon.
constexpr ReadSvgOptions kSmall{.max_bytes = 1u << 20, .max_pieces = 20'000, .max_depth = 60};

struct CorpusFile {
  std::string name, bytes;
};

std::vector<CorpusFile> Corpus() {
  std::vector<CorpusFile> files;
  for (const auto& entry : std::filesystem::directory_iterator(LASCAUX_SVG_CORPUS)) {
    std::ifstream in(entry.path(), std::ios::binary);
    files.push_back({entry.path().filename().string(),
                     {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()}});
  }
  std::sort(files.begin(), files.end(),
            [](const auto& a, const auto& b) { return a.name < b.name; });
  return files;
}

TEST(SvgCorpus, EveryFileGivesASoundSketchOrAnInputError) {
  const std::vector<CorpusFile> corpus = Corpus();
  EXPECT_GE(corpus.size(), 30u);
  for (const CorpusFile& file : corpus)
    EXPECT_EQ(WrongWith(ReadSvg(file.bytes, kSmall)), "") << file.name;
}

TEST(SvgCorpus, EveryTruncatedFileDoes) {
  for (const CorpusFile& file : Corpus()) {
    for (std::size_t n = 0; n < file.bytes.size(); n += 1 + n / 40) {
      ASSERT_EQ(WrongWith(ReadSvg(file.bytes.substr(0, n), kSmall)), "")
          << file.name << " at " << n;
    }
  }
}

TEST(SvgCorpus, EveryDamagedFileDoes) {
  const std::vector<CorpusFile> corpus = Corpus();
  ForSeeds(2000, [&](Random& random) {
    const CorpusFile& file =
        corpus[static_cast<std::size_t>(random.Integer(0, static_cast<int>(corpus.size()) - 1))];
    std::string bytes = file.bytes;
    const int last = static_cast<int>(bytes.size()) - 1;
    for (int i = 0; i < 4 && last >= 0; ++i) {
      const auto at = static_cast<std::size_t>(random.Integer(0, last));
      constexpr std::string_view kInteresting = "<>&;\"'0.-eEzZmaA#,( )\xff";
      bytes[at] = random.Chance(0.2) ? static_cast<char>(random.Integer(0, 255))
                                     : kInteresting[static_cast<std::size_t>(random.Integer(
                                           0, static_cast<int>(kInteresting.size()) - 1))];
    }
    ASSERT_EQ(WrongWith(ReadSvg(bytes, kSmall)), "") << file.name << ":\n" << bytes;
  });
}

}  // namespace
}  // namespace lascaux
