#include "ostia/evaluation/contour_surface.h"

#include "sampled_distance.h"

#include "ostia/core/error.h"
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
using geometry::Vec3;
using Ring = std::vector<Vec3>;

using std::numbers::pi;

Ring resampled(const Ring& ring, std::size_t count) {
  if (ring.size() == count) return ring;
  Ring closed = ring;
  closed.push_back(ring.front());
  const double length = geometry::length(closed);
  Ring out;
  for (std::size_t i = 0; i < count; ++i)
    out.push_back(
        geometry::at_abscissa(closed, length * static_cast<double>(i) / static_cast<double>(count)).point);
  return out;
}

/// Turned so that its points, centroid on centroid, lie nearest to those of `before`.
Ring aligned(const Ring& ring, const Ring& before) {
  const auto mean = [](const Ring& r) {
    Vec3 sum = Vec3::Zero();
    for (const Vec3& p : r) sum += p;
    return Vec3(sum / static_cast<double>(r.size()));
  };
  const Vec3 shift = mean(before) - mean(ring);
  const std::size_t n = ring.size();
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t turn = 0; turn < n; ++turn) {
    double sum = 0.0;
    for (std::size_t i = 0; i < n && sum < least; ++i)
      sum += (ring[(i + turn) % n] + shift - before[i]).squaredNorm();
    if (sum < least * (1.0 - 1e-9)) {
      least = sum;
      best = turn;
    }
  }
  Ring out;
  for (std::size_t i = 0; i < n; ++i) out.push_back(ring[(i + best) % n]);
  return out;
}

std::vector<Ring> rings_of(const ContourSection& section, int points) {
  std::size_t count = points > 0 ? static_cast<std::size_t>(points) : 0;
  if (count == 0)
    for (const Contour& c : section.contours) count = std::max(count, c.points.size());
  std::vector<Ring> rings;
  for (const Contour& c : section.contours) {
    rings.push_back(resampled(c.points, count));
    if (rings.size() > 1) rings.back() = aligned(rings.back(), rings[rings.size() - 2]);
  }
  return rings;
}

void add_cap(TriMesh& mesh, std::size_t first, std::size_t count, bool reversed) {
  Vec3 centre = Vec3::Zero();
  for (std::size_t i = 0; i < count; ++i) centre += mesh.points[first + i] / static_cast<double>(count);
  const auto middle = static_cast<std::int32_t>(mesh.points.size());
  mesh.points.push_back(centre);
  for (std::size_t i = 0; i < count; ++i) {
    const auto a = static_cast<std::int32_t>(first + i),
               b = static_cast<std::int32_t>(first + (i + 1) % count);
    if (reversed) {
      mesh.triangles.push_back({b, a, middle});
    } else {
      mesh.triangles.push_back({a, b, middle});
    }
  }
}

/// Of a closed line across the vessel the rings stand in the order that contours have: counter-clockwise
/// looking distally, which makes the triangles below outward.
TriMesh ruled(const std::vector<Ring>& rings, bool caps) {
  TriMesh mesh;
  const std::size_t n = rings.front().size();
  for (const Ring& ring : rings) mesh.points.insert(mesh.points.end(), ring.begin(), ring.end());
  for (std::size_t k = 0; k + 1 < rings.size(); ++k) {
    for (std::size_t i = 0; i < n; ++i) {
      const auto a = static_cast<std::int32_t>(k * n + i), b = static_cast<std::int32_t>(k * n + (i + 1) % n);
      const auto c = static_cast<std::int32_t>(a + static_cast<std::int32_t>(n));
      const auto d = static_cast<std::int32_t>(b + static_cast<std::int32_t>(n));
      // The shorter diagonal bends less.
      const auto at = [&](std::int32_t p) { return mesh.points[static_cast<std::size_t>(p)]; };
      if ((at(a) - at(d)).squaredNorm() <= (at(b) - at(c)).squaredNorm()) {
        mesh.triangles.push_back({a, d, b});
        mesh.triangles.push_back({a, c, d});
      } else {
        mesh.triangles.push_back({a, c, b});
        mesh.triangles.push_back({b, c, d});
      }
    }
  }
  if (caps) {
    add_cap(mesh, 0, n, false);
    add_cap(mesh, (rings.size() - 1) * n, n, true);
  }
  return mesh;
}

ContourSection every_second(const ContourSection& section) {
  ContourSection out = section;
  out.contours.clear();
  for (std::size_t i = 0; i < section.contours.size(); i += 2) out.contours.push_back(section.contours[i]);
  return out;
}

ContourSection coarser(const ContourSection& section) {
  ContourSection out = section;
  for (Contour& c : out.contours) {
    Ring half;
    for (std::size_t i = 0; i < c.points.size(); i += 2) half.push_back(c.points[i]);
    if (half.size() >= 3) c.points = half;
  }
  return out;
}

double mean_between(const TriMesh& a, const TriMesh& b) {
  constexpr double sample_mm = 0.25;
  return (distances_to(geometry::AabbTree(a), b, sample_mm, {}) +
          distances_to(geometry::AabbTree(b), a, sample_mm, {}))
      .mean();
}

