#pragma once
/// \file Surfaces whose area, volume, distances and faults are known beforehand.

#include "ostia/geometry/tri_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

namespace ostia::geometry::test {

inline void turn_over(TriMesh& mesh) {
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
}

/// Outward, closed: 20 * 4^levels triangles, points on the sphere.
inline TriMesh icosphere(int levels, double radius = 1.0, const Vec3& center = Vec3::Zero()) {
  const double g = std::numbers::phi;
  TriMesh mesh;
  mesh.points = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                 {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  mesh.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                    {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                    {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> middles;
    const auto middle = [&](std::int32_t a, std::int32_t b) {
      const std::pair<std::int32_t, std::int32_t> edge = std::minmax(a, b);
      const auto [entry, added] = middles.try_emplace(edge, static_cast<std::int32_t>(mesh.points.size()));
      if (added) {
        const Vec3 sum = mesh.points[static_cast<std::size_t>(a)] + mesh.points[static_cast<std::size_t>(b)];
        mesh.points.push_back(0.5 * sum);
      }
      return entry->second;
    };
    std::vector<Triangle> finer;
    for (const auto& [a, b, c] : mesh.triangles) {
      const std::int32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    mesh.triangles = std::move(finer);
    for (Vec3& p : mesh.points) p.normalize();
  }
  for (Vec3& p : mesh.points) p = center + radius * p.normalized();
  return mesh;
}

/// Outward, closed, 12 triangles.
inline TriMesh box(const Vec3& lower, const Vec3& upper) {
  TriMesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.points.emplace_back(i & 1 ? upper.x() : lower.x(), i & 2 ? upper.y() : lower.y(),
                             i & 4 ? upper.z() : lower.z());
  }
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

/// Open tube along z from 0 to `length`, outward; point ring * around + i.
inline TriMesh tube(int around, int rings, double radius = 1.0, double length = 4.0) {
  TriMesh mesh;
  for (int r = 0; r < rings; ++r) {
    for (int i = 0; i < around; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / around;
      mesh.points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), length * r / (rings - 1));
    }
  }
  for (int r = 0; r + 1 < rings; ++r) {
    for (int i = 0; i < around; ++i) {
      const int a = r * around + i, b = r * around + (i + 1) % around;
      mesh.triangles.push_back({a, b, b + around});
      mesh.triangles.push_back({a, b + around, a + around});
    }
  }
  return mesh;
}

/// Outward, closed, around the z axis.
inline TriMesh torus(int around, int across, double large = 3.0, double small = 1.0) {
  TriMesh mesh;
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      const double u = 2.0 * std::numbers::pi * i / around, v = 2.0 * std::numbers::pi * j / across;
      const double r = large + small * std::cos(v);
      mesh.points.emplace_back(r * std::cos(u), r * std::sin(u), small * std::sin(v));
    }
  }
  const auto at = [&](int i, int j) { return (i % around) * across + j % across; };
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

/// One half twist: an even number of quads that no turning makes consistent.
inline TriMesh moebius(int segments) {
  TriMesh mesh;
  for (int i = 0; i < segments; ++i) {
    const double u = 2.0 * std::numbers::pi * i / segments;
    for (const double w : {-0.5, 0.5}) {
      const double r = 2.0 + w * std::cos(u / 2);
      mesh.points.emplace_back(r * std::cos(u), r * std::sin(u), w * std::sin(u / 2));
    }
  }
  for (int i = 0; i < segments; ++i) {
    const bool last = i + 1 == segments;
    const int a = 2 * i, b = 2 * i + 1, c = last ? 1 : a + 2, d = last ? 0 : a + 3;
    mesh.triangles.push_back({a, c, b});
    mesh.triangles.push_back({b, c, d});
  }
  return mesh;
}

inline std::vector<Vec3> random_points(std::size_t count, double half_width, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(-half_width, half_width);
  std::vector<Vec3> points(count);
  for (Vec3& p : points) {
    for (int a = 0; a < 3; ++a) p[a] = uniform(generator);
  }
  return points;
}

}  // namespace ostia::geometry::test
