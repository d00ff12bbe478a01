#include "mesh_details_of.h"

#include <algorithm>
#include <cassert>

#include "lascaux/volume/part_of_points.h"
#include "lascaux/volume/vertex_normals.h"
#include "record_print.h"

namespace lascaux {

std::vector<MeshPart> FieldPartsOf(const Model& model) {
  // MakeField's order: each part of the creature, then its mirror image.
  std::vector<MeshPart> parts;
  int colors = 0;
  for (const CreaturePart& part : model.creature->parts) {
    const std::string& name = model.graph->nodes[static_cast<std::size_t>(part.part)].name;
    const Srgb8 color = PartColor(colors++);
    parts.push_back({name, color});
    if (part.mirrored) parts.push_back({name + "-far", color});
  }
  return parts;
}

MeshDetails MeshDetailsOf(const Model& model, const Execution& execution) {
  MeshDetails details;
  const Eigen::Vector3d to_field(0, -model.lift, 0);
  details.normals = model.print_record
                        ? VertexNormals(*model.mesh)  // the field knows nothing of the changes
                        : FieldNormals(*model.mesh, *model.field, to_field, execution);
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
