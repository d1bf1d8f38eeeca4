#pragma once
/// \file What holds for every surface with flow extensions.

#include "ostia/geometry/aabb_tree.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/meshing/caps.h"
#include "ostia/meshing/flow_extension.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace ostia::meshing {

inline double degrees_between(const geometry::Vec3& a, const geometry::Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b)) * 180.0 / std::numbers::pi;
}

inline std::vector<geometry::Vec3> loop_points(const ClippedSurface& surface, std::size_t end) {
  std::vector<geometry::Vec3> points;
  for (const std::int32_t v : surface.ends[end].loop)
    points.push_back(surface.mesh.points[static_cast<std::size_t>(v)]);
  return points;
}

/// What holds for every extended surface.
inline void expect_sound(const ExtendedEnds& out, std::size_t ends, double least_seam_deg = 25.0) {
  EXPECT_TRUE(geometry::self_intersections(out.surface.mesh, 1).empty());
  const geometry::SurfaceFaults faults = geometry::find_faults(out.surface.mesh, false);
  EXPECT_EQ(faults.non_manifold_edges + faults.non_manifold_vertices + faults.inconsistent_edges +
                faults.unused_points + faults.degenerate_triangles,
            0u)
      << faults.summary();
  EXPECT_EQ(geometry::boundary_loops(out.surface.mesh).size(), ends);
  EXPECT_FALSE(geometry::find_fault(out.tree).has_value()) << *geometry::find_fault(out.tree);
  EXPECT_GT(geometry::volume(cap_ends(out.surface).mesh), 0.0);
  for (const FlowExtension& e : out.extensions) {
    EXPECT_NEAR(e.end_area_mm2, e.section_area_mm2, 1e-3 * e.section_area_mm2) << e.end;
    EXPECT_GE(e.seam_angle_deg, least_seam_deg) << e.end;
  }
  for (std::size_t i = 0; i < out.surface.ends.size(); ++i) {
    const EndPlane& plane = out.surface.ends[i].plane;
    for (const geometry::Vec3& p : loop_points(out.surface, i))
      EXPECT_LT(std::abs((p - plane.origin).dot(plane.normal)), 1e-9) << end_name(plane);
    EXPECT_LT((geometry::node(out.tree, plane.node).position - plane.origin).norm(),
              out.extensions.size() == ends ? 1e-9 : 1e3);
  }
}

/// All points of a far end at the same distance from its centre.
inline void expect_round(const ExtendedEnds& out, std::size_t end) {
  const EndPlane& plane = out.surface.ends[end].plane;
  for (const geometry::Vec3& p : loop_points(out.surface, end))
    EXPECT_NEAR((p - plane.origin).norm(), plane.radius_mm, 1e-9 * plane.radius_mm);
}

}  // namespace ostia::meshing
