#include "ostia/pipeline/mask_walls.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/geometry/axis_curve.h"
#include "ostia/imaging/filters.h"
#include "ostia/imaging/sampling.h"
#include "ostia/lumen/lumen_model.h"
#include "ostia/pipeline/image_walls.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <string>
#include <utility>

namespace ostia::pipeline {
namespace {

using geometry::Vec3;
using std::numbers::pi;
using MaskAxis = std::shared_ptr<const geometry::AxisCurve>;

constexpr double ring_mm = 0.25;
constexpr int shape_rays = 24, shape_orders = 3;
constexpr double ray_step_mm = 0.05, longest_ray_mm = 8.0;
constexpr double out_through_branch = 1.5;  // times the ring's median: the ray has left through a branch
constexpr double least_shape = 0.7, most_shape = 1.45;
constexpr double take_off_mm = 1.5;  // from a branch's tube to its own wall
constexpr double reach_mm = 7.0;     // of a voxel from the axis it belongs to
constexpr double scale_limit = 1.3;

/// One vessel while its wall is made: areas and shapes on rings from `own_from` to its end.
struct MaskVessel {
  MaskAxis axis;
  double own_mm = 0.0, free_mm = 0.0, step_mm = ring_mm;
  std::vector<double> area_mm2;                       // one a ring
  std::vector<std::array<double, shape_rays>> shape;  // mean square 1
  geometry::Box3 box;

  std::size_t rings() const { return area_mm2.size(); }
  double s(std::size_t ring) const { return own_mm + step_mm * static_cast<double>(ring); }
  double mean_radius(double s_mm) const {
    const double x = place(s_mm);
    const auto i = std::min(rings() - 2, static_cast<std::size_t>(x));
    const double t = x - static_cast<double>(i);
    return std::sqrt(((1.0 - t) * area_mm2[i] + t * area_mm2[i + 1]) / pi);
  }
  double radius(double s_mm, double theta) const {
    const double x = place(s_mm);
    const auto i = std::min(rings() - 2, static_cast<std::size_t>(x));
    const double t = x - static_cast<double>(i);
    return mean_radius(s_mm) * ((1.0 - t) * shape_at(i, theta) + t * shape_at(i + 1, theta));
  }

