#pragma once

#include <cstdint>
#include <string>

#include "json_values.h"
#include "model.h"

namespace lascaux {

enum class ReportTimings : std::uint8_t { kWith, kWithout };

/// The report of a run, lascaux.report/1, as JSON text (docs/report.md says what each field means).
///
/// What was not measured is null. Equal runs give equal bytes but for `timings_ms`.
std::string ReportText(const Model& model, ReportTimings timings);

/// What was counted on a mesh, as the report's "mesh" has it.
Json MeshFactsJson(const MeshFacts& facts);

}  // namespace lascaux
