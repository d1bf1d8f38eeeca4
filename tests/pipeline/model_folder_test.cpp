#include "ostia/pipeline/model_folder.h"

#include "builtin_model.h"
#include "shared_data.h"

#include "ostia/core/error.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/io/centerline_file.h"
#include "ostia/io/surface_file.h"
#include "ostia/io/volume_mesh_file.h"
#include "ostia/pipeline/report.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace ostia::pipeline {
namespace {
namespace fs = std::filesystem;

JobKey model_folder_key() {
  return {"model", {{"input", builtin_model().source.sha256}}, parameters_json(builtin_options())};
}

TEST(ModelFolder, HoldsEverythingAndIsDone) {
  const fs::path folder = testing::temporary_folder("model") / "out";
  EXPECT_EQ(
      write_model_folder(folder, builtin_model(), builtin_options(), model_folder_key(), std::nullopt, 1.0),
      ExitCode::ok);
  for (const char* name : {"lumen.vtp", "lumen.stl", "centerlines.vtp", "mesh.vtu", "report.json",
                           "report.html", "manifest.json"}) {
    EXPECT_TRUE(fs::exists(folder / name)) << name;
  }
  EXPECT_EQ(already_done(folder, model_folder_key()), ExitCode::ok);
  const auto mesh = io::read_volume_mesh(folder / "mesh.vtu");
  EXPECT_EQ(mesh.tetrahedra.size(), builtin_model().meshed.mesh.tetrahedra.size());
  EXPECT_EQ(mesh.faces.size(), 4u);
  EXPECT_TRUE(
      geometry::find_faults(io::read_surface(folder / "lumen.stl").surface.mesh, false).closed_manifold());
  EXPECT_FALSE(geometry::find_fault(io::read_centerlines(folder / "centerlines.vtp")));
}

TEST(ModelFolder, LeavesNothingWhenCancelled) {
  const fs::path parent = testing::temporary_folder("model");
  const core::TaskContext task;
  task.cancel();
  EXPECT_THROW(write_model_folder(parent / "out", builtin_model(), builtin_options(), model_folder_key(),
                                  std::nullopt, 1.0, task),
               Cancelled);
  EXPECT_TRUE(fs::is_empty(parent));
}

TEST(ModelFolder, RefusesWhereItCannotWrite) {
  EXPECT_THROW(write_model_folder("/dev/null/out", builtin_model(), builtin_options(), model_folder_key(),
                                  std::nullopt, 1.0),
               IoError);
}

TEST(ModelFolder, MeshFolderTellsAFailedGate) {
  const fs::path folder = testing::temporary_folder("model") / "mesh";
  MeshedLumen meshed = builtin_model().meshed;
  meshed.quality.verdict.reasons.push_back("made to fail");
  EXPECT_EQ(write_mesh_folder(folder, meshed, builtin_options(), model_folder_key(), 1.0),
            ExitCode::quality_failed);
  EXPECT_EQ(already_done(folder, model_folder_key()), ExitCode::quality_failed);
}

}  // namespace
}  // namespace ostia::pipeline
