#include "json_values.h"

#include <algorithm>

namespace lascaux {
namespace {

constexpr std::size_t kIndent = 2;  // spaces a level

/// True for values that are written on one line: everything but objects that hold more than
/// scalars, and arrays of objects.
bool IsFlat(const Json& json) {
  if (json.is_array())
    return std::all_of(json.begin(), json.end(),
                       [](const Json& item) { return !item.is_object() && IsFlat(item); });
  if (json.is_object())
    return std::all_of(json.begin(), json.end(), [](const Json& item) { return IsFlat(item); });
  return true;
}

std::string OneLine(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

void Append(const Json& json, std::size_t level, std::string& text) {
  if (level > 0 && IsFlat(json)) {
    text += OneLine(json);
    return;
  }
  const bool object = json.is_object();
  text += object ? '{' : '[';
  const char* separator = "\n";
  for (const auto& [key, item] : json.items()) {
    text += separator;
    text.append(kIndent * (level + 1), ' ');
    if (object) text += OneLine(Json(key)) + ": ";
    Append(item, level + 1, text);
    separator = ",\n";
  }
  text += '\n';
  text.append(kIndent * level, ' ');
  text += object ? '}' : ']';
}

}  // namespace

std::string JsonText(const Json& json) {
  std::string text;
  Append(json, 0, text);
  return text + "\n";
}

}  // namespace lascaux
