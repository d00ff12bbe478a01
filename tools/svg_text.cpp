#include "svg_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lascaux {
namespace {

constexpr int kMostDecimals = 12;

int DecimalsFor(double diagonal) {
  if (!(diagonal > 0)) return 3;
  return std::clamp(static_cast<int>(std::ceil(5 - std::log10(diagonal))), 0, kMostDecimals);
}

}  // namespace

SvgNumbers::SvgNumbers(double diagonal) : decimals_(DecimalsFor(diagonal)) {}

std::string SvgNumbers::operator()(double value) const {
  std::string text = fmt::format("{:.{}f}", value, decimals_);
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  return text == "-0" ? "0" : text;
}

std::string SvgNumbers::operator()(const Eigen::Vector2d& point) const {
  return (*this)(point.x()) + "," + (*this)(point.y());
}

std::string SvgNumbers::Line(const std::vector<Eigen::Vector2d>& points) const {
  std::string data;
  for (const Eigen::Vector2d& point : points) {
    data += data.empty() ? 'M' : ' ';
    data += (*this)(point);
  }
  return data;
}

std::string SvgNumbers::Ring(const std::vector<Eigen::Vector2d>& points) const {
  return points.empty() ? std::string() : Line(points) + "Z";
}

std::string SvgNumbers::Curve(const Stroke& stroke) const {
  if (stroke.pieces.empty()) return {};
  const SvgNumbers& n = *this;
  std::string data = fmt::format("M{}", n(stroke.pieces.front().p[0]));
  for (const CubicBezier& piece : stroke.pieces)
    data += fmt::format("C{} {} {}", n(piece.p[1]), n(piece.p[2]), n(piece.p[3]));
  return stroke.closed ? data + "Z" : data;
}

}  // namespace lascaux
