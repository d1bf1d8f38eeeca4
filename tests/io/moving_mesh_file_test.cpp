#include "ostia/io/moving_mesh_file.h"

#include "io_test_support.h"
#include "mesh_export_meshes.h"

#include "ostia/io/mesh_export.h"
#include "ostia/io/volume_mesh_file.h"

#include <gmock/gmock.h>

namespace ostia::io {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

TEST(MovingMeshFile, ListsMeshesByTime) {
  const fs::path path = testing::temporary_folder("moving") / "mesh.pvd";
  write_pvd(path, {{0.0, "mesh_000.vtu"}, {0.04, "mesh_001.vtu"}});
  EXPECT_EQ(core::read_file(path),
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" "
            "byte_order=\"LittleEndian\">\n  <Collection>\n"
            "    <DataSet timestep=\"0\" part=\"0\" file=\"mesh_000.vtu\"/>\n"
            "    <DataSet timestep=\"0.04\" part=\"0\" file=\"mesh_001.vtu\"/>\n"
            "  </Collection>\n</VTKFile>\n");
}

TEST(MovingMeshFile, NamesTimesAsOpenFoamDoes) {
  EXPECT_EQ(openfoam_time(0.0), "0");
  EXPECT_EQ(openfoam_time(0.8 / 20 * 3), "0.12");
  EXPECT_EQ(openfoam_time(1.0), "1");
}

}  // namespace
}  // namespace ostia::io
