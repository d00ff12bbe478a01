#include "sketch/svg/style_sheet.h"

#include <algorithm>
#include <utility>

#include "sketch/svg/cursor.h"

namespace lascaux::svg {
namespace {

/// Position of the first of `marks` at or after `from`, outside of quotes and parentheses; the
/// text's size when there is none.
std::size_t FindOutside(std::string_view text, std::string_view marks, std::size_t from) {
  char quote = '\0';
  bool in_parentheses = false;
  for (std::size_t i = from; i < text.size(); ++i) {
    const char c = text[i];
    if (quote != '\0') {
      if (c == quote) quote = '\0';
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '(' || c == ')') {
      in_parentheses = c == '(';
    } else if (!in_parentheses && marks.find(c) != std::string_view::npos) {
      return i;
    }
  }
  return text.size();
}

/// Position behind the block that begins at `open` ('{'), or the text's size.
std::size_t BlockEnd(std::string_view text, std::size_t open) {
  std::size_t depth = 0;
  for (std::size_t i = open; i < text.size(); i = FindOutside(text, "{}", i + 1)) {
    if (text[i] == '{') ++depth;
    if (text[i] == '}' && --depth == 0) return i + 1;
  }
  return text.size();
}

bool IsForScreens(std::string_view at_rule) {
  if (!at_rule.starts_with("@media")) return false;
  const std::string_view query = Trimmed(at_rule.substr(6));
  return query.empty() || query == "all" || query == "screen" || query == "only screen";
}

}  // namespace

std::vector<Declaration> ParseDeclarations(std::string_view text) {
  std::vector<Declaration> declarations;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t end = FindOutside(text, ";", i);
    const std::string_view one = text.substr(i, end - i);
    i = end + 1;
    const std::size_t colon = one.find(':');
    if (colon == std::string_view::npos) continue;
    Declaration declaration{Trimmed(one.substr(0, colon)), Trimmed(one.substr(colon + 1)), false};
    const std::size_t mark = declaration.value.rfind('!');
    if (mark != std::string_view::npos &&
        EqualsIgnoringCase(Trimmed(declaration.value.substr(mark + 1)), "important")) {
      declaration.important = true;
      declaration.value = Trimmed(declaration.value.substr(0, mark));
    }
    declarations.push_back(declaration);
  }
  return declarations;
}

std::string WithoutComments(std::string_view css) {
  std::string result;
  result.reserve(css.size());
  for (std::size_t i = 0; i < css.size();) {
    const std::size_t begin = std::min(css.find("/*", i), css.size());
    result.append(css.substr(i, begin - i));
    if (begin == css.size()) break;
    result.push_back(' ');
    const std::size_t end = css.find("*/", begin + 2);
    if (end == std::string_view::npos) break;
    i = end + 2;
  }
  return result;
}

void StyleSheet::Add(std::string_view css) {
  texts_.push_back(WithoutComments(css));
  AddRules(texts_.back());
}

void StyleSheet::AddRules(std::string_view css) {
  for (std::size_t i = 0; i < css.size();) {
    const std::size_t open = FindOutside(css, "{};", i);
    const std::string_view head = Trimmed(css.substr(i, open - i));
    if (open == css.size()) return;
    if (css[open] !=
        '{') {  // "@import ...;", a stray '}' such as the end of an "@media" block that was entered
      i = open + 1;
      continue;
    }
    if (IsForScreens(head)) {
      i = open + 1;
      continue;
    }
    const std::size_t end = BlockEnd(css, open);
    if (!head.starts_with("@")) {
      const std::size_t inner_end = css[end - 1] == '}' ? end - 1 : end;
      const std::string_view block = css.substr(open + 1, inner_end - open - 1);
      blocks_.push_back(ParseDeclarations(block));
      block_costs_.push_back(1 + block.size() / 16);
      AddSelectors(head, blocks_.size() - 1);
    }
    i = end;
  }
}

void StyleSheet::AddSelectors(std::string_view list, std::size_t block) {
  for (std::size_t i = 0; i <= list.size();) {
    const std::size_t end = std::min(list.find(',', i), list.size());
    std::optional<Selector> selector = ParseSelector(list.substr(i, end - i));
    i = end + 1;
    if (!selector) continue;
    const Compound& subject = selector->compounds.back();
    const std::size_t rule = rules_.size();
    if (!subject.id.empty()) {
      by_id_[subject.id].push_back(rule);
    } else if (!subject.classes.empty()) {
      by_class_[subject.classes.front()].push_back(rule);
    } else if (!subject.tag.empty()) {
      by_tag_[subject.tag].push_back(rule);
    } else {
      for_all_.push_back(rule);
    }
    rules_.push_back({std::move(*selector), block});
  }
}

StyleSheet::Matches StyleSheet::Match(const pugi::xml_node& element) const {
  Matches result;
  if (rules_.empty()) return result;
  const ElementFacts facts(element);
  std::vector<std::size_t> fitting;
  const auto try_all = [&](const std::vector<std::size_t>& rules) {
    for (const std::size_t rule : rules) {
      const SelectorMatch match = svg::Match(rules_[rule].selector, element, facts);
      result.cost += match.cost;
      if (match.matches) fitting.push_back(rule);
    }
  };
  const auto try_index = [&](const Index& index, std::string_view key) {
    const auto found = index.find(key);
    if (found != index.end()) try_all(found->second);
  };
  try_all(for_all_);
  try_index(by_tag_, facts.tag);
  try_index(by_id_, facts.id);
  std::vector<std::string_view> classes = Words(facts.classes);
  std::sort(classes.begin(), classes.end());
  classes.erase(std::unique(classes.begin(), classes.end()), classes.end());
  for (const std::string_view name : classes) try_index(by_class_, name);
  std::sort(fitting.begin(), fitting.end(), [&](std::size_t a, std::size_t b) {
    return std::pair(rules_[a].selector.specificity, a) <
           std::pair(rules_[b].selector.specificity, b);
  });
  for (const std::size_t rule : fitting) {
    result.blocks.push_back(&blocks_[rules_[rule].block]);
    result.cost += block_costs_[rules_[rule].block];
  }
  return result;
}

}  // namespace lascaux::svg
