#include "ostia/geometry/cage.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace ostia::geometry {
namespace {

constexpr double thinnest_side = 0.1;  // of the longest

int step(int corner, int axis) {
  return corner >> axis & 1;
}

}  // namespace

std::size_t CageGrid::point_count() const {
  const auto n = static_cast<std::size_t>(points_a_side());
  return n * n * n;
}

std::size_t CageGrid::cell_count() const {
  const auto n = static_cast<std::size_t>(cells);
  return n * n * n;
}

Vec3 CageGrid::place(std::int32_t point) const {
  const int n = points_a_side();
  return origin + cell_mm.cwiseProduct(Vec3(point % n, point / n % n, point / n / n));
}

CageCell CageGrid::corners(std::size_t cell) const {
  const auto n = static_cast<std::size_t>(cells);
  const auto i = static_cast<int>(cell % n), j = static_cast<int>(cell / n % n),
             k = static_cast<int>(cell / n / n);
  CageCell corners;
  for (int c = 0; c < 8; ++c)
    corners[static_cast<std::size_t>(c)] = point(i + step(c, 0), j + step(c, 1), k + step(c, 2));
  return corners;
}

CageGrid cage_around(const std::vector<Vec3>& points, int depth, double margin) {
  if (points.empty()) throw InvalidInput("a cage needs points to be around");
  if (depth < 0 || depth > 8)
    throw InvalidInput("a cage of depth " + std::to_string(depth) + " cannot be made: 0 to 8 can");
  if (!(margin >= 0.0 && margin <= 10.0)) throw InvalidInput("a cage's margin must be in [0, 10]");
  Box3 box;
  for (const Vec3& p : points) {
    if (!p.allFinite()) throw InvalidInput("a cage cannot be around points that are not finite");
    box.extend(p);
  }
  const double longest = std::max(box.sizes().maxCoeff(), 1e-6);
  const Vec3 sizes = box.sizes().cwiseMax(thinnest_side * longest) + Vec3::Constant(2.0 * margin * longest);
  CageGrid grid;
  grid.cells = 1 << depth;
  grid.origin = box.center() - sizes / 2.0;
  grid.cell_mm = sizes / grid.cells;
  return grid;
}

CagePoint cage_point(const CageGrid& grid, const Vec3& point) {
  CagePoint result;
  std::uint32_t stride = 1;
  result.weights.fill(1.0);
  for (int axis = 0; axis < 3; ++axis) {
    const double at = std::clamp((point[axis] - grid.origin[axis]) / grid.cell_mm[axis], 0.0,
                                 static_cast<double>(grid.cells));
    const int cell = std::min(static_cast<int>(at), grid.cells - 1);
    result.cell += stride * static_cast<std::uint32_t>(cell);
    stride *= static_cast<std::uint32_t>(grid.cells);
    for (int c = 0; c < 8; ++c)
      result.weights[static_cast<std::size_t>(c)] *= step(c, axis) == 1 ? at - cell : 1.0 - (at - cell);
  }
  return result;
}

Vec3 carried(const CageGrid& grid, const CagePoint& point, const std::vector<Vec3>& control_points) {
  const CageCell corners = grid.corners(point.cell);
  Vec3 sum = Vec3::Zero();
  for (std::size_t c = 0; c < 8; ++c)
    sum += point.weights[c] * control_points[static_cast<std::size_t>(corners[c])];
  return sum;
}

std::vector<Vec3> rest_points(const CageGrid& grid) {
  std::vector<Vec3> points(grid.point_count());
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = grid.place(static_cast<std::int32_t>(i));
  return points;
}

CageGrid refined(const CageGrid& grid) {
  CageGrid fine = grid;
  fine.cells *= 2;
  fine.cell_mm /= 2.0;
  return fine;
}

std::vector<Vec3> refined(const CageGrid& grid, const std::vector<Vec3>& control_points) {
  const CageGrid fine = refined(grid);
  std::vector<Vec3> points(fine.point_count());
  const int n = fine.points_a_side();
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        Vec3 sum = Vec3::Zero();  // over the two neighbours along each axis, which are one at even steps
        for (int c = 0; c < 8; ++c)
          sum += control_points[static_cast<std::size_t>(
              grid.point((i + step(c, 0)) / 2, (j + step(c, 1)) / 2, (k + step(c, 2)) / 2))];
        points[static_cast<std::size_t>(fine.point(i, j, k))] = sum / 8.0;
      }
  return points;
}

std::array<double, 2> jacobian_bounds(const std::array<Vec3, 8>& corners, const Vec3& cell_mm) {
  // Along its own axis a derivative is constant, along the two others linear: the edges' vectors are its
  // Bernstein coefficients. Products of the three are summed with binomial weights.
  std::array<std::array<Vec3, 4>, 3> edges;
  for (int axis = 0; axis < 3; ++axis)
    for (int e = 0; e < 4; ++e) {
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      const int from = (e & 1) << u | (e >> 1) << v;
      edges[static_cast<std::size_t>(axis)][static_cast<std::size_t>(e)] =
          (corners[static_cast<std::size_t>(from | 1 << axis)] - corners[static_cast<std::size_t>(from)]) /
          cell_mm[axis];
    }
  std::array<double, 27> sums{};
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b < 4; ++b) {
      const Vec3 normal = edges[0][static_cast<std::size_t>(a)].cross(edges[1][static_cast<std::size_t>(b)]);
      for (int c = 0; c < 4; ++c) {
        const int x = (b >> 1) + (c & 1);  // x is the second other axis of y, and the first of z
        const int y = (a & 1) + (c >> 1);
        const int z = (a >> 1) + (b & 1);
        sums[static_cast<std::size_t>(x + 3 * (y + 3 * z))] +=
            normal.dot(edges[2][static_cast<std::size_t>(c)]);
      }
    }
  std::array<double, 2> bounds{1e300, -1e300};
  for (std::size_t i = 0; i < 27; ++i) {
    double weight = 1.0;  // 1, 2, 1 along each axis, of products of two linear pieces
    for (const std::size_t at : {i % 3, i / 3 % 3, i / 9}) weight *= at == 1 ? 2.0 : 1.0;
    bounds[0] = std::min(bounds[0], sums[i] / weight);
    bounds[1] = std::max(bounds[1], sums[i] / weight);
  }
  return bounds;
}

}  // namespace ostia::geometry
