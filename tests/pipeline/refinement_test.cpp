#include "ostia/pipeline/refinement.h"

#include "shared_data.h"

#include "ostia/core/error.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/geometry/mixed_mesh_sides.h"
#include "ostia/io/mesh_export.h"
#include "ostia/io/volume_fields.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace ostia::pipeline {
namespace {

namespace fs = std::filesystem;
using geometry::Vec3;
using ::testing::AllOf;
using ::testing::HasSubstr;

/// A box of 6 x 6 x 6 mm of tetrahedra, in `unit_mm`.
geometry::MixedMesh box(double unit_mm = 1.0) {
  geometry::MixedMesh mesh;
  constexpr std::int32_t n = 6, m = n + 1;
  for (std::int32_t k = 0; k < m; ++k)
    for (std::int32_t j = 0; j < m; ++j)
      for (std::int32_t i = 0; i < m; ++i) mesh.points.push_back(Vec3(i, j, k) / unit_mm);
  constexpr std::array<std::int32_t, 3> step{1, m, m * m};
  for (std::int32_t k = 0; k < n; ++k)
    for (std::int32_t j = 0; j < n; ++j)
      for (std::int32_t i = 0; i < n; ++i)
        for (const auto& [x, y, z] :
             {std::array{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {1, 0, 2}, {0, 2, 1}, {2, 1, 0}}) {
          const std::int32_t a = i + m * (j + m * k), b = a + step[static_cast<std::size_t>(x)],
                             c = b + step[static_cast<std::size_t>(y)],
                             d = c + step[static_cast<std::size_t>(z)];
          const bool even = y == (x + 1) % 3;
          mesh.tetrahedra.push_back(even ? geometry::Tetrahedron{a, b, c, d}
                                         : geometry::Tetrahedron{a, c, b, d});
        }
  geometry::take_free_sides_as_boundary(mesh);
  mesh.faces = {{1, "wall", geometry::FaceKind::wall}};
  return mesh;
}

/// Its nodes' values, and the same linear in the cells.
io::VolumeFields fields_of(const geometry::MixedMesh& mesh) {
  io::VolumeFields fields;
  for (const Vec3& p : mesh.points) {
    for (const double v : {0.0, 0.0, p.x() * p.x()}) fields.points["velocity_m_s"].values.push_back(v);
    fields.points["pressure_Pa"].values.push_back(p.z());
  }
  fields.points["velocity_m_s"].components = 3;
  for (const geometry::Tetrahedron& t : mesh.tetrahedra)
    fields.cells["pressure_Pa"].values.push_back(mesh.points[static_cast<std::size_t>(t[0])].z());
  return fields;
}

fs::path result_file(const geometry::MixedMesh& mesh) {
  const fs::path file = testing::temporary_folder("refinement") / "result.vtu";
  io::write_vtu_with_fields(file, mesh, fields_of(mesh));
  return file;
}

geometry::Box3 box_of(const geometry::MixedMesh& mesh) {
  return geometry::bounds(mesh.points);
}

TEST(Refinement, ReadsAFieldAtNodesAndSaysWhatItAskedFor) {
  const geometry::MixedMesh mesh = box();
  RefinementOptions options;
  options.result = result_file(mesh).parent_path();  // the folder with it
  options.field = "velocity_m_s";
  options.sizing.most_refinement = 0.05;
  options.sizing.error_share = 0.001;
  const Refinement made = refinement_by(options, box_of(mesh));
  EXPECT_EQ(made.report.field, "velocity_m_s");
  EXPECT_FALSE(made.report.at_elements);
  EXPECT_DOUBLE_EQ(made.report.range, 36.0);
  EXPECT_DOUBLE_EQ(made.report.target_error, 0.036);
  // 3/16 h^2 2 = 0.036
  const double edge = std::sqrt(0.036 * 16.0 / 3.0 / 2.0);
  EXPECT_NEAR(made.report.least_edge_mm, edge, 1e-4);
  EXPECT_NEAR(made.report.largest_edge_mm, edge, 1e-4);
  EXPECT_EQ(made.report.elements_before, static_cast<double>(mesh.tetrahedra.size()));
  EXPECT_EQ(made.sizes->points.size(), mesh.points.size());
  EXPECT_DOUBLE_EQ(made.report.refined_share, 1.0);
}

TEST(Refinement, TakesWhatIsKnownInCellsBeforeWhatIsAtPoints) {
  const geometry::MixedMesh mesh = box();
  RefinementOptions options;
  options.result = result_file(mesh);
  options.field = "pressure_Pa";
  EXPECT_TRUE(refinement_by(options, box_of(mesh)).report.at_elements);
}

std::string refusal(const RefinementOptions& options, const geometry::Box3& box) {
  try {
    refinement_by(options, box);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "";
}

TEST(Refinement, RefusesWithTheWayOut) {
  const geometry::MixedMesh mesh = box();
  RefinementOptions options;
  options.result = result_file(mesh);
  options.field = "speed";
  EXPECT_THAT(refusal(options, box_of(mesh)),
              AllOf(HasSubstr("no field speed"), HasSubstr("in its cells it has pressure_Pa,"),
                    HasSubstr("at its points pressure_Pa, velocity_m_s")));
  options.field = "velocity_m_s";
  geometry::Box3 far = box_of(mesh);
  far.translate(Vec3(0.0, 100.0, 0.0));
  EXPECT_THAT(refusal(options, far), AllOf(HasSubstr("of another vessel"), HasSubstr("from 0,100,0")));
  options.result = options.result.parent_path() / "none.vtu";
  EXPECT_THAT(refusal(options, box_of(mesh)), HasSubstr("no such file"));
  options.result = options.result.parent_path() / (std::string(300, 'n') + ".vtu");  // no name of a file
  EXPECT_THAT(refusal(options, box_of(mesh)), HasSubstr("no such file"));
  options.result = options.result.parent_path() / "flow.foam";
  EXPECT_THAT(refusal(options, box_of(mesh)), HasSubstr("ostia result CASE"));
  options.result = result_file(box(1000.0));
  EXPECT_THAT(refusal(options, box_of(mesh)), HasSubstr("in metres: scale its points by 1000"));
  options.field.clear();
  EXPECT_THAT(refusal(options, box_of(mesh)), HasSubstr("--by NAME"));
}

}  // namespace
}  // namespace ostia::pipeline
