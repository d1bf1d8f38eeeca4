// Faulty surfaces: refused where they cannot be used, mended where they can be.

#include "program.h"

#include "ostia/core/files.h"
#include "ostia/io/surface_file.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace ostia::testing {
namespace {

using geometry::TriMesh;
using ::testing::HasSubstr;
using Json = nlohmann::json;

/// A box from `corner`, 10 mm wide, 12 triangles, outward.
TriMesh box(const geometry::Vec3& corner = geometry::Vec3::Zero()) {
  TriMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.points.push_back(corner + 10.0 * geometry::Vec3(i & 1, (i >> 1) & 1, (i >> 2) & 1));
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

/// Its lower side is an inlet.
geometry::FacedSurface box_with_inlet() {
  geometry::FacedSurface faced{
      box(), std::vector<std::int32_t>(12, 1), {{1, "wall", geometry::FaceKind::wall}}};
  faced.face_ids[0] = faced.face_ids[1] = 2;
  faced.faces.push_back({2, "inlet_a", geometry::FaceKind::inlet});
  return faced;
}

TriMesh both(TriMesh a, const TriMesh& b) {
  const auto shift = static_cast<std::int32_t>(a.points.size());
  a.points.insert(a.points.end(), b.points.begin(), b.points.end());
  for (const geometry::Triangle& t : b.triangles)
    a.triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
  return a;
}

void expect_refused(const TriMesh& mesh, const std::string& what) {
  const auto folder = temporary_folder("faulty");
  io::write_surface(folder / "a.ply", mesh);
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"mesh", "a.ply", "-o", "out", "--strict"},
        {"model", "a.ply", "-o", "out", "--strict"}}) {
    const Outcome done = ostia(command, {folder, ""});
    EXPECT_EQ(done.code, 3) << command.front() << done.err;
    EXPECT_THAT(done.err, HasSubstr(what)) << command.front();
    EXPECT_EQ(names_in(folder).size(), 1u) << command.front();
  }
}

TEST(SurfaceCommands, RefusesSeveralParts) {
  expect_refused(both(box(), box({30, 0, 0})), "as it is: it has 2 separate parts");
}

TEST(SurfaceCommands, RefusesSelfIntersections) {
  expect_refused(both(box(), box({5, 4, 3})), "intersect");
}

TEST(SurfaceCommands, RefusesDuplicateTriangles) {
  TriMesh mesh = box();
  mesh.triangles.push_back(mesh.triangles[3]);
  expect_refused(mesh, "cannot be used as it is");
}

TEST(SurfaceCommands, RepairTurnsTrianglesAndDropsCopiesAndParts) {
  const auto folder = temporary_folder("repair");
  TriMesh mesh = box();
  TriMesh crumb = box({30, 0, 0});
  for (geometry::Vec3& p : crumb.points) p = geometry::Vec3(30, 0, 0) + 0.05 * (p - geometry::Vec3(30, 0, 0));
  mesh = both(mesh, crumb);
  std::swap(mesh.triangles[2][0], mesh.triangles[2][1]);
  mesh.triangles.push_back(mesh.triangles[0]);
  io::write_surface(folder / "a.ply", mesh);
  ASSERT_EQ(ostia({"convert", "a.ply", "b.ply", "--repair"}, {folder, ""}).code, 0);
  const Json mended = Json::parse(ostia({"info", "b.ply", "--json"}, {folder, ""}).out);
  EXPECT_EQ(mended["components"], 1);
  EXPECT_EQ(mended["open_edges"], 0);
  EXPECT_EQ(mended["non_manifold_edges"], 0);
  EXPECT_EQ(mended["duplicate_triangles"], 0);
  EXPECT_NEAR(mended["volume_mm3"].get<double>(), 1000.0, 1e-3);
}

TEST(SurfaceCommands, RepairTellsWhatItDidAsJson) {
  const auto folder = temporary_folder("repair_json");
  TriMesh mesh = box();
  mesh.triangles.pop_back();
  mesh.triangles.push_back(mesh.triangles[0]);
  io::write_surface(folder / "a.ply", mesh);
  const Outcome done =
      ostia({"convert", "a.ply", "b.ply", "--repair", "--fill-holes", "20", "--json"}, {folder, ""});
  ASSERT_EQ(done.code, 0) << done.err;
  const Json told = Json::parse(done.out);
  EXPECT_EQ(told["triangles"], 12);
  EXPECT_EQ(told["repair"]["left"], "none");
  ASSERT_EQ(told["repair"]["steps"].size(), 2u);
  EXPECT_EQ(told["repair"]["steps"][0]["what"], "duplicate_triangles_dropped");
  EXPECT_EQ(told["repair"]["steps"][1]["what"], "holes_filled");
  EXPECT_EQ(told["repair"]["steps"][1]["count"], 1);
}

