// `ostia mesh` with what goes beside the mesh: a solver's case, placed planes, an array of sizes, a forecast,
// other programs' files to check.

#include "mesh_refusals.h"
#include "program.h"

#include "ostia/core/files.h"
#include "ostia/geometry/analytic_shapes.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/io/surface_fields.h"
#include "ostia/io/surface_file.h"
#include "ostia/io/volume_mesh_file.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <numbers>

namespace ostia::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;

constexpr double mesh_places_radius_mm = 2.0, mesh_places_length_mm = 12.0;

fs::path folder_with_narrowed_tube(double unit = 1.0) {
  const fs::path folder = temporary_folder("mesh");
  geometry::TriMesh tube =
      geometry::surface_of(geometry::straight_tube(mesh_places_length_mm, mesh_places_radius_mm), 0.4, true);
  for (geometry::Vec3& p : tube.points) p *= unit;
  io::write_surface(folder / "tube.ply", tube);
  return folder;
}

Json mesh_places_manifest(const fs::path& folder) {
  return Json::parse(core::read_file(folder / "manifest.json"));
}

std::pair<double, double> z_range(const geometry::MixedMesh& mesh) {
  const auto [low, high] =
      std::ranges::minmax(mesh.points, {}, [](const geometry::Vec3& p) { return p.z(); });
  return {low.z(), high.z()};
}

TEST(MeshWithCase, OpenfoamsCaseStandsInTheFolder) {
  const fs::path folder = folder_with_narrowed_tube();
  const std::vector<std::string> command{
      "mesh",   "tube.ply", "-o",        "out",        "--layers", "2", "--with-case", "openfoam",
      "--flow", "0.7",      "--outlets", "resistance", "--cycles", "2", "--waveform",  "coronary-left"};
  const Outcome done = ostia(command, {folder, ""});
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_THAT(done.err, HasSubstr("out/openfoam-case/Allrun"));
  const fs::path made = folder / "out" / "openfoam-case";
  EXPECT_THAT(core::read_file(made / "system/controlDict"), HasSubstr("pimpleFoam"));
  EXPECT_TRUE(fs::exists(made / "Allrun"));
  // The mesh of the case is the mesh.
  const geometry::MixedMesh mesh = io::read_volume_mesh(folder / "out" / "mesh.vtu"),
                            of_case = io::read_volume_mesh(made);
  EXPECT_EQ(of_case.tetrahedra.size(), mesh.tetrahedra.size());
  EXPECT_EQ(of_case.prisms.size(), mesh.prisms.size());
  const Json record = mesh_places_manifest(folder / "out");
  EXPECT_EQ(record["parameters"]["solver_case"]["solver"], "openfoam");
  EXPECT_EQ(record["parameters"]["solver_case"]["flow"]["flow_ml_s"], 0.7);
  EXPECT_TRUE(record["outputs"].contains("openfoam-case/0/U"));
  EXPECT_THAT(ostia(command, {folder, ""}).err, HasSubstr("nothing to do"));
  const Outcome other =
      ostia({"mesh", "tube.ply", "-o", "out", "--layers", "2", "--with-case", "openfoam"}, {folder, ""});
  EXPECT_THAT(other.err, Not(HasSubstr("nothing to do"))) << "another case is another job";
  EXPECT_THAT(core::read_file(made / "system/controlDict"), HasSubstr("simpleFoam"));
}

TEST(MeshWithCase, SvmultiphysicsTakesSplitLayers) {
  const fs::path folder = folder_with_narrowed_tube();
  const Outcome done = ostia({"mesh", "tube.ply", "-o", "out", "--layers", "2", "--layer-thickness", "0.5",
                              "--split-prisms", "--with-case", "svmultiphysics", "--outlets", "resistance"},
                             {folder, ""});
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_TRUE(fs::exists(folder / "out/svmultiphysics-case/solver.xml"));
  EXPECT_TRUE(fs::exists(folder / "out/svmultiphysics-case/boundary_conditions.json"));
}

