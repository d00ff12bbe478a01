#include "lascaux/io/write_exr.h"

#include <cassert>
#include <cstddef>
#include <vector>

#include "io/encoded_picture.h"
#include "lascaux/io/output_file.h"

namespace lascaux {
namespace {

/// Channels of all layers, pixel by pixel.
class Channels {
 public:
  explicit Channels(std::size_t pixels) : pixels_(pixels) {}

  void Add(const std::vector<float>& layer, const std::vector<const char*>& names) {
    if (layer.empty()) return;
    assert(layer.size() == pixels_ * names.size());
    layers_.push_back({layer.data(), names.size()});
    names_.insert(names_.end(), names.begin(), names.end());
  }

  const std::vector<const char*>& names() const { return names_; }

  std::vector<float> Interleaved() const {
    std::vector<float> all;
    all.reserve(pixels_ * names_.size());
    for (std::size_t i = 0; i < pixels_; ++i) {
      for (const Layer& layer : layers_) {
        all.insert(all.end(), layer.values + i * layer.channels,
                   layer.values + (i + 1) * layer.channels);
      }
    }
    return all;
  }

 private:
  struct Layer {
    const float* values;
    std::size_t channels;
  };

  std::size_t pixels_;
  std::vector<Layer> layers_;
  std::vector<const char*> names_;
};

}  // namespace

Diagnostics WriteExr(const std::filesystem::path& path, const Picture& picture) {
  assert(picture.width > 0 && picture.height > 0);
  Channels channels(static_cast<std::size_t>(picture.width) *
                    static_cast<std::size_t>(picture.height));
  channels.Add(picture.rgba, {"R", "G", "B", "A"});
  channels.Add(picture.depth, {"Z"});
  channels.Add(picture.normal, {"N.X", "N.Y", "N.Z"});
  channels.Add(picture.part, {"id"});
  const std::vector<float> pixels = channels.Interleaved();
  const LascauxLayers plain{picture.width, picture.height,
                            static_cast<int32_t>(channels.names().size()), channels.names().data(),
                            pixels.data()};
  const Outcome<std::string> bytes = EncodePicture(path, plain, &ImagePlugin::encode_exr);
  return bytes ? WriteBytes(path, *bytes) : bytes.diagnostics();
}

}  // namespace lascaux
