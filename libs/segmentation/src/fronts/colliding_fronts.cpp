#include "ostia/segmentation/colliding_fronts.h"

#include "fronts/fast_marching.h"
#include "range_about_seeds.h"
#include "region_builder.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace ostia::segmentation {
namespace {

using detail::BlockGrid;
using detail::FrontTimes;
using detail::kUnreached;
using detail::RegionBuilder;
using detail::Voxel;

constexpr int kOverlapVoxels = 5;  // by which the two halves of a branch with a point between overlap

/// Gradient of the arrival times in world units along the image's axes; one-sided where one neighbour was not
/// reached.
Vec3 time_gradient(const BlockGrid<float>& times, const imaging::Geometry& geometry, const Voxel& v) {
  Vec3 gradient = Vec3::Zero();
  const double here = times.get(v);
  for (int d = 0; d < 3; ++d) {
    Voxel before = v;
    Voxel after = v;
    --before[d];
    ++after[d];
    const double t0 = before[d] >= 0 ? times.get(before) : kUnreached;
    const double t1 = after[d] < geometry.size[d] ? times.get(after) : kUnreached;
    const double h = geometry.spacing[d];
    if (std::isfinite(t0) && std::isfinite(t1)) {
      gradient[d] = (t1 - t0) / (2.0 * h);
    } else if (std::isfinite(t1)) {
      gradient[d] = (t1 - here) / h;
    } else if (std::isfinite(t0)) {
      gradient[d] = (here - t0) / h;
    }
  }
  return gradient;
}

struct Pair {
  Vec3 from;
  Vec3 to;
  Voxel from_voxel;
  Voxel to_voxel;
};

struct Fronts {
  FrontTimes first;
  FrontTimes second;
};

detail::FrontStop stop_at(const Voxel& target, const imaging::Geometry& geometry,
                          const CollidingFrontsOptions& options) {
  detail::FrontStop stop;
  stop.targets = {target};
  stop.all_voxels = options.domain == FrontDomain::whole_volume;
  stop.overrun = options.overrun;
  stop.overrun_mm = 4.0 * geometry.spacing.maxCoeff();
  return stop;
}

/// Of the voxels that a front has covered, the one nearest to where it should go.
Vec3 nearest_covered(const FrontTimes& front, const imaging::Geometry& geometry, const Vec3& target) {
  Vec3 nearest = target;
  double least = std::numeric_limits<double>::infinity();
  for (const Voxel& v : front.order) {
    const Vec3 here = geometry.world(Vec3(v[0], v[1], v[2]));
    if ((here - target).norm() >= least) continue;
    least = (here - target).norm();
    nearest = here;
  }
  return nearest;
}

[[noreturn]] void throw_never_meet(const Pair& pair, const detail::SpeedModel& speed, const FrontTimes& first,
                                   const imaging::Geometry& geometry) {
  const Vec3 reached = nearest_covered(first, geometry, pair.to);
  throw GeometryError(
      "the fronts from " + detail::text(pair.from) + " and " + detail::text(pair.to) +
      " mm never meet: within " + std::to_string(std::llround(speed.range.lower)) + " to " +
      std::to_string(std::llround(speed.range.upper)) + " HU the first covered " +
      std::to_string(first.order.size()) + " voxels and came as far as " + detail::text(reached) + " mm, " +
      std::to_string(std::llround((reached - pair.to).norm())) +
      " mm before the other seed; lower the lower bound, or check that both seeds lie in the same vessel");
}

Fronts run_fronts(const imaging::ImageVolume& image, const Pair& pair, const detail::SpeedModel& speed,
                  const CollidingFrontsOptions& options, const core::TaskContext& task) {
  std::array<std::optional<FrontTimes>, 2> fronts;
  core::parallel_for(2, 1, [&](std::size_t n) {
    const Vec3& source = n == 0 ? pair.from : pair.to;
    const Voxel& target = n == 0 ? pair.to_voxel : pair.from_voxel;
    fronts[n] = detail::march(image, {source}, speed, stop_at(target, image.geometry, options), task);
  });
  if (fronts[0]->target_time == kUnreached || fronts[1]->target_time == kUnreached) {
    throw_never_meet(pair, speed, *fronts[0], image.geometry);
  }
  return {std::move(*fronts[0]), std::move(*fronts[1])};
}

/// The face neighbour that the front reached first; the voxel itself where it was earlier than all.
Voxel earliest_neighbour(const BlockGrid<float>& times, const imaging::Geometry& geometry, const Voxel& v) {
  Voxel best = v;
  for (int d = 0; d < 3; ++d) {
    for (const int s : {-1, 1}) {
      Voxel n = v;
      n[d] += s;
      if (detail::inside(geometry.size, n) && times.get(n) < times.get(best)) best = n;
    }
  }
  return best;
}

/// cos of the angle between the fronts' gradients where both have been. Appends the way.
void add_collision(const imaging::ImageVolume& image, const Fronts& fronts, const Pair& pair,
                   RegionBuilder& region, std::vector<Vec3>& way) {
  BlockGrid<float> cosines(image.geometry.size, 1.0F);
  for (const Voxel& v : fronts.first.order) {
    if (fronts.second.times.get(v) == kUnreached) continue;
    const Vec3 g1 = time_gradient(fronts.first.times, image.geometry, v);
    const Vec3 g2 = time_gradient(fronts.second.times, image.geometry, v);
    const double norms = g1.norm() * g2.norm();
    cosines.at(v) = norms > 0.0 ? static_cast<float>(g1.dot(g2) / norms) : 0.0F;
  }
  // The way that the front took belongs to the region, even where it is a voxel wide and its gradients mean
  // little.
  Voxel v = pair.to_voxel;
  for (std::size_t step = 0; step < fronts.first.order.size(); ++step) {
    cosines.at(v) = std::min(-0.1F, cosines.get(v));
    way.push_back(image.geometry.world(Vec3(v[0], v[1], v[2])));
    if (v == pair.from_voxel) break;
    const Voxel next = earliest_neighbour(fronts.first.times, image.geometry, v);
    if (next == v) break;
    v = next;
  }
  cosines.at(pair.from_voxel) = std::min(-0.1F, cosines.get(pair.from_voxel));
  if (!region.add_connected(cosines, pair.from_voxel, pair.to_voxel)) {
    throw GeometryError("the region in which the fronts from " + detail::text(pair.from) + " and " +
                        detail::text(pair.to) +
                        " mm run against each other does not join the two seeds; "
                        "place a seed between them");
  }
}

/// The point some voxels further along the way from `through` to where `times` started.
Vec3 point_ahead(const BlockGrid<float>& times, const imaging::Geometry& geometry, Voxel v) {
  for (int step = 0; step < kOverlapVoxels; ++step) {
    v = earliest_neighbour(times, geometry, v);
  }
  return geometry.world(Vec3(v[0], v[1], v[2]));
}

/// The mean direction of a front about a voxel, in the world.
Vec3 front_direction(const BlockGrid<float>& times, const imaging::Geometry& geometry, const Voxel& v) {
  Vec3 sum = Vec3::Zero();
  for (int k = -2; k <= 2; ++k) {
    for (int j = -2; j <= 2; ++j) {
      for (int i = -2; i <= 2; ++i) {
        const Voxel n{v[0] + i, v[1] + j, v[2] + k};
        if (detail::inside(geometry.size, n) && times.get(n) != kUnreached)
          sum += time_gradient(times, geometry, n).normalized();
      }
    }
  }
  return geometry.direction * (sum.norm() > 0.0 ? sum.normalized() : Vec3::UnitZ());
}

Pair make_pair(const imaging::ImageVolume& image, const Vec3& from, const Vec3& to,
               const IntensityRange& range) {
  Pair pair{from, to, detail::voxel_in_range(image, from, range), detail::voxel_in_range(image, to, range)};
  if (pair.from_voxel == pair.to_voxel) {
    throw InvalidInput("the seeds " + detail::text(from) + " and " + detail::text(to) +
                       " mm lie in the same voxel: place them at the two ends of the vessel");
  }
  return pair;
}

}  // namespace