TEST(MeshWithCase, WhatASolverDoesNotTakeIsRefusedBeforeAnythingIsRead) {
  expect_mesh_and_model_refuse({"--with-case", "openfoam", "--order", "2"}, 3, "--order 1");
  expect_mesh_and_model_refuse({"--with-case", "svmultiphysics", "--layers", "2"}, 3, "--split-prisms");
  expect_mesh_and_model_refuse({"--with-case", "svmultiphysics", "--outlets", "split"}, 3, "resistances");
  expect_mesh_and_model_refuse({"--with-case", "openfoam", "--flow", "-1"}, 3, "flow_ml_s");
  expect_mesh_and_model_refuse({"--with-case", "openfoam", "--viscosity", "0.0035"}, 3, "viscosity_mpa_s");
  expect_mesh_and_model_refuse({"--with-case", "openfoam", "--compliance", "1"}, 3, "Windkessel");
  expect_mesh_and_model_refuse({"--with-case", "openfoam", "--waveform", "aorta"}, 3, "coronary-left");
  expect_mesh_and_model_refuse({"--with-case", "fluent"}, 2, "openfoam");
  expect_mesh_and_model_refuse({"--flow", "1"}, 2, "--with-case");
}

TEST(MeshWithCase, AFlowThroughAnInletThatIsNotThereIsToldBeforeMeshing) {
  const fs::path folder = folder_with_narrowed_tube();
  const Outcome done = ostia({"mesh", "tube.ply", "-o", "out", "--with-case", "openfoam", "--flow",
                              "inlet_moon=1", "--progress", "plain"},
                             {folder, ""});
  EXPECT_EQ(done.code, 3);
  EXPECT_THAT(done.err, HasSubstr("no inlet \"inlet_moon\""));
  EXPECT_THAT(done.err, HasSubstr("the ends are inlet_"));
  EXPECT_THAT(done.err, Not(HasSubstr("tetrahedra")));
  EXPECT_FALSE(fs::exists(folder / "out"));
}

TEST(MeshPlanes, AnEndIsCutWhereAPersonWantsIt) {
  const fs::path folder = folder_with_narrowed_tube();
  // The tube runs from z = 0 to 12; the nearest end of each plane is the one that is meant.
  const Outcome done = ostia(
      {"mesh", "tube.ply", "-o", "out", "--plane", "0,0,3:0,0,1", "--plane", "0.1,0,9:0,0.2,-1", "--json"},
      {folder, ""});
  ASSERT_EQ(done.code, 0) << done.err;
  const Json faces = Json::parse(done.out)["volume"]["faces"];
  const double circle = std::numbers::pi * mesh_places_radius_mm * mesh_places_radius_mm;
  for (const std::size_t cap : {1U, 2U}) {
    const bool straight = std::abs(faces[cap]["centre"][2].get<double>() - 3.0) < 0.1;
    const double cosine = straight ? 1.0 : 1.0 / std::hypot(0.2, 1.0);
    EXPECT_NEAR(std::abs(faces[cap]["mean_normal"][2].get<double>()), cosine, 1e-6);
    EXPECT_NEAR(faces[cap]["area_mm2"].get<double>(), circle / cosine, 0.04 * circle);  // 16 chords
    EXPECT_NEAR(faces[cap]["centre"][2].get<double>(), straight ? 3.0 : 9.0, 0.1);
  }
  EXPECT_EQ(mesh_places_manifest(folder / "out")["parameters"]["clip"]["planes"].size(), 2U);
}

TEST(MeshPlanes, ATableNamesTheEnds) {
  const fs::path folder = folder_with_narrowed_tube();
  const Outcome plain = ostia({"mesh", "tube.ply", "-o", "plain", "--json"}, {folder, ""});
  const std::string outlet = Json::parse(plain.out)["volume"]["faces"][2]["name"];
  const double at = Json::parse(plain.out)["volume"]["faces"][2]["centre"][2];
  const double wanted = at > 6.0 ? 8.0 : 4.0;
  core::write_file(folder / "planes.csv",
                   "end,x,y,z,nx,ny,nz\n" + outlet + ",0,0," + std::to_string(wanted) + ",0,0,1\n");
  const Outcome cut =
      ostia({"mesh", "tube.ply", "-o", "out", "--planes", "planes.csv", "--inset", "0.5"}, {folder, ""});
  ASSERT_EQ(cut.code, 0) << cut.err;
  EXPECT_THAT(cut.err, HasSubstr("does nothing at 1 of 2 ends"));
  EXPECT_THAT(mesh_places_manifest(folder / "out")["warnings"].dump(), HasSubstr("--inset"));
  const auto [low, high] = z_range(io::read_volume_mesh(folder / "out" / "mesh.vtu"));
  EXPECT_NEAR(at > 6.0 ? high : low, wanted, 0.01);
  EXPECT_NEAR(at > 6.0 ? low : high, at > 6.0 ? 0.0 : mesh_places_length_mm, 0.05)
      << "the other end is left alone";
}

