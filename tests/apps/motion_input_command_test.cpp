// What `ostia motion` takes: how phases are counted, units, faces, marks of layers, what was done already.

#include "program.h"

#include "ostia/core/files.h"
#include "ostia/io/cage_motion_file.h"
#include "ostia/io/mesh_export.h"
#include "ostia/io/surface_file.h"
#include "ostia/io/volume_mesh_file.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>
#include <numbers>

namespace ostia::testing {
namespace {

namespace fs = std::filesystem;
using geometry::TriMesh;
using geometry::Vec3;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;

/// Up and down along z, mm.
double lift(double phase) {
  return std::sin(2.0 * std::numbers::pi * phase);
}

/// `motion.json`: a box of 10 mm goes up and down, with these phases.
void write_motion(const fs::path& folder, const std::vector<double>& phases = {0.0, 0.25, 0.5, 0.75}) {
  geometry::CageMotion motion;
  motion.grid = geometry::cage_around({Vec3(0, 0, 0), Vec3(10, 10, 10)}, 1);
  for (const double phase : phases) {
    geometry::CagePhase one;
    one.phase = phase;
    for (const Vec3& p : geometry::rest_points(motion.grid))
      one.control_points.push_back(p + Vec3(0.0, 0.0, lift(phase)));
    motion.phases.push_back(std::move(one));
  }
  io::write_cage_motion(folder / "motion.json", {motion, ""});
}

/// A tetrahedron of 4 mm at (3, 3, 3), `up` mm higher.
TriMesh small_surface(double up = 0.0) {
  TriMesh mesh{{{3, 3, 3}, {7, 3, 3}, {3, 7, 3}, {3, 3, 7}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
  for (Vec3& p : mesh.points) p.z() += up;
  return mesh;
}

/// Two tetrahedra, all of the boundary a wall.
geometry::MixedMesh small_mesh(double size_mm = 1.0) {
  geometry::MixedMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  for (Vec3& p : mesh.points) p = Vec3(3, 3, 3) + size_mm * p;
  mesh.tetrahedra = {{0, 1, 2, 3}, {1, 2, 3, 4}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 4}, {2, 3, 4}, {1, 4, 3}};
  mesh.triangle_face_ids.assign(6, 1);
  mesh.faces = {{1, "wall", geometry::FaceKind::wall}};
  return mesh;
}

fs::path folder_with_motion() {
  const fs::path folder = temporary_folder("motion-input");
  write_motion(folder);
  io::write_surface(folder / "at-rest.vtp", small_surface());
  fs::create_directory(folder / "phases");
  return folder;
}

Outcome evaluated(const fs::path& folder, const std::vector<std::string>& more) {
  return ostia(std::vector<std::string>{"motion", "evaluate", "motion.json", "phases", "--surface",
                                        "at-rest.vtp", "--json", "--sample", "0.5", "--resolution", "0.5"} +
                   more,
               {folder, ""});
}

std::string motion_input_refusal(const std::vector<std::string>& arguments, const fs::path& folder,
                                 int code = 3) {
  const Outcome done = ostia(arguments, {folder, ""});
  EXPECT_EQ(done.code, code) << done.err;
  return done.err;
}

TEST(MotionInputCommand, FramesFromOneOnBeginAtTheRPeak) {
  const fs::path folder = folder_with_motion();
  for (int k = 0; k < 4; ++k)
    io::write_surface(folder / "phases" / ("frame_" + std::to_string(k + 1) + ".ply"),
                      small_surface(lift(k / 4.0)));
  const Outcome done = evaluated(folder, {"--frames", "4"});
  ASSERT_EQ(done.code, 0) << done.err;
  const Json result = Json::parse(done.out);
  EXPECT_EQ(result["phases"][1]["phase"], "25 %");
  EXPECT_LT(result["msd_mm"], 1e-6);
  EXPECT_THAT(done.err, HasSubstr("frames are counted from 1 to 4"));
}

TEST(MotionInputCommand, FramesWithOneMissingAreNoPercents) {
  const fs::path folder = folder_with_motion();
  for (int k = 0; k < 25; ++k)
    if (k != 12)
      io::write_surface(folder / "phases" / ("f" + std::to_string(100 + k).substr(1) + ".ply"),
                        small_surface());
  EXPECT_THAT(motion_input_refusal({"motion", "fit", "phases", "-o", "out"}, folder),
              AllOf(HasSubstr("f00.ply"), HasSubstr("f24.ply"), HasSubstr("--frames 25")));
}

TEST(MotionInputCommand, ExactPercentsAreNotDividedByFrames) {
  const fs::path folder = folder_with_motion();
  Json beat;
  for (const int percent : {0, 25, 50, 75}) {
    const std::string name = "phase-" + std::to_string(percent);
    fs::create_directory(folder / "phases" / name);
    io::write_surface(folder / "phases" / name / "lumen.vtp", small_surface(lift(percent / 100.0)));
    beat["phases"].push_back({{"folder", name}, {"percent", percent}});
  }
  core::write_file(folder / "phases" / "heartbeat.json", beat.dump());
  const Outcome done = evaluated(folder, {"--frames", "20"});
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_EQ(Json::parse(done.out)["phases"][3]["phase"], "75 %");
  EXPECT_LT(Json::parse(done.out)["msd_mm"], 1e-6);
}

TEST(MotionInputCommand, PhasesAreKeptAsMessagesCallThem) {
  const fs::path folder = folder_with_motion();
  write_motion(folder, {0.0, 1.0 / 24.0, 0.5, 0.75});
  for (const char* name : {"p0.ply", "p50.ply"}) io::write_surface(folder / "phases" / name, small_surface());
  const Outcome done = evaluated(folder, {"--keep", "0,4.17,50"});
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_EQ(Json::parse(done.out)["used_phases"], 3);
  const Outcome none = evaluated(folder, {"--keep", "0,4.2,50"});
  EXPECT_EQ(none.code, 3);
  EXPECT_THAT(none.err, HasSubstr("no phase 4.2 %; it has 0 %, 4.17 %, 50 %, 75 %"));
}

TEST(MotionInputCommand, NumbersThatAreNoneAreWrongUsage) {
  const fs::path folder = folder_with_motion();
  EXPECT_THAT(
      motion_input_refusal({"motion", "fit", "phases", "-o", "out", "--template-phase", "nan"}, folder, 2),
      HasSubstr("--template-phase"));
  EXPECT_THAT(
      motion_input_refusal({"motion", "export", "motion.json", "-o", "out", "--rr", "nan"}, folder, 2),
      HasSubstr("--rr"));
  EXPECT_THAT(motion_input_refusal(
                  {"motion", "measure", "motion.json", "at-rest.vtp", "-o", "out", "--rr", "nan"}, folder, 2),
              HasSubstr("--rr"));
}

TEST(MotionInputCommand, UnitsAreAskedForWhereTheyAreHardlyMillimetres) {
  const fs::path folder = folder_with_motion();
  TriMesh metres = small_surface();
  for (Vec3& p : metres.points) p /= 1000.0;
  io::write_surface(folder / "metres.ply", metres);
  const std::vector<std::string> apply{"motion", "apply",   "motion.json", "metres.ply",
                                       "-o",     "out.ply", "--phase",     "25"};
  EXPECT_THAT(motion_input_refusal(apply, folder), AllOf(HasSubstr("metres.ply"), HasSubstr("--units")));
  ASSERT_EQ(ostia(apply + std::vector<std::string>{"--units", "m"}, {folder, ""}).code, 0);
  const TriMesh moved = io::read_surface(folder / "out.ply").surface.mesh;
  EXPECT_LT((moved.points[3] - Vec3(3, 3, 8)).norm(), 1e-9);
  const std::vector<std::string> out{"motion",  "export", "motion.json", "-o",        "out",
                                     "--times", "1",      "--surface",   "metres.ply"};
  EXPECT_THAT(motion_input_refusal(out, folder), AllOf(HasSubstr("metres.ply"), HasSubstr("--units")));
  EXPECT_EQ(ostia(out + std::vector<std::string>{"--units", "m"}, {folder, ""}).code, 0);
}

TEST(MotionInputCommand, RefusesPointsByFileAndNumber) {
  const fs::path folder = folder_with_motion();
  TriMesh mesh = small_surface();
  mesh.points[2].y() = std::numeric_limits<double>::quiet_NaN();
  io::write_surface(folder / "broken.ply", mesh);
  const auto apply = [&](const std::string& file) {
    return motion_input_refusal({"motion", "apply", "motion.json", file, "-o", "out.ply", "--phase", "0"},
                                folder);
  };
  EXPECT_THAT(apply("broken.ply"), AllOf(HasSubstr("broken.ply"), HasSubstr("point 2 is not a number")));
  mesh = small_surface();
  for (const std::size_t i : {0U, 1U, 2U}) mesh.points[i].z() -= 30.0;
  io::write_surface(folder / "apart.ply", mesh);
  EXPECT_THAT(apply("apart.ply"), HasSubstr("apart.ply: 75.0 % of its points lie outside"));
}

TEST(MotionInputCommand, FacesAndLayersAreKeptOrRefused) {
  const fs::path folder = folder_with_motion();
  const geometry::FacedSurface faced{small_surface(), {1, 1, 1, 2}, {{1, "wall", {}}, {2, "inlet", {}}}};
  io::write_surface(folder / "faced.vtp", faced);
  EXPECT_THAT(motion_input_refusal(
                  {"motion", "apply", "motion.json", "faced.vtp", "-o", "out.stl", "--phase", "0"}, folder),
              AllOf(HasSubstr("out.stl"), HasSubstr("named faces")));
  io::export_mesh(small_mesh(), io::MeshFormat::vtu, folder / "mesh.vtu", {.layer_tetrahedra = 1});
  ASSERT_EQ(
      ostia({"motion", "apply", "motion.json", "mesh.vtu", "-o", "moved.vtu", "--phase", "25"}, {folder, ""})
          .code,
      0);
  const std::vector<bool> marks{false, true};
  EXPECT_EQ(io::read_layered_mesh(folder / "moved.vtu").in_layers, marks);
  const Outcome done = ostia({"motion", "export", "motion.json", "--surface", "at-rest.vtp", "--mesh",
                              "mesh.vtu", "-o", "out", "--times", "1", "--format", "vtu,openfoam"},
                             {folder, ""});
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_EQ(io::read_layered_mesh(folder / "out" / "mesh_000.vtu").in_layers, marks);
  EXPECT_EQ(io::read_layered_mesh(folder / "out" / "openfoam").in_layers, marks);
}

// A folder, and a file that holds no more than the name of another one.
TEST(MotionInputCommand, AnotherMeshIsAnotherJob) {
  for (const char* format : {"openfoam", "xdmf"}) {
    const fs::path folder = folder_with_motion(), mesh = folder / "mesh";
    const std::string named = std::string(format) == "xdmf" ? "mesh/mesh.xdmf" : "mesh";
    const std::vector<std::string> command{"motion", "export", "motion.json", "--surface", "at-rest.vtp",
                                           "--mesh", named,    "-o",          "out",       "--times",
                                           "1"};
    io::export_mesh(small_mesh(), io::mesh_format(format), mesh);
    ASSERT_EQ(ostia(command, {folder, ""}).code, 0) << format;
    EXPECT_THAT(ostia(command, {folder, ""}).err, HasSubstr("nothing to do")) << format;
    io::export_mesh(small_mesh(2.0), io::mesh_format(format), mesh);
    EXPECT_THAT(ostia(command, {folder, ""}).err, Not(HasSubstr("nothing to do"))) << format;
    const Vec3 last = io::read_volume_mesh(folder / "out" / "mesh_000.vtu").points.back();
    EXPECT_LT((last - Vec3(5, 5, 5)).norm(), 1e-6) << format;
  }
}

}  // namespace
}  // namespace ostia::testing
