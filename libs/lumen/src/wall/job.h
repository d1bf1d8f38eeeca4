#pragma once
// What all blocks share while a wall is followed: the field, and counts.

#include "wall/grid.h"

#include "ostia/lumen/scalar_field.h"

#include <atomic>
#include <vector>

namespace ostia::lumen {

class WallJob {
 public:
  WallJob(const ScalarField& field, double cell_mm, std::size_t largest_cells)
      : field_(field), cell_mm_(cell_mm), largest_cells_(largest_cells) {}

  double cell_mm() const { return cell_mm_; }
  const ScalarField& field() const { return field_; }
  Vec3 node(const GridIndex& index) const {
    return {cell_mm_ * index[0], cell_mm_ * index[1], cell_mm_ * index[2]};
  }
  /// The place at a fraction of the edge that begins at a node.
  Vec3 place(const GridIndex& index, int axis, double fraction) const {
    Vec3 at = node(index);
    at[axis] = cell_mm_ * (index[static_cast<std::size_t>(axis)] + fraction);
    return at;
  }
  std::vector<double> ask(const std::vector<Vec3>& places);  ///< throws InvalidInput where it is not a number
  void count_cells(std::size_t more);                        ///< throws ResourceError
  std::size_t evaluations() const { return evaluations_; }

 private:
  const ScalarField& field_;
  double cell_mm_;
  std::size_t largest_cells_;
  std::atomic<std::size_t> cells_{0}, evaluations_{0};
};

}  // namespace ostia::lumen
