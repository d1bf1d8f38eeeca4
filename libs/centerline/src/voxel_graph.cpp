#include "voxel_graph.h"

#include "simple_point.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <numeric>
#include <set>
#include <string>

namespace ostia::centerline::detail {
namespace {

// Vertices - edges + faces - cubes of the closed voxels' union.
std::int64_t euler_number(const std::vector<Cell>& cells) {
  std::set<Cell> parts;
  for (const Cell& c : cells)
    for (std::int64_t z = 0; z <= 2; ++z)
      for (std::int64_t y = 0; y <= 2; ++y)
        for (std::int64_t x = 0; x <= 2; ++x) parts.insert({2 * c[0] + x, 2 * c[1] + y, 2 * c[2] + z});
  std::int64_t sum = 0;
  for (const Cell& p : parts) sum += ((p[0] ^ p[1] ^ p[2]) & 1) != 0 ? -1 : 1;
  return sum;
}

// Whether some background is shut in by the cells (by faces).
bool encloses(const std::vector<Cell>& cells) {
  if (cells.size() < 6) return false;
  Cell low = cells.front(), high = cells.front();
  for (const Cell& c : cells)
    for (std::size_t d = 0; d < 3; ++d) {
      low[d] = std::min(low[d], c[d] - 1);
      high[d] = std::max(high[d], c[d] + 1);
    }
  const Cell size{high[0] - low[0] + 1, high[1] - low[1] + 1, high[2] - low[2] + 1};
  const auto offset = [&](const Cell& c) {
    return static_cast<std::size_t>((c[0] - low[0]) +
                                    size[0] * ((c[1] - low[1]) + size[1] * (c[2] - low[2])));
  };
  std::vector<bool> seen(static_cast<std::size_t>(size[0] * size[1] * size[2]), false);
  for (const Cell& c : cells) seen[offset(c)] = true;
  std::size_t count = cells.size();
  std::vector<Cell> open{low};
  seen[0] = true;
  while (!open.empty()) {
    const Cell c = open.back();
    open.pop_back();
    ++count;
    for (std::size_t d = 0; d < 3; ++d)
      for (const std::int64_t step : {-1, 1}) {
        Cell next = c;
        next[d] += step;
        if (next[d] < low[d] || next[d] > high[d] || seen[offset(next)]) continue;
        seen[offset(next)] = true;
        open.push_back(next);
      }
  }
  return count < seen.size();
}

std::int64_t squared_length(const Cell& a, const Cell& b) {
  std::int64_t sum = 0;
  for (std::size_t d = 0; d < 3; ++d) sum += (a[d] - b[d]) * (a[d] - b[d]);
  return sum;
}

// The lines that span a cluster and its loops. Generators of the first homology of the cliques' complex are
// the lines that a shortest spanning tree leaves out; each triangle is a relation between them modulo 2. What
// no relation's last generator is, spans a loop of its own.
class LoopLines {
 public:
  LoopLines(const SkeletonVoxels& skeleton, const std::vector<std::int32_t>& voxels)
      : skeleton_(skeleton), voxels_(voxels), root_(voxels.size()) {
    std::iota(root_.begin(), root_.end(), 0);
    for (std::size_t a = 0; a < voxels.size(); ++a)
      for (const std::int32_t w : neighbours(voxels[a])) {
        const auto b = std::lower_bound(voxels.begin(), voxels.end(), w);
        if (w > voxels[a] && b != voxels.end() && *b == w)
          lines_.push_back({squared_length(cell(voxels[a]), cell(w)), {voxels[a], w}});
      }
    std::sort(lines_.begin(), lines_.end());
  }

  std::vector<std::pair<std::int32_t, std::int32_t>> find() {
    std::vector<std::pair<std::int32_t, std::int32_t>> kept;
    generator_.assign(lines_.size(), -1);
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      if (join(lines_[i].second))
        kept.push_back(lines_[i].second);
      else
        generator_[i] = static_cast<std::int32_t>(i);
    }
    relations_.assign(lines_.size(), {});
    for (std::size_t i = 0; i < lines_.size(); ++i) add_triangles(i);
    for (std::size_t i = 0; i < lines_.size(); ++i)
      if (generator_[i] >= 0 && relations_[i].empty()) kept.push_back(lines_[i].second);
    return kept;
  }

 private:
  using Line = std::pair<std::int32_t, std::int32_t>;

  const Cell& cell(std::int32_t v) const { return skeleton_.cells[static_cast<std::size_t>(v)]; }
  const std::vector<std::int32_t>& neighbours(std::int32_t v) const {
    return skeleton_.neighbours[static_cast<std::size_t>(v)];
  }
  std::size_t place(std::int32_t v) const {
    return static_cast<std::size_t>(std::lower_bound(voxels_.begin(), voxels_.end(), v) - voxels_.begin());
  }
  std::size_t root(std::size_t a) {
    while (root_[a] != a) a = root_[a] = root_[root_[a]];
    return a;
  }
  bool join(const Line& line) {
    const std::size_t a = root(place(line.first)), b = root(place(line.second));
    root_[a] = b;
    return a != b;
  }
  std::int32_t line_of(std::int32_t a, std::int32_t b) const {
    const std::pair<std::int64_t, Line> key{squared_length(cell(a), cell(b)), std::minmax(a, b)};
    const auto at = std::lower_bound(lines_.begin(), lines_.end(), key);
    return at != lines_.end() && *at == key ? static_cast<std::int32_t>(at - lines_.begin()) : -1;
  }