void validate(const CollidingFrontsOptions& o) {
  const auto finite = [](const std::optional<double>& v) { return !v || std::isfinite(*v); };
  if (!finite(o.lower_hu) || !finite(o.upper_hu)) {
    throw InvalidInput("colliding fronts: lower_hu and upper_hu must be finite");
  }
  if (o.lower_hu && o.upper_hu && !(*o.lower_hu < *o.upper_hu)) {
    throw InvalidInput("colliding fronts: lower_hu " + std::to_string(*o.lower_hu) +
                       " must be below upper_hu " + std::to_string(*o.upper_hu));
  }
  if (!(o.slowest > 0.0 && o.slowest <= 1.0))
    throw InvalidInput("colliding fronts: slowest must be in (0, 1]");
  if (!(o.overrun >= 0.0 && o.overrun <= 10.0))
    throw InvalidInput("colliding fronts: overrun must be in [0, 10]");
  if (o.margin_voxels < 1) throw InvalidInput("colliding fronts: margin_voxels must be at least 1");
}

InitialRegion colliding_fronts(const imaging::ImageVolume& image, const BranchSeeds& branch,
                               const CollidingFrontsOptions& options, const core::TaskContext& task) {
  validate(options);
  std::vector<Vec3> seeds{branch.from};
  if (branch.through) seeds.push_back(*branch.through);
  seeds.push_back(branch.to);
  const detail::ChosenRange chosen = detail::choose_range(image, seeds, options.lower_hu, options.upper_hu);
  const detail::SpeedModel speed{chosen.range, chosen.lumen_hu, options.slowest};

  RegionBuilder region(image.geometry);
  std::int64_t visited = 0;
  std::vector<Vec3> outward;
  std::vector<Vec3> way;
  const auto run = [&](const Pair& pair, const core::TaskContext& part) {
    Fronts fronts = run_fronts(image, pair, speed, options, part);
    add_collision(image, fronts, pair, region, way);
    visited += static_cast<std::int64_t>(fronts.first.order.size() + fronts.second.order.size());
    return fronts;
  };
  task.set_progress(0.0);
  if (branch.through) {
    const Pair second = make_pair(image, *branch.through, branch.to, chosen.range);
    const Pair first = make_pair(image, branch.from, *branch.through, chosen.range);
    const Fronts fronts = run(second, task);
    const Vec3 last = front_direction(fronts.first.times, image.geometry, second.to_voxel);
    task.set_progress(0.5);
    const Vec3 ahead = point_ahead(fronts.second.times, image.geometry, second.from_voxel);
    const Fronts before = run(make_pair(image, first.from, ahead, chosen.range), task);
    outward = {front_direction(before.second.times, image.geometry, first.from_voxel), last};
  } else {
    const Pair pair = make_pair(image, branch.from, branch.to, chosen.range);
    const Fronts fronts = run(pair, task);
    outward = {front_direction(fronts.second.times, image.geometry, pair.from_voxel),
               front_direction(fronts.first.times, image.geometry, pair.to_voxel)};
  }
  InitialRegion result = region.finish(options.margin_voxels);
  result.range = chosen.range;
  result.range_was_chosen = chosen.chosen;
  result.lumen_hu = chosen.lumen_hu;
  result.visited = visited;
  result.outward = outward;
  result.way = std::move(way);
  task.set_progress(1.0);
  return result;
}

