#include "boundary/boundary_rows.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <queue>
#include <utility>

namespace ostia::segmentation {
namespace {

constexpr int pieces = 4;  // of the line between two rays

double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Catmull-Rom around the ring.
double between(const double* r, int around, int j, double t) {
  const auto at = [&](int i) { return r[(i + around) % around]; };
  const double a = at(j - 1), b = at(j), c = at(j + 1), d = at(j + 2);
  return b + 0.5 * t * ((c - a) + t * ((2.0 * a - 5.0 * b + 4.0 * c - d) + t * (3.0 * (b - c) + d - a)));
}

}  // namespace

Vec2 centroid_of(const double* radius_mm, int around) {
  const double turn = 2.0 * std::numbers::pi / around;
  Vec2 moment = Vec2::Zero();
  double area = 0.0;
  for (int a = 0; a < around; ++a) {
    const double r2 = radius_mm[a] * radius_mm[a];
    moment += r2 * radius_mm[a] / 3.0 * Vec2(std::cos(a * turn), std::sin(a * turn));
    area += 0.5 * r2;
  }
  return moment / area;
}

SeenLine seen_from(const double* radius_mm, int around, const Vec2& centre, double outside_mm) {
  const double turn = 2.0 * std::numbers::pi / around;
  const int n = around * pieces;
  std::vector<Vec2> line(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) {
    const double t = static_cast<double>(i % pieces) / pieces;
    const double theta = (i / pieces + t) * turn;
    line[i] = between(radius_mm, around, i / pieces, t) * Vec2(std::cos(theta), std::sin(theta)) - centre;
  }
  SeenLine out;
  out.radius_mm.assign(static_cast<std::size_t>(around), -1.0);
  out.index.assign(static_cast<std::size_t>(around), 0.0);
  for (int a = 0; a < around; ++a) {
    const Vec2 direction(std::cos(a * turn), std::sin(a * turn));
    for (int i = 0; i < n; ++i) {
      const Vec2& p = line[i];
      const Vec2& q = line[(i + 1) % n];
      const double before = cross(direction, p), after = cross(direction, q);
      if ((before <= 0.0) == (after <= 0.0)) continue;
      const double t = before / (before - after);
      const double r = direction.dot(p + t * (q - p));
      // A line that is no star about the new centre: its outermost crossing, so that all of it is enclosed.
      if (r > out.radius_mm[a]) out.radius_mm[a] = r, out.index[a] = (i + t) / pieces;
    }
    if (out.radius_mm[a] <= outside_mm) {
      out.radius_mm[a] = outside_mm;
      out.index[a] = a;
      out.inside = false;
    }
  }
  return out;
}

void hold_limits(std::vector<double>& radius_mm, int rows, int around_count, double along_mm, double around) {
  // Smallest first: what a settled ray allows its neighbours is final (as in a shortest-path search).
  using Entry = std::pair<double, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (std::size_t n = 0; n < radius_mm.size(); ++n) queue.emplace(radius_mm[n], n);
  const auto lower = [&](std::size_t n, double most) {
    if (radius_mm[n] <= most) return;
    radius_mm[n] = most;
    queue.emplace(most, n);
  };
  while (!queue.empty()) {
    const auto [r, n] = queue.top();
    queue.pop();
    if (r > radius_mm[n]) continue;
    const int row = static_cast<int>(n / around_count), a = static_cast<int>(n % around_count);
    const auto ring = static_cast<std::size_t>(row) * around_count;
    lower(ring + (a + 1) % around_count, r * (1.0 + around));
    lower(ring + (a + around_count - 1) % around_count, r * (1.0 + around));
    if (row > 0) lower(n - around_count, r + along_mm);
    if (row + 1 < rows) lower(n + around_count, r + along_mm);
  }
}

}  // namespace ostia::segmentation
