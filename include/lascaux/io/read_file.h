#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "lascaux/base/outcome.h"

/// @file
/// Inputs as bytes.

namespace lascaux {

struct ReadBytesOptions {
  std::size_t max_bytes = std::size_t{1}
                          << 30;  ///< larger inputs are refused before they cost memory

  bool operator==(const ReadBytesOptions&) const = default;
};

/// All bytes of a file, or of standard input for the path "-". An empty file is an empty string.
///
/// Reads pipes and devices, too; at most max_bytes + 1 bytes of them. Error: "cannot-read" with the
/// path, the reason and the remedy: missing, a folder, no permission, larger than max_bytes.
Outcome<std::string> ReadBytes(const std::filesystem::path& path,
                               const ReadBytesOptions& options = {});

}  // namespace lascaux
