// What OpenGL draws, held against the same in double precision on the CPU.

#include "ostia/glview/beating_scene.h"

#include "ostia/core/error.h"
#include "ostia/geometry/analytic_shapes.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/glview/offscreen.h"
#include "ostia/glview/sample_motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace ostia::glview {
namespace {

using geometry::TriMesh;

constexpr int width = 640, height = 480;
const Viewport whole{0, 0, width, height};

#define REQUIRE_OPENGL() \
  if (const std::string why = offscreen_trouble(); !why.empty()) GTEST_SKIP() << why

/// A cage of three phases, of which the second is moved by `move`.
template <class Move>
geometry::CageMotion moved_by(const TriMesh& mesh, int depth, const Move& move) {
  geometry::CageMotion motion;
  motion.grid = geometry::cage_around(mesh.points, depth);
  motion.template_phase = 0.0;
  const auto rest = geometry::rest_points(motion.grid);
  for (int k = 0; k < 3; ++k) {
    geometry::CagePhase phase{k / 3.0, {}, geometry::PhaseOrigin::fitted};
    for (const Vec3& p : rest) phase.control_points.push_back(k == 1 ? move(p) : p);
    motion.phases.push_back(phase);
  }
  return motion;
}

TriMesh ball(double radius, int around = 96) {
  TriMesh mesh;
  const int rows = around / 2;
  mesh.points.push_back(Vec3(0, 0, radius));
  for (int i = 1; i < rows; ++i)
    for (int k = 0; k < around; ++k) {
      const double t = std::numbers::pi * i / rows, p = 2.0 * std::numbers::pi * k / around;
      mesh.points.push_back(radius * Vec3(std::sin(t) * std::cos(p), std::sin(t) * std::sin(p), std::cos(t)));
    }
  mesh.points.push_back(Vec3(0, 0, -radius));
  const auto at = [&](int i, int k) { return 1 + (i - 1) * around + k % around; };
  for (int k = 0; k < around; ++k) {
    mesh.triangles.push_back({0, at(1, k), at(1, k + 1)});
    for (int i = 1; i + 1 < rows; ++i) {
      mesh.triangles.push_back({at(i, k), at(i + 1, k), at(i + 1, k + 1)});
      mesh.triangles.push_back({at(i, k), at(i + 1, k + 1), at(i, k + 1)});
    }
    mesh.triangles.push_back({at(rows - 1, k), 1 + (rows - 1) * around, at(rows - 1, k + 1)});
  }
  return mesh;
}

double grey(const figure::Raster& raster, int x, int y) {
  return raster.pixel(x, y)[1] / 255.0;
}

struct Heart {
  SampleHeart heart = sample_heart(0.9, 3);
  ShownSurface shown = shown_surface(heart.surface, heart.motion.grid);
  motion::MovingCage cage{heart.motion};
};

TEST(BeatingSceneGui, PutsVerticesWhereTheCageCarriesThem) {
  REQUIRE_OPENGL();
  Heart h;
  // Some points outside of the cage, too.
  h.heart.surface.points[0] = h.heart.motion.grid.origin - Vec3(3, 2, 1);
  h.shown = shown_surface(h.heart.surface, h.heart.motion.grid);
  Offscreen offscreen(width, height);
  BeatingScene scene(h.shown, h.cage);
  const motion::CarriedPoints carried(h.heart.motion.grid, h.heart.surface.points);
  ASSERT_EQ(carried.outside(), 1U);
  for (const double phase : {0.0, 0.38, 0.75, 0.991, 2.2}) {
    scene.set_phase(phase);
    const auto gpu = scene.places();
    const auto cpu = carried.places(h.cage.at(phase));
    ASSERT_EQ(gpu.size(), cpu.size());
    double off = 0.0;
    for (std::size_t i = 0; i < cpu.size(); ++i) off = std::max(off, (gpu[i].cast<double>() - cpu[i]).norm());
    EXPECT_LT(off, 5e-5) << phase << ": single precision is 4e-6 of a place 60 mm away";
  }
}

TEST(BeatingSceneGui, NormalsAreThoseOfTheMovedSurface) {
  REQUIRE_OPENGL();
  const TriMesh mesh = ball(10.0);
  const auto shear = [](const Vec3& p) { return Vec3(1.3 * p.x() + 0.4 * p.z(), 0.8 * p.y(), p.z()); };
  const auto motion = moved_by(mesh, 2, shear);
  Offscreen offscreen(width, height);
  BeatingScene scene(shown_surface(mesh, motion.grid), motion::MovingCage(motion));
  scene.set_phase(motion.phases[1].phase);
  const auto normals = scene.normals();
  TriMesh moved = mesh;
  for (Vec3& p : moved.points) p = shear(p);
  const auto expected = geometry::vertex_normals(moved);
  double worst = 1.0;
  for (std::size_t i = 0; i < normals.size(); ++i)
    worst = std::min(worst, normals[i].cast<double>().dot(expected[i]));
  EXPECT_GT(worst, std::cos(1.5 * std::numbers::pi / 180.0)) << "within 1.5 degrees";
}

TEST(BeatingSceneGui, ValuesAreThoseOfTheFormulas) {
  REQUIRE_OPENGL();
  Heart h;
  h.shown.along = find_directions(h.shown);
  const BendingTable table = bending_table(h.shown, h.cage, 5);
  Offscreen offscreen(width, height);
  BeatingScene scene(h.shown, h.cage);
  scene.set_bending(table);
  for (const SurfaceValue value :
       {SurfaceValue::displacement, SurfaceValue::velocity, SurfaceValue::stretch, SurfaceValue::bending})
    for (const double phase : {0.31, 0.52}) {
      scene.set_phase(phase, 0.8);
      SceneLook look;
      look.value = value;
      look.range = {-10.0, 40.0};
      const auto gpu = scene.values(look);
      const auto cpu = values_at(h.shown, h.cage, phase, value, 0.8, &table);
      double off = 0.0, most = 0.0;
      for (std::size_t i = 0; i < cpu.size(); ++i) {
        off = std::max(off, std::abs(static_cast<double>(gpu[i]) * 50.0 - 10.0 - cpu[i]));
        most = std::max(most, std::abs(cpu[i]));
      }
      EXPECT_GT(most, 0.1) << title(value);
      EXPECT_LT(off, 5e-3 + 1e-5 * most) << title(value);
    }
}

TEST(BeatingSceneGui, DirectionsThatComeLaterColourAsThoseThatCameWithTheSurface) {
  REQUIRE_OPENGL();
  Heart h;
  Offscreen offscreen(width, height);
  BeatingScene later(h.shown, h.cage);
  SceneLook look;
  look.value = SurfaceValue::stretch;
  look.range = {-20.0, 20.0};
  later.set_phase(0.38);
  for (const float value : later.values(look))
    EXPECT_FLOAT_EQ(value, 0.5F) << "none yet: nothing is stretched";
  h.shown.along = find_directions(h.shown);
  later.set_directions(h.shown.along);
  BeatingScene whole_at_once(h.shown, h.cage);
  whole_at_once.set_phase(0.38);
  const std::vector<float> values = later.values(look);
  EXPECT_EQ(values, whole_at_once.values(look));
  EXPECT_LT(*std::min_element(values.begin(), values.end()), 0.4F) << "the sample heart shortens";
}

TEST(BeatingSceneGui, AMovedBallIsWhereTheCameraProjectsIt) {
  REQUIRE_OPENGL();
  const TriMesh mesh = ball(6.0);
  const Vec3 shift(11.0, 4.0, -7.0);
  const auto motion = moved_by(mesh, 1, [&](const Vec3& p) { return Vec3(p + shift); });
  Offscreen offscreen(width, height);
  BeatingScene scene(shown_surface(mesh, motion.grid), motion::MovingCage(motion));
  scene.set_phase(motion.phases[1].phase);
  SceneLook look;
  look.value = SurfaceValue::displacement;
  look.range = {0.0, 20.0};
  look.shaded = false;
  const auto yellowish = color(SurfaceValue::displacement, shift.norm() / 20.0);
  for (const CarmAngles angles : {CarmAngles{0, 0}, CarmAngles{40, -25}, CarmAngles{-80, 10}}) {
    Camera camera;
    camera.angles = angles;
    camera.half_height_mm = 30.0;
    offscreen.bind();
    scene.draw(camera, look, whole);
    const figure::Raster raster = offscreen.read();
    double sum_x = 0.0, sum_y = 0.0, count = 0.0;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const auto* p = raster.pixel(x, y);
        if (std::abs(p[0] / 255.0 - yellowish.r) + std::abs(p[1] / 255.0 - yellowish.g) +
                std::abs(p[2] / 255.0 - yellowish.b) >
            0.03)
          continue;
        sum_x += x + 0.5;
        sum_y += y + 0.5;
        ++count;
      }
    const Vec2 middle = camera.project(shift, width, height);
    const double px_a_mm = height / 60.0 * camera.eye_mm / (camera.eye_mm - shift.dot(camera.towards()));
    ASSERT_GT(count, 100.0);
    EXPECT_NEAR(sum_x / count, middle.x(), 0.5) << text_of(angles);
    EXPECT_NEAR(sum_y / count, middle.y(), 0.5);
    EXPECT_NEAR(std::sqrt(count / std::numbers::pi), 6.0 * px_a_mm, 0.5) << "its radius; its colour is exact";
  }
}

