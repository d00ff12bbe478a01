#include "io/samples.h"

#include <openvdb/tools/LevelSetSphere.h>

#include <map>
#include <utility>

#include "lascaux/volume/vertex_normals.h"

namespace lascaux {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

const Eigen::Vector3f kCenter(5, kSampleRadius, -3);

/// Cuts every triangle in four; the new vertices on the unit sphere.
Mesh Refined(const Mesh& mesh) {
  Mesh fine{mesh.vertices, {}};
  std::map<Edge, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto [place, is_new] = middles.try_emplace(std::minmax(a, b), 0);
    if (is_new) {
      place->second = static_cast<std::uint32_t>(fine.vertices.size());
      fine.vertices.push_back((mesh.vertices[a] + mesh.vertices[b]).normalized());
    }
    return place->second;
  };
  for (const auto& [a, b, c] : mesh.triangles) {
    const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    fine.triangles.insert(fine.triangles.end(),
                          {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
  }
  return fine;
}

}  // namespace

Mesh SampleSphere(int refinements) {
  Mesh mesh;
  mesh.vertices = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                    {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int i = 0; i < refinements; ++i) mesh = Refined(mesh);
  for (Eigen::Vector3f& p : mesh.vertices) p = kCenter + static_cast<float>(kSampleRadius) * p;
  return mesh;
}

MeshDetails SampleDetails(const Mesh& mesh) {
  MeshDetails details;
  details.normals = VertexNormals(mesh);
  details.parts = {{"body", PartColor(0)}, {"limb-1", PartColor(1)}};
  for (const Eigen::Vector3f& v : mesh.vertices)
    details.vertex_parts.push_back(v.y() > kCenter.y() ? 1 : 0);
  details.triangle_parts = PartsOfTriangles(mesh.triangles, details.vertex_parts);
  return details;
}

openvdb::FloatGrid::Ptr SampleLevelSet(double voxel_size) {
  openvdb::initialize();
  return openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(
      static_cast<float>(kSampleRadius), openvdb::Vec3f(kCenter.x(), kCenter.y(), kCenter.z()),
      static_cast<float>(voxel_size));
}

Image SamplePicture(int width, int height) {
  Image image{width, height, {}};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (const int value : {3 * x, 5 * y, x + y, 255 - x * y}) {
        image.rgba.push_back(static_cast<std::uint8_t>(value & 255));
      }
    }
  }
  return image;
}

Picture SampleLayers(int width, int height) {
  Picture picture{width, height, {}, {}, {}, {}};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto u = static_cast<float>(x), v = static_cast<float>(y);
      picture.rgba.insert(picture.rgba.end(), {u / 64, v / 64, (u + v) / 128, 0.5F});
      picture.depth.push_back(x == y ? kNoDepth : 100 + u / 3);
      picture.normal.insert(picture.normal.end(), {u / 64, -v / 64, 0.25F});
      picture.part.push_back(u - 1);
    }
  }
  return picture;
}

}  // namespace lascaux
