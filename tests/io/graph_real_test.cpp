#include "io_test_support.h"

#include "ostia/geometry/graph_faults.h"
#include "ostia/geometry/graph_repair.h"
#include "ostia/geometry/graph_tree.h"
#include "ostia/io/graph_file.h"

#include <cstdio>
#include <utility>
#include <vector>

namespace ostia::io {
namespace {

using geometry::GraphFacts;

// Grown trees of 2 n - 1 segments for n ends.
TEST(GraphReal, TreesOfTheVisualizer) {
  for (const int ends : {64, 128, 192, 256, 320, 384, 448, 512}) {
    char name[80];
    std::snprintf(name, sizeof name, "trees/arterial-tree-visualizer/tree3D_Nterm0512_step%04d.vtk", ends);
    OSTIA_REQUIRE_SHARED(path, name);
    SCOPED_TRACE(name);
    const LoadedGraph loaded = read_graph(path);
    EXPECT_TRUE(loaded.warnings.empty());
    const geometry::GraphFaults faults = geometry::find_faults(loaded.graph);
    EXPECT_TRUE(faults.sound_tree()) << geometry::summary(faults, loaded.graph);
    const GraphFacts facts = geometry::facts_of(loaded.graph);
    EXPECT_EQ(facts.segments, static_cast<std::size_t>(2 * ends - 1));
    EXPECT_EQ(facts.points, static_cast<std::size_t>(2 * ends));
    EXPECT_EQ(facts.ends, static_cast<std::size_t>(ends));
    EXPECT_EQ(facts.forks, static_cast<std::size_t>(ends - 1));
    EXPECT_EQ(facts.roots, 1u);
    EXPECT_EQ(facts.loops, 0u);
    EXPECT_GT(facts.least_radius_mm, 0.0);
  }
}

/// Out and in again without a loss, and through the tree of named vessels.
void expect_round_trip(const geometry::VesselGraph& graph) {
  const auto csv = testing::temporary_folder("io") / "grown.csv";
  EXPECT_TRUE(write_graph(csv, graph).empty());
  const geometry::VesselGraph again = read_graph(csv).graph;
  EXPECT_EQ(geometry::facts_of(again).length_mm, geometry::facts_of(graph).length_mm);
  EXPECT_EQ(geometry::facts_of(again).ends, geometry::facts_of(graph).ends);
  EXPECT_EQ(geometry::find_fault(geometry::tree_of(again)), std::nullopt);
}

// One of the two has an end that was grown twice at the very same place.
TEST(GraphReal, TreesOfOpenCco) {
  for (const auto& [name, twice] : std::vector<std::pair<const char*, std::size_t>>{
           {"trees/opencco/tree_3D-fig6.xml", 0}, {"trees/opencco/tree_3D-fig8.xml", 1}}) {
    OSTIA_REQUIRE_SHARED(path, name);
    SCOPED_TRACE(name);
    const LoadedGraph loaded = read_graph(path);
    const GraphFacts facts = geometry::facts_of(loaded.graph);
    EXPECT_EQ(facts.segments, 1989u);
    EXPECT_EQ(facts.points, 1990u);
    EXPECT_EQ(facts.parts, 1u);
    EXPECT_EQ(facts.ends, 995u);
    EXPECT_EQ(facts.loops, 0u);
    const geometry::GraphFaults faults = geometry::find_faults(loaded.graph);
    EXPECT_EQ(faults.count(geometry::GraphFaultKind::duplicate_point), twice);
    EXPECT_EQ(faults.found.size(), twice) << geometry::summary(faults, loaded.graph);
    const geometry::RepairedGraph fixed = geometry::repaired(loaded.graph);
    EXPECT_TRUE(fixed.left.sound_tree()) << geometry::summary(fixed.left, fixed.graph);
    EXPECT_EQ(fixed.graph.edges.size(), 1989u - twice);
    expect_round_trip(fixed.graph);
  }
}

// The two tables that are there lack the third one, which has the places.
TEST(GraphReal, TablesWithoutPlaces) {
  for (const char* name : {"trees/opencco/edges.dat", "trees/opencco/radius.dat"}) {
    OSTIA_REQUIRE_SHARED(path, name);
    try {
      read_graph(path);
      ADD_FAILURE() << name << " was read";
    } catch (const InvalidInput& error) {
      EXPECT_NE(std::string(error.what()).find("vertex.dat"), std::string::npos) << error.what();
    }
  }
}

TEST(GraphReal, CenterlinesAreNetworks) {
  OSTIA_REQUIRE_SHARED(path, "vessels/carotid-jackyko/centerline.vtp");
  EXPECT_TRUE(is_graph_file(path));
  const geometry::RepairedGraph fixed = geometry::repaired(read_graph(path).graph);
  EXPECT_EQ(fixed.left.count(geometry::GraphFaultKind::missing_radius), 0u);
}

}  // namespace
}  // namespace ostia::io
