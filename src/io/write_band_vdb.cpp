#include "lascaux/io/write_band_vdb.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <map>
#include <span>
#include <string>
#include <string_view>

#include "io/file_writer.h"
#include "io/vdb_conventions.h"
#include "io/vdb_tree.h"
#include "lascaux/io/content_hash.h"

namespace lascaux {
namespace {

constexpr std::uint64_t kMagic = 0x56444220;
constexpr std::uint32_t kFileVersion = 224, kLibraryMajor = 10, kLibraryMinor = 0;
constexpr std::uint32_t kActiveValuesOnly = 2;  // COMPRESS_ACTIVE_MASK

/// Which inactive values a node has, all of which are plus or minus the background.
enum class Inactive : std::int8_t { kPlus = 0, kMinus = 1, kBoth = 3 };

/// Bytes of nodes in memory, as OpenVDB 10 counts them: tables, masks and places.
constexpr std::int64_t kRootBytes = 1304, kUpperBytes = 270348, kLowerBytes = 33804,
                       kLeafBytes = 2144;

class File {
 public:
  template <typename T>
  void Number(T value) {
    static_assert(std::endian::native == std::endian::little);
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  template <typename T>
  void Numbers(std::span<const T> values) {
    bytes_.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
  }
  void Text(std::string_view text) {
    Number(static_cast<std::uint32_t>(text.size()));
    bytes_.append(text);
  }
  void Entry(std::string_view key, std::string_view value) {
    Text(key);
    Text("string");
    Text(value);
  }
  void Entry(std::string_view key, std::int64_t value) {
    Text(key);
    Text("int64");
    Number(std::uint32_t{sizeof value});
    Number(value);
  }
  void Entry(std::string_view key, const Eigen::Vector3i& value) {
    Text(key);
    Text("vec3i");
    Number(std::uint32_t{3 * sizeof(std::int32_t)});
    for (int axis = 0; axis < 3; ++axis) Number(std::int32_t{value[axis]});
  }

  /// Room for a number that Place() fills in when it is known.
  std::size_t Room() {
    Number(std::int64_t{0});
    return bytes_.size() - sizeof(std::int64_t);
  }
  /// Writes the end of the file so far there, or of so many bytes behind that.
  void Place(std::size_t room, std::size_t behind = 0) {
    const auto end = static_cast<std::int64_t>(bytes_.size() + behind);
    std::memcpy(bytes_.data() + room, &end, sizeof end);
  }

  std::string& bytes() { return bytes_; }

 private:
  std::string bytes_;
};

/// Bytes of leaves that are gathered before they go to the file.
constexpr std::size_t kPieceBytes = std::size_t{1} << 20;

/// A band in the unit of the scene.
class BandFile {
 public:
  BandFile(const NarrowBand& band, const WriteVdbOptions& options)
      : band_(band),
        options_(options),
        factor_(PerMillimetre(options.unit)),
        background_(VdbBackground(factor_ * band.voxel_size)),
        tree_(TreeOf(band)) {}

  /// The leaves are most of the file and are written piece by piece. What is before them tells
  /// where they end, and is written once more then.
  Diagnostics Write(const std::filesystem::path& path) {
    WriteHeader();
    head_.Text("surface");
    head_.Text("Tree_float_5_4_3");
    head_.Text("");  // not an instance of another grid
    const std::size_t begin = head_.Room(), leaves = head_.Room(), end = head_.Room();
    head_.Place(begin);
    head_.Number(kActiveValuesOnly);
    WriteGridMetadata();
    WriteTransform();
    WriteTopology();
    head_.Place(leaves);
    FileWriter file(path);
    file.Write(head_.bytes());
    const Written written = WriteLeaves(file);
    head_.Place(end, written.bytes);
    SetVdbId(head_.bytes(), written.prints);
    file.Rewrite(head_.bytes());
    return file.Close();
  }

 private:
  /// Leaves in the file, and the hashes of their pieces.
  struct Written {
    std::size_t bytes = 0;
    std::string prints;
  };

