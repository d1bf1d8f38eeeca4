#include "test_graphs.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/geometry/isosurface.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/reconstruction/surface.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace {

using namespace ostia;
using namespace ostia::reconstruction;
using geometry::Vec3;
using reconstruction::testing::tube;
using std::numbers::pi;

/// Semi-axes 2 and 1, the major one turned from y to z by 35 degrees: across a vessel along x.
const double radius = std::sqrt(2.0);
const Vec3 major(0.0, std::cos(35.0 * pi / 180.0), std::sin(35.0 * pi / 180.0));
const Vec3 minor(0.0, -major.z(), major.y());

/// How far from the axis in semi-axes: 1 on the elliptic cylinder along x.
double in_axes(const Vec3& p) {
  return std::hypot(p.dot(major) / 2.0, p.dot(minor));
}

EllipticSections same_everywhere(const geometry::VesselGraph& graph, double ratio, const Vec3& along) {
  return {{graph.edges.size(), {EllipticSection{ratio, along}, EllipticSection{ratio, along}}}};
}

ReconstructionOptions at_level(int level) {
  ReconstructionOptions options;
  options.level = level;
  return options;
}

/// Far enough from x = 0 and 20 to be neither cap nor rim.
bool on_wall(const Vec3& p) {
  return p.x() > 0.5 && p.x() < 19.5;
}

void expect_sound(const ReconstructedSurface& made) {
  const auto faults = geometry::find_faults(made.surface.mesh, true);
  EXPECT_TRUE(faults.closed_manifold()) << faults.summary();
  EXPECT_EQ(made.self_intersections, 0U);
  EXPECT_TRUE(made.narrowed.empty());
}

class EllipticLevels : public ::testing::TestWithParam<int> {};

TEST_P(EllipticLevels, AStraightTubeIsTheCylinder) {
  const auto graph = tube(20.0, radius, 3);
  // Of any length, and with a part along the vessel that does not count.
  const auto made = reconstruct_surface(graph, same_everywhere(graph, 0.5, 3.0 * major + Vec3::UnitX()),
                                        at_level(GetParam()));
  expect_sound(made);
  EXPECT_NEAR(geometry::volume(made.surface.mesh), 20.0 * 2.0 * pi, 1e-8);
  const double side = 2.0 * pi / (8 << GetParam()), scale = std::sqrt(side / std::sin(side));
  for (const Vec3& p : made.points) {
    if (on_wall(p)) {
      EXPECT_NEAR(in_axes(p), scale, 1e-9);
    }
  }
}

// The plane of the bend and the one across it stay apart: major semi-axes across the plane z = 0.
TEST_P(EllipticLevels, ABendDoesNotTwist) {
  geometry::VesselGraph graph;
  for (int i = 0; i <= 24; ++i) {
    const double t = 0.75 * pi * i / 24;
    graph.points.emplace_back(12.0 * std::cos(t), 12.0 * std::sin(t), 0.0);
    if (i > 0) graph.edges.push_back({i - 1, i, radius, radius});
  }
  const auto made =
      reconstruct_surface(graph, same_everywhere(graph, 0.5, Vec3::UnitZ()), at_level(GetParam()));
  expect_sound(made);
  const double side = 2.0 * pi / (8 << GetParam()), scale = std::sqrt(side / std::sin(side));
  std::size_t seen = 0;
  for (const Vec3& p : made.points) {
    const double t = std::atan2(p.y(), p.x());
    if (t < 0.1 || t > 0.75 * pi - 0.1) continue;
    EXPECT_NEAR(std::hypot(std::hypot(p.x(), p.y()) - 12.0, p.z() / 2.0), scale, 0.02 * scale);
    ++seen;
  }
  EXPECT_GT(seen, 60U);
}

