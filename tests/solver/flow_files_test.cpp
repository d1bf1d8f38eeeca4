#include "ostia/solver/flow_files.h"

#include "made_up_flow.h"
#include "mid_cut.h"

#include "ostia/io/surface_file.h"
#include "ostia/io/volume_mesh_file.h"
#include "ostia/solver/flow_figures.h"

#include <nlohmann/json.hpp>

#include <set>

namespace ostia::solver {
namespace {

namespace fs = std::filesystem;
using geometry::Vec3;

TEST(FlowFiles, HoldTheFieldsByTheirNames) {
  const Poiseuille truth;
  const geometry::MixedMesh mesh = tube(truth.length_mm, truth.radius_mm);
  const FlowResult result = read_flow_result(made_up_steady(mesh, truth));
  const fs::path folder = testing::temporary_folder("files");
  write_flow_files(result, flow_report(result), folder);

  const io::VolumeFields volume = io::read_vtu_fields(folder / "result.vtu");
  for (const auto* fields : {&volume.cells, &volume.points}) {
    ASSERT_EQ(fields->size(), 2u);
    EXPECT_EQ(fields->at("velocity_m_s").components, 3);
    EXPECT_EQ(fields->at("pressure_Pa").components, 1);
  }
  EXPECT_EQ(volume.cells.at("velocity_m_s").values, result.last.velocity_m_s);
  EXPECT_EQ(io::read_volume_mesh(folder / "result.vtu").prisms, mesh.prisms);
  // Carried to the points: a linear pressure within what half an edge makes of it, and no slip at the wall.
  const double edge = truth.gradient_pa_m() * 1e-3 * 0.7 * truth.radius_mm;
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
    EXPECT_NEAR(volume.points.at("pressure_Pa").values[i], truth.pressure_pa(mesh.points[i].z()), edge);
  for (const std::int32_t p : result.wall.mesh_points)
    EXPECT_EQ(volume.points.at("velocity_m_s").values[3 * static_cast<std::size_t>(p) + 2], 0.0);

  const io::PointFields wall = io::read_surface_with_fields(folder / "wall.vtp").points;
  ASSERT_EQ(wall.size(), 3u);
  for (const double shear : wall.at("wall_shear_stress_Pa").values)
    EXPECT_NEAR(shear, truth.shear_pa(), 1e-9);
  EXPECT_EQ(wall.at("wall_shear_stress_vector_Pa").components, 3);
  EXPECT_NEAR(wall.at("wall_shear_stress_vector_Pa").values[2], truth.shear_pa(), 1e-9);
  EXPECT_EQ(wall.at("pressure_Pa").values.size(), result.wall.mesh_points.size());
  const geometry::FacedSurface surface = io::read_surface(folder / "wall.vtp").surface;
  EXPECT_EQ(surface.mesh.triangles.size(), wall_centres(mesh).size());
  EXPECT_EQ(surface.faces.at(0).name, "wall");
}

TEST(FlowFiles, TablesSayTheSame) {
  const Poiseuille truth;
  const geometry::MixedMesh mesh = tube(truth.length_mm, truth.radius_mm);
  const FlowResult result = read_flow_result(made_up_steady(mesh, truth));
  const FlowReport report = flow_report(result);
  const auto json = nlohmann::json::parse(report_json(result, report));
  EXPECT_EQ(json["run"]["iterations"], 120.0);
  EXPECT_TRUE(json["verdict"]["passed"].get<bool>());
  EXPECT_TRUE(json["cycle"].is_null());
  EXPECT_NEAR(json["faces"][0]["pressure_mmHg"].get<double>(), truth.pressure_pa(0.0) / 133.322387415, 1e-9);
  EXPECT_NEAR(json["walls"][0]["wall_shear_stress_Pa"]["p95"].get<double>(), truth.shear_pa(), 1e-9);
  const std::string csv = faces_csv(result, report);
  std::istringstream lines(csv);
  std::size_t rows = 0;
  for (std::string line; std::getline(lines, line); ++rows)
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), 12) << line;
  EXPECT_EQ(rows, 4u);  // head, inlet, outlet, wall
  EXPECT_NE(csv.find("\nwall,wall,"), std::string::npos);
}

