#pragma once

#include <string>
#include <string_view>

namespace lascaux {

/// Text for XML's elements and attributes in quotes: the characters that XML reserves escaped,
/// control characters, most of which it forbids, replaced by spaces.
std::string EscapeXml(std::string_view text);

}  // namespace lascaux
