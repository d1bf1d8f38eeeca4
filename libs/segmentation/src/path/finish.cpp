#include "path/finish.h"

#include "fronts/fast_marching.h"
#include "path/target.h"
#include "range_about_seeds.h"

#include "ostia/core/error.h"
#include "ostia/geometry/frame.h"
#include "ostia/geometry/polyline.h"
#include "ostia/geometry/spline.h"
#include "ostia/imaging/sampling.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ostia::segmentation::detail {
namespace {

constexpr double kAirAtEndHu = -500.0;
constexpr double kLeastEndContrast = 0.33;  // of the tree's, at the click
constexpr double kLeastFull = 0.5;          // a thin vessel's full contrast as a part of the tree's
constexpr double kLeastWidthHu = 60.0;      // between background and lumen
constexpr double kCalciumAbove = 0.5;       // of the contrast, above the lumen
constexpr double kCalciumNoise = 4.0;       // deviations of the noise by which a voxel of calcium is brighter
constexpr double kLeastNoiseHu = 16.0;      // no scan of the coronaries has less
constexpr double kGap = 0.35;               // contrast below which the way is out of the lumen
constexpr double kGapMm = 1.0;              // shorter ones are not worth a word
constexpr double kFallbackRadiusMm = 0.6;
constexpr double kRadiusSmoothingMm3 = 1.0;

/// Median and robust standard deviation.
struct Spread {
  double median = 0.0, sigma = 0.0;
};
Spread spread(std::vector<double> values) {
  const auto middle = [](std::vector<double>& v) {
    const auto at = v.begin() + static_cast<std::ptrdiff_t>(v.size() / 2);
    std::nth_element(v.begin(), at, v.end());
    return *at;
  };
  Spread result;
  result.median = middle(values);
  for (double& value : values) value = std::abs(value - result.median);
  result.sigma = 1.4826 * middle(values);
  return result;
}

/// Fills radii that were not found from their neighbours, and smooths them.
std::vector<double> completed_radii(const std::vector<double>& s, std::vector<double> radius, bool& unknown) {
  std::vector<double> at, found;
  for (std::size_t i = 0; i < radius.size(); ++i) {
    if (radius[i] <= 0.0) continue;
    at.push_back(s[i]);
    found.push_back(radius[i]);
  }
  unknown = found.empty();
  if (unknown) return std::vector<double>(radius.size(), kFallbackRadiusMm);
  for (std::size_t i = 0; i < radius.size(); ++i) {
    if (radius[i] > 0.0) continue;
    const auto after = std::lower_bound(at.begin(), at.end(), s[i]) - at.begin();
    const auto n = static_cast<std::size_t>(after);
    if (n == 0) {
      radius[i] = found.front();
    } else if (n == at.size()) {
      radius[i] = found.back();
    } else {
      const double t = (s[i] - at[n - 1]) / (at[n] - at[n - 1]);
      radius[i] = found[n - 1] + t * (found[n] - found[n - 1]);
    }
  }
  if (radius.size() < 4) return radius;
  // A single ray fan that went astray at a side branch must not be seen.
  std::vector<double> calm = radius;
  for (std::size_t i = 2; i + 2 < radius.size(); ++i) {
    std::array<double, 5> five{};
    std::copy_n(radius.begin() + static_cast<std::ptrdiff_t>(i - 2), 5, five.begin());
    std::nth_element(five.begin(), five.begin() + 2, five.end());
    calm[i] = five[2];
  }
  const double step = s[1] - s[0];
  std::vector<double> smooth = geometry::smoothing_spline(s, calm, std::vector<double>(s.size(), 1.0),
                                                          kRadiusSmoothingMm3 / step, false);
  const auto [least, most] = std::minmax_element(calm.begin(), calm.end());
  for (double& r : smooth) r = std::clamp(r, *least, *most);
  return smooth;
}

/// "the way leaves the contrast for 4.0 mm, 12.5 mm from its start" for each stretch that is so.
template <class Flag>
void tell_stretches(const std::vector<double>& s, const Flag& flag, const char* what,
                    std::vector<std::string>& warnings) {
  for (std::size_t i = 0; i < s.size();) {
    if (!flag(i)) {
      ++i;
      continue;
    }
    std::size_t last = i;
    while (last + 1 < s.size() && flag(last + 1)) ++last;
    const double length = s[last] - s[i] + (s[1] - s[0]);
    if (length >= kGapMm)
      warnings.push_back(worded("%s for %.1f mm, %.1f mm from its start", what, length, s[i]));
    i = last + 1;
  }
}

}  // namespace

void require_inside(const imaging::ImageVolume& image, const Vec3& place, const std::string& what) {
  const auto& size = image.geometry.size;
  if (image.voxels.empty()) throw InvalidInput("minimal path: the image is empty");
  if (place.allFinite() && image.geometry.contains(place)) return;
  const Vec3 last(static_cast<double>(size[0] - 1), static_cast<double>(size[1] - 1),
                  static_cast<double>(size[2] - 1));
  throw InvalidInput(what + " " + text(place) + " mm lies outside the image, which spans " +
                     text(image.geometry.world(Vec3::Zero())) + " to " + text(image.geometry.world(last)) +
                     " mm (LPS): choose a place inside it");
}

