#pragma once

#include <cstddef>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <string_view>

#include "lascaux/base/outcome.h"
#include "lascaux/sketch/read_svg.h"
#include "sketch/svg/document.h"
#include "sketch/svg/findings.h"
#include "sketch/svg/length.h"
#include "sketch/svg/transform.h"

/// @file
/// One reading of a document: what it may still cost, what it has found, and attributes that may be
/// faulty.

namespace lascaux::svg {

class Reading {
 public:
  Reading(const Document& document, const ReadSvgOptions& options);

  const Document& document() const { return document_; }
  const ReadSvgOptions& options() const { return options_; }
  Findings& findings() { return findings_; }
  bool failed() const { return findings_.failed(); }

  /// 'path "tail" (line 3, column 4)', for messages. Costs a search through the file.
  std::string Name(const pugi::xml_node& element) const;
  std::string RootName() const { return Name(document_.root()); }

  /// Charges what a visit of an element costs, and what comparisons with style rules cost. False,
  /// with an error, when the whole has become too much.
  bool SpendOnVisit(const pugi::xml_node& node);
  bool SpendOnStyle(const pugi::xml_node& node, std::size_t comparisons);
  /// Charges curve pieces.
  bool SpendPieces(const pugi::xml_node& node, std::size_t pieces);
  int pieces_left() const { return pieces_left_; }

  /// A length, or a viewBox; nothing when it isn't given, or when it is faulty, which is then a
  /// finding.
  std::optional<double> LengthOf(const pugi::xml_node& node, const char* name, double percent_of);
  std::optional<Box> ViewBoxOf(const pugi::xml_node& node);

  /// Findings about the text of an attribute: "bad-attribute" or "bad-path-data", warnings, and the
  /// errors "not-finite" and, for pieces, "too-large".
  void Report(const pugi::xml_node& node, std::string_view attribute, Fault fault,
              std::size_t offset);
  void Warn(const char* code, const pugi::xml_node& node, std::string_view what);
  void Fail(const char* code, std::string message);

  /// All findings and the error, as the result of the reading.
  Outcome<Sketch> Failed(Diagnostic error);

 private:
  bool Spend(const pugi::xml_node& node, std::size_t steps);

  const Document& document_;
  ReadSvgOptions options_;
  Findings findings_;
  int pieces_left_;
  std::size_t steps_left_;
};

}  // namespace lascaux::svg