 private:
  double place(double s_mm) const {
    return std::clamp((s_mm - own_mm) / step_mm, 0.0, static_cast<double>(rings() - 1));
  }
  /// Periodic cubic between rays (Catmull-Rom).
  double shape_at(std::size_t ring, double theta) const {
    const double turn = theta / (2.0 * pi), x = (turn - std::floor(turn)) * shape_rays;
    const int k = static_cast<int>(x);
    const double t = x - k, u = 1.0 - t;
    const auto v = [&](int i) {
      return shape[ring][static_cast<std::size_t>((i % shape_rays + shape_rays) % shape_rays)];
    };
    const double mb = 0.5 * (v(k + 1) - v(k - 1)), mc = 0.5 * (v(k + 2) - v(k));
    return u * u * (1.0 + 2.0 * t) * v(k) + t * t * (3.0 - 2.0 * t) * v(k + 1) + t * u * (u * mb - t * mc);
  }
};

/// A mean over neighbours along the vessel, weighed by a Gaussian, within the rings from `first` on.
template <class Value>
std::vector<Value> evened_along(const std::vector<Value>& values, std::size_t first, double sigma_rings,
                                const std::function<void(Value&, const Value&, double)>& add, Value zero) {
  if (sigma_rings < 1e-3) return values;
  std::vector<Value> result = values;
  const auto reach = static_cast<std::ptrdiff_t>(std::ceil(3.0 * sigma_rings));
  const auto count = static_cast<std::ptrdiff_t>(values.size());
  for (auto i = static_cast<std::ptrdiff_t>(first); i < count; ++i) {
    Value sum = zero;
    double weights = 0.0;
    for (std::ptrdiff_t j = std::max(static_cast<std::ptrdiff_t>(first), i - reach);
         j <= std::min(count - 1, i + reach); ++j) {
      const double d = static_cast<double>(j - i) / sigma_rings, w = std::exp(-0.5 * d * d);
      add(sum, values[static_cast<std::size_t>(j)], w);
      weights += w;
    }
    Value mean = zero;
    add(mean, sum, 1.0 / weights);
    result[static_cast<std::size_t>(i)] = mean;
  }
  return result;
}

std::vector<MaskVessel> vessels_of(const geometry::VesselTree& tree) {
  std::vector<MaskAxis> axes;
  for (const geometry::Vessel& vessel : tree.vessels)
    axes.push_back(std::make_shared<const geometry::AxisCurve>(geometry::vessel_axis(tree, vessel)));
  std::vector<MaskVessel> vessels;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    MaskVessel one;
    one.axis = axes[i];
    one.own_mm = lumen::own_from_mm(tree, tree.vessels[i].id);
    const double length = axes[i]->length();
    one.free_mm = std::min(free_from_mm(tree, axes, i), std::max(one.own_mm, length - 1.0));
    const auto steps = std::max(2, static_cast<int>(std::ceil((length - one.own_mm) / ring_mm)));
    one.step_mm = (length - one.own_mm) / steps;
    for (int k = 0; k <= steps; ++k) {
      const double s = one.own_mm + one.step_mm * k, r = axes[i]->radius(s);
      one.area_mm2.push_back(pi * r * r);
      one.box.extend(axes[i]->point(s));
    }
    one.shape.assign(one.area_mm2.size(), {});
    for (auto& ring : one.shape) ring.fill(1.0);
    one.box.extend(Vec3(one.box.min() - Vec3::Constant(reach_mm)));
    one.box.extend(Vec3(one.box.max() + Vec3::Constant(reach_mm)));
    vessels.push_back(std::move(one));
  }
  return vessels;
}

/// Where a place is as seen from the vessel whose wall is nearest.
struct Belonging {
  std::int32_t vessel = -1;
  geometry::AxisFoot foot;
  double beyond_mm = 1e9;  // the wall; negative inside
};

/// Distance beyond a vessel's wall; behind an end that of the dome there.
double beyond_wall(const MaskVessel& vessel, const geometry::AxisFoot& foot, bool round) {
  if (foot.past_end) return foot.rho_mm - vessel.mean_radius(foot.s_mm);
  return foot.rho_mm - (round ? vessel.mean_radius(foot.s_mm) : vessel.radius(foot.s_mm, foot.theta));
}

Belonging belonging_of(const std::vector<MaskVessel>& vessels, const Vec3& place, bool round) {
  Belonging best;
  for (std::size_t i = 0; i < vessels.size(); ++i) {
    const MaskVessel& vessel = vessels[i];
    if (!vessel.box.contains(place)) continue;
    for (const geometry::AxisFoot& foot : vessel.axis->feet(place, reach_mm)) {
      if (foot.s_mm < vessel.own_mm) continue;
      const double beyond = beyond_wall(vessel, foot, round);
      if (beyond < best.beyond_mm) best = {static_cast<std::int32_t>(i), foot, beyond};
    }
  }
  return best;
}

std::vector<std::int64_t> object_voxels(const imaging::MaskVolume& mask) {
  std::vector<std::int64_t> voxels;
  for (std::size_t n = 0; n < mask.voxels.size(); ++n)
    if (mask.voxels[n] != 0) voxels.push_back(static_cast<std::int64_t>(n));
  return voxels;
}

Vec3 centre_of_voxel(const imaging::Geometry& grid, std::int64_t n) {
  return grid.world(Vec3(static_cast<double>(n % grid.size[0]),
                         static_cast<double>(n / grid.size[0] % grid.size[1]),
                         static_cast<double>(n / (grid.size[0] * grid.size[1]))));
}

std::vector<Belonging> all_belongings(const std::vector<MaskVessel>& vessels, const imaging::Geometry& grid,
                                      const std::vector<std::int64_t>& voxels, bool round,
                                      const core::TaskContext& task) {
  std::vector<Belonging> result(voxels.size());
  core::parallel_chunks(voxels.size(), 512, [&](std::size_t first, std::size_t last) {
    task.throw_if_cancelled();
    for (std::size_t v = first; v < last; ++v)
      result[v] = belonging_of(vessels, centre_of_voxel(grid, voxels[v]), round);
  });
  return result;
}

/// Areas that hold the voxels' volume, evened along each vessel.
void take_areas(std::vector<MaskVessel>& vessels, const imaging::MaskVolume& mask,
                const std::vector<std::int64_t>& voxels, const MaskWallOptions& options,
                const core::TaskContext& task) {
  const double voxel = mask.geometry.spacing.prod();
  std::vector<std::vector<double>> volume;
  for (const MaskVessel& vessel : vessels) volume.emplace_back(vessel.rings(), 0.0);
  for (const Belonging& one : all_belongings(vessels, mask.geometry, voxels, true, task)) {
    if (one.vessel < 0 || one.foot.past_end) continue;
    const MaskVessel& vessel = vessels[static_cast<std::size_t>(one.vessel)];
    auto& rings = volume[static_cast<std::size_t>(one.vessel)];
    const double x = std::clamp((one.foot.s_mm - vessel.own_mm) / vessel.step_mm, 0.0,
                                static_cast<double>(rings.size() - 1));
    const auto i = std::min(rings.size() - 2, static_cast<std::size_t>(x));
    const double t = x - static_cast<double>(i);
    rings[i] += (1.0 - t) * voxel;
    rings[i + 1] += t * voxel;
  }
  for (std::size_t v = 0; v < vessels.size(); ++v) {
    MaskVessel& vessel = vessels[v];
    std::vector<double> area = volume[v];
    for (double& a : area) a /= vessel.step_mm;
    area.front() *= 2.0;  // half a ring's length
    area.back() *= 2.0;
    const double behind = vessel.free_mm > vessel.own_mm ? vessel.free_mm + 0.5 : vessel.own_mm;
    const auto first = std::min(
        vessel.rings() - 1, static_cast<std::size_t>(std::ceil((behind - vessel.own_mm) / vessel.step_mm)));
    area = evened_along<double>(
        area, first, options.even_mm / vessel.step_mm,
        [](double& sum, const double& value, double weight) { sum += weight * value; }, 0.0);
    const double least = pi * options.least_radius_mm * options.least_radius_mm;
    const auto calibre =
        std::min(vessel.rings() - 1, first + static_cast<std::size_t>(take_off_mm / vessel.step_mm));
    for (std::size_t i = 0; i < area.size(); ++i)
      vessel.area_mm2[i] = std::max(least, i < first ? area[calibre] : area[i]);
    if (first == 0) continue;
    for (std::size_t i = first; i < calibre; ++i) {  // from the tube to what is there
      const double t = static_cast<double>(i - first) / static_cast<double>(calibre - first);
      const double w = t * t * (3.0 - 2.0 * t);
      vessel.area_mm2[i] = std::max(least, (1.0 - w) * area[calibre] + w * area[i]);
    }
  }
}

double ray_to_edge(const imaging::FloatVolume& inside, const Vec3& from, const Vec3& direction) {
  double before = imaging::sample(inside, from);
  if (before < 0.5) return -1.0;
  for (double t = ray_step_mm; t < longest_ray_mm; t += ray_step_mm) {
    const double now = imaging::sample(inside, Vec3(from + t * direction));
    if (now < 0.5) return t - ray_step_mm * (0.5 - now) / std::max(before - now, 1e-9);
    before = now;
  }
  return -1.0;
}

/// The low orders of a closed curve's Fourier series, scaled to a mean square of 1.
std::array<double, shape_rays> low_orders(const std::array<double, shape_rays>& ring) {
  std::array<double, shape_rays> out{};
  for (int order = 0; order <= shape_orders; ++order) {
    double re = 0.0, im = 0.0;
    for (int k = 0; k < shape_rays; ++k) {
      re += ring[static_cast<std::size_t>(k)] * std::cos(2.0 * pi * order * k / shape_rays);
      im += ring[static_cast<std::size_t>(k)] * std::sin(2.0 * pi * order * k / shape_rays);
    }
    const double scale = (order == 0 ? 1.0 : 2.0) / shape_rays;
    for (int k = 0; k < shape_rays; ++k)
      out[static_cast<std::size_t>(k)] += scale * (re * std::cos(2.0 * pi * order * k / shape_rays) +
                                                   im * std::sin(2.0 * pi * order * k / shape_rays));
  }
  double square = 0.0;
  for (double& r : out) {
    r = std::clamp(r, least_shape, most_shape);
    square += r * r / shape_rays;
  }
  for (double& r : out) r /= std::sqrt(square);
  return out;
}

void take_shapes(MaskVessel& vessel, const imaging::FloatVolume& inside, const MaskWallOptions& options) {
  for (std::size_t i = 0; i < vessel.rings(); ++i) {
    auto& ring = vessel.shape[i];
    const double s = vessel.s(i);
    if (s < vessel.free_mm && vessel.free_mm > vessel.own_mm) continue;  // inside its parent: round
    const geometry::Frame frame = vessel.axis->frame(s);
    std::array<double, shape_rays> found{};
    std::vector<double> known;
    for (int k = 0; k < shape_rays; ++k) {
      found[static_cast<std::size_t>(k)] = ray_to_edge(
          inside, vessel.axis->point(s), geometry::radial_direction(frame, 2.0 * pi * k / shape_rays));
      if (found[static_cast<std::size_t>(k)] > 0.0) known.push_back(found[static_cast<std::size_t>(k)]);
    }
    if (known.size() < shape_rays / 2) continue;
    std::nth_element(known.begin(), known.begin() + static_cast<std::ptrdiff_t>(known.size() / 2),
                     known.end());
    const double median = known[known.size() / 2];
    for (int k = 0; k < shape_rays; ++k) {
      const double r = found[static_cast<std::size_t>(k)];
      ring[static_cast<std::size_t>(k)] = r > 0.0 && r < out_through_branch * median ? r / median : 1.0;
    }
  }
  using Ring = std::array<double, shape_rays>;
  vessel.shape = evened_along<Ring>(
      vessel.shape, 0, options.even_mm / vessel.step_mm,
      [](Ring& sum, const Ring& value, double weight) {
        for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += weight * value[k];
      },
      Ring{});
  for (Ring& ring : vessel.shape) ring = low_orders(ring);
}

/// Voxels of the mask and those within so many voxels of it.
std::vector<std::int64_t> voxels_about(const imaging::MaskVolume& mask, std::int64_t reach) {
  std::vector<std::uint8_t> near(mask.voxels.size(), 0);
  const auto& size = mask.geometry.size;
  for (std::int64_t k = 0; k < size[2]; ++k)
    for (std::int64_t j = 0; j < size[1]; ++j)
      for (std::int64_t i = 0; i < size[0]; ++i) {
        if (mask(i, j, k) == 0) continue;
        for (std::int64_t c = std::max<std::int64_t>(0, k - reach); c <= std::min(size[2] - 1, k + reach);
             ++c)
          for (std::int64_t b = std::max<std::int64_t>(0, j - reach); b <= std::min(size[1] - 1, j + reach);
               ++b)
            for (std::int64_t a = std::max<std::int64_t>(0, i - reach); a <= std::min(size[0] - 1, i + reach);
                 ++a)
              near[static_cast<std::size_t>(mask.geometry.offset(a, b, c))] = 1;
      }
  std::vector<std::int64_t> voxels;
  for (std::size_t n = 0; n < near.size(); ++n)
    if (near[n] != 0) voxels.push_back(static_cast<std::int64_t>(n));
  return voxels;
}

/// By which all radii are to be multiplied so that the walls hold as many voxels as the mask.
double volume_scale(const std::vector<MaskVessel>& vessels, const imaging::MaskVolume& mask,
                    std::size_t object, const core::TaskContext& task) {
  const std::vector<std::int64_t> near = voxels_about(mask, 2);
  std::size_t inside = 0;
  for (const Belonging& one : all_belongings(vessels, mask.geometry, near, false, task))
    if (one.beyond_mm < 0.0) ++inside;
  if (inside == 0) return 1.0;
  return std::clamp(std::sqrt(static_cast<double>(object) / static_cast<double>(inside)), 1.0 / scale_limit,
                    scale_limit);
}

}  // namespace

