#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "lascaux/field/field.h"

namespace lascaux {
namespace {

/// Collects findings about one field.
class Validator {
 public:
  Diagnostics Run(const Field& field) {
    CheckExponent("chain_exponent", field.chain_exponent);
    CheckExponent("part_exponent", field.part_exponent);
    if (field.gain) CheckGain(*field.gain);
    for (std::size_t i = 0; i < field.parts.size(); ++i) {
      place_ = "part " + std::to_string(i);
      CheckPart(field.parts[i], static_cast<int>(i));
    }
    return std::move(found_);
  }

 private:
  void Report(const std::string& what) {
    found_.push_back(
        Error(FailureKind::kBug, "bad-primitive",
              (place_.empty() ? "the field" : place_) + " " + what +
                  "; no field can be made of it: leave it out or give it a proper size"));
  }

  void CheckExponent(const std::string& name, double exponent) {
    constexpr double kMostExponent = 64;  // beyond it the blend is the maximum to every purpose
    if (!(exponent >= 1 && exponent <= kMostExponent)) {
      Report("has a " + name + " of " + std::to_string(exponent) + ", outside of 1 to 64");
    }
  }

  void CheckPart(const FieldPart& part, int index) {
    if (part.parent && (*part.parent < 0 || *part.parent >= index)) {
      Report("has the parent " + std::to_string(*part.parent) + ", which is not an earlier part");
    }
    if (!std::isfinite(part.z0)) Report("has a depth z0 that is not a number");
    if (!(std::isfinite(part.depth_scale) && part.depth_scale > 0)) {
      Report("has a depth_scale of " + std::to_string(part.depth_scale) + ", which is not above 0");
    }
    if (part.depth) CheckDepth(*part.depth);
    const std::string part_place = place_;
    for (std::size_t c = 0; c < part.chains.size(); ++c) {
      const std::string chain_place = part_place + ", chain " + std::to_string(c);
      const FieldChain& chain = part.chains[c];
      for (std::size_t k = 0; k < chain.segments.size(); ++k) {
        place_ = chain_place + ", segment " + std::to_string(k);
        CheckSegment(chain.segments[k]);
      }
      for (std::size_t k = 0; k < chain.points.size(); ++k) {
        place_ = chain_place + ", point " + std::to_string(k);
        CheckPoint(chain.points[k]);
      }
    }
  }

  /// Coefficients of a table over the plane; none when it has no proper size.
  template <typename Table>
  static std::optional<std::size_t> SizeOf(const Table& table) {
    const bool sized = table.columns > 0 && table.rows > 0 && std::isfinite(table.cell) &&
                       table.cell > 0 && table.origin.allFinite();
    if (!sized) return std::nullopt;
    return static_cast<std::size_t>(table.columns) * static_cast<std::size_t>(table.rows);
  }

  void CheckGain(const PlanarGain& gain) {
    constexpr float kMostLog = 32;  // a factor that single precision has room for beside the field
    if (SizeOf(gain) != gain.coefficients.size()) return Report("has a gain without a proper size");
    const auto fits = [](float x) { return std::abs(x) <= kMostLog; };
    if (!std::all_of(gain.coefficients.begin(), gain.coefficients.end(), fits)) {
      Report("has a gain whose logarithm is outside of -32 to 32");
    }
  }

  void CheckDepth(const DepthMap& map) {
    const std::optional<std::size_t> size = SizeOf(map);
    if (size != map.middle.size() || size != map.steepness.size()) {
      return Report("has a depth map without a proper size");
    }
    const auto finite = [](float x) { return std::isfinite(x); };
    const auto positive = [](float x) { return std::isfinite(x) && x > 0; };
    if (!std::all_of(map.middle.begin(), map.middle.end(), finite)) {
      Report("has a depth map whose middle is not a number");
    }
    if (!std::all_of(map.steepness.begin(), map.steepness.end(), positive)) {
      Report("has a depth map whose steepness is not above 0");
    }
  }

  void CheckSegment(const Segment& segment) {
    if (!segment.a.allFinite() || !segment.b.allFinite()) Report("has an end that is not a number");
    CheckRadius(segment.radius_a);
    CheckRadius(segment.radius_b);
    if (segment.radius_a == 0 && segment.radius_b == 0) Report("has radius 0 at both ends");
  }

  void CheckPoint(const PointPrimitive& point) {
    if (!point.center.allFinite()) Report("has a centre that is not a number");
    CheckRadius(point.radius);
    if (point.radius == 0) Report("has radius 0");
    if (!(std::isfinite(point.weight) && point.weight >= 0)) {
      Report("has a weight of " + std::to_string(point.weight));
    }
  }

  void CheckRadius(double radius) {
    if (!(std::isfinite(radius) && radius >= 0)) {
      Report("has a radius of " + std::to_string(radius));
    }
  }

  std::string place_;
  Diagnostics found_;
};

}  // namespace

Diagnostics Validate(const Field& field) { return Validator().Run(field); }

}  // namespace lascaux
