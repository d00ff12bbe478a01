#include "lascaux/io/write_png.h"

#include <fmt/format.h>

#include <cassert>
#include <string>

#include "io/plugin_loader.h"
#include "lascaux/io/output_file.h"

namespace lascaux {
namespace {

void Append(void* text, const char* bytes, std::size_t size) {
  static_cast<std::string*>(text)->append(bytes, size);
}

}  // namespace

Diagnostics WritePng(const std::filesystem::path& path, const Image& image) {
  assert(image.width > 0 && image.height > 0);
  assert(image.rgba.size() == std::size_t{4} * static_cast<std::size_t>(image.width) *
                                  static_cast<std::size_t>(image.height));
  static const Outcome<LascauxEncodePng> encoder = LoadPngEncoder(PluginFolders());
  if (!encoder) return encoder.diagnostics();
  const LascauxImage plain{image.width, image.height, image.rgba.data()};
  std::string bytes;
  if ((*encoder)(&plain, Append, &bytes) != 0) {
    return {Error(FailureKind::kOutput, "cannot-write",
                  fmt::format("cannot write '{}': {}; ask for a smaller picture", path.string(),
                              bytes.empty() ? "OpenImageIO gives no reason" : bytes))};
  }
  return WriteBytes(path, bytes);
}

}  // namespace lascaux
