#include "sketch/svg/reading.h"

#include <fmt/core.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace lascaux::svg {
namespace {

/// A reading may take as many steps as the longest file has bytes, times this: real documents need
/// a small part of it. It bounds what a small file can ask for by `use` inside `use`, and by style
/// rules times elements.
constexpr std::size_t kStepsPerByte = 4;

/// What an element costs beside its attributes, and a comparison of a selector, in steps.
constexpr std::size_t kStepsPerElement = 256, kStepsPerComparison = 32;

std::size_t AllSteps(const ReadSvgOptions& options) {
  constexpr std::size_t kMost = std::numeric_limits<std::size_t>::max() / kStepsPerByte;
  return std::min(options.max_bytes, kMost) * kStepsPerByte;
}

}  // namespace

Reading::Reading(const Document& document, const ReadSvgOptions& options)
    : document_(document),
      options_(options),
      pieces_left_(options.max_pieces),
      steps_left_(AllSteps(options)) {}

std::string Reading::Name(const pugi::xml_node& element) const {
  const std::string_view id = element.attribute("id").value();
  const std::string tag = Quoted(element.name());
  return fmt::format("{}{}{} ({})", std::string_view(tag).substr(1, tag.size() - 2),
                     id.empty() ? "" : " ", id.empty() ? "" : Quoted(id), document_.Place(element));
}

bool Reading::Spend(const pugi::xml_node& node, std::size_t steps) {
  if (failed()) return false;
  if (steps > steps_left_) {
    Fail("too-large",
         fmt::format("at {} the drawing has taken {} steps to read, the most that are allowed: it "
                     "has too many copies by use, or too many style rules; simplify it",
                     Name(node), AllSteps(options_)));
    return false;
  }
  steps_left_ -= steps;
  return true;
}

bool Reading::SpendOnVisit(const pugi::xml_node& node) {
  std::size_t steps = kStepsPerElement;
  for (const pugi::xml_attribute& attribute : node.attributes()) {
    steps += std::string_view(attribute.name()).size();
    steps += std::string_view(attribute.value()).size();
  }
  return Spend(node, steps);
}

bool Reading::SpendOnStyle(const pugi::xml_node& node, std::size_t comparisons) {
  return Spend(node, comparisons * kStepsPerComparison);
}

bool Reading::SpendPieces(const pugi::xml_node& node, std::size_t pieces) {
  if (pieces > static_cast<std::size_t>(std::max(pieces_left_, 0))) {
    Report(node, {}, Fault::kTooLarge, 0);
    return false;
  }
  pieces_left_ -= static_cast<int>(pieces);
  return true;
}

std::optional<double> Reading::LengthOf(const pugi::xml_node& node, const char* name,
                                        double percent_of) {
  const std::string_view text = Trimmed(node.attribute(name).value());
  if (text.empty() || text == "auto") return std::nullopt;
  const Length length = ParseLength(text, percent_of);
  if (!length.value) Report(node, name, length.fault, 0);
  return length.value;
}

std::optional<Box> Reading::ViewBoxOf(const pugi::xml_node& node) {
  const pugi::xml_attribute attribute = node.attribute("viewBox");
  if (!attribute) return std::nullopt;
  const std::optional<Box> box = ParseViewBox(attribute.value());
  if (!box) Report(node, "viewBox", Fault::kSyntax, 0);
  return box;
}

void Reading::Report(const pugi::xml_node& node, std::string_view attribute, Fault fault,
                     std::size_t offset) {
  switch (fault) {
    case Fault::kNone:
      return;
    case Fault::kNotFinite:
      return Fail("not-finite",
                  fmt::format("{} of {} holds, at byte {}, a number that is none or is beyond "
                              "1e308; correct it",
                              attribute, Name(node), offset));
    case Fault::kTooLarge:
      return Fail("too-large", fmt::format("at {} the drawing has more than {} curve pieces; "
                                           "simplify its paths",
                                           Name(node), options_.max_pieces));
    case Fault::kSyntax:
      break;
  }
  const bool is_path = attribute == "d" || attribute == "points";
  const char* const code = is_path ? "bad-path-data" : "bad-attribute";
  findings_.Add(code, [&] {
    return Warning(
        code,
        fmt::format("{} of {} is wrong at byte {}: {}", attribute, Name(node), offset,
                    is_path ? "what stands before was kept, the rest left out" : "it is ignored"));
  });
}

void Reading::Warn(const char* code, const pugi::xml_node& node, std::string_view what) {
  findings_.Add(code, [&] { return Warning(code, fmt::format("{} {}", Name(node), what)); });
}

void Reading::Fail(const char* code, std::string message) {
  findings_.Add(code, [&] { return Error(FailureKind::kInput, code, std::move(message)); });
}

Outcome<Sketch> Reading::Failed(Diagnostic error) {
  findings_.Add(error.code, [&] { return std::move(error); });
  return Outcome<Sketch>::Failure(std::move(findings_).Take());
}

}  // namespace lascaux::svg
