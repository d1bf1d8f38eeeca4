// `ostia mesh` for solvers: layers, second order, formats, the gate.

#include "mesh_refusals.h"
#include "program.h"

#include "ostia/core/files.h"
#include "ostia/geometry/analytic_shapes.h"
#include "ostia/io/surface_file.h"
#include "ostia/io/volume_mesh_file.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <numbers>

namespace ostia::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsSupersetOf;
using ::testing::Not;
using Json = nlohmann::json;

constexpr double radius_mm = 2.0, length_mm = 12.0;

/// A folder with a tube along z, open at both ends.
fs::path folder_with_tube() {
  const fs::path folder = temporary_folder("mesh");
  io::write_surface(folder / "tube.ply",
                    geometry::surface_of(geometry::straight_tube(length_mm, radius_mm), 0.4, true));
  return folder;
}

Json manifest(const fs::path& folder) {
  return Json::parse(core::read_file(folder / "manifest.json"));
}

std::size_t wall_triangles(const geometry::MixedMesh& mesh) {
  return static_cast<std::size_t>(std::ranges::count(mesh.triangle_face_ids, 1));
}

Json done_json(const std::vector<std::string>& command, const fs::path& folder) {
  const Outcome done = ostia(command, {folder, ""});
  EXPECT_EQ(done.code, 0) << done.err;
  return done.code == 0 ? Json::parse(done.out) : Json();
}

TEST(MeshCommand, LayersAndFormatsAreThereAndListed) {
  const fs::path folder = folder_with_tube();
  const std::vector<std::string> command{"mesh",     "--layers", "2",   "--export", "openfoam,gmsh4",
                                         "tube.ply", "-o",       "out", "--json"};
  const Json quality = done_json(command, folder);
  const geometry::MixedMesh mesh = io::read_volume_mesh(folder / "out" / "mesh.vtu");
  const std::size_t wall = wall_triangles(mesh);
  ASSERT_GT(wall, 100U);
  EXPECT_EQ(mesh.prisms.size(), 2 * wall);
  EXPECT_EQ(quality["volume"]["prisms"], mesh.prisms.size());
  EXPECT_EQ(quality["volume"]["tetrahedra"], mesh.tetrahedra.size());
  EXPECT_EQ(quality, Json::parse(core::read_file(folder / "out" / "quality.json")));
  const Json made = manifest(folder / "out");
  EXPECT_EQ(made["parameters"]["layers"]["count"], 2);
  EXPECT_EQ(made["parameters"]["layers"]["thickness"], 0.25);
  EXPECT_EQ(made["parameters"]["layers"]["growth"], 1.2);
  EXPECT_EQ(made["parameters"]["export"], Json({"openfoam", "gmsh4"}));
  const std::vector<std::string> files{"mesh.vtu",
                                       "mesh-gmsh4.msh",
                                       "openfoam/constant/polyMesh/boundary",
                                       "openfoam/constant/polyMesh/faces",
                                       "openfoam/constant/polyMesh/neighbour",
                                       "openfoam/constant/polyMesh/owner",
                                       "openfoam/constant/polyMesh/points"};
  for (const std::string& file : files) {
    EXPECT_TRUE(fs::exists(folder / "out" / file)) << file;
    EXPECT_TRUE(made["outputs"].contains(file)) << file;
  }
}

TEST(MeshCommand, AnotherLayerIsAnotherJob) {
  const fs::path folder = folder_with_tube();
  // Whether it was made anew.
  const auto run = [&](const std::vector<std::string>& more) {
    const Outcome done =
        ostia(std::vector<std::string>{"mesh", "tube.ply", "-o", "out"} + more, {folder, ""});
    EXPECT_EQ(done.code, 0) << done.err;
    return done.err.find("nothing to do") == std::string::npos;
  };
  EXPECT_TRUE(run({"--layers", "2"}));
  EXPECT_FALSE(run({"--layers", "2"}));
  EXPECT_FALSE(run({"--layers", "2", "--layer-thickness", "0.25"})) << "the default";
  EXPECT_TRUE(run({"--layers", "2", "--layer-thickness", "0.3"}));
  EXPECT_TRUE(run({"--layers", "2", "--layer-thickness", "0.3", "--split-prisms"}));
  EXPECT_TRUE(run({"--layers", "2", "--layer-thickness", "0.3", "--export", "stl"}));
  EXPECT_TRUE(run({}));
  EXPECT_FALSE(fs::exists(folder / "out" / "stl")) << "the folder is made anew";
}

