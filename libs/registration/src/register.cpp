#include "ostia/registration/register.h"

#include "prepared.h"
#include "quality.h"
#include "spline_levels.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

namespace ostia::registration {
namespace {

constexpr std::int64_t linear_samples = 20000;

template <class Number>
void check_range(const char* name, Number value, Number least, Number most) {
  if (!(value >= least && value <= most))
    throw InvalidInput(std::string("registration: ") + name + " must be from " + std::to_string(least) +
                       " to " + std::to_string(most) + ", not " + std::to_string(value));
}

void check_scan(const imaging::ImageVolume& scan, const char* name) {
  if (scan.voxels.empty() || static_cast<std::int64_t>(scan.voxels.size()) != scan.geometry.voxels())
    throw InvalidInput(std::string("the ") + name + " scan is empty");
  for (const std::int64_t size : scan.geometry.size)
    if (size < 8)
      throw InvalidInput(std::string("the ") + name + " scan has only " + std::to_string(size) +
                         " voxels along an axis: there is nothing to compare");
}

/// Both scans, what is compared of them, and how.
struct Pair {
  imaging::ImageVolume fixed;   // the region, with voxels no smaller than needed
  imaging::ImageVolume moving;  // all of it, likewise
  imaging::Geometry moving_field;
  const RegistrationOptions& options;
  Window fixed_window, moving_window;
  Region region;
};

/// Where to begin when no landmarks say it: as the scanner has it, or middle upon middle, and turned a
/// little.
std::vector<LinearMap> starts(const Pair& pair) {
  const imaging::Geometry& moving = pair.moving_field;
  const Vec3 middle = moving.world(0.5 * Vec3(static_cast<double>(moving.size[0] - 1),
                                              static_cast<double>(moving.size[1] - 1),
                                              static_cast<double>(moving.size[2] - 1)));
  const Vec3 centre = pair.region.centre();
  std::vector<LinearMap> maps;
  for (const Vec3& target : {centre, middle})
    for (int turn = 0; turn < 7; ++turn) {
      LinearMap map;
      if (turn > 0)
        map.linear = Eigen::AngleAxisd((turn % 2 == 0 ? -1.0 : 1.0) * std::numbers::pi / 12.0,
                                       Vec3::Unit((turn - 1) / 2))
                         .toRotationMatrix();
      map.offset_mm = target - map.linear * centre;
      maps.push_back(map);
    }
  return maps;
}

/// From the best few of all starts, a short way each; the best is gone on from.
LinearMap best_start(const ComparedImages& images, const std::vector<LinearMap>& maps, LinearSearch search,
                     const core::TaskContext& task) {
  constexpr std::size_t tried = 3;
  const std::vector<double> costs = costs_of(images, maps);
  std::vector<std::size_t> order(maps.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return costs[a] < costs[b]; });
  search.iterations = std::min(search.iterations, 12);
  std::optional<LinearMap> best;
  for (std::size_t i = 0; i < std::min(tried, order.size()); ++i) {
    if (costs[order[i]] == std::numeric_limits<double>::max()) break;
    const LinearMap found =
        fitted_linear(images, maps[order[i]], search,
                      task.sub(static_cast<double>(i) / tried, static_cast<double>(i + 1) / tried));
    if (!best || found.cost < best->cost) best = found;
  }
  if (!best) throw InvalidInput(no_overlap);
  return *best;
}

struct LinearMaps {
  LinearMap rigid, affine;
};

LinearMaps linear_maps(const Pair& pair, const std::optional<LinearMap>& start,
                       const core::TaskContext& task) {
  const RegistrationOptions& options = pair.options;
  LinearSearch search;
  search.centre_mm = pair.region.centre();
  search.reach_mm = pair.region.reach_mm();
  search.iterations = options.iterations;
  LinearMaps maps;
  maps.rigid = start.value_or(LinearMap{});
  for (const double voxel_mm : {2.0 * options.linear_voxel_mm, options.linear_voxel_mm}) {
    const bool first = voxel_mm > options.linear_voxel_mm;
    const imaging::FloatVolume fixed =
        coarse(pair.fixed, &pair.region.box(), voxel_mm, pair.fixed_window, task.sub(0.0, 0.0));
    const imaging::FloatVolume moving =
        coarse(pair.moving, nullptr, voxel_mm, pair.moving_window, task.sub(0.0, 0.0));
    ComparedImages images{&fixed, &moving, {}, options.likeness};
    const std::int64_t count = std::min(options.samples, linear_samples);
    if (first && !start) {
      // All of the region: which part of it the moving scan shows depends on the start.
      images.samples = pair.region.samples(fixed.geometry, fixed.geometry, {}, count);
      maps.rigid = best_start(images, starts(pair), search, task.sub(0.05, 0.35));
    }
    images.samples = pair.region.samples(fixed.geometry, pair.moving_field, maps.rigid, count);
    search.affine = false;
    maps.rigid = fitted_linear(images, maps.rigid, search, first ? task.sub(0.35, 0.55) : task.sub(0.6, 0.8));
    if (first) continue;
    search.affine = true;
    maps.affine = fitted_linear(images, maps.rigid, search, task.sub(0.8, 1.0));
  }
  return maps;
}

std::vector<Vec3> places_of(const imaging::Geometry& image, const std::vector<std::int64_t>& offsets) {
  std::vector<Vec3> places;
  places.reserve(offsets.size());
  for (const std::int64_t offset : offsets) {
    const std::int64_t i = offset % image.size[0], rest = offset / image.size[0];
    places.push_back(image.world(Vec3(static_cast<double>(i), static_cast<double>(rest % image.size[1]),
                                      static_cast<double>(rest / image.size[1]))));
  }
  return places;
}

/// A level's spline from `start`, stiffer where it comes close to folding; `start` itself where nothing
/// helps.
struct SplineStep {
  SplineGrid spline;
  bool settled = false;
};
SplineStep unfolded_spline(const ComparedImages& images, const SplineGrid& start,
                           const std::vector<Vec3>& places, const RegistrationOptions& options,
                           const core::TaskContext& task) {
  double weight = options.bending_weight;
  for (int attempt = 0; attempt < 3; ++attempt) {
    SplineGrid spline = fitted_spline(images, start, weight, options.iterations, task);
    if (jacobian_range(spline, places).min >= options.least_jacobian) return {std::move(spline), true};
    weight = 10.0 * std::max(weight, 1e-4);
  }
  return {start, false};
}

/// The shifts on top of `map`; what they come to goes into `quality`.
SplineGrid bent(const Pair& pair, const LinearMap& map, Quality& quality, const core::TaskContext& task) {
  const RegistrationOptions& options = pair.options;
  const int levels = options.levels;
  const auto coarsening = [&](int level) { return std::pow(2.0, levels - 1 - level); };
  SplineGrid spline = resting_spline(pair.region.box(), options.node_spacing_mm * coarsening(0));
  SplineGrid back = spline;
  bool going = true;
  double done = 0.0;
  for (int level = 0; level < levels; ++level) {
    const double to = std::pow(0.5, levels - 1 - level);
    const core::TaskContext part = task.sub(done, to);
    done = to;
    const bool last = level == levels - 1;
    const double voxel_mm =
        std::max(options.finest_voxel_mm,
                 std::min(options.linear_voxel_mm, options.finest_voxel_mm * coarsening(level)));
    const imaging::FloatVolume fixed =
        coarse(pair.fixed, &pair.region.box(), voxel_mm, pair.fixed_window, part.sub(0.0, 0.0));
    const imaging::FloatVolume moving =
        laid_on(fixed.geometry, pair.moving, map, voxel_mm, pair.moving_window, part.sub(0.0, 0.0));
    ComparedImages images{&fixed, &moving, {}, options.likeness};
    const auto count =
        static_cast<std::int64_t>(static_cast<double>(options.samples) / std::sqrt(coarsening(level)));
    images.samples = pair.region.samples(fixed.geometry, pair.moving_field, map, count, &quality.overlap);
    const std::vector<Vec3> places = places_of(fixed.geometry, images.samples);
    const SplineGrid before = level > 0 ? refined(spline) : spline;
    if (going) {
      SplineStep step = unfolded_spline(images, before, places, options, part.sub(0.05, last ? 1.0 : 0.6));
      spline = std::move(step.spline);
      going = step.settled;
    } else {
      spline = before;
    }
    if (!last || levels == 1) {
      ComparedImages reversed = images;
      std::swap(reversed.fixed, reversed.moving);
      back = unfolded_spline(reversed, level > 0 ? refined(back) : back, places, options, part.sub(0.6, 1.0))
                 .spline;
      quality.inverse_consistency_mm = inconsistency_mm(spline, back, places);
    }
    if (last) {
      const JacobianRange range = jacobian_range(spline, places);
      quality.jacobian_min = range.min;
      quality.jacobian_max = range.max;
      quality.correlation_linear = correlation_of(fixed, moving, nullptr, places);
      quality.correlation = correlation_of(fixed, moving, &spline, places);
    }
  }
  return spline;
}

/// Whether a spline makes the scans more alike; of other kinds of images the correlation does not tell.
bool pays(const Quality& quality, const RegistrationOptions& options) {
  return !options.hounsfield || quality.correlation > quality.correlation_linear;
}

/// What is true of the affine map alone.
Quality without_spline(const Quality& with) {
  Quality left;
  left.overlap = with.overlap;
  left.correlation = left.correlation_linear = with.correlation_linear;
  return left;
}

/// Without a spline: only how alike the images are.
void compare_linear(const Pair& pair, const LinearMap& map, Quality& quality, const core::TaskContext& task) {
  const double voxel_mm = pair.options.finest_voxel_mm;
  const imaging::FloatVolume fixed =
      coarse(pair.fixed, &pair.region.box(), voxel_mm, pair.fixed_window, task.sub(0.0, 0.0));
  const imaging::FloatVolume moving =
      laid_on(fixed.geometry, pair.moving, map, voxel_mm, pair.moving_window, task);
  const std::vector<std::int64_t> samples =
      pair.region.samples(fixed.geometry, pair.moving_field, map, pair.options.samples, &quality.overlap);
  quality.correlation_linear = correlation_of(fixed, moving, nullptr, places_of(fixed.geometry, samples));
  quality.correlation = quality.correlation_linear;
}

}  // namespace

