#include "ostia/pipeline/motion_export.h"

#include "box_of_cubes.h"
#include "shared_data.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/io/surface_fields.h"
#include "ostia/io/surface_file.h"
#include "ostia/io/volume_fields.h"
#include "ostia/io/volume_mesh_file.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <functional>
#include <numbers>

namespace ostia::pipeline {
namespace {

namespace fs = std::filesystem;
using geometry::CageMotion;
using geometry::MixedMesh;
using geometry::TriMesh;
using geometry::Vec3;
using ostia::testing::temporary_folder;
using ::testing::HasSubstr;

constexpr double whole_turn = 2.0 * std::numbers::pi;

/// Up and down by 3 mm along z: a sine, whose phases are on a spline to 1e-4.
double lift(double phase) {
  return 3.0 * std::sin(whole_turn * phase);
}

CageMotion lifting_cage() {
  CageMotion motion;
  motion.grid = geometry::cage_around({Vec3(0, 0, 0), Vec3(2, 2, 2)}, 1);
  motion.template_phase = 0.0;
  for (int k = 0; k < 20; ++k) {
    geometry::CagePhase phase;
    phase.phase = k / 20.0;
    for (const Vec3& p : geometry::rest_points(motion.grid))
      phase.control_points.push_back(p + Vec3(0.0, 0.0, lift(phase.phase)));
    motion.phases.push_back(std::move(phase));
  }
  return motion;
}

/// Two mm wide, all of its boundary a wall.
MixedMesh cubes() {
  auto mesh = meshing::box_of_cubes<MixedMesh>(2);
  std::map<std::array<std::int32_t, 3>, geometry::Triangle> free;
  for (const geometry::Tetrahedron& t : mesh.tetrahedra)
    for (const geometry::Triangle side :
         {geometry::Triangle{t[0], t[2], t[1]}, {t[0], t[1], t[3]}, {t[1], t[2], t[3]}, {t[0], t[3], t[2]}}) {
      std::array<std::int32_t, 3> key{side[0], side[1], side[2]};
      std::ranges::sort(key);
      if (const auto [at, fresh] = free.emplace(key, side); !fresh) free.erase(at);
    }
  for (const auto& [key, side] : free) mesh.triangles.push_back(side);
  mesh.triangle_face_ids.assign(mesh.triangles.size(), 1);
  mesh.faces = {{1, "wall", geometry::FaceKind::wall}};
  return mesh;
}

TriMesh wall(const MixedMesh& mesh) {
  return {mesh.points, mesh.triangles};
}

TEST(MotionExport, WritesASurfaceOfTheSameTrianglesAtEveryTime) {
  const fs::path folder = temporary_folder("export");
  const MixedMesh mesh = cubes();
  MotionExportOptions options;
  options.formats = {MotionFormat::vtp, MotionFormat::stl, MotionFormat::csv, MotionFormat::json};
  options.times = 4;
  options.rr_seconds = 0.8;
  const MotionExport made =
      export_motion(folder, motion::MovingCage(lifting_cage()), wall(mesh), nullptr, options);
  ASSERT_EQ(made.times.size(), 4U);
  EXPECT_EQ(made.outside, 0U);
  EXPECT_NEAR(made.times[1].seconds, 0.2, 1e-12);
  EXPECT_NEAR(made.times[1].mean_displacement_mm, 3.0, 1e-9);
  EXPECT_NEAR(made.times[2].max_displacement_mm, 0.0, 1e-9);
  for (int k = 0; k < 4; ++k) {
    const auto read = io::read_surface_with_fields(folder / ("surface_00" + std::to_string(k) + ".vtp"));
    EXPECT_EQ(read.mesh.triangles, mesh.triangles);
    const auto& displacement = read.points.at("displacement_mm");
    const auto& velocity = read.points.at("velocity_mm_s");
    ASSERT_EQ(displacement.components, 3);
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
      EXPECT_NEAR(displacement.values[3 * i + 2], lift(k / 4.0), 1e-9);
      EXPECT_NEAR(velocity.values[3 * i + 2], 3.0 * whole_turn * std::cos(whole_turn * k / 4.0) / 0.8, 0.01);
      EXPECT_LT((read.mesh.points[i] - mesh.points[i] - Vec3(0, 0, lift(k / 4.0))).norm(), 1e-9);
    }
  }
  EXPECT_EQ(io::read_surface(folder / "surface_001.stl").surface.mesh.triangles.size(),
            mesh.triangles.size());
  EXPECT_THAT(core::read_file(folder / "surface.pvd"),
              HasSubstr("timestep=\"0.6\" part=\"0\" file=\"surface_003.vtp\""));
  EXPECT_THAT(core::read_file(folder / "displacement_001.csv"),
              HasSubstr("point,x_mm,y_mm,z_mm,dx_mm,dy_mm,dz_mm\n0,0,0,3,0,0,3\n"));
  const auto points = nlohmann::json::parse(core::read_file(folder / "points.json"));
  EXPECT_EQ(points["phases"][3]["percent"], 75.0);
  EXPECT_NEAR(points["phases"][3]["points"][0][2].get<double>(), -3.0, 1e-9);
}

TEST(MotionExport, MovesAMeshForSolvers) {
  const fs::path folder = temporary_folder("export");
  const MixedMesh mesh = cubes();
  MotionExportOptions options;
  options.formats = {MotionFormat::vtu, MotionFormat::openfoam};
  options.times = 4;
  options.rr_seconds = 1.0;
  const MotionExport made =
      export_motion(folder, motion::MovingCage(lifting_cage()), wall(mesh), &mesh, options);
  EXPECT_EQ(made.inverted(), 0U);
  EXPECT_GT(made.times[0].min_scaled_jacobian, 0.1);
  const MixedMesh third = io::read_volume_mesh(folder / "mesh_003.vtu");
  EXPECT_EQ(third.tetrahedra, mesh.tetrahedra);
  EXPECT_NEAR(third.points[0].z(), -3.0, 1e-9);
  EXPECT_NEAR(io::read_vtu_fields(folder / "mesh_001.vtu").points.at("displacement_mm").values[2], 3.0, 1e-9);
  EXPECT_THAT(core::read_file(folder / "mesh.pvd"), HasSubstr("mesh_003.vtu"));
  const fs::path foam = folder / "openfoam";
  EXPECT_EQ(io::read_volume_mesh(foam).points.size(), mesh.points.size());
  fs::copy_file(foam / "0.25" / "polyMesh" / "points", foam / "constant" / "polyMesh" / "points",
                fs::copy_options::overwrite_existing);
  const MixedMesh lifted = io::read_volume_mesh(foam);
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
    EXPECT_LT((lifted.points[i] - mesh.points[i] - Vec3(0, 0, 3)).norm(), 1e-9);
  EXPECT_THAT(core::read_file(foam / "0.75" / "pointDisplacement"),
              AllOf(HasSubstr("pointVectorField"), HasSubstr("[0 1 0 0 0 0 0]"), HasSubstr(" -0.003)\n")));
  EXPECT_THAT(core::read_file(foam / "system" / "controlDict"), HasSubstr("endTime         0.75;"));
}

TEST(MotionExport, CountsElementsThatAreTurnedInsideOut) {
  const fs::path folder = temporary_folder("export");
  const MixedMesh mesh = cubes();
  CageMotion motion = lifting_cage();
  for (Vec3& p : motion.phases[10].control_points) p.x() = 2.0 - p.x();  // mirrored
  MotionExportOptions options;
  options.formats = {MotionFormat::vtu};
  options.times = 20;
  const MotionExport made = export_motion(folder, motion::MovingCage(motion), wall(mesh), &mesh, options);
  EXPECT_EQ(made.times[10].inverted, mesh.tetrahedra.size());
  EXPECT_LT(made.times[10].min_scaled_jacobian, 0.0);
  EXPECT_EQ(made.times[5].inverted, 0U);
  EXPECT_THAT(made.warnings, ::testing::Contains(HasSubstr("50 % of the cycle) 48 elements are inverted")));
}

std::string refusal(const std::function<void()>& call) {
  try {
    call();
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "not refused";
}

// The surface is judged beside a mesh that is in the cage too.
TEST(MotionExport, JudgesSurfaceAndMesh) {
  const fs::path folder = temporary_folder("export");
  const MixedMesh mesh = cubes();
  const motion::MovingCage cage(lifting_cage());
  MotionExportOptions options;
  options.times = 1;
  options.surface_name = "lumen.vtp";
  TriMesh surface = wall(mesh);
  surface.points[4].x() += 100.0;
  EXPECT_THAT(export_motion(folder, cage, surface, &mesh, options).warnings,
              ::testing::ElementsAre(HasSubstr("lumen.vtp: 3.7 % of its points lie outside")));
  for (std::size_t i = 0; i < 14; ++i) surface.points[i].x() = 100.0;  // of 27
  EXPECT_THAT(refusal([&] { export_motion(folder, cage, surface, &mesh, options); }),
              HasSubstr("lumen.vtp: 51.9 % of its points lie outside"));
  surface = wall(mesh);
  surface.points[5].y() = std::nan("");
  EXPECT_EQ(refusal([&] { export_motion(folder, cage, surface, &mesh, options); }),
            "lumen.vtp: point 5 is not a number");
}

TEST(MotionExport, TellsHowFarItIsWithinATime) {
  const fs::path folder = temporary_folder("export");
  fs::create_directory(folder / "displacement_000.csv");  // cannot be written, after surface and mesh
  const MixedMesh mesh = cubes();
  MotionExportOptions options;
  options.formats = {MotionFormat::vtu, MotionFormat::csv};
  options.times = 1;
  core::TaskContext task;
  EXPECT_ANY_THROW(
      export_motion(folder, motion::MovingCage(lifting_cage()), wall(mesh), &mesh, options, task));
  EXPECT_GT(task.progress(), 0.5);
  EXPECT_LT(task.progress(), 1.0);
}

TEST(MotionExport, RefusesWhatItCannotWrite) {
  const fs::path folder = temporary_folder("export");
  const MixedMesh mesh = cubes();
  const motion::MovingCage cage(lifting_cage());
  MotionExportOptions options;
  options.formats = {MotionFormat::vtu};
  EXPECT_THROW(export_motion(folder, cage, wall(mesh), nullptr, options), InvalidInput);
  options.formats = {MotionFormat::vtp};
  options.times = 0;
  EXPECT_THROW(export_motion(folder, cage, wall(mesh), nullptr, options), InvalidInput);
  options.times = 4;
  options.rr_seconds = 0.0;
  EXPECT_THROW(export_motion(folder, cage, wall(mesh), nullptr, options), InvalidInput);
  options.rr_seconds = 0.8;
  TriMesh far = wall(mesh);
  for (Vec3& p : far.points) p.x() += 100.0;
  EXPECT_THROW(export_motion(folder, cage, far, nullptr, options), InvalidInput);
  for (std::size_t i = 0; i + 1 < far.points.size(); ++i) far.points[i].x() -= 100.0;
  EXPECT_THAT(export_motion(folder, cage, far, nullptr, options).warnings,
              ::testing::ElementsAre(HasSubstr("the surface: 3.7 % of its points lie outside")));
  EXPECT_THROW(motion_format("avi"), InvalidInput);
  for (const MotionFormat format : {MotionFormat::vtp, MotionFormat::openfoam})
    EXPECT_EQ(motion_format(name_of(format)), format);
  core::TaskContext task;
  task.cancel();
  EXPECT_THROW(export_motion(folder, cage, wall(mesh), nullptr, options, task), Cancelled);
}

}  // namespace
}  // namespace ostia::pipeline
