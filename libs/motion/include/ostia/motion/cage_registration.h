#pragma once
/// \file A surface at one phase brought onto the surface of another, by a hierarchy of cages ([Yi] 3).

#include "ostia/core/task_context.h"
#include "ostia/geometry/cage.h"
#include "ostia/geometry/tri_mesh.h"
#include "ostia/motion/hyperelastic.h"

#include <vector>

namespace ostia::motion {

struct RegistrationOptions {
  int depth = 4;        ///< 2^depth cells a side in the end, from 2 on; in [1, 5]
  double margin = 0.1;  ///< of the cage around the source, of its longest side
  /// Pairs whose normals differ more are none ([Yi] equation 13); in (0, 180].
  double max_angle_deg = 30.0;
  HyperelasticWeights energy;
  /// Weight of squared distances, times the surface they stand for, against the energy, 1/mm. > 0.
  double data_weight = 1e4;
  int most_rounds = 12;  ///< of pairing and solving at each depth; in [1, 1000]
  /// Surfaces of more points are paired by coarser copies of about that many; all points are carried in the
  /// end. At least 100.
  int most_points = 30000;
  /// Control points of a neighbouring phase, at full depth: the coarsest cage starts at these. The cage is
  /// that around the source, so this is for several targets of one source. Empty: at rest.
  std::vector<geometry::Vec3> start;
};
void validate(const RegistrationOptions& options);

struct RegistrationReport {
  int rounds = 0;                 ///< of all depths
  double paired_share = 0.0;      ///< of the source's surface, in the last round
  double mean_distance_mm = 0.0;  ///< of these pairs
  double least_jacobian = 0.0;    ///< bound over all cells: positive, nothing is inverted
  /// Pairs of triangles that intersect in the result, and in the source.
  std::size_t self_intersections = 0, source_self_intersections = 0;
};

/// Whether a cell that cannot be pressed further has ended the rounds too early: the least Jacobian is below
/// 0.05, and the surface still more than 0.1 mm off.
bool is_stuck(const RegistrationReport& report);

struct Registration {
  geometry::CageGrid grid;
  std::vector<geometry::Vec3> control_points;
  geometry::TriMesh surface;  ///< the source's triangles, carried
  RegistrationReport report;
};

/// Gauss-Newton on distances between planes and points both ways (each vertex to the target, each vertex of
/// the target to the source), with weights that leave out what is far compared with the rest (Tukey):
/// branches that only one surface has. At each depth, pairs and cage by turns; steps are shortened until
/// every cell's Jacobian is positive everywhere and the energy falls. Cells far from the surface follow
/// smoothly. If triangles intersect that did not in the source, a depth is taken back by halves until none
/// do. Deterministic. Throws InvalidInput (options, a surface without triangles, a start of another number of
/// points), Cancelled.
Registration register_cage(const geometry::TriMesh& source, const geometry::TriMesh& target,
                           const RegistrationOptions& options = {},
                           const core::TaskContext& task = core::no_task());

}  // namespace ostia::motion
