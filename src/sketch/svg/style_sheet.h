#pragma once

#include <cstddef>
#include <deque>
#include <map>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "sketch/svg/selector.h"

/// @file
/// CSS style sheets, as far as drawings use them: rules for names, classes and ids.

namespace lascaux::svg {

/// `name: value`, as it stands in a style sheet or in a `style` attribute.
struct Declaration {
  std::string_view name, value;
  bool important = false;
};

/// Splits "a: b; c: d !important" at its semicolons; what has no colon is left out.
std::vector<Declaration> ParseDeclarations(std::string_view text);

/// The text with each comment replaced by a space.
std::string WithoutComments(std::string_view css);

/// All rules of a document. At-rules are skipped, but for the inside of `@media` that speaks of all
/// or of a screen.
class StyleSheet {
 public:
  /// Adds the rules of one `style` element's text.
  void Add(std::string_view css);

  /// The declarations of all rules that fit, weakest first, and the work it took to find them (see
  /// SelectorMatch).
  struct Matches {
    std::vector<const std::vector<Declaration>*> blocks;
    std::size_t cost = 0;
  };
  Matches Match(const pugi::xml_node& element) const;

 private:
  struct Rule {
    Selector selector;
    std::size_t block = 0;  ///< into blocks_
  };
  using Index = std::map<std::string_view, std::vector<std::size_t>, std::less<>>;

  void AddRules(std::string_view css);
  void AddSelectors(std::string_view list, std::size_t block);

  std::deque<std::string> texts_;  ///< what all views point into; a deque never moves them
  std::vector<std::vector<Declaration>> blocks_;
  std::vector<std::size_t> block_costs_;
  std::vector<Rule> rules_;
  // Each rule is found by one thing that its element must have, so that most elements meet none but
  // their own.
  Index by_id_, by_class_, by_tag_;
  std::vector<std::size_t> for_all_;
};

}  // namespace lascaux::svg
