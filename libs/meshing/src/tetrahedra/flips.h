#pragma once
/// \file Changes of connectivity without new points: removal of edges (Klincsek's programme over the ring
/// around it; the 3-2 and 4-4 flips are its smallest cases) and of faces (2-3 is the smallest). Freitag and
/// Ollivier-Gooch 1997; Shewchuk, Two discrete optimization algorithms for the topological improvement of
/// tetrahedral meshes, 2002.

#include "tetrahedra/complex.h"

#include <array>
#include <vector>

namespace ostia::meshing {

/// Each does its best exchange only where the least quality of the new tetrahedra is above that of the old.
class TetrahedraFlips {
 public:
  using Id = TetrahedraComplex::Id;
  explicit TetrahedraFlips(TetrahedraComplex& mesh) : mesh_(mesh) {}

  /// Removes any of the edges of a tetrahedron, or else any of its faces.
  bool improve(Id t);
  /// Removes the edge a-b of tetrahedron t.
  bool remove_edge(Id t, Id a, Id b);
  /// Removes the face opposite a corner of t, and those beside it that lie between the same two points where
  /// that is better.
  bool remove_face(Id t, std::size_t opposite);

  /// The same without doing it: the best exchange whose tetrahedra are all above `floor`, which is then in
  /// old() and fresh(). False where there is none.
  bool plan_edge_removal(Id t, Id a, Id b, double floor);
  bool plan_face_removal(Id t, std::size_t opposite, double floor);
  const std::vector<Id>& old() const { return old_; }
  const std::vector<TetrahedraComplex::Corners>& fresh() const { return fresh_; }

 private:
  static constexpr std::size_t most_around = 10;
  using Table = std::array<std::array<double, most_around>, most_around>;
  using Choice = std::array<std::array<std::size_t, most_around>, most_around>;

  bool find_ring(Id t, Id a, Id b);
  bool fill_ring(double floor);
  bool open_face(Id t, std::size_t opposite, double floor);
  double triangle_quality(std::size_t i, std::size_t k, std::size_t j, double at_least) const;
  void collect(const Choice& choice, std::size_t i, std::size_t j);
  double open_side(Id top, Id bottom, Id u, Id w);
  double least_quality(const std::vector<Id>& tetrahedra) const;

  TetrahedraComplex& mesh_;
  Id a_ = 0, b_ = 0;
  std::vector<Id> old_, around_;
  std::vector<TetrahedraComplex::Corners> fresh_;
};

}  // namespace ostia::meshing
