#include "io/image_plugin/decode.h"

#include <OpenImageIO/imageio.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <exception>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace {

/// The bytes under a name: not every format of OpenImageIO reads from memory.
class MemoryFile {
 public:
  MemoryFile(const char* bytes, size_t size) : descriptor_(memfd_create("picture", MFD_CLOEXEC)) {
    for (size_t done = 0; descriptor_ >= 0 && done < size;) {
      const ssize_t count = write(descriptor_, bytes + done, size - done);
      if (count <= 0) break;
      done += static_cast<size_t>(count);
    }
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  ~MemoryFile() {
    if (descriptor_ >= 0) close(descriptor_);
  }
  std::string Name() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

 private:
  int descriptor_;
};

struct Magic {
  std::string_view bytes;
  const char* format;
};

/// The reader for the most usual formats; for others OpenImageIO tries all that it has.
std::string ReaderFor(std::string_view bytes) {
  using namespace std::string_view_literals;
  constexpr std::array kMagic = {Magic{"\x89PNG"sv, "png"}, Magic{"\xff\xd8\xff"sv, "jpeg"},
                                 Magic{"II*\0"sv, "tiff"},  Magic{"MM\0*"sv, "tiff"},
                                 Magic{"BM"sv, "bmp"},      Magic{"RIFF"sv, "webp"},
                                 Magic{"GIF8"sv, "gif"},    Magic{"\x76\x2f\x31\x01"sv, "openexr"}};
  for (const Magic& magic : kMagic)
    if (bytes.starts_with(magic.bytes)) return magic.format;
  return {};
}

/// Where a pixel of the file belongs in the upright picture (Exif's eight orientations).
struct Upright {
  int width, height, orientation;

  bool swaps() const { return orientation >= 5; }
  size_t Index(int x, int y) const {
    const int w = width - 1 - x, h = height - 1 - y;
    const std::array<std::array<int, 2>, 8> place = {
        {{x, y}, {w, y}, {w, h}, {x, h}, {y, x}, {h, x}, {h, w}, {y, w}}};
    const auto [u, v] = place[static_cast<size_t>(orientation - 1)];
    return static_cast<size_t>(v) * static_cast<size_t>(swaps() ? height : width) +
           static_cast<size_t>(u);
  }
};

/// Grey becomes colour; what has no alpha is opaque.
void Complete(uint8_t* rgba, size_t pixels, int channels, int alpha) {
  for (size_t i = 0; i < pixels; ++i) {
    uint8_t* p = rgba + 4 * i;
    if (channels <= 2) {
      p[3] = channels == 2 ? p[1] : 255;
      p[1] = p[2] = p[0];
    } else if (channels == 3 || alpha < 0) {
      p[3] = 255;
    }
  }
}

struct Failure {
  int32_t code = 0;
  std::string reason;
};

Failure Decode(const LascauxEncoded& file, LascauxCanvas canvas, void* context) {
  const MemoryFile memory(file.bytes, file.size);
  const std::string reader = ReaderFor({file.bytes, file.size});
  OIIO::ImageSpec hints;
  hints.attribute("oiio:UnassociatedAlpha", 1);
  std::unique_ptr<OIIO::ImageInput> input;
  OIIO::ImageSpec spec;
  if (reader.empty()) {
    input = OIIO::ImageInput::open(memory.Name(), &hints);
    if (!input) return {1, OIIO::geterror()};
    spec = input->spec();
  } else {
    input = OIIO::ImageInput::create(reader);
    if (!input) return {1, OIIO::geterror()};
    if (!input->open(memory.Name(), spec, hints)) return {1, input->geterror()};
  }
  if (spec.width <= 0 || spec.height <= 0 || spec.depth > 1 || spec.nchannels < 1)
    return {1, "it holds no flat picture"};
  const int64_t pixels = int64_t{spec.width} * spec.height;
  if (pixels > file.max_pixels)
    return {2, std::to_string(spec.width) + " x " + std::to_string(spec.height)};

  const int channels = std::min(spec.nchannels, 4);
  const int turned = spec.get_int_attribute("Orientation", 1);
  const Upright upright{spec.width, spec.height, turned >= 1 && turned <= 8 ? turned : 1};
  std::vector<uint8_t> sideways;
  const auto upright_canvas = [&] {
    return upright.swaps() ? canvas(context, spec.height, spec.width)
                           : canvas(context, spec.width, spec.height);
  };
  uint8_t* target = nullptr;
  if (upright.orientation == 1) {
    target = upright_canvas();
  } else {
    sideways.resize(4 * static_cast<size_t>(pixels));
    target = sideways.data();
  }
  if (!input->read_image(0, 0, 0, channels, OIIO::TypeDesc::UINT8, target, 4))
    return {1, input->geterror()};
  Complete(target, static_cast<size_t>(pixels), channels, spec.alpha_channel);
  if (upright.orientation == 1) return {};
  uint8_t* const result = upright_canvas();
  for (int y = 0; y < spec.height; ++y)
    for (int x = 0; x < spec.width; ++x)
      std::copy_n(target + 4 * (static_cast<size_t>(y) * static_cast<size_t>(spec.width) +
                                static_cast<size_t>(x)),
                  4, result + 4 * upright.Index(x, y));
  return {};
}

}  // namespace

extern "C" __attribute__((visibility("default"))) int32_t lascaux_decode_1(
    const LascauxEncoded* file, LascauxCanvas canvas, LascauxImageSink reason, void* context) {
  Failure failure;
  try {
    OIIO::attribute("threads", 1);
    failure = Decode(*file, canvas, context);
  } catch (const std::exception& error) {
    failure = {1, error.what()};
  }
  if (failure.code != 0) reason(context, failure.reason.data(), failure.reason.size());
  return failure.code;
}