  Written WriteLeaves(FileWriter& file) const {
    Written written;
    File piece;
    const auto flush = [&] {
      file.Write(piece.bytes());
      written.bytes += piece.bytes().size();
      written.prints += ContentHashText(piece.bytes());
      piece.bytes().clear();
    };
    ForLeaves([&](std::uint32_t block) {
      WriteLeaf(block, piece);
      if (piece.bytes().size() >= kPieceBytes) flush();
    });
    flush();
    return written;
  }

  void WriteHeader() {
    head_.Number(kMagic);
    head_.Number(kFileVersion);
    head_.Number(kLibraryMajor);
    head_.Number(kLibraryMinor);
    head_.Number(char{1});  // the grids' places are known
    for (int i = 0; i < 36; ++i) head_.Number('0');
    std::map<std::string, std::string> metadata(options_.metadata.begin(), options_.metadata.end());
    metadata.emplace("units", Name(options_.unit));
    metadata.emplace("up_axis", Name(options_.up));
    head_.Number(static_cast<std::uint32_t>(metadata.size()));
    for (const auto& [key, value] : metadata) head_.Entry(key, value);
    head_.Number(std::int32_t{1});  // grid
  }

  template <typename Visit>
  void ForLeaves(const Visit& visit) const {
    for (const auto& [origin, upper] : tree_) {
      for (const auto& [at, lower] : upper.lower) {
        for (const auto& [place, block] : lower.blocks) visit(block);
      }
    }
  }

  Eigen::AlignedBox3i ActiveBox() const {
    Eigen::AlignedBox3i box;
    for (std::size_t b = 0; b < band_.size(); ++b) {
      const VoxelMask& mask = band_.active[b];
      std::uint64_t any = 0;
      int first = -1, last = -1;
      for (int x = 0; x < 8; ++x) {
        if (mask[static_cast<std::size_t>(x)] == 0) continue;
        any |= mask[static_cast<std::size_t>(x)];
        if (first < 0) first = x;
        last = x;
      }
      if (any == 0) continue;
      std::uint64_t z = any;  // all y folded into one byte
      for (const int shift : {32, 16, 8}) z |= z >> shift;
      z &= 0xFF;
      const Eigen::Vector3i& at = band_.blocks[b];
      box.extend(Eigen::Vector3i(
          at + Eigen::Vector3i(first, std::countr_zero(any) / 8, std::countr_zero(z))));
      box.extend(Eigen::Vector3i(
          at + Eigen::Vector3i(last, (63 - std::countl_zero(any)) / 8, 63 - std::countl_zero(z))));
    }
    return box;
  }

  std::int64_t BytesInMemory() const {
    std::int64_t bytes = kRootBytes + kUpperBytes * static_cast<std::int64_t>(tree_.size()) +
                         kLeafBytes * static_cast<std::int64_t>(band_.size());
    for (const auto& [origin, upper] : tree_)
      bytes += kLowerBytes * static_cast<std::int64_t>(upper.lower.size());
    return bytes;
  }

  void WriteGridMetadata() {
    const Eigen::AlignedBox3i box = ActiveBox();
    head_.Number(std::uint32_t{7});
    head_.Entry("class", "level set");
    head_.Entry("file_bbox_max", box.max());
    head_.Entry("file_bbox_min", box.min());
    head_.Entry("file_compression", "active values");
    head_.Entry("file_mem_bytes", BytesInMemory());
    head_.Entry("file_voxel_count", CountActive(band_));
    head_.Entry("name", "surface");
  }

  void WriteTransform() {
    head_.Text("UniformScaleTranslateMap");
    const double scale = factor_ * band_.voxel_size;
    for (int axis = 0; axis < 3; ++axis) head_.Number(factor_ * band_.origin[axis]);
    // Scale and voxel size, and what OpenVDB keeps of them for differences.
    for (const double value : {scale, scale, 1 / scale, 1 / (scale * scale), 0.5 / scale}) {
      for (int axis = 0; axis < 3; ++axis) head_.Number(value);
    }
  }

