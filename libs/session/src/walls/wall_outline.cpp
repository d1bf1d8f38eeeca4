#include "walls/wall_outline.h"

#include "ostia/core/error.h"
#include "ostia/lumen/contour_lines.h"
#include "ostia/lumen/views.h"
#include "ostia/reformat/plane.h"

#include <algorithm>
#include <cmath>

namespace ostia::session {
namespace {

using geometry::Contour;
using geometry::Vec2;
using geometry::Vec3;

constexpr double pixel_mm = 0.05;
constexpr double cell_px = 6.0;                         // 0.3 mm: throats are found at their seeds
constexpr double bend_px = 0.1;                         // chords within 5 um of the wall
constexpr double beyond_mm = 3.0, least_side_mm = 6.0;  // how far a wall may lie outside of the contour

reformat::Plane plane_of(const Contour& contour) {
  const Vec3 centre = geometry::contour_centroid(contour), normal = geometry::contour_normal(contour);
  double radius = 0.0;
  for (const Vec3& p : contour.points) radius = std::max(radius, (p - centre).norm());
  const double side = std::max(least_side_mm, 2.0 * (radius + beyond_mm));
  reformat::Plane plane;
  plane.u = normal.unitOrthogonal();
  plane.v = normal.cross(plane.u);
  plane.pixel_mm = pixel_mm;
  plane.width = plane.height = static_cast<int>(std::ceil(side / pixel_mm));
  plane.origin = centre - 0.5 * plane.width * pixel_mm * (plane.u + plane.v);
  return plane;
}

bool is_within(const std::vector<Vec2>& line, const Vec2& p) {
  bool within = false;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Vec2 a = line[i], b = line[i + 1];
    if ((a.y() <= p.y()) == (b.y() <= p.y())) continue;
    if (a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()) > p.x()) within = !within;
  }
  return within;
}

double size_of(const std::vector<Vec2>& line) {
  double twice = 0.0;
  for (std::size_t i = 0; i + 1 < line.size(); ++i)
    twice += line[i].x() * line[i + 1].y() - line[i].y() * line[i + 1].x();
  return std::abs(twice);
}

}  // namespace

std::vector<Vec3> wall_outline(const lumen::ScalarField& wall, const Contour& contour, const Vec3& inside) {
  const reformat::Plane plane = plane_of(contour);
  const Vec2 middle(0.5 * plane.width, 0.5 * plane.height);
  std::vector<Vec2> seeds{middle};
  const Vec2 foot = reformat::project(plane, inside).picture_px;
  const bool foot_seen =
      foot.x() > 0.0 && foot.y() > 0.0 && foot.x() < plane.width && foot.y() < plane.height;
  if (foot_seen) seeds.push_back(foot);
  lumen::ContourLineOptions options;
  options.step_px = cell_px;
  options.bend_px = bend_px;
  const lumen::ContourLine* best = nullptr;
  double largest = 0.0;
  const std::vector<lumen::ContourLine> lines =
      lumen::contour_lines(wall, lumen::view_of(plane), seeds, options);
  for (const lumen::ContourLine& line : lines) {
    if (!line.closed()) continue;
    const bool around = is_within(line.picture_px, middle) || (foot_seen && is_within(line.picture_px, foot));
    const double size = around ? size_of(line.picture_px) : 0.0;
    if (size <= largest) continue;
    largest = size;
    best = &line;
  }
  if (!best || best->world.size() < 4) return {};
  return {best->world.begin(), best->world.end() - 1};
}

}  // namespace ostia::session
