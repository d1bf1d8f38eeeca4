#include "ostia/evaluation/lumen_scores.h"

#include "sampled_distance.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/evaluation/contour_surface.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/geometry/polyline.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace ostia::evaluation {
namespace {

using geometry::Contour;
using geometry::ContourSection;
using geometry::TriMesh;
using geometry::Vec2;
using geometry::Vec3;

/// What is between the first and the last contour's plane and near the line of the contours' centroids.
struct SectionSpace {
  std::vector<Vec3> axis;
  Vec3 first_normal = Vec3::Zero(), last_normal = Vec3::Zero();
  double reach_mm = 0.0;
  bool holds(const Vec3& p) const {
    if ((p - axis.front()).dot(first_normal) < 0.0 || (p - axis.back()).dot(last_normal) > 0.0) return false;
    return (geometry::closest(axis, p).point - p).norm() <= reach_mm;
  }
};

double largest_radius(const Contour& contour, const Vec3& centre) {
  double largest = 0.0;
  for (const Vec3& p : contour.points) largest = std::max(largest, (p - centre).norm());
  return largest;
}

SectionSpace space_of(const ContourSection& section, double reach_radii) {
  SectionSpace space;
  double largest = 0.0;
  for (const Contour& c : section.contours) {
    space.axis.push_back(contour_centroid(c));
    largest = std::max(largest, largest_radius(c, space.axis.back()));
  }
  space.first_normal = contour_normal(section.contours.front());
  space.last_normal = contour_normal(section.contours.back());
  space.reach_mm = reach_radii * largest + 0.3;
  return space;
}

/// Triangles that come near the section.
TriMesh nearby(const TriMesh& mesh, const SectionSpace& space) {
  geometry::Box3 box;
  for (const Vec3& p : space.axis) {
    box.extend(Vec3(p.array() - space.reach_mm));
    box.extend(Vec3(p.array() + space.reach_mm));
  }
  std::vector<bool> keep;
  keep.reserve(mesh.triangles.size());
  for (const auto& t : mesh.triangles) {
    geometry::Box3 own;
    for (const std::int32_t corner : t) own.extend(mesh.points[static_cast<std::size_t>(corner)]);
    keep.push_back(box.intersects(own));
  }
  return geometry::subset(mesh, keep);
}

struct Interval {
  double from = 0.0, to = 0.0;
};
using Intervals = std::vector<Interval>;

double length_of(const Intervals& all) {
  double sum = 0.0;
  for (const Interval& i : all) sum += i.to - i.from;
  return sum;
}

double shared(const Intervals& a, const Intervals& b) {
  double sum = 0.0;
  for (const Interval& i : a)
    for (const Interval& j : b) sum += std::max(0.0, std::min(i.to, j.to) - std::max(i.from, j.from));
  return sum;
}

/// Where a line v = const runs inside a polygon.
Intervals inside_polygon(const std::vector<Vec2>& polygon, double v) {
  std::vector<double> crossings;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    if ((a.y() <= v) == (b.y() <= v)) continue;
    crossings.push_back(a.x() + (v - a.y()) / (b.y() - a.y()) * (b.x() - a.x()));
  }
  std::sort(crossings.begin(), crossings.end());
  Intervals out;
  for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) out.push_back({crossings[i], crossings[i + 1]});
  return out;
}

/// Whether a point lies behind a wall of the result's own as seen from the axis: it left the lumen before it,
/// so the point belongs to another vessel. The point's own triangle does not count.
bool behind_wall(const geometry::AabbTree& tree, const TriMesh& mesh, const Vec3& axis_point, const Vec3& p) {
  constexpr double before = 1.0 - 1e-6;
  const double distance = (p - axis_point).norm();
  if (!(distance > 0.0)) return false;
  const Vec3 way = (p - axis_point) / distance;
  for (const geometry::RayHit& hit : tree.all_hits(axis_point, way)) {
    if (hit.t >= before * distance) return false;
    const auto& t = mesh.triangles[static_cast<std::size_t>(hit.triangle)];
    const Vec3 a = mesh.points[static_cast<std::size_t>(t[0])];
    const Vec3 n = (mesh.points[static_cast<std::size_t>(t[1])] - a)
                       .cross(mesh.points[static_cast<std::size_t>(t[2])] - a);
    if (n.dot(way) > 0.0) return true;
  }
  return false;
}

