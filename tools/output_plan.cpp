#include "output_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string_view>
#include <system_error>

namespace lascaux {
namespace {

namespace fs = std::filesystem;

struct Ending {
  std::string_view text;
  OutputKind kind;
};

constexpr std::array kBuildEndings = {
    Ending{".vdb", OutputKind::kVdb},         Ending{".stl", OutputKind::kStl},
    Ending{".3mf", OutputKind::k3mf},         Ending{".glb", OutputKind::kGlb},
    Ending{".obj", OutputKind::kObj},         Ending{".ply", OutputKind::kPly},
    Ending{".usda", OutputKind::kUsda},       Ending{".png", OutputKind::kPng},
    Ending{".exr", OutputKind::kExr},         Ending{".json", OutputKind::kReport},
    Ending{".svg", OutputKind::kParsePicture}};
constexpr std::array kInspectEndings = {Ending{".svg", OutputKind::kParsePicture},
                                        Ending{".json", OutputKind::kParseDump}};
constexpr std::array kRenderEndings = {Ending{".png", OutputKind::kPng},
                                       Ending{".exr", OutputKind::kExr}};
constexpr std::array kTraceEndings = {Ending{".svg", OutputKind::kCurves},
                                      Ending{".json", OutputKind::kTraceFacts}};
constexpr std::array kCheckEndings = {Ending{".json", OutputKind::kReport}};
constexpr std::string_view kBuildFormats =
    ".vdb .stl .3mf .glb .obj .ply .usda .png .exr .json .svg";
constexpr std::string_view kInspectFormats = ".svg .json";
constexpr std::string_view kTraceFormats = ".svg .json";
constexpr std::string_view kRenderFormats = ".png .exr";

struct VerbFormats {
  std::string_view verb;
  std::span<const Ending> endings;
  std::string_view list;
};

VerbFormats FormatsOf(Verb verb) {
  switch (verb) {
    case Verb::kInspect:
      return {"inspect", kInspectEndings, kInspectFormats};
    case Verb::kRender:
      return {"render", kRenderEndings, kRenderFormats};
    case Verb::kTrace:
      return {"trace", kTraceEndings, kTraceFormats};
    case Verb::kCheck:
      return {"check", kCheckEndings, ".json"};
    case Verb::kBuild:
      break;
  }
  return {"build", kBuildEndings, kBuildFormats};
}

std::optional<OutputKind> KindOf(std::span<const Ending> endings, const std::string& ending) {
  const auto found = std::find_if(endings.begin(), endings.end(),
                                  [&](const Ending& e) { return e.text == ending; });
  if (found == endings.end()) return std::nullopt;
  return found->kind;
}

std::string LowerCaseEnding(const std::string& name) {
  std::string ending = fs::path(name).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

Diagnostic Usage(std::string code, std::string message) {
  return Error(FailureKind::kUsage, std::move(code), std::move(message));
}

std::string Substitute(const std::string& name, const std::string& stem) {
  std::string result;
  std::size_t from = 0;
  for (std::size_t at; (at = name.find("{}", from)) != std::string::npos; from = at + 2)
    result += name.substr(from, at - from) + stem;
  return result + name.substr(from);
}

/// A form in which two names of one file are equal, also when it does not exist yet.
fs::path Identity(const fs::path& path) {
  std::error_code error;
  const fs::path canonical = fs::weakly_canonical(fs::absolute(path, error), error);
  return error ? path.lexically_normal() : canonical;
}

}  // namespace

std::string SketchName(const std::string& sketch) {
  return sketch == "-" ? "stdin" : fs::path(sketch).stem().string();
}

Outcome<std::vector<OutputRequest>> ReadOutputNames(Verb verb,
                                                    const std::vector<std::string>& names) {
  std::vector<OutputRequest> requests;
  Diagnostics errors;
  for (const std::string& name : names) {
    const VerbFormats formats = FormatsOf(verb);
    if (name == "-" && (verb == Verb::kCheck || verb == Verb::kBuild)) {
      requests.push_back({verb == Verb::kCheck ? OutputKind::kReport : OutputKind::kVdb, name});
      continue;
    }
    if (name == "-") {
      errors.push_back(Usage(
          "stdout-output",
          fmt::format("-o -: {} writes to files; name one of {}", formats.verb, formats.list)));
      continue;
    }
    const std::string ending = LowerCaseEnding(name);
    const auto kind = KindOf(formats.endings, ending);
    if (kind) {
      requests.push_back({*kind, name});
    } else {
      errors.push_back(
          Usage("unknown-format",
                fmt::format("-o {}: the ending '{}' names no format that {} writes; use one of {}",
                            name, ending, formats.verb, formats.list)));
    }
  }
  if (!errors.empty()) return Outcome<std::vector<OutputRequest>>::Failure(std::move(errors));
  return requests;
}

bool HasLayers(const std::vector<OutputTarget>& targets) {
  return std::any_of(targets.begin(), targets.end(),
                     [](const OutputTarget& target) { return target.kind == OutputKind::kExr; });
}

Outcome<std::vector<std::vector<OutputTarget>>> PlanOutputs(
    const std::vector<std::string>& sketches, const std::vector<OutputRequest>& requests) {
  std::vector<std::vector<OutputTarget>> plan;
  std::set<fs::path> inputs, outputs;
  Diagnostics errors;
  for (const OutputRequest& request : requests)
    if (sketches.size() > 1 && request.name.find("{}") == std::string::npos)
      errors.push_back(Usage("output-name",
                             fmt::format("{}: with several sketches each output's name holds {{}}, "
                                         "which stands for the sketch's name",
                                         request.name)));
  for (const std::string& sketch : sketches)
    if (sketch != "-") inputs.insert(Identity(sketch));
  for (const std::string& sketch : sketches) {
    const std::string stem = SketchName(sketch);
    std::vector<OutputTarget>& targets = plan.emplace_back();
    for (const OutputRequest& request : requests) {
      const fs::path path = Substitute(request.name, stem);
      const fs::path identity = Identity(path);
      if (inputs.contains(identity))
        errors.push_back(Usage(
            "output-name", fmt::format("{}: this is an input; it would be lost", path.string())));
      else if (!outputs.insert(identity).second && errors.empty())
        errors.push_back(
            Usage("output-name", fmt::format("{}: two outputs have this name", path.string())));
      targets.push_back({request.kind, path});
    }
  }
  if (!errors.empty())
    return Outcome<std::vector<std::vector<OutputTarget>>>::Failure(std::move(errors));
  return plan;
}

}  // namespace lascaux
