#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <string>

#include "io/plugin_loader.h"
#include "lascaux/base/outcome.h"

namespace lascaux {

/// The bytes of a picture's file, by an encoder of the plugin. `path` is the one that errors name:
/// "cannot-write", "image-plugin-missing".
template <typename Plain>
Outcome<std::string> EncodePicture(const std::filesystem::path& path, const Plain& picture,
                                   int32_t (*ImagePlugin::*encode)(const Plain*, LascauxImageSink,
                                                                   void*)) {
  using Result = Outcome<std::string>;
  const Outcome<ImagePlugin>& plugin = OurImagePlugin();
  if (!plugin) return Result::Failure(plugin.diagnostics());
  std::string bytes;
  const auto append = [](void* text, const char* piece, std::size_t size) {
    static_cast<std::string*>(text)->append(piece, size);
  };
  if (((*plugin).*encode)(&picture, append, &bytes) != 0) {
    return Result::Failure(
        Error(FailureKind::kOutput, "cannot-write",
              fmt::format("cannot write '{}': {}; ask for a smaller picture", path.string(),
                          bytes.empty() ? "OpenImageIO gives no reason" : bytes)));
  }
  return bytes;
}

}  // namespace lascaux
