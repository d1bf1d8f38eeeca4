#pragma once
// Cells, nodes and edges of the sparse grid on which a wall is polygonised, and how they are numbered.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace ostia::lumen {

inline constexpr int block_cells = 16;               ///< along each axis
inline constexpr int block_nodes = block_cells + 1;  ///< with those on both faces

/// A cell of the whole grid by its lowest node; also a block, in steps of 16 cells.
using GridIndex = std::array<std::int32_t, 3>;
/// A place in a block, in steps of its cells.
using Place = std::array<int, 3>;

using CellCode = std::uint16_t;  ///< x + 16 (y + 16 z) of a cell in its block
using NodeCode = std::uint16_t;  ///< x + 17 (y + 17 z) of a node in a block
using EdgeCode = std::uint16_t;  ///< 3 node + axis of the grid edge that begins at a node
inline constexpr int cell_codes = block_cells * block_cells * block_cells;
inline constexpr int node_codes = block_nodes * block_nodes * block_nodes;
inline constexpr int edge_codes = 3 * node_codes;

constexpr GridIndex block_of(const GridIndex& cell) {
  static_assert(block_cells == 16);
  return {cell[0] >> 4, cell[1] >> 4, cell[2] >> 4};  // rounds down, below zero too
}
constexpr Place in_steps(const GridIndex& cell, const GridIndex& block) {
  return {cell[0] - block[0] * block_cells, cell[1] - block[1] * block_cells,
          cell[2] - block[2] * block_cells};
}
constexpr GridIndex in_grid(const Place& place, const GridIndex& block) {
  return {place[0] + block[0] * block_cells, place[1] + block[1] * block_cells,
          place[2] + block[2] * block_cells};
}

constexpr CellCode cell_code(const Place& cell) {
  return static_cast<CellCode>(cell[0] + block_cells * (cell[1] + block_cells * cell[2]));
}
constexpr NodeCode node_code(const Place& node) {
  return static_cast<NodeCode>(node[0] + block_nodes * (node[1] + block_nodes * node[2]));
}
constexpr CellCode code_in_block(const GridIndex& cell, const GridIndex& block) {
  return cell_code(in_steps(cell, block));
}
constexpr Place place_of_cell(CellCode code) {
  return {code % block_cells, code / block_cells % block_cells, code / (block_cells * block_cells)};
}
constexpr Place place_of_node(NodeCode code) {
  return {code % block_nodes, code / block_nodes % block_nodes, code / (block_nodes * block_nodes)};
}
constexpr bool in_block(const Place& cell) {
  return std::all_of(cell.begin(), cell.end(), [](int c) { return c >= 0 && c < block_cells; });
}
/// Corner c of a cell is at (c & 1, c >> 1 & 1, c >> 2).
constexpr Place corner_of(const Place& cell, int corner) {
  return {cell[0] + (corner & 1), cell[1] + (corner >> 1 & 1), cell[2] + (corner >> 2)};
}

constexpr NodeCode node_of_edge(EdgeCode edge) {
  return static_cast<NodeCode>(edge / 3);
}
constexpr EdgeCode edge_code(NodeCode node, int axis) {
  return static_cast<EdgeCode>(3 * node + axis);
}
/// The node at an edge's other end; for edges that the block holds.
constexpr NodeCode end_of_edge(EdgeCode edge) {
  constexpr std::array<int, 3> step{1, block_nodes, block_nodes * block_nodes};
  return static_cast<NodeCode>(edge / 3 + step[edge % 3]);
}
/// Whether an edge begins in one of the block's own cells; others lie on its upper faces.
constexpr bool is_own(EdgeCode edge) {
  const Place node = place_of_node(node_of_edge(edge));
  return node[0] < block_cells && node[1] < block_cells && node[2] < block_cells;
}

/// The corners of a cell inside the wall as bits: whether the wall passes through the cell, and through one
/// of its faces.
constexpr bool crossed(unsigned bits) {
  return bits != 0 && bits != 0xFF;
}
constexpr bool face_crossed(unsigned bits, int axis, int side) {
  constexpr std::array<unsigned, 3> upper{0xAA, 0xCC, 0xF0};
  const unsigned upper_mask = upper[static_cast<std::size_t>(axis)],
                 mask = side != 0 ? upper_mask : 0xFF ^ upper_mask;
  return (bits & mask) != 0 && (bits & mask) != mask;
}

}  // namespace ostia::lumen
