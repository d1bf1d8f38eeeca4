#include "mask/mask_vessels.h"

#include "ostia/core/parallel.h"

#include <algorithm>
#include <cmath>

namespace ostia::pipeline {
namespace {

using geometry::Vec3;
using std::numbers::pi;

constexpr double soon_radii = 5.0, soon_mm = 2.0;  // along both vessels: so soon after a fork they are free
constexpr double steepest = 0.7;                   // of a dent: its depth over the way along the wall
constexpr double spread_mm = 0.25;
constexpr double within_bend = 0.8;  // of a bend's radius
constexpr double bend_look_mm = 0.5;

/// How far two vessels go one way from a common root; 0: they have none.
double shared_mm(const geometry::VesselTree& tree, const geometry::Vessel& a, const geometry::Vessel& b) {
  double mm = 0.0;
  for (std::size_t k = 0; k < std::min(a.segments.size(), b.segments.size()); ++k) {
    if (a.segments[k] != b.segments[k]) break;
    mm += geometry::segment(tree, a.segments[k]).axis.abscissa.back();
  }
  return mm;
}

/// Where a vessel has come free of another after the fork of both.
double free_of(const MaskVessel& one, const MaskVessel& other, double fork_mm, double apart_mm) {
  const double most = soon_radii * (one.mean_radius(fork_mm) + other.mean_radius(fork_mm)) + soon_mm;
  double s = fork_mm;
  for (; s < std::min(fork_mm + most, one.axis->length()); s += mask_ring_mm) {
    const geometry::AxisFoot foot = other.axis->nearest_foot(one.axis->point(s));
    if (foot.rho_mm > one.mean_radius(s) + other.mean_radius(foot.s_mm) + apart_mm) break;
  }
  return s + one.mean_radius(s);
}

class WallParting {
 public:
  WallParting(const std::vector<MaskVessel>& vessels, const geometry::VesselTree& tree, double apart_mm)
      : vessels_(vessels), apart_mm_(apart_mm), common_(vessels.size()) {
    core::parallel_for(vessels.size(), 1, [&](std::size_t i) {
      common_[i].assign(vessels.size(), -1.0);
      for (std::size_t j = 0; j < vessels.size(); ++j) {
        const double fork = i == j ? 0.0 : shared_mm(tree, tree.vessels[i], tree.vessels[j]);
        if (fork > 0.0) common_[i][j] = free_of(vessels[i], vessels[j], fork, apart_mm);
      }
    });
  }

  /// By how much a wall must give way on a ring.
  MaskRing given_up(std::size_t vessel, std::size_t ring) const {
    MaskRing gone{};
    const MaskVessel& one = vessels_[vessel];
    const double s = one.s(ring);
    const Vec3 centre = one.axis->point(s);
    const std::vector<std::size_t> near = others_near(vessel, centre, one.mean_radius(s));
    if (near.empty()) return gone;
    const geometry::Frame frame = one.axis->frame(s);
    for (int k = 0; k < mask_rays; ++k) {
      const double theta = 2.0 * pi * k / mask_rays, whole = one.radius(s, theta);
      const Vec3 direction = geometry::radial_direction(frame, theta);
      const auto room = [&](double r) {  // negative: too near
        const Vec3 at = centre + r * direction;
        double least = 1e9;
        for (const std::size_t j : near) least = std::min(least, beyond(vessel, s, j, at));
        return least - apart_mm_ - (r - whole);
      };
      if (room(whole) >= 0.0) continue;
      double low = std::min(whole, least_wall(one, s)), high = whole;
      for (int step = 0; step < 12; ++step) {
        const double middle = 0.5 * (low + high);
        (room(middle) < 0.0 ? high : low) = middle;
      }
      gone[static_cast<std::size_t>(k)] = whole - low;
    }
    return gone;
  }

