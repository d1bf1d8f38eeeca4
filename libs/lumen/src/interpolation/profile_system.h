#pragma once
/// \file A wall's system with its Cholesky factor, changed where samples come and go.

#include "editing/change_extent.h"
#include "interpolation/constraints.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <vector>

namespace ostia::lumen {

/// A c + P q = h with P^T c = 0 ([Wels] eq. 3), A = L L^T.
///
/// Constraints lie in blocks, cut at fixed abscissas; a block row reaches back to the first block that it is
/// coupled with, and L fills no more than that (the profile, or skyline). Row by row
///   L_ij = (A_ij - sum_k<j L_ik L_jk^T) L_jj^-T,
/// so that a row depends on the rows in its reach alone. After a change the rows whose constraints or
/// couplings changed are formed again, and then those that reach back to a row which is no longer what it
/// was: what a row knows of another fades with their distance along the vessel, and a row that comes out as
/// before within round-off ends it. Solutions are corrected in the same way by their residual, which is not
/// zero near the change alone. What either leaves out shows in the residual of the whole system and is
/// refined away.
class ProfileSystem {
 public:
  /// `constraints` in canonical order. Throws ResourceError by the profile's size before anything is
  /// factored, NumericalError where A is not positive definite or the residual stays above 1e-7 mm.
  ProfileSystem(const std::vector<Constraint>& constraints, const InterpolationOptions& options);

  /// What a change altered.
  struct Change {
    int rows_formed = 0;  ///< constraints whose rows of L were formed again
    double residual = 0.0;
    ChangeExtent extent;
  };
  /// Throws NumericalError as above; then all is as before.
  Change change(const ConstraintSet::Difference& difference);
  /// Blocks have grown so far beyond their first size that they should be cut anew.
  bool overgrown() const;

  double residual() const { return residual_; }  ///< largest |f(p_i) - h_i|, mm
  ImplicitCoefficients coefficients() const;

 private:
  using Matrix = Eigen::MatrixXd;
  struct Row {
    std::vector<Constraint> members;  // in canonical order
    geometry::Box3 box;
    std::size_t first = 0;  // block that it reaches back to
    Matrix a, l;            // members x all members of blocks first .. this
    Matrix right, x, rest;  // h and the polynomial's terms; A^-1 of them; right - A x
    Eigen::VectorXd weights;
  };
  struct Journal;

  std::size_t block_of(double s_mm) const;
  void set_members(Row& row, std::vector<Constraint> members) const;
  bool coupled(const Row& a, const Row& b) const;
  void number_rows();
  Eigen::Index offset(std::size_t row, std::size_t column) const {
    return start_[column] - start_[rows_[row].first];
  }
  void refuse_what_does_not_fit() const;
  void assemble(std::size_t i);
  void factor_row(std::size_t i);
  std::vector<char> coupled_with(const std::vector<char>& rows) const;
  void measure(const std::vector<char>& rows);
  std::vector<char> correct();
  void refine(std::vector<char> stale);
  void set_weights();
  std::vector<char> apply(const ConstraintSet::Difference& difference, Journal& journal, Change& report);
  std::vector<WeightChange> weight_changes(const Journal& journal) const;
  ChangeExtent extent_since(const Journal& journal) const;

  InterpolationOptions options_;
  Vec3 centre_ = Vec3::Zero();
  std::vector<double> cuts_;  // abscissas where blocks begin, but the first
  std::vector<Row> rows_;
  std::vector<Eigen::Index> start_;  // of each block among all constraints
  std::size_t first_largest_ = 0;
  Eigen::Vector4d q_ = Eigen::Vector4d::Zero();
  double residual_ = 0.0;
};

}  // namespace ostia::lumen
