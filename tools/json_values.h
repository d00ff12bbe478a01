#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "lascaux/base/diagnostic.h"
#include "lascaux/sketch/depth_graph.h"
#include "lascaux/sketch/trace_picture.h"

/// @file
/// Values as JSON, written the same way in the report and in the parse dump.

namespace lascaux {

/// Keeps the order in which fields are added, which is the order of the documentation.
using Json = nlohmann::ordered_json;

inline Json PointJson(const Eigen::Vector2d& point) { return {point.x(), point.y()}; }

inline Json PlaceJson(const Eigen::Vector3d& place) { return {place.x(), place.y(), place.z()}; }

inline Json RingJson(const std::vector<Eigen::Vector2d>& ring) {
  Json json = Json::array();
  for (const Eigen::Vector2d& point : ring) json.push_back(PointJson(point));
  return json;
}

/// The value, or null.
template <typename T>
Json OrNull(const std::optional<T>& value) {
  return value ? Json(*value) : Json();
}

/// How well a role is borne out; null where no rule chose it.
inline Json ChoiceJson(const std::optional<RoleChoice>& choice) {
  if (!choice) return nullptr;
  return {{"score", choice->score},
          {"runner_up", Name(choice->runner_up)},
          {"runner_up_score", choice->runner_up_score},
          {"margin", choice->Margin()}};
}

/// How a picture was traced; null for a drawing that needed no tracing.
inline Json TraceJson(const std::optional<TraceFacts>& facts) {
  if (!facts) return nullptr;
  return {{"width", facts->width},
          {"height", facts->height},
          {"ink_width", facts->ink_width},
          {"reduction", facts->reduction},
          {"coverage", facts->coverage},
          {"ink_regions", facts->ink_regions},
          {"curve_regions", facts->curve_regions}};
}

inline Json DiagnosticsJson(const Diagnostics& diagnostics) {
  Json json = Json::array();
  for (const Diagnostic& d : diagnostics)
    json.push_back({{"severity", Name(d.severity)},
                    {"code", d.code},
                    {"message", d.message},
                    {"stroke", OrNull(d.stroke)},
                    {"at", d.at ? PointJson(*d.at) : Json()}});
  return json;
}

/// The text of a document: lines of objects, with arrays of numbers on one line. File names that
/// are no UTF-8 get replacement characters.
std::string JsonText(const Json& json);

}  // namespace lascaux
