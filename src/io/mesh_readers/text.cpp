#include <charconv>
#include <limits>
#include <system_error>

#include "io/mesh_readers/readers.h"

namespace lascaux {
namespace {

bool IsSpace(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

}  // namespace

bool TextCursor::Line(std::string_view& line) {
  if (rest_.empty()) return false;
  const std::size_t end = rest_.find_first_of("\r\n");
  line = rest_.substr(0, end);
  if (end == std::string_view::npos) {
    rest_ = {};
  } else {
    const bool two = rest_[end] == '\r' && end + 1 < rest_.size() && rest_[end + 1] == '\n';
    rest_.remove_prefix(end + (two ? 2 : 1));
  }
  return true;
}

std::string_view TextCursor::Word() {
  std::size_t begin = 0;
  while (begin < rest_.size() && IsSpace(rest_[begin])) ++begin;
  std::size_t end = begin;
  while (end < rest_.size() && !IsSpace(rest_[end])) ++end;
  const std::string_view word = rest_.substr(begin, end - begin);
  rest_.remove_prefix(end);
  return word;
}

bool ToFloat(std::string_view word, float& value) {
  if (word.starts_with('+')) word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (word.empty() || end != word.data() + word.size()) return false;
  if (error == std::errc::result_out_of_range) {
    // Too small is 0, too large is infinite: told apart in double, else by the exponent's sign.
    double wide = 0;
    const auto again = std::from_chars(word.data(), word.data() + word.size(), wide);
    const bool small = again.ec == std::errc() ? wide < 1 && wide > -1
                                               : word.find("e-") != std::string_view::npos ||
                                                     word.find("E-") != std::string_view::npos;
    value = small ? 0.0F : std::numeric_limits<float>::infinity();
    return true;
  }
  return error == std::errc();
}

bool ToInteger(std::string_view word, long long& value) {
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return !word.empty() && error == std::errc() && end == word.data() + word.size();
}

double UnitInComment(std::string_view comment) noexcept {
  constexpr std::string_view kKey = "unit ";
  const std::size_t at = comment.find(kKey);
  if (at == std::string_view::npos) return 0;
  const std::string_view unit = comment.substr(at + kKey.size(), 3);
  const auto is = [unit](std::string_view name) {
    return unit.starts_with(name) &&
           (unit.size() == name.size() || unit[name.size()] == ',' || unit[name.size()] == ' ');
  };
  if (is("mm")) return 1;
  if (is("cm")) return 10;
  return is("m") ? 1000 : 0;
}

}  // namespace lascaux
