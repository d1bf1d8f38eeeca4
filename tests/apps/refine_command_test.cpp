// `ostia mesh --refine-from`: lengths from a result.

#include "program.h"

#include "ostia/core/files.h"
#include "ostia/geometry/analytic_shapes.h"
#include "ostia/io/surface_file.h"
#include "ostia/io/volume_fields.h"
#include "ostia/io/volume_mesh_file.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace ostia::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;
using geometry::Vec3;

/// A jet that begins in the middle of the tube.
Vec3 velocity_at(const Vec3& p) {
  const double along = 1.0 / (1.0 + std::exp(-4.0 * (p.z() - 6.0)));
  return {0.0, 0.0, along * (1.0 - std::tanh((std::hypot(p.x(), p.y()) - 0.9) / 0.25))};
}

/// A made-up flow in a folder's mesh.
void write_result(const fs::path& mesh_file, const fs::path& result) {
  const geometry::MixedMesh mesh = io::read_volume_mesh(mesh_file);
  io::VolumeFields fields;
  auto& velocity = fields.points["velocity_m_s"];
  velocity.components = 3;
  for (const Vec3& p : mesh.points) {
    const Vec3 v = velocity_at(p);
    velocity.values.insert(velocity.values.end(), {v.x(), v.y(), v.z()});
  }
  io::write_vtu_with_fields(result, mesh, fields);
}

/// A folder with a tube, its mesh, and a flow in it.
fs::path folder_with_result() {
  const fs::path folder = temporary_folder("refine");
  io::write_surface(folder / "tube.ply", geometry::surface_of(geometry::straight_tube(12.0, 2.0), 0.4, true));
  const Outcome done = ostia({"mesh", "tube.ply", "-o", "coarse", "--layers", "2"}, {folder, ""});
  EXPECT_EQ(done.code, 0) << done.err;
  write_result(folder / "coarse" / "mesh.vtu", folder / "result.vtu");
  return folder;
}

double mean_volume(const geometry::MixedMesh& mesh, double from_z, double to_z) {
  double sum = 0.0, count = 0.0;
  for (const geometry::Tetrahedron& t : mesh.tetrahedra) {
    const auto at = [&](std::size_t i) { return mesh.points[static_cast<std::size_t>(t[i])]; };
    const double z = 0.25 * (at(0) + at(1) + at(2) + at(3)).z();
    if (z < from_z || z > to_z) continue;
    sum += (at(1) - at(0)).cross(at(2) - at(0)).dot(at(3) - at(0)) / 6.0;
    count += 1.0;
  }
  return sum / count;
}

TEST(RefineCommand, MeshesFinerWhereTheFieldBendsAndSaysSo) {
  const fs::path folder = folder_with_result();
  const std::vector<std::string> command{
      "mesh",          "tube.ply",   "-o",   "fine",         "--layers",          "2",
      "--refine-from", "result.vtu", "--by", "velocity_m_s", "--refine-elements", "12000",
      "--json"};
  const Outcome done = ostia(command, {folder, ""});
  ASSERT_EQ(done.code, 0) << done.err;
  const Json quality = Json::parse(done.out), refinement = quality["refinement"];
  EXPECT_EQ(refinement["field"], "velocity_m_s");
  EXPECT_EQ(refinement["at"], "points");
  EXPECT_EQ(refinement["asked"]["elements"], 12000.0);
  const double got = refinement["elements"];
  EXPECT_EQ(got, static_cast<double>(quality["volume"]["tetrahedra"]) +
                     static_cast<double>(quality["volume"]["prisms"]));
  EXPECT_NEAR(got, 12000.0, 0.2 * 12000.0);
  EXPECT_GT(quality["volume"]["prisms"], 0);
  const auto coarse = io::read_volume_mesh(folder / "coarse" / "mesh.vtu"),
             fine = io::read_volume_mesh(folder / "fine" / "mesh.vtu");
  EXPECT_LT(mean_volume(fine, 7.0, 11.0), 0.5 * mean_volume(coarse, 7.0, 11.0));
  EXPECT_NEAR(mean_volume(fine, 0.0, 3.5), mean_volume(coarse, 0.0, 3.5),
              0.35 * mean_volume(coarse, 0.0, 3.5));
  EXPECT_THAT(ostia(command, {folder, ""}).err, HasSubstr("nothing to do"));
  std::vector<std::string> other = command;
  other[11] = "9000";
  EXPECT_THAT(ostia(other, {folder, ""}).err, Not(HasSubstr("nothing to do")));
}

TEST(RefineCommand, ACaseIsRefinedLikeASurfaceAndAnothersResultIsRefused) {
  const fs::path folder = temporary_folder("refine");
  std::string axis = "x,y,z,radius\n";
  for (int i = 0; i <= 24; ++i) axis += "0,0," + std::to_string(0.5 * i) + ",2\n";
  core::write_file(folder / "tube.csv", axis);
  const std::vector<std::vector<std::string>> before{
      {"lumen", "tube.csv", "-o", "tube.stl", "--case", "tube.ostia"},
      {"mesh", "tube.ostia", "-o", "coarse"}};
  for (const auto& command : before) ASSERT_EQ(ostia(command, {folder, ""}).code, 0);
  write_result(folder / "coarse" / "mesh.vtu", folder / "result.vtu");
  const std::vector<std::string> refine{"mesh", "tube.ostia", "--refine-from", "result.vtu", "--by"};
  const Outcome done = ostia(
      refine + std::vector<std::string>{"velocity_m_s", "--refine-error", "0.02", "-o", "fine", "--json"},
      {folder, ""});
  ASSERT_EQ(done.code, 0) << done.err;
  const Json refinement = Json::parse(done.out)["refinement"];
  EXPECT_EQ(refinement["asked"]["error_share"], 0.02);
  EXPECT_GT(refinement["refined_share"], 0.05);
  EXPECT_GT(refinement["elements"], 1.3 * static_cast<double>(refinement["elements_before"]));
  const Outcome missing = ostia(refine + std::vector<std::string>{"speed", "-o", "none"}, {folder, ""});
  EXPECT_EQ(missing.code, 3);
  EXPECT_THAT(missing.err, HasSubstr("has no field speed"));
  geometry::TriMesh moved = geometry::surface_of(geometry::straight_tube(12.0, 2.0), 0.4, true);
  for (Vec3& p : moved.points) p.x() += 100.0;
  io::write_surface(folder / "far.ply", moved);
  const Outcome far = ostia(
      {"mesh", "far.ply", "-o", "none", "--refine-from", "result.vtu", "--by", "velocity_m_s"}, {folder, ""});
  EXPECT_EQ(far.code, 3);
  EXPECT_THAT(far.err, HasSubstr("of another vessel"));
  EXPECT_FALSE(fs::exists(folder / "none"));
}

TEST(RefineCommand, OptionsThatNeedOthersAreNamed) {
  const fs::path folder = temporary_folder("refine");
  const auto said = [&](const std::vector<std::string>& more) {
    const Outcome done =
        ostia(std::vector<std::string>{"mesh", "tube.ply", "-o", "out"} + more, {folder, ""});
    EXPECT_EQ(done.code, 2) << done.err;
    return done.err;
  };
  EXPECT_THAT(said({"--by", "p"}), HasSubstr("need --refine-from"));
  EXPECT_THAT(said({"--refine-from", "result.vtu"}), HasSubstr("needs --by FIELD"));
  EXPECT_THAT(
      said({"--refine-from", "r.vtu", "--by", "p", "--refine-error", "0.1", "--refine-elements", "1000"}),
      HasSubstr("give one"));
}

}  // namespace
}  // namespace ostia::testing
