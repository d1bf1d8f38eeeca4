#pragma once
/// \file Faces between tetrahedra made more orthogonal to the line between their centres, which finite
/// volumes want (OpenFOAM's non-orthogonality). See docs/methods/tetrahedra.md.

#include "tetrahedra/complex.h"
#include "tetrahedra/flips.h"

#include "ostia/core/task_context.h"
#include "ostia/meshing/tetrahedralize.h"

#include <array>
#include <vector>

namespace ostia::meshing {

class TetrahedraOrthogonality {
 public:
  using Id = TetrahedraComplex::Id;
  /// No tetrahedron gets a quality (tetrahedra_quality.h) below `least_quality`; where there is
  /// one below it already, none below that.
  TetrahedraOrthogonality(TetrahedraComplex& mesh, double least_quality)
      : mesh_(mesh), least_quality_(least_quality), flips_(mesh) {}

  /// Cosine of the angle between the normal of the face opposite a corner and the line from the one
  /// tetrahedron's centre to the other's: 1 is best; 1 at the boundary.
  double cosine(Id t, std::size_t opposite) const;
  /// Moves a point of the two tetrahedra at the face, or else removes the face or one of its edges, or else
  /// adds a point to one of its edges, so that the least cosine of what changes grows by more than a little.
  bool improve(Id t, std::size_t opposite, MendingReport& report);

 private:
  /// A face with a tetrahedron on either side. One of its five points may be the one that moves.
  struct Pair {
    TetrahedraComplex::Face face;  ///< seen from the first
    Id first, second;              ///< the points opposite
  };
  Pair pair(Id t, std::size_t opposite, Id other) const;
  double cosine(const Pair& pair, Id moved, const geometry::Vec3& p) const;
  void gather(Id v);
  double least_cosine(Id v, const geometry::Vec3& p, double give_up) const;
  bool keeps_quality(const geometry::Vec3& p, double floor) const;
  bool move(Id v);
  double least_cosine(const std::vector<Id>& cavity,
                      const std::vector<TetrahedraComplex::Corners>& tetrahedra) const;
  bool flip(Id t, std::size_t opposite);
  bool insert(Id t, std::size_t opposite);
  double worth_of(const geometry::Vec3& p, Id v, const std::vector<Id>& old,
                  const std::vector<TetrahedraComplex::Corners>& fresh, double floor);

  TetrahedraComplex& mesh_;
  double least_quality_;
  TetrahedraFlips flips_;
  std::size_t added_ = 0;  // points
  std::vector<Id> star_;
  std::vector<Pair> pairs_;                    // whose cosines change when the point moves
  std::vector<TetrahedraComplex::Face> hull_;  // around the point
};

/// Works on the faces whose angle is above `goal_deg`, the worst first, until nothing helps, and counts what
/// was done in the report. Deterministic. Throws Cancelled.
void make_orthogonal(TetrahedraComplex& mesh, double goal_deg, double least_quality, MendingReport& report,
                     const core::TaskContext& task = core::no_task());

}  // namespace ostia::meshing
