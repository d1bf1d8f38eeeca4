#pragma once
/// \file A smooth normal number along all walls of a tree.

#include "ostia/hemodynamics/network.h"

#include <span>
#include <vector>

namespace ostia::hemodynamics {

/// z of mean 0 and deviation 1 at every station, correlated along s as (1 + a) exp(-a), a = sqrt(3) distance
/// / `correlation_mm` (Matern 3/2). As a process in s it has two states, z and its slope, and no memory
/// beyond them; so branches behind a fork begin with the state that their parent ends with, and z is the same
/// on all its sides.
class WallField {
 public:
  WallField(const Network& network, double correlation_mm);
  std::size_t stations() const { return steps_.size(); }         ///< of all branches, one after another
  std::size_t innovations() const { return 2 * steps_.size(); }  ///< independent normal numbers that it takes
  /// z at the stations; `values` has stations() elements, `independent` innovations().
  void values(std::span<const double> independent, std::span<double> values) const;
  /// The transposed map: how a weighted sum of z depends on each independent number.
  std::vector<double> influence(std::span<const double> weights) const;

 private:
  struct Step {
    long before = -1;  // station whose state it follows; -1: none
    double z_by_z = 0.0, z_by_slope = 0.0, slope_by_z = 0.0, slope_by_slope = 0.0;
    double z_new = 1.0, slope_by_first = 0.0, slope_new = 1.0;  // a triangle, of the independent numbers
  };
  std::vector<Step> steps_;
};

/// Turns independent normal numbers so that some of them, which are drawn evenly, have the most say: the
/// first is along the first influence, the second along what is left of the second, and so on (after Imai and
/// Tan 2006, J Comput Finance 10:129).
class EvenDirections {
 public:
  explicit EvenDirections(const std::vector<std::vector<double>>& influences);
  std::size_t count() const { return directions_.size(); }
  /// `independent` stays normal and independent; its part along direction k becomes `even`[k].
  void put(std::span<const double> even, std::span<double> independent) const;

 private:
  std::vector<std::vector<double>> directions_;  // orthonormal
};

}  // namespace ostia::hemodynamics
