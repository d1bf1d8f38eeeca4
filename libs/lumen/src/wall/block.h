#pragma once
// One block of the sparse grid on which a wall is polygonised: what is known of it.

#include "wall/grid.h"

#include "ostia/geometry/tri_mesh.h"

#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace ostia::lumen {

/// A connected part of the wall within one block.
struct WallPiece {
  std::vector<CellCode> cells;  ///< ascending
  /// Cells of other blocks that the wall goes on to: not all, but one at least of each connected stretch.
  std::vector<GridIndex> exits;
  /// The edges of the mesh's points: first those that begin in one of the block's cells (its own), then those
  /// on its upper faces, which are other blocks' own; each ascending.
  std::vector<EdgeCode> edges;
  std::size_t own = 0;
  std::shared_ptr<const geometry::TriMesh> mesh;
  bool reached = false;                             ///< from the seeds, in the present call
  std::size_t first_point = 0, first_triangle = 0;  ///< in the joined mesh, once a call is done
};

/// A cell of the block that a seed lies in, and the crossed cells that are found from it.
struct WallSeed {
  CellCode cell = 0;
  bool crossed = false;           ///< the cell itself, and then `others` is empty
  std::vector<GridIndex> others;  ///< around it
};

/// Values of the field that were asked, by NodeCode, and fractions of grid edges at which these are crossed,
/// by EdgeCode; each once, in any order.
struct WallValues {
  std::vector<std::pair<NodeCode, double>> nodes;
  std::vector<std::pair<EdgeCode, double>> crossings;
};

struct WallBlock {
  GridIndex index{0, 0, 0};
  WallValues kept;                ///< of earlier calls: read while the neighbours are worked on, too
  WallValues fresh;               ///< of the present call
  std::vector<WallPiece> pieces;  ///< by lowest cell once a call is done
  std::vector<std::int16_t>
      piece_of;                  ///< by CellCode: 1 + index of the piece, 0 for none; empty without pieces
  std::vector<WallSeed> seeds;   ///< of the last call, by cell
  std::vector<CellCode> likely;  ///< where the wall was before it was forgotten: asked in one batch
  bool made = false;             ///< in the present call

  /// The piece that passes through a cell of the block, or null.
  WallPiece* piece_at(CellCode cell);
  const WallPiece* piece_at(CellCode cell) const;
  void number_pieces();  ///< makes `piece_of`
};
using WallBlocks = std::map<GridIndex, WallBlock>;

/// Forgets all pieces; their cells are `likely` from now on.
void forget_pieces(WallBlock& block);
/// Ends a call: pieces that were not reached go, fresh values are kept.
void settle(WallBlock& block);

}  // namespace ostia::lumen