InitialRegion fast_marching_initialisation(const imaging::ImageVolume& image,
                                           const std::vector<Vec3>& seeds_mm,
                                           const std::vector<Vec3>& targets_mm,
                                           const CollidingFrontsOptions& options,
                                           const core::TaskContext& task) {
  validate(options);
  if (targets_mm.empty()) throw InvalidInput("fast marching: no target is given");
  std::vector<Vec3> all = seeds_mm;
  if (all.empty()) throw InvalidInput("fast marching: no seed is given");
  all.insert(all.end(), targets_mm.begin(), targets_mm.end());
  const detail::ChosenRange chosen = detail::choose_range(image, all, options.lower_hu, options.upper_hu);
  const detail::SpeedModel speed{chosen.range, chosen.lumen_hu, options.slowest};
  for (const Vec3& seed : seeds_mm) detail::voxel_in_range(image, seed, chosen.range);

  detail::FrontStop stop;
  for (const Vec3& target : targets_mm)
    stop.targets.push_back(detail::voxel_in_range(image, target, chosen.range));
  stop.all_voxels = options.domain == FrontDomain::whole_volume;
  stop.overrun = 0.0;
  stop.overrun_mm = 2.0 * image.geometry.spacing.maxCoeff();
  const FrontTimes front = detail::march(image, seeds_mm, speed, stop, task);
  if (front.target_time == kUnreached) {
    throw GeometryError("fast marching: no target was reached from the seeds within " +
                        std::to_string(std::llround(chosen.range.lower)) + " to " +
                        std::to_string(std::llround(chosen.range.upper)) + " HU; lower the lower bound");
  }
  RegionBuilder region(image.geometry);
  const double step = image.geometry.spacing.minCoeff();
  for (const Voxel& v : front.order) {
    const double value = (static_cast<double>(front.times.get(v)) - front.target_time) / step;
    region.add(v, static_cast<float>(std::clamp(value, -1.0, 1.0)));
  }
  InitialRegion result = region.finish(options.margin_voxels);
  result.range = chosen.range;
  result.range_was_chosen = chosen.chosen;
  result.lumen_hu = chosen.lumen_hu;
  result.visited = static_cast<std::int64_t>(front.order.size());
  task.set_progress(1.0);
  return result;
}

}  // namespace ostia::segmentation
