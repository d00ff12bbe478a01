#include "lascaux/volume/check_mesh.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <string>

#include "volume/exact_predicates.h"
#include "volume/shapes.h"
#include "volume/triangle_pair.h"

namespace lascaux {
namespace {

using testing::CancelledBy;
using testing::InsideOut;
using testing::Moved;
using testing::OnThreads;
using testing::Sphere;
using testing::Tetrahedron;
using testing::Together;
using testing::Torus;

/// The codes of a mesh's defects, with spaces between.
std::string Defects(const Mesh& mesh) {
  const MeshFacts facts = CheckMesh(mesh);
  const Diagnostics defects = MeshDefects(facts);
  EXPECT_EQ(facts.IsPrintable(), defects.empty());
  std::string codes;
  for (const Diagnostic& d : defects) {
    EXPECT_EQ(d.failure, FailureKind::kMesh);
    codes += (codes.empty() ? "" : " ") + d.code;
  }
  return codes;
}

TEST(CheckMesh, FindsNothingWrongWithGoodSolids) {
  EXPECT_EQ(Defects(Tetrahedron()), "");
  EXPECT_EQ(Defects(Sphere(4)), "");
  EXPECT_EQ(Defects(Torus(60)), "");
  EXPECT_EQ(Defects(Moved(Sphere(5, 1e-3F), 0.5F, 0.25F, -0.1F)), "");
}

TEST(CheckMesh, MeasuresASphere) {
  const MeshFacts facts = CheckMesh(Sphere(6, 2));
  EXPECT_EQ(facts.triangles, 8 << 12);
  EXPECT_EQ(facts.vertices, facts.triangles / 2 + 2);
  EXPECT_EQ(facts.genus, 0);
  EXPECT_EQ(facts.self_intersections, 0);
  EXPECT_NEAR(facts.volume, 4.0 / 3 * std::numbers::pi * 8, 0.02);
  EXPECT_NEAR(facts.area, 4 * std::numbers::pi * 4, 0.02);
}

TEST(CheckMesh, ATorusHasGenusOne) { EXPECT_EQ(CheckMesh(Torus(20)).genus, 1); }

TEST(CheckMesh, AHoleIsOpen) {
  Mesh mesh = Sphere(2);
  mesh.triangles.pop_back();
  EXPECT_EQ(Defects(mesh), "mesh-open mesh-not-oriented");
  EXPECT_EQ(CheckMesh(mesh).genus, std::nullopt);
}

TEST(CheckMesh, AFlippedTriangleIsNotOriented) {
  Mesh mesh = Sphere(2);
  std::swap(mesh.triangles[7][0], mesh.triangles[7][1]);
  EXPECT_EQ(Defects(mesh), "mesh-not-oriented");
}

TEST(CheckMesh, AnInsideOutSolidIsNotOriented) {
  EXPECT_EQ(Defects(InsideOut(Sphere(2))), "mesh-not-oriented");
}

TEST(CheckMesh, ADuplicateTriangleIsNotManifoldAndOverlaps) {
  Mesh mesh = Sphere(2);
  mesh.triangles.push_back(mesh.triangles[5]);
  EXPECT_EQ(Defects(mesh), "mesh-open mesh-not-manifold mesh-not-oriented mesh-self-intersects");
  // Twice, once from each side: every edge is balanced again.
  mesh.triangles.push_back({mesh.triangles[5][0], mesh.triangles[5][2], mesh.triangles[5][1]});
  mesh.triangles.push_back({mesh.triangles[5][0], mesh.triangles[5][2], mesh.triangles[5][1]});
  EXPECT_EQ(CheckMesh(mesh).manifold, false);
}

TEST(CheckMesh, AnEdgeWithFourTrianglesIsNotManifold) {
  // Two tetrahedra on opposite sides of the x axis have the edge 0-1 in common.
  Mesh mesh = Tetrahedron();
  mesh.vertices.insert(mesh.vertices.end(), {{0, -1, 0}, {0, 0, -1}});
  mesh.triangles.insert(mesh.triangles.end(), {{0, 4, 1}, {0, 5, 4}, {0, 1, 5}, {1, 4, 5}});
  EXPECT_EQ(Defects(mesh), "mesh-not-manifold");
}

TEST(CheckMesh, TwoFansAtAVertexAreNotManifold) {
  Mesh mesh = Tetrahedron();
  mesh.vertices.insert(mesh.vertices.end(), {{-1, 0, 0}, {0, -1, 0}, {0, 0, -1}});
  mesh.triangles.insert(mesh.triangles.end(), {{0, 4, 5}, {0, 5, 6}, {0, 6, 4}, {4, 6, 5}});
  EXPECT_EQ(Defects(mesh), "mesh-not-manifold");
}

TEST(CheckMesh, AVertexOfNoTriangleIsNotManifold) {
  Mesh mesh = Tetrahedron();
  mesh.vertices.emplace_back(5, 5, 5);
  EXPECT_EQ(Defects(mesh), "mesh-not-manifold");
}

TEST(CheckMesh, TwoComponentsAreTwoPieces) {
  EXPECT_EQ(Defects(Together(Sphere(2), Moved(Sphere(2), 3, 0, 0))), "mesh-in-pieces");
  EXPECT_EQ(CheckMesh(Together(Sphere(2), Moved(Sphere(2), 3, 0, 0))).components, 2);
}

TEST(CheckMesh, ACavityIsAnInwardPiece) {
  EXPECT_EQ(Defects(Together(Sphere(2), InsideOut(Sphere(2, 0.5F)))),
            "mesh-not-oriented mesh-in-pieces");
}

TEST(CheckMesh, APokedOutCornerIntersectsTheOtherSide) {
  Mesh mesh = Sphere(3);
  mesh.vertices[0] = {-1.5F, 0.01F, 0.02F};  // the corner at +x, pulled through the sphere
  EXPECT_EQ(Defects(mesh), "mesh-self-intersects");
}

TEST(CheckMesh, InterpenetratingSpheresIntersect) {
  const Mesh mesh = Together(Sphere(3), Moved(Sphere(3), 1, 0.1F, 0.2F));
  EXPECT_EQ(Defects(mesh), "mesh-self-intersects mesh-in-pieces");
}

TEST(CheckMesh, AFoldedTriangleOverlapsItsNeighbour) {
  // A flat pyramid whose apex is pulled over a side of its base, in the plane of the base.
  Mesh mesh = {
      {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {1, -1, 0}, {1, 1, -1}},
      {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}, {1, 0, 5}, {2, 1, 5}, {3, 2, 5}, {0, 3, 5}}};
  EXPECT_EQ(Defects(mesh), "mesh-self-intersects");
}

TEST(CheckMesh, ATriangleOnALineIsDegenerate) {
  // A vertex in the middle of an edge, with a triangle of no area between the edge and its halves.
  Mesh mesh = Tetrahedron();
  mesh.vertices.emplace_back(0.5F, 0, 0);
  mesh.triangles[0] = {0, 2, 4};
  mesh.triangles.insert(mesh.triangles.end(), {{4, 2, 1}, {0, 4, 1}});
  // Its long side belongs to a triangle whose edge now touches the two halves.
  EXPECT_EQ(Defects(mesh), "mesh-degenerate mesh-self-intersects");
  EXPECT_EQ(CheckMesh(mesh).degenerate, 1);
}

TEST(CheckMesh, CoincidentVerticesAreFound) {
  // Two spheres' worth of surface that only touch at a point without sharing a vertex.
  const Mesh mesh = Together(Sphere(2), Moved(Sphere(2), 2, 0, 0));
  EXPECT_EQ(Defects(mesh), "mesh-coincident mesh-self-intersects mesh-in-pieces");
  EXPECT_EQ(CheckMesh(mesh).coincident, 1);
  Mesh zero = Tetrahedron();
  zero.vertices.emplace_back(-0.0F, 0, 0);
  EXPECT_EQ(CheckMesh(zero).coincident, 1);
}

TEST(CheckMesh, AMeshThatIsNotFiniteIsInvalid) {
  for (const float bad :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    Mesh mesh = Sphere(2);
    mesh.vertices[3].y() = bad;
    EXPECT_EQ(Defects(mesh), "mesh-invalid");
    EXPECT_EQ(CheckMesh(mesh).self_intersections, std::nullopt);
  }
}

TEST(CheckMesh, AnIndexPastTheEndIsInvalid) {
  Mesh mesh = Tetrahedron();
  mesh.triangles[2][1] = 4;
  EXPECT_EQ(Defects(mesh), "mesh-invalid");
}

TEST(CheckMesh, NothingIsEmpty) {
  EXPECT_EQ(Defects({}), "mesh-empty");
  EXPECT_EQ(Defects({{{0, 0, 0}}, {}}), "mesh-empty");
}

TEST(CheckMesh, IsTheSameForAnyNumberOfThreads) {
  const Mesh mesh = Together(Sphere(5), Moved(Torus(50), 0.5F, 0.1F, 0));
  EXPECT_EQ(CheckMesh(mesh, OnThreads(1)), CheckMesh(mesh, OnThreads(2)));
  EXPECT_GT(CheckMesh(mesh).self_intersections, 0);
}

TEST(CheckMesh, ACancelledCheckDoesNotCountIntersections) {
  const std::atomic<bool> cancel = true;
  EXPECT_EQ(CheckMesh(Sphere(3), CancelledBy(cancel)).self_intersections, std::nullopt);
}

TEST(SelfIntersections, AreTheSameAsByTestingAllPairsExactly) {
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> uniform(-0.4F, 0.4F);
    Mesh mesh = Sphere(2);
    for (auto& v : mesh.vertices)
      v += Eigen::Vector3f(uniform(random), uniform(random), uniform(random));
    std::int64_t pairs = 0;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      for (std::size_t j = i + 1; j < mesh.triangles.size(); ++j) {
        pairs += PairIntersects(mesh, mesh.triangles[i], mesh.triangles[j]) ? 1 : 0;
      }
    }
    EXPECT_EQ(CheckMesh(mesh).self_intersections, pairs) << "seed " << seed;
    EXPECT_GT(pairs, 0) << "seed " << seed;
  }
}