void validate(const MaskWallOptions& options) {
  const auto check = [](double value, double least, double most, const char* name) {
    if (!(value >= least && value <= most))
      throw InvalidInput(std::string("walls of a mask: ") + name + " is " + std::to_string(value) +
                         "; it must be in [" + std::to_string(least) + ", " + std::to_string(most) + "]");
  };
  check(options.even_mm, 0.0, 5.0, "even_mm");
  check(options.voxel_blur, 0.0, 2.0, "voxel_blur");
  check(options.least_radius_mm, 0.05, 2.0, "least_radius_mm");
}

std::vector<lumen::RadialWall> walls_from_mask(const geometry::VesselTree& tree,
                                               const imaging::MaskVolume& lumen,
                                               const MaskWallOptions& options,
                                               const core::TaskContext& task) {
  validate(options);
  const std::vector<std::int64_t> voxels = object_voxels(lumen);
  if (voxels.empty()) throw InvalidInput("walls of a mask: the mask is empty");
  if (tree.vessels.empty()) throw InvalidInput("walls of a mask: the tree has no vessels");
  std::vector<MaskVessel> vessels = vessels_of(tree);
  take_areas(vessels, lumen, voxels, options, task);
  // Once more with walls that are about right: which vessel a voxel belongs to depends on them.
  take_areas(vessels, lumen, voxels, options, task);
  task.set_progress(0.4);
  imaging::FloatVolume inside;
  inside.geometry = lumen.geometry;
  for (const std::uint8_t v : lumen.voxels) inside.voxels.push_back(v != 0 ? 1.0F : 0.0F);
  inside = imaging::gaussian_blurred(inside, options.voxel_blur * lumen.geometry.spacing.maxCoeff(),
                                     task.sub(0.4, 0.5));
  core::parallel_for(vessels.size(), 1, [&](std::size_t i) {
    task.throw_if_cancelled();
    take_shapes(vessels[i], inside, options);
  });
  task.set_progress(0.8);
  const double scale = volume_scale(vessels, lumen, voxels.size(), task);
  std::vector<lumen::RadialWall> walls;
  for (MaskVessel& vessel : vessels) {
    for (double& area : vessel.area_mm2) area *= scale * scale;
    const auto kept = std::make_shared<const MaskVessel>(std::move(vessel));
    walls.emplace_back([kept](double s_mm, double theta) { return kept->radius(s_mm, theta); });
  }
  task.set_progress(1.0);
  return walls;
}

}  // namespace ostia::pipeline
