#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "lascaux/volume/check_mesh.h"
#include "lascaux/volume/extract_mesh.h"
#include "volume/cell_table.h"
#include "volume/diagonals.h"
#include "volume/envelope.h"
#include "volume/lattice_proof.h"

namespace lascaux {
namespace {

Lattice LatticeOf(const NarrowBand& band) { return {band.origin, band.voxel_size}; }

/// Eight blocks of random values in a shell of voxels outside, off the origin by a grid that is no
/// power of two. The larger `level`, the more of them are outside.
NarrowBand Noise(std::uint32_t seed, float level) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> uniform(-1, 1);
  NarrowBand band;
  band.voxel_size = 0.3;
  band.origin = {0.1, -0.7, 0.2};
  for (int b = 0; b < 8; ++b) {
    const Eigen::Vector3i at =
        8 * (Eigen::Vector3i(b & 1, b >> 1 & 1, b >> 2) - Eigen::Vector3i::Ones());
    band.blocks.push_back(at);
    for (std::size_t i = 0; i < kBlockVoxels; ++i) {
      const Eigen::Vector3i voxel =
          at + Eigen::Vector3i(static_cast<int>(i / 64), static_cast<int>(i / 8 % 8),
                               static_cast<int>(i % 8));
      const bool is_rim = voxel.minCoeff() < -7 || voxel.maxCoeff() > 6;
      float v = uniform(random) + level;
      if (seed % 4 == 1) v = std::copysign(1.0F, v);
      if (seed % 4 == 2) v = v > 0.5F ? 0.0F : v;
      if (seed % 4 == 3) v *= 1e-6F;
      band.values.push_back(is_rim ? 1.0F : v);
    }
    band.active.emplace_back();
  }
  return band;
}

/// A ball in the same blocks: all its vertices are alone in their cells.
NarrowBand Ball(float radius) {
  NarrowBand band = Noise(0, 0);
  for (std::size_t i = 0; i < band.values.size(); ++i) {
    const auto in_block = [i](std::size_t stride) { return static_cast<int>(i / stride % 8); };
    const Eigen::Vector3i voxel =
        band.blocks[i / kBlockVoxels] + Eigen::Vector3i(in_block(64), in_block(8), in_block(1));
    band.values[i] = (voxel.cast<float>() + Eigen::Vector3f(0.41F, 0.57F, 0.32F)).norm() - radius;
  }
  return band;
}

/// How dense the noise is: from single voxels inside to single holes.
float LevelOf(std::uint32_t seed) { return static_cast<float>(seed % 7) * 0.25F - 0.75F; }

TEST(CellTable, EveryPieceIsOneRound) {
  for (int signs = 0; signs < 256; ++signs) {
    const auto bits = static_cast<CellSigns>(signs);
    for (const CellPieces* pieces : {&PiecesApart(bits), &PiecesJoined(bits)}) {
      std::array<int, 4> edges{};
      for (const std::uint8_t piece : pieces->of_edge) {
        if (piece != kNotCrossed) ++edges.at(piece);
      }
      for (std::size_t p = 0; p < 4; ++p) {
        EXPECT_EQ(edges[p] >= 3, p < pieces->count) << signs;
        EXPECT_EQ(edges[p] == 0, p >= pieces->count) << signs;
      }
    }
    // Joined is apart for the opposite signs.
    const CellPieces &joined = PiecesJoined(bits), &apart = PiecesApart(bits);
    EXPECT_EQ(joined.of_edge, PiecesApart(static_cast<CellSigns>(~signs)).of_edge) << signs;
    // What makes an edge of four faces can be cured in both cells: nothing else changes there.
    if (joined.twice != kNoFace) {
      EXPECT_EQ(apart.count, joined.count + 1) << signs;
      EXPECT_EQ(apart.twice, kNoFace) << signs;
    }
  }
}

TEST(AreCutFromFirst, TakesTheShorterDiagonalThatStaysInTheEnvelope) {
  constexpr double kMargin = 1e-3, kRounding = 1e-5;
  std::mt19937 random(3);
  std::uniform_real_distribution<float> uniform(0, 1);
  int longer = 0;
  for (int round = 0; round < 3200; ++round) {
    std::array<SeenCorners, 4> quads;
    for (std::size_t k = 0; k < 4; ++k) {
      for (int i = 0; i < 4; ++i) {
        quads[k].x[i] = uniform(random) - (k == 1 || k == 2 ? 0.0F : 1.0F);
        quads[k].y[i] = uniform(random) - (k >= 2 ? 0.0F : 1.0F);
        quads[k].height[i] = uniform(random);
      }
    }
    const FourInts cuts = AreCutFromFirst(quads, static_cast<float>(kMargin));
    for (int i = 0; i < 4; ++i) {
      std::array<SeenCorner, 4> q;
      for (std::size_t k = 0; k < 4; ++k)
        q[k] = {double{quads[k].x[i]}, double{quads[k].y[i]}, double{quads[k].height[i]}};
      const auto is_good = [&q](bool from_first, double margin) {
        return from_first ? IsInEnvelope({q[0], q[2], q[1], q[3]}, margin)
                          : IsInEnvelope({q[1], q[3], q[2], q[0]}, margin);
      };
      const auto squared_length = [&q](std::size_t a, std::size_t b) {
        return std::pow(q[a].x - q[b].x, 2) + std::pow(q[a].y - q[b].y, 2) +
               std::pow(q[a].height - q[b].height, 2);
      };
      const double excess = squared_length(0, 2) - squared_length(1, 3);
      const bool cut = cuts[i] != 0, shorter = excess <= 0;
      // Where rounding decides, either is right.
      if (is_good(true, kMargin - kRounding) != is_good(true, kMargin + kRounding)) continue;
      if (is_good(false, kMargin - kRounding) != is_good(false, kMargin + kRounding)) continue;
      if (std::abs(excess) < kRounding) continue;
      const bool takes_shorter = is_good(shorter, kMargin) || !is_good(!shorter, kMargin);
      ASSERT_EQ(cut == shorter, takes_shorter) << round << ' ' << i;
      longer += takes_shorter ? 0 : 1;
    }
  }
  EXPECT_GT(longer, 20);
}

TEST(ExtractMesh, NoiseIsOneSolidThatDoesNotRunThroughItself) {
  std::int64_t crossing = 0;
  for (std::uint32_t seed = 0; seed < 200; ++seed) {
    const NarrowBand band = Noise(seed, LevelOf(seed));
    const auto mesh = ExtractMesh(band);
    if (!mesh.ok()) continue;  // nothing is enclosed
    const MeshFacts facts = CheckMesh(*mesh);
    EXPECT_TRUE(facts.closed && facts.manifold && facts.oriented) << "seed " << seed;
    EXPECT_EQ(facts.components, 1) << "seed " << seed;
    EXPECT_EQ(facts.coincident, 0) << "seed " << seed;
    EXPECT_EQ(facts.degenerate, 0) << "seed " << seed;
    EXPECT_EQ(facts.self_intersections, 0) << "seed " << seed;
    crossing += facts.self_intersections.value_or(0);
  }
  EXPECT_EQ(crossing, 0);
}

TEST(ExtractMesh, ACavityAloneIsNoBody) {
  NarrowBand band = Ball(5);
  EXPECT_TRUE(ExtractMesh(band).ok());
  for (float& v : band.values) v = -v;
  const auto mesh = ExtractMesh(band);
  ASSERT_FALSE(mesh.ok());
  EXPECT_EQ(mesh.diagnostics().back().code, "empty-mesh");
}

TEST(CheckMesh, ALatticeChangesNoFact) {
  std::mt19937 random(7);
  int intersecting = 0;
  for (std::uint32_t seed = 0; seed < 36; ++seed) {
    const NarrowBand band = Noise(seed, LevelOf(seed));
    auto mesh = ExtractMesh(band);
    if (!mesh.ok()) continue;
    // Vertices pushed within their cells, out of them, onto each other.
    const float push = 0.3F * 0.5F * static_cast<float>(seed % 5);
    std::uniform_real_distribution<float> uniform(-push, push);
    for (Eigen::Vector3f& v : mesh->vertices)
      v += Eigen::Vector3f(uniform(random), uniform(random), uniform(random));
    if (seed % 6 == 5) mesh->vertices[3] = mesh->vertices[5];
    const MeshFacts facts = CheckMesh(*mesh);
    EXPECT_EQ(CheckMesh(*mesh, LatticeOf(band)), facts) << "seed " << seed;
    EXPECT_EQ(CheckMesh(*mesh, Lattice{Eigen::Vector3d(0.03, 0, 0), 0.17}), facts) << seed;
    intersecting += facts.self_intersections.value_or(0) > 0 ? 1 : 0;
  }
  EXPECT_GT(intersecting, 12);
}

/// What can go wrong with a mesh, one thing at a time.
const std::vector<std::function<void(Mesh&, std::size_t)>> kDamages = {
    [](Mesh& m, std::size_t t) { std::swap(m.triangles[t][0], m.triangles[t][1]); },  // flipped
    [](Mesh& m, std::size_t t) {
      m.triangles.erase(m.triangles.begin() + static_cast<std::ptrdiff_t>(t));
    },
    [](Mesh& m, std::size_t t) {  // a quadrilateral
      const auto at = m.triangles.begin() + static_cast<std::ptrdiff_t>(t & ~std::size_t{1});
      m.triangles.erase(at, at + 2);
    },
    [](Mesh& m, std::size_t t) {  // turned around
      for (const std::size_t k : {t & ~std::size_t{1}, t | 1})
        std::swap(m.triangles[k][1], m.triangles[k][2]);
    },
    [](Mesh& m, std::size_t t) { m.triangles.push_back(m.triangles[t]); },
    [](Mesh& m, std::size_t t) {  // both halves twice
      const std::size_t first = t & ~std::size_t{1};
      const auto quad = std::array{m.triangles[first], m.triangles[first + 1]};
      m.triangles.insert(m.triangles.end(), quad.begin(), quad.end());
    },
    [](Mesh& m, std::size_t t) {  // the halves of two quadrilaterals, each in the other
      if (t + 2 < m.triangles.size()) std::swap(m.triangles[t], m.triangles[t + 2]);
    },
    [](Mesh& m, std::size_t t) {  // two fans at one vertex
      const std::uint32_t from = m.triangles[t][0], to = m.triangles[m.triangles.size() - 1 - t][1];
      for (auto& corners : m.triangles)
        for (std::uint32_t& v : corners)
          if (v == from) v = to;
    },
    [](Mesh& m, std::size_t t) { m.triangles[t][1] = m.triangles[m.triangles.size() - 1 - t][1]; },
    [](Mesh& m, std::size_t t) { m.triangles[t][1] = m.triangles[t][0]; },
    [](Mesh& m, std::size_t) { m.vertices.push_back(m.vertices.back()); },
    [](Mesh& m, std::size_t) { m.vertices.emplace_back(50.0F, 50.0F, 50.0F); },
    [](Mesh& m, std::size_t t) { m.vertices[m.triangles[t][0]] = m.vertices[m.triangles[t][1]]; },
    [](Mesh& m, std::size_t t) { m.vertices[m.triangles[t][0]].x() += 0.2F; },
    [](Mesh& m, std::size_t t) { m.vertices[m.triangles[t][0]] += Eigen::Vector3f(0, 3, 3); },
    [](Mesh& m, std::size_t t) {  // numbers in another order
      const std::uint32_t a = m.triangles[t][0], b = m.triangles[t][2];
      std::swap(m.vertices[a], m.vertices[b]);
      for (auto& corners : m.triangles)
        for (std::uint32_t& v : corners) v = v == a ? b : v == b ? a : v;
    },
};

TEST(CheckMesh, ALatticeHidesNoDamage) {
  std::mt19937 random(11);
  std::int64_t bad = 0, all = 0;
  for (const bool noise : {false, true}) {
    for (std::uint32_t seed = 0; seed < 2; ++seed) {
      const NarrowBand band =
          noise ? Noise(4 * seed, 0.4F) : Ball(5.3F - 0.4F * static_cast<float>(seed));
      const auto good = ExtractMesh(band);
      ASSERT_TRUE(good.ok());
      ASSERT_TRUE(CheckMesh(*good, LatticeOf(band)).IsPrintable());
      const auto proof = ProveByLattice(*good, LatticeOf(band));
      ASSERT_TRUE(proof && proof->closed_fans);
      EXPECT_LT(proof->doubtful.size(), good->triangles.size());
      for (std::size_t d = 0; d < kDamages.size(); ++d) {
        for (int round = 0; round < 3; ++round) {
          Mesh mesh = *good;
          kDamages[d](mesh, random() % mesh.triangles.size());
          const MeshFacts facts = CheckMesh(mesh);
          ASSERT_EQ(CheckMesh(mesh, LatticeOf(band)), facts)
              << "noise " << noise << ", seed " << seed << ", damage " << d << ", round " << round;
          bad += facts.IsPrintable() ? 0 : 1;
          ++all;
        }
      }
    }
  }
  EXPECT_GT(bad, all * 3 / 4);  // some change nothing that counts
}

}  // namespace
}  // namespace lascaux
