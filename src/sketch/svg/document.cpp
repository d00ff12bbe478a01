#include "sketch/svg/document.h"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "sketch/svg/cursor.h"
#include "sketch/svg/gzip.h"
#include "sketch/svg/selector.h"

namespace lascaux::svg {
namespace {

constexpr std::string_view kSvgNamespace = "http://www.w3.org/2000/svg";

/// A parsed element or attribute takes up to 64 bytes, so this many take a quarter of a gigabyte;
/// no drawing that is within the limit on pieces comes near.
constexpr std::ptrdiff_t kMaxMarkup = 4'000'000;

Diagnostic InputError(std::string code, std::string message) {
  return Error(FailureKind::kInput, std::move(code), std::move(message));
}

/// The parser stores a tree node for each '<' and each '=' at most.
std::ptrdiff_t CountMarkup(std::string_view text) {
  return std::count_if(text.begin(), text.end(), [](char c) { return c == '<' || c == '='; });
}

Diagnostic NotSvg(std::string_view bytes) {
  std::string what = "its first character is not '<', so it is no XML";
  if (bytes.empty()) what = "the file is empty";
  if (bytes.starts_with("\x89PNG") || bytes.starts_with("\xff\xd8\xff")) {
    what = "it is a picture; trace it first";
  }
  return InputError("not-svg",
                    fmt::format("this is not an SVG drawing (at byte 0): {}; expected an XML "
                                "document with the root element svg",
                                what));
}

}  // namespace

Outcome<Document> Document::Load(std::string_view bytes, const ReadSvgOptions& options) {
  using Result = Outcome<Document>;
  if (bytes.size() > options.max_bytes) {
    return Result::Failure(InputError(
        "too-large",
        fmt::format("the file has {} bytes, more than the {} that are read (from byte {} on); "
                    "remove embedded pictures and metadata, or raise the limit",
                    bytes.size(), options.max_bytes, options.max_bytes)));
  }
  Document document;
  if (IsGzip(bytes)) {
    Outcome<std::string> unpacked = Unzip(bytes, options.max_bytes);
    if (!unpacked) return Result::Failure(unpacked.diagnostics());
    document.unpacked_ = std::make_unique<std::string>(std::move(*unpacked));
    bytes = *document.unpacked_;
  }
  document.text_ = Utf8Text::Decode(bytes);
  const std::string_view text = document.text_.view();
  if (!Trimmed(text).starts_with('<')) return Result::Failure(NotSvg(bytes));
  document.expanded_ = ExpandEntities(text, {options.max_bytes, options.max_depth});
  const std::string_view parsed = document.expanded_ ? document.expanded_->text : text;
  const bool laughs = document.expanded_ && document.expanded_->too_large;
  if (laughs || CountMarkup(parsed) > kMaxMarkup) {
    const std::size_t place = text.find(laughs ? "<!ENTITY" : "<");
    return Result::Failure(InputError(
        "too-large",
        fmt::format("{} ({}): more than {}; simplify the document",
                    laughs ? "its entities stand for too much text" : "it has too many elements",
                    document.PlaceOf(place),
                    laughs
                        ? fmt::format("{} bytes or {} levels", options.max_bytes, options.max_depth)
                        : fmt::format("{} elements and attributes", kMaxMarkup))));
  }
  if (std::optional<Diagnostic> error = document.Parse()) return Result::Failure(*error);
  document.Index();
  return document;
}

std::optional<Diagnostic> Document::Parse() {
  const std::string_view parsed = expanded_ ? expanded_->text : text_.view();
  const pugi::xml_parse_result result =
      tree_->load_buffer(parsed.data(), parsed.size(), pugi::parse_default, pugi::encoding_utf8);
  const pugi::xml_node first = tree_->document_element();
  // A document that is something else is not worth the diagnosis of where it breaks.
  if (first && LocalName(first.name()) != "svg") {
    return InputError("not-svg",
                      fmt::format("this is not an SVG drawing: its root element ({}) is {}, not "
                                  "svg; save the drawing itself as SVG",
                                  Place(first), std::string_view(first.name()).substr(0, 40)));
  }
  const std::size_t nul = parsed.find('\0');
  if (result && first && nul == std::string_view::npos) return std::nullopt;
  // pugixml reports where a construct that is never finished begins, or the end of the text.
  const auto at = static_cast<std::size_t>(std::max<std::ptrdiff_t>(result.offset, 0));
  const std::string why = !result                         ? result.description()
                          : nul != std::string_view::npos ? "A zero byte"
                                                          : "No element at all";
  return InputError(
      "broken-xml",
      fmt::format("the XML is broken at {}: {}; the file may be cut off: save it again",
                  PlaceOf(SourceOffset(result ? std::min(nul, parsed.size()) : at)), why));
}

void Document::Index() {
  const std::string_view root_name = root().name();
  const std::size_t colon = root_name.find(':');
  if (colon != std::string_view::npos) svg_prefixes_.insert(root_name.substr(0, colon));
  // No recursion: the tree may be deeper than the stack.
  for (pugi::xml_node node = root(); node;) {
    if (node.type() == pugi::node_element) IndexElement(node);
    if (node.first_child()) {
      node = node.first_child();
      continue;
    }
    while (node && !node.next_sibling() && node != root()) node = node.parent();
    node = node == root() ? pugi::xml_node() : node.next_sibling();
  }
  std::stable_sort(ids_.begin(), ids_.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
}

void Document::IndexElement(const pugi::xml_node& element) {
  for (const pugi::xml_attribute& attribute : element.attributes()) {
    const std::string_view name = attribute.name();
    if (name == "id" && *attribute.value() != '\0') ids_.emplace_back(attribute.value(), element);
    if (name.starts_with("xmlns:") && attribute.value() == kSvgNamespace) {
      svg_prefixes_.insert(name.substr(6));
    }
  }
  if (Tag(element) != "style") return;
  const std::string_view type = element.attribute("type").value();
  if (!type.empty() && type.find("css") == std::string_view::npos) return;
  std::string text;
  for (const pugi::xml_node& child : element.children()) text += child.value();
  style_texts_.push_back(std::move(text));
}

std::string_view Document::Tag(const pugi::xml_node& node) const {
  if (node.type() != pugi::node_element) return {};
  const std::string_view name = node.name();
  const std::size_t colon = name.find(':');
  if (colon == std::string_view::npos) return name;
  return svg_prefixes_.contains(name.substr(0, colon)) ? name.substr(colon + 1)
                                                       : std::string_view();
}

pugi::xml_node Document::ById(std::string_view id) const {
  const auto found = std::lower_bound(
      ids_.begin(), ids_.end(), id,
      [](const auto& entry, std::string_view wanted) { return entry.first < wanted; });
  return found != ids_.end() && found->first == id ? found->second : pugi::xml_node();
}

std::string Document::Place(const pugi::xml_node& element) const {
  const std::ptrdiff_t offset = element.offset_debug();
  return PlaceOf(SourceOffset(static_cast<std::size_t>(std::max<std::ptrdiff_t>(offset, 0))));
}

std::size_t Document::SourceOffset(std::size_t parsed_offset) const {
  return expanded_ ? expanded_->SourceOffset(parsed_offset) : parsed_offset;
}

std::string Document::PlaceOf(std::size_t source_offset) const {
  const std::string_view before = text_.view().substr(0, source_offset);
  const std::size_t line_begin = before.rfind('\n') + 1;  // npos + 1 is 0
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const std::string_view in_line = before.substr(line_begin);
  const auto column = 1 + std::count_if(in_line.begin(), in_line.end(), [](char c) {
                        return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
                      });
  return fmt::format("line {}, column {}", line, column);
}

}  // namespace lascaux::svg
