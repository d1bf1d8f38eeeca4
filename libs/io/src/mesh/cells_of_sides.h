#pragma once
/// \file Tetrahedra, prisms and hexahedra put together of their sides, as formats of faces have them.

#include "mesh/builder.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace ostia::io {

/// Corners of a side, the fourth of a triangle -1, seen from outside of the cell.
using CellSide = std::array<std::int32_t, 4>;

/// Nodes in our order of the cell with these sides: 4 of a tetrahedron, 6 of a prism, 8 of a hexahedron.
/// Empty where they are the sides of none of these.
std::vector<std::int32_t> nodes_of_sides(const std::vector<CellSide>& sides);
/// Gives the mesh the cells with these sides. Throws InvalidInput that names the file and the cell, counted
/// from `first` on, that is no tetrahedron, prism or hexahedron. `in_layers`: of each cell, or none.
void add_cells_of_sides(const std::vector<std::vector<CellSide>>& cells, std::size_t first,
                        const std::filesystem::path& path, MeshBuilder& mesh,
                        const std::vector<bool>& in_layers = {});

}  // namespace ostia::io