// Half the way from an ellipse to the one at a right angle to it lies the circle, not the ellipse at 45
// degrees.
TEST_P(EllipticLevels, MatricesAreMixedAndNotAngles) {
  const auto graph = tube(20.0, radius);
  const EllipticSections sections{{{EllipticSection{0.5, major}, EllipticSection{0.5, minor}}}};
  const auto made = reconstruct_surface(graph, sections, at_level(GetParam()));
  expect_sound(made);
  const double side = 2.0 * pi / (8 << GetParam()), scale = std::sqrt(side / std::sin(side));
  for (const Vec3& p : made.points) {
    if (!on_wall(p)) continue;
    const double h = 0.5 * std::log(2.0) * (1.0 - p.x() / 10.0);  // of the logarithm, along `major`
    EXPECT_NEAR(std::hypot(p.dot(major) * std::exp(-h), p.dot(minor) * std::exp(h)), radius * scale, 1e-3);
  }
}

TEST_P(EllipticLevels, ForksStaySoundAndTheirBranchesElliptic) {
  const double side = 2.0 * pi / (8 << GetParam()), scale = std::sqrt(side / std::sin(side));
  for (const double degrees : {40.0, 60.0, 90.0, 130.0})
    for (const double ratio : {0.4, 0.6, 0.8}) {
      SCOPED_TRACE(std::to_string(degrees) + " degrees, ratio " + std::to_string(ratio));
      const auto graph = reconstruction::testing::side_branch(degrees, 0.6, 30.0);
      const auto made = reconstruct_surface(graph, same_everywhere(graph, ratio, Vec3(1.0, 2.0, 3.0)),
                                            at_level(GetParam()));
      expect_sound(made);
      EXPECT_TRUE(made.moved.empty());
      // The open end of the trunk, which lies along x.
      const Vec3 along = Vec3(0.0, 2.0, 3.0).normalized(), across(0.0, -along.z(), along.y());
      std::size_t seen = 0;
      for (const Vec3& p : made.points) {
        if (std::abs(p.x() - graph.points[0].x()) > 1e-9) continue;
        const double in_semi_axes =
            std::hypot(p.dot(along) * std::sqrt(ratio), p.dot(across) / std::sqrt(ratio));
        if (in_semi_axes < 0.9) continue;  // inside of the lid
        EXPECT_NEAR(in_semi_axes, scale, 1e-9);
        ++seen;
      }
      EXPECT_EQ(seen, static_cast<std::size_t>(8 << GetParam()));
    }
}

INSTANTIATE_TEST_SUITE_P(All, EllipticLevels, ::testing::Range(0, 3));

TEST(Elliptic, CirclesMakeTheSurfaceThatTheyMakeWithout) {
  for (const auto& graph : {tube(9.0, 1.0, 4), reconstruction::testing::torus(10.0, 1.0, 30),
                            reconstruction::testing::y_fork(50.0, 0.7)}) {
    const auto without = reconstruct_surface(graph, at_level(2));
    const auto with =
        reconstruct_surface(graph, same_everywhere(graph, 1.0, Vec3(1.0, 2.0, 3.0)), at_level(2));
    EXPECT_EQ(with.points, without.points);
    EXPECT_EQ(with.quads, without.quads);
  }
}

TEST(Elliptic, IsTheSameForAnyNumberOfThreads) {
  const auto graph = reconstruction::testing::y_fork(60.0, 0.8);
  const auto sections = same_everywhere(graph, 0.6, Vec3(1.0, 2.0, 3.0));
  core::set_max_threads(1);
  const auto alone = reconstruct_surface(graph, sections, at_level(2));
  core::set_max_threads(4);
  EXPECT_EQ(reconstruct_surface(graph, sections, at_level(2)).points, alone.points);
  core::set_max_threads(0);
}

TEST(Elliptic, RefusesSectionsThatDoNotFit) {
  const auto graph = tube(20.0, 1.0, 2);
  auto sections = same_everywhere(graph, 0.5, major);
  sections.of_edge.pop_back();
  EXPECT_THROW(reconstruct_surface(graph, sections), InvalidInput);
  sections = same_everywhere(graph, 0.5, major);
  sections.of_edge[1][0].ratio = 1.5;
  EXPECT_THROW(reconstruct_surface(graph, sections), InvalidInput);
  sections.of_edge[1][0] = {0.5, Vec3::Zero()};
  EXPECT_THROW(reconstruct_surface(graph, sections), InvalidInput);
}

