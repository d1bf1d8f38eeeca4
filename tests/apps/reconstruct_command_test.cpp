#include "program.h"

#include "ostia/core/files.h"
#include "ostia/geometry/isosurface.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/io/surface_fields.h"
#include "ostia/io/surface_file.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

namespace ostia::testing {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;

/// A straight vessel of 20 mm and radius 2 mm: its volume is 80 pi mm3.
constexpr const char* one_line = "id,x,y,z,radius,parent\n1,0,0,0,2,-1\n2,0,0,20,2,1\n";
constexpr const char* reconstruct_fork =
    "id,x,y,z,radius,parent\n1,0,0,0,2,-1\n2,0,0,20,2,1\n3,8,0,34,1.4,2\n4,-6,0,36,1.2,2\n";

struct Folder {
  explicit Folder(const char* tree) { core::write_file(path / "tree.csv", tree); }
  Outcome run(std::vector<std::string> rest) const {
    return ostia(std::vector<std::string>{"reconstruct"} + rest, {path, ""});
  }
  std::filesystem::path path = temporary_folder("reconstruct");
};

TEST(ReconstructCommand, AStraightVesselHasItsVolume) {
  const Folder folder(one_line);
  const Outcome done = folder.run({"tree.csv", "-o", "tube.vtp", "--level", "2", "--json"});
  ASSERT_EQ(done.code, 0) << done.err;
  const Json told = Json::parse(done.out);
  EXPECT_EQ(told["branches"], 1);
  EXPECT_EQ(told["level"], 2);
  EXPECT_EQ(told["closed"], true);
  EXPECT_EQ(told["self_intersections"], 0);
  EXPECT_TRUE(told["narrowed"].empty());
  const double volume = 80.0 * std::numbers::pi;
  EXPECT_NEAR(told["volume_mm3"].get<double>(), volume, 1e-6 * volume);
  const auto read = io::read_surface(folder.path / "tube.vtp").surface;
  EXPECT_EQ(read.mesh.triangles.size(), 2 * told["quads"].get<std::size_t>());
  EXPECT_TRUE(geometry::find_faults(read.mesh, true).closed_manifold());
  EXPECT_NEAR(geometry::volume(read.mesh), volume, 1e-6 * volume);
  ASSERT_EQ(read.faces.size(), 3u);
  EXPECT_THAT(read.faces[1].name, HasSubstr("inlet"));
}

TEST(ReconstructCommand, AllFormatsHoldTheSameClosedSurface) {
  const Folder folder(reconstruct_fork);
  for (const char* name : {"a.vtp", "a.ply", "a.obj", "a.stl"}) {
    SCOPED_TRACE(name);
    const Outcome done = folder.run({"tree.csv", "-o", name});
    ASSERT_EQ(done.code, 0) << done.err;
    EXPECT_THAT(done.out, HasSubstr("3 branches; level 1"));
    const auto mesh = io::read_surface(folder.path / name).surface.mesh;
    EXPECT_EQ(geometry::find_faults(mesh, true).summary(), "none");
  }
  EXPECT_EQ(folder.run({"tree.csv", "-o", "a.vtk"}).code, 0);
  const auto branches = io::read_surface_with_fields(folder.path / "a.vtk").triangles.at("BranchIds").values;
  EXPECT_EQ(*std::max_element(branches.begin(), branches.end()), 2.0);
}

TEST(ReconstructCommand, UnitsAndRepairAreThoseOfTrees) {
  const Folder folder("id,x,y,z,radius,parent\n1,0,0,0,2,-1\n2,0,0,0.02,2,1\n3,0,0,0.02,2,2\n");
  const Outcome bad =
      folder.run({"tree.csv", "-o", "tube.vtp", "--units", "m", "--radius-units", "mm", "--json"});
  EXPECT_EQ(bad.code, 3);
  EXPECT_THAT(bad.err, HasSubstr("--repair"));
  EXPECT_FALSE(std::filesystem::exists(folder.path / "tube.vtp"));
  const Outcome done = folder.run(
      {"tree.csv", "-o", "tube.vtp", "--units", "m", "--radius-units", "mm", "--repair", "--json"});
  ASSERT_EQ(done.code, 0) << done.err;
  const Json told = Json::parse(done.out);
  EXPECT_FALSE(told["repair"]["steps"].empty());
  EXPECT_NEAR(told["volume_mm3"].get<double>(), 80.0 * std::numbers::pi, 1e-3);
}

// Two vessels side by side, nearer to each other than their radii, and no round to take them apart.
TEST(ReconstructCommand, WhatStillCrossesIsToldAndWritten) {
  const Folder folder("id,x,y,z,radius,parent\n1,0,0,0,2,-1\n2,0,0,20,2,1\n3,1,0,-5,2,-1\n4,1,0,25,2,3\n");
  const Outcome done = folder.run({"tree.csv", "-o", "a.vtp", "--untangling", "0", "--json"});
  EXPECT_EQ(done.code, 4) << done.err;
  const Json told = Json::parse(done.out);
  EXPECT_EQ(told["closed"], false);
  EXPECT_GT(told["self_intersections"].get<int>(), 0);
  EXPECT_THAT(done.err, HasSubstr("cross: " + told["self_intersections"].dump()));
  EXPECT_TRUE(std::filesystem::exists(folder.path / "a.vtp"));
}

/// Semi-axes 3 and 1.5 mm along z, scaled.
void write_elliptic_wall(const std::filesystem::path& file, double scale) {
  const auto inside = [scale](const geometry::Vec3& p) {
    return std::hypot(p.x() / (3.0 * scale), p.y() / (1.5 * scale)) - 1.0;
  };
  const geometry::Box3 box(geometry::Vec3(-4.0 * scale, -2.0 * scale, -1.0),
                           geometry::Vec3(4.0 * scale, 2.0 * scale, 21.0));
  io::write_surface(file, geometry::isosurface(inside, box, 0.2 * scale));
}

TEST(ReconstructCommand, SectionsAreThoseOfAWall) {
  const Folder folder(one_line);
  write_elliptic_wall(folder.path / "wall.stl", 1.0);
  const Outcome done = folder.run({"tree.csv", "-o", "tube.vtp", "--wall", "wall.stl", "--json"});
  ASSERT_EQ(done.code, 0) << done.err;
  const Json told = Json::parse(done.out);
  EXPECT_GT(told["sections"]["cut"].get<int>(), 20);
  EXPECT_EQ(told["sections"]["used"], told["sections"]["cut"]);
  const double volume = 20.0 * 4.5 * std::numbers::pi;
  EXPECT_NEAR(told["volume_mm3"].get<double>(), volume, 0.01 * volume);
  geometry::Box3 box;
  for (const auto& p : io::read_surface(folder.path / "tube.vtp").surface.mesh.points) box.extend(p);
  EXPECT_NEAR(box.sizes().x(), 6.0, 0.15);  // polygons of the ellipse's area reach a little beyond it
  EXPECT_NEAR(box.sizes().y(), 3.0, 0.1);

  write_elliptic_wall(folder.path / "far.stl", 3.0);
  const Outcome none = folder.run({"tree.csv", "-o", "none.vtp", "--wall", "far.stl"});
  EXPECT_EQ(none.code, 3);
  EXPECT_THAT(none.err, HasSubstr("far.stl"));
  EXPECT_THAT(none.err, HasSubstr("--wall"));
  EXPECT_FALSE(std::filesystem::exists(folder.path / "none.vtp"));
  EXPECT_EQ(folder.run({"tree.csv", "-o", "none.vtp", "--wall", "missing.stl"}).code, 3);
  EXPECT_EQ(folder.run({"tree.csv", "-o", "none.vtp", "--wall", "wall.stl", "--frusta"}).code, 2);
}

TEST(ReconstructCommand, HexahedraFillTheSurface) {
  const Folder folder(reconstruct_fork);
  const Outcome done = folder.run({"tree.csv", "-o", "a.vtp", "--sides", "4", "--level", "2", "--hexahedra",
                                   "case", "--layers", "4", "--layer-growth", "1.3", "--json"});
  ASSERT_EQ(done.code, 0) << done.err;
  const Json told = Json::parse(done.out), hexahedra = told["hexahedra"];
  EXPECT_EQ(hexahedra["folded"], 0);
  EXPECT_GT(hexahedra["least_scaled_jacobian"].get<double>(), 0.25);
  EXPECT_NEAR(hexahedra["volume_mm3"].get<double>(), told["volume_mm3"].get<double>(),
              0.01 * told["volume_mm3"].get<double>());
  // 16 around in four layers, and four squares of 2 x 2 within.
  EXPECT_EQ(hexahedra["count"].get<int>() % (4 * 16 + 16), 0);
  const std::string boundary = core::read_file(folder.path / "case/constant/polyMesh/boundary");
  for (const char* name : {"wall", "inlet_0", "outlet_1", "outlet_2"}) EXPECT_THAT(boundary, HasSubstr(name));
  const Outcome vtu = folder.run({"tree.csv", "-o", "a.vtp", "--hexahedra", "a.vtu"});
  EXPECT_EQ(vtu.code, 0) << vtu.err;
  EXPECT_THAT(vtu.out, HasSubstr("hexahedra; scaled Jacobian at least 0."));
  EXPECT_TRUE(std::filesystem::exists(folder.path / "a.vtu"));
}

// A thin branch of eight sides at a small angle.
TEST(ReconstructCommand, FoldedHexahedraAreTold) {
  const Folder folder(
      "id,x,y,z,radius,parent\n1,0,0,0,2,-1\n2,0,0,20,2,1\n3,0,0,40,2,2\n4,0,0.342,20.94,0.4,2\n5,0,6.84,38."
      "8,0.4,4\n");
  const Outcome done =
      folder.run({"tree.csv", "-o", "a.vtp", "--level", "2", "--hexahedra", "a.vtu", "--json"});
  ASSERT_EQ(done.code, 4) << done.err;
  EXPECT_GT(Json::parse(done.out)["hexahedra"]["folded"].get<int>(), 0);
  EXPECT_EQ(Json::parse(done.out)["closed"], true);
  EXPECT_THAT(done.err, HasSubstr("folded"));
  EXPECT_TRUE(std::filesystem::exists(folder.path / "a.vtu"));
}

TEST(ReconstructCommand, HexahedraNeedALevelAndAFormat) {
  const Folder folder(reconstruct_fork);
  const auto code = [&](std::vector<std::string> rest) {
    return folder.run(std::vector<std::string>{"tree.csv", "-o", "a.vtp"} + rest).code;
  };
  EXPECT_EQ(code({"--hexahedra", "a.vtu", "--level", "0"}), 2);
  EXPECT_EQ(code({"--hexahedra", "a.msh"}), 2);
  EXPECT_EQ(code({"--hexahedra", "a.vtu", "--layers", "0"}), 2);
  EXPECT_EQ(code({"--hexahedra", "a.vtu", "--frusta"}), 2);
  EXPECT_FALSE(std::filesystem::exists(folder.path / "a.vtp"));
}

TEST(ReconstructCommand, ConesForDrawing) {
  const Folder folder(reconstruct_fork);
  const Outcome done = folder.run({"tree.csv", "-o", "a.vtp", "--frusta", "--sides", "6", "--json"});
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_EQ(Json::parse(done.out)["triangles"], 3 * 2 * 6);
  const auto read = io::read_surface_with_fields(folder.path / "a.vtp");
  EXPECT_EQ(read.mesh.triangles.size(), 36u);
  EXPECT_EQ(read.points.at("Normals").components, 3);
  EXPECT_EQ(read.points.at("TextureCoordinates").components, 2);
  EXPECT_EQ(folder.run({"tree.csv", "-o", "a.vtp", "--frusta", "--level", "2"}).code, 2);
}

TEST(ReconstructCommand, RefusesWrongWordsAndBadTrees) {
  const Folder folder(reconstruct_fork);
  for (const std::vector<std::string>& wrong : std::vector<std::vector<std::string>>{
           {"--level", "4"}, {"--sides", "7"}, {"--untangling", "-1"}, {"--root", "0,0,0"}})
    EXPECT_EQ(folder.run(std::vector<std::string>{"tree.csv", "-o", "a.vtp"} + wrong).code, 2) << wrong[0];
  EXPECT_EQ(folder.run({"tree.csv", "-o", "a.nrrd"}).code, 2);
  EXPECT_EQ(folder.run({"nothing.csv", "-o", "a.vtp"}).code, 3);
  core::write_file(folder.path / "bad.csv", "id,x,y,z,radius,parent\n1,0,0,0,1,-1\n2,0,0,1,-4,1\n");
  const Outcome bad = folder.run({"bad.csv", "-o", "a.vtp"});
  EXPECT_EQ(bad.code, 3);
  EXPECT_THAT(bad.err, HasSubstr("bad.csv"));
  EXPECT_FALSE(std::filesystem::exists(folder.path / "a.vtp"));
}

}  // namespace
}  // namespace ostia::testing