void validate(const RegistrationOptions& options) {
  check_range("region_mm", options.region_mm, 5.0, 100.0);
  check_range("linear_voxel_mm", options.linear_voxel_mm, 1.0, 10.0);
  check_range("finest_voxel_mm", options.finest_voxel_mm, 0.5, 5.0);
  check_range("node_spacing_mm", options.node_spacing_mm, 4.0, 100.0);
  check_range("levels", options.levels, 0, 5);
  check_range("samples", options.samples, std::int64_t{1000}, std::int64_t{10'000'000});
  check_range("bending_weight", options.bending_weight, 0.0, 1e6);
  check_range("iterations", options.iterations, 1, 1000);
  check_range("least_jacobian", options.least_jacobian, 1e-6, 0.999);
}

const char* name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::good:
      return "good";
    case Verdict::doubtful:
      return "doubtful";
    case Verdict::failed:
      return "failed";
  }
  return "";
}

Registration register_scans(const imaging::ImageVolume& fixed, const imaging::ImageVolume& moving,
                            const Guidance& guidance, const RegistrationOptions& options,
                            const core::TaskContext& task) {
  validate(options);
  check_scan(fixed, "fixed");
  check_scan(moving, "moving");
  const Window fixed_window = window_of(fixed, options.hounsfield, "fixed");
  const Window moving_window = window_of(moving, options.hounsfield, "moving");
  Region region(fixed.geometry, guidance, options.region_mm);
  std::optional<LinearMap> start;
  if (guidance.landmarks.size() >= 3) {
    const LandmarkFit fit = rigid_from_landmarks(guidance.landmarks);
    start = LinearMap{fit.transform.linear(), fit.transform.offset_mm()};
  }
  const Pair pair{reduced(fixed, &region.box(), options.finest_voxel_mm / 1.5, task),
                  reduced(moving, nullptr, options.finest_voxel_mm / 1.5, task),
                  moving.geometry,
                  options,
                  fixed_window,
                  moving_window,
                  region};
  LinearMaps maps;
  const double linear_share = options.linear ? 0.25 : 0.0;
  if (options.linear) {
    task.set_stage("rigid and affine registration");
    maps = linear_maps(pair, start, task.sub(0.0, linear_share));
  } else if (start) {
    maps = {*start, *start};
  }
  Registration result;
  result.rigid = Transform(maps.rigid.linear, maps.rigid.offset_mm);
  result.affine = Transform(maps.affine.linear, maps.affine.offset_mm);
  result.transform = result.affine;
  task.set_stage("B-spline registration");
  if (options.levels > 0) {
    SplineGrid spline = bent(pair, maps.affine, result.quality, task.sub(linear_share, 1.0));
    if (pays(result.quality, options))
      result.transform = Transform(maps.affine.linear, maps.affine.offset_mm, std::move(spline));
    else
      result.quality = without_spline(result.quality);
  } else {
    compare_linear(pair, maps.affine, result.quality, task.sub(linear_share, 1.0));
  }
  judge(result.quality, fixed, moving, guidance, result.transform, options.hounsfield);
  task.set_progress(1.0);
  return result;
}

RegistrationOptions phase_options() {
  RegistrationOptions options;
  options.likeness = Likeness::mean_squares;
  options.linear = false;
  options.node_spacing_mm = 8.0;
  options.bending_weight = 2e-4;
  return options;
}

Registration register_phases(const imaging::ImageVolume& fixed, const imaging::ImageVolume& moving,
                             const Guidance& guidance, const RegistrationOptions& options,
                             const core::TaskContext& task) {
  return register_scans(fixed, moving, guidance, options, task);
}

}  // namespace ostia::registration
