#include "scene/wall_change.h"

#include <algorithm>

namespace ostia::view {
namespace {

/// Adds each triangle's normal, as long as twice its area, to those of its corners that are wanted.
template <class Wanted>
std::vector<Eigen::Vector3f> summed_normals(const geometry::TriMesh& mesh, const Wanted& wanted) {
  std::vector<Eigen::Vector3f> normals(mesh.points.size(), Eigen::Vector3f::Zero());
  for (const geometry::Triangle& t : mesh.triangles) {
    if (!wanted(t[0]) && !wanted(t[1]) && !wanted(t[2])) continue;
    const geometry::Vec3& a = mesh.points[static_cast<std::size_t>(t[0])];
    const Eigen::Vector3f area = (mesh.points[static_cast<std::size_t>(t[1])] - a)
                                     .cross(mesh.points[static_cast<std::size_t>(t[2])] - a)
                                     .cast<float>();
    for (const std::int32_t corner : t) normals[static_cast<std::size_t>(corner)] += area;
  }
  return normals;
}

Eigen::Vector3f unit(const Eigen::Vector3f& normal) {
  const float length = normal.norm();
  return length > 0.0F ? Eigen::Vector3f(normal / length) : normal;
}

}  // namespace

std::vector<Eigen::Vector3f> smooth_normals(const geometry::TriMesh& mesh) {
  std::vector<Eigen::Vector3f> normals = summed_normals(mesh, [](std::int32_t) { return true; });
  for (Eigen::Vector3f& normal : normals) normal = unit(normal);
  return normals;
}

WallChange change_between(const geometry::TriMesh& before, const geometry::TriMesh& after) {
  const auto &old = before.points, &now = after.points;
  const std::size_t shorter = std::min(old.size(), now.size());
  WallChange change;
  while (change.first < shorter && old[change.first] == now[change.first]) ++change.first;
  std::size_t same = 0;  // at the end
  while (same < shorter - change.first && old[old.size() - 1 - same] == now[now.size() - 1 - same]) ++same;
  change.last = now.size() - same;
  change.shift = static_cast<std::ptrdiff_t>(now.size()) - static_cast<std::ptrdiff_t>(old.size());
  // Between them points that stay are passed over as long as both walls have them.
  std::size_t a = change.first, b = change.first;
  const std::size_t a_end = old.size() - same, b_end = change.last;
  while (a < a_end || b < b_end) {
    if (a < a_end && b < b_end && old[a] == now[b]) {
      ++a, ++b;
      continue;
    }
    if (a < a_end) change.box.extend(old[a++]);
    if (b < b_end) change.box.extend(now[b++]);
  }
  return change;
}

std::vector<char> points_within(const geometry::TriMesh& wall, const geometry::Box3& box) {
  std::vector<char> within(wall.points.size());
  for (std::size_t i = 0; i < within.size(); ++i) within[i] = box.contains(wall.points[i]);
  return within;
}

std::vector<char> triangles_within(const geometry::TriMesh& wall, const geometry::Box3& box) {
  const std::vector<char> point = points_within(wall, box);
  std::vector<char> within(wall.triangles.size());
  for (std::size_t i = 0; i < within.size(); ++i)
    for (const std::int32_t corner : wall.triangles[i]) within[i] |= point[static_cast<std::size_t>(corner)];
  return within;
}

WallPiece piece_within(const geometry::TriMesh& wall, const geometry::Box3& box) {
  const std::vector<char> of_piece = triangles_within(wall, box);
  std::vector<std::int32_t> index(wall.points.size(), -1);
  WallPiece piece;
  for (std::size_t i = 0; i < of_piece.size(); ++i) {
    if (!of_piece[i]) continue;
    geometry::Triangle made{};
    for (std::size_t c = 0; c < 3; ++c) {
      const std::int32_t corner = wall.triangles[i][c];
      std::int32_t& at = index[static_cast<std::size_t>(corner)];
      if (at < 0) {
        at = static_cast<std::int32_t>(piece.points.size());
        piece.points.push_back(corner);
        piece.mesh.points.push_back(wall.points[static_cast<std::size_t>(corner)]);
      }
      made[c] = at;
    }
    piece.mesh.triangles.push_back(made);
  }
  // Points at its border have triangles beyond it, too.
  const std::vector<Eigen::Vector3f> sums =
      summed_normals(wall, [&](std::int32_t point) { return index[static_cast<std::size_t>(point)] >= 0; });
  for (const std::int32_t point : piece.points)
    piece.normals.push_back(unit(sums[static_cast<std::size_t>(point)]));
  return piece;
}

}  // namespace ostia::view
