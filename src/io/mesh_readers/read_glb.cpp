#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "io/mesh_readers/readers.h"

namespace lascaux {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kHeaderBytes = 12, kChunkBytes = 8;
constexpr std::uint32_t kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;
constexpr int kDeepest = 64;  // of nodes within nodes

/// What is wrong with a file: unwinds from any depth of its description.
struct Trouble {
  std::string what;
  bool unsupported = false;
};

/// A view on numbers of one accessor.
struct Numbers {
  std::string_view bytes;
  std::size_t count = 0, stride = 0;
  int type = 0;  ///< componentType
};

std::size_t Unsigned(const Json& object, const char* key, std::size_t fallback) {
  const auto found = object.find(key);
  if (found == object.end()) return fallback;
  if (!found->is_number_unsigned()) throw Trouble{fmt::format("has no whole number '{}'", key)};
  return found->get<std::size_t>();
}

/// The entry that `key` of `object` names in the list `list` of the document.
const Json& Entry(const Json& document, const char* list, const Json& index) {
  const auto found = document.find(list);
  if (found == document.end() || !found->is_array() || !index.is_number_unsigned() ||
      index.get<std::size_t>() >= found->size() || !(*found)[index.get<std::size_t>()].is_object())
    throw Trouble{fmt::format("names an entry of '{}' that is not there", list)};
  return (*found)[index.get<std::size_t>()];
}

class GlbReader {
 public:
  GlbReader(const Json& document, std::string_view binary, const ReadMeshOptions& options)
      : document_(document), binary_(binary), options_(options) {}

  LoadedMesh Read() {
    if (document_.contains("extensionsRequired"))
      throw Trouble{"needs extensions, such as compression", true};
    if (document_.contains("scenes")) {
      const auto scene = document_.find("scene");
      const Json& entry = Entry(document_, "scenes", scene == document_.end() ? Json(0U) : *scene);
      for (const Json& node : List(entry, "nodes")) AddNode(node, Eigen::Affine3d::Identity(), 0);
    } else {
      for (std::size_t i = 0; i < List(document_, "meshes").size(); ++i)
        AddMesh(Entry(document_, "meshes", Json(i)), Eigen::Affine3d::Identity());
    }
    LoadedMesh loaded;
    loaded.format = MeshFormat::kGlb;
    loaded.millimetres = 1000;
    if (!names_.empty() && parts_.size() == mesh_.triangles.size()) {
      for (const std::string& name : names_)
        loaded.details.parts.push_back(
            {name, PartColor(static_cast<int>(loaded.details.parts.size()))});
      loaded.details.triangle_parts = std::move(parts_);
    }
    loaded.mesh = std::move(mesh_);
    WeldVertices(loaded.mesh);
    return loaded;
  }

 private:
  static const Json& List(const Json& object, const char* key) {
    static const Json kNone = Json::array();
    const auto found = object.find(key);
    if (found == object.end()) return kNone;
    if (!found->is_array()) throw Trouble{fmt::format("has no list '{}'", key)};
    return *found;
  }

  static std::vector<double> Doubles(const Json& object, const char* key, std::size_t count) {
    std::vector<double> values;
    for (const Json& value : List(object, key)) {
      if (!value.is_number()) throw Trouble{fmt::format("has no numbers in '{}'", key)};
      values.push_back(value.get<double>());
    }
    if (!values.empty() && values.size() != count)
      throw Trouble{fmt::format("has {} numbers in '{}', not {}", values.size(), key, count)};
    return values;
  }

  static Eigen::Affine3d Placement(const Json& node) {
    Eigen::Affine3d placement = Eigen::Affine3d::Identity();
    if (const auto m = Doubles(node, "matrix", 16); !m.empty()) {
      for (std::size_t i = 0; i < 16; ++i)
        placement.matrix()(static_cast<Eigen::Index>(i % 4), static_cast<Eigen::Index>(i / 4)) =
            m[i];
      return placement;
    }
    if (const auto t = Doubles(node, "translation", 3); !t.empty())
      placement.translate(Eigen::Vector3d(t[0], t[1], t[2]));
    if (const auto r = Doubles(node, "rotation", 4); !r.empty())
      placement.rotate(Eigen::Quaterniond(r[3], r[0], r[1], r[2]).normalized());
    if (const auto s = Doubles(node, "scale", 3); !s.empty())
      placement.scale(Eigen::Vector3d(s[0], s[1], s[2]));
    return placement;
  }

