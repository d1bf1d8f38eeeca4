#include "ostia/pipeline/vessel_export.h"

#include "shared_data.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/io/centerline_file.h"
#include "ostia/io/surface_file.h"
#include "ostia/io/volume_mesh_file.h"
#include "ostia/lumen/start_surface.h"
#include "ostia/lumen/tree_surface.h"
#include "ostia/pipeline/manifest.h"
#include "ostia/pipeline/vessel_choice.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <thread>

namespace ostia::pipeline {
namespace {

namespace fs = std::filesystem;
using geometry::Vec3;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

geometry::Centerline export_line(const Vec3& from, const Vec3& to, double radius) {
  geometry::Centerline axis;
  const int count = static_cast<int>(std::ceil((to - from).norm() / 0.5));
  for (int i = 0; i <= count; ++i) {
    axis.points.push_back(from + (to - from) * i / count);
    axis.radius.push_back(radius);
  }
  geometry::complete(axis);
  return axis;
}

/// A trunk along z with a side branch at its middle, and a vessel of its own beside them.
lumen::LumenModel heart() {
  const Vec3 root(0, 0, 0), fork(0, 0, 10), end(0, 0, 20), side(8, 0, 16), other(30, 0, 0), far(30, 0, 15);
  geometry::VesselTree tree;
  tree.nodes = {{1, root}, {2, fork}, {3, end}, {4, side}, {5, other}, {6, far}};
  tree.segments = {{11, 1, 2, export_line(root, fork, 1.5)},
                   {12, 2, 3, export_line(fork, end, 1.5)},
                   {13, 2, 4, export_line(fork, side, 1.0)},
                   {14, 5, 6, export_line(other, far, 1.2)}};
  tree.vessels = {{21, "LAD", {11, 12}}, {22, "D1", {11, 13}}, {23, "RCA", {14}}};
  return lumen::model_of_tubes(tree);
}

/// A straight tube alone; between the cuts it is length - 2 * 0.4 * radius long.
constexpr double tube_radius_mm = 1.5, length_mm = 20.0;
lumen::LumenModel vessel_export_tube() {
  geometry::VesselTree tree;
  const Vec3 from(0, 0, 0), to(0, 0, length_mm);
  tree.nodes = {{1, from}, {2, to}};
  tree.segments = {{3, 1, 2, export_line(from, to, tube_radius_mm)}};
  tree.vessels = {{4, "LAD", {3}}};
  return lumen::model_of_tubes(tree);
}
double tube_volume() {
  return M_PI * tube_radius_mm * tube_radius_mm * (length_mm - 0.8 * tube_radius_mm);
}
/// The same of the model, whose wall is interpolated: what its fine wall encloses, less what is cut off.
double model_volume() {
  const double cut = M_PI * tube_radius_mm * tube_radius_mm * (0.4 + 2.0 / 3.0) * tube_radius_mm;
  return geometry::volume(lumen::surface_of(vessel_export_tube(), 0.08)) - 2.0 * cut;
}

std::vector<std::string> names(const std::vector<geometry::Face>& faces) {
  std::vector<std::string> all;
  for (const geometry::Face& face : faces) all.push_back(face.name);
  return all;
}

TEST(VesselChoice, ABranchBringsItsParent) {
  const lumen::LumenModel model = heart();
  EXPECT_THAT(with_parents(model.tree, {22}), ElementsAre(21, 22));
  EXPECT_THAT(with_parents(model.tree, {21}), ElementsAre(21));
  EXPECT_THAT(with_parents(model.tree, {23, 21}), ElementsAre(21, 23));
  EXPECT_THROW(with_parents(model.tree, {}), InvalidInput);
  EXPECT_THROW(with_parents(model.tree, {7}), InvalidInput);
}

TEST(VesselChoice, PartsAreSound) {
  const lumen::LumenModel model = heart();
  for (const std::int32_t id : {21, 22, 23})
    EXPECT_FALSE(lumen::find_fault(part_of(model, {id}))) << *lumen::find_fault(part_of(model, {id}));
  const auto parts = rooted_parts(model);
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(parts[0].name, "LAD");
  EXPECT_EQ(parts[0].model.vessels.size(), 2U);
  EXPECT_EQ(parts[1].name, "RCA");
  EXPECT_EQ(lumen::digest(part_of(model, {21, 22, 23})), lumen::digest(model));
}

TEST(VesselExport, AMeshHasTheTubesVolumeAndNamedEnds) {
  const fs::path folder = testing::temporary_folder("export") / "mesh";
  MeshExportOptions options;
  options.sizing = even_edges(0.25);
  const ExportSummary made = export_mesh(folder, vessel_export_tube(), options);
  EXPECT_TRUE(made.verdict.ok()) << made.verdict.summary();
  const geometry::MixedMesh mesh = io::read_volume_mesh(folder / "mesh.vtu");
  EXPECT_EQ(mesh.tetrahedra.size(), made.tetrahedra);
  EXPECT_THAT(names(mesh.faces), ElementsAre("wall", "inlet_LAD", "outlet_LAD"));
  const meshing::MixedQuality quality = meshing::mixed_quality(mesh);
  EXPECT_NEAR(quality.volume_mm3(), model_volume(), 0.01 * model_volume());
  EXPECT_NEAR(quality.volume_mm3(), tube_volume(), 0.02 * tube_volume());
  EXPECT_EQ(quality.tetrahedra.min_dihedral_deg, made.min_dihedral_deg);
  const auto surface = io::read_surface(folder / "lumen.stl").surface.mesh;
  EXPECT_NEAR(geometry::volume(surface), quality.volume_mm3(), 1e-3 * quality.volume_mm3());
  EXPECT_FALSE(geometry::find_fault(io::read_centerlines(folder / "centerlines.vtp")));
  EXPECT_EQ(already_done(folder, mesh_job(vessel_export_tube(), options)), ExitCode::ok);
  options.sizing = even_edges(0.5);
  EXPECT_FALSE(already_done(folder, mesh_job(vessel_export_tube(), options)));
}

TEST(VesselExport, SeveralTreesGetAFolderEach) {
  const fs::path folder = testing::temporary_folder("export") / "mesh";
  const ExportSummary made = export_mesh(folder, heart());
  EXPECT_EQ(made.trees, 2U);
  const auto left = io::read_volume_mesh(folder / "LAD" / "mesh.vtu"),
             right = io::read_volume_mesh(folder / "RCA" / "mesh.vtu");
  EXPECT_THAT(names(left.faces), ElementsAre("wall", "inlet_LAD", "outlet_LAD", "outlet_D1"));
  EXPECT_THAT(names(right.faces), ElementsAre("wall", "inlet_RCA", "outlet_RCA"));
  EXPECT_EQ(left.tetrahedra.size() + right.tetrahedra.size(), made.tetrahedra);
  EXPECT_TRUE(fs::exists(folder / "manifest.json"));
  EXPECT_NEAR(meshing::mixed_quality(left).volume_mm3() + meshing::mixed_quality(right).volume_mm3(),
              made.volume_mm3, 1e-6);
}

TEST(VesselExport, PlanesAndFlowsFindTheirTrees) {
  const fs::path folder = testing::temporary_folder("export") / "mesh";
  MeshExportOptions options;
  options.planes = {{"", {30, 0, 11}, {0, 0, 1}}, {"inlet_LAD", {0, 0, 4}, {0, 0, 1}}};
  solver::OpenfoamCaseOptions flow;
  flow.flow.inlet_flow_ml_s = {{"inlet_LAD", 1.25}, {"inlet_RCA", 0.75}};
  options.volume.solver_case = flow;
  export_mesh(folder, heart(), options);
  const auto extent = [&](const std::string& tree) {
    const auto mesh = io::read_volume_mesh(folder / tree / "mesh.vtu");
    return geometry::bounds(mesh.points);
  };
  EXPECT_NEAR(extent("RCA").max().z(), 11.0, 0.01);
  EXPECT_NEAR(extent("LAD").min().z(), 4.0, 0.01);
  EXPECT_LT(extent("RCA").min().z(), 1.0) << "the other ends are where they were";
  EXPECT_GT(extent("LAD").max().z(), 19.0);
  for (const std::string tree : {"LAD", "RCA"})
    EXPECT_TRUE(fs::exists(folder / tree / "openfoam-case" / "Allrun")) << tree;
  flow.flow.inlet_flow_ml_s = {{"inlet_LM", 1.0}};
  options.volume.solver_case = flow;
  EXPECT_THROW(export_mesh(folder, heart(), options), InvalidInput);
  options.volume.solver_case.reset();
  options.planes = {{"outlet_LM", {0, 0, 4}, {0, 0, 1}}};
  EXPECT_THROW(export_mesh(folder, heart(), options), InvalidInput);
}

TEST(VesselExport, TheEstimateIsNearWhatIsMade) {
  const fs::path parent = testing::temporary_folder("export");
  int number = 0;
  for (const meshing::SizingOptions& sizing :
       {edges_around(16), edges_around(22), even_edges(0.3), even_edges(0.6)}) {
    MeshExportOptions options;
    options.sizing = sizing;
    const ExportSummary made = export_mesh(parent / std::to_string(number++), heart(), options);
    const MeshEstimate estimate = estimate_mesh(heart(), {}, sizing);
    EXPECT_NEAR(estimate.tetrahedra / static_cast<double>(made.tetrahedra), 1.0, 0.2);
    EXPECT_NEAR(estimate.triangles / static_cast<double>(made.triangles), 1.0, 0.2);
  }
}

TEST(VesselExport, LayersAndFormatsOfSeveralTrees) {
  const fs::path folder = testing::temporary_folder("export") / "mesh";
  MeshExportOptions options;
  options.volume.layers.emplace();
  options.volume.layers->thickness = 0.5;
  options.volume.formats = {io::MeshFormat::openfoam, io::MeshFormat::gmsh4};
  const ExportSummary made = export_mesh(folder, heart(), options);
  EXPECT_TRUE(made.verdict.ok()) << made.verdict.summary();
  EXPECT_GT(made.prisms, 0U);
  ASSERT_TRUE(made.full_layers);
  EXPECT_GT(*made.full_layers, 0.9);
  std::size_t prisms = 0;
  for (const char* tree : {"LAD", "RCA"}) {
    prisms += io::read_volume_mesh(folder / tree / "mesh.vtu").prisms.size();
    EXPECT_TRUE(fs::exists(folder / tree / "openfoam" / "constant" / "polyMesh" / "faces")) << tree;
    EXPECT_TRUE(fs::exists(folder / tree / "mesh-gmsh4.msh")) << tree;
  }
  EXPECT_EQ(prisms, made.prisms);
  const MeshEstimate estimate = estimate_mesh(heart(), {}, options.sizing, options.volume);
  EXPECT_NEAR(estimate.prisms / static_cast<double>(made.prisms), 1.0, 0.2);
  EXPECT_NEAR(estimate.tetrahedra / static_cast<double>(made.tetrahedra), 1.0, 0.2);
  EXPECT_EQ(already_done(folder, mesh_job(heart(), options)), ExitCode::ok);
  options.volume.layers->layers = 3;
  EXPECT_FALSE(already_done(folder, mesh_job(heart(), options)));
}

TEST(VesselExport, SurfacesEndAsAsked) {
  const fs::path parent = testing::temporary_folder("export");
  SurfaceExportOptions options;
  options.formats = {"vtp", "stl", "ply"};
  options.sizing = even_edges(0.25);
  export_surface(parent / "capped", vessel_export_tube(), options);
  const auto capped = io::read_surface(parent / "capped" / "lumen.vtp").surface;
  EXPECT_THAT(names(capped.faces), ElementsAre("wall", "inlet_LAD", "outlet_LAD"));
  EXPECT_NEAR(geometry::volume(capped.mesh), model_volume(), 0.01 * model_volume());
  for (const char* name : {"lumen.stl", "lumen.ply"})
    EXPECT_NEAR(geometry::volume(io::read_surface(parent / "capped" / name).surface.mesh),
                geometry::volume(capped.mesh), 1e-3)
        << name;

  options.ends = SurfaceEnds::open;
  options.sizing.reset();
  export_surface(parent / "open", vessel_export_tube(), options);
  const auto open = io::read_surface(parent / "open" / "lumen.vtp").surface.mesh;
  EXPECT_GT(geometry::find_faults(open, false).open_edges, 20U);
  EXPECT_NEAR(geometry::area(open), 2.0 * M_PI * tube_radius_mm * (length_mm - 0.8 * tube_radius_mm), 2.0);

  options.ends = SurfaceEnds::rounded;
  const ExportSummary made = export_surface(parent / "rounded", vessel_export_tube(), options);
  const auto rounded = io::read_surface(parent / "rounded" / "lumen.vtp").surface.mesh;
  EXPECT_TRUE(geometry::find_faults(rounded, false).closed_manifold());
  const double with_domes =
      M_PI * tube_radius_mm * tube_radius_mm * length_mm + 4.0 / 3.0 * M_PI * std::pow(tube_radius_mm, 3);
  EXPECT_NEAR(made.volume_mm3, with_domes, 0.02 * with_domes);
}

TEST(VesselExport, SeveralTreesAreOneSurface) {
  const fs::path folder = testing::temporary_folder("export") / "surface";
  SurfaceExportOptions options;
  options.formats = {"vtp"};
  options.sizing = edges_around(16);
  EXPECT_EQ(export_surface(folder, heart(), options).trees, 2U);
  const auto surface = io::read_surface(folder / "lumen.vtp").surface;
  EXPECT_THAT(names(surface.faces),
              ElementsAre("wall", "inlet_LAD", "outlet_LAD", "outlet_D1", "inlet_RCA", "outlet_RCA"));
  EXPECT_EQ(geometry::find_faults(surface.mesh, false).components, 2);
  options.vessels = {23};
  export_surface(folder, heart(), options);  // its own earlier result may be replaced
  EXPECT_THAT(names(io::read_surface(folder / "lumen.vtp").surface.faces),
              ElementsAre("wall", "inlet_RCA", "outlet_RCA"));
}

TEST(VesselExport, WhatCannotBeIsRefusedByName) {
  const fs::path parent = testing::temporary_folder("export");
  const auto refusal = [&](const auto& act) -> std::string {
    try {
      act();
    } catch (const Error& error) {
      return error.what();
    }
    return "nothing was refused";
  };
  EXPECT_THAT(refusal([] { even_edges(0.01); }), HasSubstr("0.05 to 3 mm"));
  EXPECT_THAT(refusal([] { even_edges(NAN); }), HasSubstr("0.05 to 3 mm"));
  EXPECT_THAT(refusal([] { edges_around(2); }), HasSubstr("6 to 120"));
  SurfaceExportOptions surface;
  surface.formats = {"obj"};
  EXPECT_THAT(refusal([&] { export_surface(parent / "a", vessel_export_tube(), surface); }),
              HasSubstr("vtp, stl or ply"));
  surface.formats.clear();
  EXPECT_THAT(refusal([&] { export_surface(parent / "a", vessel_export_tube(), surface); }),
              HasSubstr("at least one"));
  core::write_file(parent / "mine.txt", "mine");
  EXPECT_THAT(refusal([&] { export_mesh(parent, vessel_export_tube()); }), HasSubstr("holds files"));
  EXPECT_THROW(export_mesh("/proc/ostia-mesh", vessel_export_tube()), IoError);
  EXPECT_EQ(std::distance(fs::directory_iterator(parent), fs::directory_iterator()), 1);
}

TEST(VesselExport, CancelledAnywhereItLeavesNothing) {
  const fs::path parent = testing::temporary_folder("export");
  for (const double at : {0.0, 0.1, 0.3, 0.6}) {
    const core::TaskContext task;
    std::atomic<bool> ended = false;
    std::thread watcher([&] {
      while (!ended && task.progress() < at) std::this_thread::sleep_for(std::chrono::milliseconds(1));
      task.cancel();
    });
    MeshExportOptions options;
    options.sizing = even_edges(0.2);
    EXPECT_THROW(export_mesh(parent / "mesh", vessel_export_tube(), options, task), Cancelled) << at;
    ended = true;
    watcher.join();
    EXPECT_TRUE(fs::is_empty(parent)) << at;
  }
}

}  // namespace
}  // namespace ostia::pipeline
