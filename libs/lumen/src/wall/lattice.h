#pragma once
// What is known of one block while the wall is followed in it.

#include "wall/block.h"
#include "wall/job.h"

namespace ostia::lumen {

/// Values at the nodes of a block and crossings of its edges, asked where they are not known, and each once:
/// what the block or a neighbour has kept is taken, so that both sides of a face see the same.
class Lattice {
 public:
  Lattice(WallJob& job, WallBlock& block, const WallBlocks& all);

  /// The corners of cells, asked at once where they are not known.
  void know(const std::vector<CellCode>& cells);
  /// Where edges are crossed, found at once where it is not known.
  void know_crossings(const std::vector<WallPiece>& pieces);

  double value(const Place& node) const { return values_[node_code(node)]; }
  /// Which corners of a cell lie inside.
  unsigned bits(CellCode cell) const;
  Vec3 point(EdgeCode edge) const {
    return job_.place(in_grid(place_of_node(node_of_edge(edge)), block_.index), edge % 3, crossings_[edge]);
  }

 private:
  void load(const WallValues& known);
  void load_from_neighbour(const WallValues& known, const Place& step);

  WallJob& job_;
  WallBlock& block_;
  std::vector<double> values_, crossings_;  // NaN where not known
};

}  // namespace ostia::lumen
