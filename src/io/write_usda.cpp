#include "lascaux/io/write_usda.h"

#include <Eigen/Geometry>
#include <cassert>
#include <set>
#include <string_view>
#include <vector>

#include "io/scene_vertices.h"
#include "io/text_batch.h"
#include "io/token.h"

namespace lascaux {
namespace {

/// A string literal.
std::string Quoted(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : OneLine(text)) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + '"';
}

/// A path between @ signs; names that hold one stand between three.
std::string AssetPath(const std::string& path) {
  const char* mark = path.find('@') == std::string::npos ? "@" : "@@@";
  return mark + OneLine(path) + mark;
}

double MetersPerUnit(Unit unit) { return PerMillimetre(Unit::kMetre) / PerMillimetre(unit); }

TextBatch& operator<<(TextBatch& text, const Eigen::Vector3f& v) {
  return text << '(' << v.x() << ", " << v.y() << ", " << v.z() << ')';
}

/// "[a, b, c]" of a range, a line break every now and then.
template <typename Range, typename Print>
void AddList(TextBatch& text, const Range& range, Print&& print) {
  constexpr int kPerLine = 8;
  text << '[';
  int count = 0;
  for (const auto& value : range) {
    if (count > 0) text << (count % kPerLine == 0 ? ",\n            " : ", ");
    print(value);
    ++count;
  }
  text << ']';
}

void AddHeader(TextBatch& text, const MeshFileOptions& options) {
  text << "#usda 1.0\n(\n";
  text << "    customLayerData = {\n";
  for (const auto& [key, value] : options.metadata)
    text << "        string " << Identifier(key) << " = " << Quoted(value) << '\n';
  text << "    }\n";
  text << "    defaultPrim = " << Quoted(Identifier(options.name)) << '\n';
  text << "    metersPerUnit = " << MetersPerUnit(options.unit) << "\n    upAxis = \"Y\"\n)\n\n";
}

void AddFaces(TextBatch& text, const Mesh& mesh) {
  text << "        int[] faceVertexCounts = ";
  AddList(text, mesh.triangles, [&](const auto&) { text << '3'; });
  text << '\n';
  text << "        int[] faceVertexIndices = ";
  AddList(text, mesh.triangles,
          [&](const auto& t) { text << t[0] << ", " << t[1] << ", " << t[2]; });
  text << '\n';
}

void AddColors(TextBatch& text, const MeshDetails& details) {
  const auto add = [&text](const Srgb8& c) {
    text << Eigen::Vector3f(LinearFromSrgb(c[0]), LinearFromSrgb(c[1]), LinearFromSrgb(c[2]));
  };
  text << "        color3f[] primvars:displayColor = ";
  if (!details.vertex_colors.empty()) {
    AddList(text, details.vertex_colors, add);
    text << " (\n            interpolation = \"vertex\"\n        )\n";
    return;
  }
  AddList(text, details.parts, [&](const MeshPart& part) { add(part.color); });
  text << " (\n            interpolation = \"uniform\"\n        )\n";
  text << "        int[] primvars:displayColor:indices = ";
  AddList(text, details.triangle_parts, [&](std::uint16_t part) { text << part; });
  text << '\n';
}

void AddSubsets(TextBatch& text, const MeshDetails& details) {
  const auto groups = TrianglesOfParts(details);
  std::set<std::string> used;
  for (std::size_t p = 0; p < groups.size(); ++p) {
    if (groups[p].empty()) continue;
    std::string name = Identifier(details.parts[p].name);
    while (!used.insert(name).second) name += '_';
    text << "\n        def GeomSubset " << Quoted(name) << "\n        {\n"
         << "            uniform token elementType = \"face\"\n"
         << "            uniform token familyName = \"parts\"\n"
         << "            int[] indices = ";
    AddList(text, groups[p], [&](std::uint32_t t) { text << t; });
    text << "\n        }\n";
  }
}

void AddExtent(TextBatch& text, const Eigen::AlignedBox3f& box) {
  text << "        float3[] extent = [" << box.min() << ", " << box.max() << "]\n";
}

void AddMesh(TextBatch& text, const Mesh& mesh, const MeshDetails& details,
             const std::vector<Eigen::Vector3f>& vertices) {
  text << "    def Mesh \"mesh\"\n    {\n";
  text << "        uniform token subdivisionScheme = \"none\"\n"
       << "        uniform token orientation = \"rightHanded\"\n";
  AddFaces(text, mesh);
  text << "        point3f[] points = ";
  AddList(text, vertices, [&](const Eigen::Vector3f& v) { text << v; });
  text << '\n';
  if (!details.normals.empty()) {
    text << "        normal3f[] normals = ";
    AddList(text, details.normals, [&](const Eigen::Vector3f& n) { text << n; });
    text << " (\n            interpolation = \"vertex\"\n        )\n";
  }
  if (!details.triangle_parts.empty()) AddColors(text, details);
}

void AddField(TextBatch& text, std::string_view name, const UsdaOptions& options) {
  text << "\n        def OpenVDBAsset \"" << name << "\"\n        {\n"
       << "            asset filePath = " << AssetPath(options.volume) << '\n'
       << "            token fieldName = \"" << name << "\"\n"
       << "            token fieldClass = \"" << (name == "surface" ? "levelSet" : "fogVolume")
       << "\"\n        }\n";
}

void AddVolume(TextBatch& text, const Eigen::AlignedBox3f& stage, const UsdaOptions& options) {
  Eigen::AlignedBox3f box = stage;
  text << "\n    def Volume \"volume\"\n    {\n";
  if (options.volume_up == UpAxis::kZ) {
    text << "        float xformOp:rotateX = -90\n"
         << "        uniform token[] xformOpOrder = [\"xformOp:rotateX\"]\n";
    box = Eigen::AlignedBox3f(ToPrintFrame(stage.min()));
    box.extend(ToPrintFrame(stage.max()));
  }
  AddExtent(text, box);
  text << "        uniform token purpose = \"guide\"\n";
  std::vector<std::string_view> fields = {"surface"};
  if (options.fog) fields.emplace_back("density");
  for (const std::string_view field : fields)
    text << "        rel field:" << field << " = </" << Identifier(options.name) << "/volume/"
         << field << ">\n";
  for (const std::string_view field : fields) AddField(text, field, options);
  text << "    }\n";
}

}  // namespace

Diagnostics WriteUsda(const std::filesystem::path& path, const Mesh& mesh,
                      const MeshDetails& details, const UsdaOptions& options) {
  assert(!mesh.triangles.empty());
  const std::vector<Eigen::Vector3f> vertices = SceneVertices(mesh, options.unit);
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& v : vertices) box.extend(v);
  FileWriter file(path);
  TextBatch text(file);
  AddHeader(text, options);
  text << "def Xform " << Quoted(Identifier(options.name))
       << " (\n    kind = \"component\"\n)\n{\n";
  AddMesh(text, mesh, details, vertices);
  AddExtent(text, box);
  if (!details.triangle_parts.empty()) AddSubsets(text, details);
  text << "    }\n";
  if (!options.volume.empty()) AddVolume(text, box, options);
  text << "}\n";
  text.Flush();
  return file.Close();
}

}  // namespace lascaux
