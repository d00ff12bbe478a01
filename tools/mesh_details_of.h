#pragma once

#include <string>
#include <vector>

#include "lascaux/base/execution.h"
#include "lascaux/volume/mesh_details.h"
#include "model.h"

namespace lascaux {

/// Name and colour of each part of the field, in its order: names are the report's, with "-far" for
/// mirror images; a limb and its mirror image have one colour.
///
/// Precondition: graph and creature are there.
std::vector<MeshPart> FieldPartsOf(const Model& model);

/// Normals and parts from the field, for the model's mesh.
///
/// Precondition: graph, creature, field and mesh are there.
MeshDetails MeshDetailsOf(const Model& model, const Execution& execution = {});

}  // namespace lascaux
