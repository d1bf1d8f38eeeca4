#include "scan/sparse_march.h"

#include "ostia/core/parallel.h"
#include "ostia/geometry/isosurface.h"
#include "ostia/geometry/zero_crossing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>
#include <vector>

namespace ostia::phantom {
namespace {

using geometry::Box3;
using geometry::TriMesh;

constexpr int brick_cells = 24, cell_block = 8, brick_nodes = brick_cells + 1;
constexpr std::size_t batch = 128;
/// Vertices stay this far (in steps) from the grid's nodes where they can: shorter edges help nobody.
constexpr double clearance = 0.06;

using Index = std::array<std::int64_t, 3>;

/// A grid edge: from a node one step along an axis.
struct EdgeKey {
  Index node{};
  int axis = 0;
  bool operator==(const EdgeKey&) const = default;
};
struct EdgeHash {
  std::size_t operator()(const EdgeKey& e) const {
    std::uint64_t h = static_cast<std::uint64_t>(e.axis) + 1;
    for (const std::int64_t i : e.node) h = (h ^ static_cast<std::uint64_t>(i)) * 0x9E3779B97F4A7C15ULL;
    return static_cast<std::size_t>(h ^ (h >> 29));
  }
};

/// The edge that a vertex in grid coordinates lies on: one coordinate is between two integers.
EdgeKey edge_of(const Vec3& p) {
  EdgeKey edge;
  double farthest = -1.0;
  for (int a = 0; a < 3; ++a) {
    const double off = std::abs(p[a] - std::round(p[a]));
    if (off > farthest) {
      farthest = off;
      edge.axis = a;
    }
  }
  for (int a = 0; a < 3; ++a)
    edge.node[static_cast<std::size_t>(a)] =
        static_cast<std::int64_t>(a == edge.axis ? std::floor(p[a]) : std::round(p[a]));
  return edge;
}

class Grid {
 public:
  Grid(const ImplicitField& f, const Box3& box, double spacing) : f_(f), h_(spacing) {
    // Off the round numbers where axes and ends like to lie.
    origin_ = box.min() - spacing * Vec3(1.137, 1.259, 1.381);
    for (int a = 0; a < 3; ++a)
      bricks_[static_cast<std::size_t>(a)] =
          static_cast<std::int64_t>(std::ceil((box.max()[a] - origin_[a]) / (brick_cells * spacing))) + 1;
  }

  Vec3 at(const Index& i) const {
    return origin_ +
           h_ * Vec3(static_cast<double>(i[0]), static_cast<double>(i[1]), static_cast<double>(i[2]));
  }

  /// First nodes of the bricks that the function is near to, by halving the grid.
  std::vector<Index> bricks() const {
    std::vector<Index> out;
    collect({0, 0, 0}, bricks_, out);
    std::sort(out.begin(), out.end());
    return out;
  }

  void fill(const Index& first, std::vector<float>& values) const {
    values.assign(brick_nodes * brick_nodes * brick_nodes, static_cast<float>(h_));
    for (int k = 0; k < brick_cells; k += cell_block)
      for (int j = 0; j < brick_cells; j += cell_block)
        for (int i = 0; i < brick_cells; i += cell_block) fill_block(first, {i, j, k}, values);
  }

  /// The crossing of a grid edge, on the surface: on the edge itself, but where that is next to a node on the
  /// surface beside it.
  Vec3 crossing(const EdgeKey& edge) const {
    const Vec3 a = at(edge.node);
    Vec3 b = a;
    b[edge.axis] += h_;
    const double t = root(a, b);
    const double inner = std::clamp(t, clearance, 1.0 - clearance);
    Vec3 p = a + inner * (b - a);
    if (inner == t || project(f_, p, 2.0 * clearance * h_)) return p;
    return a + std::clamp(t, 1e-3, 1.0 - 1e-3) * (b - a);
  }

 private:
  void collect(const Index& from, const Index& to, std::vector<Index>& out) const {
    if (from[0] >= to[0] || from[1] >= to[1] || from[2] >= to[2]) return;
    const auto corner = [](const Index& i) -> Index {
      return {i[0] * brick_cells, i[1] * brick_cells, i[2] * brick_cells};
    };
    if (!f_.near(Box3(at(corner(from)), at(corner(to))))) return;
    std::size_t axis = 0;
    for (std::size_t a = 1; a < 3; ++a)
      if (to[a] - from[a] > to[axis] - from[axis]) axis = a;
    if (to[axis] - from[axis] == 1) {
      out.push_back(corner(from));
      return;
    }
    Index low = to, high = from;
    low[axis] = high[axis] = (from[axis] + to[axis]) / 2;
    collect(from, low, out);
    collect(high, to, out);
  }