TEST(BeatingSceneGui, AProjectionDarkensByTheWayThroughTheVessel) {
  REQUIRE_OPENGL();
  const double radius = 6.0, per_mm = 0.08;
  const TriMesh mesh = ball(radius);
  const auto motion = moved_by(mesh, 1, [](const Vec3& p) { return Vec3(2.0 * p); });
  Offscreen offscreen(width, height);
  BeatingScene scene(shown_surface(mesh, motion.grid), motion::MovingCage(motion));
  Camera camera;
  camera.projection = Projection::x_ray;
  camera.half_height_mm = 30.0;
  SceneLook look;
  look.absorption_per_mm = per_mm;
  for (const double scale : {1.0, 2.0}) {
    scene.set_phase(scale > 1.5 ? motion.phases[1].phase : 0.0);
    offscreen.bind();
    scene.draw(camera, look, whole);
    const figure::Raster raster = offscreen.read();
    for (const double off_mm : {0.0, 2.0, 4.0}) {
      const int x = width / 2 + static_cast<int>(off_mm * height / 60.0);
      const double mm = (x + 0.5 - width / 2.0) * 60.0 / height;
      const double way = 2.0 * std::sqrt(scale * scale * radius * radius - mm * mm);
      const double across = (x + 0.5) / width - 0.5, field = 0.74 - 0.22 * across * across;
      EXPECT_NEAR(grey(raster, x, height / 2), 0.05 + (field - 0.05) * std::exp(-per_mm * way), 0.008);
    }
    EXPECT_NEAR(grey(raster, 3, height / 2), 0.74 - 0.22 * 0.25, 0.01) << "beside it nothing is darkened";
  }
}

