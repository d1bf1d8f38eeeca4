#include "test_meshes.h"

#include "ostia/core/error.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/geometry/smoothing.h"
#include "ostia/geometry/tree_parts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <set>

namespace ostia::geometry {
namespace {

constexpr int thin_around =
    10;  // points about a thin vessel: Taubin's pass band does not hold so round a wave
constexpr double thin_length = 24.0;

/// A thin tube of few triangles around, its points shaken.
TriMesh shaken_tube(double by) {
  TriMesh mesh = test::tube(thin_around, 61, 1.0, thin_length);
  const auto moves = test::random_points(mesh.points.size(), by, 7);
  for (std::size_t p = 0; p < mesh.points.size(); ++p) mesh.points[p] += moves[p];
  return mesh;
}

double volume_when_closed(const TriMesh& mesh) {
  return std::abs(volume(fill_holes(mesh).mesh));
}

double spread_of_radius(const TriMesh& mesh) {
  double sum = 0.0, squares = 0.0;
  for (const Vec3& p : mesh.points) {
    const double r = p.head<2>().norm();
    sum += r;
    squares += r * r;
  }
  const auto n = static_cast<double>(mesh.points.size());
  return std::sqrt(std::max(0.0, squares / n - sum * sum / (n * n)));
}

TEST(VolumeSmoothing, AThinVesselKeepsItsCalibre) {
  const TriMesh rough = shaken_tube(0.08);
  const double true_volume =
      thin_length * 0.5 * thin_around *
      std::sin(2.0 * std::numbers::pi / thin_around);  // of the prism before it was shaken
  VolumeSmoothingOptions options;
  options.filter.iterations = 100;
  const TriMesh smooth = smoothed_in_volume(rough, options), taubin = taubin_smoothed(rough, options.filter);
  EXPECT_LT(spread_of_radius(smooth), 0.6 * spread_of_radius(rough));
  EXPECT_NEAR(volume_when_closed(smooth), true_volume, 0.015 * true_volume);
  EXPECT_GT(std::abs(volume_when_closed(taubin) - true_volume),
            2.0 * std::abs(volume_when_closed(smooth) - true_volume));
  EXPECT_EQ(smooth.triangles, rough.triangles);
}

TEST(VolumeSmoothing, OnlyFreePointsMoveAndBordersWhereTheyMay) {
  const TriMesh rough = shaken_tube(0.08);
  VolumeSmoothingOptions options;
  options.free.assign(rough.points.size(), false);
  for (std::size_t p = 0; p < rough.points.size(); ++p) options.free[p] = p / thin_around < 20;
  const auto moved = [&](const TriMesh& smooth, std::size_t p) {
    return (smooth.points[p] - rough.points[p]).norm() > 0.0;
  };
  const TriMesh stays = smoothed_in_volume(rough, options);
  EXPECT_TRUE(moved(stays, 10 * thin_around));
  EXPECT_FALSE(moved(stays, 0)) << "a border";
  for (std::size_t p = 20 * thin_around; p < rough.points.size(); ++p) EXPECT_FALSE(moved(stays, p));
  options.borders_move = true;
  const TriMesh moves = smoothed_in_volume(rough, options);
  EXPECT_TRUE(moved(moves, 0));
  for (std::size_t p = 20 * thin_around; p < rough.points.size(); ++p) EXPECT_FALSE(moved(moves, p));
}

TEST(VolumeSmoothing, RefusesBadInput) {
  TriMesh mesh = shaken_tube(0.0);
  VolumeSmoothingOptions options;
  options.free.assign(3, true);
  EXPECT_THROW(smoothed_in_volume(mesh, options), InvalidInput);
  options = {};
  options.mean_rings = 0;
  EXPECT_THROW(smoothed_in_volume(mesh, options), InvalidInput);
  options = {};
  options.restoring_rounds = -1;
  EXPECT_THROW(smoothed_in_volume(mesh, options), InvalidInput);
  mesh.points[5].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(smoothed_in_volume(mesh), InvalidInput);
}

VesselTree tree_of_one_vessel(std::int32_t first_id) {
  VesselTree tree;
  tree.nodes.resize(2);
  tree.nodes[0].id = first_id;
  tree.nodes[1].id = first_id + 1;
  tree.segments.resize(1);
  tree.segments[0].id = first_id;
  tree.segments[0].from = first_id;
  tree.segments[0].to = first_id + 1;
  tree.vessels.resize(1);
  tree.vessels[0].id = first_id;
  tree.vessels[0].segments = {first_id};
  return tree;
}

TEST(TreeParts, GetIdsOfTheirOwn) {
  VesselTree tree;
  append_tree(tree, tree_of_one_vessel(0));
  EXPECT_EQ(tree.nodes[0].id, 0);
  append_tree(tree, tree_of_one_vessel(0));
  append_tree(tree, tree_of_one_vessel(4), 1, [](std::int32_t old) { return old + 100; });
  std::set<std::int32_t> nodes, segments;
  for (const TreeNode& node : tree.nodes) nodes.insert(node.id);
  for (const TreeSegment& segment : tree.segments) {
    segments.insert(segment.id);
    EXPECT_TRUE(nodes.contains(segment.from));
    EXPECT_EQ(segment.to, segment.from + 1);
  }
  EXPECT_EQ(nodes.size(), 6u);
  EXPECT_EQ(segments.size(), 3u);
  EXPECT_EQ(tree.vessels[1].id, 1);
  EXPECT_EQ(tree.vessels[2].id, 104);
  for (const Vessel& vessel : tree.vessels) EXPECT_TRUE(segments.contains(vessel.segments.front()));
  VesselTree from_one;
  append_tree(from_one, tree_of_one_vessel(0), 1);
  EXPECT_EQ(from_one.nodes[0].id, 1);
  EXPECT_EQ(from_one.vessels[0].segments.front(), from_one.segments[0].id);
}

}  // namespace
}  // namespace ostia::geometry
