#include "tetgen_job.h"

#include "test_surfaces.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace ostia::meshing {
namespace {

std::filesystem::path scratch(const std::string& name) {
  return std::filesystem::path(::testing::TempDir()) / name;
}

TEST(TetgenJob, ComesBackAsItWasWritten) {
  const auto surface = tetrahedron_surface(1.0);
  const TetgenJob job{1.5, 7.0, surface.points, {0.1, 0.2, 0.3, 0.4}, surface.triangles};
  write_job(job, scratch("job.bin"));
  const TetgenJob back = read_job(scratch("job.bin"));
  EXPECT_EQ(back.max_radius_edge_ratio, 1.5);
  EXPECT_EQ(back.min_dihedral_deg, 7.0);
  EXPECT_EQ(back.points, job.points);
  EXPECT_EQ(back.sizes, job.sizes);
  EXPECT_EQ(back.triangles, job.triangles);
  const TetgenResult result{surface.points, {{0, 1, 2, 3}}};
  write_result(result, scratch("result.bin"));
  EXPECT_EQ(read_result(scratch("result.bin")).tetrahedra, result.tetrahedra);
}

TEST(TetgenJob, RefusesFilesThatAreNotWhole) {
  const auto surface = tetrahedron_surface(1.0);
  write_job({1.5, 7.0, surface.points, {0.1, 0.2, 0.3, 0.4}, surface.triangles}, scratch("whole.bin"));
  const std::string bytes = core::read_file(scratch("whole.bin"));
  for (const std::size_t length :
       {std::size_t{0}, std::size_t{5}, std::size_t{20}, std::size_t{60}, bytes.size() - 1}) {
    core::write_file(scratch("cut.bin"), bytes.substr(0, length));
    EXPECT_THROW(read_job(scratch("cut.bin")), InvalidInput) << length;
  }
  EXPECT_THROW(read_result(scratch("whole.bin")), InvalidInput);
  write_job({1.5, 7.0, surface.points, {0.1, 0.2, 0.3, 0.4}, {{0, 1, 9}}}, scratch("corner.bin"));
  EXPECT_THROW(read_job(scratch("corner.bin")), InvalidInput);
  std::string huge = bytes;
  huge.replace(8 + 16, 8, std::string(8, '\x7f'));  // the count of points
  core::write_file(scratch("huge.bin"), huge);
  EXPECT_THROW(read_job(scratch("huge.bin")), InvalidInput);
}

}  // namespace
}  // namespace ostia::meshing
