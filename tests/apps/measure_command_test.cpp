#include "branched_shapes.h"
#include "program.h"

#include "ostia/core/files.h"
#include "ostia/geometry/analytic_shapes.h"
#include "ostia/geometry/vessel_tree.h"
#include "ostia/io/centerline_file.h"
#include "ostia/io/surface_fields.h"
#include "ostia/io/surface_file.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <numbers>

namespace ostia::testing {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;

/// A trunk of 10 mm, two children of 5 mm each, all as wide as Murray's law wants; a stray vessel across one.
constexpr const char* measure_fork =
    "x1,y1,z1,radius1,x2,y2,z2,radius2\n"
    "0,0,0,1,0,0,10,1\n"
    "0,0,10,0.793700526,3,0,14,0.793700526\n"
    "0,0,10,0.793700526,-3,0,14,0.793700526\n";

TEST(MeasureCommand, AForkIsMeasuredAsItIs) {
  const auto folder = temporary_folder("measure");
  core::write_file(folder / "tree.csv", measure_fork);
  const Setting in{folder, ""};
  const Outcome done = ostia({"measure", "tree.csv", "-o", "out", "--json"}, in);
  ASSERT_EQ(done.code, 0) << done.err;
  const json m = json::parse(done.out);
  EXPECT_EQ(m["segments"], 3);
  EXPECT_EQ(m["ends"], 2);
  EXPECT_NEAR(m["length_mm"].get<double>(), 20.0, 1e-9);
  const double child = 0.793700526;
  EXPECT_NEAR(m["volume_mm3"].get<double>(), std::numbers::pi * (10.0 + 10.0 * child * child), 1e-6);
  EXPECT_NEAR(m["murray_exponent"].get<double>(), 3.0, 1e-6);
  EXPECT_NEAR(m["median_angles_deg"]["between"].get<double>(), 2.0 * std::atan2(3.0, 4.0) * 180.0 / M_PI,
              1e-6);
  EXPECT_EQ(m["overlaps"]["count"], 0);
  EXPECT_EQ(core::read_file(folder / "out/measures.json"), done.out);
  for (const char* name : {"segments.csv", "branches.csv", "orders.csv", "connectivity.csv", "forks.csv",
                           "overlaps.csv", "report.html", "manifest.json", "pictures/murray.png"})
    EXPECT_TRUE(fs::exists(folder / "out" / name)) << name;
  EXPECT_THAT(core::read_file(folder / "out/segments.csv"), HasSubstr("0.793700526"));
  EXPECT_THAT(ostia({"measure", "tree.csv", "-o", "out"}, in).err, HasSubstr("done already"));
}

TEST(MeasureCommand, VesselsThatCrossAreListedByTheirLines) {
  const auto folder = temporary_folder("measure_cross");
  core::write_file(folder / "tree.csv", std::string(measure_fork) + "-5,0,5,0.5,5,0,5,0.5\n");
  const Setting in{folder, ""};
  const Outcome done = ostia({"measure", "tree.csv", "-o", "out", "--json"}, in);
  ASSERT_EQ(done.code, 0) << done.err;
  const json overlaps = json::parse(done.out)["overlaps"];
  ASSERT_EQ(overlaps["count"], 1);
  EXPECT_EQ(overlaps["first"][0]["references"], (json{2, 5}));  // lines of the file
  EXPECT_NEAR(overlaps["first"][0]["depth_mm"].get<double>(), 1.5, 1e-6);
}

TEST(MeasureCommand, ASurfaceIsMeasuredByItsCenterlines) {
  const auto folder = temporary_folder("measure_surface");
  io::write_surface(folder / "tube.stl",
                    geometry::structured_surface(geometry::straight_tube(30.0, 2.0).tubes.front(), 48, 0.5));
  const Setting in{folder, ""};
  const Outcome done = ostia({"measure", "tube.stl", "-o", "out", "--json"}, in);
  ASSERT_EQ(done.code, 0) << done.err;
  const json m = json::parse(done.out);
  EXPECT_NEAR(m["length_mm"].get<double>(), 30.0, 1.0);
  EXPECT_NEAR(m["volume_mm3"].get<double>() / (std::numbers::pi * 4.0 * 30.0), 1.0, 0.06);
}

/// Straight tubes of radius 2, the children 60 degrees apart, as a surface with its height and its lines.
void write_fork(const std::filesystem::path& folder) {
  const geometry::VesselTree tree = analysis::straight_y(60.0, 0.0, 2.0);
  const geometry::TriMesh wall = geometry::surface_of(analysis::shape_of(tree), 0.4, true);
  io::PointFields fields;
  for (const geometry::Vec3& p : wall.points) fields["height"].values.push_back(p.z());
  const std::vector<std::int32_t> faces(wall.triangles.size(), 1);
  io::write_vtp_with_fields(folder / "fork.vtp", {wall, faces, {{}}}, fields);
  io::write_centerlines(folder / "lines.vtp", tree);
}

TEST(MeasureCommand, AForksBifurcationSectionsAndPatchesAreMeasured) {
  const auto folder = temporary_folder("measure_branches");
  write_fork(folder);
  const Setting in{folder, ""};
  const Outcome done =
      ostia({"measure", "fork.vtp", "--centerline", "lines.vtp", "-o", "out", "--bifurcations", "--sections",
             "--patch-length", "2", "--patch-sectors", "6", "--json"},
            in);
  ASSERT_EQ(done.code, 0) << done.err;
  const json m = json::parse(done.out)["branch_measures"];
  EXPECT_EQ(m, json::parse(core::read_file(folder / "out/branches.json")));
  ASSERT_EQ(m["bifurcations"].size(), 1u);
  const json& fork = m["bifurcations"][0];
  EXPECT_NEAR(fork["angle_between_deg"].get<double>(), 60.0, 1e-6);
  EXPECT_NEAR(std::abs(fork["vectors"][1]["in_plane_deg"].get<double>()), 30.0, 1e-6);
  EXPECT_NEAR(fork["area_ratio"].get<double>(), 2.0, 0.05);
  EXPECT_NEAR(fork["sections"][0]["area_mm2"].get<double>(), 4.0 * std::numbers::pi, 0.3);
  EXPECT_EQ(m["branches"].size(), 3u);
  EXPECT_GT(m["patches"]["count"].get<int>(), 60);
  EXPECT_EQ(m["patches"]["arrays"], (json{"DistanceToCenterlines", "height"}));
  for (const char* name :
       {"branch-geometry.csv", "bifurcations.csv", "bifurcation-vectors.csv", "branch-sections.csv",
        "bifurcation-sections.csv", "patches.csv", "bifurcation-systems.vtp", "bifurcation-vectors.vtp",
        "branch-sections.vtp", "bifurcation-sections.vtp", "mapped-surface.vtp", "patches.vtp"})
    EXPECT_TRUE(fs::exists(folder / "out" / name)) << name;
  EXPECT_THAT(core::read_file(folder / "out/report.html"), HasSubstr("Bifurcations"));
  for (const char* name : {"BranchSectionArea", "BranchSectionClosed", "BranchSectionDistanceSpheres"})
    EXPECT_THAT(core::read_file(folder / "out/branch-sections.vtp"), HasSubstr(name));
  const io::SurfaceWithFields mapped = io::read_surface_with_fields(folder / "out/mapped-surface.vtp");
  for (std::size_t i = 0; i < mapped.mesh.points.size(); ++i)
    EXPECT_NEAR(mapped.points.at("height").values[i], mapped.mesh.points[i].z(), 1e-9);
  EXPECT_TRUE(mapped.points.contains("StretchedMapping"));
}

TEST(MeasureCommand, LinesAloneHaveBifurcationsButNoSections) {
  const auto folder = temporary_folder("measure_lines");
  write_fork(folder);
  const Setting in{folder, ""};
  const Outcome done = ostia({"measure", "lines.vtp", "-o", "out", "--bifurcations"}, in);
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_THAT(done.out, HasSubstr("60.0 degrees"));
  const Outcome sections = ostia({"measure", "lines.vtp", "-o", "none", "--sections"}, in);
  EXPECT_EQ(sections.code, 2);
  EXPECT_THAT(sections.err, HasSubstr("--centerline"));
  EXPECT_EQ(ostia({"measure", "lines.vtp", "-o", "none", "--patch-length", "1"}, in).code, 2);
  EXPECT_EQ(ostia({"measure", "fork.vtp", "-o", "none", "--section-spheres", "2"}, in).code, 2);
  EXPECT_EQ(ostia({"measure", "fork.vtp", "-o", "none", "--patch-sectors", "2"}, in).code, 2);
  EXPECT_EQ(ostia({"measure", "lines.vtp", "-o", "none", "--centerline", "lines.vtp"}, in).code, 2);
  EXPECT_FALSE(fs::exists(folder / "none"));
}

TEST(MeasureCommand, WholeLinesOfVmtkAreJoinedWhereTheyShareTheirWay) {
  const auto folder = temporary_folder("measure_whole_lines");
  core::write_file(folder / "lines.vtk",
                   "# vtk DataFile Version 3.0\nlines\nASCII\nDATASET POLYDATA\nPOINTS 8 float\n"
                   "0 0 0 0 0 5 0 0 10 3 0 14\n0 0 0 0 0 5 0 0 10 -3 0 14\nLINES 2 10\n4 0 1 2 3\n4 4 5 6 7\n"
                   "POINT_DATA 8\nSCALARS MaximumInscribedSphereRadius float 1\nLOOKUP_TABLE default\n"
                   "1 1 1 1 1 1 1 1\n");
  const Setting in{folder, ""};
  const Outcome done = ostia({"measure", "lines.vtk", "-o", "out", "--bifurcations"}, in);
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_THAT(done.out, HasSubstr("3 branches, 2 ends"));
  EXPECT_THAT(done.out, HasSubstr("length 20 mm"));
  EXPECT_THAT(done.err, HasSubstr("run side by side are joined: "));
  EXPECT_EQ(ostia({"reconstruct", "lines.vtk", "-o", "wall.vtp"}, in).code, 0);
}

TEST(MeasureCommand, WhatCannotBeMeasuredIsToldAndLeavesNothing) {
  const auto folder = temporary_folder("measure_bad");
  core::write_file(folder / "bad.csv", "x1,y1,z1,radius1,x2,y2,z2,radius2\n0,0,0,1,0,0,0,1\n");
  core::write_file(folder / "tree.csv", measure_fork);
  const Setting in{folder, ""};
  const Outcome bad = ostia({"measure", "bad.csv", "-o", "out"}, in);
  EXPECT_EQ(bad.code, 3);
  EXPECT_THAT(bad.err, HasSubstr("--repair"));
  EXPECT_EQ(ostia({"measure", "none.csv", "-o", "out"}, in).code, 3);
  const Outcome useless = ostia({"measure", "tree.csv", "-o", "out", "--source", "0,0,0"}, in);
  EXPECT_EQ(useless.code, 2);
  EXPECT_THAT(useless.err, HasSubstr("surfaces"));
  EXPECT_FALSE(fs::exists(folder / "out"));
}

TEST(MeasureCommand, OfAFolderItsLinesOrItsLumenAreMeasured) {
  const auto folder = temporary_folder("measure_folder");
  fs::create_directories(folder / "made");
  const Setting in{folder, ""};
  const Outcome none = ostia({"measure", "made", "-o", "out"}, in);
  EXPECT_EQ(none.code, 3);
  EXPECT_THAT(none.err, HasSubstr("centerlines.vtp"));
  io::write_surface(folder / "made/lumen.vtp",
                    geometry::structured_surface(geometry::straight_tube(30.0, 2.0).tubes.front(), 48, 0.5));
  const Outcome lumen = ostia({"measure", "made", "-o", "out", "--json"}, in);
  ASSERT_EQ(lumen.code, 0) << lumen.err;
  EXPECT_NEAR(json::parse(lumen.out)["length_mm"].get<double>(), 30.0, 1.0);
  core::write_file(folder / "line.txt", "0 0 0 2 1\n0 0 5 2 1\n0 0 12 2 1\n");
  ASSERT_EQ(ostia({"convert", "line.txt", "made/centerlines.vtp"}, in).code, 0);
  const Outcome lines = ostia({"measure", "made", "-o", "out2", "--json"}, in);
  ASSERT_EQ(lines.code, 0) << lines.err;
  EXPECT_NEAR(json::parse(lines.out)["length_mm"].get<double>(), 12.0, 1e-9);
}

}  // namespace
}  // namespace ostia::testing
