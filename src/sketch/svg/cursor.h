#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

/// @file
/// Reading the small grammars inside SVG attributes from left to right, in linear time and without
/// a locale.

namespace lascaux::svg {

/// Why the reading of a text stopped.
enum class Fault : std::uint8_t {
  kNone,
  kSyntax,
  kNotFinite,  ///< a number beyond double's range, or a generator's "NaN"
  kTooLarge,   ///< more pieces than are allowed
};

/// True for the five characters that XML and CSS take for white space.
constexpr bool IsSpace(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f';
}
constexpr bool IsDigit(char c) { return c >= '0' && c <= '9'; }
constexpr bool IsLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
constexpr char ToLower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; }

/// The text without the white space around it.
std::string_view Trimmed(std::string_view text);

/// ASCII comparison that ignores case; `lower` is in lower case.
bool EqualsIgnoringCase(std::string_view text, std::string_view lower);

/// A position in a text. A failed read leaves the position where reading became impossible.
class Cursor {
 public:
  explicit Cursor(std::string_view text) : text_(text) {}

  bool AtEnd() const { return position_ == text_.size(); }
  std::size_t position() const { return position_; }
  /// The next character; '\0' at the end.
  char Peek() const { return AtEnd() ? '\0' : text_[position_]; }
  /// True when the next characters can only be a number.
  bool AtNumber() const;

  void SkipSpace();
  /// White space with at most one comma in it, as between the numbers of all of SVG's lists.
  void SkipSeparator();
  /// Steps over the next character if it is `c`.
  bool Take(char c);
  /// Letters, and '-' and '%' as in identifiers and units.
  std::string_view TakeWord();

  /// A number; packed ones ("1.5.5-2") need no separator. Nothing when there is none: see fault().
  std::optional<double> Number();
  /// An arc's flag: one character, so that the next number may be glued to it.
  std::optional<bool> Flag();

  /// Why the last Number() or Flag() gave nothing.
  Fault fault() const { return fault_; }

 private:
  std::string_view text_;
  std::size_t position_ = 0;
  Fault fault_ = Fault::kNone;
};

}  // namespace lascaux::svg
