#include "quadratic/projection.h"

#include "ostia/core/parallel.h"

namespace ostia::meshing {

using geometry::Vec3;

namespace {

struct Foot {
  Vec3 point = Vec3::Zero();
  double alignment = 0.0;  // of the reference's normal there with the wall's
};

Foot foot(const WallNode& node, const geometry::TriMesh& reference, const geometry::AabbTree& tree) {
  constexpr int most_rounds = 60;
  Foot result{node.straight, 0.0};
  geometry::SurfacePoint nearest;
  // Alternately on the reference and in the cap's plane: ends on their curve of intersection.
  for (int round = 0; round < most_rounds; ++round) {
    nearest = tree.closest(result.point);
    const double off = node.cap_normal.dot(nearest.point - node.straight);
    const Vec3 next = nearest.point - off * node.cap_normal;
    const double step = (next - result.point).norm();
    result.point = next;
    if (node.cap_normal.isZero() || step <= 1e-13 * node.length) break;
  }
  const geometry::Triangle& t = reference.triangles[static_cast<std::size_t>(nearest.triangle)];
  const Vec3& a = reference.points[static_cast<std::size_t>(t[0])];
  const Vec3 normal = (reference.points[static_cast<std::size_t>(t[1])] - a)
                          .cross(reference.points[static_cast<std::size_t>(t[2])] - a);
  const double size = normal.norm();
  result.alignment = size > 0.0 ? normal.dot(node.normal) / size : 1.0;
  return result;
}

}  // namespace

std::vector<Projection> projections(const std::vector<WallNode>& nodes, const geometry::TriMesh& reference,
                                    const geometry::AabbTree& tree, double max_displacement,
                                    const core::TaskContext& task) {
  constexpr double least_alignment = 0.3;  // cosine: 72 degrees, as in remeshing
  std::vector<Foot> feet(nodes.size());
  core::parallel_chunks(nodes.size(), 512, [&](std::size_t first, std::size_t last) {
    task.throw_if_cancelled();
    for (std::size_t i = first; i < last; ++i) feet[i] = foot(nodes[i], reference, tree);
  });
  double sum = 0.0;
  for (const Foot& f : feet) sum += f.alignment;
  const double sense = sum < 0.0 ? -1.0 : 1.0;  // a reference may look inward as a whole
  std::vector<Projection> result(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Vec3 way = feet[i].point - nodes[i].straight;
    result[i].found =
        way.norm() <= max_displacement * nodes[i].length && sense * feet[i].alignment >= least_alignment;
    if (result[i].found) result[i].displacement = way;
  }
  return result;
}

}  // namespace ostia::meshing
