#include "start/start_walls.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostia::lumen {
namespace {

using std::numbers::pi;
constexpr double ring_step_mm = 0.25;
constexpr int rays_around = 32;
// A ray that runs so many times farther than the median of the rings about it has left through a side branch:
// an axis half a radius beside the middle still sees its own wall. The limit by the axis' radius is wider.
constexpr double ring_limit = 1.45, axis_limit = 2.5;
constexpr double window_mm = 3.0;

struct Rays {
  WallTable wall;
  std::vector<char> found;
  static std::size_t index(int ring, int k) {
    return static_cast<std::size_t>(ring * rays_around + (k % rays_around + rays_around) % rays_around);
  }
  char& known(int ring, int k) { return found[index(ring, k)]; }
};

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The first crossing, if the ray goes out of the surface there.
std::optional<double> crossing(const geometry::TriMesh& surface, const geometry::AabbTree& shells,
                               const Vec3& from, const Vec3& direction) {
  const auto hit = shells.first_hit(from, direction);
  if (!hit) return std::nullopt;
  const geometry::Triangle& t = surface.triangles[static_cast<std::size_t>(hit->triangle)];
  const Vec3 &a = surface.points[static_cast<std::size_t>(t[0])],
             &b = surface.points[static_cast<std::size_t>(t[1])],
             &c = surface.points[static_cast<std::size_t>(t[2])];
  if ((b - a).cross(c - a).dot(direction) <= 0.0) return std::nullopt;
  return hit->t;
}

Rays cast(const StartVessel& start, const geometry::TriMesh& surface, const geometry::AabbTree& shells,
          const core::TaskContext& task) {
  const double length = start.axis->length() - start.own_from_mm;
  const int cells = std::max(4, static_cast<int>(std::ceil(length / ring_step_mm)));
  const double step = length / cells;
  Rays rays{WallTable(start.own_from_mm, step, cells + 1, rays_around), {}};
  rays.found.assign(static_cast<std::size_t>((cells + 1) * rays_around), 0);
  for (int ring = 0; ring <= cells; ++ring) {
    task.throw_if_cancelled();
    // On the end itself a ray would run along the rim of an open surface.
    const double s =
        std::clamp(rays.wall.s(ring), start.own_from_mm + 0.2 * step, start.axis->length() - 0.2 * step);
    const geometry::Frame frame = start.axis->frame(s);
    for (int k = 0; k < rays_around; ++k) {
      const Vec3 direction = geometry::radial_direction(frame, 2.0 * pi * k / rays_around);
      const auto t = crossing(surface, shells, start.axis->point(s), direction);
      rays.known(ring, k) = t && *t > 1e-3 && *t < axis_limit * start.radius.at(s);
      rays.wall.at(ring, k) = t.value_or(start.radius.at(s));
    }
  }
  return rays;
}

/// Forgets what has left through a side branch, and what stands right beside it: an opening's edge.
void forget_outliers(Rays& rays, double step_mm) {
  const int reach = std::max(1, static_cast<int>(std::lround(window_mm / step_mm)));
  const int last_ring = rays.wall.rings() - 1;
  std::vector<char> kept = rays.found;
  std::vector<double> near;
  for (int ring = 0; ring <= last_ring; ++ring) {
    near.clear();
    for (int i = std::max(0, ring - reach); i <= std::min(last_ring, ring + reach); ++i) {
      for (int k = 0; k < rays_around; ++k) {
        if (rays.known(i, k)) near.push_back(rays.wall.at(i, k));
      }
    }
    if (near.empty()) continue;
    const double limit = ring_limit * median(near);
    for (int k = 0; k < rays_around; ++k) {
      if (!rays.known(ring, k) || rays.wall.at(ring, k) <= limit) continue;
      for (int i = std::max(0, ring - 1); i <= std::min(last_ring, ring + 1); ++i) {
        for (int j = k - 1; j <= k + 1; ++j) kept[rays.index(i, j)] = 0;
      }
    }
  }
  rays.found = std::move(kept);
}

/// What was not found becomes the smoothest continuation of what was (Laplace's equation by relaxation).
void fill(Rays& rays, const StartVessel& start) {
  if (std::none_of(rays.found.begin(), rays.found.end(), [](char c) { return c != 0; })) {
    for (int ring = 0; ring < rays.wall.rings(); ++ring) {
      for (int k = 0; k < rays_around; ++k) rays.wall.at(ring, k) = start.radius.at(rays.wall.s(ring));
    }
    return;
  }
  // Relative to the axis' radius, so that a long gap is filled by the tube scaled as its ends ask.
  const auto radius = [&](int ring) { return start.radius.at(rays.wall.s(ring)); };
  for (int ring = 0; ring < rays.wall.rings(); ++ring) {
    for (int k = 0; k < rays_around; ++k) {
      if (!rays.known(ring, k)) rays.wall.at(ring, k) = radius(ring);
    }
  }
  const int last = rays.wall.rings() - 1;
  for (int sweep = 0; sweep < 200; ++sweep) {
    double moved = 0.0;
    for (int ring = 0; ring <= last; ++ring) {
      const int before = std::max(0, ring - 1), after = std::min(last, ring + 1);
      for (int k = 0; k < rays_around; ++k) {
        if (rays.known(ring, k)) continue;
        const double share =
            0.25 * (rays.wall.at(before, k) / radius(before) + rays.wall.at(after, k) / radius(after) +
                    (rays.wall.at(ring, k - 1) + rays.wall.at(ring, k + 1)) / radius(ring));
        moved = std::max(moved, std::abs(share * radius(ring) - rays.wall.at(ring, k)));
        rays.wall.at(ring, k) = share * radius(ring);
      }
    }
    if (moved < 1e-4) break;
  }
}

/// One pass of [1 2 1] / 4 along and around: the facets' edges go, the wall stays.
WallTable evened(const WallTable& wall) {
  WallTable along = wall;
  for (int ring = 1; ring + 1 < wall.rings(); ++ring) {
    for (int k = 0; k < wall.around(); ++k)
      along.at(ring, k) = 0.25 * (wall.at(ring - 1, k) + 2.0 * wall.at(ring, k) + wall.at(ring + 1, k));
  }
  WallTable result = along;
  for (int ring = 0; ring < wall.rings(); ++ring) {
    for (int k = 0; k < wall.around(); ++k)
      result.at(ring, k) = 0.25 * (along.at(ring, k - 1) + 2.0 * along.at(ring, k) + along.at(ring, k + 1));
  }
  return result;
}

}  // namespace

