#pragma once

#include <string>
#include <string_view>

/// @file
/// What encoding a document is in, and its text in UTF-8.

namespace lascaux::svg {

/// True for well-formed UTF-8 (no surrogates, nothing overlong).
bool IsUtf8(std::string_view bytes);

/// The text of Latin-1 bytes; also what damaged UTF-8 is taken for, so that it never leaves the
/// reader.
std::string Latin1ToUtf8(std::string_view bytes);

/// A document's text. A view when its bytes are that already: then they must outlive it.
class Utf8Text {
 public:
  /// Decides by the byte-order mark, else by where the zero bytes of "<" are (UTF-16 and UTF-32,
  /// both byte orders), else by the XML declaration (Latin-1 and its superset windows-1252, whose
  /// additions no drawing needs), else UTF-8; bytes that claim to be UTF-8 and are not are read as
  /// Latin-1. Linear.
  static Utf8Text Decode(std::string_view bytes);

  std::string_view view() const { return owned_.empty() ? borrowed_ : std::string_view(owned_); }

 private:
  std::string_view borrowed_;
  std::string owned_;
};

}  // namespace lascaux::svg