TEST(MeshCommand, EdgesAreShorterAtAStenosisWhereThatIsAskedFor) {
  const fs::path folder = temporary_folder("mesh");
  io::write_surface(
      folder / "tube.ply",
      geometry::surface_of(geometry::stenosed_tube(40.0, radius_mm, 0.5, 20.0, 8.0), 0.4, true));
  const auto triangles_near = [&](const std::string& out, const std::vector<std::string>& more, double z) {
    std::vector<std::string> command{"mesh", "tube.ply", "-o", out, "--edge-ratio", "0.5", "--json"};
    command.insert(command.end(), more.begin(), more.end());
    done_json(command, folder);
    const geometry::MixedMesh mesh = io::read_volume_mesh(folder / out / "mesh.vtu");
    return std::ranges::count_if(mesh.triangles, [&](const auto& t) {
      return std::abs(mesh.points[static_cast<std::size_t>(t[0])].z() - z) < 2.0;
    });
  };
  const auto plain = triangles_near("plain", {}, 20.0);
  EXPECT_GT(triangles_near("fine", {"--stenosis-edges", "0.5"}, 20.0), 2 * plain);
  EXPECT_EQ(manifest(folder / "fine")["parameters"]["sizing"]["throat_share"], 0.5);
}

TEST(MeshCommand, QualityTellsTheEndsByName) {
  const fs::path folder = folder_with_tube();
  const Json quality = done_json({"mesh", "tube.ply", "-o", "out", "--layers", "3", "--layer-thickness",
                                  "0.5", "--edge-ratio", "0.25", "--json"},
                                 folder);
  const Json& volume = quality["volume"];
  EXPECT_EQ(volume["inverted"], 0);
  EXPECT_EQ(volume["boundary_mismatches"], 0);
  EXPECT_GT(volume["min_scaled_jacobian"].get<double>(), 0.02);
  EXPECT_GT(volume["of_prisms"]["min_scaled_jacobian"].get<double>(), 0.1);
  EXPECT_LT(volume["openfoam"]["max_non_orthogonality_deg"].get<double>(), 70.0);
  EXPECT_LT(volume["openfoam"]["max_skewness"].get<double>(), 4.0);
  const double circle = std::numbers::pi * radius_mm * radius_mm;
  ASSERT_EQ(volume["faces"].size(), 3U);
  EXPECT_EQ(volume["faces"][0]["name"], "wall");
  for (const std::size_t cap : {1U, 2U}) {
    const Json& face = volume["faces"][cap];
    EXPECT_EQ(face["kind"], cap == 1 ? "inlet" : "outlet");
    EXPECT_NEAR(face["area_mm2"].get<double>(), circle, 0.02 * circle) << face["name"];
    EXPECT_NEAR(std::abs(face["mean_normal"][2].get<double>()), 1.0, 1e-6);
  }
  EXPECT_NEAR(volume["volume_mm3"].get<double>(), circle * length_mm, 0.02 * circle * length_mm);
  EXPECT_LT(quality["wall_deviation"]["p95_mm"].get<double>(), 0.02 * radius_mm);
  EXPECT_NEAR(quality["layers"]["full_share"].get<double>(), 1.0, 1e-9);
  EXPECT_TRUE(quality["layers"]["thin_places"].empty());
  EXPECT_TRUE(quality["verdict"]["passed"].get<bool>());
}

