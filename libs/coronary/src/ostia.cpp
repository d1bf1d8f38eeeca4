#include "ostia/coronary/ostia.h"

#include "aortic_wall.h"

#include "ostia/core/error.h"
#include "ostia/imaging/sampling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <set>
#include <string>

namespace ostia::coronary {
namespace {

// Just beyond the wall: half the blur of an edge and what the median leaves.
constexpr double beyond_mm = 1.5;
constexpr double looked_at_mm = 20.0;

using Index = std::array<std::int64_t, 3>;

/// A bright patch of the unrolled wall.
struct Spot {
  std::vector<std::pair<std::size_t, std::size_t>> cells;  // station, angle
  double area_mm2 = 0.0, hu = 0.0;
  Vec3 place = Vec3::Zero();  // mean, on the wall
};

double cell_area(const AorticWall& wall, std::size_t station, std::size_t a) {
  return wall.step_mm * wall.radius(station, a) * 2.0 * std::numbers::pi / static_cast<double>(wall.angles);
}

std::vector<Spot> bright_spots(const imaging::ImageVolume& image, const AorticWall& wall, double level) {
  const std::size_t rows = wall.centres.size(), turn = wall.angles;
  std::vector<double> value(rows * turn);
  for (std::size_t s = 0; s < rows; ++s)
    for (std::size_t a = 0; a < turn; ++a) {
      const Vec3 at = wall.place(s, a, beyond_mm);
      value[s * turn + a] =
          image.geometry.contains(at) ? imaging::sample(image, at) : -std::numeric_limits<double>::infinity();
    }
  std::vector<char> seen(value.size(), 0);
  std::vector<Spot> spots;
  for (std::size_t start = 0; start < value.size(); ++start) {
    if (seen[start] || value[start] < level) continue;
    Spot spot;
    std::vector<std::size_t> front{start};
    seen[start] = 1;
    const auto visit = [&](std::size_t cell) {
      if (seen[cell] || value[cell] < level) return;
      seen[cell] = 1;
      front.push_back(cell);
    };
    while (!front.empty()) {
      const std::size_t cell = front.back(), s = cell / turn, a = cell % turn;
      front.pop_back();
      spot.cells.emplace_back(s, a);
      const double area = cell_area(wall, s, a);
      spot.area_mm2 += area;
      spot.hu += area * value[cell];
      spot.place += area * wall.place(s, a, 0.0);
      if (s > 0) visit(cell - turn);
      if (s + 1 < rows) visit(cell + turn);
      visit(s * turn + (a + 1) % turn);
      visit(s * turn + (a + turn - 1) % turn);
    }
    spot.hu /= spot.area_mm2;
    spot.place /= spot.area_mm2;
    spots.push_back(std::move(spot));
  }
  return spots;
}

/// How far outside the wall a place lies; negative inside. Beyond the wall's ends there is no inside.
double outside(const AorticWall& wall, const Vec3& place) {
  std::size_t near = 0;
  for (std::size_t s = 1; s < wall.centres.size(); ++s)
    if ((wall.centres[s] - place).squaredNorm() < (wall.centres[near] - place).squaredNorm()) near = s;
  const Vec3 away = place - wall.centres[near];
  const Vec3 across = away - away.dot(wall.frames[near].tangent) * wall.frames[near].tangent;
  if (std::abs((away - across).norm()) > 2.0 * wall.step_mm) return looked_at_mm;
  const double turn = static_cast<double>(wall.angles);
  const double at = geometry::angle_of(wall.frames[near], across) / (2.0 * std::numbers::pi) * turn;
  const auto a = static_cast<std::size_t>(std::lround(at + turn)) % wall.angles;
  return across.norm() - wall.radius(near, a);
}

/// What is bright outside the wall and hangs together with the spot, within a ball.
struct Growth {
  double volume_mm3 = 0.0, reach_mm = 0.0;
  Vec3 towards = Vec3::Zero();  // mean direction of its first millimetres
};

Growth grown_from(const imaging::ImageVolume& image, const AorticWall& wall, const Spot& spot, double level,
                  double largest_mm3) {
  const imaging::Geometry& grid = image.geometry;
  const double voxel_mm3 = grid.spacing.prod();
  std::set<Index> seen;
  std::vector<Index> front;
  Growth growth;
  const auto visit = [&](const Index& index) {
    for (std::size_t k = 0; k < 3; ++k)
      if (index[k] < 0 || index[k] >= grid.size[k]) return;
    if (image(index[0], index[1], index[2]) < level) return;
    const Vec3 place = grid.world(
        Vec3(static_cast<double>(index[0]), static_cast<double>(index[1]), static_cast<double>(index[2])));
    const double away = (place - spot.place).norm();
    if (away > looked_at_mm || seen.contains(index) || outside(wall, place) < 0.75) return;
    seen.insert(index);
    front.push_back(index);
    growth.reach_mm = std::max(growth.reach_mm, away);
    if (away < 5.0) growth.towards += (place - spot.place) / std::max(away, 1.0);
  };
  for (const auto& [s, a] : spot.cells) {
    const Vec3 at = grid.index(wall.place(s, a, beyond_mm));
    visit({std::lround(at.x()), std::lround(at.y()), std::lround(at.z())});
  }
  while (!front.empty() && growth.volume_mm3 <= largest_mm3) {
    const Index index = front.back();
    front.pop_back();
    growth.volume_mm3 += voxel_mm3;
    for (std::size_t k = 0; k < 3; ++k)
      for (const std::int64_t step : {-1, 1}) {
        Index next = index;
        next[k] += step;
        visit(next);
      }
  }
  return growth;
}

void check_ostium_search_option(const char* name, double value, double low, double high, const char* unit) {
  if (!(value >= low && value <= high))
    throw InvalidInput(std::string("search for ostia: ") + name + " is " + std::to_string(value) + unit +
                       "; give " + std::to_string(low) + " to " + std::to_string(high));
}

}  // namespace

void validate(const OstiaOptions& options) {
  check_ostium_search_option("the stretch of aorta", options.upwards_mm, 10.0, 120.0, " mm");
  check_ostium_search_option("the wall's intensity", options.wall_hu, -100.0, 150.0, " HU");
  check_ostium_search_option("the level", options.level, 0.3, 0.8, "");
  check_ostium_search_option("the smallest radius", options.smallest_radius_mm, 0.3, 2.0, " mm");
  check_ostium_search_option("the largest radius", options.largest_radius_mm, options.smallest_radius_mm, 8.0,
                             " mm");
  check_ostium_search_option("the least reach", options.least_reach_mm, 3.0, 30.0, " mm");
  check_ostium_search_option("the largest section", options.largest_section_mm2, 5.0, 200.0, " mm2");
}

std::vector<Ostium> find_ostia(const imaging::ImageVolume& image, const Aorta& aorta,
                               const OstiaOptions& options, const core::TaskContext& task) {
  validate(options);
  if (aorta.stations.size() < 3)
    throw InvalidInput("search for ostia: the aorta has " + std::to_string(aorta.stations.size()) +
                       " stations; three are needed");
  const AorticWall wall =
      aortic_wall(image, aorta, {.upwards_mm = options.upwards_mm, .wall_hu = options.wall_hu});
  const double level = options.wall_hu + options.level * (aorta.lumen_hu - options.wall_hu);
  std::vector<Ostium> found;
  for (const Spot& spot : bright_spots(image, wall, level)) {
    task.throw_if_cancelled();
    const double radius = std::sqrt(spot.area_mm2 / std::numbers::pi);
    if (radius < options.smallest_radius_mm || radius > options.largest_radius_mm) continue;
    const Growth growth = grown_from(image, wall, spot, level, options.largest_section_mm2 * looked_at_mm);
    if (growth.reach_mm < options.least_reach_mm) continue;
    Ostium ostium;
    ostium.place = spot.place;
    ostium.direction = growth.towards.normalized();
    ostium.radius_mm = radius;
    ostium.hu = spot.hu;
    ostium.reach_mm = growth.reach_mm;
    ostium.section_mm2 = growth.volume_mm3 / growth.reach_mm;
    ostium.height_mm = wall.step_mm * static_cast<double>(spot.cells[spot.cells.size() / 2].first);
    if (ostium.section_mm2 <= options.largest_section_mm2) found.push_back(ostium);
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Ostium& a, const Ostium& b) { return a.section_mm2 < b.section_mm2; });
  return found;
}

}  // namespace ostia::coronary
