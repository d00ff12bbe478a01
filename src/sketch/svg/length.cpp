#include "sketch/svg/length.h"

#include <array>
#include <cmath>
#include <utility>

namespace lascaux::svg {
namespace {

constexpr std::array<std::pair<std::string_view, double>, 12> kUnits{{
    {"", 1},
    {"px", 1},
    {"pt", kPixelsPerInch / 72},
    {"pc", kPixelsPerInch / 6},
    {"in", kPixelsPerInch},
    {"cm", kPixelsPerInch / 2.54},
    {"mm", kPixelsPerInch / 25.4},
    {"q", kPixelsPerInch / 101.6},
    {"em", kInitialFontSize},
    {"rem", kInitialFontSize},
    {"ex", kInitialFontSize / 2},
    {"ch", kInitialFontSize / 2},
}};

}  // namespace

double Viewport::Diagonal() const { return std::hypot(width, height) / std::sqrt(2.0); }

Length ParseLength(std::string_view text, double percent_of) {
  Cursor cursor(Trimmed(text));
  const std::optional<double> number = cursor.Number();
  if (!number) return {std::nullopt, cursor.fault()};
  const std::string_view unit = cursor.TakeWord();
  if (!cursor.AtEnd()) return {std::nullopt, Fault::kSyntax};
  if (unit == "%") return {*number / 100 * percent_of};
  for (const auto& [name, size] : kUnits) {
    if (EqualsIgnoringCase(unit, name)) return {*number * size};
  }
  return {std::nullopt, Fault::kSyntax};
}

}  // namespace lascaux::svg
