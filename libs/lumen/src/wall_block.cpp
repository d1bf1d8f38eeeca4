#include "wall_block.h"

#include "wall_roots.h"

#include "ostia/core/error.h"
#include "ostia/geometry/cube_patterns.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

namespace ostia::lumen {
namespace {

using Place = std::array<int, 3>;
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

bool in_block(const Place& cell) {
  return std::all_of(cell.begin(), cell.end(), [](int c) { return c >= 0 && c < block_cells; });
}
int cell_code(const Place& cell) {
  return cell[0] + block_cells * (cell[1] + block_cells * cell[2]);
}
Place corner_of(const Place& cell, int corner) {
  return {cell[0] + (corner & 1), cell[1] + (corner >> 1 & 1), cell[2] + (corner >> 2)};
}
Place in_steps(const GridIndex& cell, const GridIndex& block) {
  return {cell[0] - block[0] * block_cells, cell[1] - block[1] * block_cells,
          cell[2] - block[2] * block_cells};
}
GridIndex in_grid(const Place& place, const GridIndex& block) {
  return {place[0] + block[0] * block_cells, place[1] + block[1] * block_cells,
          place[2] + block[2] * block_cells};
}

// Whether the wall passes through a face of a cell with such corners.
bool face_crossed(unsigned bits, int axis, int side) {
  constexpr std::array<unsigned, 3> upper{0xAA, 0xCC, 0xF0};
  const unsigned upper_mask = upper[static_cast<std::size_t>(axis)],
                 mask = side != 0 ? upper_mask : 0xFF ^ upper_mask;
  return (bits & mask) != 0 && (bits & mask) != mask;
}
bool crossed(unsigned bits) {
  return bits != 0 && bits != 0xFF;
}

template <class Visit>
void each_crossed_face(const Place& cell, unsigned bits, const Visit& visit) {
  for (int axis = 0; axis < 3; ++axis) {
    for (int side = 0; side < 2; ++side) {
      if (!face_crossed(bits, axis, side)) continue;
      Place beyond = cell;
      beyond[static_cast<std::size_t>(axis)] += side != 0 ? 1 : -1;
      visit(beyond);
    }
  }
}

bool is_own(EdgeCode edge) {
  const Place node = place_of_node(static_cast<NodeCode>(edge / 3));
  return std::all_of(node.begin(), node.end(), [](int c) { return c < block_cells; });
}

/// What is known of a block while the wall is followed in it.
class Lattice {
 public:
  Lattice(WallJob& job, WallBlock& block, const WallBlocks& all)
      : job_(job), block_(block), values_(node_codes, unknown), crossings_(edge_codes, unknown) {
    load(block.kept, {0, 0, 0});
    load(block.fresh, {0, 0, 0});
    for (int z = -1; z <= 1; ++z)
      for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) load_neighbour(all, {x, y, z});
  }

  // The corners of cells, asked at once where they are not known.
  void know(const std::vector<CellCode>& cells) {
    std::vector<NodeCode> nodes;
    for (const CellCode cell : cells) {
      const Place place = place_of_cell(cell);
      for (int corner = 0; corner < 8; ++corner) {
        const int node = node_code(corner_of(place, corner));
        double& value = values_[static_cast<std::size_t>(node)];
        if (!std::isnan(value)) continue;
        value = 0.0;  // asked once
        nodes.push_back(static_cast<NodeCode>(node));
      }
    }
    std::vector<Vec3> places;
    for (const NodeCode node : nodes) places.push_back(job_.node(in_grid(place_of_node(node), block_.index)));
    const std::vector<double> found = job_.ask(places);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      values_[nodes[i]] = found[i];
      block_.fresh.nodes.emplace_back(nodes[i], found[i]);
    }
  }

  double value(const Place& node) const { return values_[static_cast<std::size_t>(node_code(node))]; }
  unsigned bits(CellCode cell) const {
    const Place place = place_of_cell(cell);
    unsigned inside = 0;
    for (int corner = 0; corner < 8; ++corner)
      if (value(corner_of(place, corner)) < 0.0) inside |= 1u << corner;
    return inside;
  }

  // Where edges are crossed, found at once where it is not known.
  void know_crossings(const std::vector<WallPiece>& pieces) {
    std::vector<EdgeCode> codes;
    for (const WallPiece& piece : pieces)
      for (const EdgeCode code : piece.edges)
        if (std::isnan(crossings_[code])) codes.push_back(code);
    std::vector<WallEdge> edges;
    for (const EdgeCode code : codes) {
      Place node = place_of_node(static_cast<NodeCode>(code / 3));
      WallEdge edge{in_grid(node, block_.index), code % 3, value(node), 0.0};
      ++node[static_cast<std::size_t>(edge.axis)];
      edge.to = value(node);
      edges.push_back(edge);
    }
    const std::vector<double> found = roots(job_, edges);
    for (std::size_t i = 0; i < codes.size(); ++i) {
      crossings_[codes[i]] = found[i];
      block_.fresh.crossings.emplace_back(codes[i], found[i]);
    }
  }
  Vec3 point(EdgeCode edge) const {
    const Place node = place_of_node(static_cast<NodeCode>(edge / 3));
    return job_.place(in_grid(node, block_.index), edge % 3, crossings_[edge]);
  }

