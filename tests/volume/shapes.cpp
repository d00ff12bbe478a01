#include "volume/shapes.h"

#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace lascaux::testing {

Mesh Sphere(int levels, float radius) {
  Mesh mesh;
  mesh.vertices = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                    {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [at, is_new] = middles.try_emplace(std::minmax(a, b), mesh.vertices.size());
      if (is_new) mesh.vertices.push_back((mesh.vertices[a] + mesh.vertices[b]).normalized());
      return at->second;
    };
    Triangles finer;
    for (const auto& [a, b, c] : mesh.triangles) {
      const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    mesh.triangles = std::move(finer);
  }
  for (Eigen::Vector3f& v : mesh.vertices) v *= radius;
  return mesh;
}

Mesh Torus(std::uint32_t n, float major, float minor) {
  Mesh mesh;
  const float step = 2 * std::numbers::pi_v<float> / static_cast<float>(n);
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < n; ++j) {
      const float u = step * static_cast<float>(i), v = step * static_cast<float>(j);
      const float r = major + minor * std::cos(v);
      mesh.vertices.emplace_back(r * std::cos(u), minor * std::sin(v), r * std::sin(u));
      const std::uint32_t a = n * i + j, b = n * ((i + 1) % n) + j;
      const std::uint32_t c = n * ((i + 1) % n) + (j + 1) % n, d = n * i + (j + 1) % n;
      mesh.triangles.push_back({a, d, c});
      mesh.triangles.push_back({a, c, b});
    }
  }
  return mesh;
}

Mesh Tetrahedron() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
          {{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}}};
}

Mesh Moved(Mesh mesh, float x, float y, float z) {
  for (Eigen::Vector3f& v : mesh.vertices) v += Eigen::Vector3f(x, y, z);
  return mesh;
}

Mesh Together(Mesh mesh, const Mesh& other) {
  const auto shift = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const auto& [a, b, c] : other.triangles) {
    mesh.triangles.push_back({a + shift, b + shift, c + shift});
  }
  return mesh;
}

Mesh InsideOut(Mesh mesh) {
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

Execution OnThreads(int threads) {
  Execution execution;
  execution.threads = threads;
  return execution;
}

Execution CancelledBy(const std::atomic<bool>& cancel) {
  Execution execution;
  execution.cancel = &cancel;
  return execution;
}

}  // namespace lascaux::testing
