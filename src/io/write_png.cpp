#include "lascaux/io/write_png.h"

#include <cassert>

#include "io/encoded_picture.h"
#include "lascaux/io/output_file.h"

namespace lascaux {

Outcome<std::string> EncodePng(const std::filesystem::path& path, const Image& image) {
  assert(image.width > 0 && image.height > 0);
  assert(image.rgba.size() == std::size_t{4} * static_cast<std::size_t>(image.width) *
                                  static_cast<std::size_t>(image.height));
  const LascauxImage plain{image.width, image.height, image.rgba.data()};
  return EncodePicture(path, plain, &ImagePlugin::encode_png);
}

Diagnostics WritePng(const std::filesystem::path& path, const Image& image) {
  const Outcome<std::string> bytes = EncodePng(path, image);
  return bytes ? WriteBytes(path, *bytes) : bytes.diagnostics();
}

}  // namespace lascaux
