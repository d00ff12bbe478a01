#include "sketch/trace/find_ink.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sketch/trace/distance.h"
#include "sketch/trace/fills.h"
#include "sketch/trace/filters.h"
#include "sketch/trace/regions.h"

namespace lascaux::trace {
namespace {

constexpr float kBlack = 0.08f;   // lightness that is added, so that noise in the dark counts less
constexpr double kWidest = 0.02;  // of the picture's diagonal: a pen's width when it isn't known
constexpr float kFaintest = 0.06f;  // strength of ink that an eye still sees
constexpr double kSeedShare =
    0.6;  // of the threshold between ink and page: a line has a place so dark
constexpr double kGrowShare = 0.35;  // of it: and none lighter than this
constexpr double kNoise = 5;         // deviations of the paper that are not ink
constexpr double kSpeck = 0.5;       // widths along a side of the least blot
constexpr double kPinhole = 0.3;     // and of the least hole in the ink
constexpr float kAsDark = 0.2f;      // how far from ink to page an area filled with ink may be

/// The value that a share of all values lies below.
float Quantile(std::vector<float> values, double share) {
  if (values.empty()) return 0;
  const auto n = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + n, values.end());
  return values[static_cast<std::size_t>(n)];
}

/// Every n-th value, at most about 100,000 of them: enough for what is typical.
std::vector<float> Sampled(const Tone& tone) {
  const std::size_t step = std::max<std::size_t>(1, tone.data.size() / 100'000) | 1;
  std::vector<float> values;
  for (std::size_t i = 0; i < tone.data.size(); i += step) values.push_back(tone.data[i]);
  return values;
}

/// Standard deviation of the paper's grain, from second differences along rows, robust to lines.
double GrainOf(const Tone& tone) {
  std::vector<float> differences;
  const int step = std::max(1, tone.height / 200);
  for (int y = 0; y < tone.height; y += step)
    for (int x = 1; x + 1 < tone.width; ++x)
      differences.push_back(std::abs(tone(x, y) - 0.5f * (tone(x - 1, y) + tone(x + 1, y))));
  return Quantile(std::move(differences), 0.5) / (0.6745 * std::sqrt(1.5));
}

/// The threshold that parts values in [0, 1] best into two classes (N. Otsu 1979).
float OtsuThreshold(const Tone& tone) {
  constexpr int kBins = 256;
  std::array<double, kBins> count{};
  for (const float v : tone.data)
    count[static_cast<std::size_t>(std::clamp(v, 0.f, 1.f) * (kBins - 1) + 0.5f)] += 1;
  double all = 0, sum = 0;
  for (int i = 0; i < kBins; ++i)
    all += count[static_cast<std::size_t>(i)], sum += i * count[static_cast<std::size_t>(i)];
  double below = 0, sum_below = 0, best = -1, threshold = 0.5;
  for (int i = 0; i + 1 < kBins; ++i) {
    below += count[static_cast<std::size_t>(i)];
    sum_below += i * count[static_cast<std::size_t>(i)];
    const double above = all - below;
    if (below <= 0 || above <= 0) continue;
    const double apart = sum_below / below - (sum - sum_below) / above;
    const double variance = below * above * apart * apart;
    if (variance > best) best = variance, threshold = (i + 0.5) / (kBins - 1);
  }
  return static_cast<float>(threshold);
}

/// How much darker each pixel is than both of its sides, 0 to 1.
Tone StrengthOf(const Tone& tone, int radius) {
  Tone strength = Closed(tone, radius);
  for (std::size_t i = 0; i < strength.data.size(); ++i)
    strength.data[i] = 1 - (tone.data[i] + kBlack) / (strength.data[i] + kBlack);
  return strength;
}

struct Levels {
  float seed, grow;
};

/// From the distribution of strength: the grain of the paper has some, everywhere.
Levels LevelsOf(const Tone& strength) {
  const std::vector<float> values = Sampled(strength);
  const float typical = Quantile(values, 0.5);
  std::vector<float> off;
  for (const float v : values) off.push_back(std::abs(v - typical));
  const double grain = Quantile(std::move(off), 0.5) / 0.6745;
  const double floor = std::max<double>(kFaintest, typical + kNoise * grain);
  const double split = OtsuThreshold(strength);
  return {static_cast<float>(std::max(floor, kSeedShare * split)),
          static_cast<float>(std::max(floor, kGrowShare * split))};
}

void ClearEdge(Mask& mask) {
  for (int x = 0; x < mask.width; ++x) mask(x, 0) = mask(x, mask.height - 1) = 0;
  for (int y = 0; y < mask.height; ++y) mask(0, y) = mask(mask.width - 1, y) = 0;
}

Mask MaskOf(const Tone& coverage) {
  Mask mask(coverage.width, coverage.height);
  for (std::size_t i = 0; i < mask.data.size(); ++i)
    mask.data[i] = coverage.data[i] >= 0.5f ? 1 : 0;
  ClearEdge(mask);
  return mask;
}

/// Strength as a share of the greatest nearby.
Tone CoverageOf(const Tone& strength, const Levels& levels, double width) {
  Tone coverage = Dilated(strength, std::max(1, static_cast<int>(std::lround(0.6 * width))));
  for (std::size_t i = 0; i < coverage.data.size(); ++i)
    coverage.data[i] =
        std::clamp(strength.data[i] / std::max(coverage.data[i], 2 * levels.grow), 0.f, 1.f);
  return coverage;
}

/// Removes what has no place that is surely ink, and specks; fills pinholes.
void CleanUp(Ink& ink, const Tone& strength, const Levels& levels) {
  const double least = std::pow(kSpeck * ink.width, 2);
  for (const Region& region : RegionsOf(ink.mask, 1, Neighbours::kCorners)) {
    const bool sure = std::any_of(region.begin(), region.end(), [&](std::int32_t i) {
      return strength.data[static_cast<std::size_t>(i)] >= levels.seed;
    });
    if (sure && static_cast<double>(region.size()) >= least) continue;
    for (const std::int32_t i : region)
      ink.mask.data[static_cast<std::size_t>(i)] = 0,
      ink.coverage.data[static_cast<std::size_t>(i)] = 0;
  }
  const double least_hole = std::pow(kPinhole * ink.width, 2);
  for (const Region& region : RegionsOf(ink.mask, 0, Neighbours::kEdges)) {
    if (static_cast<double>(region.size()) >= least_hole) continue;
    for (const std::int32_t i : region)
      ink.mask.data[static_cast<std::size_t>(i)] = 1,
      ink.coverage.data[static_cast<std::size_t>(i)] = 1;
  }
  ClearEdge(ink.mask);
}

/// Twice the median half-width where the ink is thickest, along its middle.
double WidthOf(const Mask& mask, const Plane<std::int32_t>& squared) {
  std::vector<float> half_widths;
  for (int y = 1; y + 1 < mask.height; ++y)
    for (int x = 1; x + 1 < mask.width; ++x) {
      const std::int32_t here = squared(x, y);
      bool ridge = here > 0;
      for (int k = 0; ridge && k < 8; ++k) ridge = squared(x + kDx[k], y + kDy[k]) <= here;
      if (ridge) half_widths.push_back(static_cast<float>(HalfWidth(here)));
    }
  if (half_widths.empty()) return 0;
  // A line of an even number of pixels has its middle between two of them.
  return 2 * Quantile(std::move(half_widths), 0.5) + 0.5;
}

/// Lightness as a share of the page's own, which changes slowly.
Tone Flattened(const Tone& tone) {
  const int factor = std::max(1, std::max(tone.width, tone.height) / 128);
  const Tone coarse = Reduced(tone, factor);
  const Tone page = Blurred(Closed(coarse, std::max(coarse.width, coarse.height) / 6), 4);
  Tone flat(tone.width, tone.height);
  for (int y = 0; y < tone.height; ++y)
    for (int x = 0; x < tone.width; ++x)
      flat(x, y) = tone(x, y) / std::max(page(x / factor, y / factor), 0.05f);
  return flat;
}

/// Adds the rims of filled areas and takes out their insides. Returns their share of what is dark.
double AddFills(Ink& ink, const Tone& tone) {
  const Tone flat = Flattened(tone);
  std::vector<float> of_ink;
  for (std::size_t i = 0; i < flat.data.size(); ++i)
    if (ink.mask.data[i] && ink.coverage.data[i] > 0.9f) of_ink.push_back(flat.data[i]);
  const float darkness =
      of_ink.empty() ? Quantile(Sampled(flat), 0.02) : Quantile(std::move(of_ink), 0.5);
  const float limit = darkness + kAsDark * (1 - darkness);
  Mask dark(tone.width, tone.height);
  for (std::size_t i = 0; i < dark.data.size(); ++i)
    dark.data[i] = flat.data[i] < limit || ink.mask.data[i] ? 1 : 0;
  ClearEdge(dark);
  const Fills fills = FillsOf(dark, ink.width);
  if (fills.share <= 0) return 0;
  for (std::size_t i = 0; i < dark.data.size(); ++i) {
    if (!fills.area.data[i]) continue;
    ink.mask.data[i] = fills.interior.data[i] ? 0 : 1;
    ink.coverage.data[i] = ink.mask.data[i];
  }
  return fills.share;
}

}  // namespace

double ContrastOf(const Tone& lightness) {
  constexpr double kMost = 0.98;  // what few pixels have is dirt
  const double diagonal = std::hypot(lightness.width, lightness.height);
  const int radius = std::max(2, static_cast<int>(kWidest * diagonal));
  return static_cast<double>(Quantile(Sampled(StrengthOf(Blurred(lightness, 2), radius)), kMost));
}

Ink InkOfMask(Mask mask, Tone coverage) {
  Ink ink{std::move(mask), std::move(coverage), {}, 0};
  ClearEdge(ink.mask);
  ink.squared = SquaredDistances(ink.mask);
  ink.width = WidthOf(ink.mask, ink.squared);
  return ink;
}

std::optional<Ink> FindInk(const Tone& lightness, const FindInkOptions& options) {
  const double diagonal = std::hypot(lightness.width, lightness.height);
  const double guess = options.width.value_or(0.5 * kWidest * diagonal);
  const double grain = GrainOf(lightness);
  constexpr double kSmooth = 0.01;  // grain that does no harm
  const Tone tone =
      grain > kSmooth ? Blurred(lightness, std::clamp(0.25 * guess, 0.8, 3.0)) : lightness;
  const Tone strength = StrengthOf(tone, std::max(2, static_cast<int>(std::ceil(2 * guess))));
  const Levels levels = LevelsOf(strength);
  Ink ink;
  ink.coverage = CoverageOf(strength, levels, guess);
  ink.mask = MaskOf(ink.coverage);
  ink.squared = SquaredDistances(ink.mask);
  ink.width = WidthOf(ink.mask, ink.squared);
  CleanUp(ink, strength, levels);
  AddFills(ink, tone);
  ink.squared = SquaredDistances(ink.mask);
  ink.width = WidthOf(ink.mask, ink.squared);
  if (!(ink.width > 0)) return std::nullopt;
  return ink;
}

}  // namespace lascaux::trace
