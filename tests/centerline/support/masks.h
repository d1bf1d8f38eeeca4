#pragma once
/// \file Voxelised shapes, and their topology counted without the library.

#include "ostia/centerline/skeleton_graph.h"
#include "ostia/imaging/volume.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace ostia::centerline::test {

/// Inside where `inside` says so of a voxel's centre in the world.
imaging::MaskVolume mask_of(const imaging::Geometry& grid, const std::function<bool(const Vec3&)>& inside);
imaging::Geometry grid_of(std::int64_t x, std::int64_t y, std::int64_t z, const Vec3& spacing = Vec3::Ones());

/// Distance to the segment from a to b, and to a tube with flat ends: inside where true.
double to_segment(const Vec3& p, const Vec3& a, const Vec3& b);
bool in_tube(const Vec3& p, const Vec3& a, const Vec3& b, double radius);

struct Topology {
  std::int64_t components = 0, loops = 0, cavities = 0, euler = 0;
  bool operator==(const Topology&) const = default;
};
/// Of the union of the closed voxels: cells of the cubical complex, and components by filling. Outside of the
/// image is background.
Topology topology_of(const imaging::MaskVolume& mask);

/// Balls at random places of which some touch: loops, cavities and bridges of one voxel.
imaging::MaskVolume random_blobs(std::uint64_t seed, std::int64_t size, const Vec3& spacing = Vec3::Ones());
/// Each voxel on its own.
imaging::MaskVolume random_voxels(std::uint64_t seed, std::int64_t size, double share);

/// The graph of the mask's skeleton.
SkeletonGraph graph_of(const imaging::MaskVolume& mask);
double total_length(const SkeletonGraph& graph);
std::vector<SkeletonNode> nodes_of(const SkeletonGraph& graph, SkeletonNodeKind kind);

}  // namespace ostia::centerline::test