LumenLevels levels_from(const imaging::ImageVolume& image, const std::vector<Vec3>& lumen_places,
                        const std::vector<Vec3>& around) {
  TubeSpeed plain(image, {1.0, 0.0, 1e9}, 0.5);
  std::vector<double> values, voxels;
  for (const Vec3& p : lumen_places) {
    values.push_back(plain.smooth(p));
    voxels.push_back(imaging::sample(image, p, imaging::Interpolation::trilinear));
  }
  const Spread lumen = spread(std::move(values));
  LumenLevels levels;
  levels.lumen_hu = lumen.median;
  levels.background_hu = background_hu(image, around, lumen.median);
  levels.background_hu = std::min(levels.background_hu, lumen.median - kLeastWidthHu);
  const double width = levels.lumen_hu - levels.background_hu;
  levels.calcium_hu = lumen.median + std::max(3.0 * lumen.sigma, kCalciumAbove * width);
  levels.calcium_margin_hu = kCalciumNoise * std::max(kLeastNoiseHu, spread(std::move(voxels)).sigma);
  levels.calcium_voxel_hu = lumen.median + levels.calcium_margin_hu;
  return levels;
}

LumenLevels calcium_above(const LumenLevels& levels, const imaging::ImageVolume& image,
                          const std::vector<Vec3>& axes) {
  TubeSpeed plain(image, {1.0, 0.0, 1e9}, 0.5);
  std::vector<double> values;
  for (const Vec3& p : axes) values.push_back(plain.smooth(p));
  const auto quartile = values.begin() + static_cast<std::ptrdiff_t>(values.size() * 3 / 4);
  std::nth_element(values.begin(), quartile, values.end());
  const double brighter = std::max(0.0, *quartile - levels.lumen_hu);
  LumenLevels result = levels;
  result.calcium_hu += brighter;
  result.calcium_voxel_hu += brighter;
  return result;
}

BrightVoxel brightest_about(TubeSpeed& image, const Vec3& place) {
  const imaging::Geometry& g = image.image().geometry;
  const Voxel centre = nearest_voxel(g, place);
  BrightVoxel best{-1e9, place};
  for (int n = 0; n < 27; ++n) {
    const Voxel v{centre[0] + n % 3 - 1, centre[1] + n / 3 % 3 - 1, centre[2] + n / 9 - 1};
    if (!inside(g.size, v) || image.smooth(v) <= best.hu) continue;
    best = {image.smooth(v), g.world(Vec3(v[0], v[1], v[2]))};
  }
  return best;
}

LumenLevels dimmed(const LumenLevels& levels, double click_hu) {
  LumenLevels result = levels;
  const double width = levels.lumen_hu - levels.background_hu;
  const double part = std::clamp((click_hu - levels.background_hu) / width, kLeastFull, 1.0);
  result.lumen_hu = levels.background_hu + part * width;
  return result;
}

Vec3 snapped(TubeSpeed& speed, const Vec3& click, double snap_voxels, std::vector<std::string>& warnings) {
  const imaging::Geometry& g = speed.image().geometry;
  const double reach = snap_voxels * g.spacing.maxCoeff();
  const Voxel centre = nearest_voxel(g, click);
  const double here = speed.quality(centre);
  const Vec3 steps = (Vec3::Constant(reach).cwiseQuotient(g.spacing)).array().ceil();
  Voxel best = centre;
  double best_score = here, best_quality = here;
  for (int k = -static_cast<int>(steps[2]); k <= static_cast<int>(steps[2]); ++k) {
    for (int j = -static_cast<int>(steps[1]); j <= static_cast<int>(steps[1]); ++j) {
      for (int i = -static_cast<int>(steps[0]); i <= static_cast<int>(steps[0]); ++i) {
        const Voxel v{centre[0] + i, centre[1] + j, centre[2] + k};
        if (!inside(g.size, v)) continue;
        const double distance = (g.world(Vec3(v[0], v[1], v[2])) - click).norm();
        if (distance > reach) continue;
        const double quality = speed.quality(v);
        const double score = quality - 0.1 * distance / std::max(reach, 1e-9);
        if (score <= best_score) continue;
        best_score = score;
        best_quality = quality;
        best = v;
      }
    }
  }
  const double hu = speed.smooth(best);
  if (speed.levels().contrast(hu) < kLeastEndContrast) {
    const double at_click = speed.smooth(centre);
    if (at_click < kAirAtEndHu) {
      throw InvalidInput("the click " + text(click) + worded(" mm lies in air (%.0f HU)", at_click) +
                         ": click in the contrast-filled lumen");
    }
    throw InvalidInput("no contrast-filled vessel within " + worded("%.1f", reach) + " mm of the click " +
                       text(click) +
                       worded(" mm: %.0f HU at most, while the lumen near by has %.0f HU and the tissue "
                              "%.0f HU; zoom in and click in the lumen",
                              hu, speed.levels().lumen_hu, speed.levels().background_hu));
  }
  if (here >= 0.5 * best_quality) return click;
  const Vec3 place = g.world(Vec3(best[0], best[1], best[2]));
  warnings.push_back(worded("the click was moved by %.1f mm onto the lumen", (place - click).norm()));
  return place;
}

