#include "lascaux/io/content_hash.h"

#include <bit>
#include <cstddef>

namespace lascaux {
namespace {

// Odd constants with well mixed bits: the fractions of the golden ratio and of pi.
constexpr std::uint64_t kFirst = 0x9e3779b97f4a7c15;
constexpr std::uint64_t kSecond = 0x243f6a8885a308d3;

/// Up to eight bytes as a little endian number, whatever the machine's order.
std::uint64_t Word(std::string_view bytes) noexcept {
  std::uint64_t word = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    word |= static_cast<std::uint64_t>(static_cast<unsigned char>(bytes[i])) << (8 * i);
  }
  return word;
}

std::uint64_t Mix(std::uint64_t state, std::uint64_t word, std::uint64_t factor) noexcept {
  return std::rotl((state ^ word) * factor, 29);
}

/// Spreads the last words over all bits.
std::uint64_t Finish(std::uint64_t state) noexcept {
  state = (state ^ (state >> 32)) * kFirst;
  state = (state ^ (state >> 29)) * (kSecond | 1);
  return state ^ (state >> 32);
}

}  // namespace

std::array<std::uint64_t, 2> ContentHash(std::string_view bytes) noexcept {
  // The length tells contents apart that differ in zeros at the end.
  std::uint64_t a = bytes.size() * kFirst, b = ~a;
  for (; bytes.size() >= 8; bytes.remove_prefix(8)) {
    const std::uint64_t word = Word(bytes.substr(0, 8));
    a = Mix(a, word, kFirst);
    b = Mix(b, std::rotl(word, 32), kSecond);
  }
  const std::uint64_t rest = Word(bytes);
  return {Finish(Mix(a, rest, kFirst) + b), Finish(Mix(b, rest, kSecond) ^ a)};
}

std::string ContentHashText(std::string_view bytes) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  for (const std::uint64_t half : ContentHash(bytes)) {
    for (int shift = 60; shift >= 0; shift -= 4) text += kDigits[(half >> shift) & 15];
  }
  return text;
}

}  // namespace lascaux
