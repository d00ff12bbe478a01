#include <Eigen/Geometry>
#include <limits>
#include <map>
#include <pugixml.hpp>

#include "io/mesh_readers/readers.h"
#include "io/mesh_readers/unzip.h"

namespace lascaux {
namespace {

constexpr int kDeepest = 16;  // of components within components

/// What is wrong with a file: unwinds from any depth of its objects.
struct Trouble {
  std::string what;
};

double MillimetresOf(std::string_view unit) {
  static const std::map<std::string_view, double> kUnits = {{"micron", 0.001},  {"millimeter", 1},
                                                            {"centimeter", 10}, {"inch", 25.4},
                                                            {"foot", 304.8},    {"meter", 1000}};
  const auto found = kUnits.find(unit);
  return found == kUnits.end() ? 1 : found->second;
}

Eigen::Affine3d Placement(std::string_view text) {
  Eigen::Affine3d placement = Eigen::Affine3d::Identity();
  TextCursor words(text);
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 3; ++column) {
      float value = 0;
      const std::string_view word = words.Word();
      if (word.empty() && row == 0 && column == 0) return placement;
      if (!ToFloat(word, value)) throw Trouble{"has a placement of less than twelve numbers"};
      // The file's rows are the images of the axes, and the shift.
      placement.matrix()(column, row) = static_cast<double>(value);
    }
  }
  return placement;
}

std::uint32_t IndexOf(const pugi::xml_attribute& attribute) {
  long long index = -1;
  if (!ToInteger(attribute.value(), index)) throw Trouble{"has a triangle without corners"};
  const bool possible = index >= 0 && index < std::numeric_limits<std::uint32_t>::max();
  return possible ? static_cast<std::uint32_t>(index) : std::numeric_limits<std::uint32_t>::max();
}

class ThreeMfReader {
 public:
  ThreeMfReader(const pugi::xml_node& model, const ReadMeshOptions& options)
      : model_(model), options_(options) {}

  LoadedMesh Read() {
    const pugi::xml_node resources = model_.child("resources");
    for (const pugi::xml_node& group : resources.children("basematerials")) AddMaterials(group);
    for (const pugi::xml_node& object : resources.children("object"))
      objects_.emplace(object.attribute("id").value(), object);
    for (const pugi::xml_node& item : model_.child("build").children("item"))
      AddObject(item.attribute("objectid").value(), Placement(item.attribute("transform").value()),
                0);
    loaded_.format = MeshFormat::k3mf;
    loaded_.millimetres = MillimetresOf(model_.attribute("unit").value());
    if (loaded_.details.parts.empty()) loaded_.details.triangle_parts.clear();
    return std::move(loaded_);
  }

 private:
  void AddMaterials(const pugi::xml_node& group) {
    std::vector<MeshPart>& parts = loaded_.details.parts;
    first_material_.emplace(group.attribute("id").value(), parts.size());
    for (const pugi::xml_node& base : group.children("base")) {
      if (parts.size() == 65535) return;
      parts.push_back({base.attribute("name").value(), PartColor(static_cast<int>(parts.size()))});
    }
  }

