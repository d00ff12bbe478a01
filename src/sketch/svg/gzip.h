#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "lascaux/base/outcome.h"

/// @file
/// Compressed documents (.svgz, RFC 1952).

namespace lascaux::svg {

/// True for bytes that begin as gzip files do.
bool IsGzip(std::string_view bytes);

/// What gzip members, one after the other, unpack to. Stops once that is more than `most` bytes, so
/// that a small file can't fill the memory. Errors: "broken-xml" (damaged, or cut off),
/// "too-large".
Outcome<std::string> Unzip(std::string_view bytes, std::size_t most);

}  // namespace lascaux::svg
