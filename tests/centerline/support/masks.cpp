#include "support/masks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace ostia::centerline::test {
namespace {

using imaging::MaskVolume;

std::int64_t fill(std::vector<std::uint8_t>& cells, const std::array<std::int64_t, 3>& size,
                  std::uint8_t value, bool by_faces) {
  std::int64_t count = 0;
  std::vector<std::array<std::int64_t, 3>> open;
  const auto at = [&](const std::array<std::int64_t, 3>& c) {
    return static_cast<std::size_t>(c[0] + size[0] * (c[1] + size[1] * c[2]));
  };
  for (std::int64_t z = 0; z < size[2]; ++z)
    for (std::int64_t y = 0; y < size[1]; ++y)
      for (std::int64_t x = 0; x < size[0]; ++x) {
        if (cells[at({x, y, z})] != value) continue;
        ++count;
        open.push_back({x, y, z});
        cells[at({x, y, z})] = 9;
        while (!open.empty()) {
          const auto c = open.back();
          open.pop_back();
          for (int dz = -1; dz <= 1; ++dz)
            for (int dy = -1; dy <= 1; ++dy)
              for (int dx = -1; dx <= 1; ++dx) {
                if (by_faces && std::abs(dx) + std::abs(dy) + std::abs(dz) != 1) continue;
                const std::array<std::int64_t, 3> n{c[0] + dx, c[1] + dy, c[2] + dz};
                bool inside = true;
                for (std::size_t d = 0; d < 3; ++d) inside = inside && n[d] >= 0 && n[d] < size[d];
                if (!inside || cells[at(n)] != value) continue;
                cells[at(n)] = 9;
                open.push_back(n);
              }
        }
      }
  return count;
}

// Vertices - edges + faces - cubes: a cell is there where a voxel beside it is.
std::int64_t euler_of(const std::vector<std::uint8_t>& padded, const std::array<std::int64_t, 3>& size) {
  std::int64_t sum = 0;
  for (std::int64_t z = 1; z <= 2 * size[2] - 1; ++z)
    for (std::int64_t y = 1; y <= 2 * size[1] - 1; ++y)
      for (std::int64_t x = 1; x <= 2 * size[0] - 1; ++x) {
        // Odd: the middle of a voxel; even: the plane between two.
        bool there = false;
        for (std::int64_t k = (z - 1) / 2; k <= z / 2 && !there; ++k)
          for (std::int64_t j = (y - 1) / 2; j <= y / 2 && !there; ++j)
            for (std::int64_t i = (x - 1) / 2; i <= x / 2 && !there; ++i)
              there = i < size[0] && j < size[1] && k < size[2] &&
                      padded[static_cast<std::size_t>(i + size[0] * (j + size[1] * k))] != 0;
        if (!there) continue;
        const std::int64_t dimension = x % 2 + y % 2 + z % 2;
        sum += dimension % 2 == 0 ? 1 : -1;
      }
  return sum;
}

}  // namespace

MaskVolume mask_of(const imaging::Geometry& grid, const std::function<bool(const Vec3&)>& inside) {
  MaskVolume mask;
  mask.geometry = grid;
  mask.voxels.assign(static_cast<std::size_t>(grid.voxels()), 0);
  std::size_t v = 0;
  for (std::int64_t k = 0; k < grid.size[2]; ++k)
    for (std::int64_t j = 0; j < grid.size[1]; ++j)
      for (std::int64_t i = 0; i < grid.size[0]; ++i, ++v)
        mask.voxels[v] =
            inside(grid.world(Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k))))
                ? 1
                : 0;
  return mask;
}

imaging::Geometry grid_of(std::int64_t x, std::int64_t y, std::int64_t z, const Vec3& spacing) {
  imaging::Geometry grid;
  grid.size = {x, y, z};
  grid.spacing = spacing;
  return grid;
}

double to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (p - a - t * (b - a)).norm();
}

bool in_tube(const Vec3& p, const Vec3& a, const Vec3& b, double radius) {
  const double t = (p - a).dot(b - a) / (b - a).squaredNorm();
  return t >= 0.0 && t <= 1.0 && (p - a - t * (b - a)).norm() <= radius;
}

Topology topology_of(const MaskVolume& mask) {
  const auto& n = mask.geometry.size;
  const std::array<std::int64_t, 3> size{n[0] + 2, n[1] + 2, n[2] + 2};
  std::vector<std::uint8_t> padded(static_cast<std::size_t>(size[0] * size[1] * size[2]), 0);
  for (std::int64_t k = 0; k < n[2]; ++k)
    for (std::int64_t j = 0; j < n[1]; ++j)
      for (std::int64_t i = 0; i < n[0]; ++i)
        padded[static_cast<std::size_t>(i + 1 + size[0] * (j + 1 + size[1] * (k + 1)))] = mask(i, j, k) != 0;
  Topology t;
  t.euler = euler_of(padded, size);
  t.cavities = fill(padded, size, 0, true) - 1;
  t.components = fill(padded, size, 1, false);
  t.loops = t.components + t.cavities - t.euler;
  return t;
}

MaskVolume random_blobs(std::uint64_t seed, std::int64_t size, const Vec3& spacing) {
  std::mt19937_64 random(seed);
  const auto part = [&] { return static_cast<double>(random() >> 11) / 9007199254740992.0; };
  const double side = static_cast<double>(size - 1);
  std::vector<std::pair<Vec3, double>> balls;
  for (int i = 0; i < 40; ++i) {
    const double x = part(), y = part(), z = part();
    balls.emplace_back(Vec3(x, y, z).cwiseProduct(side * spacing), (1.0 + 3.5 * part()) * spacing.mean());
  }
  MaskVolume mask = mask_of(grid_of(size, size, size, spacing), [&](const Vec3& p) {
    return std::any_of(balls.begin(), balls.end(),
                       [&](const auto& b) { return (p - b.first).norm() <= b.second; });
  });
  // Holes of single voxels.
  for (int i = 0; i < 60; ++i) mask.voxels[static_cast<std::size_t>(random() % mask.voxels.size())] = 0;
  return mask;
}

MaskVolume random_voxels(std::uint64_t seed, std::int64_t size, double share) {
  std::mt19937_64 random(seed);
  return mask_of(grid_of(size, size, size), [&](const Vec3&) {
    return static_cast<double>(random() >> 11) / 9007199254740992.0 < share;
  });
}

SkeletonGraph graph_of(const MaskVolume& mask) {
  return skeleton_graph(thinned(mask));
}

double total_length(const SkeletonGraph& graph) {
  double sum = 0.0;
  for (const SkeletonEdge& e : graph.edges) sum += length_mm(e);
  return sum;
}

std::vector<SkeletonNode> nodes_of(const SkeletonGraph& graph, SkeletonNodeKind kind) {
  std::vector<SkeletonNode> found;
  for (const SkeletonNode& n : graph.nodes)
    if (n.kind == kind) found.push_back(n);
  return found;
}

}  // namespace ostia::centerline::test