TEST(MeshPlanes, AnEndThatCannotBeCutIsShownAndTheCureWorksAsPrinted) {
  const auto folder = temporary_folder("half_pipe");
  const geometry::TriMesh whole = geometry::surface_of(geometry::straight_tube(40.0, 1.5), 0.3, true);
  std::vector<bool> keep;
  for (const auto& t : whole.triangles) {
    geometry::Vec3 c = geometry::Vec3::Zero();
    for (const std::int32_t v : t) c += whole.points[static_cast<std::size_t>(v)] / 3.0;
    keep.push_back(c.z() > 8.0 || c.x() < 0.3);
  }
  io::write_surface(folder / "pipe.ply", geometry::subset(whole, keep));
  const std::vector<std::string> command{"mesh", "pipe.ply", "-o", "out", "--keep", "kept"};
  const Outcome refused = ostia(command, {folder, ""});
  ASSERT_EQ(refused.code, 3) << refused.err;
  EXPECT_GT(std::filesystem::file_size(folder / "kept" / "ends.png"), 10000U);
  EXPECT_NE(refused.err.find("ends.png"), std::string::npos);
  const std::size_t at = refused.err.find("--plane ");
  ASSERT_NE(at, std::string::npos) << refused.err;
  const std::string plane = refused.err.substr(at + 8, refused.err.find_first_of(" ;\n", at + 8) - (at + 8));
  const Outcome cured = ostia({"mesh", "pipe.ply", "-o", "out", "--plane", plane}, {folder, ""});
  EXPECT_EQ(cured.code, 0) << plane << "\n" << cured.err;
}

TEST(MeshPlanes, ACaseOfTheWindowTakesPlanesAndASolversCaseToo) {
  const fs::path folder = temporary_folder("case");
  std::string rows = "x,y,z,radius\n";
  for (int i = 0; i <= 24; ++i) rows += "0,0," + std::to_string(0.5 * i) + ",1.5\n";
  core::write_file(folder / "tube.csv", rows);
  ASSERT_EQ(ostia({"lumen", "tube.csv", "-o", "tube.stl", "--case", "tube.ostia"}, {folder, ""}).code, 0);
  const Outcome done = ostia({"mesh", "tube.ostia", "-o", "out", "--plane", "0,0,9:0,0,1", "--with-case",
                              "openfoam", "--outlets", "split"},
                             {folder, ""});
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_THAT(done.err, HasSubstr("out/openfoam-case/Allrun"));
  const auto [low, high] = z_range(io::read_volume_mesh(folder / "out" / "mesh.vtu"));
  EXPECT_NEAR(high, 9.0, 0.01);  // it keeps clear of points
  EXPECT_LT(low, 1.5);
  EXPECT_TRUE(mesh_places_manifest(folder / "out")["outputs"].contains("openfoam-case/system/controlDict"));
  const Outcome refused =
      ostia({"mesh", "tube.ostia", "-o", "other", "--plane", "outlet_moon=0,0,9:0,0,1"}, {folder, ""});
  EXPECT_EQ(refused.code, 3);
  EXPECT_THAT(refused.err, HasSubstr("the ends are inlet_"));
  EXPECT_FALSE(fs::exists(folder / "other"));
}

TEST(MeshPlanes, WhatIsNoPlaneIsRefused) {
  const fs::path folder = folder_with_narrowed_tube();
  const auto refused = [&](const std::vector<std::string>& more, const std::string& part) {
    const Outcome done =
        ostia(std::vector<std::string>{"mesh", "tube.ply", "-o", "out"} + more, {folder, ""});
    EXPECT_EQ(done.code, 3) << part;
    EXPECT_THAT(done.err, HasSubstr(part));
  };
  refused({"--plane", "0,0,3"}, "[END=]x,y,z:nx,ny,nz");
  refused({"--plane", "0,0,3:0,0,0"}, "no direction");
  refused({"--plane", "outlet_moon=0,0,3:0,0,1"}, "the ends are inlet_");
  refused({"--plane", "0,0,3:0,0,1", "--plane", "0,0,4:0,0,1"}, "two planes");
  core::write_file(folder / "planes.csv", "end,x,y,z,nx,ny\n,0,0,3,0,0\n");
  refused({"--planes", "planes.csv"}, "no column nz");
  core::write_file(folder / "planes.csv", "end,x,y,z,nx,ny,nz\n,0,zero,3,0,0,1\n");
  refused({"--planes", "planes.csv"}, "line 2");
}