 private:
  void load_neighbour(const WallBlocks& all, const Place& step) {
    if (step == Place{0, 0, 0}) return;
    const auto found =
        all.find({block_.index[0] + step[0], block_.index[1] + step[1], block_.index[2] + step[2]});
    if (found != all.end())
      load(found->second.kept, {step[0] * block_cells, step[1] * block_cells, step[2] * block_cells});
  }

  // What of another block's values, moved by a step, lies in this one.
  void load(const WallValues& known, const Place& step) {
    for (const auto& [code, value] : known.nodes) {
      const int node = moved(code, step);
      if (node >= 0) values_[static_cast<std::size_t>(node)] = value;
    }
    for (const auto& [code, fraction] : known.crossings) {
      const int node = moved(static_cast<NodeCode>(code / 3), step), axis = code % 3;
      if (node < 0 ||
          place_of_node(static_cast<NodeCode>(node))[static_cast<std::size_t>(axis)] == block_cells)
        continue;
      crossings_[static_cast<std::size_t>(3 * node + axis)] = fraction;
    }
  }
  static int moved(NodeCode code, const Place& step) {
    Place node = place_of_node(code);
    for (std::size_t a = 0; a < 3; ++a) {
      node[a] += step[a];
      if (node[a] < 0 || node[a] > block_cells) return -1;
    }
    return node_code(node);
  }

  WallJob& job_;
  WallBlock& block_;
  std::vector<double> values_, crossings_;
};

/// Finds the pieces that some cells belong to.
class Follower {
 public:
  Follower(WallJob& job, WallBlock& block, Lattice& lattice)
      : job_(job), block_(block), lattice_(lattice), bits_(cell_codes, 0) {}

  void follow(std::vector<CellCode> frontier) {
    std::vector<char> seen(cell_codes, 0);
    std::vector<CellCode> found, next;
    for (const CellCode cell : frontier) seen[cell] = 1;
    while (!frontier.empty()) {
      lattice_.know(frontier);
      next.clear();
      for (const CellCode cell : frontier) {
        const unsigned bits = lattice_.bits(cell);
        if (!crossed(bits)) continue;
        bits_[cell] = static_cast<std::uint8_t>(bits);
        found.push_back(cell);
        each_crossed_face(place_of_cell(cell), bits, [&](const Place& beyond) {
          if (!in_block(beyond)) return;
          const auto code = static_cast<CellCode>(cell_code(beyond));
          if (seen[code] == 0) next.push_back(code);
          seen[code] = 1;
        });
      }
      frontier.swap(next);
    }
    job_.count_cells(found.size());
    std::sort(found.begin(), found.end());
    std::vector<WallPiece> pieces;
    for (const CellCode cell : found)
      if (seen[cell] == 1) pieces.push_back(piece_from(cell, seen));
    lattice_.know_crossings(pieces);
    for (WallPiece& piece : pieces) {
      piece.mesh = std::make_shared<const geometry::TriMesh>(mesh_of(piece));
      block_.pieces.push_back(std::move(piece));
    }
    block_.made = block_.made || !found.empty();
  }

 private:
  WallPiece piece_from(CellCode first, std::vector<char>& seen) {
    WallPiece piece;
    piece.cells.push_back(first);
    seen[first] = 2;
    for (std::size_t i = 0; i < piece.cells.size(); ++i) {
      const CellCode cell = piece.cells[i];
      each_crossed_face(place_of_cell(cell), bits_[cell], [&](const Place& beyond) {
        if (!in_block(beyond)) {
          piece.exits.push_back(in_grid(beyond, block_.index));
          return;
        }
        const auto code = static_cast<CellCode>(cell_code(beyond));
        if (seen[code] == 1) piece.cells.push_back(code);
        seen[code] = 2;
      });
    }
    std::sort(piece.cells.begin(), piece.cells.end());
    number_edges(piece);
    return piece;
  }

  static EdgeCode edge_of(CellCode cell, std::size_t cube_edge) {
    const geometry::CubeEdge& edge = geometry::cube_edges()[cube_edge];
    return static_cast<EdgeCode>(3 * node_code(corner_of(place_of_cell(cell), edge.from)) + edge.axis);
  }

