#include "wall/lattice.h"

#include "wall/roots.h"

#include <cmath>
#include <limits>

namespace ostia::lumen {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

// Nodes brick by brick of 4^3: places that are asked together are cut into batches in this order, and a batch
// whose places are near one another shares the vessel's centres.
std::vector<NodeCode> ranks_by_brick() {
  std::vector<NodeCode> ranks(node_codes);
  NodeCode rank = 0;
  for (int brick = 0; brick < 125; ++brick) {
    const Place from{4 * (brick % 5), 4 * (brick / 5 % 5), 4 * (brick / 25)};
    for (int z = from[2]; z < std::min(from[2] + 4, block_nodes); ++z)
      for (int y = from[1]; y < std::min(from[1] + 4, block_nodes); ++y)
        for (int x = from[0]; x < std::min(from[0] + 4, block_nodes); ++x)
          ranks[node_code({x, y, z})] = rank++;
  }
  return ranks;
}

NodeCode rank_of(NodeCode node) {
  static const std::vector<NodeCode> ranks = ranks_by_brick();
  return ranks[node];
}

// The node that is there in this block, of a block a step away; -1 where it lies outside.
int moved(NodeCode code, const Place& step) {
  Place node = place_of_node(code);
  for (std::size_t a = 0; a < 3; ++a) {
    node[a] += block_cells * step[a];
    if (node[a] < 0 || node[a] > block_cells) return -1;
  }
  return node_code(node);
}

}  // namespace

Lattice::Lattice(WallJob& job, WallBlock& block, const WallBlocks& all)
    : job_(job), block_(block), values_(node_codes, unknown), crossings_(edge_codes, unknown) {
  load(block.kept);
  load(block.fresh);
  for (int z = -1; z <= 1; ++z)
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x) {
        if (x == 0 && y == 0 && z == 0) continue;
        const auto found = all.find({block.index[0] + x, block.index[1] + y, block.index[2] + z});
        if (found != all.end()) load_from_neighbour(found->second.kept, {x, y, z});
      }
}

void Lattice::load(const WallValues& known) {
  for (const auto& [code, value] : known.nodes) values_[code] = value;
  for (const auto& [code, fraction] : known.crossings) crossings_[code] = fraction;
}

void Lattice::load_from_neighbour(const WallValues& known, const Place& step) {
  for (const auto& [code, value] : known.nodes) {
    const int node = moved(code, step);
    if (node >= 0) values_[static_cast<std::size_t>(node)] = value;
  }
  for (const auto& [code, fraction] : known.crossings) {
    const int from = moved(node_of_edge(code), step), to = moved(end_of_edge(code), step);
    if (from >= 0 && to >= 0) crossings_[edge_code(static_cast<NodeCode>(from), code % 3)] = fraction;
  }
}

void Lattice::know(const std::vector<CellCode>& cells) {
  std::vector<NodeCode> nodes;
  for (const CellCode cell : cells) {
    const Place place = place_of_cell(cell);
    for (int corner = 0; corner < 8; ++corner) {
      const NodeCode node = node_code(corner_of(place, corner));
      if (!std::isnan(values_[node])) continue;
      values_[node] = 0.0;  // asked once
      nodes.push_back(node);
    }
  }
  if (nodes.empty()) return;
  std::sort(nodes.begin(), nodes.end(), [](NodeCode a, NodeCode b) { return rank_of(a) < rank_of(b); });
  std::vector<Vec3> places;
  places.reserve(nodes.size());
  for (const NodeCode node : nodes) places.push_back(job_.node(in_grid(place_of_node(node), block_.index)));
  const std::vector<double> found = job_.ask(places);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    values_[nodes[i]] = found[i];
    block_.fresh.nodes.emplace_back(nodes[i], found[i]);
  }
}

unsigned Lattice::bits(CellCode cell) const {
  const std::size_t lowest = node_code(place_of_cell(cell));
  unsigned inside = 0;
  for (int corner = 0; corner < 8; ++corner)
    if (values_[lowest + node_code(corner_of({0, 0, 0}, corner))] < 0.0) inside |= 1u << corner;
  return inside;
}

void Lattice::know_crossings(const std::vector<WallPiece>& pieces) {
  std::vector<EdgeCode> codes;
  for (const WallPiece& piece : pieces)
    for (const EdgeCode code : piece.edges)
      if (std::isnan(crossings_[code])) codes.push_back(code);
  std::sort(codes.begin(), codes.end(), [](EdgeCode a, EdgeCode b) {
    const NodeCode at_a = rank_of(node_of_edge(a)), at_b = rank_of(node_of_edge(b));
    return at_a != at_b ? at_a < at_b : a < b;
  });
  std::vector<WallEdge> edges;
  edges.reserve(codes.size());
  for (const EdgeCode code : codes)
    edges.push_back({in_grid(place_of_node(node_of_edge(code)), block_.index), code % 3,
                     values_[node_of_edge(code)], values_[end_of_edge(code)]});
  const std::vector<double> found = roots(job_, edges);
  for (std::size_t i = 0; i < codes.size(); ++i) {
    crossings_[codes[i]] = found[i];
    block_.fresh.crossings.emplace_back(codes[i], found[i]);
  }
}

}  // namespace ostia::lumen
