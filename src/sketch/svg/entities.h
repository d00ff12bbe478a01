#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// @file
/// General entities that a document declares in its own DTD, replaced by what they stand for.
///
/// pugixml knows the five predefined ones only. Drawing programs declare their namespaces as
/// entities, and people their colours and whole groups.

namespace lascaux::svg {

/// Limits of an expansion; "billion laughs" grow without bound in either.
struct EntityLimits {
  std::size_t max_bytes = 0;  ///< of all texts that are made on the way, the document among them
  int max_depth = 0;          ///< of entities inside entities
};

/// A document without references to its own entities.
struct ExpandedText {
  std::string text;
  bool too_large = false;  ///< a limit was met: `text` is of no use

  /// Where in the original a place of `text` comes from; inside of an expansion, the reference.
  std::size_t SourceOffset(std::size_t offset) const;

  /// A stretch of `text` and where it comes from; it ends where the next one begins.
  struct Stretch {
    std::size_t begin = 0, source = 0;
    bool expanded = false;
  };
  std::vector<Stretch> stretches;
};

/// Replaces the references, also those inside entities' values. Nothing when the document declares
/// none, which is the rule: then it can be used as it is. Linear in the document plus the result.
///
/// Comments, CDATA sections and processing instructions are left alone; inside of a tag the
/// characters that would end an attribute are escaped. References to what is not declared (or is
/// declared in another file) stay as they are; character references inside a value are replaced
/// where it is used, not where it is declared; a reference to an entity inside itself is taken for
/// text.
std::optional<ExpandedText> ExpandEntities(std::string_view xml, const EntityLimits& limits);

}  // namespace lascaux::svg
