#include "body.h"

#include <fstream>
#include <map>
#include <sstream>

using lascaux::Field;
using lascaux::Segment;

Field ReadBody(const std::string& path, BodyBlend blend) {
  Field field;
  std::ifstream file(path);
  std::map<std::string, std::size_t> index;
  for (std::string line; std::getline(file, line);) {
    Segment s;
    std::string name;
    std::istringstream words(line);
    words >> s.a.x() >> s.a.y() >> s.a.z() >> s.radius_a;
    words >> s.b.x() >> s.b.y() >> s.b.z() >> s.radius_b >> name;
    if (!words) continue;
    if (blend == BodyBlend::kPlainSum) name.clear();
    const auto [at, is_new] = index.try_emplace(name, field.parts.size());
    if (is_new) {
      field.parts.emplace_back().chains.emplace_back();
      if (field.parts.size() > 1) field.parts.back().parent = 0;
    }
    field.parts[at->second].chains.front().segments.push_back(s);
  }
  return field;
}
