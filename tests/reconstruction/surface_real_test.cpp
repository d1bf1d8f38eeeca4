#include "shared_data.h"

#include "ostia/geometry/graph_repair.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/io/graph_file.h"
#include "ostia/reconstruction/surface.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <iostream>

namespace ostia::reconstruction {
namespace {

/// Closed whatever crosses, on the right side, and with one end face for the root and one for each end.
ReconstructedSurface expect_closed(const geometry::VesselGraph& graph) {
  const geometry::GraphFacts facts = geometry::facts_of(graph);
  ReconstructedSurface made = reconstruct_surface(graph);
  const geometry::SurfaceFaults faults = geometry::find_faults(made.surface.mesh, false);
  EXPECT_TRUE(faults.closed_manifold()) << faults.summary();
  EXPECT_EQ(faults.components, 1u);
  EXPECT_GT(geometry::volume(made.surface.mesh), 0.0);
  EXPECT_EQ(made.surface.faces.size(), 1 + facts.roots + facts.ends);
  std::cout << "  " << facts.branches << " branches, " << made.quads.size() << " quadrilaterals, "
            << made.self_intersections << " self-intersections, " << made.narrowed.size() << " narrowed\n";
  return made;
}

// Places in metres, radii in millimetres.
TEST(ReconstructionReal, TreesOfTheVisualizer) {
  for (const int ends : {64, 128, 192, 256, 320, 384, 448, 512}) {
    char name[80];
    std::snprintf(name, sizeof name, "trees/arterial-tree-visualizer/tree3D_Nterm0512_step%04d.vtk", ends);
    OSTIA_REQUIRE_SHARED(path, name);
    SCOPED_TRACE(name);
    geometry::VesselGraph graph = io::read_graph(path).graph;
    for (geometry::Vec3& p : graph.points) p *= 1000.0;
    EXPECT_EQ(expect_closed(graph).self_intersections, 0u);
  }
}

TEST(ReconstructionReal, TreesOfOpenCco) {
  for (const char* name : {"trees/opencco/tree_3D-fig6.xml", "trees/opencco/tree_3D-fig8.xml"}) {
    OSTIA_REQUIRE_SHARED(path, name);
    SCOPED_TRACE(name);
    const ReconstructedSurface made = expect_closed(geometry::repaired(io::read_graph(path).graph).graph);
    EXPECT_EQ(made.self_intersections, 0u);
  }
}

}  // namespace
}  // namespace ostia::reconstruction
