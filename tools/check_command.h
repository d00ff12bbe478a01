#pragma once

#include "command.h"
#include "exit_code.h"
#include "lascaux/base/execution.h"

namespace lascaux {

/// `lascaux check`: measures each mesh of options.sketches, says what it found on standard output
/// (for people) and writes what was asked for as JSON ("-" is standard output instead of the text).
///
/// Defects are errors on standard error. Returns the worst exit code: 0 for printable meshes, 6 for
/// others, 3 for what can't be read.
ExitCode RunCheck(const CommandOptions& options, const Execution& execution);

}  // namespace lascaux
