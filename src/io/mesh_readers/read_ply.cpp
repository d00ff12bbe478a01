#include <algorithm>
#include <bit>
#include <map>
#include <optional>

#include "io/mesh_readers/readers.h"

namespace lascaux {
namespace {

enum class Encoding : std::uint8_t { kText, kLittle, kBig };

/// A kind of number; `size` is 0 for none.
struct Number {
  int size = 0;
  bool real = false, negative = false;
};

struct Property {
  std::string_view name;
  Number number;  ///< of the value, or of a list's members
  Number count;   ///< of a list's length; size 0 for a single value
};

struct Element {
  std::string_view name;
  std::size_t count = 0;
  std::vector<Property> properties;
};

struct Header {
  Encoding encoding = Encoding::kText;
  std::vector<Element> elements;
  std::vector<MeshPart> parts;
  double unit = 0;
};

Number NumberNamed(std::string_view name) {
  static const std::map<std::string_view, Number> kNumbers = {
      {"char", {1, false, true}},    {"int8", {1, false, true}},    {"uchar", {1, false, false}},
      {"uint8", {1, false, false}},  {"short", {2, false, true}},   {"int16", {2, false, true}},
      {"ushort", {2, false, false}}, {"uint16", {2, false, false}}, {"int", {4, false, true}},
      {"int32", {4, false, true}},   {"uint", {4, false, false}},   {"uint32", {4, false, false}},
      {"float", {4, true, true}},    {"float32", {4, true, true}},  {"double", {8, true, true}},
      {"float64", {8, true, true}}};
  const auto found = kNumbers.find(name);
  return found == kNumbers.end() ? Number{} : found->second;
}

/// The values of a file's body, one after the other.
class Values {
 public:
  Values(std::string_view body, Encoding encoding)
      : cursor_(body), body_(body), encoding_(encoding) {}

  /// The next number; empty at the end and where there is none.
  std::optional<double> Next(const Number& number) {
    if (encoding_ == Encoding::kText) {
      const std::string_view word = cursor_.Word();
      long long whole = 0;
      if (!number.real && ToInteger(word, whole)) return static_cast<double>(whole);
      float value = 0;
      if (!ToFloat(word, value)) return std::nullopt;
      return value;
    }
    const auto size = static_cast<std::size_t>(number.size);
    if (body_.size() < size) return std::nullopt;
    std::array<char, 8> bytes{};
    std::copy_n(body_.data(), size, bytes.data());
    body_.remove_prefix(size);
    const bool swap = (encoding_ == Encoding::kBig) == (std::endian::native == std::endian::little);
    if (swap) std::reverse(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
    return Value({bytes.data(), 8}, number);
  }

 private:
  static double Value(std::string_view bytes, const Number& number) {
    switch (number.size) {
      case 1:
        return number.negative ? ValueAt<std::int8_t>(bytes, 0) : ValueAt<std::uint8_t>(bytes, 0);
      case 2:
        return number.negative ? ValueAt<std::int16_t>(bytes, 0) : ValueAt<std::uint16_t>(bytes, 0);
      case 4:
        if (number.real) return static_cast<double>(ValueAt<float>(bytes, 0));
        return number.negative ? ValueAt<std::int32_t>(bytes, 0) : ValueAt<std::uint32_t>(bytes, 0);
      default:
        return ValueAt<double>(bytes, 0);
    }
  }

  TextCursor cursor_;
  std::string_view body_;
  Encoding encoding_;
};

class PlyReader {
 public:
  explicit PlyReader(const ReadMeshOptions& options) : options_(options) {}

  Outcome<LoadedMesh> Read(std::string_view bytes) {
    TextCursor lines(bytes);
    if (!ReadHeader(lines)) return Broken("has a header that can't be understood");
    Values values(lines.rest(), header_.encoding);
    for (const Element& element : header_.elements) {
      for (std::size_t i = 0; i < element.count; ++i) {
        if (!ReadElement(element, values))
          return Broken(
              fmt::format("ends or is damaged at {} {} of {}", element.name, i, element.count));
        if (loaded_.mesh.triangles.size() > options_.max_triangles)
          return TooManyTriangles(MeshFormat::kPly, options_);
      }
    }
    Finish();
    return std::move(loaded_);
  }

 private:
  static Outcome<LoadedMesh> Broken(const std::string& what) {
    return BrokenMesh(MeshFormat::kPly, what);
  }