TEST(FlowFiles, AWallOfQuadrilateralsIsCutInTriangles) {
  // One prism whose three quadrilaterals are the wall.
  geometry::MixedMesh mesh;
  mesh.points = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 3}, {2, 0, 3}, {0, 2, 3}};
  mesh.prisms = {{0, 1, 2, 3, 4, 5}};
  mesh.triangles = {{0, 2, 1}, {3, 4, 5}};
  mesh.triangle_face_ids = {2, 3};
  mesh.quads = {{0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}};
  mesh.quad_face_ids = {1, 1, 1};
  mesh.faces = {{1, "wall", geometry::FaceKind::wall},
                {2, "inlet_a", geometry::FaceKind::inlet},
                {3, "outlet_a", geometry::FaceKind::outlet}};
  const WallSurface wall = wall_surface(mesh);
  ASSERT_EQ(wall.areas_mm2.size(), 3u);
  EXPECT_NEAR(wall.areas_mm2[0], 6.0, 1e-12);
  EXPECT_NEAR(wall.areas_mm2[1], 6.0 * std::sqrt(2.0), 1e-12);
  EXPECT_EQ(wall.facet_of, (std::vector<std::int32_t>{0, 0, 1, 1, 2, 2}));
  const std::vector<double> carried = at_wall_points(wall, {1.0, 2.0, 4.0}, 1);
  // The point (0, 0, 0): a whole quadrilateral's two halves or one of them, weighted with area.
  EXPECT_NEAR(carried[0], (6.0 * 1.0 + 3.0 * 4.0) / 9.0, 1e-12);
  EXPECT_NEAR(element_volumes(mesh).at(0), 6.0, 1e-12);
  mesh.faces[0].kind = geometry::FaceKind::outlet;
  EXPECT_THROW(wall_surface(mesh), InvalidInput);
}

TEST(FlowFiles, TheLumenIsCutHalfWayAlongTheSight) {
  constexpr double radius = 1.5;
  const geometry::MixedMesh mesh = vessel(geometry::straight_tube(8.0, radius), 0.4, 2);
  const WallSurface wall = wall_surface(mesh);
  const Vec3 sight(0.0, 2.0, 0.0);
  std::vector<double> heights;
  for (const Vec3& p : mesh.points) heights.push_back(p.z());
  const MidCut cut = mid_cut(mesh, wall.surface.mesh, wall.mesh_points, heights, sight);
  geometry::Box3 box;
  for (const Vec3& p : mesh.points) box.extend(p);
  double area = 0.0;
  ASSERT_EQ(cut.values.size(), cut.surface.triangles.size());
  for (std::size_t t = 0; t < cut.values.size(); ++t) {
    const auto p = [&](std::size_t k) {
      return cut.surface.points[static_cast<std::size_t>(cut.surface.triangles[t][k])];
    };
    const Vec3 normal = (p(1) - p(0)).cross(p(2) - p(0)) / 2.0;
    EXPECT_LE(normal.y(), 0.0) << "towards the viewer";
    area -= normal.y();
    EXPECT_NEAR(cut.values[t], (p(0).z() + p(1).z() + p(2).z()) / 3.0, 1e-9) << "a linear field stays";
  }
  for (const Vec3& p : cut.surface.points) EXPECT_NEAR(p.y(), 0.0, 0.3) << p.transpose();
  const double section = 2.0 * radius * box.sizes().z();
  EXPECT_NEAR(area, section, 0.06 * section);
  ASSERT_FALSE(cut.behind.triangles.empty());
  for (const geometry::Triangle& t : cut.behind.triangles) {
    double y = 0.0;
    for (const std::int32_t c : t) y += cut.behind.points[static_cast<std::size_t>(c)].y();
    EXPECT_GT(y, -0.6);
  }
}

TEST(FlowFiles, PicturesHaveTheColoursOfTheirValues) {
  const Poiseuille truth;
  const geometry::MixedMesh mesh = tube(truth.length_mm, truth.radius_mm);
  FlowResult result = read_flow_result(made_up_steady(mesh, truth));
  const auto colours = [](const figure::Raster& raster, int first, int last) {
    std::set<std::array<int, 3>> seen;
    for (int y = 60; y < raster.height - 60; ++y)
      for (int x = first; x < last; ++x) {
        const std::uint8_t* p = raster.pixel(x, y);
        seen.insert({p[0] / 16, p[1] / 16, p[2] / 16});
      }
    return seen.size();
  };
  const figure::Raster even = wall_shear_picture(result).raster();
  for (std::size_t i = 0; i < result.last.wall_shear_pa.size(); ++i)  // from none to twice as much
    result.last.wall_shear_pa[i] *=
        2.0 * static_cast<double>(i) / static_cast<double>(result.last.wall_shear_pa.size());
  const figure::Raster rising = wall_shear_picture(result).raster();
  EXPECT_GT(colours(rising, 100, 500), 2 * colours(even, 100, 500));
  const figure::Raster speed = speed_picture(result).raster();
  EXPECT_GT(speed.width, 600);
  EXPECT_GT(colours(speed, 100, 500), 30u);
}

}  // namespace
}  // namespace ostia::solver
