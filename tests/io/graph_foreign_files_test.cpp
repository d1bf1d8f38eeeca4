// Networks as other programs, damaged disks and people leave them.

#include "io_test_support.h"

#include "ostia/geometry/graph_faults.h"
#include "ostia/geometry/graph_repair.h"
#include "ostia/io/graph_file.h"

#include <cmath>

namespace ostia::io {
namespace {

using geometry::GraphFaultKind;
using geometry::Vec3;
using References = std::vector<std::int64_t>;

std::string said_of(const LoadedGraph& loaded) {
  return geometry::summary(geometry::find_faults(loaded.graph), loaded.graph, loaded.reference_name);
}

TEST(GraphForeignFiles, SwcIdsMayBeAnyWholeNumbers) {
  const LoadedGraph loaded = read_graph(
      file_with("sparse.swc",
                "1000000000 0 0 0 0 1 -1\n1 0 1 0 0 1 1000000000\n9223372036854775807 0 2 0 0 1 1\n"
                "-9223372036854775808 0 3 0 0 1 9223372036854775807\n-4 0 4 0 0 1 -9223372036854775808\n"));
  EXPECT_EQ(said_of(loaded), "none");
  EXPECT_EQ(geometry::facts_of(loaded.graph).ends, 1u);
  EXPECT_EQ(loaded.graph.points.size(), 5u);
}

// Only -1 is the word for no parent; other negative numbers are parents that are not there.
TEST(GraphForeignFiles, AParentOutOfRangeIsCountedOnEitherSide) {
  const LoadedGraph loaded = read_graph(file_with(
      "range.swc", "1 0 0 0 0 1 -1\n2 0 1 0 0 1 1\n3 0 2 0 0 1 -7\n4 0 3 0 0 1 99\n5 0 4 0 0 1 4\n"));
  EXPECT_NE(said_of(loaded).find("2 segments name points that are not there (line 3, line 4)"),
            std::string::npos)
      << said_of(loaded);
  EXPECT_TRUE(geometry::repaired(loaded.graph).left.sound_trees());
}

TEST(GraphForeignFiles, AByteOrderMarkIsNoPartOfTheFirstNumber) {
  const LoadedGraph swc = read_graph(file_with("mark.swc",
                                               "\xEF\xBB\xBF"
                                               "1 0 0 0 0 1 -1\n2 0 1 0 0 1 1\n"));
  EXPECT_EQ(swc.graph.edges.size(), 1u);
  const LoadedGraph comment =
      read_graph(file_with("mark.swc", "\xEF\xBB\xBF# made by hand\n1 0 0 0 0 1 -1\n2 0 1 0 0 1 1\n"));
  EXPECT_EQ(comment.graph.edges.size(), 1u);
}

TEST(GraphForeignFiles, SwcDuplicatesAreNamedByTheirLines) {
  const LoadedGraph loaded = read_graph(
      file_with("twice.swc",
                "# head\n1 0 0 0 0 1 -1\n2 0 0 0 5 1 1\n3 0 0 0 9 1 2\n4 0 -0 0 5 1 1\n5 0 nan 0 0 1 2\n"));
  const std::string said = said_of(loaded);
  EXPECT_NE(said.find("1 point is at the place of another (point 3 of line 5)"), std::string::npos) << said;
  EXPECT_NE(said.find("(point 4 of line 6)"), std::string::npos) << said;
  const geometry::RepairedGraph fixed = geometry::repaired(loaded.graph);
  EXPECT_TRUE(fixed.left.sound_tree());
  EXPECT_EQ(fixed.graph.references, (References{3, 4}));
}

const std::string gxl_in_one_line =
    "<gxl><graph><node id=\"a\"><attr name=\"position\"><tup><float>0</float><float>0</float><float>0</float>"
    "</tup></attr></node><node id=\"b\"><attr name=\"position\"><tup><float>1</float><float>0</float>"
    "<float>0</float></tup></attr></node><edge from=\"a\" to=\"b\"><attr "
    "name=\"radius\"><float>-1</float></attr>"
    "</edge><edge from=\"b\" to=\"zz\"><attr name=\"radius\"><float>1</float></attr></edge></graph></gxl>";

// Without lines the edges are counted, and a node that an edge only names is no point.
TEST(GraphForeignFiles, GxlInOneLineIsNamedByItsEdges) {
  const LoadedGraph loaded = read_graph(file_with("line.gxl", gxl_in_one_line));
  EXPECT_EQ(loaded.reference_name, "edge");
  EXPECT_EQ(loaded.graph.points.size(), 2u);
  EXPECT_EQ(said_of(loaded),
            "1 segment names a point that is not there (edge 2); 1 segment has a negative radius (edge 1)");
}

TEST(GraphForeignFiles, VtkInCapitals) {
  const std::string text =
      "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 2 float\n0 0 0 1 0 0\nLINES 1 3\n2 0 "
      "1\n";
  EXPECT_EQ(read_graph(file_with("TREE.VTK", text)).graph.edges.size(), 1u);
}

TEST(GraphForeignFiles, VtkIndicesAndCountsThatAreNegativeOrHuge) {
  const std::string points =
      "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n0 0 0 1 0 0 2 0 0\n";
  for (const char* lines :
       {"LINES 1 3\n2 0 -5\n", "LINES 1 3\n2 0 2147483648\n", "LINES 1 3\n2 4294967296 1\n",
        "LINES 1 3\n2 0 9223372036854775807\n", "LINES 1 3\n2 0 99999999999999999999\n",
        "LINES 1 3\n-2 0 1\n", "LINES -1 3\n2 0 1\n", "LINES 1 -3\n2 0 1\n", "LINES 1 3\n9 0 1\n",
        "LINES 2000000000 6000000000\n2 0 1\n", "LINES 1 3\n"}) {
    SCOPED_TRACE(lines);
    const auto path = file_with("bad.vtk", points + lines);
    expect_refusal(path, [&] { read_graph(path); }, {});
  }
  const auto huge = file_with(
      "huge.vtk", "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 4000000000 double\n0 0\n");
  expect_refusal(huge, [&] { read_graph(huge); }, {});
}

TEST(GraphForeignFiles, VtkReferencesThatAreNoWholeNumbers) {
  const LoadedGraph loaded = read_graph(file_with(
      "references.vtk",
      "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n0 0 0 1 0 0 2 0 0\nLINES 2 6\n"
      "2 0 1\n2 1 2\nCELL_DATA 2\nSCALARS Reference double 1\nLOOKUP_TABLE default\n1e300 7\n"));
  EXPECT_EQ(loaded.graph.references, (References{-1, 7}));
}

// A cut within the last number leaves another number: it cannot be known, but it is told, and by its line.
TEST(GraphForeignFiles, CutWithinTheLastNumber) {
  const auto told = [](const LoadedGraph& loaded, const std::string& part) {
    ASSERT_EQ(loaded.warnings.size(), 1u);
    EXPECT_NE(loaded.warnings[0].find(part), std::string::npos) << loaded.warnings[0];
  };
  std::string chain = "1 0 0 0 0 1 -1\n";
  for (int i = 2; i <= 12; ++i)
    chain += std::to_string(i) + " 0 " + std::to_string(i) + " 0 0 1 " + std::to_string(i - 1) + "\n";
  told(read_graph(file_with("chain.swc", chain.substr(0, chain.size() - 2))),
       "line 12, the last one, has no end");
  told(read_graph(file_with("chain.csv", "x,y,z,radius\n0,0,0,1\n1,0,0,1\n2,0,0,1.2")),
       "line 4, the last one");
  told(read_graph(file_with("rows.csv", "x1,y1,z1,x2,y2,z2,radius\n0,0,0,1,0,0,1.5\n1,0,0,2,0,0,1")),
       "line 3");
  const auto folder = testing::temporary_folder("io");
  core::write_file(folder / "vertex.dat", "0 0 0\n1 0 0\n2 0 0\n");
  core::write_file(folder / "radius.dat", "1\n1\n1\n");
  core::write_file(folder / "edges.dat", "0 1\n1 2");
  told(read_graph(folder / "edges.dat"), "edges.dat: line 2, the last one, has no end");
}

// Whatever byte a file ends after: it is read or refused by its name, and what is read can be judged and
// mended.
TEST(GraphForeignFiles, CutAfterEachByte) {
  const std::vector<std::pair<std::string, std::string>> files{
      {"cut.swc", "# c\n1 1 0 0 0 1.5 -1\n2 1 1 0 0 1 1\n3 1 2 0 0 1 2\n4 1 2 1 0 0.5 12\n"},
      {"rows.csv", "x1,y1,z1,radius1,x2,y2,z2,radius2\n0,0,0,1,1,0,0,1\n1,0,0,1,\"2\",0,0,0.5\n"},
      {"samples.csv", "id,x,y,z,radius,parent\n1,0,0,0,1,-1\n2,1,0,0,1,1\n3,2,0,0,1,12\n"},
      {"points.csv", "vessel,x,y,z,radius\n\"a\"\"b\",0,0,0,1\n\"a\"\"b\",1,0,0,1\nc,0,0,0,1\nc,0,1,0,2\n"},
      {"cut.gxl", gxl_in_one_line}};
  for (const auto& [name, whole] : files) {
    std::size_t read = 0;
    for (std::size_t bytes = 0; bytes < whole.size(); ++bytes) {
      SCOPED_TRACE(name + " cut after " + std::to_string(bytes));
      const auto path = file_with(name, whole.substr(0, bytes));
      try {
        LoadedGraph loaded = read_graph(path);
        ++read;
        EXPECT_FALSE(said_of(loaded).empty());
        geometry::facts_of(loaded.graph);
        geometry::repaired(std::move(loaded.graph));
      } catch (const InvalidInput& error) {
        const std::string said = error.what();
        EXPECT_TRUE(said.find(name) != std::string::npos ||
                    said.find("no segment left after its repair") != std::string::npos)
            << said;
      }
    }
    EXPECT_EQ(read > 0, name != "cut.gxl") << name;
  }
}

TEST(GraphForeignFiles, ReferencesOutliveRepairAndFormats) {
  LoadedGraph loaded = read_graph(file_with(
      "faulty.swc", "1 0 0 0 0 1 -1\n2 0 1 0 0 1 1\n3 0 1 0 0 1 2\n4 0 2 0 0 1 3\n5 0 3 0 0 1 4\n"));
  const geometry::VesselGraph fixed = geometry::repaired(std::move(loaded.graph)).graph;
  EXPECT_EQ(fixed.references, (References{2, 4, 5}));
  const auto folder = testing::temporary_folder("io");
  for (const char* name : {"fixed.csv", "fixed.vtp"}) {
    EXPECT_TRUE(write_graph(folder / name, fixed).empty());
    const LoadedGraph again = read_graph(folder / name);
    EXPECT_EQ(again.graph.references, fixed.references) << name;
    EXPECT_EQ(again.reference_name, "reference") << name;
    EXPECT_TRUE(again.warnings.empty());
  }
  const std::vector<std::string> told = write_graph(folder / "fixed.swc", fixed);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_NE(told[0].find("no place for the segments' references"), std::string::npos);
  const auto bad = file_with("bad.csv", "x1,y1,z1,x2,y2,z2,reference\n0,0,0,1,0,0,first\n");
  expect_refusal(bad, [&] { read_graph(bad); }, {"line 2: column reference: \"first\" is no whole number"});
}

TEST(GraphForeignFiles, ValuesOfSegmentsAreWrittenByTheirNames) {
  geometry::VesselGraph graph;
  graph.points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  graph.edges = {{0, 1, 1, 1}, {1, 2, 1, 0.5}};
  const std::vector<SegmentValues> values{{"Order", {2, 1}}, {"Element", {-1, 70}}};
  const auto folder = testing::temporary_folder("io");
  EXPECT_TRUE(write_graph(folder / "values.csv", graph, values).empty());
  EXPECT_EQ(
      core::read_file(folder / "values.csv"),
      "x1,y1,z1,radius1,x2,y2,z2,radius2,Order,Element\n0,0,0,1,1,0,0,1,2,-1\n1,0,0,1,2,0,0,0.5,1,70\n");
  EXPECT_TRUE(write_graph(folder / "values.vtp", graph, values).empty());
  EXPECT_NE(core::read_file(folder / "values.vtp").find("Name=\"Element\""), std::string::npos);
  EXPECT_EQ(read_graph(folder / "values.vtp").graph.edges.size(), 2u);
  EXPECT_EQ(read_graph(folder / "values.csv").graph.edges[1].radius_to, 0.5);
  const std::vector<std::string> told = write_graph(folder / "values.swc", graph, values);
  ASSERT_EQ(told.size(), 2u);
  EXPECT_NE(told[1].find("Element"), std::string::npos);
  EXPECT_THROW(write_graph(folder / "few.vtp", graph, {{"Order", {1}}}), InvalidInput);
  graph.references = {1};
  EXPECT_THROW(write_graph(folder / "few.vtp", graph), InvalidInput);
}

}  // namespace
}  // namespace ostia::io
