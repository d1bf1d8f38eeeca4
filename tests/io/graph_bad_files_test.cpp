#include "io_test_support.h"

#include "ostia/io/graph_file.h"

#include <limits>

namespace ostia::io {
namespace {

void expect_bad(const std::string& name, const std::string& content, const std::vector<std::string>& parts) {
  SCOPED_TRACE(name + ": " + content.substr(0, 80));
  const auto path = file_with(name, content);
  expect_refusal(
      path, [&] { read_graph(path); }, parts);
}

TEST(GraphBadFiles, Empty) {
  for (const char* name : {"a.swc", "a.csv", "a.gxl", "a.xml", "a.vtk", "a.vtp"})
    expect_bad(name, "", {"the file is empty"});
  const auto missing = testing::temporary_folder("io") / "missing.swc";
  expect_refusal(missing, [&] { read_graph(missing); }, {"no such file"});
  expect_bad("tree.txt", "1 2 3", {"a tree ends in"});
}

TEST(GraphBadFiles, NoSegments) {
  expect_bad("a.swc", "# nothing\n", {"no segments"});
  expect_bad("a.swc", "1 1 0 0 0 1 -1\n", {"no segments"});
  expect_bad("a.csv", "x,y,z,radius\n", {"no segments"});
  expect_bad("a.csv", "x,y,z,radius\n1,2,3,4\n", {"no segments"});
  expect_bad("a.gxl", "<gxl><graph></graph></gxl>", {"no segments"});
}

TEST(GraphBadFiles, SwcByLine) {
  expect_bad("a.swc", "1 1 0 0 0 1 -1\n2 1 0,5 0 0 1 1\n", {"line 2: x \"0,5\" is no number", "1 samples"});
  expect_bad("a.swc", "1 1 0 0 0 1 -1\n\n1.5 1 0 0 0 1 1\n", {"line 3: id \"1.5\" is no whole number"});
  expect_bad("a.swc", "1 1 0 0 0 1 -1\n2 1 0 0\n3 1 0 0 0 1 1\n", {"line 2", "4 of the 7 columns"});
  expect_bad("a.swc", "1 1 0 0 0 1 -1\n2 1 0 0 0 1 99999999999999999999\n", {"line 2: parent"});
}

TEST(GraphBadFiles, CsvByLine) {
  expect_bad("a.csv", "a,b\n1,2\n", {"no column x"});
  expect_bad("a.csv", "x1,y1,z1,x2,y2\n", {"no column z2"});
  expect_bad("a.csv", "id,parent,x,y\n", {"no column z"});
  expect_bad("a.csv", "x,y,z,radius\n0,0,0,1\n1,0,zero,1\n", {"line 3: column z: \"zero\" is no number"});
  expect_bad("a.csv", "x,y,z,radius\n0,0,0,1\n1,0,0,1\n1,0\n",
             {"line 4", "2 of its 4 columns", "1 segments"});
  expect_bad("a.csv", "id,parent,x,y,z\nfirst,,0,0,0\n", {"line 2: column id: \"first\" is no whole number"});
  expect_bad("a.csv", "x,y,z,vessel\n0,0,0,\"lad\n", {"line 2", "quotation"});
}

TEST(GraphBadFiles, GxlByLine) {
  expect_bad("a.xml", "<html><body/></html>", {"no GXL file"});
  expect_bad("a.gxl", "<!DOCTYPE gxl [<!ENTITY a \"b\">]>\n<gxl/>", {"entities"});
  expect_bad("a.gxl", "<gxl>\n<node/>", {"line 2", "no id"});
  expect_bad("a.gxl", "<gxl><node id='1'/>\n<node id='1'/></gxl>",
             {"line 2", "node 1 is there a second time"});
  expect_bad("a.gxl", "<gxl>\n\n<edge from='1'/></gxl>", {"line 3", "lacks from or to"});
  expect_bad("a.gxl", "<gxl><edge from='1' to='2'>\n<attr name='radius'><float>wide</float></attr>",
             {"line 2", "\"wide\" is no number"});
}

TEST(GraphBadFiles, VtkThatWouldCrashItsReader) {
  const std::string head =
      "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 2 float\n0 0 0 1 0 0\n";
  expect_bad("a.vtk", "solid\n", {"no legacy VTK file"});
  expect_bad("a.vtk", head + "LINES 1 3\n2 0 7\n", {"names point 7"});
  expect_bad("a.vtk", head, {"no segments"});
}

/// A text cut off in the middle of its last line.
std::string cut(const std::string& header, const std::string& row, std::size_t rows,
                const std::string& rest) {
  std::string content = header;
  content.reserve(header.size() + rows * row.size() + rest.size());
  for (std::size_t i = 0; i < rows; ++i) content += row;
  return content + rest;
}

// Ten million lines, the last of them cut: named by its line, with what was read until then.
TEST(GraphBadFiles, TenMillionLinesCutOffInTheMiddle) {
  expect_bad("cut.swc", cut("", "1 0 1 2 3 1 -1\n", 10'000'000, "2 0 1 2"),
             {"line 10000001: the file ends within it", "10000000 samples were read"});
}

TEST(GraphBadFiles, CutOffInTheMiddle) {
  expect_bad("cut.csv", cut("x,y,z,radius\n", "1,2,3,1\n", 100'000, "1,2"),
             {"line 100002: the file ends within it", "99999 segments were read"});
  expect_bad("cut.gxl", cut("<gxl>\n", "<edge from='a' to='b'/>\n", 100'000, "<edge from='a'"),
             {"line 100002: the file ends", "100000 edges were read"});
  expect_bad("cut.gxl", "<gxl>\n<node id='a'>\n<attr name='position'>", {"within a node", "1 nodes"});
}

// Where the cut leaves a whole number of columns it cannot be known, but it can be told.
TEST(GraphBadFiles, ALastLineWithoutItsEndIsTold) {
  const LoadedGraph loaded = read_graph(file_with("end.swc", "1 0 0 0 0 1 -1\n2 0 1 0 0 1 1"));
  ASSERT_EQ(loaded.warnings.size(), 1u);
  EXPECT_NE(loaded.warnings[0].find("line 2, the last one, has no end"), std::string::npos);
}

TEST(GraphBadFiles, ALineWithoutAnyEndIsNotHeld) {
  expect_bad("long.swc", "1 0 0 0 0 1 -1\n" + std::string(std::size_t{5} << 20, '7'), {"line 2", "1 MiB"});
}

TEST(GraphBadFiles, Cancels) {
  core::TaskContext task;
  task.cancel();
  for (const char* name : {"a.swc", "a.csv", "a.gxl"})
    EXPECT_THROW(read_graph(file_with(name, "1 0 0 0 0 1 -1\n"), task), Cancelled) << name;
}

}  // namespace
}  // namespace ostia::io
