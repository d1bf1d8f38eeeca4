#include "wall/following.h"

#include "wall/lattice.h"

#include "ostia/geometry/cube_patterns.h"

#include <bit>
#include <cmath>
#include <optional>

namespace ostia::lumen {
namespace {

// visit(axis, side, cell beyond)
template <class Visit>
void each_crossed_face(const Place& cell, unsigned bits, const Visit& visit) {
  for (int axis = 0; axis < 3; ++axis) {
    for (int side = 0; side < 2; ++side) {
      if (!face_crossed(bits, axis, side)) continue;
      Place beyond = cell;
      beyond[static_cast<std::size_t>(axis)] += side != 0 ? 1 : -1;
      visit(axis, side, beyond);
    }
  }
}

// Whether the wall runs on across a block's face to the cell before this one along another axis: through the
// edge that both have in the face. Then they are connected on either side of the face, and one of them will
// do as an exit.
bool goes_on_before(unsigned bits, int face_axis, int side, int other_axis) {
  const int third = 3 - face_axis - other_axis;
  const int corner = side << face_axis;
  return (bits >> corner & 1) != (bits >> (corner | 1 << third) & 1);
}

// The codes of a cell's edges, less three times its lowest node's.
const std::array<int, 12>& edge_steps() {
  static const std::array<int, 12> steps = [] {
    std::array<int, 12> made{};
    for (std::size_t e = 0; e < made.size(); ++e) {
      const geometry::CubeEdge& edge = geometry::cube_edges()[e];
      made[e] = edge_code(node_code(corner_of({0, 0, 0}, edge.from)), edge.axis);
    }
    return made;
  }();
  return steps;
}

/// Finds the pieces that some cells belong to.
class Follower {
 public:
  Follower(WallJob& job, WallBlock& block, Lattice& lattice)
      : job_(job), block_(block), lattice_(lattice), bits_(cell_codes, 0), seen_(cell_codes, not_seen) {}

  void follow(std::vector<CellCode> frontier) {
    const std::vector<CellCode> found = crossed_cells(std::move(frontier));
    job_.count_cells(found.size());
    std::vector<WallPiece> pieces;
    for (const CellCode cell : found)
      if (seen_[cell] == seen) pieces.push_back(piece_from(cell));
    lattice_.know_crossings(pieces);
    for (WallPiece& piece : pieces) {
      piece.mesh = std::make_shared<const geometry::TriMesh>(mesh_of(piece));
      block_.pieces.push_back(std::move(piece));
    }
    block_.made = block_.made || !found.empty();
  }

 private:
  enum State : std::uint8_t { not_seen, seen, in_piece };

  // Ascending.
  std::vector<CellCode> crossed_cells(std::vector<CellCode> frontier) {
    std::vector<CellCode> found, next;
    for (const CellCode cell : frontier) seen_[cell] = seen;
    while (!frontier.empty()) {
      lattice_.know(frontier);
      next.clear();
      for (const CellCode cell : frontier) {
        const unsigned bits = lattice_.bits(cell);
        if (!crossed(bits)) continue;
        bits_[cell] = static_cast<std::uint8_t>(bits);
        found.push_back(cell);
        each_crossed_face(place_of_cell(cell), bits, [&](int, int, const Place& beyond) {
          if (!in_block(beyond)) return;
          const CellCode code = cell_code(beyond);
          if (seen_[code] == not_seen) next.push_back(code);
          seen_[code] = seen;
        });
      }
      frontier.swap(next);
    }
    std::sort(found.begin(), found.end());
    return found;
  }

  WallPiece piece_from(CellCode first) {
    WallPiece piece;
    piece.cells.push_back(first);
    seen_[first] = in_piece;
    for (std::size_t i = 0; i < piece.cells.size(); ++i) {
      const CellCode cell = piece.cells[i];
      const Place place = place_of_cell(cell);
      each_crossed_face(place, bits_[cell], [&](int axis, int side, const Place& beyond) {
        if (!in_block(beyond)) {
          if (is_first_exit(place, bits_[cell], axis, side))
            piece.exits.push_back(in_grid(beyond, block_.index));
          return;
        }
        const CellCode code = cell_code(beyond);
        if (seen_[code] == seen) piece.cells.push_back(code);
        seen_[code] = in_piece;
      });
    }
    std::sort(piece.cells.begin(), piece.cells.end());
    number_edges(piece);
    return piece;
  }

