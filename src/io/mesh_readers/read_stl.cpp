#include <algorithm>
#include <cstring>
#include <unordered_map>

#include "io/mesh_readers/readers.h"
#include "lascaux/io/content_hash.h"

namespace lascaux {
namespace {

constexpr std::size_t kHeaderBytes = 84, kRecordBytes = 50;

struct PlaceHash {
  std::size_t operator()(const std::array<float, 3>& p) const noexcept {
    return ContentHash({reinterpret_cast<const char*>(p.data()), sizeof p})[0];
  }
};

Outcome<LoadedMesh> ReadBinary(std::string_view bytes, const ReadMeshOptions& options) {
  const std::size_t count = ValueAt<std::uint32_t>(bytes, 80);
  if (count > options.max_triangles) return TooManyTriangles(MeshFormat::kStl, options);
  if (bytes.size() < kHeaderBytes + kRecordBytes * count) {
    return BrokenMesh(MeshFormat::kStl,
                      fmt::format("ends after {} of its {} triangles",
                                  (bytes.size() - kHeaderBytes) / kRecordBytes, count));
  }
  LoadedMesh loaded;
  loaded.mesh.vertices.reserve(3 * count);
  for (std::size_t t = 0; t < count; ++t) {
    const auto corners = ValueAt<std::array<float, 9>>(bytes, kHeaderBytes + kRecordBytes * t + 12);
    for (std::size_t k = 0; k < 9; k += 3)
      loaded.mesh.vertices.emplace_back(corners[k], corners[k + 1], corners[k + 2]);
  }
  return loaded;
}

Outcome<LoadedMesh> ReadText(std::string_view bytes, const ReadMeshOptions& options) {
  LoadedMesh loaded;
  TextCursor cursor(bytes);
  for (std::string_view word; !(word = cursor.Word()).empty();) {
    if (word != "vertex") continue;
    Eigen::Vector3f p;
    for (int k = 0; k < 3; ++k) {
      if (!ToFloat(cursor.Word(), p[k]))
        return BrokenMesh(MeshFormat::kStl, fmt::format("has no number for coordinate {} of "
                                                        "corner {}",
                                                        k, loaded.mesh.vertices.size()));
    }
    loaded.mesh.vertices.push_back(p);
    if (loaded.mesh.vertices.size() / 3 > options.max_triangles)
      return TooManyTriangles(MeshFormat::kStl, options);
  }
  if (loaded.mesh.vertices.size() % 3 != 0)
    return BrokenMesh(MeshFormat::kStl, "ends within a triangle");
  return loaded;
}

}  // namespace

void WeldVertices(Mesh& mesh) {
  std::unordered_map<std::array<float, 3>, std::uint32_t, PlaceHash> first;
  first.reserve(mesh.vertices.size());
  std::vector<std::uint32_t> place(mesh.vertices.size());
  std::vector<Eigen::Vector3f> kept;
  for (std::size_t i = 0; i < place.size(); ++i) {
    const Eigen::Vector3f p = mesh.vertices[i] + Eigen::Vector3f::Zero();  // -0 becomes 0
    const auto [entry, is_new] =
        first.try_emplace({p.x(), p.y(), p.z()}, static_cast<std::uint32_t>(kept.size()));
    if (is_new) kept.push_back(p);
    place[i] = entry->second;
  }
  mesh.vertices = std::move(kept);
  for (auto& triangle : mesh.triangles)
    for (std::uint32_t& corner : triangle)
      // What points past the end goes on doing so.
      corner = corner < place.size() ? place[corner] : ~std::uint32_t{0};
}

Outcome<LoadedMesh> ReadStl(std::string_view bytes, const ReadMeshOptions& options) {
  // Binary files may begin with "solid", too: a text has "facet" early on, and no binary zeros.
  const std::string_view head = bytes.substr(0, 1024);
  const bool text = bytes.starts_with("solid") && head.find('\0') == std::string_view::npos &&
                    (head.find("facet") != std::string_view::npos ||
                     head.find("endsolid") != std::string_view::npos);
  if (!text && bytes.size() < kHeaderBytes)
    return BrokenMesh(MeshFormat::kStl, fmt::format("ends after {} bytes", bytes.size()));
  Diagnostics log;
  auto loaded = (text ? ReadText(bytes, options) : ReadBinary(bytes, options)).MoveInto(log);
  if (!loaded) return Outcome<LoadedMesh>::Failure(std::move(log));
  Mesh& mesh = loaded->mesh;
  for (Eigen::Vector3f& p : mesh.vertices) p = FromPrintFrame(p);
  mesh.triangles.resize(mesh.vertices.size() / 3);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    mesh.triangles[t] = {3 * t, 3 * t + 1, 3 * t + 2};
  WeldVertices(mesh);
  loaded->format = MeshFormat::kStl;
  return std::move(*loaded);
}

}  // namespace lascaux
