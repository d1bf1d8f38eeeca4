#include "ostia/io/centerline_file.h"

#include "io_test_support.h"

#include "ostia/io/graph_file.h"

#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>

#include <cmath>

namespace ostia::io {
namespace {

using geometry::Centerline;
using geometry::Vec3;
using geometry::VesselTree;

Centerline line(const Vec3& from, const Vec3& to, double radius) {
  Centerline out;
  for (int i = 0; i <= 10; ++i) {
    out.points.push_back(from + (to - from) * i / 10.0);
    out.radius.push_back(radius - 0.01 * i);
  }
  geometry::complete(out);
  return out;
}

VesselTree fork() {
  const Vec3 a(0, 0, 0), b(0, 0, 10), c(4, 0, 18), d(-4, 0, 18);
  VesselTree tree;
  tree.nodes = {{0, a}, {1, b}, {2, c}, {3, d}};
  tree.segments = {{10, 0, 1, line(a, b, 2.0)}, {11, 1, 2, line(b, c, 1.5)}, {12, 1, 3, line(b, d, 1.4)}};
  tree.vessels = {{5, "LAD", {10, 11}}, {6, "LCX", {10, 12}}};
  return tree;
}

TEST(CenterlineFile, RoundTripsATree) {
  const auto path = testing::temporary_folder("io") / "lines.vtp";
  write_centerlines(path, fork());
  const VesselTree read = read_centerlines(path);
  EXPECT_FALSE(geometry::find_fault(read).has_value());
  ASSERT_EQ(read.segments.size(), 3u);
  EXPECT_EQ(read.nodes.size(), 4u);
  ASSERT_EQ(read.vessels.size(), 2u);
  EXPECT_EQ(read.vessels[0].name, "LAD");
  EXPECT_EQ(read.vessels[1].segments, (std::vector<std::int32_t>{10, 12}));
  EXPECT_EQ(read.vessels[1].id, 6);
  for (std::size_t s = 0; s < 3; ++s) {
    EXPECT_EQ(read.segments[s].axis.points, fork().segments[s].axis.points);
    EXPECT_EQ(read.segments[s].axis.radius, fork().segments[s].axis.radius);
  }
}

TEST(CenterlineFile, CarriesTheNamesThatTheFieldReads) {
  const auto path = testing::temporary_folder("io") / "lines.vtp";
  write_centerlines(path, fork());
  const std::string content = core::read_file(path);
  for (const char* name : {"MaximumInscribedSphereRadius", "CenterlineIds", "GroupIds", "Blanking",
                           "Abscissas", "ParallelTransportNormals", "FrenetTangent", "FrenetNormal",
                           "FrenetBinormal", "Curvature", "Torsion", "TractIds", "Length", "Tortuosity"}) {
    EXPECT_NE(content.find("Name=\"" + std::string(name) + "\""), std::string::npos) << name;
  }
}

TEST(CenterlineFile, WhatIsKnownAlongVesselsStandsBesideTheRadius) {
  const AlongVessels share{"Share", [](std::int32_t vessel, double s_mm) {
                             return s_mm > 1.0 ? vessel + 0.001 * s_mm : std::nan("");
                           }};
  const auto folder = testing::temporary_folder("io");
  write_centerlines(folder / "lines.vtp", fork(), {share});
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName((folder / "lines.vtp").c_str());
  reader->Update();
  vtkPointData& points = *reader->GetOutput()->GetPointData();
  vtkCellData& cells = *reader->GetOutput()->GetCellData();
  ASSERT_NE(points.GetArray("Share"), nullptr);
  vtkIdType looked_at = 0;
  for (vtkIdType c = 0; c < reader->GetOutput()->GetNumberOfCells(); ++c) {
    vtkIdList& ids = *reader->GetOutput()->GetCell(c)->GetPointIds();
    for (vtkIdType i = 0; i < ids.GetNumberOfIds(); ++i) {
      const double s_mm = points.GetArray("Abscissas")->GetTuple1(ids.GetId(i));
      if (s_mm <= 1.0) continue;
      EXPECT_NEAR(points.GetArray("Share")->GetTuple1(ids.GetId(i)),
                  cells.GetArray("CenterlineIds")->GetTuple1(c) + 0.001 * s_mm, 1e-12);
      ++looked_at;
    }
  }
  EXPECT_GT(looked_at, 10);
  write_centerlines(folder / "lines.csv", fork(), {share});
  const std::string table = core::read_file(folder / "lines.csv");
  EXPECT_EQ(table.substr(0, table.find('\n')), "vessel,x,y,z,radius,abscissa,Share");
  EXPECT_EQ(table.substr(table.find('\n') + 1, table.find('\n', table.find('\n') + 1) - table.find('\n') - 1)
                .back(),
            ',')
      << "not known at the root";
  EXPECT_EQ(read_centerlines(folder / "lines.csv").vessels.size(), 2U);
}

/// As VMTK's scripts leave it: without what only Ostia writes.
void forget_segments(const std::filesystem::path& path) {
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkPolyData& data = *reader->GetOutput();
  data.GetPointData()->RemoveArray("SegmentIds");
  data.GetFieldData()->Initialize();
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetFileName(path.c_str());
  writer->SetInputData(&data);
  writer->Write();
}

TEST(CenterlineFile, MarksBifurcationsAsVmtkDoes) {
  const auto path = testing::temporary_folder("io") / "lines.vtp";
  write_centerlines(path, fork());
  const auto lines = read_branched_lines(path);
  ASSERT_TRUE(lines.has_value());
  ASSERT_EQ(lines->lines.size(), 2u);
  EXPECT_EQ(lines->groups, 4);
  const geometry::BranchedLines asked = geometry::branch_groups(fork());
  for (std::size_t l = 0; l < 2; ++l) {
    ASSERT_EQ(lines->lines[l].tracts.size(), 3u);
    for (std::size_t t = 0; t < 3; ++t) {
      const geometry::Tract &read = lines->lines[l].tracts[t], &put = asked.lines[l].tracts[t];
      EXPECT_EQ(read.group, put.group);
      EXPECT_EQ(read.blanked, t == 1);
      const Centerline here = geometry::tract_axis(lines->lines[l], read);
      const Centerline there = geometry::tract_axis(asked.lines[l], put);
      EXPECT_LT((here.points.front() - there.points.front()).norm(), 1e-12);
      EXPECT_LT((here.points.back() - there.points.back()).norm(), 1e-12);
    }
  }
}

TEST(CenterlineFile, ReadsWhatVmtkHasSplit) {
  const auto path = testing::temporary_folder("io") / "lines.vtp";
  write_centerlines(path, fork());
  forget_segments(path);
  const VesselTree read = read_centerlines(path);
  EXPECT_FALSE(geometry::find_fault(read).has_value()) << *geometry::find_fault(read);
  ASSERT_EQ(read.segments.size(), 3u);  // branches, each with the bifurcation before it
  EXPECT_EQ(read.nodes.size(), 4u);
  ASSERT_EQ(read.vessels.size(), 2u);
  EXPECT_EQ(read.vessels[1].segments, (std::vector<std::int32_t>{0, 3}));
  const geometry::Centerline axis = geometry::vessel_axis(read, read.vessels[1]);
  EXPECT_LT((axis.points.back() - Vec3(-4, 0, 18)).norm(), 1e-12);
  EXPECT_NEAR(axis.abscissa.back(), 10.0 + std::hypot(4.0, 8.0), 0.2);
  EXPECT_TRUE(read_branched_lines(path).has_value());
}

TEST(CenterlineFile, ANetworkOfSplitLinesHasEveryWayOnce) {
  const auto path = testing::temporary_folder("io") / "lines.vtp";
  write_centerlines(path, fork());
  const geometry::VesselGraph graph = read_graph(path).graph;
  EXPECT_EQ(graph.edges.size(), 30u);
  EXPECT_EQ(graph.points.size(), 31u);
}

TEST(CenterlineFile, RoundTripsCsvOfVessels) {
  const auto path = testing::temporary_folder("io") / "lines.csv";
  write_centerlines(path, fork());
  const VesselTree read = read_centerlines(path);
  ASSERT_EQ(read.vessels.size(), 2u);
  EXPECT_EQ(read.vessels[1].name, "LCX");
  const Centerline axis = geometry::vessel_axis(read, read.vessels[1]);
  EXPECT_EQ(axis.points, geometry::vessel_axis(fork(), fork().vessels[1]).points);
}

TEST(CenterlineFile, NamesWithCommasAndQuotesComeBackFromCsv) {
  const auto path = testing::temporary_folder("io") / "lines.csv";
  VesselTree tree = fork();
  tree.vessels[1].name = "LCX, the \"second\" one";
  write_centerlines(path, tree);
  const VesselTree read = read_centerlines(path);
  ASSERT_EQ(read.vessels.size(), 2u);
  EXPECT_EQ(read.vessels[1].name, tree.vessels[1].name);
  EXPECT_EQ(geometry::vessel_axis(read, read.vessels[1]).points,
            geometry::vessel_axis(tree, tree.vessels[1]).points);
}

TEST(CenterlineFile, ANameWithALinesEndIsRefusedForCsv) {
  const auto path = testing::temporary_folder("io") / "lines.csv";
  VesselTree tree = fork();
  tree.vessels[1].name = "LCX\nx";
  EXPECT_THROW(write_centerlines(path, tree), InvalidInput);
  EXPECT_FALSE(std::filesystem::exists(path));
}

TEST(CenterlineFile, ReadsPlainCsv) {
  const VesselTree read = read_centerlines(
      file_with("a.csv", "x, y, z, radius\n0,0,0,1.5\n0,0,1,1.25\n\n5,0,0,1\n5,0,1,1\n5,0,2,1\n"));
  ASSERT_EQ(read.segments.size(), 2u);
  EXPECT_EQ(read.segments[0].axis.radius[1], 1.25);
  EXPECT_EQ(read.segments[1].axis.size(), 3u);
}

TEST(CenterlineFile, RefusesWhatIsNoCenterline) {
  const std::vector<std::pair<std::string, std::string>> bad{
      {"x,y,z\n0,0,0\n", "radius"},
      {"x,y,z,radius\n0,0,0,1\n0,0,a,1\n", "row 3"},
      {"x,y,z,radius\n0,0,0,1\n0,0,1,-1\n", "positive"},
      {"x,y,z,radius\n0,0,0,1\n", "fewer than two"},
      {"x,y,z,radius\n", "no points"},
      {"vessel,x,y,z,radius\na,0,0,0,1\n\"a,0,0,1,1\n", "row 3"},
      {"x,y,z,radius\n0,0,0,1\n0,0,nan,1\n", "row 3"}};
  for (const auto& [content, part] : bad) {
    const auto path = file_with("a.csv", content);
    expect_refusal(path, [&] { read_centerlines(path); }, {part});
  }
  const auto other = file_with("a.txt", "1 2 3");
  expect_refusal(other, [&] { read_centerlines(other); }, {".vtp"});
  const auto legacy = file_with("a.vtk", "hello");
  expect_refusal(legacy, [&] { read_centerlines(legacy); }, {"legacy"});
}

TEST(CenterlineFile, VesselsOfATableShareTheWayThatTheyHaveInCommon) {
  const auto path = testing::temporary_folder("io") / "lines.csv";
  write_centerlines(path, fork());
  const VesselTree read = read_centerlines(path);
  EXPECT_EQ(geometry::find_fault(read), std::nullopt);
  EXPECT_EQ(read.segments.size(), 3u);
  EXPECT_EQ(read.nodes.size(), 4u);
  ASSERT_EQ(read.vessels.size(), 2u);
  EXPECT_EQ(read.vessels[0].name, "LAD");
  EXPECT_EQ(read.vessels[0].segments.front(), read.vessels[1].segments.front());
}

TEST(CenterlineFile, ABranchThatBeginsOnAnotherLineIsJoinedThere) {
  const VesselTree read = read_centerlines(file_with(
      "a.csv",
      "vessel,x,y,z,radius\nmain,0,0,0,2\nmain,0,0,1,2\nmain,0,0,2,2\nside,0,0,1,1\nside,1,0,2,1\n"));
  EXPECT_EQ(geometry::find_fault(read), std::nullopt);
  EXPECT_EQ(read.segments.size(), 3u);
  EXPECT_EQ(geometry::roots(read).size(), 1u);
  ASSERT_EQ(read.vessels.size(), 2u);
  EXPECT_EQ(read.vessels[0].name, "main");
  EXPECT_EQ(read.vessels[1].name, "side");
  EXPECT_EQ(geometry::vessel_axis(read, read.vessels[1]).size(), 3u) << "from the root";
}

TEST(CenterlineFile, LinesThatFormALoopStayVesselsOfTheirOwn) {
  const VesselTree read = read_centerlines(
      file_with("a.csv", "x,y,z,radius\n0,0,0,1\n0,0,1,1\n0,0,2,1\n\n0,0,0,1\n0,1,1,1\n0,0,2,1\n"));
  EXPECT_EQ(read.segments.size(), 2u);
  EXPECT_EQ(read.vessels.size(), 2u);
  EXPECT_EQ(read.nodes.size(), 2u);
}

TEST(CenterlineFile, NetworksAreTreesOfVessels) {
  for (const auto& [name, text] : std::vector<std::pair<std::string, std::string>>{
           {"a.swc", "1 2 0 0 0 1 -1\n2 2 0 0 5 0.8 1\n3 2 1 0 9 0.5 2\n4 2 -1 0 9 0.6 2\n"},
           {"a.csv",
            "x1,y1,z1,radius1,x2,y2,z2,radius2\n0,0,0,1,0,0,5,0.8\n0,0,5,0.8,1,0,9,0.5\n0,0,5,0.8,-1,0,9,0."
            "6\n"}}) {
    const VesselTree read = read_centerlines(file_with(name, text));
    EXPECT_EQ(geometry::find_fault(read), std::nullopt) << name;
    EXPECT_EQ(read.segments.size(), 3u) << name;
    EXPECT_EQ(read.vessels.size(), 2u) << name;
  }
  const auto loop =
      file_with("b.csv", "x1,y1,z1,x2,y2,z2,radius\n0,0,0,1,0,0,1\n1,0,0,1,1,0,1\n1,1,0,0,0,0,1\n");
  expect_refusal(loop, [&] { read_centerlines(loop); }, {"loops"});
}

}  // namespace
}  // namespace ostia::io