  /// A block with the nodes on its far sides: neighbours write the same values there, or far ones.
  void fill_block(const Index& first, const std::array<int, 3>& block, std::vector<float>& values) const {
    const Index low{first[0] + block[0], first[1] + block[1], first[2] + block[2]};
    const Index high{low[0] + cell_block, low[1] + cell_block, low[2] + cell_block};
    if (!f_.near(Box3(at(low), at(high)))) return;
    const Vec3 middle = 0.5 * (at(low) + at(high));
    const double half = 0.5 * (at(high) - at(low)).norm(), there = f_(middle);
    const bool inside = there < -1.6 * half - h_;  // the slope of the function is about one
    for (int k = 0; k <= cell_block; ++k)
      for (int j = 0; j <= cell_block; ++j)
        for (int i = 0; i <= cell_block; ++i) {
          const auto at_node = static_cast<std::size_t>(
              block[0] + i + brick_nodes * (block[1] + j + brick_nodes * (block[2] + k)));
          values[at_node] = static_cast<float>(inside ? there : f_(at({low[0] + i, low[1] + j, low[2] + k})));
        }
  }

  /// The zero between two points of opposite sign, as a fraction.
  double root(const Vec3& a, const Vec3& b) const {
    return geometry::zero_crossing([&](double t) { return f_(a + t * (b - a)); },
                                   {.value = 1e-10, .bracket = 1e-13, .most_iterations = 60});
  }

  const ImplicitField& f_;
  double h_;
  Vec3 origin_;
  Index bricks_{};
};

}  // namespace

bool project(const ImplicitField& f, Vec3& point, double reach_mm) {
  constexpr double step = 1e-4;
  Vec3 p = point;
  for (int iteration = 0; iteration < 12; ++iteration) {
    const double value = f(p);
    if (std::abs(value) < 1e-9) {
      if ((p - point).norm() > reach_mm) return false;
      point = p;
      return true;
    }
    Vec3 slope;
    for (int a = 0; a < 3; ++a) {
      Vec3 aside = p;
      aside[a] += step;
      const double ahead = f(aside);
      aside[a] -= 2.0 * step;
      slope[a] = (ahead - f(aside)) / (2.0 * step);
    }
    const double steep = slope.squaredNorm();
    if (!(steep > 0.04)) return false;
    p -= value / steep * slope;
    if ((p - point).norm() > 2.0 * reach_mm) return false;
  }
  return false;
}

TriMesh sparse_march(const ImplicitField& f, const Box3& box, double spacing_mm,
                     const core::TaskContext& task) {
  const Grid grid(f, box, spacing_mm);
  const std::vector<Index> bricks = grid.bricks();
  std::unordered_map<EdgeKey, std::int32_t, EdgeHash> number;
  std::vector<EdgeKey> edges;
  TriMesh mesh;
  std::vector<std::vector<float>> values(batch);
  for (std::size_t from = 0; from < bricks.size(); from += batch) {
    task.throw_if_cancelled();
    task.set_progress(0.8 * static_cast<double>(from) / static_cast<double>(bricks.size()));
    const std::size_t count = std::min(batch, bricks.size() - from);
    core::parallel_for(count, 1, [&](std::size_t i) { grid.fill(bricks[from + i], values[i]); });
    for (std::size_t b = 0; b < count; ++b) {
      const std::vector<float>& v = values[b];
      if (std::all_of(v.begin(), v.end(), [](float x) { return x >= 0.0f; })) continue;
      geometry::ScalarGrid scalar;
      scalar.size = {brick_nodes, brick_nodes, brick_nodes};
      scalar.values = v.data();
      const Index& first = bricks[from + b];
      scalar.origin =
          Vec3(static_cast<double>(first[0]), static_cast<double>(first[1]), static_cast<double>(first[2]));
      const TriMesh part = geometry::isosurface(scalar, 0.0f, false);
      std::vector<std::int32_t> renumbered;
      renumbered.reserve(part.points.size());
      for (const Vec3& p : part.points) {
        const EdgeKey edge = edge_of(p);
        const auto [known, added] = number.try_emplace(edge, static_cast<std::int32_t>(edges.size()));
        if (added) edges.push_back(edge);
        renumbered.push_back(known->second);
      }
      for (const geometry::Triangle& t : part.triangles)
        mesh.triangles.push_back({renumbered[static_cast<std::size_t>(t[0])],
                                  renumbered[static_cast<std::size_t>(t[1])],
                                  renumbered[static_cast<std::size_t>(t[2])]});
    }
  }
  mesh.points.resize(edges.size());
  constexpr std::size_t grain = 4096;
  core::parallel_chunks(edges.size(), grain, [&](std::size_t first, std::size_t last) {
    task.throw_if_cancelled();
    for (std::size_t i = first; i < last; ++i) mesh.points[i] = grid.crossing(edges[i]);
  });
  task.set_progress(1.0);
  return mesh;
}

}  // namespace ostia::phantom
