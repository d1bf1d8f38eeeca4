#include "scan/artefacts.h"

#include "ostia/phantom/noise.h"
#include "ostia/phantom/stair_steps.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace ostia::phantom {
namespace {

using geometry::Vec3;

constexpr std::uint64_t stair_stream = 0x7374616972ULL, motion_stream = 0x6d6f74696f6eULL;

}  // namespace

double drawn_angle(const ScanOptions& options, std::uint64_t stream) {
  return 2.0 * std::numbers::pi * uniform(options.seed ^ stream, 0);
}

geometry::Vec3 stair_shift(const ScanOptions& options, std::int64_t slice) {
  if (options.stair_step_mm <= 0.0) return Vec3::Zero();
  const double height_mm = (static_cast<double>(slice) + 0.5) * options.grid.spacing.z();
  const auto block = static_cast<std::int64_t>(std::floor(height_mm / options.stair_block_mm));
  const double angle = drawn_angle(options, stair_stream);
  const double side = (block & 1) != 0 ? -0.5 : 0.5;
  return side * options.stair_step_mm *
         (options.grid.direction * Vec3(std::cos(angle), std::sin(angle), 0.0));
}

double motion_share(const ScanOptions& options, const Vec3& point_mm) {
  if (options.moving_radius_mm <= 0.0) return 1.0;
  const double part = (point_mm - options.moving_centre).norm() / options.moving_radius_mm;
  const double t = std::clamp(3.0 * (1.0 - part), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

Vec3 shown_at(const ScanOptions& options, const Vec3& place) {
  if (options.stair_step_mm <= 0.0) return place;
  const auto slice = static_cast<std::int64_t>(std::lround(options.grid.index(place).z()));
  return place + motion_share(options, place) * stair_shift(options, slice);
}

MotionBlur::MotionBlur(const ScanOptions& options) : options_(options) {
  if (options.motion_mm <= 0.0) return;
  const Vec3& spacing = options.grid.spacing;
  const double angle = drawn_angle(options, motion_stream);
  const int steps =
      2 * static_cast<int>(std::ceil(options.motion_mm / (0.25 * spacing.head<2>().minCoeff()))) + 1;
  std::map<std::pair<int, int>, double> weights;
  for (int n = 0; n < steps; ++n) {
    const double along = options.motion_mm * ((n + 0.5) / steps - 0.5);
    const double x = along * std::cos(angle) / spacing.x(), y = along * std::sin(angle) / spacing.y();
    const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
    for (int corner = 0; corner < 4; ++corner) {
      const int di = corner & 1, dj = corner >> 1;
      const double wx = di != 0 ? x - i : 1.0 - (x - i), wy = dj != 0 ? y - j : 1.0 - (y - j);
      weights[{i + di, j + dj}] += wx * wy / steps;
    }
  }
  for (const auto& [offset, weight] : weights)
    if (weight > 1e-6) taps_.push_back({offset.first, offset.second, static_cast<float>(weight)});
}

void MotionBlur::blur(const SliceView& slice, std::int64_t margin_i, std::int64_t margin_j,
                      std::int64_t k) const {
  if (none()) return;
  std::vector<float> from(static_cast<std::size_t>(slice.width * slice.height));
  for (std::ptrdiff_t j = 0; j < slice.height; ++j)
    std::copy_n(slice.row(j), slice.width, from.begin() + j * slice.width);
  for (std::ptrdiff_t j = 0; j < slice.height; ++j) {
    for (std::ptrdiff_t i = 0; i < slice.width; ++i) {
      const Vec3 at = options_.grid.world(
          Vec3(static_cast<double>(i - margin_i), static_cast<double>(j - margin_j), static_cast<double>(k)));
      const auto share = static_cast<float>(motion_share(options_, at));
      if (share <= 0.0f) continue;
      float sum = 0.0f;
      for (const Tap& tap : taps_) {
        const std::ptrdiff_t x = std::clamp<std::ptrdiff_t>(i + tap.di, 0, slice.width - 1),
                             y = std::clamp<std::ptrdiff_t>(j + tap.dj, 0, slice.height - 1);
        sum += tap.weight * from[static_cast<std::size_t>(x + y * slice.width)];
      }
      float& value = slice.row(j)[i];
      value += share * (sum - value);
    }
  }
}

}  // namespace ostia::phantom
