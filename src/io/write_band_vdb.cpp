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

#include "io/vdb_conventions.h"
#include "io/vdb_tree.h"
#include "lascaux/io/output_file.h"

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
  /// Writes the end of the file so far there.
  void Place(std::size_t room) {
    const auto end = static_cast<std::int64_t>(bytes_.size());
    std::memcpy(bytes_.data() + room, &end, sizeof end);
  }

  void Reserve(std::size_t size) { bytes_.reserve(size); }
  std::string Take() && { return std::move(bytes_); }

 private:
  std::string bytes_;
};

/// A band in the unit of the scene.
class BandFile {
 public:
  BandFile(const NarrowBand& band, const WriteVdbOptions& options)
      : band_(band),
        options_(options),
        factor_(PerMillimetre(options.unit)),
        background_(VdbBackground(factor_ * band.voxel_size)),
        tree_(TreeOf(band)) {}

  std::string Encode() {
    file_.Reserve(band_.size() * (kBlockVoxels * sizeof(float)) / 2 + (std::size_t{1} << 16));
    WriteHeader();
    file_.Text("surface");
    file_.Text("Tree_float_5_4_3");
    file_.Text("");  // not an instance of another grid
    const std::size_t begin = file_.Room(), leaves = file_.Room(), end = file_.Room();
    file_.Place(begin);
    file_.Number(kActiveValuesOnly);
    WriteGridMetadata();
    WriteTransform();
    WriteTopology();
    file_.Place(leaves);
    ForLeaves([this](std::uint32_t block) { WriteLeaf(block); });
    file_.Place(end);
    return std::move(file_).Take();
  }

 private:
  void WriteHeader() {
    file_.Number(kMagic);
    file_.Number(kFileVersion);
    file_.Number(kLibraryMajor);
    file_.Number(kLibraryMinor);
    file_.Number(char{1});  // the grids' places are known
    for (int i = 0; i < 36; ++i) file_.Number('0');
    std::map<std::string, std::string> metadata(options_.metadata.begin(), options_.metadata.end());
    metadata.emplace("units", Name(options_.unit));
    metadata.emplace("up_axis", Name(options_.up));
    file_.Number(static_cast<std::uint32_t>(metadata.size()));
    for (const auto& [key, value] : metadata) file_.Entry(key, value);
    file_.Number(std::int32_t{1});  // grid
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
    file_.Number(std::uint32_t{7});
    file_.Entry("class", "level set");
    file_.Entry("file_bbox_max", box.max());
    file_.Entry("file_bbox_min", box.min());
    file_.Entry("file_compression", "active values");
    file_.Entry("file_mem_bytes", BytesInMemory());
    file_.Entry("file_voxel_count", CountActive(band_));
    file_.Entry("name", "surface");
  }

  void WriteTransform() {
    file_.Text("UniformScaleTranslateMap");
    const double scale = factor_ * band_.voxel_size;
    for (int axis = 0; axis < 3; ++axis) file_.Number(factor_ * band_.origin[axis]);
    // Scale and voxel size, and what OpenVDB keeps of them for differences.
    for (const double value : {scale, scale, 1 / scale, 1 / (scale * scale), 0.5 / scale}) {
      for (int axis = 0; axis < 3; ++axis) file_.Number(value);
    }
  }

  void WriteTopology() {
    file_.Number(std::int32_t{1});  // buffer a leaf
    file_.Number(background_);
    file_.Number(std::uint32_t{0});  // tiles of the root
    file_.Number(static_cast<std::uint32_t>(tree_.size()));
    for (const auto& [origin, upper] : tree_) {
      for (const int coordinate : origin) file_.Number(std::int32_t{coordinate});
      std::array<std::uint64_t, 512> children{};
      for (const auto& [at, lower] : upper.lower)
        children[at / 64U] |= std::uint64_t{1} << at % 64U;
      WriteNode(children, {});
      for (const auto& [at, lower] : upper.lower) {
        WriteNode(lower.leaves, lower.inside);
        for (const auto& [place, block] : lower.blocks)
          file_.Numbers(std::span<const std::uint64_t>(band_.active[block]));
      }
    }
  }

  /// A node's children and tiles, none of which is active.
  void WriteNode(std::span<const std::uint64_t> children, std::span<const std::uint64_t> inside) {
    file_.Numbers(children);
    const std::vector<std::uint64_t> active(children.size(), 0);
    file_.Numbers(std::span(active));
    std::vector<std::uint64_t> outside(children.size());
    std::uint64_t any_inside = 0, any_outside = 0;
    for (std::size_t i = 0; i < children.size(); ++i) {
      const std::uint64_t minus = inside.empty() ? 0 : inside[i] & ~children[i];
      outside[i] = ~(children[i] | minus);
      any_inside |= minus;
      any_outside |= outside[i];
    }
    WriteInactive(any_inside != 0, any_outside != 0, outside);
  }

  void WriteInactive(bool any_inside, bool any_outside, std::span<const std::uint64_t> outside) {
    const Inactive kind = !any_inside   ? Inactive::kPlus
                          : any_outside ? Inactive::kBoth
                                        : Inactive::kMinus;
    file_.Number(kind);
    if (kind == Inactive::kBoth) file_.Numbers(outside);
  }

  void WriteLeaf(std::uint32_t block) {
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
    file_.Numbers(std::span<const std::uint64_t>(active));
    WriteInactive(any_inside != 0, any_outside != 0, outside);
    file_.Numbers(std::span<const float>(written.data(), count));
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
  File file_;
};

}  // namespace

Diagnostics WriteBandVdb(const std::filesystem::path& path, const NarrowBand& band,
                         const WriteVdbOptions& options) {
  Diagnostics wrong = CheckVdbVoxelSize(path, band.voxel_size, options.unit);
  if (!wrong.empty()) return wrong;
  std::string bytes = BandFile(band, options).Encode();
  SetVdbId(bytes);
  return WriteBytes(path, bytes);
}

}  // namespace lascaux
