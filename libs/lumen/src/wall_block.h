#pragma once
// One block of the sparse grid on which a wall is polygonised: what is known of it, and following the wall in
// it.

#include "ostia/geometry/tri_mesh.h"
#include "ostia/lumen/scalar_field.h"

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace ostia::lumen {

inline constexpr int block_cells = 16;               ///< along each axis
inline constexpr int block_nodes = block_cells + 1;  ///< with those on both faces

/// A cell of the whole grid by its lowest node; also a block, in steps of 16 cells.
using GridIndex = std::array<std::int32_t, 3>;
GridIndex block_of(const GridIndex& cell);

using CellCode = std::uint16_t;  ///< x + 16 (y + 16 z) of a cell in its block
using NodeCode = std::uint16_t;  ///< x + 17 (y + 17 z) of a node in a block
using EdgeCode = std::uint16_t;  ///< 3 node + axis of the grid edge that begins at a node
inline constexpr int cell_codes = block_cells * block_cells * block_cells;
inline constexpr int node_codes = block_nodes * block_nodes * block_nodes;
inline constexpr int edge_codes = 3 * node_codes;

CellCode code_in_block(const GridIndex& cell, const GridIndex& block);
/// Places in a block, in steps of its cells.
std::array<int, 3> place_of_cell(CellCode code);
std::array<int, 3> place_of_node(NodeCode code);
int node_code(const std::array<int, 3>& place);

/// A connected part of the wall within one block.
struct WallPiece {
  std::vector<CellCode> cells;   ///< ascending
  std::vector<GridIndex> exits;  ///< cells of other blocks that the wall goes on to
  /// The edges of the mesh's points: first those that begin in one of the block's cells (its own), then those
  /// on its upper faces, which are other blocks' own; each ascending.
  std::vector<EdgeCode> edges;
  std::size_t own = 0;
  std::shared_ptr<const geometry::TriMesh> mesh;
  bool reached = false;  ///< from the seeds, in the present call
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
      piece_of;  ///< by CellCode: 1 + index of the piece, 0 for none; empty without pieces
  std::map<CellCode, std::vector<GridIndex>> starts;  ///< the crossed cells found from a seed in that cell
  bool made = false;                                  ///< in the present call

  /// The piece that passes through a cell of the block, or null.
  const WallPiece* piece_at(CellCode cell) const;
};
using WallBlocks = std::map<GridIndex, WallBlock>;

/// What all blocks of a call share.
class WallJob {
 public:
  WallJob(const ScalarField& field, double cell_mm, std::size_t largest_cells, std::size_t cells)
      : field_(field), cell_mm_(cell_mm), largest_cells_(largest_cells), cells_(cells) {}

  Vec3 node(const GridIndex& index) const;
  /// The place at a fraction of the edge that begins at a node.
  Vec3 place(const GridIndex& index, int axis, double fraction) const;
  std::vector<double> ask(const std::vector<Vec3>& places);  ///< throws InvalidInput where it is not a number
  void count_cells(std::size_t more);                        ///< throws ResourceError
  std::size_t evaluations() const { return evaluations_; }

 private:
  const ScalarField& field_;
  double cell_mm_;
  std::size_t largest_cells_;
  std::atomic<std::size_t> cells_, evaluations_{0};
};

/// Follows the wall in a block from the cells of its seeds and from cells that the wall enters by; returns
/// the cells by which it goes on into other blocks. Other blocks' `kept` values on shared faces are used;
/// what is found depends on the field alone, not on the order of the entries.
std::vector<GridIndex> follow_wall(WallJob& job, WallBlock& block, const WallBlocks& all,
                                   const std::vector<GridIndex>& seeds,
                                   const std::vector<GridIndex>& entries);

/// Whether anything that the block was made from lies in a box.
bool depends_on(const WallBlock& block, const Box3& box, double cell_mm);
/// Forgets the values that lie in a box, and all pieces and starts.
void forget(WallBlock& block, const Box3& changed, double cell_mm);
/// Ends a call: pieces that were not reached go, fresh values are kept.
void settle(WallBlock& block);

}  // namespace ostia::lumen
