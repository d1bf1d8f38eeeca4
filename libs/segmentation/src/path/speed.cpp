#include "path/speed.h"

#include <algorithm>
#include <cmath>

namespace ostia::segmentation::detail {
namespace {

constexpr std::array<double, 3> kScalesMm{1.1, 1.9, 3.2};  // reach across tubes of 0.4 to 2.8 mm radius
constexpr double kUntubular = 0.15;  // quality of full contrast that is no tube at all, as a blood pool
constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

/// The middle eigenvalue of a symmetric matrix (O. K. Smith, Commun. ACM 4:168, 1961).
double middle_eigenvalue(double xx, double yy, double zz, double xy, double xz, double yz) {
  const double off = xy * xy + xz * xz + yz * yz;
  const double mean = (xx + yy + zz) / 3.0;
  const double dx = xx - mean, dy = yy - mean, dz = zz - mean;
  const double p = std::sqrt((dx * dx + dy * dy + dz * dz + 2.0 * off) / 6.0);
  if (p < 1e-12) return mean;
  const double determinant = dx * (dy * dz - yz * yz) - xy * (xy * dz - yz * xz) + xz * (xy * yz - dy * xz);
  const double r = std::clamp(determinant / (2.0 * p * p * p), -1.0, 1.0);
  // Angles phi, phi + 120 and phi + 240 degrees: the last is the middle one for phi in [0, 60] degrees.
  return mean + 2.0 * p * std::cos(std::acos(r) / 3.0 + 4.0 * M_PI / 3.0);
}

}  // namespace

double LumenLevels::contrast(double hu) const {
  const double width = lumen_hu - background_hu;
  if (hu > calcium_hu) return std::clamp(1.0 - (hu - calcium_hu) / width, 0.0, 1.0);
  return std::clamp((hu - background_hu) / width, 0.0, 1.0);
}

TubeSpeed::TubeSpeed(const imaging::ImageVolume& image, const LumenLevels& levels, double slowest)
    : image_(image),
      levels_(levels),
      slowest_(slowest),
      smooth_(image.geometry.size, kUnknown),
      quality_(image.geometry.size, kUnknown) {
  for (std::size_t s = 0; s < kScalesMm.size(); ++s) {
    for (int d = 0; d < 3; ++d) {
      steps_[s][static_cast<std::size_t>(d)] =
          std::max(1, static_cast<std::int32_t>(std::lround(kScalesMm[s] / image.geometry.spacing[d])));
    }
  }
}

float TubeSpeed::smooth(const Voxel& v) {
  float& kept = smooth_.at(v);
  if (!std::isnan(kept)) return kept;
  const auto& size = image_.geometry.size;
  std::array<std::array<std::int64_t, 3>, 3> at{};
  for (std::size_t d = 0; d < 3; ++d)
    for (std::int64_t n = -1; n <= 1; ++n)
      at[d][static_cast<std::size_t>(n + 1)] = std::clamp<std::int64_t>(v[d] + n, 0, size[d] - 1);
  int sum = 0;  // weights 1, 2, 1 along each axis: 64 in all
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t j = 0; j < 3; ++j) {
      const int row = image_(at[0][0], at[1][j], at[2][k]) + 2 * image_(at[0][1], at[1][j], at[2][k]) +
                      image_(at[0][2], at[1][j], at[2][k]);
      sum += row * ((k == 1 ? 2 : 1) * (j == 1 ? 2 : 1));
    }
  }
  return kept = static_cast<float>(sum) / 64.0F;
}

float TubeSpeed::smooth_clamped(Voxel v) {
  for (std::size_t d = 0; d < 3; ++d)
    v[d] = std::clamp(v[d], 0, static_cast<std::int32_t>(image_.geometry.size[d]) - 1);
  return smooth(v);
}

double TubeSpeed::smooth(const Vec3& world_mm) {
  const Vec3 index = image_.geometry.index(world_mm);
  Voxel low{};
  Vec3 part;
  for (int d = 0; d < 3; ++d) {
    const double last = static_cast<double>(image_.geometry.size[static_cast<std::size_t>(d)] - 1);
    const double x = std::clamp(index[d], 0.0, last);
    low[static_cast<std::size_t>(d)] = static_cast<std::int32_t>(x);
    part[d] = x - std::floor(x);
  }
  double value = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    Voxel v = low;
    double weight = 1.0;
    for (int d = 0; d < 3; ++d) {
      const int up = corner >> d & 1;
      v[static_cast<std::size_t>(d)] += up;
      weight *= up == 1 ? part[d] : 1.0 - part[d];
    }
    if (weight > 0.0) value += weight * static_cast<double>(smooth_clamped(v));
  }
  return value;
}

/// How much darker it is on both sides along the two directions that are darkest: from second differences
/// over the reach of each scale, in parts of the lumen's contrast; 1 in a tube that is no wider than the
/// reach, 0 in a plate, in a pool of blood and in tissue ([Frangi et al. 1998] take the same eigenvalues).
double TubeSpeed::tube(const Voxel& v) {
  const double centre = smooth(v);
  const double width = levels_.lumen_hu - levels_.background_hu;
  // Calcium near by must not stand for a wall of the tube, nor the tube for calcium's surroundings.
  const auto value = [&](int di, int dj, int dk) {
    const float s = smooth_clamped({v[0] + di, v[1] + dj, v[2] + dk});
    return std::clamp<double>(s, levels_.background_hu - 0.5 * width, levels_.calcium_hu);
  };
  const double middle = std::min(centre, levels_.calcium_hu);
  double best = 0.0;
  for (const auto& n : steps_) {
    const auto second = [&](int i, int j, int k) {
      return 0.5 * (value(i, j, k) + value(-i, -j, -k)) - middle;
    };
    const auto mixed = [&](int a, int b) {
      std::array<int, 3> p{}, m{};
      p[static_cast<std::size_t>(a)] = m[static_cast<std::size_t>(a)] = n[static_cast<std::size_t>(a)];
      p[static_cast<std::size_t>(b)] = n[static_cast<std::size_t>(b)];
      m[static_cast<std::size_t>(b)] = -n[static_cast<std::size_t>(b)];
      return 0.125 * (value(p[0], p[1], p[2]) + value(-p[0], -p[1], -p[2]) - value(m[0], m[1], m[2]) -
                      value(-m[0], -m[1], -m[2]));
    };
    const double xx = second(n[0], 0, 0), yy = second(0, n[1], 0), zz = second(0, 0, n[2]);
    const double lambda = middle_eigenvalue(xx, yy, zz, mixed(0, 1), mixed(0, 2), mixed(1, 2));
    best = std::max(best, -lambda / width);
    if (best >= 1.0) break;
  }
  return std::min(best, 1.0);
}

float TubeSpeed::quality(const Voxel& v) {
  if (const float kept = quality_.get(v); !std::isnan(kept)) return kept;
  const double contrast = levels_.contrast(smooth(v));
  double value = 0.0;
  if (contrast > 0.1) value = contrast * (kUntubular + (1.0 - kUntubular) * tube(v));
  return quality_.at(v) = static_cast<float>(value);
}

float TubeSpeed::speed(const Voxel& v) {
  const double q = quality(v);
  return static_cast<float>(slowest_ + (1.0 - slowest_) * q * q);
}

}  // namespace ostia::segmentation::detail
