#include "edge_table.h"
#include "mesh_checks.h"

#include "ostia/geometry/mesh_topology.h"
#include "ostia/geometry/polygon.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <utility>

namespace ostia::geometry {
namespace {

using detail::HalfEdge;

// The programme takes cubic time: a fifth of a second at this size.
constexpr std::size_t largest_programme = 500;
constexpr double forbidden = std::numeric_limits<double>::infinity();

/// Area, plus a millionth part that settles ties in flat loops for well-shaped triangles and shuns degenerate
/// ones.
double cost(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 u = b - a, v = c - a;
  const double area = 0.5 * u.cross(v).norm();
  const double length2 = u.squaredNorm() + v.squaredNorm() + (v - u).squaredNorm();
  return area + 1e-6 * length2 * length2 / std::max(area, 1e-12 * length2);
}

bool is_edge(const std::vector<HalfEdge>& edges, std::int32_t a, std::int32_t b) {
  const std::pair<std::int32_t, std::int32_t> wanted = std::minmax(a, b);
  const auto ends = [](const HalfEdge& h) { return std::pair(h.low, h.high); };
  return std::ranges::binary_search(edges, wanted, {}, ends);
}

/// Triangulation of least area of a closed polygon (Barequet and Sharir 1995): best(i, j) closes the part
/// from i to j.
class LeastArea {
 public:
  LeastArea(const std::vector<Vec3>& points, const std::vector<std::int32_t>& loop,
            const std::vector<HalfEdge>& edges)
      : size_(loop.size()),
        costs_(size_ * size_, 0.0),
        costs_to_(size_ * size_, 0.0),
        apex_(size_ * size_, 0) {
    std::vector<Vec3> p(size_);
    for (std::size_t i = 0; i < size_; ++i) p[i] = points[static_cast<std::size_t>(loop[i])];
    for (std::size_t width = 2; width < size_; ++width) {
      for (std::size_t i = 0; i + width < size_; ++i) {
        const std::size_t j = i + width;
        double best = forbidden;
        // A diagonal that is an edge of the surface already would carry a third triangle.
        const bool taken = width + 1 < size_ && is_edge(edges, loop[i], loop[j]);
        for (std::size_t k = i + 1; k < j && !taken; ++k) {
          const double parts = costs_[i * size_ + k] + costs_to_[j * size_ + k];
          if (!(parts < best)) continue;
          const double total = parts + cost(p[i], p[k], p[j]);
          if (!(total < best)) continue;
          best = total;
          apex_[i * size_ + j] = static_cast<std::uint16_t>(k);
        }
        costs_[i * size_ + j] = costs_to_[j * size_ + i] = best;
      }
    }
  }

  bool found() const { return costs_[size_ - 1] < forbidden; }

  /// Triangles as places in the loop, first < middle < last.
  std::vector<std::array<std::size_t, 3>> triangles() const {
    std::vector<std::array<std::size_t, 3>> result;
    std::vector<std::pair<std::size_t, std::size_t>> waiting{{0, size_ - 1}};
    while (!waiting.empty()) {
      const auto [i, j] = waiting.back();
      waiting.pop_back();
      if (j - i < 2) continue;
      const std::size_t k = apex_[i * size_ + j];
      result.push_back({i, k, j});
      waiting.emplace_back(k, j);
      waiting.emplace_back(i, k);
    }
    return result;
  }

 private:
  std::size_t size_;
  std::vector<double> costs_, costs_to_;  ///< the second by j and i, so that both are read in a row
  std::vector<std::uint16_t> apex_;
};

void fill_with_fan(TriMesh& mesh, const std::vector<std::int32_t>& loop) {
  Vec3 middle = Vec3::Zero();
  for (const std::int32_t v : loop) middle += mesh.points[static_cast<std::size_t>(v)];
  const auto apex = static_cast<std::int32_t>(mesh.points.size());
  mesh.points.push_back(middle / static_cast<double>(loop.size()));
  for (std::size_t i = 0; i < loop.size(); ++i) {
    mesh.triangles.push_back({loop[(i + 1) % loop.size()], loop[i], apex});
  }
}

std::vector<Triangle> fan_of(std::span<const std::int32_t> corners) {
  std::vector<Triangle> fan;
  for (std::size_t i = 2; i < corners.size(); ++i) fan.push_back({corners[0], corners[i - 1], corners[i]});
  return fan;
}

/// A diagonal of a quadrilateral is the other one only where that is better by more than rounding.
bool fan_is_best(const std::vector<Vec3>& points, std::span<const std::int32_t> q) {
  const auto at = [&](std::size_t i) -> const Vec3& { return points[static_cast<std::size_t>(q[i])]; };
  const double fan = cost(at(0), at(1), at(2)) + cost(at(0), at(2), at(3));
  const double other = cost(at(0), at(1), at(3)) + cost(at(1), at(2), at(3));
  return !(other < (1.0 - 1e-5) * fan);
}

}  // namespace

std::vector<Triangle> triangles_of_polygon(const std::vector<Vec3>& points,
                                           std::span<const std::int32_t> corners) {
  const bool known = std::ranges::all_of(
      corners, [&](std::int32_t c) { return c >= 0 && static_cast<std::size_t>(c) < points.size(); });
  if (corners.size() < 4 || !known) return fan_of(corners);
  if (corners.size() == 4 && fan_is_best(points, corners)) return fan_of(corners);
  if (corners.size() > largest_programme) {
    const std::size_t half = corners.size() / 2;
    std::vector<std::int32_t> rest(corners.begin() + static_cast<std::ptrdiff_t>(half), corners.end());
    rest.push_back(corners[0]);
    std::vector<Triangle> both = triangles_of_polygon(points, corners.first(half + 1));
    const std::vector<Triangle> second = triangles_of_polygon(points, rest);
    both.insert(both.end(), second.begin(), second.end());
    return both;
  }
  const LeastArea programme(points, {corners.begin(), corners.end()}, {});
  if (!programme.found()) return fan_of(corners);
  std::vector<Triangle> result;
  for (const auto& [i, k, j] : programme.triangles()) result.push_back({corners[i], corners[k], corners[j]});
  return result;
}

FilledHoles fill_holes(const TriMesh& mesh) {
  detail::check_indices(mesh, "boundary loops");
  const std::vector<HalfEdge> edges = detail::half_edges(mesh);
  const auto loops = detail::boundary_loops(mesh, edges);
  detail::check_finite(mesh, "hole filling");
  FilledHoles result{mesh, std::vector<std::int32_t>(mesh.triangles.size(), -1)};
  for (std::size_t l = 0; l < loops.size(); ++l) {
    const auto& loop = loops[l];
    bool done = false;
    if (loop.size() >= 3 && loop.size() <= largest_programme) {
      const LeastArea programme(mesh.points, loop, edges);
      done = programme.found();
      if (done) {
        // Against the loop's direction: the border's triangles run along it.
        for (const auto& [i, k, j] : programme.triangles())
          result.mesh.triangles.push_back({loop[j], loop[k], loop[i]});
      }
    }
    if (!done) fill_with_fan(result.mesh, loop);
    result.hole_of_triangle.resize(result.mesh.triangles.size(), static_cast<std::int32_t>(l));
  }
  return result;
}

}  // namespace ostia::geometry
