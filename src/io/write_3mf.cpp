#include "lascaux/io/write_3mf.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <charconv>
#include <string>
#include <vector>

#include "io/scene_vertices.h"
#include "io/zip_writer.h"
#include "lascaux/io/output_file.h"
#include "lascaux/io/write_png.h"
#include "lascaux/io/xml_text.h"

namespace lascaux {
namespace {

constexpr const char* kXml = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";

template <typename Number>
void Append(std::string& text, Number number) {
  char digits[32];
  text.append(digits, std::to_chars(digits, digits + sizeof digits, number).ptr);
}

void AppendMetadata(std::string& xml, const ThreeMfOptions& options) {
  xml += fmt::format(" <metadata name=\"Title\">{}</metadata>\n", EscapeXml(options.name));
  xml += " <metadata name=\"Application\">Lascaux</metadata>\n";
  std::string description;
  for (const auto& [key, value] : options.metadata)
    description += fmt::format("{}{}: {}", description.empty() ? "" : "; ", key, value);
  // Names of our own would need an XML namespace of our own; readers warn of those they don't know.
  if (!description.empty())
    xml += fmt::format(" <metadata name=\"Description\">{}</metadata>\n", EscapeXml(description));
}

void AppendMaterials(std::string& xml, const std::vector<MeshPart>& parts) {
  xml += "  <basematerials id=\"1\">\n";
  for (const MeshPart& part : parts)
    xml += fmt::format("   <base name=\"{}\" displaycolor=\"#{:02X}{:02X}{:02X}\"/>\n",
                       EscapeXml(part.name), part.color[0], part.color[1], part.color[2]);
  xml += "  </basematerials>\n";
}

void AppendMesh(std::string& xml, const Mesh& mesh, const MeshDetails& details) {
  xml += "   <mesh>\n    <vertices>\n";
  for (const Eigen::Vector3f& vertex : mesh.vertices) {
    const Eigen::Vector3f p = ToPrintFrame(vertex);
    xml += "     <vertex x=\"";
    Append(xml, p.x());
    xml += "\" y=\"";
    Append(xml, p.y());
    xml += "\" z=\"";
    Append(xml, p.z());
    xml += "\"/>\n";
  }
  xml += "    </vertices>\n    <triangles>\n";
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    xml += "     <triangle v1=\"";
    Append(xml, mesh.triangles[t][0]);
    xml += "\" v2=\"";
    Append(xml, mesh.triangles[t][1]);
    xml += "\" v3=\"";
    Append(xml, mesh.triangles[t][2]);
    if (!details.triangle_parts.empty()) {
      xml += "\" pid=\"1\" p1=\"";
      Append(xml, details.triangle_parts[t]);
    }
    xml += "\"/>\n";
  }
  xml += "    </triangles>\n   </mesh>\n";
}

std::string ModelXml(const Mesh& mesh, const MeshDetails& details, const ThreeMfOptions& options) {
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& vertex : mesh.vertices) box.extend(ToPrintFrame(vertex));
  std::string xml = kXml;
  xml.reserve(mesh.vertices.size() * 60 + mesh.triangles.size() * 70 + 4096);
  xml +=
      "<model unit=\"millimeter\" xml:lang=\"en-US\" "
      "xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\">\n";
  AppendMetadata(xml, options);
  xml += " <resources>\n";
  const bool parts = !details.triangle_parts.empty();
  if (parts) AppendMaterials(xml, details.parts);
  xml += fmt::format("  <object id=\"2\" type=\"model\" name=\"{}\"{}>\n", EscapeXml(options.name),
                     parts ? " pid=\"1\" pindex=\"0\"" : "");
  AppendMesh(xml, mesh, details);
  xml += "  </object>\n </resources>\n <build>\n";
  xml += fmt::format("  <item objectid=\"2\" transform=\"1 0 0 0 1 0 0 0 1 {} {} {}\"/>\n",
                     0.0F - box.min().x(), 0.0F - box.min().y(), 0.0F - box.min().z());
  xml += " </build>\n</model>\n";
  return xml;
}

constexpr const char* kContentTypes =
    "<Types xmlns=\"http://schemas.openxmlformats.org/package/2006/content-types\">\n"
    " <Default Extension=\"rels\" "
    "ContentType=\"application/vnd.openxmlformats-package.relationships+xml\"/>\n"
    " <Default Extension=\"model\" "
    "ContentType=\"application/vnd.ms-package.3dmanufacturing-3dmodel+xml\"/>\n"
    " <Default Extension=\"png\" ContentType=\"image/png\"/>\n"
    "</Types>\n";

constexpr const char* kModelRelation =
    " <Relationship Target=\"/3D/3dmodel.model\" Id=\"rel0\" "
    "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/>\n";

constexpr const char* kThumbnailRelation =
    " <Relationship Target=\"/Metadata/thumbnail.png\" Id=\"rel1\" "
    "Type=\"http://schemas.openxmlformats.org/package/2006/relationships/metadata/thumbnail\"/>\n";

}  // namespace

Diagnostics Write3mf(const std::filesystem::path& path, const Mesh& mesh,
                     const MeshDetails& details, const ThreeMfOptions& options) {
  Diagnostics log;
  ZipWriter zip;
  zip.Add("[Content_Types].xml", std::string(kXml) + kContentTypes);
  std::string relations = kModelRelation;
  if (options.thumbnail) {
    const auto png = EncodePng(path, *options.thumbnail).MoveInto(log);
    if (!png) return log;
    zip.Add("Metadata/thumbnail.png", *png);
    relations += kThumbnailRelation;
  }
  zip.Add("_rels/.rels",
          std::string(kXml) +
              "<Relationships "
              "xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">\n" +
              relations + "</Relationships>\n");
  zip.Add("3D/3dmodel.model", ModelXml(mesh, details, options));
  const std::optional<std::string> bytes = zip.Finish();
  if (!bytes) {
    return {Error(FailureKind::kOutput, "cannot-write",
                  fmt::format("cannot write '{}': 3MF holds at most 4 GB; lower the resolution",
                              path.string()))};
  }
  return WriteBytes(path, *bytes);
}

}  // namespace lascaux
