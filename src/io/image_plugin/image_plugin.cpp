#include "io/image_plugin/image_plugin.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <exception>
#include <memory>
#include <string>
#include <vector>

namespace {

/// What went wrong is in `error`, which is empty for nothing.
struct Encoded {
  std::vector<unsigned char> bytes;
  std::string error;
};

Encoded Encode(const char* format, const OIIO::ImageSpec& spec, OIIO::TypeDesc type,
               const void* pixels) {
  Encoded encoded;
  OIIO::Filesystem::IOVecOutput memory(encoded.bytes);
  const auto output = OIIO::ImageOutput::create(format, &memory);
  if (!output) {
    encoded.error = OIIO::geterror();
  } else if (!output->open(std::string("memory.") + format, spec) ||
             !output->write_image(type, pixels) || !output->close()) {
    encoded.error = output->geterror();
  }
  return encoded;
}

/// Colours and normals as half, as is usual; depths and ids need all bits.
Encoded EncodeExr(const LascauxLayers& layers) {
  OIIO::ImageSpec spec(layers.width, layers.height, layers.channels, OIIO::TypeDesc::FLOAT);
  spec.channelnames.clear();
  spec.alpha_channel = spec.z_channel = -1;
  for (int i = 0; i < layers.channels; ++i) {
    const std::string name = layers.names[i];
    if (name == "A") spec.alpha_channel = i;
    if (name == "Z") spec.z_channel = i;
    spec.channelnames.push_back(name);
    const bool exact = name == "Z" || name == "id";
    spec.channelformats.push_back(exact ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::HALF);
  }
  spec.attribute("compression", "zip");
  spec.attribute("oiio:ColorSpace", "Linear");
  // The writer would put the clock in, and equal pictures would differ.
  spec.attribute("DateTime", "1970:01:01 00:00:00");
  return Encode("exr", spec, OIIO::TypeDesc::FLOAT, layers.pixels);
}

template <typename Picture>
int32_t Run(Encoded (*encode)(const Picture&), const Picture* picture, LascauxImageSink sink,
            void* context) {
  std::string error;
  try {
    // Pictures of one run are small: a pool of threads would cost more than it saves.
    OIIO::attribute("threads", 1);
    OIIO::attribute("exr_threads", -1);
    const Encoded encoded = encode(*picture);
    if (encoded.error.empty()) {
      sink(context, reinterpret_cast<const char*>(encoded.bytes.data()), encoded.bytes.size());
      return 0;
    }
    error = encoded.error;
  } catch (const std::exception& failure) {
    error = failure.what();
  }
  sink(context, error.data(), error.size());
  return 1;
}

}  // namespace

extern "C" __attribute__((visibility("default"))) int32_t lascaux_encode_exr_1(
    const LascauxLayers* layers, LascauxImageSink sink, void* context) {
  return Run(EncodeExr, layers, sink, context);
}