 private:
  std::vector<std::size_t> others_near(std::size_t vessel, const Vec3& centre, double radius_mm) const {
    std::vector<std::size_t> near;
    for (std::size_t j = 0; j < vessels_.size(); ++j) {
      if (j == vessel || !vessels_[j].box.contains(centre)) continue;
      for (const geometry::AxisFoot& foot : vessels_[j].axis->feet(centre, mask_reach_mm)) {
        if (foot.s_mm < vessels_[j].own_mm ||
            foot.rho_mm > 1.5 * (radius_mm + vessels_[j].mean_radius(foot.s_mm)) + apart_mm_)
          continue;
        near.push_back(j);
        break;
      }
    }
    return near;
  }
  /// Beyond the wall of another vessel, as far as that is no neighbour along the tree.
  double beyond(std::size_t vessel, double s_mm, std::size_t other, const Vec3& at) const {
    double least = 1e9;
    for (const geometry::AxisFoot& foot : vessels_[other].axis->feet(at, mask_reach_mm)) {
      if (foot.s_mm < vessels_[other].own_mm) continue;
      if (s_mm <= common_[vessel][other] && foot.s_mm <= common_[other][vessel]) continue;
      least = std::min(least, beyond_wall(vessels_[other], foot, false));
    }
    return least;
  }

  const std::vector<MaskVessel>& vessels_;
  double apart_mm_;
  std::vector<std::vector<double>> common_;  // up to where one belongs to its fork with another; -1: to none
};

/// On the inner side of a bend a wall cannot be farther from the axis than the bend's centre: it would fold.
void keep_within_bend(const MaskVessel& vessel, std::size_t ring, MaskRing& gone) {
  const double s = vessel.s(ring);
  Vec3 bend = vessel.axis->curvature_vector(s);
  for (const double at : {s - bend_look_mm, s + bend_look_mm}) {
    const Vec3 there = vessel.axis->curvature_vector(at);
    if (there.squaredNorm() > bend.squaredNorm()) bend = there;
  }
  const geometry::Frame frame = vessel.axis->frame(s);
  for (int k = 0; k < mask_rays; ++k) {
    const double theta = 2.0 * pi * k / mask_rays;
    const double towards = bend.dot(geometry::radial_direction(frame, theta));
    if (towards <= 0.0) continue;
    double& here = gone[static_cast<std::size_t>(k)];
    here = std::max(here, vessel.radius(s, theta) - within_bend / towards);
  }
}

/// Dents run out with a slope that samples of a wall can follow.
std::vector<MaskRing> run_out(const MaskVessel& vessel, const std::vector<MaskRing>& dents) {
  const auto count = static_cast<std::ptrdiff_t>(dents.size());
  std::vector<MaskRing> wide = dents;
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const double arc = 2.0 * pi / mask_rays * vessel.mean_radius(vessel.s(static_cast<std::size_t>(i)));
    for (int k = 0; k < mask_rays; ++k) {
      const double deep = dents[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)];
      if (deep <= 0.0) continue;
      const auto along = static_cast<std::ptrdiff_t>(deep / (steepest * vessel.step_mm));
      const int around = std::min(mask_rays / 2, static_cast<int>(deep / (steepest * arc)));
      for (std::ptrdiff_t j = std::max<std::ptrdiff_t>(0, i - along); j <= std::min(count - 1, i + along);
           ++j)
        for (int n = -around; n <= around; ++n) {
          const double away = std::hypot(vessel.step_mm * static_cast<double>(j - i), arc * n);
          double& there =
              wide[static_cast<std::size_t>(j)][static_cast<std::size_t>((k + n + mask_rays) % mask_rays)];
          there = std::max(there, deep - steepest * away);
        }
    }
  }
  return evened_along<MaskRing>(wide, 0, spread_mm / vessel.step_mm, add_ring, MaskRing{});
}

}  // namespace

void part_walls(std::vector<MaskVessel>& vessels, const geometry::VesselTree& tree, double apart_mm,
                const core::TaskContext& task) {
  const WallParting parting(vessels, tree, apart_mm);
  std::vector<std::vector<MaskRing>> dents(vessels.size());
  core::parallel_for(vessels.size(), 1, [&](std::size_t i) {
    task.throw_if_cancelled();
    for (std::size_t ring = 0; ring < vessels[i].rings(); ++ring) {
      dents[i].push_back(parting.given_up(i, ring));
      keep_within_bend(vessels[i], ring, dents[i].back());
    }
  });
  for (std::size_t i = 0; i < vessels.size(); ++i)
    if (std::any_of(dents[i].begin(), dents[i].end(), [](const MaskRing& ring) {
          return std::any_of(ring.begin(), ring.end(), [](double d) { return d > 0.0; });
        }))
      vessels[i].given_up = run_out(vessels[i], dents[i]);
}

}  // namespace ostia::pipeline
