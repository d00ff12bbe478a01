#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "lascaux/base/outcome.h"

/// @file
/// Which files a run writes: the names on the command line, understood before any work is done.

namespace lascaux {

enum class OutputKind : std::uint8_t {
  kVdb,
  kStl,
  k3mf,
  kGlb,
  kObj,
  kPly,
  kUsda,
  kPng,
  kExr,
  kReport,
  kParsePicture,
  kParseDump,
  kCurves,
  kTraceFacts
};

/// True for the files that hold the model or show it; they don't appear when the build failed.
constexpr bool IsModel(OutputKind kind) noexcept {
  return kind != OutputKind::kReport && kind != OutputKind::kParsePicture &&
         kind != OutputKind::kParseDump && kind != OutputKind::kCurves &&
         kind != OutputKind::kTraceFacts;
}

/// True for pictures of the model.
constexpr bool IsPicture(OutputKind kind) noexcept {
  return kind == OutputKind::kPng || kind == OutputKind::kExr;
}

/// True for the files that hold more of a mesh than triangles: normals, parts and their colours.
constexpr bool HoldsDetails(OutputKind kind) noexcept {
  return kind == OutputKind::k3mf || kind == OutputKind::kGlb || kind == OutputKind::kObj ||
         kind == OutputKind::kPly || kind == OutputKind::kUsda;
}

/// True for the files that go to a printer.
constexpr bool IsPrinted(OutputKind kind) noexcept {
  return kind == OutputKind::kStl || kind == OutputKind::k3mf;
}

/// A name as given: it may hold "{}".
struct OutputRequest {
  OutputKind kind = OutputKind::kVdb;
  std::string name;
};

/// A file to write.
struct OutputTarget {
  OutputKind kind = OutputKind::kVdb;
  std::filesystem::path path;
};

/// True for what goes to standard output: the path "-". A file of this name is "./-".
inline bool IsStandardOutput(const OutputTarget& target) { return target.path == "-"; }

/// True when one of them holds more of a picture than its colours.
bool HasLayers(const std::vector<OutputTarget>& targets);

/// What stands for "{}": the sketch's file name without its ending, "stdin" for "-".
std::string SketchName(const std::string& sketch);

/// What the verbs of the program write: an ending stands for a format.
enum class Verb : std::uint8_t { kBuild, kInspect, kTrace, kRender, kCheck };

/// The formats that the names' endings ask for. "-" is standard output: of kBuild for a .vdb, of
/// kCheck for its report. Errors: "unknown-format", "stdout-output" (for the other verbs).
Outcome<std::vector<OutputRequest>> ReadOutputNames(Verb verb,
                                                    const std::vector<std::string>& names);

/// The files of each sketch, "{}" replaced by the sketch's name without its ending ("stdin" for
/// "-").
///
/// Errors: "output-name" (several sketches and a name without "{}", two outputs at one path, an
/// output that is an input).
Outcome<std::vector<std::vector<OutputTarget>>> PlanOutputs(
    const std::vector<std::string>& sketches, const std::vector<OutputRequest>& requests);

}  // namespace lascaux
