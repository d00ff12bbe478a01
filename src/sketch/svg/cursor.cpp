#include "sketch/svg/cursor.h"

#include <algorithm>
#include <charconv>

namespace lascaux::svg {
namespace {

/// Exponents beyond this decide by themselves whether a number is too large or too small for
/// double.
constexpr long kExponentCap = 1'000'000'000;

/// Power of ten of the first digit that is not zero, for a decimal number as std::from_chars takes
/// it.
long DecimalMagnitude(std::string_view number) {
  const std::size_t mantissa_end = std::min(number.find_first_of("eE"), number.size());
  const std::string_view mantissa = number.substr(0, mantissa_end);
  const std::size_t point = std::min(mantissa.find('.'), mantissa.size());
  const std::size_t first = mantissa.find_first_of("123456789");
  if (first == std::string_view::npos) return -kExponentCap;
  long exponent = 0;
  if (mantissa_end < number.size()) {
    std::size_t i = mantissa_end + 1;
    const bool negative = number[i] == '-';
    if (negative || number[i] == '+') ++i;
    for (; i < number.size(); ++i) {
      exponent = std::min(kExponentCap, exponent * 10 + (number[i] - '0'));
    }
    if (negative) exponent = -exponent;
  }
  return exponent + static_cast<long>(point) - static_cast<long>(first);
}

/// "NaN", "inf" and "Infinity": what careless generators write for numbers.
bool IsNonNumber(std::string_view text) {
  return EqualsIgnoringCase(text.substr(0, 3), "nan") ||
         EqualsIgnoringCase(text.substr(0, 3), "inf");
}

}  // namespace

std::string_view Trimmed(std::string_view text) {
  while (!text.empty() && IsSpace(text.front())) text.remove_prefix(1);
  while (!text.empty() && IsSpace(text.back())) text.remove_suffix(1);
  return text;
}

bool EqualsIgnoringCase(std::string_view text, std::string_view lower) {
  return std::equal(text.begin(), text.end(), lower.begin(), lower.end(),
                    [](char a, char b) { return ToLower(a) == b; });
}

bool Cursor::AtNumber() const {
  const char c = Peek();
  return IsDigit(c) || c == '.' || c == '-' || c == '+';
}

void Cursor::SkipSpace() {
  while (!AtEnd() && IsSpace(text_[position_])) ++position_;
}

void Cursor::SkipSeparator() {
  SkipSpace();
  if (Take(',')) SkipSpace();
}

bool Cursor::Take(char c) {
  if (AtEnd() || text_[position_] != c) return false;
  ++position_;
  return true;
}

std::string_view Cursor::TakeWord() {
  const std::size_t begin = position_;
  const auto belongs = [](char c) { return IsLetter(c) || c == '-' || c == '%'; };
  while (!AtEnd() && belongs(text_[position_])) ++position_;
  return text_.substr(begin, position_ - begin);
}

std::optional<double> Cursor::Number() {
  const std::size_t sign = Peek() == '-' || Peek() == '+' ? 1 : 0;
  const std::string_view magnitude = text_.substr(std::min(text_.size(), position_ + sign));
  const auto at = [&](std::size_t i) { return i < magnitude.size() ? magnitude[i] : '\0'; };
  if (!IsDigit(at(0)) && !(at(0) == '.' && IsDigit(at(1)))) {
    fault_ = IsNonNumber(magnitude) ? Fault::kNotFinite : Fault::kSyntax;
    return std::nullopt;
  }
  double value = 0;
  const char* const begin = magnitude.data();
  const auto [end, error] = std::from_chars(begin, begin + magnitude.size(), value);
  const auto length = static_cast<std::size_t>(end - begin);
  if (error == std::errc::result_out_of_range) {
    if (DecimalMagnitude(magnitude.substr(0, length)) > 0) {
      fault_ = Fault::kNotFinite;
      return std::nullopt;
    }
    value = 0;
  }
  const bool negative = Peek() == '-';
  position_ += sign + length;
  return negative ? -value : value;
}

std::optional<bool> Cursor::Flag() {
  if (Take('0')) return false;
  if (Take('1')) return true;
  fault_ = Fault::kSyntax;
  return std::nullopt;
}

}  // namespace lascaux::svg
