#pragma once

#include <string>
#include <variant>
#include <vector>

#include "command.h"
#include "exit_code.h"
#include "render_command.h"

namespace lascaux {

/// A command line that asks for work.
struct CommandLine {
  Verb verb = Verb::kBuild;
  CommandOptions options;
  RenderCommandOptions render;  ///< for Verb::kRender, instead of `options`
  int threads = 0;              ///< 0: all that the machine has
};

/// A command line that is answered at once: with help or the version on standard output, or an
/// error on standard error.
struct Answer {
  ExitCode code = ExitCode::kSuccess;
  std::string text;
};

/// Understands the arguments (without the program's name).
std::variant<CommandLine, Answer> ParseCommandLine(std::vector<std::string> arguments);

}  // namespace lascaux
