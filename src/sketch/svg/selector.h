#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <pugixml.hpp>
#include <string_view>
#include <vector>

/// @file
/// CSS selectors made of element names, classes and ids, also nested (descendants, children).

namespace lascaux::svg {

/// How a compound is tied to the one on its left.
enum class Combinator : std::uint8_t { kDescendant, kChild };

/// Such as "path.thick#tail". Views point into the style sheet.
struct Compound {
  std::string_view tag, id;  ///< empty when they don't matter
  std::vector<std::string_view> classes;
  Combinator combinator = Combinator::kDescendant;
};

struct Selector {
  std::vector<Compound> compounds;  ///< the last one is for the element itself; never empty
  std::uint64_t specificity = 0;    ///< by CSS: ids before classes before names
};

/// Reads one selector (no list). Nothing for those that ask for attributes, pseudo-classes or
/// siblings.
std::optional<Selector> ParseSelector(std::string_view text);

/// What selectors ask of an element, looked up once.
struct ElementFacts {
  explicit ElementFacts(const pugi::xml_node& element);

  std::string_view tag, id, classes;
  std::size_t cost = 0;  ///< attributes looked at
};

/// Whether a selector fits, and how much work that took in comparisons of short texts: at most the
/// number of the element's ancestors times the selector's length, for there is no backtracking.
struct SelectorMatch {
  bool matches = false;
  std::size_t cost = 0;
};
SelectorMatch Match(const Selector& selector, const pugi::xml_node& element,
                    const ElementFacts& facts);

/// The local part of a name with or without a prefix.
std::string_view LocalName(std::string_view name);

/// The words of a text, as the `class` attribute has them.
std::vector<std::string_view> Words(std::string_view text);

}  // namespace lascaux::svg
