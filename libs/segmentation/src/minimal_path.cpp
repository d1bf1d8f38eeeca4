#include "ostia/segmentation/minimal_path.h"

#include "fast_marching.h"
#include "intensity_range.h"
#include "path_front.h"
#include "path_line.h"
#include "path_target.h"

#include "ostia/core/error.h"
#include "ostia/geometry/frame.h"
#include "ostia/geometry/polyline.h"
#include "ostia/geometry/spline.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

namespace ostia::segmentation {
namespace {

using detail::LumenLevels;
using detail::TubeSpeed;
using detail::Voxel;

constexpr double kNearMm = 25.0;  // of the tree: its lumen there is like the new vessel's
constexpr std::size_t kFewestPlaces = 40;
constexpr double kAirHu = -500.0;
constexpr double kLeastContrast = 0.33;  // of the tree's, at the click
constexpr double kLeastFull = 0.5;       // a thin vessel's full contrast as a part of the tree's
constexpr double kLeastWidthHu = 60.0;   // between background and lumen
constexpr double kCalciumAbove = 0.5;    // of the contrast, above the lumen
constexpr double kGap = 0.35;            // contrast below which the way is out of the lumen
constexpr double kGapMm = 1.0;           // shorter ones are not worth a word
constexpr double kLineStepMm = 0.5;      // while it is centred
constexpr double kFallbackRadiusMm = 0.6;
constexpr double kRadiusSmoothingMm3 = 1.0;

template <class... Values>
std::string worded(const char* format, Values... values) {
  char buffer[256];
  std::snprintf(buffer, sizeof buffer, format, values...);
  return buffer;
}

void check(bool good, const char* name, double value, const char* allowed) {
  if (!good) throw InvalidInput(worded("minimal path: %s is %g; it must be in %s", name, value, allowed));
}

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

void require_inside(const imaging::ImageVolume& image, const Vec3& click) {
  const auto& size = image.geometry.size;
  if (image.voxels.empty()) throw InvalidInput("minimal path: the image is empty");
  if (click.allFinite() && image.geometry.contains(click)) return;
  const Vec3 last(static_cast<double>(size[0] - 1), static_cast<double>(size[1] - 1),
                  static_cast<double>(size[2] - 1));
  throw InvalidInput("the click " + detail::text(click) + " mm lies outside the image, which spans " +
                     detail::text(image.geometry.world(Vec3::Zero())) + " to " +
                     detail::text(image.geometry.world(last)) + " mm (LPS): click inside it");
}

LumenLevels levels_from(const imaging::ImageVolume& image, const std::vector<Vec3>& lumen_places,
                        const std::vector<Vec3>& clicks) {
  TubeSpeed plain(image, {1.0, 0.0, 1e9}, 0.5);
  std::vector<double> values;
  for (const Vec3& p : lumen_places) values.push_back(plain.smooth(p));
  const Spread lumen = spread(std::move(values));
  LumenLevels levels;
  levels.lumen_hu = lumen.median;
  levels.background_hu = detail::background_hu(image, clicks, lumen.median);
  levels.background_hu = std::min(levels.background_hu, lumen.median - kLeastWidthHu);
  const double width = levels.lumen_hu - levels.background_hu;
  levels.calcium_hu = lumen.median + std::max(3.0 * lumen.sigma, kCalciumAbove * width);
  return levels;
}

/// The click, or the best place within reach where it lies beside the lumen.
Vec3 snapped(TubeSpeed& speed, const Vec3& click, double snap_voxels, std::vector<std::string>& warnings) {
  const imaging::Geometry& g = speed.image().geometry;
  const double reach = snap_voxels * g.spacing.maxCoeff();
  const Voxel centre = detail::nearest_voxel(g, click);
  const double here = speed.quality(centre);
  const Vec3 steps = (Vec3::Constant(reach).cwiseQuotient(g.spacing)).array().ceil();
  Voxel best = centre;
  double best_score = here, best_quality = here;
  for (int k = -static_cast<int>(steps[2]); k <= static_cast<int>(steps[2]); ++k) {
    for (int j = -static_cast<int>(steps[1]); j <= static_cast<int>(steps[1]); ++j) {
      for (int i = -static_cast<int>(steps[0]); i <= static_cast<int>(steps[0]); ++i) {
        const Voxel v{centre[0] + i, centre[1] + j, centre[2] + k};
        if (!detail::inside(g.size, v)) continue;
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
  if (speed.levels().contrast(hu) < kLeastContrast) {
    const double at_click = speed.smooth(centre);
    if (at_click < kAirHu) {
      throw InvalidInput("the click " + detail::text(click) + worded(" mm lies in air (%.0f HU)", at_click) +
                         ": click in the contrast-filled lumen");
    }
    throw InvalidInput("no contrast-filled vessel within " + worded("%.1f", reach) + " mm of the click " +
                       detail::text(click) +
                       worded(" mm: %.0f HU at most, while the lumen near by has %.0f HU and the tissue "
                              "%.0f HU; zoom in and click in the lumen",
                              hu, speed.levels().lumen_hu, speed.levels().background_hu));
  }
  if (here >= 0.5 * best_quality) return click;
  const Vec3 place = g.world(Vec3(best[0], best[1], best[2]));
  warnings.push_back(worded("the click was moved by %.1f mm onto the lumen", (place - click).norm()));
  return place;
}

/// Full contrast for a vessel as dim as the one that was clicked.
LumenLevels dimmed(const LumenLevels& levels, double click_hu) {
  LumenLevels result = levels;
  const double width = levels.lumen_hu - levels.background_hu;
  const double part = std::clamp((click_hu - levels.background_hu) / width, kLeastFull, 1.0);
  result.lumen_hu = levels.background_hu + part * width;
  return result;
}

[[noreturn]] void unreached(const detail::PathFront& front, const Vec3& click, const char* what,
                            const MinimalPathOptions& options) {
  const std::string text = std::string("no way from ") + detail::text(click) + " mm to " + what + ": ";
  switch (front.end) {
    case detail::PathFrontEnd::length:
      throw GeometryError(text + worded("the front has run %.0f mm (max_length_mm); click nearer to it, or "
                                        "set points between",
                                        options.max_length_mm));
    case detail::PathFrontEnd::voxels:
      throw GeometryError(text + worded("the front has spread over %lld voxels (most_voxels) without "
                                        "following a vessel; click in the lumen of one",
                                        static_cast<long long>(options.most_voxels)));
    default:
      throw GeometryError(text + "the front has covered the image");
  }
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

/// The rays see the scanner's blur, the voxel's own box and the binomial mean, whose variances add up.
detail::RayOptions rays_for(const TubeSpeed& speed, const MinimalPathOptions& options) {
  const double voxel = speed.image().geometry.spacing.squaredNorm() / 3.0;
  return {options.largest_radius_mm,
          std::sqrt(options.blur_sigma_mm * options.blur_sigma_mm + voxel * (1.0 / 12.0 + 0.5)),
          options.wall_hu};
}

/// Median of the radii along a line as the image shows them.
double middle_radius(TubeSpeed& speed, const std::vector<Vec3>& line, const MinimalPathOptions& options) {
  const std::vector<Vec3> tangents = geometry::tangents(line);
  std::vector<double> radii;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const double r =
        detail::look_across(speed, line[i], tangents[i], rays_for(speed, options)).seen_radius_mm;
    if (r > 0.0) radii.push_back(r);
  }
  return radii.empty() ? kFallbackRadiusMm : spread(std::move(radii)).median;
}

/// Centres the line and measures along it; what lies before `fixed_mm` belongs to the parent's lumen.
void finish(MinimalPath& path, TubeSpeed& speed, const std::vector<Vec3>& rough, double fixed_mm,
            const MinimalPathOptions& options) {
  const std::vector<Vec3> centred =
      detail::centred_line(speed, rough, kLineStepMm, fixed_mm, !path.junction, rays_for(speed, options));
  path.points = geometry::resample(centred, options.step_mm);
  const std::vector<Vec3> tangents = geometry::tangents(path.points);
  const std::vector<double> s = geometry::abscissas(path.points);
  path.length_mm = s.back();
  std::vector<double> radius(s.size(), 0.0);
  std::vector<bool> calcium(s.size(), false);
  path.contrast.assign(s.size(), 0.0F);
  double sum = 0.0;
  std::size_t counted = 0;
  for (std::size_t i = 0; i < s.size(); ++i) {
    const detail::PathSection section =
        detail::look_across(speed, path.points[i], tangents[i], rays_for(speed, options));
    path.contrast[i] = static_cast<float>(section.contrast);
    if (s[i] < fixed_mm) continue;
    radius[i] = section.contrast >= kGap ? section.radius_mm : 0.0;
    calcium[i] = section.calcium;
    sum += section.contrast * section.edges;
    ++counted;
  }
  path.evidence = counted > 0 ? std::clamp(sum / static_cast<double>(counted), 0.0, 1.0) : 0.0;
  bool unknown = false;
  path.radius_mm = completed_radii(s, std::move(radius), unknown);
  if (unknown)
    path.warnings.push_back(worded("no edge was found along the way: radii are %.1f mm", kFallbackRadiusMm));
  const auto out = [&](std::size_t i) { return s[i] >= fixed_mm && path.contrast[i] < kGap && !calcium[i]; };
  tell_stretches(s, out, "the way leaves the contrast", path.warnings);
  tell_stretches(
      s, [&](std::size_t i) { return calcium[i]; }, "the way runs through calcium", path.warnings);
}

}  // namespace

void validate(const MinimalPathOptions& o) {
  check(o.max_length_mm >= 1.0 && o.max_length_mm <= 1000.0, "max_length_mm", o.max_length_mm,
        "[1, 1000] mm");
  check(o.step_mm >= 0.1 && o.step_mm <= 5.0, "step_mm", o.step_mm, "[0.1, 5] mm");
  check(o.snap_voxels >= 0.0 && o.snap_voxels <= 10.0, "snap_voxels", o.snap_voxels, "[0, 10]");
  check(o.largest_radius_mm >= 0.5 && o.largest_radius_mm <= 10.0, "largest_radius_mm", o.largest_radius_mm,
        "[0.5, 10] mm");
  check(o.blur_sigma_mm >= 0.0 && o.blur_sigma_mm <= 1.5, "blur_sigma_mm", o.blur_sigma_mm, "[0, 1.5] mm");
  check(o.wall_hu >= -100.0 && o.wall_hu <= 200.0, "wall_hu", o.wall_hu, "[-100, 200] HU");
  check(o.slowest > 0.0 && o.slowest <= 0.5, "slowest", o.slowest, "(0, 0.5]");
  check(o.most_voxels >= 1000, "most_voxels", static_cast<double>(o.most_voxels), "[1000, inf)");
}

MinimalPath path_to_tree(const imaging::ImageVolume& image, const Vec3& click,
                         const geometry::VesselTree& tree, const MinimalPathOptions& options,
                         const core::TaskContext& task) {
  validate(options);
  require_inside(image, click);
  task.set_stage("finding the way to the tree");
  const detail::PathTarget target(image, tree, click, options.max_length_mm);
  if (target.empty()) {
    throw InvalidInput(
        worded("the tree has no axis inside the image within %.0f mm of the click ", options.max_length_mm) +
        detail::text(click) + " mm: draw a first vessel by its two ends");
  }
  const auto refuse_inside = [&](const Vec3& place) {
    const std::optional<std::int32_t> vessel = target.vessel_around(place);
    if (!vessel) return;
    const auto named = std::find_if(tree.vessels.begin(), tree.vessels.end(),
                                    [&](const geometry::Vessel& v) { return v.id == *vessel; });
    throw InvalidInput("the click " + detail::text(click) + " mm lies inside vessel '" + named->name +
                       "', which is in the tree already: click the distal end of one that is not");
  };
  refuse_inside(click);

  MinimalPath path;
  const LumenLevels tree_levels =
      levels_from(image, target.axis_points_near(click, kNearMm, kFewestPlaces), {click});
  TubeSpeed plain(image, tree_levels, options.slowest);
  const Vec3 end = snapped(plain, click, options.snap_voxels, path.warnings);
  refuse_inside(end);
  const LumenLevels levels = dimmed(tree_levels, plain.smooth(detail::nearest_voxel(image.geometry, end)));
  TubeSpeed speed(image, levels, options.slowest);
  path.lumen_hu = levels.lumen_hu;
  path.background_hu = levels.background_hu;

  detail::PathFrontStop stop;
  stop.target = [&](const Voxel& v) { return target.hit(v); };
  stop.max_length_mm = options.max_length_mm;
  stop.most_voxels = options.most_voxels;
  const detail::PathFront front = detail::run_front(speed, end, stop, task.sub(0.0, 0.9));
  path.visited = front.visited;
  if (front.end != detail::PathFrontEnd::target) unreached(front, click, "the tree", options);

  const std::vector<Vec3> way = detail::trace_back(image.geometry, front, end);
  const auto joined = [](const detail::PathTarget::Joint& joint, const std::vector<Vec3>& line) {
    std::vector<Vec3> result{joint.junction.point};
    result.insert(result.end(), line.begin() + static_cast<std::ptrdiff_t>(joint.first_free), line.end());
    return result;
  };
  std::vector<Vec3> line = joined(target.entry(front.reached, way), way);
  if (geometry::length(line) < 2.0 * kLineStepMm) {
    throw InvalidInput("the click " + detail::text(click) +
                       " mm lies on the wall of a vessel that is in the tree already: click further out");
  }
  line = detail::centred_line(speed, line, kLineStepMm, (line[1] - line[0]).norm(), false,
                              rays_for(speed, options));
  const detail::PathTarget::Joint joint =
      target.rejoined(front.reached, line, middle_radius(speed, line, options));
  path.junction = joint.junction;
  line = joined(joint, line);
  finish(path, speed, line, (line[1] - line[0]).norm(), options);
  task.set_progress(1.0);
  return path;
}

MinimalPath path_between(const imaging::ImageVolume& image, const Vec3& from, const Vec3& to,
                         const MinimalPathOptions& options, const core::TaskContext& task) {
  validate(options);
  require_inside(image, from);
  require_inside(image, to);
  task.set_stage("finding the way between two points");
  MinimalPath path;
  // The brighter end tells the lumen's intensity: the other may be thin, or beside it.
  TubeSpeed looking(image, {1.0, 0.0, 1e9}, 0.5);
  std::vector<Vec3> brightest;
  double most = -1e9;
  const imaging::Geometry& g = image.geometry;
  for (const Vec3& click : {from, to}) {
    const Voxel centre = detail::nearest_voxel(g, click);
    for (int n = 0; n < 27; ++n) {
      const Voxel v{centre[0] + n % 3 - 1, centre[1] + n / 3 % 3 - 1, centre[2] + n / 9 - 1};
      if (!detail::inside(g.size, v) || looking.smooth(v) <= most) continue;
      most = looking.smooth(v);
      brightest = {g.world(Vec3(v[0], v[1], v[2]))};
    }
  }
  if (most < kAirHu) {
    throw InvalidInput("both ends of the way, " + detail::text(from) + " and " + detail::text(to) +
                       " mm, lie in air: click in the contrast-filled lumen");
  }
  const LumenLevels bright = levels_from(image, brightest, {from, to});
  TubeSpeed plain(image, bright, options.slowest);
  const Vec3 start = snapped(plain, from, options.snap_voxels, path.warnings);
  const Vec3 end = snapped(plain, to, options.snap_voxels, path.warnings);
  const double dimmer =
      std::min(plain.smooth(detail::nearest_voxel(g, start)), plain.smooth(detail::nearest_voxel(g, end)));
  const LumenLevels levels = dimmed(bright, dimmer);
  TubeSpeed speed(image, levels, options.slowest);
  path.lumen_hu = levels.lumen_hu;
  path.background_hu = levels.background_hu;

  const Voxel goal = detail::nearest_voxel(g, start);
  if (goal == detail::nearest_voxel(g, end)) {
    throw InvalidInput("the two ends of the way, " + detail::text(from) + " and " + detail::text(to) +
                       " mm, are one place: click them further apart");
  }
  detail::PathFrontStop stop;
  stop.target = [&](const Voxel& v) { return v == goal; };
  stop.max_length_mm = options.max_length_mm;
  stop.most_voxels = options.most_voxels;
  const detail::PathFront front = detail::run_front(speed, end, stop, task.sub(0.0, 0.9));
  path.visited = front.visited;
  if (front.end != detail::PathFrontEnd::target)
    unreached(front, to, (detail::text(from) + " mm").c_str(), options);
  std::vector<Vec3> way = detail::trace_back(g, front, end);
  way.front() = start;
  finish(path, speed, way, 0.0, options);
  task.set_progress(1.0);
  return path;
}

}  // namespace ostia::segmentation
