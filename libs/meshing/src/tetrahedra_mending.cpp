#include "tetrahedra_mending.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace ostia::meshing {

using geometry::Vec3;

namespace {

/// Cosine of the smallest dihedral angle; above 1 the less the volume where it is not positive.
double badness(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const double six_volumes = (b - a).cross(c - a).dot(d - a);
  if (!(six_volumes > 0.0)) return 2.0 - six_volumes;
  // Outward normals of the faces opposite a, b, c, d: a dihedral angle lies between two of them.
  std::array<Vec3, 4> n{(c - b).cross(d - b), (d - a).cross(c - a), (b - a).cross(d - a),
                        (c - a).cross(b - a)};
  for (Vec3& v : n) v.normalize();
  double worst = -1.0;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = i + 1; j < 4; ++j) worst = std::max(worst, -n[i].dot(n[j]));
  return worst;
}

class Mender {
 public:
  explicit Mender(geometry::VolumeMesh& mesh) : mesh_(mesh), fixed_(mesh.points.size(), false) {
    for (const geometry::Triangle& t : mesh.boundary)
      for (const std::int32_t v : t) fixed_[static_cast<std::size_t>(v)] = true;
    first_.assign(mesh.points.size() + 1, 0);
    for (const geometry::Tetrahedron& t : mesh.tetrahedra)
      for (const std::int32_t v : t) ++first_[static_cast<std::size_t>(v) + 1];
    for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
    star_.resize(4 * mesh.tetrahedra.size());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for (std::size_t i = 0; i < mesh.tetrahedra.size(); ++i)
      for (const std::int32_t v : mesh.tetrahedra[i]) star_[next[static_cast<std::size_t>(v)]++] = i;
  }

  double badness_of(std::size_t t) const {
    const geometry::Tetrahedron& k = mesh_.tetrahedra[t];
    return badness(at(k[0]), at(k[1]), at(k[2]), at(k[3]));
  }

  bool improve(std::size_t v) {
    if (fixed_[v]) return false;
    double best = worst_around(v, std::numeric_limits<double>::infinity());
    const double start = best;
    Vec3 centroid = Vec3::Zero();
    double reach = std::numeric_limits<double>::infinity();
    for (std::size_t i = first_[v]; i < first_[v + 1]; ++i)
      for (const std::int32_t w : mesh_.tetrahedra[star_[i]]) {
        centroid += at(w) / (4.0 * static_cast<double>(first_[v + 1] - first_[v]));
        if (static_cast<std::size_t>(w) != v) reach = std::min(reach, (at(w) - mesh_.points[v]).norm());
      }
    auto attempt = [&](const Vec3& place) {
      const Vec3 old = mesh_.points[v];
      mesh_.points[v] = place;
      const double now = worst_around(v, best);
      if (now < best - 1e-7) {
        best = now;
        return true;
      }
      mesh_.points[v] = old;
      return false;
    };
    for (const double t : {1.0, 0.5, 0.25})
      if (attempt(mesh_.points[v] + t * (centroid - mesh_.points[v]))) break;
    for (double step = 0.4 * reach; step > 0.02 * reach; step *= 0.6)
      for (int k = 0; k < 14; ++k) attempt(mesh_.points[v] + step * direction(k));
    return best < start - 1e-6;
  }

 private:
  const Vec3& at(std::int32_t v) const { return mesh_.points[static_cast<std::size_t>(v)]; }
  /// Faces and corners of a cube.
  static Vec3 direction(int k) {
    if (k < 6) return (k % 2 == 0 ? 1.0 : -1.0) * Vec3::Unit(k / 2);
    return Vec3((k & 1) != 0 ? 1.0 : -1.0, ((k - 6) & 2) != 0 ? 1.0 : -1.0, ((k - 6) & 4) != 0 ? 1.0 : -1.0) /
           std::sqrt(3.0);
  }
  double worst_around(std::size_t v, double give_up) const {
    double worst = -1.0;
    for (std::size_t i = first_[v]; i < first_[v + 1] && worst < give_up; ++i)
      worst = std::max(worst, badness_of(star_[i]));
    return worst;
  }

  geometry::VolumeMesh& mesh_;
  std::vector<bool> fixed_;
  std::vector<std::size_t> first_, star_;
};

}  // namespace

std::size_t mend_tetrahedra(geometry::VolumeMesh& mesh, double below_deg, int rounds,
                            const core::TaskContext& task) {
  Mender mender(mesh);
  const double bound = std::cos(below_deg * std::numbers::pi / 180.0);
  std::vector<bool> moved(mesh.points.size(), false);
  for (int round = 0; round < rounds; ++round) {
    std::vector<std::int32_t> points;
    for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
      if (mender.badness_of(t) > bound)
        points.insert(points.end(), mesh.tetrahedra[t].begin(), mesh.tetrahedra[t].end());
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    bool changed = false;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (i % 256 == 0) task.throw_if_cancelled();
      if (mender.improve(static_cast<std::size_t>(points[i]))) {
        moved[static_cast<std::size_t>(points[i])] = true;
        changed = true;
      }
    }
    if (!changed) break;
  }
  return static_cast<std::size_t>(std::count(moved.begin(), moved.end(), true));
}

}  // namespace ostia::meshing
