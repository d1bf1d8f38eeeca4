#include "ostia/analysis/wall_evidence.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/imaging/sampling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

namespace ostia::analysis {
namespace {

using geometry::Vec3;

constexpr double shut_mm = 0.1;
constexpr double profile_reach_mm = 1.5, grain_mm = 0.1;  // of a ray's profile about the wall, to either side
constexpr int samples = 31;
constexpr int sectors = 8;            // of a ring, for its sharpness
constexpr double sharpness_mm = 2.0;  // of vessel to either side that a sector's edge is averaged over
constexpr double least_profiles = 6;  // of a sector
constexpr double contrast_reach_mm = 5.0;
constexpr double tissue_hu = 50.0;                     // usual, of walls and muscle
constexpr double fall_share = 0.35, fall_noise = 1.5;  // of contrast and of noise, that a clear edge falls by
constexpr double calcium_hu = 150.0, calcium_noise = 3.0;  // above the lumen
constexpr float nowhere = std::numeric_limits<float>::quiet_NaN();

constexpr double offset_at(int k) {
  return -profile_reach_mm + k * grain_mm;
}

/// HU along one ray, from the lumen outwards; NaN on the other side of the axis.
using Profile = std::array<float, samples>;

struct Ring {
  std::vector<Profile> rays;
  std::vector<double> radius_mm;
  std::vector<char> calcium, clear;
  bool shut = false;
};

double middle_value(std::vector<double>& values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Mean of a ray between two offsets from the wall; NaN where the ray has nothing there.
double mean_between(const Profile& ray, double from_mm, double to_mm) {
  double sum = 0.0;
  int count = 0;
  for (int k = 0; k < samples; ++k) {
    const double d = offset_at(k);
    if (d < from_mm - 1e-9 || d > to_mm + 1e-9 || std::isnan(ray[static_cast<std::size_t>(k)])) continue;
    sum += ray[static_cast<std::size_t>(k)], ++count;
  }
  return count > 0 ? sum / count : std::numeric_limits<double>::quiet_NaN();
}

double inside_of(const Profile& ray, double lumen_hu) {
  const double mean = mean_between(ray, -0.8, -0.2);
  return std::isnan(mean) ? lumen_hu : mean;
}
double outside_of(const Profile& ray) {
  return mean_between(ray, 0.3, 1.1);
}

/// The brightest three tenths of a millimetre from just within the wall to behind it.
double brightest_behind(const Profile& ray) {
  double most = -std::numeric_limits<double>::infinity();
  for (double d = -0.3; d < 1.15; d += grain_mm) {
    const double mean = mean_between(ray, d, d + 2.0 * grain_mm);
    if (!std::isnan(mean)) most = std::max(most, mean);
  }
  return most;
}

class Evidence {
 public:
  Evidence(const imaging::ImageVolume& image, const geometry::AxisCurve& axis, const WallRadius& wall_mm,
           const WallEvidenceOptions& options)
      : image_(image), axis_(axis), wall_mm_(wall_mm), options_(options) {}

  std::vector<WallEvidence> of(double from_mm, double to_mm, const core::TaskContext& task) {
    const auto count = 1 + static_cast<std::size_t>(std::ceil((to_mm - from_mm) / options_.step_mm - 1e-9));
    step_mm_ = count > 1 ? (to_mm - from_mm) / static_cast<double>(count - 1) : options_.step_mm;
    found_.resize(count);
    rings_.resize(count);
    core::parallel_for(count, 8, [&](std::size_t i) {
      task.throw_if_cancelled();
      found_[i].s_mm = std::min(from_mm + static_cast<double>(i) * step_mm_, to_mm);
      look_at(found_[i], rings_[i]);
    });
    core::parallel_for(count, 8, [&](std::size_t i) { judge_edges(i); });
    core::parallel_for(count, 8, [&](std::size_t i) { found_[i].blur_mm = blur_at(i); });
    return std::move(found_);
  }

 private:
  double turn(int ray) const { return 2.0 * std::numbers::pi * ray / options_.around; }

  void look_at(WallEvidence& out, Ring& ring) const {
    double area = 0.0;
    for (int a = 0; a < options_.around; ++a) {
      const double radius = std::max(0.0, wall_mm_(out.s_mm, turn(a)));
      ring.radius_mm.push_back(radius);
      area += radius * radius / options_.around;
      if (!image_.geometry.contains(axis_.place(out.s_mm, turn(a), radius + profile_reach_mm)))
        out.in_image = false;
    }
    if (!out.in_image) return;
    out.calibre_mm = 2.0 * std::sqrt(area);
    ring.shut = 0.5 * out.calibre_mm <= shut_mm;
    std::vector<double> inner{imaging::sample(image_, axis_.point(out.s_mm))}, around;
    for (int a = 0; a < options_.around; ++a) {
      ring.rays.push_back(profile_of(out.s_mm, a, ring.radius_mm[static_cast<std::size_t>(a)], inner));
    }
    out.lumen_hu = middle_value(inner);
    const double bright = out.lumen_hu + std::max(calcium_hu, calcium_noise * options_.noise_hu);
    int calcified = 0;
    for (const Profile& ray : ring.rays) {
      ring.calcium.push_back(brightest_behind(ray) > bright ? 1 : 0);
      calcified += ring.calcium.back();
      if (!ring.calcium.back()) around.push_back(outside_of(ray));
    }
    out.calcium_share = static_cast<double>(calcified) / options_.around;
    if (!ring.shut && !around.empty()) out.contrast_hu = std::max(0.0, out.lumen_hu - middle_value(around));
  }

  /// The profile, and what of it is well within the lumen.
  Profile profile_of(double s_mm, int ray, double radius_mm, std::vector<double>& inner) const {
    Profile out;
    for (int k = 0; k < samples; ++k) {
      const double rho = radius_mm + offset_at(k);
      auto& value = out[static_cast<std::size_t>(k)];
      value = nowhere;
      if (rho < 0.0) continue;
      value = static_cast<float>(imaging::sample(image_, axis_.place(s_mm, turn(ray), rho)));
      if (rho <= 0.5 * radius_mm && k % 3 == 0) inner.push_back(value);
    }
    return out;
  }

  std::size_t rows_within(double mm) const {
    return static_cast<std::size_t>(std::max(1.0, std::round(mm / step_mm_)));
  }
  std::pair<std::size_t, std::size_t> about(std::size_t row, double mm) const {
    const std::size_t reach = rows_within(mm);
    return {row > reach ? row - reach : 0, std::min(found_.size(), row + reach + 1)};
  }

  /// A ray's edge is held against what the vessel's blood would show about there: a wall that is modelled
  /// within a bright mass has hardly any contrast of its own.
  void judge_edges(std::size_t row) {
    WallEvidence& out = found_[row];
    Ring& ring = rings_[row];
    ring.clear.assign(ring.rays.size(), 0);
    if (!out.in_image || ring.shut) return;
    std::vector<double> bloods;
    const auto [first, last] = about(row, contrast_reach_mm);
    for (std::size_t i = first; i < last; ++i)
      if (found_[i].in_image && !rings_[i].shut) bloods.push_back(found_[i].lumen_hu - tissue_hu);
    const double least = std::max(fall_share * middle_value(bloods), fall_noise * options_.noise_hu);
    int judged = 0, clear = 0;
    for (std::size_t a = 0; a < ring.rays.size(); ++a) {
      if (ring.calcium[a]) continue;
      ++judged;
      ring.clear[a] = inside_of(ring.rays[a], out.lumen_hu) - outside_of(ring.rays[a]) >= least ? 1 : 0;
      clear += ring.clear[a];
    }
    out.clear_share = judged > 0 ? static_cast<double>(clear) / judged : 0.0;
  }

  /// Mean profile of a sector's clear rays nearby; its steepest fall tells the blur.
  double sector_blur(std::size_t row, int sector) const {
    std::array<double, samples> sum{};
    std::array<int, samples> count{};
    double profiles = 0.0;
    const int wide = options_.around / sectors;
    const auto [first, last] = about(row, sharpness_mm);
    for (std::size_t i = first; i < last; ++i) {
      const Ring& ring = rings_[i];
      for (int n = 0; n < wide && !ring.clear.empty(); ++n) {
        const auto a = static_cast<std::size_t>(sector * wide + n);
        if (!ring.clear[a]) continue;
        profiles += 1.0;
        for (std::size_t k = 0; k < samples; ++k)
          if (!std::isnan(ring.rays[a][k])) sum[k] += ring.rays[a][k], ++count[k];
      }
    }
    if (profiles < least_profiles) return 0.0;
    double high = -std::numeric_limits<double>::infinity(), low = -high, steepest = 0.0;
    for (int k = 0; k + 2 < samples; ++k) {
      const auto i = static_cast<std::size_t>(k);
      if (count[i] < profiles / 2 || count[i + 2] < profiles / 2) continue;
      const double a = sum[i] / count[i], b = sum[i + 2] / count[i + 2];
      high = std::max(high, a), low = std::min(low, b);
      if (std::abs(offset_at(k + 1)) < 1.0) steepest = std::max(steepest, (a - b) / (2.0 * grain_mm));
    }
    if (!(steepest > 0.0) || !(high > low)) return 0.0;
    return (high - low) / (std::sqrt(2.0 * std::numbers::pi) * steepest);
  }

  double blur_at(std::size_t row) const {
    if (!found_[row].in_image || rings_[row].shut) return 0.0;
    std::vector<double> blurs;
    for (int sector = 0; sector < sectors; ++sector)
      if (const double blur = sector_blur(row, sector); blur > 0.0) blurs.push_back(blur);
    if (blurs.size() < sectors / 2) return 0.0;
    std::sort(blurs.begin(), blurs.end());
    return blurs[blurs.size() - 1 - blurs.size() / 4];
  }

  const imaging::ImageVolume& image_;
  const geometry::AxisCurve& axis_;
  const WallRadius& wall_mm_;
  WallEvidenceOptions options_;
  double step_mm_ = 0.0;
  std::vector<WallEvidence> found_;
  std::vector<Ring> rings_;
};

}  // namespace

void validate(const WallEvidenceOptions& options) {
  const auto require = [](bool fine, const char* what) {
    if (!fine) throw InvalidInput(std::string("evidence of a wall: ") + what);
  };
  require(options.step_mm >= 0.1 && options.step_mm <= 5.0, "step_mm has to be in [0.1, 5] mm");
  require(options.around >= 16 && options.around <= 128 && options.around % sectors == 0,
          "around has to be a multiple of 8 in [16, 128] rays");
  require(options.noise_hu >= 0.0 && options.noise_hu <= 500.0, "noise_hu has to be in [0, 500] HU");
}

std::vector<WallEvidence> wall_evidence(const imaging::ImageVolume& image, const geometry::AxisCurve& axis,
                                        const WallRadius& wall_mm, double from_mm, double to_mm,
                                        const WallEvidenceOptions& options, const core::TaskContext& task) {
  validate(options);
  if (!(from_mm >= -1e-6 && from_mm < to_mm && to_mm <= axis.length() + 1e-6))
    throw InvalidInput("evidence of a wall: from " + std::to_string(from_mm) + " to " +
                       std::to_string(to_mm) + " mm is no stretch of an axis of " +
                       std::to_string(axis.length()) + " mm");
  return Evidence(image, axis, wall_mm, options).of(from_mm, to_mm, task);
}

}  // namespace ostia::analysis
