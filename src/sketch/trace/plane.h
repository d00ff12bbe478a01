#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace lascaux::trace {

/// One value a pixel, rows from the top.
template <typename T>
struct Plane {
  int width = 0, height = 0;
  std::vector<T> data;

  Plane() = default;
  Plane(int w, int h, T value = {})
      : width(w),
        height(h),
        data(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), value) {}

  std::size_t Index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x);
  }
  T* Row(int y) { return data.data() + Index(0, y); }
  const T* Row(int y) const { return data.data() + Index(0, y); }
  T& operator()(int x, int y) { return data[Index(x, y)]; }
  const T& operator()(int x, int y) const { return data[Index(x, y)]; }
  bool Holds(int x, int y) const { return x >= 0 && y >= 0 && x < width && y < height; }
};

/// 1 where there is ink, 0 elsewhere. The outermost pixels are never ink, so that neighbours need
/// no test.
using Mask = Plane<std::uint8_t>;
/// Lightness or strength of ink, 0 to 1.
using Tone = Plane<float>;

/// The 8 neighbours, clockwise from the right; even ones share an edge with the pixel.
inline constexpr int kDx[8] = {1, 1, 0, -1, -1, -1, 0, 1};
inline constexpr int kDy[8] = {0, 1, 1, 1, 0, -1, -1, -1};

}  // namespace lascaux::trace
