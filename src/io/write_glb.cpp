#include "lascaux/io/write_glb.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <array>
#include <bit>
#include <cassert>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "io/file_writer.h"
#include "io/scene_vertices.h"
#include "lascaux/io/output_file.h"

namespace lascaux {
namespace {

static_assert(std::endian::native == std::endian::little, "glTF is little endian, as memory here");

// Numbers of the format.
constexpr std::uint32_t kMagic = 0x46546C67, kVersion = 2, kJsonChunk = 0x4E4F534A,
                        kBinaryChunk = 0x004E4942;
constexpr int kUnsignedShort = 5123, kUnsignedInt = 5125, kFloat = 5126;
constexpr int kArrayBuffer = 34962, kElementBuffer = 34963;

using Json = nlohmann::ordered_json;

/// The binary chunk and the views and accessors that say what is in it.
class Buffer {
 public:
  template <typename T, typename Allocator>
  int Add(const std::vector<T, Allocator>& values, int target, Json accessor,
          std::size_t stride = 0) {
    Json view = {{"buffer", 0}, {"byteOffset", bytes_.size()}};
    view["byteLength"] = values.size() * sizeof(T);
    if (stride > 0) view["byteStride"] = stride;
    view["target"] = target;
    bytes_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
    bytes_.resize((bytes_.size() + 3) / 4 * 4);
    accessor["bufferView"] = views_.size();
    views_.push_back(std::move(view));
    accessors_.push_back(std::move(accessor));
    return static_cast<int>(accessors_.size()) - 1;
  }

  void MoveInto(Json& document) {
    document["buffers"] = Json::array({{{"byteLength", bytes_.size()}}});
    document["bufferViews"] = std::move(views_);
    document["accessors"] = std::move(accessors_);
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
  Json views_ = Json::array(), accessors_ = Json::array();
};

Json Triple(const Eigen::Vector3f& v) { return {v.x(), v.y(), v.z()}; }

int AddPositions(Buffer& buffer, const std::vector<Eigen::Vector3f>& vertices) {
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& v : vertices) box.extend(v);
  return buffer.Add(vertices, kArrayBuffer,
                    {{"componentType", kFloat},
                     {"count", vertices.size()},
                     {"type", "VEC3"},
                     {"min", Triple(box.min())},
                     {"max", Triple(box.max())}});
}

/// Linear colours, 16 bits a channel: 8 would show steps in the dark ones.
int AddColors(Buffer& buffer, const MeshDetails& details) {
  std::array<std::uint16_t, 256> linear;
  for (std::size_t i = 0; i < linear.size(); ++i)
    linear[i] =
        static_cast<std::uint16_t>(65535 * LinearFromSrgb(static_cast<std::uint8_t>(i)) + 0.5F);
  std::vector<std::array<std::uint16_t, 4>> colors;
  colors.reserve(details.vertex_parts.size());
  for (std::size_t i = 0; i < details.vertex_parts.size(); ++i) {
    const auto& [r, g, b] = details.ColorOf(i);
    colors.push_back({linear[r], linear[g], linear[b], 65535});
  }
  return buffer.Add(colors, kArrayBuffer,
                    {{"componentType", kUnsignedShort},
                     {"normalized", true},
                     {"count", colors.size()},
                     {"type", "VEC4"}});
}

int AddPartIds(Buffer& buffer, const MeshDetails& details) {
  // Each element of an attribute begins at a multiple of four bytes.
  std::vector<std::array<std::uint16_t, 2>> ids;
  ids.reserve(details.vertex_parts.size());
  for (const std::uint16_t part : details.vertex_parts) ids.push_back({part, 0});
  return buffer.Add(ids, kArrayBuffer,
                    {{"componentType", kUnsignedShort}, {"count", ids.size()}, {"type", "SCALAR"}},
                    4);
}

Json Attributes(Buffer& buffer, const Mesh& mesh, const MeshDetails& details) {
  Json attributes;
  attributes["POSITION"] = AddPositions(buffer, SceneVertices(mesh, Unit::kMetre));
  if (!details.normals.empty())
    attributes["NORMAL"] = buffer.Add(
        details.normals, kArrayBuffer,
        {{"componentType", kFloat}, {"count", details.normals.size()}, {"type", "VEC3"}});
  if (!details.vertex_parts.empty()) {
    attributes["COLOR_0"] = AddColors(buffer, details);
    attributes["_PART"] = AddPartIds(buffer, details);
  }
  return attributes;
}

/// The JSON chunk without the padding.
std::string Document(Buffer& buffer, const Mesh& mesh, const MeshDetails& details,
                     const MeshFileOptions& options) {
  Json document;
  document["asset"] = {{"version", "2.0"}, {"generator", "Lascaux"}};
  for (const auto& [key, value] : options.metadata) document["asset"]["extras"][key] = value;
  document["scene"] = 0;
  document["scenes"] = Json::array({{{"nodes", {0}}}});
  document["nodes"] = Json::array({{{"name", options.name}, {"mesh", 0}}});
  document["materials"] = Json::array(
      {{{"name", "clay"},
        {"pbrMetallicRoughness", {{"metallicFactor", 0.0}, {"roughnessFactor", 0.8}}}}});
  Json primitive = {{"attributes", Attributes(buffer, mesh, details)}};
  primitive["indices"] = buffer.Add(
      mesh.triangles, kElementBuffer,
      {{"componentType", kUnsignedInt}, {"count", 3 * mesh.triangles.size()}, {"type", "SCALAR"}});
  primitive["material"] = 0;
  Json object = {{"name", options.name}};
  object["primitives"] = Json::array({std::move(primitive)});
  for (const MeshPart& part : details.parts) object["extras"]["parts"].push_back(part.name);
  document["meshes"] = Json::array({std::move(object)});
  buffer.MoveInto(document);
  // Names come from files' names, which may be no UTF-8.
  return document.dump(-1, ' ', false, Json::error_handler_t::replace);
}

void AppendWord(std::string& bytes, std::size_t word) {
  const auto narrow = static_cast<std::uint32_t>(word);
  bytes.append(reinterpret_cast<const char*>(&narrow), sizeof narrow);
}

}  // namespace

Diagnostics WriteGlb(const std::filesystem::path& path, const Mesh& mesh,
                     const MeshDetails& details, const MeshFileOptions& options) {
  assert(!mesh.triangles.empty());
  Buffer buffer;
  std::string json = Document(buffer, mesh, details, options);
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const std::size_t total = 12 + 8 + json.size() + 8 + buffer.bytes().size();
  if (total > std::numeric_limits<std::uint32_t>::max()) {
    return {Error(FailureKind::kOutput, "cannot-write",
                  fmt::format("cannot write '{}': GLB holds at most 4 GB, {} bytes are wanted; "
                              "lower the resolution",
                              path.string(), total))};
  }
  std::string head;
  for (const std::size_t word :
       {std::size_t{kMagic}, std::size_t{kVersion}, total, json.size(), std::size_t{kJsonChunk}})
    AppendWord(head, word);
  head += json;
  AppendWord(head, buffer.bytes().size());
  AppendWord(head, kBinaryChunk);
  FileWriter file(path);
  file.Write(head);
  file.Write(buffer.bytes());
  return file.Close();
}

}  // namespace lascaux
