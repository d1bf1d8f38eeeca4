#pragma once
/// \file The best place of a point within the faces around it (after Freitag and Ollivier-Gooch 1997).

#include "tetrahedra/complex.h"

#include <vector>

namespace ostia::meshing {

/// Towards the faces and the corners of a cube, unit, k < 14.
geometry::Vec3 search_direction(int k);

/// Tries places around a point, farthest and towards `middle` first. `attempt(place)` moves `p`, which it may
/// refer to, where the place is better, and says whether it did. `reach`: distance to the nearest other
/// point.
template <class Attempt>
void pattern_search(const geometry::Vec3& p, const geometry::Vec3& middle, double reach,
                    const Attempt& attempt) {
  for (const double t : {1.0, 0.5, 0.25})
    if (attempt(p + t * (middle - p))) break;
  for (double step = 0.4 * reach; step > 0.02 * reach; step *= 0.6)
    for (int k = 0; k < 14; ++k) attempt(p + step * search_direction(k));
}

/// Faces around a point, with their corners' coordinates; the worst tetrahedron comes first once known, so
/// that most places are refused after one.
class PointSurroundings {
 public:
  using Id = TetrahedraComplex::Id;
  void clear() { faces_.clear(); }
  void add(const TetrahedraComplex& mesh, const TetrahedraComplex::Face& face);
  bool empty() const { return faces_.empty(); }
  /// Least quality of the tetrahedra that the faces make with p; where it is not above `give_up`, any value
  /// not above that.
  double least_quality(const geometry::Vec3& p, double give_up);
  geometry::Vec3 centroid() const;                ///< of the corners, each as often as it occurs
  double nearest(const geometry::Vec3& p) const;  ///< distance to the corners, mm
  double mean_edge() const;                       ///< of the faces, mm

  /// A pattern search from p. Moves it, and returns the least quality there, `quality` if it did not move.
  double search(geometry::Vec3& p, double quality);

 private:
  std::vector<std::array<geometry::Vec3, 3>> faces_;
};

class TetrahedraSmoothing {
 public:
  explicit TetrahedraSmoothing(TetrahedraComplex& mesh) : mesh_(mesh) {}
  /// Moves an inner point so that the least quality around it grows by more than a little.
  bool improve(TetrahedraComplex::Id v);

 private:
  TetrahedraComplex& mesh_;
  std::vector<TetrahedraComplex::Id> star_;
  PointSurroundings around_;
};

}  // namespace ostia::meshing