TEST(SurfaceCommands, SmoothsAndSubdivides) {
  const auto folder = temporary_folder("subdivide");
  io::write_surface(folder / "a.ply", box());
  const Outcome done =
      ostia({"convert", "a.ply", "b.ply", "--subdivide", "2", "--smooth", "1", "--json"}, {folder, ""});
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_EQ(Json::parse(done.out)["subdivided"], 2);
  EXPECT_EQ(Json::parse(done.out)["smoothed"], 1);
  const Json fine = Json::parse(ostia({"info", "b.ply", "--json"}, {folder, ""}).out);
  EXPECT_EQ(fine["triangles"], 12 * 16);
  EXPECT_EQ(fine["open_edges"], 0);
  EXPECT_LT(fine["volume_mm3"].get<double>(), 900.0);  // corners are rounded
  io::write_surface(folder / "faced.vtp", box_with_inlet());
  const Outcome refused = ostia({"convert", "faced.vtp", "c.vtp", "--subdivide", "1"}, {folder, ""});
  EXPECT_EQ(refused.code, 3);
  EXPECT_THAT(refused.err, HasSubstr("before the ends are capped"));
}

TEST(SurfaceCommands, SmoothsAWallBetweenItsCaps) {
  const auto folder = temporary_folder("smooth");
  const geometry::FacedSurface before = box_with_inlet();
  io::write_surface(folder / "a.vtp", before);
  const Outcome done = ostia({"convert", "a.vtp", "b.vtp", "--smooth", "5"}, {folder, ""});
  ASSERT_EQ(done.code, 0) << done.err;
  const geometry::FacedSurface after = io::read_surface(folder / "b.vtp").surface;
  EXPECT_EQ(after.face_ids, before.face_ids);
  EXPECT_EQ(after.faces.size(), 2u);
  for (std::size_t p = 0; p < 8; ++p)
    EXPECT_EQ((after.mesh.points[p] - before.mesh.points[p]).norm() < 1e-6, p < 4) << p;  // z = 0: the inlet
}

TEST(SurfaceCommands, RepairSaysThatItLeavesNamesOfFacesOut) {
  const auto folder = temporary_folder("repair");
  io::write_surface(folder / "a.vtp", box_with_inlet());
  const Outcome done = ostia({"convert", "a.vtp", "b.vtp", "--repair"}, {folder, ""});
  EXPECT_THAT(done.err, HasSubstr("the names of its 2 faces are left out"));
}

TEST(SurfaceCommands, CheckJudgesByItsExitCode) {
  const auto folder = temporary_folder("check");
  TriMesh open = box();
  open.triangles.pop_back();
  io::write_surface(folder / "closed.stl", box());
  io::write_surface(folder / "open.stl", open);
  const Outcome good = ostia({"mesh", "--check", "closed.stl", "--json"}, {folder, ""});
  EXPECT_EQ(good.code, 0) << good.err;
  EXPECT_NEAR(Json::parse(good.out)["surface"]["min_angle_deg"].get<double>(), 45.0, 1e-3);
  const Outcome bad = ostia({"mesh", "--check", "open.stl", "--json"}, {folder, ""});
  EXPECT_EQ(bad.code, 4) << bad.err;
  EXPECT_EQ(Json::parse(bad.out)["surface"]["open_edges"], 3);
}

TEST(SurfaceCommands, AsksForTheUnit) {
  const auto folder = temporary_folder("unit");
  TriMesh metres = box();
  for (geometry::Vec3& p : metres.points) p *= 1e-6;
  io::write_surface(folder / "a.ply", metres);
  const Outcome done = ostia({"mesh", "a.ply", "-o", "out"}, {folder, ""});
  EXPECT_EQ(done.code, 3);
  EXPECT_THAT(done.err, HasSubstr("--units"));
}

TEST(SurfaceCommands, LegacyPolydataIsASurfaceEverywhere) {
  const auto folder = temporary_folder("legacy");
  core::write_file(folder / "a.vtk",
                   "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 4 double\n"
                   "0 0 0 10 0 0 0 10 0 0 0 10\nTRIANGLE_STRIPS 1 7\n6 0 2 1 3 0 2\n");
  const Json info = Json::parse(ostia({"info", "a.vtk", "--json"}, {folder, ""}).out);
  EXPECT_EQ(info["triangles"], 4);
  EXPECT_EQ(info["open_edges"], 0);
  EXPECT_NEAR(info["volume_mm3"].get<double>(), 1000.0 / 6.0, 1e-9);
  EXPECT_EQ(ostia({"convert", "a.vtk", "b.stl"}, {folder, ""}).code, 0);
  EXPECT_EQ(io::read_surface(folder / "b.stl").surface.mesh.triangles.size(), 4u);
}

}  // namespace
}  // namespace ostia::testing