  void AddObject(const std::string& id, const Eigen::Affine3d& placement, int depth) {
    const auto found = objects_.find(id);
    if (found == objects_.end()) throw Trouble{"names an object that is not there"};
    // Components that name each other twice a level grow by themselves.
    if (depth > kDeepest || ++visits_ > 100'000) throw Trouble{"has objects within themselves"};
    const pugi::xml_node& object = found->second;
    if (object.child("mesh")) AddMesh(object, placement);
    for (const pugi::xml_node& component : object.child("components").children("component"))
      AddObject(component.attribute("objectid").value(),
                placement * Placement(component.attribute("transform").value()), depth + 1);
  }

  void AddMesh(const pugi::xml_node& object, const Eigen::Affine3d& placement) {
    Mesh& mesh = loaded_.mesh;
    const std::size_t base = mesh.vertices.size();
    // A shift leaves the shape's own floats as they are: it is left out.
    const bool moves = !placement.linear().isIdentity(0) || base > 0;
    for (const pugi::xml_node& node : object.child("mesh").child("vertices").children("vertex")) {
      Eigen::Vector3f p;
      const std::array<const char*, 3> names = {"x", "y", "z"};
      for (int k = 0; k < 3; ++k)
        if (!ToFloat(node.attribute(names[static_cast<std::size_t>(k)]).value(), p[k]))
          throw Trouble{fmt::format("has no numbers for vertex {}", mesh.vertices.size() - base)};
      if (moves) p = (placement * p.cast<double>()).cast<float>();
      mesh.vertices.push_back(FromPrintFrame(p));
    }
    const std::size_t own =
        PartOf(object.attribute("pid").value(), object.attribute("pindex").value(), 0);
    for (const pugi::xml_node& node :
         object.child("mesh").child("triangles").children("triangle")) {
      std::array<std::uint32_t, 3> triangle = {IndexOf(node.attribute("v1")),
                                               IndexOf(node.attribute("v2")),
                                               IndexOf(node.attribute("v3"))};
      for (std::uint32_t& corner : triangle)
        corner = corner < mesh.vertices.size() - base ? static_cast<std::uint32_t>(base + corner)
                                                      : std::numeric_limits<std::uint32_t>::max();
      mesh.triangles.push_back(triangle);
      if (mesh.triangles.size() > options_.max_triangles)
        throw Trouble{fmt::format("has more than {} triangles", options_.max_triangles)};
      loaded_.details.triangle_parts.push_back(static_cast<std::uint16_t>(
          PartOf(node.attribute("pid").value(), node.attribute("p1").value(), own)));
    }
  }

  /// The part that a group of materials and an index in it stand for.
  std::size_t PartOf(const std::string& group, const std::string& index,
                     std::size_t otherwise) const {
    const auto found = first_material_.find(group);
    long long i = 0;
    if (found == first_material_.end() || !ToInteger(index, i) || i < 0) return otherwise;
    const std::size_t part = found->second + static_cast<std::size_t>(i);
    return part < loaded_.details.parts.size() ? part : otherwise;
  }

  pugi::xml_node model_;
  const ReadMeshOptions& options_;
  std::map<std::string, pugi::xml_node> objects_;
  std::map<std::string, std::size_t> first_material_;
  LoadedMesh loaded_;
  std::size_t visits_ = 0;
};

/// Where the package says that its model is; without the leading slash.
std::string ModelPath(std::string_view bytes, std::size_t max_bytes) {
  const std::optional<std::string> relations = Unzip(bytes, "_rels/.rels", max_bytes);
  pugi::xml_document document;
  if (relations && document.load_buffer(relations->data(), relations->size())) {
    for (const pugi::xml_node& relation : document.child("Relationships").children()) {
      const std::string_view type = relation.attribute("Type").value();
      std::string_view target = relation.attribute("Target").value();
      if (!type.ends_with("/3dmodel")) continue;
      if (target.starts_with('/')) target.remove_prefix(1);
      return std::string(target);
    }
  }
  return "3D/3dmodel.model";
}

}  // namespace

Outcome<LoadedMesh> Read3mf(std::string_view bytes, const ReadMeshOptions& options) {
  const std::string path = ModelPath(bytes, options.max_unpacked);
  const std::optional<std::string> xml = Unzip(bytes, path, options.max_unpacked);
  if (!xml) {
    return BrokenMesh(
        MeshFormat::k3mf,
        fmt::format("is damaged or holds no '{}' of at most {} bytes", path, options.max_unpacked));
  }
  pugi::xml_document document;
  const pugi::xml_parse_result parsed = document.load_buffer(xml->data(), xml->size());
  if (!parsed || !document.child("model"))
    return BrokenMesh(MeshFormat::k3mf, "has a model that is not well-formed XML");
  try {
    return ThreeMfReader(document.child("model"), options).Read();
  } catch (const Trouble& trouble) {
    return BrokenMesh(MeshFormat::k3mf, trouble.what);
  }
}

}  // namespace lascaux
