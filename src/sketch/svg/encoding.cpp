#include "sketch/svg/encoding.h"

#include <algorithm>
#include <cstdint>

#include "sketch/svg/cursor.h"

namespace lascaux::svg {
namespace {

constexpr std::uint32_t kReplacement = 0xFFFD;
constexpr std::uint32_t kLastCodePoint = 0x10FFFF;

bool IsSurrogate(std::uint32_t c) { return c >= 0xD800 && c <= 0xDFFF; }

std::string Encoded(std::uint32_t c) {
  const auto byte = [](std::uint32_t value) { return static_cast<char>(value); };
  const auto tail = [&](int shift) { return byte(0x80 | ((c >> shift) & 0x3F)); };
  if (c < 0x80) return {byte(c)};
  if (c < 0x800) return {byte(0xC0 | (c >> 6)), tail(0)};
  if (c < 0x10000) return {byte(0xE0 | (c >> 12)), tail(6), tail(0)};
  return {byte(0xF0 | (c >> 18)), tail(12), tail(6), tail(0)};
}

/// Length of the well-formed sequence at the front of `bytes`, 0 when there is none.
std::size_t SequenceLength(std::string_view bytes) {
  const auto at = [&](std::size_t i) {
    return i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0u;
  };
  const auto is_tail = [&](std::size_t i) { return (at(i) & 0xC0) == 0x80; };
  const unsigned first = at(0), second = at(1);
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first < 0xE0) return is_tail(1) ? 2 : 0;
  if (first >= 0xE0 && first < 0xF0) {
    const bool overlong = first == 0xE0 && second < 0xA0;
    const bool surrogate = first == 0xED && second >= 0xA0;
    return is_tail(1) && is_tail(2) && !overlong && !surrogate ? 3 : 0;
  }
  if (first >= 0xF0 && first < 0xF5) {
    const bool overlong = first == 0xF0 && second < 0x90;
    const bool beyond = first == 0xF4 && second >= 0x90;
    return is_tail(1) && is_tail(2) && is_tail(3) && !overlong && !beyond ? 4 : 0;
  }
  return 0;
}

/// Code units of 2 or 4 bytes in either byte order.
struct WideEncoding {
  std::size_t unit = 2;
  bool little = true;
};

std::string WideToUtf8(std::string_view bytes, WideEncoding encoding) {
  const std::size_t count = bytes.size() / encoding.unit;
  const auto unit = [&](std::size_t index) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < encoding.unit; ++i) {
      const std::size_t k = encoding.little ? encoding.unit - 1 - i : i;
      value = (value << 8) | static_cast<unsigned char>(bytes[index * encoding.unit + k]);
    }
    return value;
  };
  std::string text;
  text.reserve(bytes.size() / encoding.unit);
  for (std::size_t i = 0; i < count; ++i) {
    std::uint32_t c = unit(i);
    if (encoding.unit == 2 && c >= 0xD800 && c < 0xDC00 && i + 1 < count) {
      const std::uint32_t low = unit(i + 1);
      if (low >= 0xDC00 && low < 0xE000) {
        c = 0x10000 + ((c - 0xD800) << 10) + (low - 0xDC00);
        ++i;
      }
    }
    text += Encoded(IsSurrogate(c) || c > kLastCodePoint ? kReplacement : c);
  }
  // A last unit that is cut off is no text, but must not make a truncated file look whole.
  if (bytes.size() % encoding.unit != 0) text += Encoded(kReplacement);
  return text;
}

bool StartsWith(std::string_view bytes, std::initializer_list<unsigned> prefix) {
  return bytes.size() >= prefix.size() &&
         std::equal(prefix.begin(), prefix.end(), bytes.begin(),
                    [](unsigned a, char b) { return a == static_cast<unsigned char>(b); });
}

bool DeclaresLatin1(std::string_view bytes) {
  const std::string_view head = bytes.substr(0, std::min(bytes.find("?>"), std::size_t{256}));
  const std::size_t at = head.find("encoding");
  if (!head.starts_with("<?xml") || at == std::string_view::npos) return false;
  std::string_view value = head.substr(at + 8);
  while (!value.empty() && (IsSpace(value.front()) || value.front() == '=')) value.remove_prefix(1);
  if (value.empty() || (value.front() != '"' && value.front() != '\'')) return false;
  value = value.substr(1, std::min(value.find(value.front(), 1), value.size()) - 1);
  for (const std::string_view name :
       {"iso-8859-1", "iso_8859-1", "latin1", "latin-1", "windows-1252", "cp1252", "iso-8859-15"}) {
    if (EqualsIgnoringCase(value, name)) return true;
  }
  return false;
}

}  // namespace

bool IsUtf8(std::string_view bytes) {
  while (!bytes.empty()) {
    const std::size_t length = SequenceLength(bytes);
    if (length == 0) return false;
    bytes.remove_prefix(length);
  }
  return true;
}

std::string Latin1ToUtf8(std::string_view bytes) {
  std::string text;
  text.reserve(bytes.size() + bytes.size() / 8);
  for (const char c : bytes) text += Encoded(static_cast<unsigned char>(c));
  return text;
}

Utf8Text Utf8Text::Decode(std::string_view bytes) {
  Utf8Text text;
  const auto wide = [&](std::size_t mark, WideEncoding encoding) {
    text.owned_ = WideToUtf8(bytes.substr(mark), encoding);
    return text;
  };
  if (StartsWith(bytes, {0xFF, 0xFE, 0, 0})) return wide(4, {4, true});
  if (StartsWith(bytes, {0, 0, 0xFE, 0xFF})) return wide(4, {4, false});
  if (StartsWith(bytes, {0xFF, 0xFE})) return wide(2, {2, true});
  if (StartsWith(bytes, {0xFE, 0xFF})) return wide(2, {2, false});
  if (StartsWith(bytes, {'<', 0, 0, 0})) return wide(0, {4, true});
  if (StartsWith(bytes, {0, 0, 0, '<'})) return wide(0, {4, false});
  if (StartsWith(bytes, {'<', 0})) return wide(0, {2, true});
  if (StartsWith(bytes, {0, '<'})) return wide(0, {2, false});
  if (StartsWith(bytes, {0xEF, 0xBB, 0xBF})) bytes.remove_prefix(3);
  if (DeclaresLatin1(bytes) || !IsUtf8(bytes)) {
    text.owned_ = Latin1ToUtf8(bytes);
  } else {
    text.borrowed_ = bytes;
  }
  return text;
}

}  // namespace lascaux::svg
