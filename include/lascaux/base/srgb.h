#pragma once

namespace lascaux {

/// Linear light of an sRGB component, and back; all 0 to 1. Source: IEC 61966-2-1.
double DecodeSrgb(double encoded) noexcept;
double EncodeSrgb(double linear) noexcept;

}  // namespace lascaux
