#include "lascaux/io/write_ply.h"

#include <bit>
#include <string>
#include <vector>

#include "io/file_writer.h"
#include "io/scene_vertices.h"
#include "io/token.h"
#include "lascaux/volume/vertex_normals.h"

namespace lascaux {
namespace {

static_assert(std::endian::native == std::endian::little,
              "the file is little endian, as memory here");

constexpr std::size_t kBatchBytes = std::size_t{1} << 20;

/// Gathers records and hands them on in pieces of about a megabyte.
class Batch {
 public:
  explicit Batch(FileWriter& file) : file_(file) { bytes_.reserve(kBatchBytes + 64); }

  template <typename T>
  void Append(const T* values, std::size_t count) {
    bytes_.append(reinterpret_cast<const char*>(values), count * sizeof(T));
    if (bytes_.size() >= kBatchBytes) Flush();
  }
  void Flush() {
    file_.Write(bytes_);
    bytes_.clear();
  }

 private:
  FileWriter& file_;
  std::string bytes_;
};

std::string Header(const Mesh& mesh, const MeshDetails& details, Unit unit) {
  std::string text = std::string("ply\nformat binary_little_endian 1.0\ncomment lascaux, unit ") +
                     Name(unit) + ", Y up\n";
  if (!details.vertex_parts.empty()) {
    for (std::size_t p = 0; p < details.parts.size(); ++p)
      text += "comment part " + std::to_string(p) + ' ' + OneLine(details.parts[p].name) + '\n';
  }
  text += "element vertex " + std::to_string(mesh.vertices.size()) +
          "\nproperty float x\nproperty float y\nproperty float z\n"
          "property float nx\nproperty float ny\nproperty float nz\n";
  if (!details.vertex_parts.empty())
    text +=
        "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty ushort part_id\n";
  return text + "element face " + std::to_string(mesh.triangles.size()) +
         "\nproperty list uchar uint vertex_indices\nend_header\n";
}

}  // namespace

Diagnostics WritePly(const std::filesystem::path& path, const Mesh& mesh,
                     const MeshDetails& details, const MeshFileOptions& options) {
  FileWriter file(path);
  Batch batch(file);
  const std::string header = Header(mesh, details, options.unit);
  batch.Append(header.data(), header.size());
  const std::vector<Eigen::Vector3f> computed =
      details.normals.empty() ? VertexNormals(mesh) : std::vector<Eigen::Vector3f>();
  const std::vector<Eigen::Vector3f>& normals = computed.empty() ? details.normals : computed;
  const double factor = PerMillimetre(options.unit);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    batch.Append(SceneVertex(mesh.vertices[i], factor).data(), 3);
    batch.Append(normals[i].data(), 3);
    if (details.vertex_parts.empty()) continue;
    const std::uint16_t part = details.vertex_parts[i];
    batch.Append(details.ColorOf(i).data(), 3);
    batch.Append(&part, 1);
  }
  for (const auto& triangle : mesh.triangles) {
    const unsigned char corners = 3;
    batch.Append(&corners, 1);
    batch.Append(triangle.data(), 3);
  }
  batch.Flush();
  return file.Close();
}

}  // namespace lascaux