/// The elliptic cylinder, with a round side branch along `out` in its middle where `branch` is its radius.
geometry::TriMesh wall(double branch) {
  const auto inside = [branch](const Vec3& p) {
    const Vec3 d = p - Vec3(10.0, 0.0, 0.0);
    const double beside = d.dot(minor) > 0.0 ? (d - d.dot(minor) * minor).norm() - branch : 1e3;
    return std::min(in_axes(p) - 1.0, beside);
  };
  return geometry::isosurface(inside, geometry::Box3(Vec3(-1.0, -3.0, -3.0), Vec3(21.0, 3.0, 3.0)), 0.1);
}

double degrees_between(const Vec3& a, const Vec3& b) {
  return std::acos(std::min(1.0, std::abs(a.normalized().dot(b.normalized())))) * 180.0 / pi;
}

// Radii that are off, as a skeleton's are, and an axis beside the middle.
TEST(SectionFit, FindsTheCylindersAxes) {
  auto graph = tube(20.0, 1.2, 5);
  for (Vec3& p : graph.points) p += 0.2 * minor;
  const FittedSections fit = fit_elliptic_sections(graph, wall(0.0));
  EXPECT_EQ(fit.used, fit.cut);
  EXPECT_GT(fit.used, 30U);
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    EXPECT_NEAR(fit.graph.edges[e].radius_from, radius, 0.005 * radius);
    for (const EllipticSection& section : fit.sections.of_edge[e]) {
      EXPECT_NEAR(section.ratio, 0.5, 0.01);
      EXPECT_LT(degrees_between(section.major, major), 1.0);
    }
  }
}

TEST(SectionFit, LeavesOutSectionsThatRunIntoABranch) {
  const auto graph = tube(20.0, 1.2, 10);
  const FittedSections fit = fit_elliptic_sections(graph, wall(1.0));
  EXPECT_LT(fit.used, fit.cut);
  EXPECT_GT(fit.used, fit.cut / 2);
  for (const auto& ends : fit.sections.of_edge)
    for (const EllipticSection& section : ends) {
      EXPECT_NEAR(section.ratio, 0.5, 0.05);
      EXPECT_LT(degrees_between(section.major, major), 3.0);
    }
}

double rms_off(const ReconstructedSurface& made) {
  double squares = 0.0, count = 0.0;
  for (const Vec3& p : made.points) {
    if (!on_wall(p)) continue;
    // Across the ellipse near its edge: the value by the gradient's length.
    const Vec3 gradient = (p.dot(major) / 4.0 * major + p.dot(minor) * minor) / in_axes(p);
    const double off = (in_axes(p) - 1.0) / gradient.norm();
    squares += off * off;
    count += 1.0;
  }
  return std::sqrt(squares / count);
}

TEST(SectionFit, TheirSurfaceIsNearerThanThatOfCircles) {
  const auto graph = tube(20.0, radius, 5);
  const FittedSections fit = fit_elliptic_sections(graph, wall(0.0));
  const double circles = rms_off(reconstruct_surface(fit.graph, at_level(2)));
  const double ellipses = rms_off(reconstruct_surface(fit.graph, fit.sections, at_level(2)));
  EXPECT_LT(ellipses, 0.02);
  EXPECT_GT(circles, 0.3);
}

TEST(SectionFit, KeepsABranchWithoutAnyGoodSection) {
  const auto graph = tube(20.0, 0.3, 3);  // a wall that is far wider
  const FittedSections fit = fit_elliptic_sections(graph, wall(0.0));
  EXPECT_EQ(fit.used, 0U);
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    EXPECT_EQ(fit.graph.edges[e].radius_to, 0.3);
    EXPECT_EQ(fit.sections.of_edge[e][0].ratio, 1.0);
  }
}

TEST(SectionFit, RefusesWhatItCannotCutAndCancels) {
  const auto graph = tube(20.0, 1.0);
  EXPECT_THROW(fit_elliptic_sections(graph, {}), InvalidInput);
  SectionFitOptions options;
  options.rays = 3;
  EXPECT_THROW(fit_elliptic_sections(graph, wall(0.0), options), InvalidInput);
  const core::TaskContext task;
  task.cancel();
  EXPECT_THROW(fit_elliptic_sections(graph, wall(0.0), {}, task), Cancelled);
}

}  // namespace
