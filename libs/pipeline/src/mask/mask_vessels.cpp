#include "mask/mask_vessels.h"

#include "ostia/core/parallel.h"
#include "ostia/lumen/lumen_model.h"
#include "ostia/pipeline/image_walls.h"

#include <algorithm>
#include <cmath>

namespace ostia::pipeline {
namespace {

using geometry::Vec3;
using std::numbers::pi;

struct RingPlace {
  std::size_t ring = 0;
  double t = 0.0;
};
RingPlace ring_place(const MaskVessel& vessel, double s_mm) {
  const double x =
      std::clamp((s_mm - vessel.own_mm) / vessel.step_mm, 0.0, static_cast<double>(vessel.rings() - 1));
  const auto i = std::min(vessel.rings() - 2, static_cast<std::size_t>(x));
  return {i, x - static_cast<double>(i)};
}

/// Periodic cubic between rays (Catmull-Rom).
double on_ring(const MaskRing& ring, double theta) {
  const double turn = theta / (2.0 * pi), x = (turn - std::floor(turn)) * mask_rays;
  const int k = static_cast<int>(x);
  const double t = x - k, u = 1.0 - t;
  const auto v = [&](int i) {
    return ring[static_cast<std::size_t>((i % mask_rays + mask_rays) % mask_rays)];
  };
  const double mb = 0.5 * (v(k + 1) - v(k - 1)), mc = 0.5 * (v(k + 2) - v(k));
  return u * u * (1.0 + 2.0 * t) * v(k) + t * t * (3.0 - 2.0 * t) * v(k + 1) + t * u * (u * mb - t * mc);
}

/// Marks on each parent where its branches leave.
void mark_forks(std::vector<MaskVessel>& vessels, const geometry::VesselTree& tree) {
  for (std::size_t i = 0; i < vessels.size(); ++i) {
    const MaskVessel& branch = vessels[i];
    if (branch.own_mm <= 0.0) continue;
    const std::int32_t id = lumen::owner_at(tree, tree.vessels[i].id, std::max(0.0, branch.own_mm - 1e-3));
    const auto found = std::find_if(tree.vessels.begin(), tree.vessels.end(),
                                    [&](const geometry::Vessel& v) { return v.id == id; });
    MaskVessel& parent = vessels[static_cast<std::size_t>(found - tree.vessels.begin())];
    const double left = parent.axis->nearest_foot(branch.axis->point(branch.free_mm)).s_mm;
    const double to = std::max(left, branch.own_mm) + 0.5 * branch.axis->radius(branch.free_mm);
    for (std::size_t k = 0; k < parent.rings(); ++k)
      if (parent.s(k) >= branch.own_mm - mask_ring_mm && parent.s(k) <= to) parent.at_fork[k] = true;
  }
}

}  // namespace

double MaskVessel::mean_radius(double s_mm) const {
  const auto [i, t] = ring_place(*this, s_mm);
  return std::sqrt(((1.0 - t) * area_mm2[i] + t * area_mm2[i + 1]) / pi);
}

double MaskVessel::radius(double s_mm, double theta) const {
  const auto [i, t] = ring_place(*this, s_mm);
  const double whole =
      mean_radius(s_mm) * ((1.0 - t) * on_ring(shape[i], theta) + t * on_ring(shape[i + 1], theta));
  const double gone = (1.0 - t) * on_ring(given_up[i], theta) + t * on_ring(given_up[i + 1], theta);
  return gone > 0.0 ? std::max(std::min(whole, least_wall(*this, s_mm)), whole - gone) : whole;
}

std::size_t MaskVessel::ring_from(double s_mm) const {
  return std::min(rings() - 1, static_cast<std::size_t>(std::ceil(std::max(0.0, s_mm - own_mm) / step_mm)));
}

std::vector<MaskVessel> mask_vessels(const geometry::VesselTree& tree) {
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
    const auto steps = std::max(2, static_cast<int>(std::ceil((length - one.own_mm) / mask_ring_mm)));
    one.step_mm = (length - one.own_mm) / steps;
    for (int k = 0; k <= steps; ++k) {
      const double s = one.own_mm + one.step_mm * k, r = axes[i]->radius(s);
      one.area_mm2.push_back(pi * r * r);
      one.box.extend(axes[i]->point(s));
    }
    MaskRing even{};
    one.given_up.assign(one.rings(), even);
    even.fill(1.0);
    one.shape.assign(one.rings(), even);
    one.at_fork.assign(one.rings(), false);
    one.box.extend(Vec3(one.box.min() - Vec3::Constant(mask_reach_mm)));
    one.box.extend(Vec3(one.box.max() + Vec3::Constant(mask_reach_mm)));
    vessels.push_back(std::move(one));
  }
  mark_forks(vessels, tree);
  return vessels;
}

double least_wall(const MaskVessel& vessel, double s_mm) {
  return std::max(0.3, 0.5 * vessel.mean_radius(s_mm));
}

double beyond_wall(const MaskVessel& vessel, const geometry::AxisFoot& foot, bool round) {
  if (foot.past_end || round) return foot.rho_mm - vessel.mean_radius(foot.s_mm);
  return foot.rho_mm - vessel.radius(foot.s_mm, foot.theta);
}

Belonging belonging_of(const std::vector<MaskVessel>& vessels, const Vec3& place, bool round) {
  Belonging best;
  for (std::size_t i = 0; i < vessels.size(); ++i) {
    const MaskVessel& vessel = vessels[i];
    if (!vessel.box.contains(place)) continue;
    for (const geometry::AxisFoot& foot : vessel.axis->feet(place, mask_reach_mm)) {
      if (foot.s_mm < vessel.own_mm) continue;
      const double beyond = beyond_wall(vessel, foot, round);
      if (beyond < best.beyond_mm) best = {static_cast<std::int32_t>(i), foot, beyond};
    }
  }
  return best;
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

Vec3 centre_of_voxel(const imaging::Geometry& grid, std::int64_t n) {
  return grid.world(Vec3(static_cast<double>(n % grid.size[0]),
                         static_cast<double>(n / grid.size[0] % grid.size[1]),
                         static_cast<double>(n / (grid.size[0] * grid.size[1]))));
}

void add_ring(MaskRing& sum, const MaskRing& value, double weight) {
  for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += weight * value[k];
}

}  // namespace ostia::pipeline