  void number_edges(WallPiece& piece) {
    const auto& edges = geometry::cube_edges();
    marks_.assign(edge_codes, 0);
    for (const CellCode cell : piece.cells)
      for (std::size_t e = 0; e < edges.size(); ++e)
        if ((bits_[cell] >> edges[e].from & 1) != (bits_[cell] >> edges[e].to & 1))
          marks_[edge_of(cell, e)] = 1;
    std::vector<EdgeCode> not_own;
    for (int edge = 0; edge < edge_codes; ++edge) {
      if (marks_[static_cast<std::size_t>(edge)] == 0) continue;
      const auto code = static_cast<EdgeCode>(edge);
      (is_own(code) ? piece.edges : not_own).push_back(code);
    }
    piece.own = piece.edges.size();
    piece.edges.insert(piece.edges.end(), not_own.begin(), not_own.end());
  }

  geometry::TriMesh mesh_of(const WallPiece& piece) const {
    geometry::TriMesh mesh;
    std::vector<std::int32_t> point(edge_codes);
    mesh.points.reserve(piece.edges.size());
    for (const EdgeCode edge : piece.edges) {
      point[edge] = static_cast<std::int32_t>(mesh.points.size());
      mesh.points.push_back(lattice_.point(edge));
    }
    mesh.triangles.reserve(2 * piece.cells.size());
    for (const CellCode cell : piece.cells)
      for (const auto& t : geometry::cube_patterns()[bits_[cell]])
        mesh.triangles.push_back(
            {point[edge_of(cell, t[0])], point[edge_of(cell, t[1])], point[edge_of(cell, t[2])]});
    return mesh;
  }

  WallJob& job_;
  WallBlock& block_;
  Lattice& lattice_;
  std::vector<std::uint8_t> bits_;   // of crossed cells
  std::vector<std::uint8_t> marks_;  // of edges
};

// Crossed cells among a seed's cell and, where that is not crossed but the wall may be near, those around it.
std::vector<GridIndex> starts_around(WallJob& job, const Lattice& lattice, const GridIndex& seed,
                                     const GridIndex& block) {
  const Place place = in_steps(seed, block);
  const unsigned bits = lattice.bits(static_cast<CellCode>(cell_code(place)));
  if (crossed(bits)) return {seed};
  // A field that runs on as in this cell has no wall in the next one.
  double sum = 0.0;
  Vec3 slope = Vec3::Zero();
  for (int corner = 0; corner < 8; ++corner) {
    const double value = lattice.value(corner_of(place, corner)) / 8.0;
    sum += value;
    for (int a = 0; a < 3; ++a) slope[a] += 2.0 * ((corner >> a & 1) != 0 ? value : -value);
  }
  if (std::abs(sum) > 2.0 * slope.lpNorm<1>()) return {};
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

void number_pieces(WallBlock& block) {
  block.piece_of.assign(block.pieces.empty() ? 0 : cell_codes, 0);
  for (std::size_t i = 0; i < block.pieces.size(); ++i)
    for (const CellCode cell : block.pieces[i].cells) block.piece_of[cell] = static_cast<std::int16_t>(i + 1);
}

}  // namespace

GridIndex block_of(const GridIndex& cell) {
  static_assert(block_cells == 16);
  return {cell[0] >> 4, cell[1] >> 4, cell[2] >> 4};  // rounds down, below zero too
}
CellCode code_in_block(const GridIndex& cell, const GridIndex& block) {
  return static_cast<CellCode>(cell_code(in_steps(cell, block)));
}
const WallPiece* WallBlock::piece_at(CellCode cell) const {
  const int piece = piece_of.empty() ? 0 : piece_of[cell];
  return piece == 0 ? nullptr : &pieces[static_cast<std::size_t>(piece - 1)];
}
std::array<int, 3> place_of_cell(CellCode code) {
  return {code % block_cells, code / block_cells % block_cells, code / (block_cells * block_cells)};
}
std::array<int, 3> place_of_node(NodeCode code) {
  return {code % block_nodes, code / block_nodes % block_nodes, code / (block_nodes * block_nodes)};
}
int node_code(const std::array<int, 3>& place) {
  return place[0] + block_nodes * (place[1] + block_nodes * place[2]);
}

Vec3 WallJob::node(const GridIndex& index) const {
  return {cell_mm_ * index[0], cell_mm_ * index[1], cell_mm_ * index[2]};
}
Vec3 WallJob::place(const GridIndex& index, int axis, double fraction) const {
  Vec3 at = node(index);
  at[axis] = cell_mm_ * (index[static_cast<std::size_t>(axis)] + fraction);
  return at;
}

