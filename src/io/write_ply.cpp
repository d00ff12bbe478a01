#include "lascaux/io/write_ply.h"

#include <Eigen/Geometry>
#include <bit>
#include <cstring>
#include <string>
#include <vector>

#include "io/file_writer.h"

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

std::string Header(const Mesh& mesh, Unit unit) {
  return std::string("ply\nformat binary_little_endian 1.0\ncomment lascaux, unit ") + Name(unit) +
         ", Y up\nelement vertex " + std::to_string(mesh.vertices.size()) +
         "\nproperty float x\nproperty float y\nproperty float z\n"
         "property float nx\nproperty float ny\nproperty float nz\nelement face " +
         std::to_string(mesh.triangles.size()) +
         "\nproperty list uchar uint vertex_indices\nend_header\n";
}

/// Sums of the faces' cross products, whose lengths are twice the areas.
std::vector<Eigen::Vector3d> WeightedNormals(const Mesh& mesh) {
  std::vector<Eigen::Vector3d> normals(mesh.vertices.size(), Eigen::Vector3d::Zero());
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3d origin = mesh.vertices[a].cast<double>();
    const Eigen::Vector3d cross =
        (mesh.vertices[b].cast<double>() - origin).cross(mesh.vertices[c].cast<double>() - origin);
    for (const std::uint32_t corner : {a, b, c}) normals[corner] += cross;
  }
  return normals;
}

}  // namespace

Diagnostics WritePly(const std::filesystem::path& path, const Mesh& mesh,
                     const WritePlyOptions& options) {
  FileWriter file(path);
  Batch batch(file);
  const std::string header = Header(mesh, options.unit);
  batch.Append(header.data(), header.size());
  const std::vector<Eigen::Vector3d> normals = WeightedNormals(mesh);
  const double factor = PerMillimetre(options.unit);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    Eigen::Matrix<float, 6, 1> record;
    // stableNormalized() leaves a zero vector zero.
    record << (factor * mesh.vertices[i].cast<double>()).cast<float>(),
        normals[i].stableNormalized().cast<float>();
    batch.Append(record.data(), 6);
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
