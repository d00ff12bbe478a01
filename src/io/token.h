#pragma once

#include <string>
#include <string_view>

namespace lascaux {

/// The text with control characters replaced by spaces: what may stand in a comment.
inline std::string OneLine(std::string_view text) {
  std::string line(text);
  for (char& c : line)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  return line;
}

/// The text as one word of a format that separates words by spaces: letters, digits, '.', '-' and
/// what is not ASCII stay, all else becomes '_'.
inline std::string Token(std::string_view text) {
  std::string token(text);
  for (char& c : token) {
    const auto u = static_cast<unsigned char>(c);
    const bool fine = (u >= '0' && u <= '9') || (u >= 'A' && u <= 'Z') || (u >= 'a' && u <= 'z') ||
                      u >= 0x80 || c == '.' || c == '-';
    if (!fine) c = '_';
  }
  return token.empty() ? "_" : token;
}

/// The text as an identifier: ASCII letters, digits and '_', no digit first.
inline std::string Identifier(std::string_view text) {
  std::string name;
  for (const char c : Token(text))
    name += c == '.' || c == '-' || static_cast<unsigned char>(c) >= 0x80 ? '_' : c;
  if (name[0] >= '0' && name[0] <= '9') name.insert(name.begin(), '_');
  return name;
}

}  // namespace lascaux
