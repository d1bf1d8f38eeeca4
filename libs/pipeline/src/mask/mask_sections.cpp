#include "mask/mask_sections.h"

#include "ostia/imaging/sampling.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace ostia::pipeline {
namespace {

using geometry::Vec3;
using std::numbers::pi;

constexpr int shape_orders = 3;
constexpr double ray_step_mm = 0.05, longest_ray_mm = 8.0;
constexpr double out_through_branch = 1.5;  // times the ring's median: the ray has left through a branch
constexpr double least_shape = 0.7, most_shape = 1.45;
constexpr double take_off_mm = 1.5;  // from a branch's tube to its own wall
constexpr double ray_bias = 1.25;    // of areas on rays, at most
constexpr double without_voxels_mm = 0.75, gap_look_mm = 1.5;

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
MaskRing low_orders(const MaskRing& ring) {
  MaskRing out{};
  for (int order = 0; order <= shape_orders; ++order) {
    double re = 0.0, im = 0.0;
    for (int k = 0; k < mask_rays; ++k) {
      re += ring[static_cast<std::size_t>(k)] * std::cos(2.0 * pi * order * k / mask_rays);
      im += ring[static_cast<std::size_t>(k)] * std::sin(2.0 * pi * order * k / mask_rays);
    }
    const double scale = (order == 0 ? 1.0 : 2.0) / mask_rays;
    for (int k = 0; k < mask_rays; ++k)
      out[static_cast<std::size_t>(k)] += scale * (re * std::cos(2.0 * pi * order * k / mask_rays) +
                                                   im * std::sin(2.0 * pi * order * k / mask_rays));
  }
  double square = 0.0;
  for (double& r : out) {
    r = std::clamp(r, least_shape, most_shape);
    square += r * r / mask_rays;
  }
  for (double& r : out) r /= std::sqrt(square);
  return out;
}

SeenRing seen_ring(const MaskVessel& vessel, std::size_t i, const imaging::FloatVolume& inside) {
  SeenRing seen;
  const double s = vessel.s(i);
  const geometry::Frame frame = vessel.axis->frame(s);
  std::vector<double> known;
  for (std::size_t k = 0; k < mask_rays; ++k) {
    seen.radius[k] =
        ray_to_edge(inside, vessel.axis->point(s),
                    geometry::radial_direction(frame, 2.0 * pi * static_cast<double>(k) / mask_rays));
    if (seen.radius[k] > 0.0) known.push_back(seen.radius[k]);
  }
  if (known.size() < mask_rays / 2) return seen;
  std::nth_element(known.begin(), known.begin() + static_cast<std::ptrdiff_t>(known.size() / 2), known.end());
  seen.median = known[known.size() / 2];
  seen.known = true;
  for (double& r : seen.radius)
    if (r <= 0.0 || r >= out_through_branch * seen.median) r = seen.median;
  return seen;
}
/// Volume over length, ring by ring, of the voxels that belong to each vessel.
std::vector<std::vector<double>> voxel_areas(const std::vector<MaskVessel>& vessels,
                                             const imaging::MaskVolume& mask,
                                             const std::vector<std::int64_t>& voxels, double most_beyond_mm,
                                             const core::TaskContext& task) {
  const double voxel = mask.geometry.spacing.prod();
  std::vector<std::vector<double>> area;
  for (const MaskVessel& vessel : vessels) area.emplace_back(vessel.rings(), 0.0);
  for (const Belonging& one : all_belongings(vessels, mask.geometry, voxels, true, task)) {
    if (one.vessel < 0 || one.foot.past_end || one.beyond_mm > most_beyond_mm) continue;
    const MaskVessel& vessel = vessels[static_cast<std::size_t>(one.vessel)];
    auto& rings = area[static_cast<std::size_t>(one.vessel)];
    const double x = std::clamp((one.foot.s_mm - vessel.own_mm) / vessel.step_mm, 0.0,
                                static_cast<double>(rings.size() - 1));
    const auto i = std::min(rings.size() - 2, static_cast<std::size_t>(x));
    const double t = x - static_cast<double>(i);
    rings[i] += (1.0 - t) * voxel / vessel.step_mm;
    rings[i + 1] += t * voxel / vessel.step_mm;
  }
  for (std::vector<double>& rings : area) {
    rings.front() *= 2.0;  // half a ring's length
    rings.back() *= 2.0;
  }
  return area;
}

/// Where branches leave, voxels do not tell whose they are: there a parent's area is that of its rays, as
/// much larger or smaller as its areas by voxels are elsewhere.
void take_rays_at_forks(const MaskVessel& vessel, const std::vector<SeenRing>& seen,
                        std::vector<double>& area) {
  const auto on_rays = [&](std::size_t i) {
    double sum = 0.0;
    for (const double r : seen[i].radius) sum += pi * r * r / mask_rays;
    return sum;
  };
  double by_voxels = 0.0, by_rays = 0.0;
  for (std::size_t i = vessel.ring_from(vessel.free_mm); i < area.size(); ++i) {
    if (vessel.at_fork[i] || !seen[i].known) continue;
    by_voxels += area[i];
    by_rays += on_rays(i);
  }
  const double bias = by_rays > 0.0 ? std::clamp(by_voxels / by_rays, 1.0 / ray_bias, ray_bias) : 1.0;
  for (std::size_t i = 0; i < area.size(); ++i)
    if (vessel.at_fork[i] && seen[i].known) area[i] = bias * on_rays(i);
}

/// Rings of a gap that was bridged, or beyond the mask: no voxel for a while to either side, and a little
/// more, because a mask's ends are round.
std::vector<bool> gap_rings(const MaskVessel& vessel, std::size_t first, const std::vector<double>& area) {
  const auto reach = static_cast<std::size_t>(without_voxels_mm / vessel.step_mm);
  const auto about = [&](std::size_t i, std::size_t rings, const auto& holds) {
    for (std::size_t j = i > first + rings ? i - rings : first; j < std::min(area.size(), i + rings + 1); ++j)
      if (!holds(j)) return false;
    return true;
  };
  std::vector<bool> gap(area.size(), false);
  for (std::size_t i = first; i < area.size(); ++i)
    gap[i] = !about(i, 2 * reach, [&](std::size_t j) {
      return !about(j, reach, [&](std::size_t k) { return area[k] <= 0.0; });
    });
  return gap;
}

/// There a vessel is as wide as it is before and behind.
void fill_gaps(const MaskVessel& vessel, std::size_t first, std::vector<double>& area) {
  const std::vector<bool> gap = gap_rings(vessel, first, area);
  const auto reach = static_cast<std::size_t>(gap_look_mm / vessel.step_mm);
  const auto mean = [&](std::size_t from, std::size_t to) {  // of [from, to)
    double sum = 0.0, count = 0.0;
    for (std::size_t k = from; k < to; ++k)
      if (!gap[k]) sum += area[k], count += 1.0;
    return count > 0.0 ? std::optional(sum / count) : std::nullopt;
  };
  for (std::size_t i = first; i < area.size();) {
    if (!gap[i]) {
      ++i;
      continue;
    }
    std::size_t end = i;
    while (end < area.size() && gap[end]) ++end;
    const auto before = mean(i > first + reach ? i - reach : first, i);
    const auto behind = mean(end, std::min(area.size(), end + reach));
    if (before || behind)
      for (std::size_t k = i; k < end; ++k) {
        const double t = static_cast<double>(k + 1 - i) / static_cast<double>(end + 1 - i);
        area[k] = std::max(area[k], (1.0 - t) * before.value_or(behind.value_or(0.0)) +
                                        t * behind.value_or(before.value_or(0.0)));
      }
    i = end;
  }
}

}  // namespace

