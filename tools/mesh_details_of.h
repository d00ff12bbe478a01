#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "lascaux/base/execution.h"
#include "lascaux/volume/drawing_colors.h"
#include "lascaux/volume/mesh_details.h"
#include "model.h"

namespace lascaux {

/// Names of the field's parts, in its order. Colours are not looked at.
std::vector<std::string> FieldPartNamesOf(const Model& model);

/// Name and colour of each part of the field, in its order: names are the report's, with "-far" for
/// mirror images; a limb and its mirror image have one colour, the drawing's if the model has its
/// colours, else PartColor().
///
/// Precondition: graph and creature are there.
std::vector<MeshPart> FieldPartsOf(const Model& model);

/// The PartColor() of each part of the field by its name, linear: a mirror image has that of the
/// part before it.
std::vector<std::array<float, 3>> PaletteOf(const std::vector<std::string>& names);

/// The colours that the model's drawing gives it; nothing when it has none.
///
/// Precondition: graph, creature, frame, mesh and details are there.
std::optional<DrawingColors> DrawingColorsOf(const Model& model, const Execution& execution = {});

/// Gives a mesh's parts and vertices the drawing's colours; parts that it does not know keep
/// theirs.
void Paint(const DrawingColors& colors, const Mesh& mesh, MeshDetails& details);

/// Normals and parts from the field, for the model's mesh, whose own normals they are then.
///
/// Precondition: graph, creature, field and mesh are there.
MeshDetails MeshDetailsOf(Model& model, const Execution& execution = {});

}  // namespace lascaux
