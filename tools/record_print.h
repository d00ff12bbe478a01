#pragma once

#include <optional>

#include "json_values.h"
#include "lascaux/base/diagnostic.h"
#include "lascaux/base/execution.h"
#include "lascaux/volume/mesh_details.h"
#include "model.h"

/// @file
/// What people and scripts are told of the changes for printing.

namespace lascaux {

/// Names the parts that were changed. The model stands where it stood when they were made.
PrintRecord RecordOf(PrintChanges changes, const Model& model, const Execution& execution);

/// Moves all places in it up.
void Lift(PrintRecord& record, double by);

/// Notes "wall-thickened", "base-added", "stands-alone" and "hollowed", warning "not-hollowed".
Diagnostics DescribeChanges(const PrintRecord& record, const PrintOptions& options);

/// Makes the plate a part "base" of its own; before PartsOfTriangles.
void MarkPlate(const PrintRecord& record, const Mesh& mesh, MeshDetails& details);

/// Null when nothing was asked for.
Json PrintRecordJson(const std::optional<PrintRecord>& record);

}  // namespace lascaux
