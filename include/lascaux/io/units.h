#pragma once

#include <cstdint>

/// @file
/// Units of the scene formats. Inside, everything is in millimetres.

namespace lascaux {

enum class Unit : std::uint8_t { kMillimetre, kCentimetre, kMetre };

/// How many of the unit a millimetre is: 1, 0.1, 0.001.
constexpr double PerMillimetre(Unit unit) noexcept {
  switch (unit) {
    case Unit::kMillimetre:
      return 1;
    case Unit::kCentimetre:
      return 0.1;
    case Unit::kMetre:
      break;
  }
  return 0.001;
}

/// "mm", "cm", "m": as on the command line.
constexpr const char* Name(Unit unit) noexcept {
  switch (unit) {
    case Unit::kMillimetre:
      return "mm";
    case Unit::kCentimetre:
      return "cm";
    case Unit::kMetre:
      break;
  }
  return "m";
}

}  // namespace lascaux
