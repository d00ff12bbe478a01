#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

#include "lascaux/volume/picture.h"

namespace lascaux {
namespace {

using Layer = std::vector<float> Picture::*;

/// One layer of all pictures on one sheet; empty when one of them is without it.
class Sheet {
 public:
  Sheet(const std::vector<Picture>& pictures, int columns)
      : pictures_(pictures),
        columns_(static_cast<std::size_t>(columns)),
        rows_((pictures.size() + columns_ - 1) / columns_) {}

  int width() const { return static_cast<int>(columns_) * pictures_[0].width; }
  int height() const { return static_cast<int>(rows_) * pictures_[0].height; }

  std::vector<float> Arrange(Layer layer, std::size_t channels) const {
    const auto lacks = [&](const Picture& p) { return (p.*layer).empty(); };
    if (std::any_of(pictures_.begin(), pictures_.end(), lacks)) return {};
    const std::size_t row = channels * static_cast<std::size_t>(pictures_[0].width);
    const auto height = static_cast<std::size_t>(pictures_[0].height);
    std::vector<float> sheet(row * columns_ * height * rows_);
    const std::vector<float>& first = pictures_[0].*layer;
    for (std::size_t cell = 0; cell < columns_ * rows_; ++cell) {
      for (std::size_t y = 0; y < height; ++y) {
        float* const to =
            sheet.data() + (cell / columns_ * height + y) * row * columns_ + cell % columns_ * row;
        if (cell < pictures_.size()) {
          std::copy_n((pictures_[cell].*layer).data() + y * row, row, to);
        } else {
          for (std::size_t i = 0; i < row; ++i) to[i] = first[i % channels];
        }
      }
    }
    return sheet;
  }

 private:
  const std::vector<Picture>& pictures_;
  std::size_t columns_, rows_;
};

}  // namespace

Picture ArrangePictures(const std::vector<Picture>& pictures, int columns) {
  assert(!pictures.empty() && columns > 0);
  const Sheet sheet(pictures, columns);
  Picture all{sheet.width(), sheet.height(), {}, {}, {}, {}};
  all.rgba = sheet.Arrange(&Picture::rgba, 4);
  all.depth = sheet.Arrange(&Picture::depth, 1);
  all.normal = sheet.Arrange(&Picture::normal, 3);
  all.part = sheet.Arrange(&Picture::part, 1);
  return all;
}

int SheetColumns(int count) noexcept {
  return static_cast<int>(std::ceil(std::sqrt(static_cast<double>(count))));
}

}  // namespace lascaux