  void WriteTopology() {
    head_.Number(std::int32_t{1});  // buffer a leaf
    head_.Number(background_);
    head_.Number(std::uint32_t{0});  // tiles of the root
    head_.Number(static_cast<std::uint32_t>(tree_.size()));
    for (const auto& [origin, upper] : tree_) {
      for (const int coordinate : origin) head_.Number(std::int32_t{coordinate});
      std::array<std::uint64_t, 512> children{};
      for (const auto& [at, lower] : upper.lower)
        children[at / 64U] |= std::uint64_t{1} << at % 64U;
      WriteNode(children, {});
      for (const auto& [at, lower] : upper.lower) {
        WriteNode(lower.leaves, lower.inside);
        for (const auto& [place, block] : lower.blocks)
          head_.Numbers(std::span<const std::uint64_t>(band_.active[block]));
      }
    }
  }

  /// A node's children and tiles, none of which is active.
  void WriteNode(std::span<const std::uint64_t> children, std::span<const std::uint64_t> inside) {
    head_.Numbers(children);
    const std::vector<std::uint64_t> active(children.size(), 0);
    head_.Numbers(std::span(active));
    std::vector<std::uint64_t> outside(children.size());
    std::uint64_t any_inside = 0, any_outside = 0;
    for (std::size_t i = 0; i < children.size(); ++i) {
      const std::uint64_t minus = inside.empty() ? 0 : inside[i] & ~children[i];
      outside[i] = ~(children[i] | minus);
      any_inside |= minus;
      any_outside |= outside[i];
    }
    WriteInactive({any_inside != 0, any_outside != 0, outside}, head_);
  }

  /// Signs of a node's inactive values.
  struct Signs {
    bool any_inside, any_outside;
    std::span<const std::uint64_t> outside;
  };

  static void WriteInactive(const Signs& signs, File& to) {
    const Inactive kind = !signs.any_inside   ? Inactive::kPlus
                          : signs.any_outside ? Inactive::kBoth
                                              : Inactive::kMinus;
    to.Number(kind);
    if (kind == Inactive::kBoth) to.Numbers(signs.outside);
  }

  void WriteLeaf(std::uint32_t block, File& piece) const {
    const VoxelMask& active = band_.active[block];
    const float* const values = band_.values.data() + kBlockVoxels * block;
    std::array<float, kBlockVoxels> written;
    std::size_t count = 0;
    VoxelMask outside{};
    std::uint64_t any_inside = 0, any_outside = 0;
    for (std::size_t x = 0; x < 8; ++x) {
      std::uint64_t negative = 0;
      for (std::size_t i = 0; i < 64; ++i)
        negative |= static_cast<std::uint64_t>(std::signbit(values[64 * x + i])) << i;
      outside[x] = ~(active[x] | negative);
      any_inside |= negative & ~active[x];
      any_outside |= outside[x];
      for (std::uint64_t word = active[x]; word != 0; word &= word - 1)
        written[count++] =
            Scaled(values[64 * x + static_cast<std::size_t>(std::countr_zero(word))]);
    }
    piece.Numbers(std::span<const std::uint64_t>(active));
    WriteInactive({any_inside != 0, any_outside != 0, outside}, piece);
    piece.Numbers(std::span<const float>(written.data(), count));
  }

  /// Rounding may carry a distance at the band's edge past the background by one bit.
  float Scaled(float value) const {
    const auto scaled = static_cast<float>(factor_ * static_cast<double>(value));
    return std::clamp(scaled, -background_, background_);
  }

  const NarrowBand& band_;
  const WriteVdbOptions& options_;
  double factor_;
  float background_;
  VdbTree tree_;
  File head_;
};

}  // namespace

Diagnostics WriteBandVdb(const std::filesystem::path& path, const NarrowBand& band,
                         const WriteVdbOptions& options) {
  Diagnostics wrong = CheckVdbVoxelSize(path, band.voxel_size, options.unit);
  if (!wrong.empty()) return wrong;
  return BandFile(band, options).Write(path);
}

}  // namespace lascaux