TEST(BeatingSceneGui, AnOpenTubeLeavesNoStreaksInProjection) {
  REQUIRE_OPENGL();
  const Heart h;
  Offscreen offscreen(width, height);
  BeatingScene scene(h.shown, h.cage);
  Camera camera = camera_on(h.heart.surface.points, {20.0, 10.0}, whole.aspect());
  camera.projection = Projection::x_ray;
  offscreen.bind();
  scene.draw(camera, {}, whole);
  const figure::Raster raster = offscreen.read();
  double darkest = 1.0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) darkest = std::min(darkest, grey(raster, x, y));
  // A hole would be a way of hundreds of millimetres: black.
  EXPECT_GT(darkest, 0.10);
  EXPECT_LT(darkest, 0.45) << "the vessels are dark";
}

TEST(BeatingSceneGui, LeftAndRightAreTheSameInBothViews) {
  REQUIRE_OPENGL();
  const TriMesh mesh = ball(4.0);
  const auto motion = moved_by(mesh, 1, [](const Vec3& p) { return Vec3(p + Vec3(12, 0, 0)); });
  Offscreen offscreen(width, height);
  BeatingScene scene(shown_surface(mesh, motion.grid), motion::MovingCage(motion));
  scene.set_phase(motion.phases[1].phase);
  Camera camera;
  camera.half_height_mm = 30.0;
  for (const Projection projection : {Projection::lit, Projection::x_ray}) {
    camera.projection = projection;
    offscreen.bind();
    scene.draw(camera, {}, whole);
    const figure::Raster raster = offscreen.read();
    const int right = width / 2 + 12 * height / 60, left = width / 2 - 12 * height / 60;
    EXPECT_GT(std::abs(grey(raster, right, height / 2) - grey(raster, left, height / 2)), 0.1)
        << "from the front the patient's left is on the right";
    EXPECT_NEAR(grey(raster, left, height / 2), grey(raster, left, height / 2 + 3), 0.02)
        << "nothing is there";
  }
}