std::vector<SeenRing> seen_rings(const MaskVessel& vessel, const imaging::FloatVolume& inside) {
  std::vector<SeenRing> rings;
  for (std::size_t i = 0; i < vessel.rings(); ++i) rings.push_back(seen_ring(vessel, i, inside));
  return rings;
}

void take_shapes(MaskVessel& vessel, const std::vector<SeenRing>& seen, const MaskWallOptions& options) {
  for (std::size_t i = 0; i < vessel.rings(); ++i) {
    const double s = vessel.s(i);
    if (s < vessel.free_mm && vessel.free_mm > vessel.own_mm) continue;  // inside its parent: round
    if (!seen[i].known) continue;
    for (std::size_t k = 0; k < mask_rays; ++k) vessel.shape[i][k] = seen[i].radius[k] / seen[i].median;
  }
  vessel.shape =
      evened_along<MaskRing>(vessel.shape, 0, options.even_mm / vessel.step_mm, add_ring, MaskRing{});
  for (MaskRing& ring : vessel.shape) ring = low_orders(ring);
}

void take_areas(std::vector<MaskVessel>& vessels, const std::vector<std::vector<SeenRing>>& seen,
                const imaging::MaskVolume& mask, const std::vector<std::int64_t>& voxels,
                double most_beyond_mm, const MaskWallOptions& options, const core::TaskContext& task) {
  std::vector<std::vector<double>> areas = voxel_areas(vessels, mask, voxels, most_beyond_mm, task);
  for (std::size_t v = 0; v < vessels.size(); ++v) {
    MaskVessel& vessel = vessels[v];
    std::vector<double>& area = areas[v];
    take_rays_at_forks(vessel, seen[v], area);
    const bool branch = vessel.free_mm > vessel.own_mm;
    const std::size_t first = vessel.ring_from(branch ? vessel.free_mm + 0.5 : vessel.own_mm);
    fill_gaps(vessel, first, area);
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

}  // namespace ostia::pipeline
