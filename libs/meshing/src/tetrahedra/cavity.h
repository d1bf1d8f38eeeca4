#pragma once
/// \file Changes that take a point away or add one: contraction of an edge, and insertion of a point into a
/// cavity that grows for as long as its worst tetrahedron asks for it (Klingner and Shewchuk, Aggressive
/// tetrahedral mesh improvement, 2007).

#include "tetrahedra/complex.h"
#include "tetrahedra/smoothing.h"

#include <vector>

namespace ostia::meshing {

class TetrahedraCavity {
 public:
  using Id = TetrahedraComplex::Id;
  explicit TetrahedraCavity(TetrahedraComplex& mesh) : mesh_(mesh) {}

  /// Draws an inner corner of the tetrahedron to another corner.
  bool contract(Id t);
  /// Puts a point into the tetrahedron, or into one of its inner edges. Not where it would come nearer to
  /// others than `nearest_share` of the mean edge around it.
  bool insert(Id t);

 private:
  static constexpr double nearest_share = 0.35;
  static constexpr std::size_t most_tetrahedra = 48;
  struct Wall {
    TetrahedraComplex::Face face;
    Id beyond;
  };
  struct Found {
    double quality = 0.0;
    geometry::Vec3 place;
    std::vector<Id> old;
    std::vector<TetrahedraComplex::Corners> fresh;  // with `none` for the new point
  };

  void begin(const std::vector<Id>& tetrahedra);
  void swallow(Id t);
  void grow(geometry::Vec3 p);
  std::size_t worst_wall(const geometry::Vec3& p, double& quality) const;
  void keep_if_best(const geometry::Vec3& p, double quality);
  bool inside(Id t) const;

  TetrahedraComplex& mesh_;
  std::vector<Id> old_, around_, star_;
  std::vector<TetrahedraComplex::Corners> fresh_;
  std::vector<Wall> walls_;
  PointSurroundings surroundings_;
  Found best_;
};

}  // namespace ostia::meshing