std::vector<double> WallJob::ask(const std::vector<Vec3>& places) {
  std::vector<double> out(places.size());
  if (places.empty()) return out;
  field_.values(places, out);
  evaluations_ += places.size();
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (!std::isnan(out[i])) continue;
    throw InvalidInput("the lumen's field is not a number at " + std::to_string(places[i].x()) + ", " +
                       std::to_string(places[i].y()) + ", " + std::to_string(places[i].z()) +
                       " mm; solve its vessels again");
  }
  return out;
}

void WallJob::count_cells(std::size_t more) {
  if ((cells_ += more) <= largest_cells_) return;
  throw ResourceError("the lumen's wall passes more than " + std::to_string(largest_cells_) + " cells of " +
                      std::to_string(cell_mm_) +
                      " mm, more than the memory limit allows; take larger cells or raise memory_limit_mib");
}

std::vector<GridIndex> follow_wall(WallJob& job, WallBlock& block, const WallBlocks& all,
                                   const std::vector<GridIndex>& seeds,
                                   const std::vector<GridIndex>& entries) {
  std::optional<Lattice> lattice;
  const auto in_lattice = [&]() -> Lattice& {
    if (!lattice) lattice.emplace(job, block, all);
    return *lattice;
  };
  std::vector<CellCode> asked;
  for (const GridIndex& seed : seeds) {
    const auto code = code_in_block(seed, block.index);
    if (!block.starts.contains(code)) asked.push_back(code);
  }
  if (!asked.empty()) in_lattice().know(asked);
  for (const CellCode code : asked)
    block.starts[code] = starts_around(job, *lattice, in_grid(place_of_cell(code), block.index), block.index);

  std::vector<GridIndex> out;
  std::vector<CellCode> cells;
  const auto enter = [&](const GridIndex& cell) {
    if (block_of(cell) == block.index)
      cells.push_back(code_in_block(cell, block.index));
    else
      out.push_back(cell);
  };
  for (const GridIndex& seed : seeds)
    for (const GridIndex& cell : block.starts.at(code_in_block(seed, block.index))) enter(cell);
  for (const GridIndex& cell : entries) enter(cell);
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());

  std::vector<CellCode> unexplored;
  for (const CellCode cell : cells)
    if (block.piece_at(cell) == nullptr) unexplored.push_back(cell);
  if (!unexplored.empty()) {
    Follower(job, block, in_lattice()).follow(unexplored);
    number_pieces(block);
  }
  for (const CellCode cell : cells) {
    const int number = block.piece_of.empty() ? 0 : block.piece_of[cell];
    if (number == 0) continue;
    WallPiece& piece = block.pieces[static_cast<std::size_t>(number - 1)];
    if (piece.reached) continue;
    piece.reached = true;
    out.insert(out.end(), piece.exits.begin(), piece.exits.end());
  }
  return out;
}

bool depends_on(const WallBlock& block, const Box3& box, double cell_mm) {
  // A seed's surroundings reach one cell further.
  Vec3 low, high;
  for (int a = 0; a < 3; ++a) {
    const int first = block.index[static_cast<std::size_t>(a)] * block_cells;
    low[a] = cell_mm * (first - 1);
    high[a] = cell_mm * (first + block_cells + 1);
  }
  return box.intersects(Box3(low, high));
}

void forget(WallBlock& block, const Box3& changed, double cell_mm) {
  const auto at = [&](NodeCode code) -> Vec3 {
    const GridIndex node = in_grid(place_of_node(code), block.index);
    return {cell_mm * node[0], cell_mm * node[1], cell_mm * node[2]};
  };
  std::erase_if(block.kept.nodes, [&](const auto& known) { return changed.contains(at(known.first)); });
  std::erase_if(block.kept.crossings, [&](const auto& known) {
    const Vec3 from = at(static_cast<NodeCode>(known.first / 3));
    return changed.intersects(Box3(from, from + cell_mm * Vec3::Unit(known.first % 3)));
  });
  block.pieces.clear();
  block.piece_of.clear();
  block.starts.clear();
}

void settle(WallBlock& block) {
  const std::size_t dropped =
      std::erase_if(block.pieces, [](const WallPiece& piece) { return !piece.reached; });
  const auto by_cell = [](const WallPiece& a, const WallPiece& b) {
    return a.cells.front() < b.cells.front();
  };
  if (dropped > 0 || !std::is_sorted(block.pieces.begin(), block.pieces.end(), by_cell)) {
    std::sort(block.pieces.begin(), block.pieces.end(), by_cell);
    number_pieces(block);
  }
  block.kept.nodes.insert(block.kept.nodes.end(), block.fresh.nodes.begin(), block.fresh.nodes.end());
  block.kept.crossings.insert(block.kept.crossings.end(), block.fresh.crossings.begin(),
                              block.fresh.crossings.end());
  block.fresh = {};
}

}  // namespace ostia::lumen
