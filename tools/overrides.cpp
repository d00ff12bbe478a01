#include "overrides.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <string>
#include <variant>

#include "json_values.h"

namespace lascaux {
namespace {

constexpr std::string_view kFormat = "lascaux.overrides/1";

/// Reads values of a document; the first that is not what it has to be is remembered, and what is
/// read after it means nothing.
class Reader {
 public:
  const std::optional<std::string>& problem() const { return problem_; }

  void Refuse(const std::string& field, const std::string& wanted) {
    if (!problem_) problem_ = fmt::format("{}: {}", field, wanted);
  }

  /// Refuses objects with other fields than these, and what is no object.
  void CheckFields(const Json& json, const std::string& field,
                   std::initializer_list<std::string_view> known) {
    if (!json.is_object())
      return Refuse(field.empty() ? "the document" : field, "has to be an object");
    for (const auto& [key, value] : json.items()) {
      if (std::find(known.begin(), known.end(), key) == known.end())
        Refuse(field.empty() ? key : field + "." + key,
               fmt::format("is unknown; there are {}", fmt::join(known, ", ")));
    }
  }

  /// The elements of an optional list.
  std::vector<Json> List(const Json& json, const std::string& field) {
    if (!json.contains(field)) return {};
    if (json[field].is_array()) return {json[field].begin(), json[field].end()};
    Refuse(field, "has to be a list");
    return {};
  }

  Eigen::Vector2d Point(const Json& json, const std::string& field) {
    if (json.is_array() && json.size() == 2 && json[0].is_number() && json[1].is_number())
      return {json[0].get<double>(), json[1].get<double>()};
    Refuse(field, "has to be a point, [x, y] in the sketch's units");
    return Eigen::Vector2d::Zero();
  }

  int Id(const Json& json, const std::string& field) {
    constexpr std::int64_t kMost = 1'000'000'000;
    if (json.is_number_integer() && json.get<std::int64_t>() >= 0 &&
        json.get<std::int64_t>() <= kMost)
      return json.get<int>();
    Refuse(field, "has to be a whole number, 0 or more");
    return 0;
  }

  PartReference Part(const Json& json, const std::string& field) {
    if (json.is_array()) return Point(json, field);
    if (json.is_number_integer()) return Id(json, field);
    Refuse(field, "has to name a part by its number or by a point in it, [x, y]");
    return 0;
  }

  PartRole Role(const Json& json, const std::string& field) {
    for (const PartRole role :
         {PartRole::kForeground, PartRole::kBackground, PartRole::kSagittal, PartRole::kIgnored}) {
      if (json == Name(role)) return role;
    }
    Refuse(field, "has to be \"foreground\", \"background\", \"sagittal\" or \"ignored\"");
    return PartRole::kIgnored;
  }

  PartOverride Override(const Json& json, const std::string& field) {
    PartOverride result;
    CheckFields(json, field, {"part", "role", "near", "flat"});
    if (problem_) return result;
    if (!json.contains("part")) Refuse(field + ".part", "is missing");
    if (json.contains("part")) result.part = Part(json["part"], field + ".part");
    if (json.contains("role")) result.role = Role(json["role"], field + ".role");
    if (json.contains("near")) result.near = Part(json["near"], field + ".near");
    if (json.contains("flat")) {
      if (!json["flat"].is_boolean()) Refuse(field + ".flat", "has to be true or false");
      result.flat = json["flat"] == true;
    }
    const bool far = result.role == PartRole::kBackground;
    if (far && !result.near)
      Refuse(field + ".near", "is missing; a background part belongs to a near one");
    if (!far && result.near) Refuse(field + ".near", "goes with \"role\": \"background\" alone");
    if (!result.role && !json.contains("flat"))
      Refuse(field, "says nothing; give a \"role\", or \"flat\": true");
    return result;
  }

 private:
  std::optional<std::string> problem_;
};

PipelineOptions Apply(Reader& reader, const Json& json, PipelineOptions options) {
  reader.CheckFields(json, "", {"format", "body", "ignore_strokes", "cuts", "parts"});
  if (reader.problem()) return options;
  if (!json.contains("format") || json["format"] != kFormat)
    reader.Refuse("format", fmt::format("has to be \"{}\"", kFormat));
  for (const Json& stroke : reader.List(json, "ignore_strokes"))
    options.map.ignored_strokes.push_back(reader.Id(stroke, "ignore_strokes"));
  for (const Json& cut : reader.List(json, "cuts")) {
    if (!cut.is_array() || cut.size() != 2) {
      reader.Refuse("cuts", "each has to be the two ends of a limb's root, [[x, y], [x, y]]");
      break;
    }
    options.parts.cuts.push_back({reader.Point(cut[0], "cuts"), reader.Point(cut[1], "cuts")});
  }
  if (json.contains("body") && !options.depth.body) {
    const PartReference body = reader.Part(json["body"], "body");
    if (const int* id = std::get_if<int>(&body)) options.depth.body_part = *id;
    if (const auto* at = std::get_if<Eigen::Vector2d>(&body)) options.depth.body = *at;
  }
  int number = 0;
  for (const Json& part : reader.List(json, "parts"))
    options.depth.overrides.push_back(reader.Override(part, fmt::format("parts[{}]", number++)));
  return options;
}

Outcome<PipelineOptions> Bad(const std::string& what) {
  return Outcome<PipelineOptions>::Failure(Error(
      FailureKind::kInput, "bad-overrides", fmt::format("the overrides can't be read: {}", what)));
}

}  // namespace

Outcome<PipelineOptions> WithOverrides(PipelineOptions options, std::string_view text) {
  Json json;
  try {
    json = Json::parse(text);
  } catch (const Json::parse_error& error) {
    return Bad(fmt::format("what begins at byte {} is no JSON", error.byte));
  }
  Reader reader;
  options = Apply(reader, json, std::move(options));
  if (reader.problem()) return Bad(*reader.problem());
  return options;
}

}  // namespace lascaux