/// Where a line runs inside a surface, between -half and half about its middle; by the side that each hit
/// triangle turns to it.
Intervals inside_surface(const geometry::AabbTree& tree, const TriMesh& mesh, const Vec3& middle,
                         const Vec3& along, double half) {
  Intervals out;
  double from = -half;
  bool inside = false, any = false;
  for (const geometry::RayHit& hit : tree.all_hits(middle - half * along, along)) {
    if (hit.t > 2.0 * half) {
      if (!any) {  // what is left behind the window tells whether it begins inside
        const auto& t = mesh.triangles[static_cast<std::size_t>(hit.triangle)];
        const Vec3 a = mesh.points[static_cast<std::size_t>(t[0])];
        const Vec3 n = (mesh.points[static_cast<std::size_t>(t[1])] - a)
                           .cross(mesh.points[static_cast<std::size_t>(t[2])] - a);
        inside = n.dot(along) > 0.0;
      }
      break;
    }
    const auto& t = mesh.triangles[static_cast<std::size_t>(hit.triangle)];
    const Vec3 a = mesh.points[static_cast<std::size_t>(t[0])];
    const Vec3 n = (mesh.points[static_cast<std::size_t>(t[1])] - a)
                       .cross(mesh.points[static_cast<std::size_t>(t[2])] - a);
    const double at = hit.t - half;
    if (n.dot(along) < 0.0) {
      from = at;
      inside = true;
    } else if (inside || !any) {
      out.push_back({from, at});
      inside = false;
    }
    any = true;
  }
  if (inside) out.push_back({from, half});
  return out;
}

struct Areas {
  double reference = 0.0, result = 0.0, both = 0.0;  // mm^2
};

Areas areas_at(const Contour& contour, const geometry::AabbTree& tree, const TriMesh& mesh,
               const LumenScoreOptions& options) {
  const Vec3 centre = contour_centroid(contour), normal = contour_normal(contour);
  const Vec3 u = normal.unitOrthogonal(), v = normal.cross(u);
  std::vector<Vec2> polygon;
  for (const Vec3& p : contour.points) polygon.emplace_back((p - centre).dot(u), (p - centre).dot(v));
  const double reach = options.reach_radii * largest_radius(contour, centre) + 0.3;
  const auto lines = static_cast<int>(std::ceil(reach / options.line_mm));
  Areas areas;
  for (int i = -lines; i < lines; ++i) {
    const double at = (i + 0.5) * options.line_mm;
    const double half = std::sqrt(std::max(0.0, reach * reach - at * at));
    if (half <= 0.0) continue;
    const Intervals a = inside_polygon(polygon, at);
    Intervals b = inside_surface(tree, mesh, centre + at * v, u, half);
    std::erase_if(b, [&](const Interval& piece) {
      const Vec3 middle = centre + at * v + 0.5 * (piece.from + piece.to) * u;
      return behind_wall(tree, mesh, centre, middle);
    });
    areas.reference += options.line_mm * length_of(a);
    areas.result += options.line_mm * length_of(b);
    areas.both += options.line_mm * shared(a, b);
  }
  return areas;
}

void add_overlap(const ContourSection& reference, const geometry::AabbTree& tree, const TriMesh& mesh,
                 const LumenScoreOptions& options, SectionScore& score) {
  const auto& contours = reference.contours;
  std::vector<Areas> areas(contours.size());
  core::parallel_for(contours.size(), 1,
                     [&](std::size_t i) { areas[i] = areas_at(contours[i], tree, mesh, options); });
  Areas volume;
  for (std::size_t i = 0; i < contours.size(); ++i) {
    const double before = i > 0 ? contours[i].s_mm - contours[i - 1].s_mm : 0.0;
    const double after = i + 1 < contours.size() ? contours[i + 1].s_mm - contours[i].s_mm : 0.0;
    const double weight = 0.5 * (before + after);
    volume.reference += weight * areas[i].reference;
    volume.result += weight * areas[i].result;
    volume.both += weight * areas[i].both;
    score.s_mm.push_back(contours[i].s_mm);
    score.reference_radius_mm.push_back(std::sqrt(areas[i].reference / std::numbers::pi));
    score.result_radius_mm.push_back(std::sqrt(areas[i].result / std::numbers::pi));
  }
  score.dice = 2.0 * volume.both / (volume.reference + volume.result);
}

/// Of the radii, along the section: positive where the result is wider.
double mean_difference(const SectionScore& score) {
  double sum = 0.0, length = 0.0;
  for (std::size_t i = 0; i + 1 < score.s_mm.size(); ++i) {
    const double step = score.s_mm[i + 1] - score.s_mm[i];
    const double here = score.result_radius_mm[i] - score.reference_radius_mm[i];
    const double next = score.result_radius_mm[i + 1] - score.reference_radius_mm[i + 1];
    sum += 0.5 * step * (here + next);
    length += step;
  }
  return sum / length;
}

}  // namespace

