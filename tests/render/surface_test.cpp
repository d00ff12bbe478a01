#include "volume/render/surface.h"

#include <gtest/gtest.h>
#include <openvdb/tools/LevelSetSphere.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <vector>

#include "volume/render/distance_transform.h"
#include "volume/render/grid_leaves.h"

namespace lascaux {
namespace {

constexpr float kRadius = 40;  // voxels, around index (10, -20, 30)
const Eigen::Vector3f kCenter(10, -20, 30);

openvdb::FloatGrid::Ptr Sphere() {
  openvdb::initialize();
  return openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(
      kRadius / 2, openvdb::Vec3f(kCenter.x() / 2, kCenter.y() / 2, kCenter.z() / 2), 0.5F);
}

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  float Uniform(float low, float high) {
    return std::uniform_real_distribution<float>(low, high)(engine_);
  }
  Eigen::Vector3f Direction() {
    for (;;) {
      const Eigen::Vector3f v(Uniform(-1, 1), Uniform(-1, 1), Uniform(-1, 1));
      if (v.norm() > 0.1F && v.norm() < 1) return v.normalized();
    }
  }

 private:
  std::mt19937 engine_;
};

std::optional<float> HitAlone(const Surface& surface, const Ray& ray) {
  Rays rays;
  rays.Add(ray, 0);
  const float t = surface.Hit(rays).front();
  return std::isinf(t) ? std::nullopt : std::optional(t);
}

TEST(SpreadSeeds, FindsTheNearestSeedOfEveryNode) {
  const std::array<int, 3> size = {7, 9, 5};
  for (unsigned seed = 0; seed < 50; ++seed) {
    Random random(seed);
    NearestSeeds seeds{std::vector<float>(315, kNoSeed), std::vector<float>(315, 0)};
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < 315; ++i) {
      if (random.Uniform(0, 1) > 0.02F) continue;
      seeds.squared_distance[i] = 0;
      seeds.value[i] = static_cast<float>(i);
      places.push_back(i);
    }
    const auto place = [&](std::size_t i) {
      return Eigen::Vector3i(static_cast<int>(i % 7), static_cast<int>(i / 7 % 9),
                             static_cast<int>(i / 63));
    };
    const NearestSeeds found = SpreadSeeds(seeds, size);
    for (std::size_t i = 0; i < 315; ++i) {
      int nearest = 1 << 20;
      for (const std::size_t p : places) {
        nearest = std::min(nearest, (place(i) - place(p)).squaredNorm());
      }
      if (places.empty()) {
        EXPECT_EQ(found.squared_distance[i], kNoSeed) << seed;
        continue;
      }
      EXPECT_EQ(found.squared_distance[i], static_cast<float>(nearest)) << seed;
      const auto winner = static_cast<std::size_t>(found.value[i]);
      EXPECT_EQ((place(i) - place(winner)).squaredNorm(), nearest) << seed;
    }
  }
}

TEST(CoarseField, IsTheDistanceInItsBoxAndNotMoreOutside) {
  const auto grid = Sphere();
  const LeafTable leaves = LeavesOf(*grid);
  const CoarseField coarse(leaves, 30);
  EXPECT_EQ(coarse.stride(), 3);
  EXPECT_NEAR(coarse.ground(), kCenter.y() - kRadius, 0.5);
  Random random(1);
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3f p = kCenter + random.Uniform(kRadius, 60) * random.Direction();
    const float distance = (p - kCenter).norm() - kRadius;
    const bool in_box =
        (p.array() >= coarse.low().array()).all() && (p.array() <= coarse.high().array()).all();
    EXPECT_LE(coarse.At(p), distance + 0.8F * coarse.stride());
    if (in_box) {
      EXPECT_GE(coarse.At(p), distance - 0.8F * coarse.stride());
    }
  }
}

TEST(Surface, RaysMeetASphereWhereItIs) {
  const auto grid = Sphere();
  const LeafTable leaves = LeavesOf(*grid);
  const CoarseField coarse(leaves, 30);
  const Surface surface(leaves, coarse);
  Random random(2);
  int hits = 0;
  for (int i = 0; i < 3000; ++i) {
    const Eigen::Vector3f eye = kCenter + 200 * random.Direction();
    const Eigen::Vector3f target = kCenter + random.Uniform(0, 60) * random.Direction();
    const Ray ray{eye, (target - eye).normalized()};
    const float along = (kCenter - eye).dot(ray.direction);
    const float miss = (eye + along * ray.direction - kCenter).norm();
    const auto t = HitAlone(surface, ray);
    if (miss > kRadius + 0.1F) {
      EXPECT_FALSE(t) << i;
    }
    if (miss > kRadius - 0.5F) continue;
    ASSERT_TRUE(t) << i;
    ++hits;
    EXPECT_NEAR((ray.At(*t) - kCenter).norm(), kRadius, 0.05) << i;
    const Eigen::Vector3f normal = (ray.At(*t) - kCenter).normalized();
    EXPECT_LT((surface.Normal(ray.At(*t)) - normal).norm(), 0.01) << i;
  }
  EXPECT_GT(hits, 1000);
}

TEST(Surface, RaysAroundAFreeLengthMeetNothingWithinIt) {
  const auto grid = Sphere();
  const LeafTable leaves = LeavesOf(*grid);
  const CoarseField coarse(leaves, 30);
  const Surface surface(leaves, coarse);
  Random random(3);
  for (int i = 0; i < 3000; ++i) {
    const Eigen::Vector3f eye = kCenter + 200 * random.Direction();
    const Eigen::Vector3f target = kCenter + random.Uniform(0, 70) * random.Direction();
    const Ray middle{eye, (target - eye).normalized()};
    constexpr float kSpread = 0.02F;
    const float free = surface.FreeLength(middle, kSpread, 0);
    const float narrow = surface.FreeLength(middle, 0.5F * kSpread, std::min(free, 1e9F));
    EXPECT_GE(narrow, free) << i;
    const Eigen::Vector3f aside = middle.direction.cross(random.Direction()).normalized();
    const Ray ray{eye, (middle.direction + kSpread * aside).normalized()};
    const auto t = HitAlone(surface, ray);
    if (t) {
      EXPECT_GE(*t, free) << i;
    }
    if (free < 1e9F) {
      EXPECT_GT(free, 100) << i;  // it is worth its cost
    }
  }
}

TEST(Surface, RaysDoNotDependOnWhoGoesWithThem) {
  const auto grid = Sphere();
  const LeafTable leaves = LeavesOf(*grid);
  const CoarseField coarse(leaves, 30);
  const Surface surface(leaves, coarse);
  Random random(5);
  const Eigen::Vector3f eye = kCenter + Eigen::Vector3f(20, 150, -60);
  for (std::size_t count : {0, 1, 7, 8, 9, 100}) {
    Rays rays;
    for (std::size_t i = 0; i < count; ++i) {
      const Eigen::Vector3f target = kCenter + 45 * random.Direction();
      rays.Add({eye, (target - eye).normalized()}, random.Uniform(0, 40));
    }
    const std::vector<float> hits = surface.Hit(rays);
    ASSERT_EQ(hits.size(), count);
    for (std::size_t i = 0; i < count; ++i) {
      Rays one;
      one.Add({eye, {rays.x[i], rays.y[i], rays.z[i]}}, rays.from[i]);
      EXPECT_EQ(hits[i], surface.Hit(one).front()) << i << " of " << count;
    }
  }
}

}  // namespace
}  // namespace lascaux