  // Triangles of which line i is the last.
  void add_triangles(std::size_t i) {
    const auto [a, b] = lines_[i].second;
    for (const std::int32_t c : neighbours(a)) {
      if (c == b) continue;
      const std::int32_t p = line_of(a, c), q = line_of(b, c);
      if (p < 0 || q < 0 || std::max(p, q) > static_cast<std::int32_t>(i)) continue;
      std::set<std::int32_t> relation;
      for (const std::int32_t line : {static_cast<std::int32_t>(i), p, q})
        if (generator_[static_cast<std::size_t>(line)] >= 0) relation.insert(line);
      reduce(std::move(relation));
    }
  }

  void reduce(std::set<std::int32_t> relation) {
    while (!relation.empty()) {
      auto& pivot = relations_[static_cast<std::size_t>(*relation.rbegin())];
      if (pivot.empty()) {
        pivot = std::move(relation);
        return;
      }
      for (const std::int32_t line : pivot)
        if (!relation.insert(line).second) relation.erase(line);
    }
  }

  const SkeletonVoxels& skeleton_;
  const std::vector<std::int32_t>& voxels_;
  std::vector<std::size_t> root_;
  std::vector<std::pair<std::int64_t, Line>> lines_;  // shortest first
  std::vector<std::int32_t> generator_;               // -1: in the spanning tree
  std::vector<std::set<std::int32_t>> relations_;     // by the last generator
};

Cluster grown(const SkeletonVoxels& skeleton, std::int32_t seed, std::int32_t number,
              std::vector<std::int32_t>& cluster_of) {
  Cluster cluster;
  std::vector<std::int32_t> open{seed};
  cluster_of[static_cast<std::size_t>(seed)] = number;
  while (!open.empty()) {
    const std::int32_t v = open.back();
    open.pop_back();
    cluster.voxels.push_back(v);
    for (const std::int32_t w : skeleton.neighbours[static_cast<std::size_t>(v)]) {
      if (skeleton.degree(w) < 3 || cluster_of[static_cast<std::size_t>(w)] >= 0) continue;
      cluster_of[static_cast<std::size_t>(w)] = number;
      open.push_back(w);
    }
  }
  std::sort(cluster.voxels.begin(), cluster.voxels.end());
  return cluster;
}

}  // namespace

SkeletonVoxels neighbours_of(const Thinned& skeleton) {
  const imaging::Geometry& grid = skeleton.mask.geometry;
  SkeletonVoxels result;
  result.cells.reserve(skeleton.voxels.size());
  for (const std::int64_t v : skeleton.voxels)
    result.cells.push_back(
        {v % grid.size[0], v / grid.size[0] % grid.size[1], v / (grid.size[0] * grid.size[1])});
  result.neighbours.resize(result.cells.size());
  for (std::size_t v = 0; v < result.cells.size(); ++v) {
    std::uint32_t around = 0;
    for (int n = 0; n < neighbour_count; ++n) {
      const Step s = neighbour_step(n);
      const Cell at{result.cells[v][0] + s.x, result.cells[v][1] + s.y, result.cells[v][2] + s.z};
      bool inside = true;
      for (std::size_t d = 0; d < 3; ++d) inside = inside && at[d] >= 0 && at[d] < grid.size[d];
      if (!inside || skeleton.mask(at[0], at[1], at[2]) == 0) continue;
      around |= 1U << n;
      const auto found =
          std::lower_bound(skeleton.voxels.begin(), skeleton.voxels.end(), grid.offset(at[0], at[1], at[2]));
      result.neighbours[v].push_back(static_cast<std::int32_t>(found - skeleton.voxels.begin()));
    }
    if (result.neighbours[v].size() > 1 && is_simple(around))
      throw InvalidInput("skeleton graph: the mask is not thin: voxel (" +
                         std::to_string(result.cells[v][0]) + ", " + std::to_string(result.cells[v][1]) +
                         ", " + std::to_string(result.cells[v][2]) +
                         ") could still be removed; use thinned() first");
  }
  return result;
}

std::vector<Cluster> clusters_of(const SkeletonVoxels& skeleton, std::vector<std::int32_t>& cluster_of) {
  cluster_of.assign(skeleton.cells.size(), -1);
  std::vector<Cluster> clusters;
  for (std::size_t v = 0; v < skeleton.cells.size(); ++v) {
    const auto seed = static_cast<std::int32_t>(v);
    if (skeleton.degree(seed) < 3 || cluster_of[v] >= 0) continue;
    clusters.push_back(grown(skeleton, seed, static_cast<std::int32_t>(clusters.size()), cluster_of));
    Cluster& cluster = clusters.back();
    std::vector<Cell> cells;
    for (const std::int32_t w : cluster.voxels) cells.push_back(skeleton.cells[static_cast<std::size_t>(w)]);
    if (encloses(cells))
      throw GeometryError("skeleton graph: " + std::to_string(cells.size()) + " voxels at (" +
                          std::to_string(cells[0][0]) + ", " + std::to_string(cells[0][1]) + ", " +
                          std::to_string(cells[0][2]) +
                          ") are a closed surface, since the object has a cavity there; thin it with "
                          "fill_cavities");
    if (euler_number(cells) != 1) cluster.lines = LoopLines(skeleton, cluster.voxels).find();
  }
  return clusters;
}

}  // namespace ostia::centerline::detail
