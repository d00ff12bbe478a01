#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "lascaux/sketch/read_svg.h"
#include "sketch/sketch_invariants.h"

/// @file
/// Short SVG documents for tests, and what reading them gives.

namespace lascaux::testing {

/// A document whose root has these attributes beside black lines and no areas.
inline std::string Svg(std::string_view content, std::string_view attributes = "") {
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" fill=\"none\" stroke=\"black\" " +
         std::string(attributes) + ">" + std::string(content) + "</svg>";
}

/// A path with this `d`, and further attributes.
inline std::string Path(std::string_view d, std::string_view attributes = "") {
  return "<path d=\"" + std::string(d) + "\" " + std::string(attributes) + "/>";
}

inline int CountOf(const Outcome<Sketch>& outcome, std::string_view code) {
  int count = 0;
  for (const Diagnostic& d : outcome.diagnostics()) count += d.code == code;
  return count;
}

/// The first message of that code, "" when there is none.
inline std::string MessageOf(const Outcome<Sketch>& outcome, std::string_view code) {
  for (const Diagnostic& d : outcome.diagnostics()) {
    if (d.code == code) return d.message;
  }
  return {};
}

/// The strokes of a document that reads without an error; a failed expectation and none otherwise.
inline std::vector<Stroke> Strokes(const std::string& document) {
  const Outcome<Sketch> outcome = ReadSvg(document);
  EXPECT_EQ(WrongWith(outcome), "") << document;
  EXPECT_TRUE(outcome.ok()) << document;
  return outcome.ok() ? outcome->strokes : std::vector<Stroke>();
}

/// "0,0 1,2 5,5": where a stroke begins and where each of its pieces ends, rounded to 1e-6.
inline std::string Ends(const Stroke& stroke) {
  std::ostringstream out;
  const auto rounded = [](double x) { return std::round(x * 1e6) / 1e6 + 0.0; };
  const auto add = [&](const Eigen::Vector2d& p) {
    out << rounded(p.x()) << ',' << rounded(p.y());
  };
  add(stroke.pieces.front().p[0]);
  for (const CubicBezier& piece : stroke.pieces) {
    out << ' ';
    add(piece.p[3]);
  }
  return out.str();
}

/// Ends() of all strokes, with "; " between them.
inline std::string EndsOf(const std::string& document) {
  std::string all;
  for (const Stroke& stroke : Strokes(document)) all += (all.empty() ? "" : "; ") + Ends(stroke);
  return all;
}

}  // namespace lascaux::testing
