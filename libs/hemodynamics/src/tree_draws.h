#pragma once
/// \file Trees drawn at random about the one that is told.

#include "uncertain_inputs.h"
#include "wall_field.h"

#include "ostia/core/quasi_random.h"
#include "ostia/hemodynamics/network_solver.h"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace ostia::hemodynamics {

/// All normal numbers that make one tree.
struct TreeDraw {
  std::vector<double> inputs;  ///< one a spread
  std::vector<double> wall;    ///< one a station of all branches
};

class TreeDraws {
 public:
  /// `network` and `flows_ml_s` (one a branch) are of the tree as it is drawn: where it loses pressure its
  /// walls are drawn evenly. Throws InvalidInput where the walls' spreads are of another tree.
  TreeDraws(const Network& network, const std::vector<double>& flows_ml_s,
            const std::vector<LesionPlace>& lesions, const std::vector<InputSpread>& spreads,
            const UncertaintyOptions& options);
  /// Of each pair of draws the first and the second are independent.
  TreeDraw draw(std::size_t pair, bool second) const;
  /// The tree with its walls moved. A section that is shut stays so.
  Network moved(const Network& network, std::span<const double> wall) const;
  bool walls_are_certain() const { return certain_; }

 private:
  std::size_t dimension(std::size_t number, bool second) const { return 2 * number + (second ? 1 : 0); }
  WallField field_;
  std::vector<double> relative_;  ///< spread over radius, of each station
  bool certain_ = true;
  double common_ = 0.0, local_ = 1.0;  ///< factors of both parts of a wall's number
  std::size_t inputs_ = 0;
  std::uint64_t seed_ = 1;
  std::optional<EvenDirections> directions_;
  std::optional<core::ScrambledHalton> points_;
};

}  // namespace ostia::hemodynamics
