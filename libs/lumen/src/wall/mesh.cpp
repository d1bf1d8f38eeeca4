#include "wall/mesh.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"

#include <limits>

namespace ostia::lumen {
namespace {

// The number of the point on an edge that begins in a cell of this block.
std::int32_t number_in(const WallBlock& owner, EdgeCode edge) {
  for (const WallPiece& piece : owner.pieces) {
    const auto last = piece.edges.begin() + static_cast<std::ptrdiff_t>(piece.own);
    const auto found = std::lower_bound(piece.edges.begin(), last, edge);
    if (found != last && *found == edge)
      return static_cast<std::int32_t>(piece.first_point +
                                       static_cast<std::size_t>(found - piece.edges.begin()));
  }
  throw Error("the wall's blocks do not fit one another");
}

/// Numbers the points of one block's pieces in the joined mesh.
class Numbering {
 public:
  Numbering(const WallBlocks& blocks, const WallBlock& block) : blocks_(blocks), block_(block) {}

  const std::vector<std::int32_t>& of(const WallPiece& piece) {
    number_.resize(piece.edges.size());
    for (std::size_t i = 0; i < piece.own; ++i) number_[i] = static_cast<std::int32_t>(piece.first_point + i);
    for (std::size_t i = piece.own; i < piece.edges.size(); ++i) number_[i] = of_foreign(piece.edges[i]);
    return number_;
  }

 private:
  // An edge on the block's upper faces belongs to the block beyond.
  std::int32_t of_foreign(EdgeCode edge) {
    Place node = place_of_node(node_of_edge(edge));
    GridIndex beyond = block_.index;
    std::size_t side = 0;
    for (std::size_t a = 0; a < 3; ++a) {
      if (node[a] < block_cells) continue;
      node[a] -= block_cells;
      ++beyond[a];
      side |= std::size_t{1} << a;
    }
    if (owners_[side] == nullptr) owners_[side] = &blocks_.at(beyond);
    return number_in(*owners_[side], edge_code(node_code(node), edge % 3));
  }

  const WallBlocks& blocks_;
  const WallBlock& block_;
  std::array<const WallBlock*, 8> owners_{};  // by the upper faces that an edge lies on
  std::vector<std::int32_t> number_;
};

void copy(const WallBlocks& blocks, const WallBlock& block, geometry::TriMesh& mesh) {
  Numbering numbering(blocks, block);
  for (const WallPiece& piece : block.pieces) {
    const std::vector<std::int32_t>& number = numbering.of(piece);
    std::copy_n(piece.mesh->points.begin(), piece.own,
                mesh.points.begin() + static_cast<std::ptrdiff_t>(piece.first_point));
    auto to = mesh.triangles.begin() + static_cast<std::ptrdiff_t>(piece.first_triangle);
    for (const geometry::Triangle& t : piece.mesh->triangles)
      *to++ = {number[static_cast<std::size_t>(t[0])], number[static_cast<std::size_t>(t[1])],
               number[static_cast<std::size_t>(t[2])]};
  }
}

}  // namespace

geometry::TriMesh joined(const WallBlocks& blocks) {
  std::size_t points = 0, triangles = 0;
  std::vector<const WallBlock*> with_wall;
  for (const auto& [index, block] : blocks) {
    if (block.pieces.empty()) continue;
    with_wall.push_back(&block);
    const WallPiece& last = block.pieces.back();
    points = last.first_point + last.own;
    triangles = last.first_triangle + last.mesh->triangles.size();
  }
  if (points > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
    throw ResourceError("the lumen's wall has more than 2^31 points; take larger cells");
  geometry::TriMesh mesh;
  mesh.points.resize(points);
  mesh.triangles.resize(triangles);
  constexpr std::size_t blocks_per_task = 32;
  core::parallel_for(with_wall.size(), blocks_per_task,
                     [&](std::size_t i) { copy(blocks, *with_wall[i], mesh); });
  return mesh;
}

}  // namespace ostia::lumen