TEST(BeatingSceneGui, ASurfaceThatIsTurnedInwardIsShownFromOutsideTooAndInnerSidesAreDarker) {
  REQUIRE_OPENGL();
  const TriMesh outward = ball(10.0);
  TriMesh inward = outward, inner_side = outward;
  for (auto& t : inward.triangles) std::swap(t[1], t[2]);
  // A half that is open to the front, and cannot be closed since two of its holes touch in a point.
  std::erase_if(inner_side.triangles, [&](const geometry::Triangle& t) {
    return outward.points[static_cast<std::size_t>(t[0])].y() < 0.0;
  });
  const std::int32_t border = geometry::boundary_loops(inner_side).front().front();
  const auto next = static_cast<std::int32_t>(inner_side.points.size());
  inner_side.points.insert(inner_side.points.end(), {Vec3(0, 30, 0), Vec3(1, 30, 0)});
  inner_side.triangles.push_back({border, next, next + 1});
  Camera camera;
  camera.half_height_mm = 30.0;
  std::vector<double> bright;
  Offscreen offscreen(width, height);
  for (const TriMesh& mesh : {outward, inward, inner_side}) {
    const auto motion = moved_by(mesh, 1, [](const Vec3& p) { return p; });
    const ShownSurface shown = shown_surface(mesh, motion.grid);
    EXPECT_EQ(shown.closed, mesh.points.size() == outward.points.size());
    BeatingScene scene(shown, motion::MovingCage(motion));
    offscreen.bind();
    scene.draw(camera, {}, whole);
    bright.push_back(offscreen.read().pixel(width / 2, height / 2)[0] / 255.0);
  }
  EXPECT_GT(bright[0], 0.6);
  EXPECT_NEAR(bright[1], bright[0], 0.01);
  EXPECT_GT(bright[2], 0.2);
  EXPECT_LT(bright[2], 0.8 * bright[0]);
}

TEST(BeatingSceneGui, RefusesWhatDoesNotFit) {
  REQUIRE_OPENGL();
  EXPECT_THROW(Offscreen(8, 100), InvalidInput);
  EXPECT_THROW(Offscreen(100, 100000), InvalidInput);
  const Heart h;
  Offscreen offscreen(width, height);
  BeatingScene scene(h.shown, h.cage);
  EXPECT_THROW(scene.set_bending({2, {1.0F, 2.0F}}), InvalidInput);
  EXPECT_THROW(scene.set_directions({{1.0F, 0.0F, 0.0F}}), InvalidInput);
}

}  // namespace
}  // namespace ostia::glview