namespace {

SectionScore named_after(const ContourSection& reference) {
  SectionScore score;
  score.section = reference.section;
  score.vessel = reference.vessel;
  score.observer = reference.observer;
  score.health = reference.health;
  score.length_mm = reference.contours.back().s_mm - reference.contours.front().s_mm;
  return score;
}

/// The result has nothing there: the overlap is none and distances mean nothing.
void mark_missing(SectionScore& score) {
  score.found = false;
  score.dice = 0.0;
  score.msd_mm = score.rms_sd_mm = score.max_sd_mm = score.signed_mean_mm =
      std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

SectionScore score_of_nothing(const ContourSection& reference) {
  SectionScore score = named_after(reference);
  score.floor_mm = discretisation_floor_mm(reference);
  mark_missing(score);
  for (const geometry::Contour& contour : reference.contours) {
    score.s_mm.push_back(contour.s_mm);
    score.reference_radius_mm.push_back(std::sqrt(geometry::contour_area(contour) / std::numbers::pi));
    score.result_radius_mm.push_back(0.0);
  }
  return score;
}

void validate(const LumenScoreOptions& options) {
  if (!(options.sample_mm > 0.0) || !(options.line_mm > 0.0) || !(options.reach_radii >= 1.0))
    throw InvalidInput(
        "scores of a lumen need positive distances of samples and lines, and a reach of at least 1");
}

LumenResult::LumenResult(TriMesh surface) : surface_(std::move(surface)), tree_(surface_) {}

SectionScore LumenResult::score(const ContourSection& reference, const LumenScoreOptions& options,
                                const core::TaskContext& task) const {
  validate(options);
  const TriMesh truth = surface_of(reference);  // throws for a fault
  SectionScore score = named_after(reference);
  score.floor_mm = discretisation_floor_mm(reference);
  add_overlap(reference, tree_, surface_, options, score);
  task.throw_if_cancelled();
  const SectionSpace space = space_of(reference, options.reach_radii);
  const TriMesh near = nearby(surface_, space);
  DistanceSums there;  // from the result
  if (!near.triangles.empty()) {
    const geometry::AabbTree own(near);
    const auto in_section = [&](const Vec3& p) {
      return space.holds(p) && !behind_wall(own, near, geometry::closest(space.axis, p).point, p);
    };
    there = distances_to(geometry::AabbTree(truth), near, options.sample_mm, in_section, task);
  }
  // Nothing of the result lies in the section, or only what belongs to another vessel beside it.
  if (!(there.area > 0.0) || !(score.dice > 0.0)) {
    mark_missing(score);
    return score;
  }
  const DistanceSums both = there + distances_to(tree_, truth, options.sample_mm, {}, task);
  score.msd_mm = both.mean();
  score.rms_sd_mm = std::sqrt(both.squares / both.area);
  score.max_sd_mm = both.max;
  score.signed_mean_mm = mean_difference(score);
  return score;
}

LumenResult result_of(const geometry::ContourSection& section) {
  constexpr double beyond_mm = 0.5;
  geometry::ContourSection longer = section;
  const auto moved = [](geometry::Contour contour, double by_mm) {
    const geometry::Vec3 step = by_mm * geometry::contour_normal(contour);
    contour.s_mm += by_mm;
    for (geometry::Vec3& p : contour.points) p += step;
    return contour;
  };
  longer.contours.insert(longer.contours.begin(), moved(section.contours.front(), -beyond_mm));
  longer.contours.push_back(moved(section.contours.back(), beyond_mm));
  return LumenResult(surface_of(longer, {.caps = true}));
}

LumenSummary summarize(const std::vector<SectionScore>& scores) {
  LumenSummary sum;
  double found_mm = 0.0;
  for (const SectionScore& s : scores) {
    ++sum.sections;
    sum.length_mm += s.length_mm;
    sum.dice += s.length_mm * s.dice;
    if (!s.found) {
      ++sum.missing;
      continue;
    }
    found_mm += s.length_mm;
    sum.msd_mm += s.length_mm * s.msd_mm;
    sum.rms_sd_mm += s.length_mm * s.rms_sd_mm * s.rms_sd_mm;
    sum.max_sd_mm = std::max(sum.max_sd_mm, s.max_sd_mm);
  }
  if (sum.length_mm > 0.0) sum.dice /= sum.length_mm;
  const double none = std::numeric_limits<double>::quiet_NaN();
  sum.msd_mm = found_mm > 0.0 ? sum.msd_mm / found_mm : none;
  sum.rms_sd_mm = found_mm > 0.0 ? std::sqrt(sum.rms_sd_mm / found_mm) : none;
  if (!(found_mm > 0.0)) sum.max_sd_mm = none;
  return sum;
}

double diameter_stenosis(const std::vector<double>& s_mm, const std::vector<double>& radius_mm) {
  if (s_mm.size() != radius_mm.size() || s_mm.size() < 3)
    throw InvalidInput("a stenosis needs radii at three abscissas at least");
  const std::size_t third = std::max<std::size_t>(1, s_mm.size() / 3);
  const auto first = static_cast<std::size_t>(
      std::max_element(radius_mm.begin(), radius_mm.begin() + static_cast<std::ptrdiff_t>(third)) -
      radius_mm.begin());
  const auto last = static_cast<std::size_t>(
      std::max_element(radius_mm.end() - static_cast<std::ptrdiff_t>(third), radius_mm.end()) -
      radius_mm.begin());
  double worst = 0.0;
  for (std::size_t i = 0; i < s_mm.size(); ++i) {
    const double t = (s_mm[i] - s_mm[first]) / (s_mm[last] - s_mm[first]);
    const double healthy = radius_mm[first] + std::clamp(t, 0.0, 1.0) * (radius_mm[last] - radius_mm[first]);
    if (healthy > 0.0) worst = std::max(worst, 1.0 - radius_mm[i] / healthy);
  }
  return std::clamp(worst, 0.0, 1.0);
}

}  // namespace ostia::evaluation
