#pragma once

#include <string>
#include <vector>

#include "exit_code.h"
#include "lascaux/base/execution.h"
#include "messages.h"
#include "run_pipeline.h"
#include "write_outputs.h"

namespace lascaux {

/// What `lascaux build`, `inspect` and `trace` are told on the command line.
struct CommandOptions {
  std::vector<std::string> sketches;  ///< paths, "-" for standard input
  std::vector<std::string> outputs;   ///< values of -o
  std::vector<std::string> reports;   ///< values of --report
  std::string format;                 ///< of what comes from standard input: "svg", "png" or "jpg"
  Verbosity verbosity = Verbosity::kAll;
  std::string overrides;  ///< a file of corrections; empty for none
  PipelineOptions pipeline;
  WriteOptions write;
};

/// Builds or inspects every sketch in turn, writes what was asked for and says on standard error
/// what there is to say.
///
/// Returns the worst exit code. Nothing is begun when the command line is wrong; after an interrupt
/// no other sketch is begun.
ExitCode RunCommand(Verb verb, const CommandOptions& options, const Execution& execution);

}  // namespace lascaux
