#include "vertex_clustering.h"

#include "ostia/geometry/mesh_topology.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace ostia::motion {
namespace {

using geometry::TriMesh;
using geometry::Vec3;

/// The cube of each point, numbered in the order of their first points.
struct Cubes {
  std::vector<std::int32_t> of_point;
  std::int32_t count = 0;
};
Cubes cubes_of(const std::vector<Vec3>& points, double side_mm) {
  std::map<std::array<std::int64_t, 3>, std::int32_t> numbers;
  Cubes cubes;
  for (const Vec3& p : points) {
    std::array<std::int64_t, 3> key{};
    for (int axis = 0; axis < 3; ++axis)
      key[static_cast<std::size_t>(axis)] = static_cast<std::int64_t>(std::floor(p[axis] / side_mm));
    const auto [at, is_new] = numbers.try_emplace(key, cubes.count);
    if (is_new) ++cubes.count;
    cubes.of_point.push_back(at->second);
  }
  return cubes;
}

/// For each cube the point nearest to the mean of its points.
std::vector<Vec3> middle_points(const std::vector<Vec3>& points, const Cubes& cubes) {
  const auto n = static_cast<std::size_t>(cubes.count);
  std::vector<Vec3> means(n, Vec3::Zero());
  std::vector<double> counts(n, 0.0), nearest(n, std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto cube = static_cast<std::size_t>(cubes.of_point[i]);
    means[cube] += points[i];
    counts[cube] += 1.0;
  }
  for (std::size_t k = 0; k < n; ++k) means[k] /= counts[k];
  std::vector<Vec3> middle(n);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto cube = static_cast<std::size_t>(cubes.of_point[i]);
    const double distance = (points[i] - means[cube]).squaredNorm();
    if (distance >= nearest[cube]) continue;
    nearest[cube] = distance;
    middle[cube] = points[i];
  }
  return middle;
}

}  // namespace

TriMesh clustered(const TriMesh& mesh, std::size_t most_points) {
  if (mesh.points.size() <= most_points) return mesh;
  // A surface passes through about 1.5 cubes for each square of their side.
  const double side = std::sqrt(1.5 * geometry::area(mesh) / static_cast<double>(most_points));
  if (!(side > 0.0)) return mesh;
  const Cubes cubes = cubes_of(mesh.points, side);
  TriMesh thin;
  thin.points = middle_points(mesh.points, cubes);
  std::set<geometry::Triangle> seen;
  for (const geometry::Triangle& t : mesh.triangles) {
    geometry::Triangle coarse{};
    for (std::size_t k = 0; k < 3; ++k) coarse[k] = cubes.of_point[static_cast<std::size_t>(t[k])];
    if (coarse[0] == coarse[1] || coarse[1] == coarse[2] || coarse[2] == coarse[0]) continue;
    geometry::Triangle sorted = coarse;
    std::sort(sorted.begin(), sorted.end());
    if (seen.insert(sorted).second) thin.triangles.push_back(coarse);
  }
  return thin;
}

}  // namespace ostia::motion
