#include <limits>
#include <map>

#include "io/mesh_readers/readers.h"

namespace lascaux {
namespace {

class ObjReader {
 public:
  explicit ObjReader(const ReadMeshOptions& options) : options_(options) {}

  Outcome<LoadedMesh> Read(std::string_view bytes) {
    TextCursor cursor(bytes);
    for (std::string_view line; cursor.Line(line);) {
      ++line_;
      TextCursor words(line);
      const std::string_view key = words.Word();
      if (key == "v" && !AddVertex(words)) return Broken("has a vertex without three numbers");
      if (key == "f" && !AddFace(words)) return Broken("has a face without three vertices");
      if (key == "g" || key == "o") StartGroup(words.Word());
      if (key.starts_with('#') && unit_ == 0) unit_ = UnitInComment(line);
      if (loaded_.mesh.triangles.size() > options_.max_triangles)
        return TooManyTriangles(MeshFormat::kObj, options_);
    }
    loaded_.format = MeshFormat::kObj;
    if (unit_ > 0) loaded_.millimetres = unit_;
    if (loaded_.details.parts.size() < 2) loaded_.details = {};
    return std::move(loaded_);
  }

 private:
  Outcome<LoadedMesh> Broken(const char* what) const {
    return BrokenMesh(MeshFormat::kObj, fmt::format("{} in line {}", what, line_));
  }

  bool AddVertex(TextCursor& words) {
    Eigen::Vector3f p;
    for (int k = 0; k < 3; ++k)
      if (!ToFloat(words.Word(), p[k])) return false;
    loaded_.mesh.vertices.push_back(p);
    return true;
  }

  /// The vertex that a corner such as "7", "7/2", "7//3" or "-1" names; past the end for none.
  bool Corner(std::string_view word, std::uint32_t& vertex) const {
    long long index = 0;
    if (!ToInteger(word.substr(0, word.find('/')), index) || index == 0) return false;
    const auto count = static_cast<long long>(loaded_.mesh.vertices.size());
    const long long place = index < 0 ? count + index : index - 1;
    const bool possible = place >= 0 && place < std::numeric_limits<std::uint32_t>::max();
    vertex = possible ? static_cast<std::uint32_t>(place) : ~std::uint32_t{0};
    return true;
  }

  bool AddFace(TextCursor& words) {
    std::array<std::uint32_t, 3> fan{};
    int corners = 0;
    for (std::string_view word; !(word = words.Word()).empty() && !word.starts_with('#');) {
      std::uint32_t vertex = 0;
      if (!Corner(word, vertex)) return false;
      if (corners < 3) {
        fan[static_cast<std::size_t>(corners)] = vertex;
      } else {
        fan[1] = fan[2];
        fan[2] = vertex;
      }
      if (++corners >= 3) AddTriangle(fan);
    }
    return corners >= 3;
  }

  void AddTriangle(const std::array<std::uint32_t, 3>& triangle) {
    // The part is listed with its first triangle: most objects have none of their own.
    if (part_ < 0) {
      const auto next = static_cast<int>(loaded_.details.parts.size());
      part_ = next < std::numeric_limits<std::uint16_t>::max()
                  ? ids_.try_emplace(group_, next).first->second
                  : 0;
      if (part_ == next) loaded_.details.parts.push_back({group_, PartColor(next)});
    }
    loaded_.mesh.triangles.push_back(triangle);
    loaded_.details.triangle_parts.push_back(static_cast<std::uint16_t>(part_));
  }

  void StartGroup(std::string_view name) {
    group_ = name;
    part_ = -1;
  }

  const ReadMeshOptions& options_;
  LoadedMesh loaded_;
  std::map<std::string, int> ids_;
  std::string group_ = "default";
  int part_ = -1;
  double unit_ = 0;
  std::size_t line_ = 0;
};

}  // namespace

Outcome<LoadedMesh> ReadObj(std::string_view bytes, const ReadMeshOptions& options) {
  return ObjReader(options).Read(bytes);
}

}  // namespace lascaux