TEST(MeshPlanes, RoundEndsAreCirclesOfTheSectionsArea) {
  const fs::path folder = temporary_folder("mesh");
  geometry::TriMesh tube =
      geometry::surface_of(geometry::straight_tube(mesh_places_length_mm, mesh_places_radius_mm), 0.4, true);
  for (geometry::Vec3& p : tube.points) p.x() *= 1.5;  // an ellipse of 3 x 2 mm
  io::write_surface(folder / "tube.ply", tube);
  const auto spread = [&](const std::string& out, const std::vector<std::string>& more) {
    const Outcome done =
        ostia(std::vector<std::string>{"mesh", "tube.ply", "-o", out, "--json"} + more, {folder, ""});
    EXPECT_EQ(done.code, 0) << done.err;
    const geometry::MixedMesh mesh = io::read_volume_mesh(folder / out / "mesh.vtu");
    const double top = z_range(mesh).second;
    double nearest = 100.0, farthest = 0.0;  // of the rim, from the axis
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      if (mesh.triangle_face_ids[t] != 1) continue;
      for (const std::int32_t v : mesh.triangles[t]) {
        const geometry::Vec3& p = mesh.points[static_cast<std::size_t>(v)];
        if (p.z() < top - 1e-6) continue;
        nearest = std::min(nearest, std::hypot(p.x(), p.y()));
        farthest = std::max(farthest, std::hypot(p.x(), p.y()));
      }
    }
    return farthest / nearest;
  };
  EXPECT_GT(spread("flat", {}), 1.4);
  EXPECT_LT(spread("round", {"--ends", "round"}), 1.02);
}

TEST(MeshSizeArray, LengthsAreTakenFromThePoints) {
  const fs::path folder = temporary_folder("mesh");
  const geometry::TriMesh tube =
      geometry::surface_of(geometry::straight_tube(mesh_places_length_mm, mesh_places_radius_mm), 0.4, true);
  io::FieldValues length;
  for (const geometry::Vec3& p : tube.points) length.values.push_back(0.4 + 0.04 * p.z());
  io::write_vtp_with_fields(folder / "tube.vtp", {tube, {}, {}}, {{"edge_mm", length}});
  const Outcome done =
      ostia({"mesh", "tube.vtp", "-o", "out", "--size-array", "edge_mm", "--json"}, {folder, ""});
  ASSERT_EQ(done.code, 0) << done.err;
  const geometry::MixedMesh mesh = io::read_volume_mesh(folder / "out" / "mesh.vtu");
  double near = 0.0, far = 0.0;
  std::size_t near_count = 0, far_count = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (mesh.triangle_face_ids[t] != 1) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const geometry::Vec3 &a = mesh.points[static_cast<std::size_t>(mesh.triangles[t][k])],
                           &b = mesh.points[static_cast<std::size_t>(mesh.triangles[t][(k + 1) % 3])];
      const double z = 0.5 * (a.z() + b.z());
      if (z < 3.0) near += (a - b).norm(), ++near_count;
      if (z > 9.0) far += (a - b).norm(), ++far_count;
    }
  }
  EXPECT_NEAR(near / static_cast<double>(near_count), 0.46, 0.08);
  EXPECT_NEAR(far / static_cast<double>(far_count), 0.82, 0.12);
  EXPECT_TRUE(mesh_places_manifest(folder / "out")["inputs"].contains("size_array"));
}

TEST(MeshSizeArray, WhatIsNoArrayOfLengthsIsRefused) {
  const fs::path folder = temporary_folder("mesh");
  const geometry::TriMesh tube =
      geometry::surface_of(geometry::straight_tube(mesh_places_length_mm, mesh_places_radius_mm), 0.4, true);
  io::FieldValues good, bad;
  good.values.assign(tube.points.size(), 0.5);
  bad.values = good.values;
  bad.values[7] = 0.0;
  io::write_vtp_with_fields(folder / "tube.vtp", {tube, {}, {}}, {{"edge_mm", good}, {"bad_mm", bad}});
  io::write_surface(folder / "tube.ply", tube);
  const auto refused = [&](const std::string& file, const std::string& name, const std::string& part) {
    for (const std::string command : {"mesh", "model"}) {
      const Outcome done = ostia({command, file, "-o", "out", "--size-array", name}, {folder, ""});
      EXPECT_EQ(done.code, 3) << done.err;
      EXPECT_THAT(done.err, HasSubstr(part));
    }
  };
  refused("tube.vtp", "size", "it has bad_mm, edge_mm");
  refused("tube.vtp", "bad_mm", "at point 7");
  refused("tube.ply", "edge_mm", ".vtp");
}

