#include "mid_cut.h"

#include "ostia/core/parallel.h"
#include "ostia/geometry/aabb_tree.h"
#include "ostia/geometry/element_centres.h"
#include "ostia/geometry/mixed_mesh_sides.h"
#include "ostia/solver/wall_surface.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

namespace ostia::solver {
namespace {

using geometry::MixedMesh;
using geometry::TriMesh;

/// How much farther the wall in front is than that behind, mm, at the mesh's points: carried there from the
/// elements' centres, which lie inside for certain.
std::vector<double> behind_the_middle(const MixedMesh& mesh, const Vec3& sight,
                                      const core::TaskContext& task) {
  const geometry::AabbTree tree(geometry::boundary_triangles(mesh));
  const std::vector<Vec3> centres = geometry::element_centres(mesh);
  std::vector<double> depth(centres.size());
  core::parallel_for(centres.size(), 512, [&](std::size_t i) {
    if (i % 512 == 0) task.throw_if_cancelled();
    const auto front = tree.first_hit(centres[i], -sight), back = tree.first_hit(centres[i], sight);
    depth[i] = front && back ? front->t - back->t : 0.0;
  });
  return at_mesh_points(mesh, depth, 1);
}

class Cutter {
 public:
  Cutter(const MixedMesh& mesh, const std::vector<double>& depth, const std::vector<double>& values,
         const Vec3& sight, MidCut& cut)
      : mesh_(mesh), depth_(depth), values_(values), sight_(sight), cut_(cut) {}

  void tetrahedron(const geometry::Tetrahedron& t) {
    std::array<std::int32_t, 4> front{}, back{};
    std::size_t fronts = 0, backs = 0;
    for (const std::int32_t p : t) (at(depth_, p) < 0.0 ? front[fronts++] : back[backs++]) = p;
    if (fronts == 0 || backs == 0) return;
    if (fronts == 2) {
      const std::int32_t a = between(front[0], back[0]), b = between(front[0], back[1]),
                         c = between(front[1], back[1]), d = between(front[1], back[0]);
      add(a, b, c);
      add(a, c, d);
    } else {
      const std::int32_t lone = fronts == 1 ? front[0] : back[0];
      const auto& others = fronts == 1 ? back : front;
      add(between(lone, others[0]), between(lone, others[1]), between(lone, others[2]));
    }
  }

 private:
  static double at(const std::vector<double>& values, std::int32_t p) {
    return values[static_cast<std::size_t>(p)];
  }
  /// The point of the cut on an edge: one for all elements about it.
  std::int32_t between(std::int32_t a, std::int32_t b) {
    const auto [place, fresh] = points_.try_emplace(std::minmax({a, b}), cut_.surface.points.size());
    if (fresh) {
      const double share = at(depth_, a) / (at(depth_, a) - at(depth_, b));
      const Vec3& pa = mesh_.points[static_cast<std::size_t>(a)];
      const Vec3& pb = mesh_.points[static_cast<std::size_t>(b)];
      cut_.surface.points.emplace_back(pa + share * (pb - pa));
      at_points_.push_back(at(values_, a) + share * (at(values_, b) - at(values_, a)));
    }
    return static_cast<std::int32_t>(place->second);
  }
  void add(std::int32_t a, std::int32_t b, std::int32_t c) {
    const auto p = [&](std::int32_t i) { return cut_.surface.points[static_cast<std::size_t>(i)]; };
    if ((p(b) - p(a)).cross(p(c) - p(a)).dot(sight_) > 0.0) std::swap(b, c);
    cut_.surface.triangles.push_back({a, b, c});
    cut_.values.push_back((at(at_points_, a) + at(at_points_, b) + at(at_points_, c)) / 3.0);
  }
  const MixedMesh& mesh_;
  const std::vector<double>&depth_, &values_;
  Vec3 sight_;
  MidCut& cut_;
  std::map<std::pair<std::int32_t, std::int32_t>, std::size_t> points_;
  std::vector<double> at_points_;
};

}  // namespace

MidCut mid_cut(const MixedMesh& mesh, const TriMesh& wall, const std::vector<std::int32_t>& wall_points,
               const std::vector<double>& values, const Vec3& sight, const core::TaskContext& task) {
  const std::vector<double> depth = behind_the_middle(mesh, sight.normalized(), task);
  MidCut cut;
  Cutter cutter(mesh, depth, values, sight, cut);
  for (const geometry::Tetrahedron& t : mesh.tetrahedra) cutter.tetrahedron(t);
  for (const geometry::Prism& p : mesh.prisms) {
    cutter.tetrahedron({p[0], p[1], p[2], p[5]});
    cutter.tetrahedron({p[0], p[1], p[5], p[4]});
    cutter.tetrahedron({p[0], p[4], p[5], p[3]});
  }
  cut.behind.points = wall.points;
  for (const geometry::Triangle& t : wall.triangles) {
    double sum = 0.0;
    for (const std::int32_t corner : t)
      sum += depth[static_cast<std::size_t>(wall_points[static_cast<std::size_t>(corner)])];
    if (sum > 0.0) cut.behind.triangles.push_back(t);
  }
  return cut;
}

}  // namespace ostia::solver
