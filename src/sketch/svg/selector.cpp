#include "sketch/svg/selector.h"

#include <algorithm>

#include "sketch/svg/cursor.h"

namespace lascaux::svg {
namespace {

bool IsNameCharacter(char c) {
  return IsLetter(c) || IsDigit(c) || c == '-' || c == '_' || static_cast<unsigned char>(c) >= 128;
}

bool HasClass(std::string_view list, std::string_view name) {
  for (std::size_t at = list.find(name); at != std::string_view::npos;
       at = list.find(name, at + name.size())) {
    const std::size_t end = at + name.size();
    if ((at == 0 || IsSpace(list[at - 1])) && (end == list.size() || IsSpace(list[end]))) {
      return true;
    }
  }
  return false;
}

SelectorMatch Fits(const Compound& compound, const ElementFacts& facts) {
  if (!compound.tag.empty() && facts.tag != compound.tag) return {false, 1};
  if (!compound.id.empty() && facts.id != compound.id) return {false, 1};
  SelectorMatch result{true, 1};
  for (const std::string_view name : compound.classes) {
    result.cost += 1 + facts.classes.size() / 16;
    if (!HasClass(facts.classes, name)) return {false, result.cost};
  }
  return result;
}

class CompoundReader {
 public:
  explicit CompoundReader(std::string_view text) : text_(text) {}

  std::optional<Compound> Read() {
    Compound compound;
    if (!text_.empty() && text_.front() == '*') {
      text_.remove_prefix(1);
    } else {
      compound.tag = Name();
    }
    while (!text_.empty()) {
      const char mark = text_.front();
      text_.remove_prefix(1);
      const std::string_view name = Name();
      if (name.empty() || (mark != '.' && mark != '#')) return std::nullopt;
      if (mark == '.') compound.classes.push_back(name);
      if (mark == '#') compound.id = name;
    }
    return compound;
  }

 private:
  std::string_view Name() {
    std::size_t n = 0;
    while (n < text_.size() && IsNameCharacter(text_[n])) ++n;
    const std::string_view name = text_.substr(0, n);
    text_.remove_prefix(n);
    return name;
  }

  std::string_view text_;
};

std::uint64_t Specificity(const Compound& compound) {
  // 16 bits for each of the three counts: nobody writes 65536 classes into one selector and means
  // it.
  constexpr std::size_t kMost = 0xffff;
  return (std::uint64_t{!compound.id.empty()} << 32) |
         (std::uint64_t{std::min(compound.classes.size(), kMost)} << 16) |
         std::uint64_t{!compound.tag.empty()};
}

}  // namespace

std::string_view LocalName(std::string_view name) {
  const std::size_t colon = name.find(':');
  return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

std::vector<std::string_view> Words(std::string_view text) {
  std::vector<std::string_view> words;
  for (std::size_t i = 0; i < text.size();) {
    std::size_t end = i;
    while (end < text.size() && !IsSpace(text[end])) ++end;
    if (end > i) words.push_back(text.substr(i, end - i));
    i = end + 1;
  }
  return words;
}

std::optional<Selector> ParseSelector(std::string_view text) {
  Selector selector;
  Combinator combinator = Combinator::kDescendant;
  for (std::size_t i = 0; i < text.size();) {
    if (IsSpace(text[i])) {
      ++i;
    } else if (text[i] == '>') {
      if (selector.compounds.empty() || combinator == Combinator::kChild) return std::nullopt;
      combinator = Combinator::kChild;
      ++i;
    } else {
      std::size_t end = i;
      while (end < text.size() && !IsSpace(text[end]) && text[end] != '>') ++end;
      std::optional<Compound> compound = CompoundReader(text.substr(i, end - i)).Read();
      if (!compound) return std::nullopt;
      compound->combinator = combinator;
      combinator = Combinator::kDescendant;
      selector.specificity += Specificity(*compound);
      selector.compounds.push_back(std::move(*compound));
      i = end;
    }
  }
  if (selector.compounds.empty() || combinator == Combinator::kChild) return std::nullopt;
  return selector;
}

ElementFacts::ElementFacts(const pugi::xml_node& element) : tag(LocalName(element.name())) {
  for (const pugi::xml_attribute& attribute : element.attributes()) {
    const std::string_view name = attribute.name();
    if (name == "id") id = attribute.value();
    if (name == "class") classes = attribute.value();
    ++cost;
  }
}

SelectorMatch Match(const Selector& selector, const pugi::xml_node& element,
                    const ElementFacts& facts) {
  SelectorMatch result = Fits(selector.compounds.back(), facts);
  const std::size_t n = selector.compounds.size();
  if (!result.matches || n == 1) return result;
  std::vector<ElementFacts> line;  // from the element up to the root
  for (pugi::xml_node node = element; node.type() == pugi::node_element; node = node.parent()) {
    line.emplace_back(node);
    result.cost += line.back().cost;
  }
  // One pass from the root down, over the selector's prefixes: `here[k]` says that compounds 0 to k
  // fit with the last of them at this node, `above[k]` that they do so at a node further up.
  std::vector<bool> above(n, false), parent(n, false), here(n, false);
  for (auto node = line.rbegin(); node != line.rend(); ++node) {
    for (std::size_t k = 0; k < n; ++k) {
      const Compound& compound = selector.compounds[k];
      const bool is_child = compound.combinator == Combinator::kChild;
      const bool tied = k == 0 || (is_child ? parent[k - 1] : above[k - 1]);
      const SelectorMatch fit = tied ? Fits(compound, *node) : SelectorMatch{false, 1};
      here[k] = fit.matches;
      result.cost += fit.cost;
    }
    for (std::size_t k = 0; k < n; ++k) above[k] = above[k] || here[k];
    parent.swap(here);
  }
  result.matches = parent[n - 1];
  return result;
}

}  // namespace lascaux::svg
