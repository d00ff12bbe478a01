#pragma once

#include <fmt/format.h>

#include <array>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>

#include "lascaux/io/read_mesh.h"

/// @file
/// What the readers of the formats share. Each reads any bytes.

namespace lascaux {

Outcome<LoadedMesh> ReadStl(std::string_view bytes, const ReadMeshOptions& options);
Outcome<LoadedMesh> ReadPly(std::string_view bytes, const ReadMeshOptions& options);
Outcome<LoadedMesh> ReadObj(std::string_view bytes, const ReadMeshOptions& options);
Outcome<LoadedMesh> ReadGlb(std::string_view bytes, const ReadMeshOptions& options);
Outcome<LoadedMesh> Read3mf(std::string_view bytes, const ReadMeshOptions& options);

/// Makes one vertex of all that are at the same place: the first of them. Order is kept otherwise.
void WeldVertices(Mesh& mesh);

/// Millimetres a unit after "unit " in a comment: mm, cm or m as our own writers say; 0 for none.
double UnitInComment(std::string_view comment) noexcept;

/// Z up to the model's axes: x = X, y = Z, z = -Y, exactly.
inline Eigen::Vector3f FromPrintFrame(const Eigen::Vector3f& p) {
  return {p.x(), p.z(), 0.0F - p.y()};
}

inline Outcome<LoadedMesh> BrokenMesh(MeshFormat format, const std::string& what) {
  return Outcome<LoadedMesh>::Failure(
      Error(FailureKind::kInput, "broken-mesh",
            fmt::format("this {} file {}; export it again", Name(format), what)));
}

/// Too many triangles for the limit.
inline Outcome<LoadedMesh> TooManyTriangles(MeshFormat format, const ReadMeshOptions& options) {
  return BrokenMesh(format, fmt::format("has more than {} triangles", options.max_triangles));
}

/// A value in the machine's memory order at `offset`, which must be in range with its size.
template <typename T>
T ValueAt(std::string_view bytes, std::size_t offset) {
  T value;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

/// Takes a text apart into lines and words; never looks past its end.
class TextCursor {
 public:
  explicit TextCursor(std::string_view text) : rest_(text) {}

  /// The next line without its end ("\n", "\r\n" or "\r"); false at the end of the text.
  bool Line(std::string_view& line);
  /// The next word between white space; empty at the end.
  std::string_view Word();

  std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_;
};

/// A whole word as a number; false for anything else. Takes a leading '+', and overflow as
/// infinity.
bool ToFloat(std::string_view word, float& value);
bool ToInteger(std::string_view word, long long& value);

}  // namespace lascaux
