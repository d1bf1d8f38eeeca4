#pragma once
/// \file The cage's control points as unknowns of a least-squares problem with hyperelastic energy.

#include "grid_matrix.h"
#include "surface_pairs.h"

#include "ostia/motion/hyperelastic.h"

#include <cstdint>
#include <vector>

namespace ostia::motion {

/// What a deformation costs.
struct CageCost {
  HyperelasticWeights energy;
  bool elastic = true;        ///< false: only distances count
  double data_weight = 1.0;   ///< half of it times a pair's weight times the squared distance is its cost
  double point_share = 0.05;  ///< of that, for all directions; the rest is along the target's normal
};

/// The cells that are solved for, those that a triangle of a surface may pass and their neighbours, and their
/// corners.
class CageSystem {
 public:
  CageSystem(const geometry::CageGrid& grid, const geometry::TriMesh& surface_at_rest, const CageCost& cost);

  /// Energy of the cells plus weighted squared distances of the pairs; infinite where a cell is inverted.
  double energy(const std::vector<geometry::Vec3>& control_points,
                const std::vector<SurfacePair>& pairs) const;
  /// Its derivative by all control points, zero for those that follow.
  std::vector<geometry::Vec3> gradient(const std::vector<geometry::Vec3>& control_points,
                                       const std::vector<SurfacePair>& pairs) const;
  /// Bound of the second derivative of the pairs' distances in any direction (Gershgorin); 1 where there are
  /// no pairs.
  double greatest_curvature(const std::vector<SurfacePair>& pairs) const;
  /// Gauss-Newton step of the solved control points, zero for the others.
  std::vector<geometry::Vec3> step(const std::vector<geometry::Vec3>& control_points,
                                   const std::vector<SurfacePair>& pairs) const;
  /// The others go with their neighbours: their displacements are made harmonic, sweep by sweep.
  void follow(std::vector<geometry::Vec3>& control_points) const;
  /// Least bound of the Jacobian over all cells.
  double least_jacobian(const std::vector<geometry::Vec3>& control_points) const;

 private:
  using Cells = std::vector<std::vector<std::uint32_t>>;
  std::array<geometry::Vec3, 8> corners(std::size_t cell, const std::vector<geometry::Vec3>& points) const;
  Cells pairs_of_cells(const std::vector<SurfacePair>& pairs) const;
  /// One cell's energy and derivatives, its pairs' included.
  CellEnergy whole_cell(std::size_t solved, const std::vector<geometry::Vec3>& points,
                        const std::vector<SurfacePair>& pairs, const std::vector<std::uint32_t>& own,
                        Derivatives derivatives) const;
  void find_neighbours();

  geometry::CageGrid grid_;
  CageCost cost_;
  ElasticCell cell_;
  std::vector<std::uint32_t> cells_;       ///< solved
  std::vector<std::int32_t> solved_cell_;  ///< of each cell its number in cells_, -1: not solved
  std::vector<std::int32_t> unknown_;      ///< of each control point its number, -1: follows
  std::size_t unknowns_ = 0;
  /// Of each unknown: the solved cells of which it is corner 0 to 7, -1: none.
  std::vector<std::array<std::int32_t, 8>> cells_about_;
  std::vector<std::array<std::int32_t, GridMatrix::row_blocks>> neighbours_;  ///< of each unknown
  struct Follower {
    std::int32_t point = 0;
    std::array<std::int32_t, 6> beside{};  ///< the first `count` are points
    int count = 0;
  };
  std::vector<Follower> followers_;
};

}  // namespace ostia::motion