  void AddNode(const Json& index, const Eigen::Affine3d& parent, int depth) {
    // A node has one parent: more visits than nodes are a circle, or a tree that grows by itself.
    if (depth > kDeepest || ++visits_ > List(document_, "nodes").size())
      throw Trouble{"has nodes within themselves"};
    const Json& node = Entry(document_, "nodes", index);
    const Eigen::Affine3d placement = parent * Placement(node);
    if (node.contains("mesh")) AddMesh(Entry(document_, "meshes", node["mesh"]), placement);
    for (const Json& child : List(node, "children")) AddNode(child, placement, depth + 1);
  }

  Numbers Accessor(const Json& index, std::size_t components) const {
    const Json& accessor = Entry(document_, "accessors", index);
    if (accessor.contains("sparse") || !accessor.contains("bufferView"))
      throw Trouble{"has sparse numbers", true};
    const Json& view = Entry(document_, "bufferViews", accessor["bufferView"]);
    const Json& buffer = Entry(document_, "buffers", view.value("buffer", Json()));
    if (buffer.contains("uri")) throw Trouble{"keeps its numbers in another file", true};
    Numbers numbers;
    numbers.type = static_cast<int>(Unsigned(accessor, "componentType", 0));
    numbers.count = Unsigned(accessor, "count", 0);
    const std::size_t size = components * ComponentBytes(numbers.type);
    numbers.stride = Unsigned(view, "byteStride", size);
    const std::size_t view_at = Unsigned(view, "byteOffset", 0);
    const std::size_t view_size = Unsigned(view, "byteLength", 0);
    const std::size_t at = Unsigned(accessor, "byteOffset", 0);
    if (view_at > binary_.size() || view_size > binary_.size() - view_at || at > view_size)
      throw Trouble{"ends before its numbers do"};
    numbers.bytes = binary_.substr(view_at, view_size).substr(at);
    const std::size_t room = numbers.bytes.size();
    if (numbers.count > 0 && (numbers.stride < size || size > room ||
                              (numbers.count - 1) > (room - size) / numbers.stride))
      throw Trouble{"ends before its numbers do"};
    return numbers;
  }

  static std::size_t ComponentBytes(int type) {
    switch (type) {
      case 5120:
      case 5121:
        return 1;
      case 5122:
      case 5123:
        return 2;
      case 5125:
      case 5126:
        return 4;
      default:
        throw Trouble{fmt::format("has numbers of the unknown type {}", type)};
    }
  }

  static std::uint32_t WholeAt(const Numbers& numbers, std::size_t i) {
    const std::size_t at = i * numbers.stride;
    if (numbers.type == 5121) return ValueAt<std::uint8_t>(numbers.bytes, at);
    if (numbers.type == 5123) return ValueAt<std::uint16_t>(numbers.bytes, at);
    if (numbers.type == 5125) return ValueAt<std::uint32_t>(numbers.bytes, at);
    throw Trouble{"has indices that are no whole numbers"};
  }

  void AddMesh(const Json& mesh, const Eigen::Affine3d& placement) {
    const auto extras = mesh.find("extras");
    if (names_.empty() && extras != mesh.end() && extras->is_object()) {
      for (const Json& name : List(*extras, "parts"))
        if (name.is_string() && names_.size() < 65535) names_.push_back(name.get<std::string>());
    }
    for (const Json& primitive : List(mesh, "primitives")) {
      if (!primitive.is_object()) throw Trouble{"has a primitive that is none"};
      if (Unsigned(primitive, "mode", 4) == 4) AddPrimitive(primitive, placement);
    }
  }

