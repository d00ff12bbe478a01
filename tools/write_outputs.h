#pragma once

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lascaux/base/diagnostic.h"
#include "lascaux/base/execution.h"
#include "lascaux/base/outcome.h"
#include "lascaux/io/output_file.h"
#include "lascaux/io/stream_file.h"
#include "lascaux/io/units.h"
#include "model.h"
#include "output_plan.h"
#include "report.h"
#include "run_pipeline.h"
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

/// The files of one sketch, which appear all or not at all; one with the path "-" goes to standard
/// output when all are complete, before the others appear.
class OutputWriter {
 public:
  OutputWriter(const std::vector<OutputTarget>& targets, const Execution& execution)
      : targets_(targets), execution_(execution), found_(targets.size()) {}

  /// Writes what is ready of the files that hold the model or show it, which nobody sees before
  /// Finish(). What the check of the mesh finds is in none of them. Calls may be side by side.
  void WriteModel(const Model& model, Ready ready, const WriteOptions& options);

  /// Writes the others, reports last, and gives all of them their names. When the model has an
  /// error, only the report, the parse picture and the parse dump appear, for they hold the
  /// diagnosis.
  ///
  /// Adds the time that writing took to the model's timings (the report's own left out), and its
  /// errors to the model's diagnostics.
  void Finish(Model& model, const WriteOptions& options);

 private:
  /// The index of a target says its turn among the messages.
  using Numbered = std::vector<std::size_t>;

  template <typename Is>
  Numbered Chosen(const Is& is) const;
  Outcome<std::filesystem::path> Add(const OutputTarget& target);
  void Write(const Model& model, const WriteOptions& options, const Numbered& chosen);
  Diagnostics TakeLog();

  const std::vector<OutputTarget>& targets_;
  const Execution& execution_;
  OutputSet files_;
  std::optional<StreamFile> stream_;
  std::vector<Diagnostics> found_;  ///< of each target
  std::mutex adding_;
  std::atomic<double> writing_ = 0;  ///< ms
};

}  // namespace lascaux