  bool ReadHeader(TextCursor& lines) {
    std::string_view line;
    while (lines.Line(line)) {
      TextCursor words(line);
      const std::string_view key = words.Word();
      if (key == "end_header") return true;
      if (key == "format") {
        const std::string_view name = words.Word();
        header_.encoding = name == "binary_little_endian" ? Encoding::kLittle
                           : name == "binary_big_endian"  ? Encoding::kBig
                                                          : Encoding::kText;
      }
      if (key == "comment") ReadComment(words);
      if (key == "element" && !AddElement(words)) return false;
      if (key == "property" && !AddProperty(words)) return false;
    }
    return false;
  }

  void ReadComment(TextCursor words) {
    if (header_.unit == 0) header_.unit = UnitInComment(words.rest());
    long long index = 0;
    if (words.Word() == "part" && ToInteger(words.Word(), index) &&
        index == static_cast<long long>(header_.parts.size()))
      header_.parts.push_back({std::string(words.Word()), PartColor(static_cast<int>(index))});
  }

  bool AddElement(TextCursor& words) {
    Element element;
    element.name = words.Word();
    long long count = 0;
    if (!ToInteger(words.Word(), count) || count < 0) return false;
    element.count = static_cast<std::size_t>(count);
    header_.elements.push_back(element);
    return true;
  }

  bool AddProperty(TextCursor& words) {
    if (header_.elements.empty()) return false;
    Property property;
    std::string_view type = words.Word();
    if (type == "list") {
      property.count = NumberNamed(words.Word());
      if (property.count.size == 0 || property.count.real) return false;
      type = words.Word();
    }
    property.number = NumberNamed(type);
    property.name = words.Word();
    header_.elements.back().properties.push_back(property);
    return property.number.size > 0;
  }

  bool ReadElement(const Element& element, Values& values) {
    // Elements without properties take no bytes: a file could claim any number of them.
    if (element.properties.empty()) return false;
    const bool vertex = element.name == "vertex", face = element.name == "face";
    Eigen::Vector3f position = Eigen::Vector3f::Zero();
    double part = 0;
    for (const Property& property : element.properties) {
      if (property.count.size > 0) {
        const bool corners =
            face && (property.name == "vertex_indices" || property.name == "vertex_index");
        if (!ReadList(property, values, corners)) return false;
        continue;
      }
      const std::optional<double> value = values.Next(property.number);
      if (!value) return false;
      if (property.name == "part_id") part = *value;
      if (property.name.size() == 1 && property.name[0] >= 'x' && property.name[0] <= 'z')
        position[property.name[0] - 'x'] = static_cast<float>(*value);
    }
    if (!vertex) return true;
    loaded_.mesh.vertices.push_back(position);
    const bool known = part >= 0 && part < static_cast<double>(header_.parts.size());
    loaded_.details.vertex_parts.push_back(known ? static_cast<std::uint16_t>(part)
                                                 : std::uint16_t{0});
    return true;
  }

  bool ReadList(const Property& property, Values& values, bool corners) {
    const std::optional<double> count = values.Next(property.count);
    if (!count || !(*count >= 0)) return false;
    std::array<std::uint32_t, 3> fan{};
    double read = 0;
    for (; read < *count; ++read) {
      const std::optional<double> value = values.Next(property.number);
      if (!value) return false;
      const bool possible = *value >= 0 && *value < 4294967295.0;
      const std::uint32_t corner = possible ? static_cast<std::uint32_t>(*value) : ~0U;
      if (read < 3) {
        fan[static_cast<std::size_t>(read)] = corner;
      } else {
        fan[1] = fan[2];
        fan[2] = corner;
      }
      if (corners && read >= 2) loaded_.mesh.triangles.push_back(fan);
    }
    return !corners || read >= 3;
  }

  void Finish() {
    loaded_.format = MeshFormat::kPly;
    if (header_.unit > 0) loaded_.millimetres = header_.unit;
    MeshDetails& details = loaded_.details;
    const std::size_t count = loaded_.mesh.vertices.size();
    if (header_.parts.empty()) {
      details = {};
      return;
    }
    details.parts = std::move(header_.parts);
    for (const auto& triangle : loaded_.mesh.triangles)
      details.triangle_parts.push_back(triangle[0] < count ? details.vertex_parts[triangle[0]]
                                                           : std::uint16_t{0});
  }

  const ReadMeshOptions& options_;
  Header header_;
  LoadedMesh loaded_;
};

}  // namespace

Outcome<LoadedMesh> ReadPly(std::string_view bytes, const ReadMeshOptions& options) {
  return PlyReader(options).Read(bytes);
}

}  // namespace lascaux
