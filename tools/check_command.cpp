#include "check_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>

#include "json_values.h"
#include "lascaux/io/output_file.h"
#include "lascaux/io/read_file.h"
#include "lascaux/io/read_mesh.h"
#include "lascaux/volume/check_mesh.h"
#include "messages.h"
#include "output_plan.h"
#include "print_facts.h"
#include "report.h"

namespace lascaux {
namespace {

/// One mesh of a call and what was found.
struct Checked {
  std::string file;
  std::optional<LoadedMesh> loaded;
  MeshFacts facts;
  PrintFacts print;
  Diagnostics diagnostics;
};

Checked Check(const std::string& file, const Execution& execution) {
  Checked checked;
  checked.file = file;
  const auto bytes =
      ReadBytes(file, {.max_bytes = std::size_t{8} << 30}).MoveInto(checked.diagnostics);
  if (!bytes) return checked;
  checked.loaded = ReadMesh(*bytes).MoveInto(checked.diagnostics);
  if (!checked.loaded) return checked;
  const LoadedMesh& loaded = *checked.loaded;
  checked.facts = CheckMesh(loaded.mesh, execution);
  checked.facts.volume *= loaded.millimetres * loaded.millimetres * loaded.millimetres;
  checked.facts.area *= loaded.millimetres * loaded.millimetres;
  checked.print = MeasureForPrint(loaded.mesh, loaded.details, loaded.millimetres, execution);
  for (const Diagnostics& found : {MeshDefects(checked.facts), PrintWarnings(checked.print)})
    checked.diagnostics.insert(checked.diagnostics.end(), found.begin(), found.end());
  if (execution.IsCancelled())
    checked.diagnostics.push_back(
        Error(FailureKind::kInterrupted, "cancelled", "interrupted; nothing was written"));
  return checked;
}

std::string CheckJson(const Checked& checked) {
  Json json = {{"format", "lascaux.check/1"}, {"file", checked.file}};
  json["printable"] = checked.loaded && checked.facts.IsPrintable();
  json["file_format"] = nullptr;
  json["millimetres_per_unit"] = nullptr;
  json["mesh"] = nullptr;
  if (checked.loaded) {
    json["file_format"] = Name(checked.loaded->format);
    json["millimetres_per_unit"] = checked.loaded->millimetres;
    json["mesh"] = MeshFactsJson(checked.facts);
    json["mesh"].update(PrintFactsJson(checked.print));
  }
  json["diagnostics"] = DiagnosticsJson(checked.diagnostics);
  return JsonText(json);
}

std::string CheckText(const Checked& checked) {
  const MeshFacts& facts = checked.facts;
  const PrintFacts& print = checked.print;
  const auto yes = [](bool holds) { return holds ? "yes" : "NO"; };
  const auto number = [](const auto& value) {
    return value ? fmt::format("{}", *value) : std::string("not measured");
  };
  std::string text =
      fmt::format("{}: {}\n", checked.file, facts.IsPrintable() ? "printable" : "NOT PRINTABLE");
  const auto row = [&text](const char* name, const std::string& value) {
    text += fmt::format("  {:<20} {}\n", name, value);
  };
  row("format", fmt::format("{}, {} triangles, {} vertices", Name(checked.loaded->format),
                            facts.triangles, facts.vertices));
  row("closed", yes(facts.closed));
  row("two-manifold", yes(facts.manifold));
  row("faces outward", yes(facts.oriented));
  row("self-intersections", number(facts.self_intersections));
  row("without area", fmt::format("{} triangles", facts.degenerate));
  row("coincident", fmt::format("{} vertices", facts.coincident));
  row("pieces", fmt::format("{}", facts.components));
  row("genus", number(facts.genus));
  row("size", fmt::format("{:.4g} x {:.4g} x {:.4g} mm (length, height, depth)", print.size.x(),
                          print.size.y(), print.size.z()));
  row("volume", fmt::format("{:.6g} mm3", facts.volume));
  row("area", fmt::format("{:.6g} mm2", facts.area));
  if (print.wall)
    row("smallest wall",
        fmt::format("{:.3g} mm at ({:.4g}, {:.4g}, {:.4g}){}{}", print.wall->thickness,
                    print.wall->middle.x(), print.wall->middle.y(), print.wall->middle.z(),
                    print.wall_part.empty() ? "" : ", ", print.wall_part));
  if (print.stability)
    row("stands",
        fmt::format("{}, centre of mass {:.3g} mm {}", yes(print.stability->Stands()),
                    std::abs(print.stability->margin),
                    print.stability->Stands()
                        ? "within the feet's outline"
                        : fmt::format("outside of the feet's outline: it rolls by {:.0f} degrees",
                                      print.stability->tilt)));
  return text;
}

/// Writes the JSON files of one mesh, all or none.
Diagnostics WriteFiles(const Checked& checked, const std::vector<OutputTarget>& targets) {
  Diagnostics log;
  OutputSet files;
  for (const OutputTarget& target : targets) {
    if (target.path == "-") {
      std::fputs(CheckJson(checked).c_str(), stdout);
      continue;
    }
    const auto path = files.Add(target.path).MoveInto(log);
    if (!path) return log;
    if (Diagnostics found = WriteBytes(*path, CheckJson(checked)); !found.empty()) return found;
  }
  return files.Commit();
}

}  // namespace

ExitCode RunCheck(const CommandOptions& options, const Execution& execution) {
  Diagnostics log;
  const auto requests = ReadOutputNames(Verb::kCheck, options.outputs).MoveInto(log);
  const auto plan =
      requests ? PlanOutputs(options.sketches, *requests).MoveInto(log) : std::nullopt;
  if (!plan) {
    PrintMessages(stderr, "lascaux", log, options.verbosity);
    return ExitCode::kUsage;
  }
  ExitCode worst = ExitCode::kSuccess;
  for (std::size_t i = 0; i < options.sketches.size() && !execution.IsCancelled(); ++i) {
    Checked checked = Check(options.sketches[i], execution);
    const std::vector<OutputTarget>& targets = (*plan)[i];
    const bool piped = std::any_of(targets.begin(), targets.end(),
                                   [](const auto& target) { return target.path == "-"; });
    if (checked.loaded && !piped && options.verbosity != Verbosity::kQuiet)
      std::fputs(CheckText(checked).c_str(), stdout);
    if (!execution.IsCancelled()) {
      const Diagnostics found = WriteFiles(checked, targets);
      checked.diagnostics.insert(checked.diagnostics.end(), found.begin(), found.end());
    }
    PrintMessages(stderr, checked.file, checked.diagnostics, options.verbosity);
    worst = Worse(worst, ExitCodeOf(checked.diagnostics));
  }
  return execution.IsCancelled() ? Worse(worst, ExitCode::kInterrupted) : worst;
}

}  // namespace lascaux