  // Going back through the face's crossed edges ends at a cell for which this holds.
  static bool is_first_exit(const Place& cell, unsigned bits, int axis, int side) {
    for (int other = 0; other < 3; ++other)
      if (other != axis && cell[static_cast<std::size_t>(other)] > 0 &&
          goes_on_before(bits, axis, side, other))
        return false;
    return true;
  }

  static int first_edge(CellCode cell) { return edge_code(node_code(place_of_cell(cell)), 0); }

  void number_edges(WallPiece& piece) {
    const auto& edges = geometry::cube_edges();
    std::array<std::uint64_t, (edge_codes + 63) / 64> marks{};
    for (const CellCode cell : piece.cells) {
      for (std::size_t e = 0; e < edges.size(); ++e) {
        if ((bits_[cell] >> edges[e].from & 1) == (bits_[cell] >> edges[e].to & 1)) continue;
        const auto code = static_cast<std::size_t>(first_edge(cell) + edge_steps()[e]);
        marks[code / 64] |= std::uint64_t{1} << code % 64;
      }
    }
    std::vector<EdgeCode> not_own;
    for (std::size_t word = 0; word < marks.size(); ++word) {
      for (std::uint64_t left = marks[word]; left != 0; left &= left - 1) {
        const auto code = static_cast<EdgeCode>(64 * word + static_cast<std::size_t>(std::countr_zero(left)));
        (is_own(code) ? piece.edges : not_own).push_back(code);
      }
    }
    piece.own = piece.edges.size();
    piece.edges.insert(piece.edges.end(), not_own.begin(), not_own.end());
  }

  geometry::TriMesh mesh_of(const WallPiece& piece) {
    geometry::TriMesh mesh;
    number_.resize(edge_codes);
    mesh.points.reserve(piece.edges.size());
    for (const EdgeCode edge : piece.edges) {
      number_[edge] = static_cast<std::int32_t>(mesh.points.size());
      mesh.points.push_back(lattice_.point(edge));
    }
    mesh.triangles.reserve(2 * piece.cells.size());
    for (const CellCode cell : piece.cells) {
      const int first = first_edge(cell);
      const auto point = [&](std::uint8_t edge) {
        return number_[static_cast<std::size_t>(first + edge_steps()[edge])];
      };
      for (const auto& t : geometry::cube_patterns()[bits_[cell]])
        mesh.triangles.push_back({point(t[0]), point(t[1]), point(t[2])});
    }
    return mesh;
  }

  WallJob& job_;
  WallBlock& block_;
  Lattice& lattice_;
  std::vector<std::uint8_t> bits_;    // of crossed cells
  std::vector<std::uint8_t> seen_;    // a State for each cell
  std::vector<std::int32_t> number_;  // of points, by edge
};

// Crossed cells around a seed's cell that is not crossed itself, where the wall may be near.
std::vector<GridIndex> starts_around(WallJob& job, const Lattice& lattice, CellCode code,
                                     const GridIndex& block) {
  const Place place = place_of_cell(code);
  // A field that runs on as in this cell has no wall in the next one.
  double sum = 0.0;
  Vec3 slope = Vec3::Zero();
  for (int corner = 0; corner < 8; ++corner) {
    const double value = lattice.value(corner_of(place, corner)) / 8.0;
    sum += value;
    for (int a = 0; a < 3; ++a) slope[a] += 2.0 * ((corner >> a & 1) != 0 ? value : -value);
  }
  if (std::abs(sum) > 2.0 * slope.lpNorm<1>()) return {};
  const GridIndex seed = in_grid(place, block);
  std::vector<Vec3> nodes;
  for (int z = -1; z <= 2; ++z)
    for (int y = -1; y <= 2; ++y)
      for (int x = -1; x <= 2; ++x) nodes.push_back(job.node({seed[0] + x, seed[1] + y, seed[2] + z}));
  const std::vector<double> values = job.ask(nodes);
  std::vector<GridIndex> found;
  for (int z = 0; z < 3; ++z) {
    for (int y = 0; y < 3; ++y) {
      for (int x = 0; x < 3; ++x) {
        unsigned inside = 0;
        for (int corner = 0; corner < 8; ++corner) {
          const Place at = corner_of({x, y, z}, corner);
          if (values[static_cast<std::size_t>(at[0] + 4 * (at[1] + 4 * at[2]))] < 0.0) inside |= 1u << corner;
        }
        if (crossed(inside)) found.push_back({seed[0] + x - 1, seed[1] + y - 1, seed[2] + z - 1});
      }
    }
  }
  return found;
}

/// What one call does in a block. The lattice is made when something has to be asked.
class BlockVisit {
 public:
  BlockVisit(WallJob& job, WallBlock& block, const WallBlocks& all) : job_(job), block_(block), all_(all) {}

