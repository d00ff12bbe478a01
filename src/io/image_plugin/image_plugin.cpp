#include "io/image_plugin/image_plugin.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <exception>
#include <memory>
#include <string>
#include <vector>

namespace {

/// The bytes of the file; what went wrong in `error`, which is empty for nothing.
std::vector<unsigned char> EncodePng(const LascauxImage& image, std::string& error) {
  OIIO::ImageSpec spec(image.width, image.height, 4, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  spec.attribute("oiio:UnassociatedAlpha", 1);
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  const auto output = OIIO::ImageOutput::create("png", &memory);
  if (!output) {
    error = OIIO::geterror();
  } else if (!output->open("memory.png", spec) ||
             !output->write_image(OIIO::TypeDesc::UINT8, image.rgba) || !output->close()) {
    error = output->geterror();
  }
  return bytes;
}

}  // namespace

extern "C" __attribute__((visibility("default"))) int32_t lascaux_encode_png_1(
    const LascauxImage* image, LascauxImageSink sink, void* context) {
  std::string error;
  try {
    // Pictures of one run are small: a pool of threads would cost more than it saves.
    OIIO::attribute("threads", 1);
    const auto bytes = EncodePng(*image, error);
    if (error.empty()) {
      sink(context, reinterpret_cast<const char*>(bytes.data()), bytes.size());
      return 0;
    }
  } catch (const std::exception& failure) {
    error = failure.what();
  }
  sink(context, error.data(), error.size());
  return 1;
}
