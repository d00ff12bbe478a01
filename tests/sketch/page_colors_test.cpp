#include "lascaux/sketch/page_colors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lascaux/sketch/read_svg.h"

namespace lascaux {
namespace {

using Eigen::Array3f;
using Eigen::Vector2d;

constexpr int kPixels = 200;

Array3f Linear(float r, float g, float b) {
  const auto linear = [](float s) {
    return s <= 0.04045F ? s / 12.92F : std::pow((s + 0.055F) / 1.055F, 2.4F);
  };
  return {linear(r / 255), linear(g / 255), linear(b / 255)};
}

std::size_t PixelAt(const PageColors& page, double x, double y) {
  const Vector2d p = (Vector2d(x, y) - page.origin) / page.pixel;
  return page.Index(static_cast<int>(p.x()), static_cast<int>(p.y()));
}

void ExpectColor(const PageColors& page, const Vector2d& at, const Array3f& color) {
  const std::size_t i = PixelAt(page, at.x(), at.y());
  EXPECT_TRUE(page.known[i]) << at.transpose();
  EXPECT_LT((page.colors[i] - color).abs().maxCoeff(), 0.01F)
      << at.transpose() << ": " << page.colors[i].transpose();
}

Sketch Read(const char* body) {
  const auto sketch =
      ReadSvg(std::string("<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 100 100'>") + body +
              "</svg>");
  EXPECT_TRUE(sketch.ok());
  return *sketch;
}

TEST(PageColors, ShowTheLastAreaThatWasPaintedOverAPlace) {
  const auto page = ColorsOf(
      Read("<rect width='100' height='100' fill='#c84020' stroke='#000'/>"
           "<path fill-rule='evenodd' fill='#3060a0' d='M20,20H80V80H20Z M40,40H60V60H40Z'/>"
           "<circle cx='30' cy='30' r='5' fill='white'/>"),
      kPixels);
  ASSERT_TRUE(page);
  ExpectColor(*page, {10, 50}, Linear(0xc8, 0x40, 0x20));
  ExpectColor(*page, {30, 50}, Linear(0x30, 0x60, 0xa0));
  ExpectColor(*page, {50, 50}, Linear(0xc8, 0x40, 0x20));
  ExpectColor(*page, {30, 30}, Linear(255, 255, 255));
}

TEST(PageColors, AreNotKnownBesideAreasAndWhiteFarFromThem) {
  const auto page = ColorsOf(Read("<rect width='100' height='100' fill='none' stroke='#000'/>"
                                  "<rect x='20' y='20' width='30' height='60' fill='#3060a0'/>"),
                             kPixels);
  ASSERT_TRUE(page);
  EXPECT_FALSE(page->known[PixelAt(*page, 51, 50)]);
  ExpectColor(*page, {70, 50}, Array3f::Ones());
  ExpectColor(*page, {49, 50}, Linear(0x30, 0x60, 0xa0));
}

TEST(PageColors, NeedAreas) {
  EXPECT_FALSE(ColorsOf(Read("<path d='M0,0H9V9Z' fill='none' stroke='#000'/>"), kPixels));
}

/// A red disc in a black ring on a page that light and its own colour make uneven.
Bitmap Photo(int side, const Array3f& paper) {
  Bitmap picture{side, side, std::vector<std::uint8_t>(std::size_t(4) * side * side, 255)};
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const double r = std::hypot(x - side / 2.0, y - side / 2.0) / side;
      Array3f light = paper * std::exp(-0.7F * static_cast<float>(x) / static_cast<float>(side));
      if (r < 0.3) light *= Linear(200, 60, 40);
      if (r > 0.28 && r < 0.3) light *= 0.02F;
      for (int k = 0; k < 3; ++k) {
        const float s = light[k] <= 0.0031308F ? 12.92F * light[k]
                                               : 1.055F * std::pow(light[k], 1 / 2.4F) - 0.055F;
        picture.rgba[4 * static_cast<std::size_t>(y * side + x) + static_cast<std::size_t>(k)] =
            static_cast<std::uint8_t>(std::lround(255 * s));
      }
    }
  }
  return picture;
}

TEST(PageColors, OfAPhotoAreThoseOnWhitePaperInEvenLight) {
  constexpr int kSide = 300;
  const Bitmap photo = Photo(kSide, {0.9F, 0.85F, 0.7F});
  // What tracing gives, but for corners on which the light is fitted.
  Sketch traced = Read(
      "<circle cx='150' cy='150' r='87' fill='none' stroke='#000' stroke-width='6'/>"
      "<path d='M20,20h2' stroke='#000'/><path d='M280,280h-2' stroke='#000'/>");
  const auto page = ColorsOf(photo, traced, kPixels);
  ASSERT_TRUE(page);
  for (const double x : {90.0, 150.0, 210.0}) ExpectColor(*page, {x, 150}, Linear(200, 60, 40));
  ExpectColor(*page, {40, 250}, Array3f::Ones());
  EXPECT_FALSE(page->known[PixelAt(*page, 150 + 87, 150)]);
  EXPECT_FALSE(ColorsOf(Photo(kSide, {0.02F, 0.02F, 0.02F}), traced, kPixels)) << "a dark page";
}

}  // namespace
}  // namespace lascaux