  // Looks at seeds that the last call did not have, and forgets those that it had and this one has not.
  void know_seeds(const std::vector<CellCode>& cells) {
    const auto is = [](const WallSeed& seed, CellCode cell) { return seed.cell == cell; };
    if (std::equal(block_.seeds.begin(), block_.seeds.end(), cells.begin(), cells.end(), is)) return;
    std::vector<WallSeed> seeds;
    std::vector<CellCode> asked;
    auto known = block_.seeds.begin();
    for (const CellCode cell : cells) {
      while (known != block_.seeds.end() && known->cell < cell) ++known;
      if (known != block_.seeds.end() && known->cell == cell) {
        seeds.push_back(std::move(*known));
        continue;
      }
      asked.push_back(cell);
      seeds.push_back({cell, false, {}});
    }
    block_.seeds = std::move(seeds);
    if (asked.empty()) return;
    lattice().know(asked);
    auto next = asked.begin();
    for (WallSeed& seed : block_.seeds) {
      if (next == asked.end() || seed.cell != *next) continue;
      ++next;
      seed.crossed = crossed(lattice().bits(seed.cell));
      if (!seed.crossed) seed.others = starts_around(job_, lattice(), seed.cell, block_.index);
    }
  }

  std::vector<GridIndex> follow(const std::vector<GridIndex>& entries, bool from_seeds) {
    std::vector<GridIndex> out;
    std::vector<CellCode> cells;
    const auto enter = [&](const GridIndex& cell) {
      if (block_of(cell) == block_.index)
        cells.push_back(code_in_block(cell, block_.index));
      else
        out.push_back(cell);
    };
    for (const GridIndex& cell : entries) enter(cell);
    if (from_seeds) {
      for (const WallSeed& seed : block_.seeds) {
        if (seed.crossed) cells.push_back(seed.cell);
        for (const GridIndex& cell : seed.others) enter(cell);
      }
    }
    explore(cells);
    for (const CellCode cell : cells) {
      WallPiece* piece = block_.piece_at(cell);
      if (piece == nullptr || piece->reached) continue;
      piece->reached = true;
      out.insert(out.end(), piece->exits.begin(), piece->exits.end());
    }
    return out;
  }

 private:
  Lattice& lattice() {
    if (!lattice_) {
      lattice_.emplace(job_, block_, all_);
      // A wall that an edit moved is about where it was: asked in one batch, which is cheaper than in rings.
      lattice_->know(block_.likely);
      block_.likely.clear();
    }
    return *lattice_;
  }

  // Finds the pieces of cells that belong to none yet.
  void explore(const std::vector<CellCode>& cells) {
    std::vector<CellCode> unexplored;
    for (const CellCode cell : cells)
      if (block_.piece_at(cell) == nullptr) unexplored.push_back(cell);
    if (unexplored.empty()) return;
    std::sort(unexplored.begin(), unexplored.end());
    unexplored.erase(std::unique(unexplored.begin(), unexplored.end()), unexplored.end());
    Follower(job_, block_, lattice()).follow(std::move(unexplored));
    block_.number_pieces();
  }

  WallJob& job_;
  WallBlock& block_;
  const WallBlocks& all_;
  std::optional<Lattice> lattice_;
};

}  // namespace

std::vector<GridIndex> follow_wall(WallJob& job, WallBlock& block, const WallBlocks& all,
                                   const std::vector<CellCode>& seeds,
                                   const std::vector<GridIndex>& entries) {
  BlockVisit visit(job, block, all);
  if (!seeds.empty()) visit.know_seeds(seeds);
  return visit.follow(entries, !seeds.empty());
}

}  // namespace ostia::lumen
