#include "ostia/io/graph_file.h"

#include "io_test_support.h"

#include "ostia/geometry/graph_faults.h"
#include "ostia/geometry/graph_repair.h"
#include "ostia/geometry/vessel_tree.h"
#include "ostia/io/centerline_file.h"

#include <cmath>
#include <fstream>

namespace ostia::io {
namespace {

using geometry::GraphEdge;
using geometry::GraphFaultKind;
using geometry::Vec3;
using geometry::VesselGraph;

/// A fork whose children begin thinner than their parent ends, with numbers that have no short decimals.
VesselGraph fork_graph() {
  VesselGraph graph;
  graph.points = {{0.1, -2.0 / 3.0, 1e-7}, {1, 2, 3}, {1.5, 2.25, 1.0 / 3.0}, {4, 0, -1}};
  graph.edges = {{0, 1, 2.0, 1.0 / 7.0}, {1, 2, 0.1, 0.05}, {1, 3, 0.11, 0.003}};
  return graph;
}

void expect_same_graph(const VesselGraph& a, const VesselGraph& b) {
  ASSERT_EQ(a.points.size(), b.points.size());
  ASSERT_EQ(a.edges.size(), b.edges.size());
  for (std::size_t i = 0; i < a.points.size(); ++i) EXPECT_EQ(a.points[i], b.points[i]) << i;
  for (std::size_t e = 0; e < a.edges.size(); ++e) {
    EXPECT_EQ(a.edges[e].from, b.edges[e].from);
    EXPECT_EQ(a.edges[e].to, b.edges[e].to);
    EXPECT_EQ(a.edges[e].radius_from, b.edges[e].radius_from);
    EXPECT_EQ(a.edges[e].radius_to, b.edges[e].radius_to);
  }
}

std::filesystem::path written(const VesselGraph& graph, const std::string& name) {
  const std::filesystem::path path = testing::temporary_folder("io") / name;
  EXPECT_TRUE(write_graph(path, graph).empty());
  return path;
}

TEST(GraphFile, CsvAndVtpKeepEveryBit) {
  VesselGraph graph = fork_graph();
  for (const char* name : {"fork.csv", "fork.vtp"}) {
    SCOPED_TRACE(name);
    const LoadedGraph loaded = read_graph(written(graph, name));
    expect_same_graph(loaded.graph, graph);
    EXPECT_TRUE(loaded.warnings.empty());
  }
  EXPECT_EQ(read_graph(written(graph, "fork.csv")).graph.references, (std::vector<std::int64_t>{2, 3, 4}));
  graph.references = {70, 80, 1LL << 40};
  const LoadedGraph named = read_graph(written(graph, "fork.vtp"));
  EXPECT_EQ(named.graph.references, graph.references);
  EXPECT_EQ(named.reference_name, "reference");
}

TEST(GraphFile, LoopsAndSeveralParentsStay) {
  VesselGraph graph = fork_graph();
  graph.edges.push_back({2, 3, 0.05, 0.003});
  for (const char* name : {"loop.csv", "loop.vtp"})
    expect_same_graph(read_graph(written(graph, name)).graph, graph);
  const std::filesystem::path swc = testing::temporary_folder("io") / "loop.swc";
  expect_refusal(swc, [&] { write_graph(swc, graph); }, {"SWC holds trees alone"});
  EXPECT_FALSE(std::filesystem::exists(swc));
}

// SWC has one radius for a point: the segments at the fork begin with their parent's, and that is told.
TEST(GraphFile, SwcTellsWhatItCannotHold) {
  const std::filesystem::path path = testing::temporary_folder("io") / "fork.swc";
  const std::vector<std::string> told = write_graph(path, fork_graph());
  ASSERT_EQ(told.size(), 1u);
  EXPECT_NE(told[0].find("2 segments begin with another radius"), std::string::npos) << told[0];
  VesselGraph expected = fork_graph();
  expected.edges[1].radius_from = expected.edges[2].radius_from = 1.0 / 7.0;
  const LoadedGraph loaded = read_graph(path);
  expect_same_graph(loaded.graph, expected);
  EXPECT_EQ(loaded.graph.references, (std::vector<std::int64_t>{3, 4, 5}));
}

// Ids that are not counted up, a child before its parent, a comment, a second root, tabs, no radius.
TEST(GraphFile, SwcAsOthersWriteIt) {
  const auto path = file_with("other.swc",
                              "# made by hand\n 30 3 1 0 0 nan 7\n7\t1\t0 0 0 +2.5 -1 extra\n\n"
                              "2 2 1 1 0 0.5 30\r\n9 1 5 5 5 1 -1\n");
  const LoadedGraph loaded = read_graph(path);
  EXPECT_EQ(loaded.reference_name, "line");
  ASSERT_EQ(loaded.graph.points.size(), 4u);
  ASSERT_EQ(loaded.graph.edges.size(), 2u);
  EXPECT_EQ(loaded.graph.edges[0].from, 1);
  EXPECT_EQ(loaded.graph.edges[0].to, 0);
  EXPECT_EQ(loaded.graph.edges[0].radius_from, 2.5);
  EXPECT_TRUE(std::isnan(loaded.graph.edges[0].radius_to));
  EXPECT_EQ(loaded.graph.references, (std::vector<std::int64_t>{2, 5}));
  EXPECT_EQ(geometry::find_faults(loaded.graph).count(GraphFaultKind::missing_radius), 2u);
}

TEST(GraphFile, SwcFaultsAreCountedByLine) {
  const auto path = file_with("faulty.swc",
                              "1 0 0 0 0 1 -1\n2 0 1 0 0 1 1\n3 0 1 0 0 1 2\n4 0 2 0 0 -1 99\n5 0 3 0 0 0 2\n"
                              "5 0 4 0 0 1 5\n7 0 nan 0 0 1 5\n8 0 6 0 0 1 8\n");
  const LoadedGraph loaded = read_graph(path);
  const geometry::GraphFaults faults = geometry::find_faults(loaded.graph);
  const std::string said = geometry::summary(faults, loaded.graph, loaded.reference_name);
  for (const char* part :
       {"1 segment names a point that is not there (line 4)", "2 segments have no length (line 3, line 8)",
        "1 segment has a negative radius (line 4)", "have the radius zero (line 5, line 6, line 7)",
        "1 point has a coordinate that is no finite number"})
    EXPECT_NE(said.find(part), std::string::npos) << said;
  ASSERT_EQ(loaded.warnings.size(), 1u);
  EXPECT_NE(loaded.warnings[0].find("repeat the id of another (first: 5)"), std::string::npos);
  EXPECT_TRUE(geometry::repaired(loaded.graph).left.sound_trees());
}

TEST(GraphFile, CsvOfSamplesAndOfPoints) {
  const LoadedGraph samples =
      read_graph(file_with("samples.csv", "Parent,id,z,y,x,radius\n,1,0,0,0,2\n1,2,0,0,5,1\n1,3,0,4,0,\n"));
  ASSERT_EQ(samples.graph.edges.size(), 2u);
  EXPECT_EQ(samples.graph.points[1], Vec3(5, 0, 0));
  EXPECT_EQ(samples.graph.edges[0].radius_from, 2.0);
  EXPECT_TRUE(std::isnan(samples.graph.edges[1].radius_to));
  EXPECT_EQ(samples.graph.references, (std::vector<std::int64_t>{3, 4}));
  // The second line begins at the first one's end: one point.
  const LoadedGraph lines = read_graph(file_with(
      "lines.csv", "vessel,x,y,z,radius\n\"a, b\",0,0,0,1\n\"a, b\",1,0,0,0.9\nc,1,0,0,0.5\nc,1,1,0,0.4\n"));
  ASSERT_EQ(lines.graph.edges.size(), 2u);
  EXPECT_EQ(lines.graph.points.size(), 3u);
  EXPECT_EQ(lines.graph.edges[1].from, 1);
  EXPECT_EQ(lines.graph.edges[1].radius_from, 0.5);
  const LoadedGraph bare = read_graph(file_with("bare.csv", "0,0,0,1\n1,0,0,1\n\n5,0,0,2\n6,0,0,2\n"));
  EXPECT_EQ(bare.graph.edges.size(), 2u);
  EXPECT_EQ(bare.graph.references, (std::vector<std::int64_t>{2, 5}));
  const LoadedGraph thin = read_graph(file_with("thin.csv", "x,y,z\n0,0,-0.0\n1,0,0\n0,0,0.0\n"));
  EXPECT_EQ(thin.graph.points.size(), 2u) << "0 and -0 are one place";
  EXPECT_EQ(geometry::find_faults(thin.graph).count(GraphFaultKind::missing_radius), 2u);
}

std::string vtk_file(const std::string& cells) {
  return "# vtk DataFile Version 3.0\ntree\nASCII\nDATASET POLYDATA\nPOINTS 4 float\n0 0 0 1 0 0 2 0 0 1 1 "
         "0\n"
         "LINES 2 7\n3 0 1 2\n2 1 3\n" +
         cells;
}

TEST(GraphFile, VtkLinesWithRadiiOfPointsOrCells) {
  const LoadedGraph cells = read_graph(
      file_with("cells.vtk", vtk_file("CELL_DATA 2\nscalars raio float\nLOOKUP_TABLE default\n0.5\n0.25\n")));
  ASSERT_EQ(cells.graph.edges.size(), 3u);
  EXPECT_EQ(cells.graph.edges[1].radius_to, 0.5);
  EXPECT_EQ(cells.graph.edges[2].radius_from, 0.25);
  EXPECT_EQ(cells.graph.references, (std::vector<std::int64_t>{0, 0, 1}));
  EXPECT_EQ(cells.reference_name, "cell");
  const LoadedGraph points = read_graph(file_with(
      "points.vtk", vtk_file("POINT_DATA 4\nSCALARS Diameter double 1\nLOOKUP_TABLE default\n4 3 2 1\n")));
  EXPECT_EQ(points.graph.edges[2].radius_from, 1.5);
  EXPECT_EQ(points.graph.edges[2].radius_to, 0.5);
  const LoadedGraph none = read_graph(
      file_with("none.vtk", vtk_file("CELL_DATA 2\nSCALARS flow float\nLOOKUP_TABLE default\n1\n1\n")));
  ASSERT_EQ(none.warnings.size(), 1u);
  EXPECT_NE(none.warnings[0].find("its arrays are flow"), std::string::npos) << none.warnings[0];
}

const std::string gxl_nodes =
    "<?xml version=\"1.0\"?>\n<!-- <gxl> > -->\n<gxl><graph id=\" t\">\n"
    "<node id=\"a\"><attr name=\" position\"><tup><float> "
    "1</float><float>2</float><float>3</float></tup></attr>\n"
    "<attr name=\" other\"><float>9</float></attr></node>\n"
    "<node id=\"n1\"><attr name='position'><tup><int>4</int><int>5</int></tup></attr></node>\n";

TEST(GraphFile, Gxl) {
  const LoadedGraph loaded = read_graph(file_with(
      "tree.gxl", gxl_nodes +
                      "<edge id=\"e1\" to=\"n1\" from=\"a\">\n<attr name=\" flow\"><float>7</float></attr>"
                      "<attr name=\" radius\"><float>0.5</float></attr></edge>\n"
                      "<edge from=\"n1\" to=\"n7\"/></graph></gxl>\n"));
  ASSERT_EQ(loaded.graph.edges.size(), 2u);
  EXPECT_EQ(loaded.graph.points[0], Vec3(1, 2, 3));
  EXPECT_EQ(loaded.graph.points[1], Vec3(4, 5, 0));
  EXPECT_EQ(loaded.graph.edges[0].radius_from, 0.5);
  EXPECT_EQ(loaded.graph.edges[0].radius_to, 0.5);
  EXPECT_EQ(loaded.graph.references, (std::vector<std::int64_t>{7, 9}));
  EXPECT_EQ(loaded.graph.edges[1].to, -1) << "no node is called n7";
  EXPECT_TRUE(std::isnan(loaded.graph.edges[1].radius_to));
}

TEST(GraphFile, Tables) {
  const auto folder = testing::temporary_folder("io");
  core::write_file(folder / "vertex.dat", "# x y z\n0 0 0\n1 0 0 \n1 1 0\n");
  core::write_file(folder / "edges.dat", "# IdA IdB flow resistance\n0 1 8.33  \n1 2 7.3\n1 5 1\n");
  core::write_file(folder / "radius.dat", "0.5\n0.4\n0.3\n");
  const LoadedGraph loaded = read_graph(folder / "edges.dat");
  ASSERT_EQ(loaded.graph.edges.size(), 3u);
  EXPECT_EQ(loaded.graph.edges[1].radius_from, 0.3) << "a segment has its distal point's radius";
  EXPECT_EQ(loaded.graph.edges[2].to, -1);
  core::write_file(folder / "radius.dat", "0.5\n");
  expect_refusal(folder / "radius.dat", [&] { read_graph(folder / "vertex.dat"); }, {"1 radii for 3 points"});
  std::filesystem::remove(folder / "vertex.dat");
  expect_refusal(folder / "vertex.dat", [&] { read_graph(folder / "edges.dat"); }, {"there is no such file"});
}

TEST(GraphFile, KnowsItsFiles) {
  for (const char* name : {"a.swc", "a.CSV", "a.gxl", "a.xml", "edges.dat", "a.vtk"})
    EXPECT_TRUE(is_graph_file(name));
  for (const char* name : {"a.stl", "a.nrrd", "a.dat", "no_such_file.vtp", "a"})
    EXPECT_FALSE(is_graph_file(name));
  EXPECT_TRUE(is_graph_file(written(fork_graph(), "known.vtp")));
}

TEST(GraphFile, RefusesToWriteWhatIsNoGraphOrNoFormat) {
  VesselGraph graph = fork_graph();
  const auto stl = testing::temporary_folder("io") / "tree.stl";
  expect_refusal(stl, [&] { write_graph(stl, graph); }, {".vtp, .swc or .csv"});
  graph.edges[1].to = 4;
  const auto csv = testing::temporary_folder("io") / "bad.csv";
  expect_refusal(csv, [&] { write_graph(csv, graph); }, {"segment 1", "repair"});
  EXPECT_FALSE(std::filesystem::exists(csv));
}

TEST(GraphFile, CenterlinesAreOneNetworkHoweverTheyAreWritten) {
  geometry::VesselTree tree;
  const geometry::Vec3 a(0, 0, 0), b(0, 0, 10), c(4, 0, 18), d(-4, 0, 18);
  const auto line = [](const geometry::Vec3& from, const geometry::Vec3& to) {
    geometry::Centerline out;
    for (int i = 0; i <= 10; ++i) {
      out.points.push_back(from + (to - from) * i / 10.0);
      out.radius.push_back(2.0);
    }
    geometry::complete(out);
    return out;
  };
  tree.nodes = {{0, a}, {1, b}, {2, c}, {3, d}};
  tree.segments = {{10, 0, 1, line(a, b)}, {11, 1, 2, line(b, c)}, {12, 1, 3, line(b, d)}};
  tree.vessels = {{5, "LAD", {10, 11}}, {6, "LCX", {10, 12}}};
  for (const char* name : {"lines.vtp", "lines.csv"}) {
    const auto path = testing::temporary_folder("io") / name;
    write_centerlines(path, tree);
    const LoadedGraph loaded = read_graph(path);
    const geometry::GraphFaults faults = geometry::find_faults(loaded.graph);
    EXPECT_TRUE(faults.found.empty()) << name << ": " << geometry::summary(faults, loaded.graph);
    EXPECT_EQ(loaded.graph.edges.size(), 30u) << name;
    EXPECT_EQ(loaded.graph.points.size(), 31u) << name;
    const geometry::GraphFacts facts = geometry::facts_of(loaded.graph);
    EXPECT_EQ(facts.parts, 1u) << name;
    EXPECT_EQ(facts.forks, 1u) << name;
    EXPECT_NEAR(facts.length_mm, 10.0 + 2.0 * std::sqrt(80.0), 1e-9) << name;
  }
}

}  // namespace
}  // namespace ostia::io
