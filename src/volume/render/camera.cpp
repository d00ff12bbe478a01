#include "volume/render/camera.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

namespace lascaux {
namespace {

constexpr float kDegree = 0.017453293F;

/// Field of view along the picture's shorter side: an 85 mm lens on small format film, which
/// flatters bodies.
constexpr float kFieldOfView = 18 * kDegree;
/// Share of the picture that the model takes in the direction that it fills.
constexpr float kFill = 0.8F;
/// The model's middle lies this share of the picture's height above its own: shadows need room
/// below.
constexpr float kRaise = 0.015F;

struct Angles {
  float azimuth, elevation;
};

/// Heads are high: 1 if the end towards +x is the higher one, else -1.
float HigherEnd(const std::vector<Eigen::Vector3f>& solid) {
  Eigen::Vector3f low = solid[0], high = solid[0];
  for (const Eigen::Vector3f& p : solid) low = low.cwiseMin(p), high = high.cwiseMax(p);
  const float middle = 0.5F * (low.x() + high.x());
  // Weighted by the cube of the height: legs say nothing, and a tail is thinner than a head.
  double balance = 0;
  for (const Eigen::Vector3f& p : solid) {
    const double height = p.y() - low.y();
    balance += height * height * height * (p.x() - middle);
  }
  return balance < 0 ? -1.F : 1.F;
}

/// 1 for a head on the right, -1 for one on the left.
float HeadEnd(const RenderOptions& options, const std::vector<Eigen::Vector3f>& solid) {
  switch (options.head) {
    case Head::kRight:
      return 1;
    case Head::kLeft:
      return -1;
    case Head::kHigher:
      break;
  }
  return HigherEnd(solid);
}

Angles AnglesOf(const RenderOptions& options, const std::vector<Eigen::Vector3f>& solid) {
  switch (options.view) {
    case View::kSide:
      return {0, 6 * kDegree};
    case View::kFront:
      return {HeadEnd(options, solid) * 90 * kDegree, 8 * kDegree};
    case View::kTop:
      return {0, 90 * kDegree};
    case View::kThreeQuarter:
      break;
  }
  return {HeadEnd(options, solid) * 38 * kDegree, 14 * kDegree};
}

/// Circles around all places that the points come to when they are turned about the vertical
/// through the middle of their box.
std::vector<Eigen::Vector3f> Swept(const std::vector<Eigen::Vector3f>& solid) {
  constexpr int kOnCircle = 32;
  Eigen::Vector3f low = solid[0], high = solid[0];
  for (const Eigen::Vector3f& p : solid) low = low.cwiseMin(p), high = high.cwiseMax(p);
  const Eigen::Vector3f middle = 0.5F * (low + high);
  std::map<float, float> radius_at;  // of a height
  for (const Eigen::Vector3f& p : solid) {
    float& radius = radius_at[p.y()];
    radius = std::max(radius, std::hypot(p.x() - middle.x(), p.z() - middle.z()));
  }
  std::vector<Eigen::Vector3f> swept;
  for (const auto& [height, radius] : radius_at) {
    for (int i = 0; i < kOnCircle; ++i) {
      const float angle = 360 * kDegree * static_cast<float>(i) / kOnCircle;
      swept.emplace_back(middle.x() + radius * std::cos(angle), height,
                         middle.z() + radius * std::sin(angle));
    }
  }
  return swept;
}

/// Smallest and largest tangents of the angles under which the points are seen.
struct Extent {
  Eigen::Array2f low = Eigen::Array2f::Constant(1e9F), high = Eigen::Array2f::Constant(-1e9F);
};

}  // namespace

Camera::Camera(const RenderOptions& options, const std::vector<Eigen::Vector3f>& solid)
    : half_width_(0.5F * static_cast<float>(options.width)),
      half_height_(0.5F * static_cast<float>(options.height)) {
  const Angles angles = AnglesOf(options, solid);
  const float azimuth = angles.azimuth + static_cast<float>(options.turn) * kDegree;
  const float c = std::cos(azimuth), s = std::sin(azimuth);
  const Eigen::Vector3f y(0, 1, 0);
  side_ = {c, 0, -s};
  front_ = {s, 0, c};
  right_ = side_;
  forward_ = -std::cos(angles.elevation) * front_ - std::sin(angles.elevation) * y;
  up_ = right_.cross(forward_);
  Aim(options.view, options.framing == Framing::kTurntable ? Swept(solid) : solid);
}

void Camera::Aim(View view, const std::vector<Eigen::Vector3f>& solid) {
  const float shorter = 2 * std::min(half_width_, half_height_);
  pixel_ = 2 * std::tan(0.5F * kFieldOfView) / shorter;
  const Eigen::Array2f half(pixel_ * half_width_, pixel_ * half_height_);
  Eigen::Vector3f center = Eigen::Vector3f::Zero();
  for (const Eigen::Vector3f& p : solid) center += p / static_cast<float>(solid.size());
  float radius = 0;
  for (const Eigen::Vector3f& p : solid) radius = std::max(radius, (p - center).norm());
  // Perspective makes the best place depend on itself; three rounds are exact to a pixel.
  float distance = 3 * radius / half.minCoeff();
  for (int round = 0; round < 4; ++round) {
    eye_ = center - distance * forward_;
    Extent seen;
    for (const Eigen::Vector3f& p : solid) {
      const Eigen::Vector3f d = p - eye_;
      const Eigen::Array2f tangent(d.dot(right_), d.dot(up_));
      seen.low = seen.low.min(tangent / d.dot(forward_));
      seen.high = seen.high.max(tangent / d.dot(forward_));
    }
    const Eigen::Array2f middle = 0.5F * (seen.low + seen.high);
    const float raise = view == View::kTop ? 0 : 2 * kRaise * half.y();
    center += distance * (middle.x() * right_ + (middle.y() - raise) * up_);
    distance *= (0.5F * (seen.high - seen.low) / (kFill * half)).maxCoeff();
    distance = std::max(distance, 1.05F * radius + 1);
  }
  eye_ = center - distance * forward_;
}

}  // namespace lascaux
