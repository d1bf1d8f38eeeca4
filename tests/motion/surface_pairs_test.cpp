#include "surface_pairs.h"

#include "ostia/geometry/analytic_shapes.h"

#include <gtest/gtest.h>

namespace ostia::motion {
namespace {

using geometry::TriMesh;
using geometry::Vec3;

TriMesh tube_at(const Vec3& place) {
  TriMesh tube = geometry::structured_surface(geometry::straight_tube(30.0, 1.0).tubes[0], 16, 0.5);
  for (Vec3& p : tube.points) p += place;
  return tube;
}

TriMesh together(TriMesh a, const TriMesh& b) {
  const auto first = static_cast<std::int32_t>(a.points.size());
  a.points.insert(a.points.end(), b.points.begin(), b.points.end());
  for (const geometry::Triangle& t : b.triangles)
    a.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  return a;
}

struct Weights {
  double there = 0.0, missing = 0.0;  ///< sums: of the vessel that both have, of the one that one lacks
};
/// Two vessels 12 mm apart, of which the target has the first alone, 0.8 mm aside.
Weights weights(double looseness, bool target_lacks) {
  const TriMesh first = tube_at(Vec3::Zero()), both = together(first, tube_at(Vec3(12.0, 0.0, 0.0)));
  TriMesh moved = target_lacks ? first : both;
  for (Vec3& p : moved.points) p += Vec3(0.0, 0.8, 0.0);
  const TriMesh& source = target_lacks ? both : first;
  const geometry::CageGrid grid = geometry::cage_around(both.points, 1);
  PairedSurface from(source), to(moved);
  const auto pairs = surface_pairs(from, to, grid, {30.0, looseness, 1});
  Weights sums;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const Vec3& place = i < source.points.size() ? source.points[i] : moved.points[i - source.points.size()];
    (place.x() < 6.0 ? sums.there : sums.missing) += pairs[i].weight;
  }
  return sums;
}

TEST(SurfacePairs, AVesselThatTheTargetLacksIsPairedWithNoOther) {
  for (const double looseness : {1.0, 4.0, 16.0, 64.0}) {
    const Weights sums = weights(looseness, true);
    EXPECT_GT(sums.there, 100.0) << looseness;
    EXPECT_EQ(sums.missing, 0.0) << looseness;
  }
}

TEST(SurfacePairs, AVesselThatTheTemplateLacksIsPairedWithNoOther) {
  for (const double looseness : {1.0, 4.0, 16.0, 64.0}) {
    const Weights sums = weights(looseness, false);
    EXPECT_GT(sums.there, 100.0) << looseness;
    EXPECT_EQ(sums.missing, 0.0) << looseness;
  }
}

TEST(SurfacePairs, WhatLiesFarButBelongsTogetherIsPairedWhenLoose) {
  // One vessel whose second half is 6 mm off: its median distance says little of that half.
  TriMesh source = tube_at(Vec3::Zero()), target_mesh = source;
  for (Vec3& p : target_mesh.points)
    p.y() += 0.3 + 6.0 * std::pow(std::clamp((p.z() - 18.0) / 12.0, 0.0, 1.0), 2);
  const geometry::CageGrid grid = geometry::cage_around(source.points, 1);
  PairedSurface from(source), to(target_mesh);
  const auto sum_far = [&](double looseness) {
    double sum = 0.0;
    const auto pairs = surface_pairs(from, to, grid, {180.0, looseness, 1});
    for (std::size_t i = 0; i < source.points.size(); ++i)
      if (source.points[i].z() > 28.0) sum += pairs[i].weight;
    return sum;
  };
  EXPECT_GT(sum_far(64.0), 5.0 * std::max(0.1, sum_far(1.0)));
}

}  // namespace
}  // namespace ostia::motion
