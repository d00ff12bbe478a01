#include "mesh_details_of.h"

#include <algorithm>
#include <cassert>
#include <string_view>

#include "lascaux/volume/part_of_points.h"
#include "lascaux/volume/vertex_normals.h"
#include "record_print.h"

namespace lascaux {

namespace {

constexpr std::string_view kFar = "-far";
/// Of the drawing's raster along its longer side: finer than voxels and pens.
constexpr int kColorPixels = 768;

}  // namespace

std::vector<std::string> FieldPartNamesOf(const Model& model) {
  // MakeField's order: each part of the creature, then its mirror image.
  std::vector<std::string> names;
  for (const CreaturePart& part : model.creature->parts) {
    names.push_back(model.graph->nodes[static_cast<std::size_t>(part.part)].name);
    if (part.mirrored) names.push_back(names.back() + std::string(kFar));
  }
  return names;
}

std::vector<MeshPart> FieldPartsOf(const Model& model) {
  const std::vector<std::string> names = FieldPartNamesOf(model);
  std::vector<MeshPart> parts;
  int colors = 0;
  for (const CreaturePart& part : model.creature->parts) {
    const Srgb8 color = model.colors ? model.colors->OfPart(parts.size()) : PartColor(colors++);
    parts.push_back({names[parts.size()], color});
    if (part.mirrored) parts.push_back({names[parts.size()], color});
  }
  return parts;
}

std::vector<std::array<float, 3>> PaletteOf(const std::vector<std::string>& names) {
  std::vector<std::array<float, 3>> palette;
  int colors = 0;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0 && names[i] == names[i - 1] + std::string(kFar)) {
      palette.push_back(palette.back());
      continue;
    }
    const Srgb8 color = PartColor(colors++);
    palette.push_back(
        {LinearFromSrgb(color[0]), LinearFromSrgb(color[1]), LinearFromSrgb(color[2])});
  }
  return palette;
}

std::optional<DrawingColors> DrawingColorsOf(const Model& model, const Execution& execution) {
  const auto page = model.picture ? ColorsOf(*model.picture, *model.sketch, kColorPixels)
                                  : ColorsOf(*model.sketch, kColorPixels);
  if (!page) return std::nullopt;
  ColoredView view{*model.mesh, model.details->triangle_parts, {}, *model.frame};
  std::uint16_t layer = 0;
  for (const CreaturePart& part : model.creature->parts) {
    view.layer_of_part.insert(view.layer_of_part.end(), part.mirrored ? 2 : 1, layer++);
  }
  return ProjectColors(*page, view, execution);
}

void Paint(const DrawingColors& colors, const Mesh& mesh, MeshDetails& details) {
  const std::size_t known = colors.layer_of_part.size();
  for (std::size_t i = 0; i < known; ++i) details.parts[i].color = colors.OfPart(i);
  details.vertex_colors.reserve(mesh.vertices.size());
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const std::uint16_t part = details.vertex_parts[v];
    if (part >= known) {
      details.vertex_colors.push_back(details.parts[part].color);
      continue;
    }
    const Eigen::Array3f c = colors.At(part, mesh.vertices[v].x(), mesh.vertices[v].y());
    details.vertex_colors.push_back(
        {SrgbFromLinear(c[0]), SrgbFromLinear(c[1]), SrgbFromLinear(c[2])});
  }
}

MeshDetails MeshDetailsOf(Model& model, const Execution& execution) {
  MeshDetails details;
  const Eigen::Vector3d to_field(0, -model.lift, 0);
  details.normals = model.print_record
                        ? VertexNormals(*model.mesh)  // the field knows nothing of the changes
                        : TakeFieldNormals(*model.mesh, *model.field, to_field, execution);
  details.parts = FieldPartsOf(model);
  assert(details.parts.size() == model.field->parts.size());
  details.vertex_parts = PartOfPoints(*model.field, model.mesh->vertices, to_field, execution);
  // What no part reaches belongs to the body.
  std::replace(details.vertex_parts.begin(), details.vertex_parts.end(), kNoPart, std::uint16_t{0});
  if (model.print_record) MarkPlate(*model.print_record, *model.mesh, details);
  details.triangle_parts = PartsOfTriangles(model.mesh->triangles, details.vertex_parts);
  return details;
}

}  // namespace lascaux