/// The table's tube: its axis is a circle about z through (ring, 0, 0); it tapers, has a stenosis in its
/// middle and is neither round nor oval across: r(s, theta).
double tube_radius(const FloorOptions& o, double s, double theta) {
  const double along = s / o.length_mm, x = (s - 0.5 * o.length_mm) / o.stenosis_length_mm;
  const double narrowing = std::abs(x) < 0.5 ? 0.5 * o.severity * (1.0 + std::cos(2.0 * pi * x)) : 0.0;
  const double shape = 1.0 + o.oval * std::cos(2.0 * theta) + o.triangular * std::cos(3.0 * theta + 1.0);
  return (o.radius_mm + along * (o.radius_end_mm - o.radius_mm)) * (1.0 - narrowing) * shape;
}

Vec3 tube_point(const FloorOptions& o, double s, double theta) {
  const double angle = s / o.ring_radius_mm;
  const Vec3 out(std::cos(angle), std::sin(angle), 0.0);
  // From outwards to up: counter-clockwise looking distally.
  return o.ring_radius_mm * out +
         tube_radius(o, s, theta) * (std::cos(theta) * out + std::sin(theta) * Vec3::UnitZ());
}

ContourSection tube_section(const FloorOptions& o, double spacing, int points) {
  ContourSection section;
  section.section = "tube";
  const auto count = static_cast<int>(std::round(o.length_mm / spacing)) + 1;
  for (int k = 0; k < count; ++k) {
    Contour contour{spacing * k, {}};
    for (int i = 0; i < points; ++i)
      contour.points.push_back(tube_point(o, contour.s_mm, 2.0 * pi * i / points));
    section.contours.push_back(contour);
  }
  return section;
}

/// Distance from the smooth surface itself: the foot point by Gauss-Newton from the point's own abscissa and
/// angle; points are near the surface, so few steps do.
double tube_distance(const FloorOptions& o, const Vec3& p) {
  constexpr double small = 1e-5;
  constexpr int steps = 6;
  double s = o.ring_radius_mm * std::atan2(p.y(), p.x());
  double theta = std::atan2(p.z(), std::hypot(p.x(), p.y()) - o.ring_radius_mm);
  for (int step = 0; step < steps; ++step) {
    const Vec3 away = p - tube_point(o, s, theta);
    const Vec3 ds = (tube_point(o, s + small, theta) - tube_point(o, s - small, theta)) / (2.0 * small);
    const Vec3 dt = (tube_point(o, s, theta + small) - tube_point(o, s, theta - small)) / (2.0 * small);
    const double ss = ds.dot(ds), st = ds.dot(dt), tt = dt.dot(dt), bs = ds.dot(away), bt = dt.dot(away);
    const double det = ss * tt - st * st;
    s += (tt * bs - st * bt) / det;
    theta += (ss * bt - st * bs) / det;
  }
  return (p - tube_point(o, s, theta)).norm();
}

FloorRow floor_row(const FloorOptions& o, double spacing, int points) {
  const ContourSection section = tube_section(o, spacing, points);
  const TriMesh mesh = surface_of(section);
  FloorRow row{spacing, points, 0.0, 0.0, discretisation_floor_mm(section)};
  double area = 0.0;
  for (const auto& t : mesh.triangles) {
    const Vec3 a = mesh.points[static_cast<std::size_t>(t[0])],
               b = mesh.points[static_cast<std::size_t>(t[1])],
               c = mesh.points[static_cast<std::size_t>(t[2])];
    const double own = 0.5 * (b - a).cross(c - a).norm();
    constexpr int parts = 4;
    double sum = 0.0;
    const auto add = [&](double u, double v) {
      const double d = tube_distance(o, a + u * (b - a) + v * (c - a));
      sum += d;
      row.max_mm = std::max(row.max_mm, d);
    };
    for (int i = 0; i < parts; ++i) {
      for (int j = 0; i + j < parts; ++j) {
        add((i + 1.0 / 3.0) / parts, (j + 1.0 / 3.0) / parts);
        if (i + j + 1 < parts) add((i + 2.0 / 3.0) / parts, (j + 2.0 / 3.0) / parts);
      }
    }
    row.mean_mm += own * sum / (parts * parts);
    area += own;
  }
  row.mean_mm /= area;
  return row;
}

}  // namespace

TriMesh surface_of(const ContourSection& section, const ContourSurfaceOptions& options) {
  if (const auto fault = geometry::find_fault(section))
    throw InvalidInput("section " + section.section + " of " + section.observer + ": " + *fault);
  if (options.points != 0 && options.points < 3)
    throw InvalidInput("a contour needs at least three points, not " + std::to_string(options.points));
  return ruled(rings_of(section, options.points), options.caps);
}

double discretisation_floor_mm(const ContourSection& section) {
  if (section.contours.size() < 3) return 0.0;
  ContourSection odd = section;  // so that every second contour begins and ends where all of them do
  if (odd.contours.size() % 2 == 0) odd.contours.pop_back();
  const TriMesh fine = surface_of(odd), along = surface_of(every_second(odd)),
                around = surface_of(coarser(odd));
  return (mean_between(fine, along) + mean_between(fine, around)) / 3.0;
}

std::vector<FloorRow> floor_table(const FloorOptions& options) {
  std::vector<FloorRow> rows;
  for (const double spacing : options.spacings_mm)
    for (const int points : options.points) rows.push_back(floor_row(options, spacing, points));
  return rows;
}

}  // namespace ostia::evaluation