TEST(MeshCommand, CheckReadsPrisms) {
  const fs::path folder = folder_with_tube();
  const Json made =
      done_json({"mesh", "tube.ply", "-o", "out", "--layers", "2", "--export", "gmsh4", "--json"}, folder);
  const Json checked = done_json({"mesh", "--check", "out/mesh.vtu", "--json"}, folder);
  EXPECT_EQ(checked["volume"], made["volume"]);
  EXPECT_TRUE(checked["verdict"]["passed"].get<bool>());
  EXPECT_EQ(done_json({"mesh", "--check", "out/mesh-gmsh4.msh", "--json"}, folder)["volume"]["of_prisms"],
            made["volume"]["of_prisms"]);
  const Outcome other = ostia({"mesh", "--check", "out/manifest.json"}, {folder, ""});
  EXPECT_EQ(other.code, 3);
  EXPECT_THAT(other.err, HasSubstr(".vtu"));
  EXPECT_THAT(other.err, HasSubstr(".msh"));
}

TEST(MeshCommand, WhatDoesNotGoTogetherIsRefusedBeforeAnythingIsRead) {
  expect_mesh_and_model_refuse({"--layers", "2", "--export", "gmsh4,mesh-complete"}, 3, "--split-prisms");
  expect_mesh_and_model_refuse({"--order", "2", "--export", "openfoam"}, 3, "--order 1");
  expect_mesh_and_model_refuse({"--layers", "2", "--order", "2", "--export", "abaqus"}, 3, "18-node prisms");
  expect_mesh_and_model_refuse({"--export", "step"}, 2, "mesh-complete");
  expect_mesh_and_model_refuse({"--layers", "21"}, 2, "layers");
  expect_mesh_and_model_refuse({"--layers", "2", "--layer-thickness", "4"}, 2, "layer-thickness");
  expect_mesh_and_model_refuse({"--layers", "2", "--layer-growth", "0.5"}, 2, "layer-growth");
  expect_mesh_and_model_refuse({"--layer-thickness", "0.5"}, 2, "--layers");
  expect_mesh_and_model_refuse({"--split-prisms"}, 2, "--layers");
  expect_mesh_and_model_refuse({"--order", "3"}, 2, "order");
  expect_mesh_and_model_refuse({"--min-edge", "0.3", "--max-edge", "0.2"}, 3, "max_edge_mm");
}

TEST(MeshCommand, LayersThickerThanTheVesselAreThinnedAndTold) {
  const fs::path folder = folder_with_tube();
  const Outcome done = ostia({"mesh", "tube.ply", "-o", "out", "--layers", "3", "--layer-thickness", "3",
                              "--edge-ratio", "0.6", "--json"},
                             {folder, ""});
  ASSERT_TRUE(done.code == 0 || done.code == 4) << done.err;
  EXPECT_THAT(done.err, HasSubstr("thinner than asked"));
  const Json quality = Json::parse(done.out);
  EXPECT_EQ(quality["volume"]["inverted"], 0);
  EXPECT_LT(quality["layers"]["full_share"].get<double>(), 0.5);
  ASSERT_FALSE(quality["layers"]["thin_places"].empty());
  EXPECT_LT(quality["layers"]["thin_places"][0]["thickness_mm"].get<double>(),
            quality["layers"]["thin_places"][0]["wanted_mm"].get<double>());
}

TEST(MeshCommand, SplitPrismsGoWhereOnlyTetrahedraDo) {
  const fs::path folder = folder_with_tube();
  const Outcome done = ostia({"mesh", "tube.ply", "-o", "out", "--layers", "2", "--layer-thickness", "0.6",
                              "--split-prisms", "--export", "mesh-complete"},
                             {folder, ""});
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_TRUE(fs::exists(folder / "out" / "mesh-complete" / "mesh-complete.mesh.vtu"));
  EXPECT_TRUE(io::read_volume_mesh(folder / "out" / "mesh.vtu").prisms.empty());
}

