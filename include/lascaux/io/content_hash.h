#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

/// @file
/// A fingerprint of bytes: tells contents apart, does not protect against forgery.

namespace lascaux {

/// 128 bits of the bytes, the same on every machine. About 5 GB/s.
std::array<std::uint64_t, 2> ContentHash(std::string_view bytes) noexcept;

/// The same as 32 hexadecimal digits.
std::string ContentHashText(std::string_view bytes);

}  // namespace lascaux
