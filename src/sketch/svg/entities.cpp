#include "sketch/svg/entities.h"

#include <algorithm>
#include <array>
#include <map>

#include "sketch/svg/cursor.h"

namespace lascaux::svg {
namespace {

/// What one reference is charged beyond its text: the memory that its two stretches take.
constexpr std::size_t kReferenceCost = 2 * sizeof(ExpandedText::Stretch);

enum class Progress { kRaw, kBusy, kDone };

struct Entity {
  std::string_view value;  ///< as declared
  std::string expanded;
  Progress progress = Progress::kRaw;
};

using Entities = std::map<std::string_view, Entity, std::less<>>;

bool IsPredefined(std::string_view name) {
  constexpr std::array<std::string_view, 5> kNames{"amp", "lt", "gt", "quot", "apos"};
  return std::find(kNames.begin(), kNames.end(), name) != kNames.end();
}

/// Reads the prolog: everything before the root element.
class PrologReader {
 public:
  explicit PrologReader(std::string_view xml) : xml_(xml) {}

  Entities Read() {
    while (true) {
      SkipSpace();
      if (At("<?")) {
        SkipPast("?>");
      } else if (At("<!--")) {
        SkipPast("-->");
      } else if (At("<!DOCTYPE")) {
        Doctype();
      } else {
        return std::move(entities_);
      }
    }
  }
  /// Where the root element begins.
  std::size_t position() const { return position_; }

 private:
  bool At(std::string_view text) const { return xml_.substr(position_).starts_with(text); }
  char Next() const { return position_ < xml_.size() ? xml_[position_] : '\0'; }
  bool AtEnd() const { return position_ >= xml_.size(); }
  void SkipSpace() {
    while (IsSpace(Next())) ++position_;
  }
  void SkipPast(std::string_view mark) {
    const std::size_t found = xml_.find(mark, position_);
    position_ = found == std::string_view::npos ? xml_.size() : found + mark.size();
  }
  std::string_view TakeQuoted() {
    const std::size_t begin = position_ + 1;
    const std::size_t end = std::min(xml_.find(Next(), begin), xml_.size());
    position_ = std::min(end + 1, xml_.size());
    return xml_.substr(begin, end - begin);
  }
  /// To the first of two characters outside of quotes; `or_else` is left unread.
  void SkipDeclaration(char or_else) {
    while (!AtEnd() && Next() != or_else) {
      if (Next() == '"' || Next() == '\'') {
        TakeQuoted();
      } else if (xml_[position_++] == '>') {
        return;
      }
    }
  }

  void Doctype() {
    SkipDeclaration('[');
    if (Next() != '[' || AtEnd()) return;
    ++position_;
    while (!AtEnd() && Next() != ']') {
      if (At("<!--")) {
        SkipPast("-->");
      } else if (At("<?")) {
        SkipPast("?>");
      } else if (At("<!ENTITY")) {
        Declaration();
      } else if (At("<!")) {
        SkipDeclaration('\0');
      } else {
        ++position_;
      }
    }
    SkipDeclaration('\0');
  }

  void Declaration() {
    position_ += std::string_view("<!ENTITY").size();
    SkipSpace();
    const std::size_t begin = position_;
    while (!AtEnd() && !IsSpace(Next()) && Next() != '>' && Next() != '"' && Next() != '\'') {
      ++position_;
    }
    const std::string_view name = xml_.substr(begin, position_ - begin);
    SkipSpace();
    if (name != "%" && (Next() == '"' || Next() == '\'')) {
      const std::string_view value = TakeQuoted();
      if (!name.empty() && !IsPredefined(name)) entities_.try_emplace(name, Entity{value, {}, {}});
    }
    SkipDeclaration('\0');
  }

  std::string_view xml_;
  std::size_t position_ = 0;
  Entities entities_;
};

class Expander {
 public:
  Expander(Entities entities, const EntityLimits& limits)
      : entities_(std::move(entities)), limits_(limits) {}

  ExpandedText Run(std::string_view xml, std::size_t body) {
    result_.text.assign(xml.substr(0, body));
    result_.stretches.push_back({0, 0, false});
    used_ = xml.size();
    for (std::size_t i = body; i < xml.size() && !result_.too_large;) i = Step(xml, i);
    return std::move(result_);
  }