TEST(MeshForecast, AGoodTubeHasNothingToTell) {
  const fs::path folder = folder_with_narrowed_tube();
  const Outcome words = ostia({"mesh", "tube.ply", "--forecast"}, {folder, ""});
  EXPECT_EQ(words.code, 0) << words.out << words.err;
  EXPECT_THAT(words.out, HasSubstr("nothing found"));
  const Outcome json = ostia({"mesh", "tube.ply", "--forecast", "--json"}, {folder, ""});
  EXPECT_EQ(Json::parse(json.out), Json::parse(R"({"fails": false, "places": []})"));
  EXPECT_EQ(ostia({"mesh", "tube.ply", "-o", "out"}, {folder, ""}).err.find("meshing may fail"),
            std::string::npos);
}

TEST(MeshForecast, AModelIsWarnedAsAMeshIs) {
  const fs::path folder = folder_with_narrowed_tube();
  for (const std::string command : {"mesh", "model"}) {
    const Outcome done = ostia({command, "tube.ply", "-o", command, "--edge-ratio", "0.9"}, {folder, ""});
    EXPECT_EQ(done.code, 0) << command << done.err;
    EXPECT_THAT(done.err, HasSubstr("edges across")) << command;
    EXPECT_THAT(done.err, HasSubstr("--edge-ratio")) << command;
  }
}

TEST(MeshForecast, MetresAreToldWithTheWayOut) {
  const fs::path folder = folder_with_narrowed_tube(1e-3);
  const Outcome words = ostia({"mesh", "tube.ply", "--forecast", "--strict"}, {folder, ""});
  EXPECT_EQ(words.code, 4);
  EXPECT_THAT(words.out, HasSubstr("looks like metres"));
  EXPECT_THAT(words.out, HasSubstr("--units m"));
  EXPECT_EQ(ostia({"mesh", "tube.ply", "--forecast", "--units", "m"}, {folder, ""}).code, 0);
  const Outcome by_calibre = ostia({"mesh", "tube.ply", "--forecast"}, {folder, ""});
  EXPECT_EQ(by_calibre.code, 0);
  EXPECT_THAT(by_calibre.err, HasSubstr("metres"));
  const Outcome checked = ostia({"mesh", "--check", "tube.ply"}, {folder, ""});
  EXPECT_EQ(checked.code, 4);
  EXPECT_EQ(Json::parse(checked.out)["forecast"]["places"][0]["kind"], "units");
  EXPECT_THAT(checked.err, HasSubstr("--units m"));
}

TEST(MeshForecast, AHoleIsToldByPlaceAndClosedOrRefused) {
  const fs::path folder = temporary_folder("mesh");
  geometry::TriMesh tube =
      geometry::surface_of(geometry::straight_tube(mesh_places_length_mm, mesh_places_radius_mm), 0.4, true);
  // A pair of triangles turned round on the wall, and a hole in its middle.
  const auto in_middle = [&](const geometry::Triangle& t) {
    const geometry::Vec3& p = tube.points[static_cast<std::size_t>(t[0])];
    return p.x() > 1.5 && std::abs(p.z() - 6.0) < 0.6;
  };
  ASSERT_GT(std::erase_if(tube.triangles, in_middle), 3U);
  io::write_surface(folder / "hole.ply", tube);
  const Outcome told = ostia({"mesh", "hole.ply", "--forecast", "--json", "--strict"}, {folder, ""});
  EXPECT_EQ(told.code, 4);
  const Json place = Json::parse(told.out)["places"][0];
  EXPECT_EQ(place["kind"], "open_edges");
  EXPECT_NEAR(place["point"][2].get<double>(), 6.0, 1.5);
  EXPECT_THAT(place["option"].get<std::string>(), HasSubstr("--fill-holes"));
  const Outcome strict = ostia({"mesh", "hole.ply", "-o", "out", "--strict"}, {folder, ""});
  EXPECT_EQ(strict.code, 3);
  EXPECT_THAT(strict.err, HasSubstr("meshing may fail there"));
  EXPECT_FALSE(fs::exists(folder / "out"));
  const Outcome mended = ostia({"mesh", "hole.ply", "-o", "out"}, {folder, ""});
  EXPECT_EQ(mended.code, 0) << mended.err;
  EXPECT_THAT(mended.err, HasSubstr("a hole in the wall closed"));
}