  void AddPrimitive(const Json& primitive, const Eigen::Affine3d& placement) {
    const Json attributes = primitive.value("attributes", Json::object());
    if (!attributes.is_object() || !attributes.contains("POSITION"))
      throw Trouble{"has a primitive without positions"};
    const Numbers positions = Accessor(attributes["POSITION"], 3);
    if (positions.type != 5126) throw Trouble{"has positions that are no floats", true};
    std::optional<Numbers> indices, parts;
    if (primitive.contains("indices")) indices = Accessor(primitive["indices"], 1);
    if (attributes.contains("_PART")) parts = Accessor(attributes["_PART"], 1);
    const std::size_t corners = indices ? indices->count : positions.count;
    if (corners % 3 != 0) throw Trouble{"has a triangle with less than three corners"};
    if (corners / 3 >
        options_.max_triangles - std::min(options_.max_triangles, mesh_.triangles.size()))
      throw Trouble{fmt::format("has more than {} triangles", options_.max_triangles)};
    const std::size_t base = mesh_.vertices.size();
    const bool stays = placement.matrix().isIdentity(0);
    for (std::size_t i = 0; i < positions.count; ++i) {
      const auto p = ValueAt<std::array<float, 3>>(positions.bytes, i * positions.stride);
      const Eigen::Vector3f point(p[0], p[1], p[2]);
      mesh_.vertices.push_back(
          stays ? point : Eigen::Vector3f((placement * point.cast<double>()).cast<float>()));
    }
    for (std::size_t i = 0; i < corners; i += 3) {
      std::array<std::uint32_t, 3> triangle;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t local = indices ? WholeAt(*indices, i + k) : i + k;
        triangle[k] = local < positions.count ? static_cast<std::uint32_t>(base + local)
                                              : std::numeric_limits<std::uint32_t>::max();
      }
      AddTriangle(triangle, base, parts);
    }
  }

  void AddTriangle(const std::array<std::uint32_t, 3>& triangle, std::size_t base,
                   const std::optional<Numbers>& parts) {
    mesh_.triangles.push_back(triangle);
    if (!parts) return;
    std::array<std::size_t, 3> ids{};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t local = triangle[k] - base;
      ids[k] = triangle[k] >= base && local < parts->count ? WholeAt(*parts, local) : 0;
    }
    const std::size_t id = ids[1] == ids[2] ? ids[1] : ids[0];
    parts_.push_back(id < names_.size() ? static_cast<std::uint16_t>(id) : std::uint16_t{0});
  }

  const Json& document_;
  std::string_view binary_;
  const ReadMeshOptions& options_;
  Mesh mesh_;
  std::vector<std::string> names_;
  std::vector<std::uint16_t> parts_;
  std::size_t visits_ = 0;
};

}  // namespace

Outcome<LoadedMesh> ReadGlb(std::string_view bytes, const ReadMeshOptions& options) {
  std::string_view json, binary;
  for (std::size_t at = kHeaderBytes; at + kChunkBytes <= bytes.size();) {
    const std::size_t size = ValueAt<std::uint32_t>(bytes, at);
    const auto type = ValueAt<std::uint32_t>(bytes, at + 4);
    at += kChunkBytes;
    if (size > bytes.size() - at) return BrokenMesh(MeshFormat::kGlb, "ends within a chunk");
    if (type == kJsonChunk && json.empty()) json = bytes.substr(at, size);
    if (type == kBinaryChunk && binary.empty()) binary = bytes.substr(at, size);
    at += size;
  }
  const Json document = Json::parse(json, nullptr, /*allow_exceptions=*/false);
  if (!document.is_object())
    return BrokenMesh(MeshFormat::kGlb, "has a description that is no JSON object");
  try {
    return GlbReader(document, binary, options).Read();
  } catch (const Trouble& trouble) {
    if (!trouble.unsupported) return BrokenMesh(MeshFormat::kGlb, trouble.what);
    return Outcome<LoadedMesh>::Failure(
        Error(FailureKind::kInput, "unsupported-mesh",
              fmt::format("this GLB file {}, which is not read; export it without", trouble.what)));
  }
}

}  // namespace lascaux
