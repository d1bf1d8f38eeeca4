#include "ostia/centerline/lumen_surface.h"
#include "ostia/core/error.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace ostia::centerline {
namespace {

using geometry::TriMesh;
using geometry::Vec3;

using Edge = std::pair<std::int32_t, std::int32_t>;

// Point in the middle of each edge that is too long.
std::map<Edge, std::int32_t> add_midpoints(TriMesh& mesh, double longest_mm) {
  std::map<Edge, std::int32_t> middle;
  const std::size_t triangles = mesh.triangles.size();
  for (std::size_t t = 0; t < triangles; ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const Edge edge = std::minmax({mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3]});
      const Vec3 a = mesh.points[static_cast<std::size_t>(edge.first)];
      const Vec3 b = mesh.points[static_cast<std::size_t>(edge.second)];
      if ((a - b).norm() <= longest_mm) continue;
      if (middle.emplace(edge, static_cast<std::int32_t>(mesh.points.size())).second)
        mesh.points.push_back(0.5 * (a + b));
    }
  return middle;
}

// Cuts off one corner after the other along the middle points of the two edges there; what is left is cut on.
void add_parts(const geometry::Triangle& t, const std::map<Edge, std::int32_t>& middle,
               std::vector<geometry::Triangle>& parts) {
  std::array<std::int32_t, 3> m{};
  int cuts = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto found = middle.find(std::minmax({t[k], t[(k + 1) % 3]}));
    m[k] = found == middle.end() ? -1 : found->second;
    cuts += m[k] >= 0;
  }
  if (cuts == 0) {
    parts.push_back(t);
    return;
  }
  std::size_t first = 0;  // a cut edge; with two of them the one before the other
  while (m[first] < 0 || (cuts == 2 && m[(first + 1) % 3] < 0)) ++first;
  const std::int32_t a = t[first], b = t[(first + 1) % 3], c = t[(first + 2) % 3];
  const std::int32_t ab = m[first], bc = m[(first + 1) % 3], ca = m[(first + 2) % 3];
  if (cuts == 1) {
    parts.insert(parts.end(), {{a, ab, c}, {ab, b, c}});
  } else if (cuts == 2) {
    parts.insert(parts.end(), {{ab, b, bc}, {a, ab, bc}, {a, bc, c}});
  } else {
    parts.insert(parts.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
  }
}

}  // namespace

geometry::TriMesh with_edges_cut(const TriMesh& wall, double longest_mm) {
  if (!(longest_mm > 0.0))
    throw InvalidInput("the longest edge must be positive, not " + std::to_string(longest_mm) + " mm");
  constexpr std::size_t most_points = 4'000'000;
  TriMesh mesh = wall;
  while (mesh.points.size() < most_points) {
    const auto middle = add_midpoints(mesh, longest_mm);
    if (middle.empty()) break;
    std::vector<geometry::Triangle> parts;
    for (const geometry::Triangle& t : mesh.triangles) add_parts(t, middle, parts);
    mesh.triangles = std::move(parts);
  }
  return mesh;
}

}  // namespace ostia::centerline
