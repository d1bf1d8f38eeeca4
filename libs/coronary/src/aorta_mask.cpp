#include "ostia/coronary/aorta_mask.h"

#include "aortic_wall.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

namespace ostia::coronary {
namespace {

constexpr double whole_mm = 1000.0;  // longer than any aorta

/// The wall's stations that may be the nearest of some place in a slab of the image.
struct Candidate {
  std::size_t station = 0;
  Vec3 centre;
  double reach_mm = 0.0;
};

double reach_of(const AorticWall& wall, std::size_t station) {
  double most = 0.0;
  for (std::size_t a = 0; a < wall.angles; ++a) most = std::max(most, wall.radius(station, a));
  return most + wall.step_mm;
}

/// Between the two angles beside it.
double radius_at(const AorticWall& wall, std::size_t station, const Vec3& across) {
  const auto turn = static_cast<double>(wall.angles);
  const double at = geometry::angle_of(wall.frames[station], across) / (2.0 * std::numbers::pi) * turn + turn;
  const double below = std::floor(at), share = at - below;
  const auto a = static_cast<std::size_t>(below) % wall.angles;
  return (1.0 - share) * wall.radius(station, a) + share * wall.radius(station, (a + 1) % wall.angles);
}

bool inside(const AorticWall& wall, const std::vector<Candidate>& near, const Vec3& place) {
  const Candidate* nearest = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const Candidate& one : near) {
    const double squared = (one.centre - place).squaredNorm();
    if (squared >= least) continue;
    least = squared;
    nearest = &one;
  }
  if (nearest == nullptr || least > nearest->reach_mm * nearest->reach_mm) return false;
  const geometry::Frame& frame = wall.frames[nearest->station];
  const Vec3 away = place - nearest->centre;
  const double along = away.dot(frame.tangent);
  // Where the axis bends, planes of neighbouring stations part on the outside: no place between is left out.
  const bool end = nearest->station == 0 || nearest->station + 1 == wall.centres.size();
  if (end && std::abs(along) > 0.5 * wall.step_mm) return false;
  const Vec3 across = away - along * frame.tangent;
  return across.norm() <= radius_at(wall, nearest->station, across);
}

/// Stations whose lumen may reach a row of voxels (i runs along it).
std::vector<Candidate> near_row(const AorticWall& wall, const std::vector<double>& reach,
                                const imaging::Geometry& grid, std::int64_t j, std::int64_t k) {
  const Vec3 from = grid.world(Vec3(0.0, static_cast<double>(j), static_cast<double>(k)));
  const Vec3 along = grid.direction.col(0);
  std::vector<Candidate> near;
  for (std::size_t s = 0; s < wall.centres.size(); ++s) {
    const Vec3 away = wall.centres[s] - from;
    // A little farther than the lumen reaches: the nearest station decides.
    if ((away - away.dot(along) * along).norm() <= 1.5 * reach[s])
      near.push_back({s, wall.centres[s], reach[s]});
  }
  return near;
}

}  // namespace

void validate(const AortaMaskOptions& options) {
  if (!(options.wall_hu >= -100.0 && options.wall_hu <= 150.0))
    throw InvalidInput("mask of the aorta: the wall's intensity is " + std::to_string(options.wall_hu) +
                       " HU; give -100 to 150");
}

imaging::MaskVolume aorta_mask(const imaging::ImageVolume& image, const Aorta& aorta,
                               const AortaMaskOptions& options, const core::TaskContext& task) {
  validate(options);
  if (image.voxels.empty()) throw InvalidInput("mask of the aorta: the image has no voxels");
  if (aorta.stations.size() < 3)
    throw InvalidInput("mask of the aorta: it has " + std::to_string(aorta.stations.size()) +
                       " stations; three are needed");
  const AorticWall wall = aortic_wall(image, aorta, {.upwards_mm = whole_mm, .wall_hu = options.wall_hu});
  std::vector<double> reach;
  for (std::size_t s = 0; s < wall.centres.size(); ++s) reach.push_back(reach_of(wall, s));
  const imaging::Geometry& grid = image.geometry;
  imaging::MaskVolume mask{grid, std::vector<std::uint8_t>(image.voxels.size(), 0)};
  core::parallel_for(static_cast<std::size_t>(grid.size[2]), 1, [&](std::size_t slice) {
    task.throw_if_cancelled();
    const auto k = static_cast<std::int64_t>(slice);
    for (std::int64_t j = 0; j < grid.size[1]; ++j) {
      const std::vector<Candidate> near = near_row(wall, reach, grid, j, k);
      if (near.empty()) continue;
      for (std::int64_t i = 0; i < grid.size[0]; ++i)
        mask(i, j, k) =
            inside(wall, near,
                   grid.world(Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k))))
                ? 1
                : 0;
    }
  });
  return mask;
}

}  // namespace ostia::coronary
