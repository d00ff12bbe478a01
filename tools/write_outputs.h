#pragma once

#include <string>
#include <utility>
#include <vector>

#include "lascaux/base/diagnostic.h"
#include "lascaux/base/execution.h"
#include "lascaux/io/units.h"
#include "model.h"
#include "output_plan.h"
#include "report.h"
#include "volume_options.h"

namespace lascaux {

struct WriteOptions {
  Unit unit = Unit::kMetre;  ///< of the scene formats
  VolumeOptions volume;
  ReportTimings timings = ReportTimings::kWith;
  /// Text metadata of the formats that take it: creator, version, the sketch's hash, the options.
  std::vector<std::pair<std::string, std::string>> metadata;
  std::string name;  ///< of the model: the sketch's
};

/// Writes the files of one sketch, all or none; one with the path "-" goes to standard output when
/// all are complete, before the others appear. When the model has an error, only the report, the
/// parse picture and the parse dump are written, for they hold the diagnosis.
///
/// Adds the time that it took to the model's timings (the report's own writing left out), and its
/// errors to the model's diagnostics.
void WriteOutputs(Model& model, const std::vector<OutputTarget>& targets,
                  const WriteOptions& options, const Execution& execution = {});

}  // namespace lascaux