TEST(MeshCommand, SecondOrderNodesLieOnTheWall) {
  const fs::path folder = folder_with_tube();
  const Json quality = done_json({"mesh", "tube.ply", "-o", "out", "--layers", "2", "--order", "2",
                                  "--export", "gmsh4,exodus", "--json"},
                                 folder);
  EXPECT_EQ(quality["volume"]["order"], 2);
  EXPECT_EQ(quality["volume"]["inverted"], 0);
  EXPECT_GT(quality["volume"]["of_prisms"]["min_jacobian_ratio"].get<double>(), 0.1);
  // 16 straight chords hold 2.6 % less than the circle; parabolas through its points hold it, and what is
  // left is the surface's own.
  const double tube = std::numbers::pi * radius_mm * radius_mm * length_mm;
  EXPECT_NEAR(quality["volume"]["volume_mm3"].get<double>(), tube, 0.01 * tube);
  EXPECT_LT(quality["quadratic"]["straight_volume_mm3"].get<double>(), 0.98 * tube);
  EXPECT_THAT(names_in(folder / "out"), IsSupersetOf({"mesh-gmsh4.msh", "mesh.exo"}));
  EXPECT_EQ(done_json({"mesh", "--check", "out/mesh.vtu", "--json"}, folder)["volume"], quality["volume"]);
}

TEST(MeshCommand, FlowExtensionsLengthenTheMeshByTheirDiameters) {
  const fs::path folder = folder_with_tube();
  const Json quality = done_json({"mesh", "tube.ply", "-o", "out", "--flow-extensions", "3", "--layers", "2",
                                  "--edge-ratio", "0.3", "--json"},
                                 folder);
  ASSERT_EQ(quality["extensions"].size(), 2U);
  for (const Json& extension : quality["extensions"]) {
    EXPECT_NEAR(extension["length_mm"].get<double>(), 6.0 * radius_mm, 0.1);
    EXPECT_NEAR(extension["end_area_mm2"].get<double>(), extension["section_area_mm2"].get<double>(),
                1e-3 * extension["section_area_mm2"].get<double>());
  }
  const double circle = std::numbers::pi * radius_mm * radius_mm, whole = length_mm + 12.0 * radius_mm;
  EXPECT_NEAR(quality["volume"]["volume_mm3"].get<double>(), circle * whole, 0.03 * circle * whole);
  EXPECT_EQ(quality["volume"]["inverted"], 0);
  EXPECT_EQ(manifest(folder / "out")["parameters"]["extensions"]["inlet_diameters"], 3.0);
  EXPECT_EQ(ostia({"mesh", "tube.ply", "-o", "other", "--flow-extensions", "0.1"}, {folder, ""}).code, 2);
}

TEST(MeshCommand, ACaseGetsLayersToo) {
  const fs::path folder = temporary_folder("case");
  std::string rows = "x,y,z,radius\n";
  for (int i = 0; i <= 24; ++i) rows += "0,0," + std::to_string(0.5 * i) + ",1.5\n";
  core::write_file(folder / "tube.csv", rows);
  done_json({"lumen", "tube.csv", "-o", "tube.stl", "--case", "tube.ostia", "--json"}, folder);
  const std::vector<std::string> command{"mesh",  "tube.ostia",     "-o",  "out",      "--layers",
                                         "2",     "--layer-growth", "1.5", "--export", "openfoam",
                                         "--json"};
  const Json quality = done_json(command, folder);
  const geometry::MixedMesh mesh = io::read_volume_mesh(folder / "out" / "mesh.vtu");
  EXPECT_EQ(mesh.prisms.size(), 2 * wall_triangles(mesh));
  EXPECT_EQ(quality["volume"]["prisms"], mesh.prisms.size());
  EXPECT_TRUE(manifest(folder / "out")["outputs"].contains("openfoam/constant/polyMesh/faces"));
  EXPECT_EQ(manifest(folder / "out")["parameters"]["layers"]["growth"], 1.5);
  const auto written = fs::last_write_time(folder / "out" / "mesh.vtu");
  EXPECT_EQ(done_json(command, folder), quality);
  EXPECT_EQ(fs::last_write_time(folder / "out" / "mesh.vtu"), written) << "done already";
  const Outcome refused = ostia(
      {"mesh", "tube.ostia", "-o", "other", "--layers", "2", "--export", "mesh-complete"}, {folder, ""});
  EXPECT_EQ(refused.code, 3) << refused.err;
  EXPECT_FALSE(fs::exists(folder / "other"));
}

}  // namespace
}  // namespace ostia::testing
