#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <variant>
#include <vector>

#include "command.h"
#include "command_line.h"
#include "grid_plugin.h"
#include "interrupt.h"
#include "messages.h"

namespace {

int Run(int argc, char** argv) {
  using lascaux::Answer;
  const auto parsed = lascaux::ParseCommandLine(std::vector<std::string>(argv + 1, argv + argc));
  if (const auto* answer = std::get_if<Answer>(&parsed)) {
    const bool good = answer->code == lascaux::ExitCode::kSuccess;
    std::fputs(answer->text.c_str(), good ? stdout : stderr);
    return static_cast<int>(answer->code);
  }
  const auto& line = std::get<lascaux::CommandLine>(parsed);
  const lascaux::Execution execution{
      .threads = line.threads, .cancel = &lascaux::WatchForInterrupts(), .progress = {}};
  if (line.verb == lascaux::Verb::kRender) {
    const auto& plugin = lascaux::LoadGridPlugin();
    if (plugin) return static_cast<int>((*plugin)->run_render(line.render, execution));
    lascaux::PrintMessages(stderr, "lascaux", plugin.diagnostics(), line.render.verbosity);
    return static_cast<int>(lascaux::ExitCodeOf(plugin.diagnostics()));
  }
  return static_cast<int>(lascaux::RunCommand(line.verb, line.options, execution));
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return Run(argc, argv);
  } catch (const std::bad_alloc&) {
    std::fputs(
        "lascaux: error: out-of-memory: there is not enough memory for this; take a lower "
        "--resolution\n",
        stderr);
    return static_cast<int>(lascaux::ExitCode::kUsage);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "lascaux: error: internal-error: %s; this is a bug, please report it\n",
                 error.what());
  }
  return static_cast<int>(lascaux::ExitCode::kBug);
}
