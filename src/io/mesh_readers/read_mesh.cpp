#include "lascaux/io/read_mesh.h"

#include "io/mesh_readers/readers.h"

namespace lascaux {
namespace {

/// Text with a line that begins with "v " and one with "f " is OBJ.
bool LooksLikeObj(std::string_view bytes) {
  if (bytes.find('\0') != std::string_view::npos) return false;
  TextCursor cursor(bytes);
  for (std::string_view line; cursor.Line(line);) {
    TextCursor words(line);
    if (words.Word() == "v") return true;
  }
  return false;
}

bool LooksLikeStl(std::string_view bytes) {
  if (bytes.starts_with("solid")) return true;
  return bytes.size() >= 84 &&
         bytes.size() >= 84 + std::size_t{50} * ValueAt<std::uint32_t>(bytes, 80) / 2;
}

}  // namespace

const char* Name(MeshFormat format) noexcept {
  switch (format) {
    case MeshFormat::kPly:
      return "PLY";
    case MeshFormat::kObj:
      return "OBJ";
    case MeshFormat::kGlb:
      return "GLB";
    case MeshFormat::k3mf:
      return "3MF";
    case MeshFormat::kStl:
      break;
  }
  return "STL";
}

Outcome<LoadedMesh> ReadMesh(std::string_view bytes, const ReadMeshOptions& options) {
  if (bytes.starts_with("glTF")) return ReadGlb(bytes, options);
  if (bytes.starts_with("PK\x03\x04")) return Read3mf(bytes, options);
  if (bytes.starts_with("ply\n") || bytes.starts_with("ply\r")) return ReadPly(bytes, options);
  if (LooksLikeObj(bytes)) return ReadObj(bytes, options);
  if (LooksLikeStl(bytes)) return ReadStl(bytes, options);
  return Outcome<LoadedMesh>::Failure(
      Error(FailureKind::kInput, "not-a-mesh",
            "the file is neither STL nor PLY, OBJ, GLB or 3MF; give a mesh in one of these"));
}

}  // namespace lascaux