WallTable::WallTable(double from_mm, double step_mm, int rings, int around)
    : from_(from_mm),
      step_(step_mm),
      rings_(rings),
      around_(around),
      values_(static_cast<std::size_t>(rings) * static_cast<std::size_t>(around), 0.0) {}

double WallTable::operator()(double s_mm, double theta) const {
  const auto cubic = [](double a, double b, double c, double d, double t) {  // Catmull-Rom between b and c
    const double mb = 0.5 * (c - a), mc = 0.5 * (d - b), u = 1.0 - t;
    return u * u * (1.0 + 2.0 * t) * b + t * t * (3.0 - 2.0 * t) * c + t * u * (u * mb - t * mc);
  };
  const double turn = theta / (2.0 * pi);
  const double x = (turn - std::floor(turn)) * around_;
  const int k = static_cast<int>(x);
  const auto ring_value = [&](int ring) {
    return cubic(at(ring, k - 1), at(ring, k), at(ring, k + 1), at(ring, k + 2), x - k);
  };
  const auto value = [&](int ring) {  // beyond the ends it runs straight on
    if (ring < 0) return 2.0 * ring_value(0) - ring_value(1);
    if (ring >= rings_) return 2.0 * ring_value(rings_ - 1) - ring_value(rings_ - 2);
    return ring_value(ring);
  };
  const double y = std::clamp((s_mm - from_) / step_, 0.0, static_cast<double>(rings_ - 1));
  const int i = std::min(rings_ - 2, static_cast<int>(y));
  return cubic(value(i - 1), value(i), value(i + 1), value(i + 2), y - i);
}

RadialWall wall_on_surface(const StartVessel& start, const geometry::TriMesh& surface,
                           const geometry::AabbTree& shells, const core::TaskContext& task) {
  Rays rays = cast(start, surface, shells, task);
  forget_outliers(rays, rays.wall.s(1) - rays.wall.s(0));
  fill(rays, start);
  const auto wall = std::make_shared<const WallTable>(evened(rays.wall));
  return [wall](double s, double theta) { return std::max(0.1, (*wall)(s, theta)); };
}

}  // namespace ostia::lumen
