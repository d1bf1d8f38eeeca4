#include "tetrahedra/smoothing.h"

#include "tetrahedra/quality.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ostia::meshing {

using geometry::Vec3;

Vec3 search_direction(int k) {
  if (k < 6) return (k % 2 == 0 ? 1.0 : -1.0) * Vec3::Unit(k / 2);
  return Vec3((k & 1) != 0 ? 1.0 : -1.0, ((k - 6) & 2) != 0 ? 1.0 : -1.0, ((k - 6) & 4) != 0 ? 1.0 : -1.0) /
         std::sqrt(3.0);
}

void PointSurroundings::add(const TetrahedraComplex& mesh, const TetrahedraComplex::Face& face) {
  faces_.push_back({mesh.point(face[0]), mesh.point(face[1]), mesh.point(face[2])});
}

double PointSurroundings::least_quality(const Vec3& p, double give_up) {
  double least = 1.0;
  for (std::size_t i = 0; i < faces_.size(); ++i) {
    const double q = tetrahedron_quality(faces_[i][0], faces_[i][1], faces_[i][2], p);
    if (q >= least) continue;
    least = q;
    if (q <= give_up) {
      std::swap(faces_[i], faces_[i / 2]);
      return q;
    }
  }
  return least;
}

Vec3 PointSurroundings::centroid() const {
  Vec3 sum = Vec3::Zero();
  for (const auto& f : faces_) sum += f[0] + f[1] + f[2];
  return sum / (3.0 * static_cast<double>(faces_.size()));
}

double PointSurroundings::nearest(const Vec3& p) const {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& f : faces_)
    for (const Vec3& corner : f) least = std::min(least, (corner - p).squaredNorm());
  return std::sqrt(least);
}

double PointSurroundings::mean_edge() const {
  double sum = 0.0;
  for (const auto& f : faces_) sum += (f[1] - f[0]).norm() + (f[2] - f[1]).norm() + (f[0] - f[2]).norm();
  return sum / (3.0 * static_cast<double>(faces_.size()));
}

double PointSurroundings::search(Vec3& p, double quality) {
  constexpr double margin = 1e-7;
  auto attempt = [&](const Vec3& place) {
    const double q = least_quality(place, quality + margin);
    if (!(q > quality + margin)) return false;
    quality = q;
    p = place;
    return true;
  };
  pattern_search(p, centroid(), nearest(p), attempt);
  return quality;
}

bool TetrahedraSmoothing::improve(TetrahedraComplex::Id v) {
  constexpr double worth_it = 1e-4;  // a thirtieth of a degree at ten degrees
  if (mesh_.fixed(v)) return false;
  mesh_.star(v, star_);
  if (star_.empty()) return false;
  around_.clear();
  double before = 1.0;
  for (const TetrahedraComplex::Id t : star_) {
    around_.add(mesh_, mesh_.face(t, mesh_.corner_of(t, v)));
    before = std::min(before, mesh_.quality(t));
  }
  Vec3 place = mesh_.point(v);
  if (!(around_.search(place, before) > before + worth_it)) return false;
  mesh_.move(v, place, star_);
  return true;
}

}  // namespace ostia::meshing