 private:
  /// Copies or expands what stands at `i`; returns where to go on.
  std::size_t Step(std::string_view xml, std::size_t i) {
    const char c = xml[i];
    if (c == '&') {
      const auto [entity, end] = Reference(xml, i);
      if (entity != nullptr) {
        result_.stretches.push_back({result_.text.size(), i, true});
        Insert(Expanded(*entity, 1));
        result_.stretches.push_back({result_.text.size(), end, false});
        return end;
      }
    } else if (quote_ != '\0') {
      if (c == quote_) quote_ = '\0';
    } else if (in_tag_) {
      if (c == '"' || c == '\'') quote_ = c;
      if (c == '>') in_tag_ = false;
    } else if (c == '<') {
      const std::size_t end = EndOfUnexpanded(xml, i);
      if (end > i) {
        result_.text.append(xml.substr(i, end - i));
        return end;
      }
      in_tag_ = true;
    }
    result_.text.push_back(c);
    return i + 1;
  }

  /// Behind the comment, section or instruction that begins at `i`; `i` when none does.
  static std::size_t EndOfUnexpanded(std::string_view xml, std::size_t i) {
    constexpr std::array<std::pair<std::string_view, std::string_view>, 3> kPairs{
        {{"<!--", "-->"}, {"<![CDATA[", "]]>"}, {"<?", "?>"}}};
    for (const auto& [open, close] : kPairs) {
      if (!xml.substr(i).starts_with(open)) continue;
      const std::size_t end = xml.find(close, i + open.size());
      return end == std::string_view::npos ? xml.size() : end + close.size();
    }
    return i;
  }

  struct Found {
    Entity* entity = nullptr;
    std::size_t end = 0;
  };
  /// The declared entity that the '&' at `i` refers to.
  Found Reference(std::string_view text, std::size_t i) {
    constexpr std::size_t kLongestName = 256;
    const std::size_t length = text.substr(i + 1, kLongestName).find(';');
    if (length == std::string_view::npos) return {};
    const auto found = entities_.find(text.substr(i + 1, length));
    if (found == entities_.end()) return {};
    return {&found->second, i + 1 + length + 1};
  }

  /// The entity's value without references; each value is expanded once.
  const std::string& Expanded(Entity& entity, int depth) {
    if (entity.progress == Progress::kDone) return entity.expanded;
    if (depth > limits_.max_depth) {
      result_.too_large = true;
      return entity.expanded;
    }
    entity.progress = Progress::kBusy;
    std::string text;
    for (std::size_t i = 0; i < entity.value.size() && !result_.too_large;) {
      const Found found = entity.value[i] == '&' ? Reference(entity.value, i) : Found{nullptr, 0};
      if (found.entity != nullptr && found.entity->progress != Progress::kBusy) {
        const std::string& inner = Expanded(*found.entity, depth + 1);
        if (Charge(inner.size() + kReferenceCost)) text += inner;
        i = found.end;
      } else {
        text.push_back(entity.value[i++]);
      }
    }
    Charge(entity.value.size());
    entity.expanded = std::move(text);
    entity.progress = Progress::kDone;
    return entity.expanded;
  }

  void Insert(const std::string& value) {
    if (!Charge(value.size() + kReferenceCost)) return;
    if (!in_tag_) {
      result_.text += value;
      return;
    }
    for (const char c : value) {
      if (c == '<') {
        result_.text += "&lt;";
      } else if (c == '"') {
        result_.text += "&quot;";
      } else if (c == '\'') {
        result_.text += "&apos;";
      } else {
        result_.text.push_back(c);
      }
    }
  }

  bool Charge(std::size_t bytes) {
    used_ += bytes;
    if (used_ > limits_.max_bytes) result_.too_large = true;
    return !result_.too_large;
  }

  Entities entities_;
  EntityLimits limits_;
  ExpandedText result_;
  std::size_t used_ = 0;
  bool in_tag_ = false;
  char quote_ = '\0';
};

}  // namespace

std::size_t ExpandedText::SourceOffset(std::size_t offset) const {
  const auto after = std::upper_bound(
      stretches.begin(), stretches.end(), offset,
      [](std::size_t value, const Stretch& stretch) { return value < stretch.begin; });
  if (after == stretches.begin()) return offset;
  const Stretch& stretch = *std::prev(after);
  return stretch.expanded ? stretch.source : stretch.source + (offset - stretch.begin);
}

std::optional<ExpandedText> ExpandEntities(std::string_view xml, const EntityLimits& limits) {
  if (xml.find("<!ENTITY") == std::string_view::npos) return std::nullopt;
  PrologReader prolog(xml);
  Entities entities = prolog.Read();
  if (entities.empty()) return std::nullopt;
  return Expander(std::move(entities), limits).Run(xml, prolog.position());
}

}  // namespace lascaux::svg