TEST(MeshForecast, NeedsASurface) {
  EXPECT_EQ(ostia({"mesh", "--forecast"}).code, 2);
  EXPECT_EQ(ostia({"mesh", "case.ostia", "--forecast"}).code, 2);
}

TEST(MeshCheck, ReadsWhatWasExported) {
  const fs::path folder = folder_with_narrowed_tube();
  const Outcome made = ostia({"mesh", "tube.ply", "-o", "out", "--layers", "2", "--export",
                              "openfoam,exodus,cgns,xdmf,abaqus,fluent", "--json"},
                             {folder, ""});
  ASSERT_EQ(made.code, 0) << made.err;
  const Json expected = Json::parse(made.out)["volume"];
  for (const std::string file :
       {"openfoam", "mesh.exo", "mesh.cgns", "mesh.inp", "mesh-fluent.msh", "xdmf", "xdmf/mesh.xdmf"}) {
    const Outcome checked = ostia({"mesh", "--check", "out/" + file, "--json"}, {folder, ""});
    ASSERT_EQ(checked.code, 0) << file << ": " << checked.err;
    const Json volume = Json::parse(checked.out)["volume"];
    EXPECT_EQ(volume["prisms"], expected["prisms"]) << file;
    EXPECT_EQ(volume["tetrahedra"], expected["tetrahedra"]) << file;
    EXPECT_NEAR(volume["volume_mm3"].get<double>(), expected["volume_mm3"].get<double>(), 1e-6) << file;
    for (std::size_t f = 0; f < 3; ++f) {
      EXPECT_EQ(volume["faces"][f]["name"], expected["faces"][f]["name"]) << file;
      EXPECT_EQ(volume["faces"][f]["kind"], expected["faces"][f]["kind"]) << file;
      EXPECT_NEAR(volume["faces"][f]["area_mm2"].get<double>(),
                  expected["faces"][f]["area_mm2"].get<double>(), 1e-6)
          << file;
    }
  }
}

TEST(MeshCheck, SplitLayersPassTheGateAndSayWhichTheyAre) {
  const fs::path folder = folder_with_narrowed_tube();
  const Outcome made =
      ostia({"mesh", "tube.ply", "-o", "out", "--layers", "4", "--layer-thickness", "0.25", "--split-prisms",
             "--export", "gmsh2,gmsh4,exodus,abaqus,cgns,xdmf,openfoam,fluent", "--json"},
            {folder, ""});
  ASSERT_EQ(made.code, 0) << made.err;
  const Json volume = Json::parse(made.out)["volume"];
  EXPECT_EQ(volume["prisms"], 0);
  EXPECT_LT(volume["min_dihedral_deg"].get<double>(), 5.0) << "flat as the layers are";
  EXPECT_GT(volume["of_layers"]["others_min_dihedral_deg"].get<double>(), 5.0);
  EXPECT_GT(volume["of_layers"]["count"].get<std::size_t>(), 1000U);
  const Outcome checked = ostia({"mesh", "--check", "out/mesh.vtu", "--json"}, {folder, ""});
  EXPECT_EQ(checked.code, 0) << checked.err;
  EXPECT_EQ(Json::parse(checked.out)["volume"]["of_layers"], volume["of_layers"]);
  for (const std::string file :
       {"mesh-gmsh2.msh", "mesh-gmsh4.msh", "mesh.exo", "mesh.inp", "mesh.cgns", "xdmf", "openfoam"}) {
    const Outcome same = ostia({"mesh", "--check", "out/" + file, "--json"}, {folder, ""});
    EXPECT_EQ(same.code, 0) << file << same.err;
    EXPECT_EQ(Json::parse(same.out)["volume"]["of_layers"]["count"], volume["of_layers"]["count"]) << file;
  }
  // A file that does not say so is judged as any other.
  const Outcome unknown = ostia({"mesh", "--check", "out/mesh-fluent.msh"}, {folder, ""});
  EXPECT_EQ(unknown.code, 4);
  EXPECT_THAT(unknown.err, HasSubstr("dihedral"));
  EXPECT_THAT(unknown.err, HasSubstr("check the mesh.vtu"));
}

}  // namespace
}  // namespace ostia::testing
