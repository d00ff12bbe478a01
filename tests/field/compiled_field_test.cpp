#include "lascaux/field/compiled_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <vector>

#include "support/cases.h"

namespace lascaux {
namespace {

using testing::ForSeeds;
using testing::Random;
using testing::RandomCreature;

std::vector<Isa> SupportedIsas() {
  std::vector<Isa> isas;
  for (Isa isa : {Isa::kBaseline, Isa::kAvx2, Isa::kAvx512}) {
    if (IsSupported(isa)) isas.push_back(isa);
  }
  return isas;
}

/// Points of a block, and room for what is found there.
struct Block {
  Eigen::Vector3d origin;
  std::vector<float> x, y, z, value, gx, gy, gz;

  Block(Random& random, const Eigen::AlignedBox3d& box, int count) : origin(random.InBox(box)) {
    const double reach = 0.1 * box.sizes().maxCoeff();
    for (int i = 0; i < count; ++i) {
      x.push_back(static_cast<float>(random.Uniform(-reach, reach)));
      y.push_back(static_cast<float>(random.Uniform(-reach, reach)));
      z.push_back(static_cast<float>(random.Uniform(-reach, reach)));
    }
    for (std::vector<float>* column : {&value, &gx, &gy, &gz}) column->resize(x.size());
  }
  Eigen::Vector3d Point(std::size_t i) const { return origin + Eigen::Vector3d(x[i], y[i], z[i]); }
  PointBlock points() const { return {origin, x, y, z}; }
  SampleBlock samples() { return {value, gx, gy, gz}; }
  Eigen::Vector3d Gradient(std::size_t i) const { return {gx[i], gy[i], gz[i]}; }
};

TEST(CompiledField, AgreesWithDoublePrecisionForEveryInstructionSet) {
  for (Isa isa : SupportedIsas()) {
    SCOPED_TRACE(Name(isa));
    double worst_value = 0, worst_gradient = 0;
    ForSeeds(60, [&](Random& random) {
      const Field field = RandomCreature(random);
      const CompiledField compiled(field, isa);
      Block block(random, compiled.bounds(), 300);
      const double thinnest = compiled.ThinnestRadius(compiled.All());
      compiled.EvaluateSamples(block.points(), compiled.All(), block.samples());
      for (std::size_t i = 0; i < block.x.size(); ++i) {
        const FieldSample exact = Evaluate(field, block.Point(i));
        const double scale = std::max(1.0, exact.value / 4);
        worst_value = std::max(worst_value, std::abs(block.value[i] - exact.value) / scale);
        worst_gradient = std::max(worst_gradient,
                                  (block.Gradient(i) - exact.gradient).norm() * thinnest / scale);
        ASSERT_LE(std::abs(block.value[i] - exact.value), kFloatValueError * scale) << exact.value;
      }
    });
    RecordProperty(std::string("value_error_") + Name(isa), std::to_string(worst_value));
    std::printf("%s value %.3g gradient %.3g\n", Name(isa), worst_value, worst_gradient);
  }
}

}  // namespace
}  // namespace lascaux