// The rays see the scanner's blur, the voxel's own box and the binomial mean, whose variances add up.
RayOptions rays_for(const TubeSpeed& speed, const MinimalPathOptions& options) {
  const double voxel = speed.image().geometry.spacing.squaredNorm() / 3.0;
  return {options.largest_radius_mm,
          std::sqrt(options.blur_sigma_mm * options.blur_sigma_mm + voxel * (1.0 / 12.0 + 0.5)),
          options.wall_hu};
}

double middle_radius(TubeSpeed& speed, const std::vector<Vec3>& line, const MinimalPathOptions& options) {
  const std::vector<Vec3> tangents = geometry::tangents(line);
  std::vector<double> radii;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const double r = look_across(speed, line[i], tangents[i], rays_for(speed, options)).seen_radius_mm;
    if (r > 0.0) radii.push_back(r);
  }
  return radii.empty() ? kFallbackRadiusMm : spread(std::move(radii)).median;
}

void finish(MinimalPath& path, TubeSpeed& speed, const std::vector<Vec3>& rough, const FixedEnds& fixed,
            const MinimalPathOptions& options) {
  const std::vector<Vec3> centred = centred_line(speed, rough, kLineStepMm, fixed, rays_for(speed, options));
  path.points = geometry::resample(centred, options.step_mm);
  const std::vector<Vec3> tangents = geometry::tangents(path.points);
  const std::vector<double> s = geometry::abscissas(path.points);
  const std::vector<double> lumen = lumen_along(speed, path.points);
  RayOptions rays = rays_for(speed, options);
  path.length_mm = s.back();
  const auto measured = [&](std::size_t i) {
    return s[i] >= fixed.start_mm && s[i] <= s.back() - fixed.end_mm;
  };
  std::vector<double> radius(s.size(), 0.0);
  std::vector<bool> calcium(s.size(), false);
  path.contrast.assign(s.size(), 0.0F);
  path.near_calcium.assign(s.size(), 0);
  double sum = 0.0;
  std::size_t counted = 0;
  for (std::size_t i = 0; i < s.size(); ++i) {
    rays.lumen_hu = lumen[i];
    const PathSection section = look_across(speed, path.points[i], tangents[i], rays);
    path.contrast[i] = static_cast<float>(section.contrast);
    if (!measured(i)) continue;
    radius[i] = section.contrast >= kGap ? section.radius_mm : 0.0;
    calcium[i] = section.calcium;
    path.near_calcium[i] = section.near_calcium ? 1 : 0;
    sum += section.contrast * section.edges;
    ++counted;
  }
  path.evidence = counted > 0 ? std::clamp(sum / static_cast<double>(counted), 0.0, 1.0) : 0.0;
  bool unknown = false;
  path.radius_mm = completed_radii(s, std::move(radius), unknown);
  if (unknown)
    path.warnings.push_back(worded("no edge was found along the way: radii are %.1f mm", kFallbackRadiusMm));
  const auto out = [&](std::size_t i) { return measured(i) && path.contrast[i] < kGap && !calcium[i]; };
  tell_stretches(s, out, "the way leaves the contrast", path.warnings);
  tell_stretches(
      s, [&](std::size_t i) { return calcium[i]; }, "the way runs through calcium", path.warnings);
}

void join_and_finish(MinimalPath& path, TubeSpeed& speed, const PathTarget& target, const Voxel& reached,
                     const std::vector<Vec3>& way, double fixed_end_mm, const MinimalPathOptions& options,
                     const std::string& what) {
  const auto joined = [](const PathTarget::Joint& joint, const std::vector<Vec3>& line) {
    std::vector<Vec3> result{joint.junction.point};
    result.insert(result.end(), line.begin() + static_cast<std::ptrdiff_t>(joint.first_free), line.end());
    return result;
  };
  // The straight piece from the parent's axis; never nothing, for then the junction would be moved.
  const auto straight = [&](const std::vector<Vec3>& line) {
    return FixedEnds{std::max(1e-6, (line[1] - line[0]).norm()), fixed_end_mm};
  };
  std::vector<Vec3> line = joined(target.entry(reached, way), way);
  if (line.size() < 2 || geometry::length(line) < 2.0 * kLineStepMm) {
    throw InvalidInput(what + " lies on the wall of a vessel that is in the tree already: click further out");
  }
  line = centred_line(speed, line, kLineStepMm, straight(line), rays_for(speed, options));
  const PathTarget::Joint joint = target.rejoined(reached, line, middle_radius(speed, line, options));
  path.junction = joint.junction;
  line = joined(joint, line);
  finish(path, speed, line, straight(line), options);
}

}  // namespace ostia::segmentation::detail
