#include "lascaux/io/write_obj.h"

#include <cmath>
#include <vector>

#include "io/scene_vertices.h"
#include "io/text_batch.h"
#include "io/token.h"

namespace lascaux {
namespace {

void AddHeader(TextBatch& text, const MeshFileOptions& options) {
  text << "# Lascaux; unit " << Name(options.unit) << ", Y up\n";
  for (const auto& [key, value] : options.metadata)
    text << "# " << OneLine(key) << ": " << OneLine(value) << '\n';
  text << "o " << Token(options.name) << '\n';
}

void AddVertices(TextBatch& text, const std::vector<Eigen::Vector3f>& vertices,
                 const MeshDetails& details) {
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    text << "v " << vertices[i].x() << ' ' << vertices[i].y() << ' ' << vertices[i].z();
    if (!details.vertex_parts.empty()) {
      // Three digits tell 256 values apart.
      for (const std::uint8_t c : details.ColorOf(i)) text << ' ' << std::round(c / 0.255) / 1000;
    }
    text << '\n';
  }
  for (const Eigen::Vector3f& n : details.normals)
    text << "vn " << n.x() << ' ' << n.y() << ' ' << n.z() << '\n';
}

void AddTriangle(TextBatch& text, const std::array<std::uint32_t, 3>& triangle,
                 const MeshDetails& details) {
  text << 'f';
  for (const std::uint32_t corner : triangle) {
    text << ' ' << corner + 1;
    if (!details.normals.empty()) text << "//" << corner + 1;
  }
  text << '\n';
}

}  // namespace

Diagnostics WriteObj(const std::filesystem::path& path, const Mesh& mesh,
                     const MeshDetails& details, const MeshFileOptions& options) {
  FileWriter file(path);
  TextBatch text(file);
  AddHeader(text, options);
  AddVertices(text, SceneVertices(mesh, options.unit), details);
  if (details.triangle_parts.empty()) {
    for (const auto& triangle : mesh.triangles) AddTriangle(text, triangle, details);
  } else {
    const auto groups = TrianglesOfParts(details);
    for (std::size_t p = 0; p < groups.size(); ++p) {
      if (!groups[p].empty()) text << "g " << Token(details.parts[p].name) << '\n';
      for (const std::uint32_t t : groups[p]) AddTriangle(text, mesh.triangles[t], details);
    }
  }
  text.Flush();
  return file.Close();
}

}  // namespace lascaux
