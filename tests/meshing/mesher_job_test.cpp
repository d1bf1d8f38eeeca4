#include "mesher/mesher_job.h"

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

MesherJob job_of(const geometry::TriMesh& surface) {
  return {MesherJob::mesh3, 1.5, 7.0, surface.points, {0.1, 0.2, 0.3, 0.4}, surface.triangles, {1, 2, 3, 4}};
}

TEST(MesherJob, ComesBackAsItWasWritten) {
  const auto surface = tetrahedron_surface(1.0);
  MesherJob job = job_of(surface);
  job.field_points = {{1, 2, 3}, {4, 5, 6}};
  job.field_sizes = {0.5, 0.6};
  job.field_gradation = 0.7;
  write_job(job, scratch("job.bin"));
  const MesherJob back = read_job(scratch("job.bin"));
  EXPECT_EQ(back.mesher, MesherJob::mesh3);
  EXPECT_EQ(back.max_radius_edge_ratio, 1.5);
  EXPECT_EQ(back.min_dihedral_deg, 7.0);
  EXPECT_EQ(back.points, job.points);
  EXPECT_EQ(back.sizes, job.sizes);
  EXPECT_EQ(back.triangles, job.triangles);
  EXPECT_EQ(back.face_ids, job.face_ids);
  EXPECT_EQ(back.field_points, job.field_points);
  EXPECT_EQ(back.field_sizes, job.field_sizes);
  EXPECT_EQ(back.field_gradation, 0.7);
  const MesherResult result{surface.points, {{0, 1, 2, 3}}, surface.triangles, {1, 2, 3, 4}};
  write_result(result, scratch("result.bin"));
  const MesherResult result_back = read_result(scratch("result.bin"));
  EXPECT_EQ(result_back.points, result.points);
  EXPECT_EQ(result_back.tetrahedra, result.tetrahedra);
  EXPECT_EQ(result_back.boundary, result.boundary);
  EXPECT_EQ(result_back.boundary_face_ids, result.boundary_face_ids);
}

TEST(MesherJob, RefusesFilesThatAreNotWhole) {
  const auto surface = tetrahedron_surface(1.0);
  write_job(job_of(surface), scratch("whole.bin"));
  const std::string bytes = core::read_file(scratch("whole.bin"));
  for (const std::size_t length :
       {std::size_t{0}, std::size_t{5}, std::size_t{20}, std::size_t{60}, bytes.size() - 1}) {
    core::write_file(scratch("cut.bin"), bytes.substr(0, length));
    EXPECT_THROW(read_job(scratch("cut.bin")), InvalidInput) << length;
  }
  EXPECT_THROW(read_result(scratch("whole.bin")), InvalidInput);
  MesherJob corner = job_of(surface);
  corner.triangles[2] = {0, 1, 9};
  write_job(corner, scratch("corner.bin"));
  EXPECT_THROW(read_job(scratch("corner.bin")), InvalidInput);
  corner = job_of(surface);
  corner.field_sizes = {1.0};
  write_job(corner, scratch("lengths.bin"));
  EXPECT_THROW(read_job(scratch("lengths.bin")), InvalidInput);
  corner = job_of(surface);
  corner.face_ids.pop_back();
  write_job(corner, scratch("ids.bin"));
  EXPECT_THROW(read_job(scratch("ids.bin")), InvalidInput);
  write_result({surface.points, {{0, 1, 2, 4}}, {}, {}}, scratch("element.bin"));
  EXPECT_THROW(read_result(scratch("element.bin")), InvalidInput);
  std::string huge = bytes;
  huge.replace(8 + 4 + 16, 8, std::string(8, '\x7f'));  // the count of points
  core::write_file(scratch("huge.bin"), huge);
  EXPECT_THROW(read_job(scratch("huge.bin")), InvalidInput);
}

}  // namespace
}  // namespace ostia::meshing