TEST(PairIntersects, AgreesWithExactPredicatesOnALattice) {
  // Small whole coordinates make touching, coplanar and overlapping pairs frequent.
  std::array<int, 3> met{};
  for (std::uint32_t seed = 0; seed < 20000; ++seed) {
    std::mt19937 random(seed);
    std::uniform_int_distribution<int> coordinate(0, 3);
    Mesh mesh;
    for (int v = 0; v < 6; ++v) {
      mesh.vertices.emplace_back(coordinate(random), coordinate(random), coordinate(random));
    }
    const std::uint32_t shared = seed % 3;
    const std::array<std::uint32_t, 3> a = {0, 1, 2};
    const std::array<std::uint32_t, 3> b = {shared > 0 ? 0u : 3u, shared > 1 ? 1u : 4u, 5u};
    const auto& p = mesh.vertices;
    const Corners x = {p[0], p[1], p[2]}, y = {p[b[0]], p[b[1]], p[b[2]]};
    if (AreCollinear(x) || AreCollinear(y)) continue;
    bool exact = false;
    if (shared == 0) exact = TrianglesMeet(x, y);
    if (shared == 1) {
      exact = SegmentMeetsTriangle(x[1], x[2], y) || SegmentMeetsTriangle(y[1], y[2], x);
    }
    if (shared == 2) exact = OverlapAcrossEdge(p[0], p[1], p[2], p[5]);
    EXPECT_EQ(PairIntersects(mesh, a, b), exact) << "seed " << seed;
    EXPECT_EQ(PairIntersects(mesh, {2, 0, 1}, {b[1], b[2], b[0]}), exact) << "seed " << seed;
    met[shared] += exact ? 1 : 0;
  }
  for (const int count : met) EXPECT_GT(count, 50);
}

}  // namespace
}  // namespace lascaux
