#include "mesh/cells_of_sides.h"

#include "surface_formats.h"

#include <algorithm>

namespace ostia::io {
namespace {

bool triangle(const CellSide& side) {
  return side[3] < 0;
}

bool has(const CellSide& side, std::int32_t corner) {
  return std::ranges::find(side, corner) != side.end();
}

/// The side that has this corner, but not the one that `base` is.
std::int32_t beyond(const std::vector<CellSide>& sides, const CellSide& base) {
  for (const CellSide& side : sides) {
    for (const std::int32_t corner : side)
      if (corner >= 0 && !has(base, corner)) return corner;
  }
  return -1;
}

/// At a quadrilateral's side: the corner next to `corner` that is not on `base`.
std::int32_t upright_from(const std::vector<CellSide>& sides, const CellSide& base, std::int32_t corner) {
  for (const CellSide& side : sides) {
    if (triangle(side)) continue;
    for (std::size_t i = 0; i < 4; ++i) {
      if (side[i] != corner) continue;
      for (const std::size_t next : {(i + 1) % 4, (i + 3) % 4})
        if (!has(base, side[next])) return side[next];
    }
  }
  return -1;
}

/// Whether exactly the nodes' own corners are named by the sides.
bool closed(const std::vector<CellSide>& sides, const std::vector<std::int32_t>& nodes) {
  if (std::ranges::find(nodes, -1) != nodes.end()) return false;
  std::vector<std::int32_t> sorted = nodes;
  std::ranges::sort(sorted);
  if (std::ranges::adjacent_find(sorted) != sorted.end()) return false;
  return std::ranges::all_of(sides, [&](const CellSide& side) {
    return std::ranges::all_of(
        side, [&](std::int32_t corner) { return corner < 0 || std::ranges::binary_search(sorted, corner); });
  });
}

}  // namespace

std::vector<std::int32_t> nodes_of_sides(const std::vector<CellSide>& sides) {
  const auto triangles = std::ranges::count_if(sides, triangle);
  const auto base = std::ranges::find_if(sides, triangle);
  std::vector<std::int32_t> nodes;
  if (sides.size() == 4 && triangles == 4) {
    // From outside 021 runs counter-clockwise.
    nodes = {(*base)[0], (*base)[2], (*base)[1], beyond(sides, *base)};
  } else if (sides.size() == 5 && triangles == 2) {
    nodes = {(*base)[0], (*base)[2], (*base)[1]};
    for (std::size_t i = 0; i < 3; ++i) nodes.push_back(upright_from(sides, *base, nodes[i]));
  } else if (sides.size() == 6 && triangles == 0) {
    const CellSide& first = sides.front();
    nodes = {first[0], first[3], first[2], first[1]};
    for (std::size_t i = 0; i < 4; ++i) nodes.push_back(upright_from(sides, first, nodes[i]));
  }
  if (!closed(sides, nodes)) return {};
  return nodes;
}

void add_cells_of_sides(const std::vector<std::vector<CellSide>>& cells, std::size_t first,
                        const std::filesystem::path& path, MeshBuilder& mesh,
                        const std::vector<bool>& in_layers) {
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const std::vector<std::int32_t> nodes = nodes_of_sides(cells[c]);
    if (nodes.empty())
      refuse(path, "cell " + std::to_string(first + c) + " with " + std::to_string(cells[c].size()) +
                       " faces is no tetrahedron, prism or hexahedron");
    if (mesh.add_hexahedron(nodes)) continue;
    mesh.set_in_layers(c < in_layers.size() && in_layers[c]);
    mesh.add(nodes.size() == 4 ? Shape::tetrahedron : Shape::prism, nodes, 0, NodeOrder());
  }
}

}  // namespace ostia::io
