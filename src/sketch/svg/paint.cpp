#include "sketch/svg/paint.h"

#include <algorithm>
#include <array>

#include "sketch/svg/cursor.h"

namespace lascaux::svg {
namespace {

constexpr Paint kNoPaint{PaintKind::kNone, {}};

Paint Solid(std::uint32_t rgb) {
  return {PaintKind::kColor,
          {((rgb >> 16) & 255) / 255.0, ((rgb >> 8) & 255) / 255.0, (rgb & 255) / 255.0}};
}

std::optional<std::uint32_t> HexDigit(char c) {
  if (IsDigit(c)) return static_cast<std::uint32_t>(c - '0');
  const char lower = ToLower(c);
  if (lower >= 'a' && lower <= 'f') return static_cast<std::uint32_t>(lower - 'a' + 10);
  return std::nullopt;
}

/// #rgb, #rgba, #rrggbb, #rrggbbaa, without the '#'. What is wholly transparent paints nothing.
std::optional<Paint> HexPaint(std::string_view digits) {
  const std::size_t n = digits.size();
  if (n != 3 && n != 4 && n != 6 && n != 8) return std::nullopt;
  const bool is_short = n <= 4;
  std::uint32_t value = 0;
  for (const char c : digits) {
    const auto digit = HexDigit(c);
    if (!digit) return std::nullopt;
    value = (value << 4) | *digit;
    if (is_short) value = (value << 4) | *digit;
  }
  if (n == 3 || n == 6) return Solid(value);
  return (value & 255) == 0 ? kNoPaint : Solid(value >> 8);
}

/// What stands between the parentheses of rgb() and rgba(), in any of their notations.
std::optional<Paint> RgbPaint(std::string_view inside) {
  Cursor cursor(Trimmed(inside));
  std::array<double, 4> values{0, 0, 0, 1};
  std::size_t count = 0;
  while (!cursor.AtEnd() && count < values.size()) {
    const auto number = cursor.Number();
    if (!number) return std::nullopt;
    const bool percent = cursor.Take('%');
    const double unit = percent ? 100 : (count < 3 ? 255 : 1);
    values[count++] = std::clamp(*number / unit, 0.0, 1.0);
    cursor.SkipSeparator();
    if (cursor.Take('/')) cursor.SkipSpace();
  }
  if (count < 3 || !cursor.AtEnd()) return std::nullopt;
  if (values[3] == 0) return kNoPaint;
  return Paint{PaintKind::kColor, {values[0], values[1], values[2]}};
}

/// url(#gradient), or what stands behind it for those who can't find it. Sketches know no
/// gradients: the colour of the fallback is taken when there is one.
Paint ServerPaint(std::string_view text) {
  const std::size_t end = text.find(')');
  if (end != std::string_view::npos) {
    const std::string_view behind = Trimmed(text.substr(end + 1));
    const bool again = behind.find('(') != std::string_view::npos;
    const auto fallback = again ? std::nullopt : ParsePaint(behind);
    if (fallback && fallback->kind == PaintKind::kColor) return *fallback;
  }
  return {PaintKind::kOther, {}};
}

}  // namespace

std::optional<Paint> ParsePaint(std::string_view text) {
  text = Trimmed(text);
  if (text.empty()) return std::nullopt;
  if (text.front() == '#') {
    // Behind the sRGB colour there may be the same one in another colour space.
    return HexPaint(text.substr(1, std::min(text.find_first_of(" \t\r\n"), text.size()) - 1));
  }
  const std::size_t open = text.find('(');
  if (open != std::string_view::npos) {
    const std::string_view name = Trimmed(text.substr(0, open));
    if (EqualsIgnoringCase(name, "url")) return ServerPaint(text);
    if (text.back() != ')') return std::nullopt;
    if (EqualsIgnoringCase(name, "rgb") || EqualsIgnoringCase(name, "rgba")) {
      return RgbPaint(text.substr(open + 1, text.size() - open - 2));
    }
    return Paint{PaintKind::kOther, {}};
  }
  if (EqualsIgnoringCase(text, "none") || EqualsIgnoringCase(text, "transparent")) return kNoPaint;
  if (EqualsIgnoringCase(text, "currentcolor")) return Paint{PaintKind::kCurrentColor, {}};
  if (EqualsIgnoringCase(text, "context-fill") || EqualsIgnoringCase(text, "context-stroke")) {
    return Paint{PaintKind::kOther, {}};
  }
  const auto named = NamedColor(text);
  if (!named) return std::nullopt;
  return Solid(*named);
}

}  // namespace lascaux::svg
