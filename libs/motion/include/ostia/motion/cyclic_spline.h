#pragma once
/// \file Points that move periodically, between the phases at which they are known ([Yi] 4).

#include "ostia/geometry/vec.h"

#include <vector>

namespace ostia::motion {

/// Cubic splines through the places of many points over a cycle, C2 everywhere, across its end too ([Yi]
/// equation 26). Phases are shares of the cycle.
class CyclicSpline {
 public:
  /// `phases` rise, in [0, 1), three at least; `places[k]` are all points at phase k, the same number each
  /// time. Throws InvalidInput.
  CyclicSpline(std::vector<double> phases, std::vector<std::vector<geometry::Vec3>> places);
  std::size_t points() const { return places_.front().size(); }
  const std::vector<double>& phases() const { return phases_; }
  /// At any phase; 1.25 is 0.25.
  std::vector<geometry::Vec3> at(double phase) const;
  /// Derivatives by the phase: mm a cycle.
  std::vector<geometry::Vec3> rate(double phase) const;

 private:
  struct Piece {
    std::size_t from, to;
    double width, share;  ///< of the piece's width
  };
  Piece piece(double phase) const;
  std::vector<double> phases_;
  std::vector<std::vector<geometry::Vec3>> places_, second_;  ///< values and second derivatives at the knots
};

}  // namespace ostia::motion
