#pragma once

#include <memory>
#include <optional>
#include <pugixml.hpp>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "lascaux/base/outcome.h"
#include "lascaux/sketch/read_svg.h"
#include "sketch/svg/encoding.h"
#include "sketch/svg/entities.h"

/// @file
/// An SVG document as a tree of elements that know their place in the file.

namespace lascaux::svg {

class Document {
 public:
  /// Parses the bytes, gzip or not, which must outlive the document. Errors: "not-svg",
  /// "broken-xml", "too-large".
  static Outcome<Document> Load(std::string_view bytes, const ReadSvgOptions& options);

  pugi::xml_node root() const { return tree_->document_element(); }

  /// The local name of an SVG element; empty for elements of other vocabularies and for what is no
  /// element.
  std::string_view Tag(const pugi::xml_node& node) const;

  /// The first element with that id, a null node when there is none.
  pugi::xml_node ById(std::string_view id) const;

  /// The texts of all `style` elements, in order.
  const std::vector<std::string>& style_texts() const { return style_texts_; }

  /// "line 3, column 14" of the original text (columns in characters), for an element: of its name.
  std::string Place(const pugi::xml_node& element) const;

 private:
  Document() = default;
  void Index();
  void IndexElement(const pugi::xml_node& element);
  std::string PlaceOf(std::size_t source_offset) const;
  std::size_t SourceOffset(std::size_t parsed_offset) const;
  std::optional<Diagnostic> Parse();

  std::unique_ptr<std::string> unpacked_;  ///< of a compressed file; text_ is a view of it
  Utf8Text text_;
  std::optional<ExpandedText> expanded_;
  std::unique_ptr<pugi::xml_document> tree_ = std::make_unique<pugi::xml_document>();
  std::set<std::string_view, std::less<>> svg_prefixes_;
  std::vector<std::pair<std::string_view, pugi::xml_node>> ids_;  ///< sorted, first comes first
  std::vector<std::string> style_texts_;
};

}  // namespace lascaux::svg
