#include "ostia/solver/velocity_profile.h"

#include "solver_test_support.h"

#include "ostia/solver/womersley.h"

namespace ostia::solver {

/// Points at r = i / rings on rings of 6 i; rings joined by triangles, or the outermost by quadrilaterals to
/// a further ring of as many points.
geometry::MixedMesh disc(double a_mm, double b_mm, int rings, bool quads) {
  geometry::MixedMesh mesh;
  const double outermost = quads ? rings + 0.5 : rings;
  const auto add_ring = [&](double r, int count) {
    for (int k = 0; k < count; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / count;
      mesh.points.emplace_back(a_mm * r / outermost * std::cos(angle), b_mm * r / outermost * std::sin(angle),
                               0.0);
    }
  };
  mesh.points.emplace_back(0.0, 0.0, 0.0);
  for (int i = 1; i <= rings; ++i) add_ring(i, 6 * i);
  const auto start = [](int i) { return i == 0 ? 0 : 1 + 3 * i * (i - 1); };
  const auto point = [&](int i, int k) { return i == 0 ? 0 : start(i) + k % (6 * i); };
  for (int i = 1; i <= rings; ++i)
    for (int sector = 0; sector < 6; ++sector)
      for (int k = 0; k < i; ++k) {
        const int outer = sector * i + k, inner = sector * (i - 1) + k;
        mesh.triangles.push_back({point(i - 1, inner), point(i, outer + 1), point(i, outer)});
        if (k + 1 < i)
          mesh.triangles.push_back({point(i - 1, inner), point(i - 1, inner + 1), point(i, outer + 1)});
      }
  if (quads) {
    const int count = 6 * rings, first = start(rings), second = static_cast<int>(mesh.points.size());
    add_ring(outermost, count);
    for (int k = 0; k < count; ++k)
      mesh.quads.push_back({first + k, first + (k + 1) % count, second + (k + 1) % count, second + k});
  }
  mesh.triangle_face_ids.assign(mesh.triangles.size(), 2);
  mesh.quad_face_ids.assign(mesh.quads.size(), 2);
  mesh.faces = {{2, "inlet_a", geometry::FaceKind::inlet}};
  return mesh;
}

namespace {

using geometry::Vec3;

TEST(Section, HasAreaNormalAndFacetsInTheOrderOfExports) {
  const geometry::MixedMesh mesh = disc(1.5, 1.5, 12, true);
  const Section section = section_of(mesh, 2);
  EXPECT_EQ(section.facets.size(), mesh.triangles.size() + mesh.quads.size());
  EXPECT_LT(section.facets[0][3], 0);
  EXPECT_GE(section.facets.back()[3], 0);
  const double polygon = 36.0 * 1.5 * 1.5 * std::sin(2.0 * std::numbers::pi / 72.0);
  EXPECT_NEAR(section.area_mm2, polygon, 1e-12);
  EXPECT_NEAR(section.normal.z(), -1.0, 1e-12);
  EXPECT_NEAR(section.diameter_mm(), 3.0, 0.004);
  expect_refusal([&] { section_of(mesh, 3); }, {"face 3"});
}

TEST(DevelopedProfile, IsPoiseuillesOnACircle) {
  for (const bool quads : {false, true}) {
    double before = 0.0;
    for (const int rings : {4, 8, 16}) {
      const Section section = section_of(disc(1.5, 1.5, rings, quads), 2);
      const DevelopedProfile profile = developed_profile(section);
      double worst = 0.0;
      for (std::size_t f = 0; f < section.facets.size(); ++f) {
        // The mean of the parabola over a facet, by the middles of its triangles' edges.
        double mean = 0.0, area = 0.0;
        const auto add = [&](std::size_t i, std::size_t j, std::size_t k) {
          const auto p = [&](std::size_t c) {
            return section.points[static_cast<std::size_t>(section.facets[f][c])];
          };
          const double own = (p(j) - p(i)).cross(p(k) - p(i)).norm();
          for (const Vec3& m : {Vec3((p(i) + p(j)) / 2), Vec3((p(j) + p(k)) / 2), Vec3((p(k) + p(i)) / 2)})
            mean += own / 3.0 * 2.0 * (1.0 - m.squaredNorm() / (1.5 * 1.5));
          area += own;
        };
        add(0, 1, 2);
        if (section.facets[f][3] >= 0) add(0, 2, 3);
        worst = std::max(worst, std::abs(profile.relative[f] - mean / area));
      }
      if (before > 0.0) {
        EXPECT_LT(worst, before / 3.0) << rings;  // second order: the polygon's
      }
      before = worst;
      EXPECT_NEAR(profile.largest, 2.0, 0.2 / rings);
    }
    EXPECT_LT(before, 0.005);
  }
}

TEST(DevelopedProfile, IsTheEllipsesOnAnEllipse) {
  const Section section = section_of(disc(2.0, 1.0, 16), 2);
  const DevelopedProfile profile = developed_profile(section);
  for (std::size_t f = 0; f < section.facets.size(); ++f) {
    const Vec3& c = section.centres[f];
    const double square = c.x() * c.x() / 4.0 + c.y() * c.y();
    EXPECT_NEAR(profile.relative[f], 2.0 * (1.0 - square), 0.02);
    EXPECT_NEAR(profile.radius[f] * profile.radius[f], square, 0.02);
  }
}

TEST(DevelopedProfile, OnASquareMeetsThePublishedMaximum) {
  // Largest over mean velocity in a square duct: 2.0962 (Shah and London 1978).
  geometry::MixedMesh mesh;
  constexpr int n = 16;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) mesh.points.emplace_back(double(i), 0.0, double(j));
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int v = j * (n + 1) + i;
      mesh.quads.push_back({v, v + 1, v + n + 2, v + n + 1});
    }
  mesh.quad_face_ids.assign(mesh.quads.size(), 5);
  const DevelopedProfile profile = developed_profile(section_of(mesh, 5));
  EXPECT_NEAR(profile.largest, 2.0962, 0.0005);
  // Fanning's friction factor times Reynolds number is 14.227 there: the mean of w is side^2 / (2 x 14.227).
  EXPECT_NEAR(profile.conductance_mm2, n * n / (2.0 * 14.227), 0.02);
}

TEST(DevelopedProfile, RefusesASectionWithoutRoom) {
  geometry::MixedMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  mesh.triangle_face_ids = {2};
  expect_refusal([&] { developed_profile(section_of(mesh, 2)); }, {"finer"});
}

TEST(OscillatingProfile, IsWomersleysOnACircleAndTheParabolaWhenSlow) {
  const Section section = section_of(disc(1.5, 1.5, 20, true), 2);
  const DevelopedProfile developed = developed_profile(section);
  constexpr double nu = 3.3;
  for (const double alpha : {3.0, 10.0}) {
    const auto profile = oscillating_profile(section, developed, alpha * alpha * nu / (1.5 * 1.5), nu);
    for (std::size_t f = 0; f < profile.size(); ++f) {
      const double s = std::min(1.0, section.centres[f].norm() / 1.5);
      EXPECT_LT(std::abs(profile[f] - womersley_profile(alpha, s)), 0.02) << alpha << " at " << s;
    }
  }
  const auto slow = oscillating_profile(section, developed, 1e-9, nu);
  for (std::size_t f = 0; f < slow.size(); ++f)
    EXPECT_NEAR(std::abs(slow[f] - developed.relative[f]), 0.0, 1e-6);
}

TEST(InwardVelocities, CarryExactlyTheFlow) {
  const Section section = section_of(disc(2.0, 1.0, 6, true), 2);
  const DevelopedProfile developed = developed_profile(section);
  const auto velocities = inward_velocities(section, developed.relative, 750.0);
  double flow = 0.0;
  std::complex<double> mean = 0.0;
  const auto mode = oscillating_profile(section, developed, 60.0, 3.3);
  for (std::size_t f = 0; f < velocities.size(); ++f) {
    flow += velocities[f].dot(section.area_vectors_mm2[f]);
    mean += mode[f] * section.area_vectors_mm2[f].dot(section.normal) / section.area_mm2;
    EXPECT_LE(velocities[f].dot(section.normal), 0.0);
  }
  EXPECT_NEAR(flow, -750.0, 1e-9);
  EXPECT_LT(std::abs(mean - 1.0), 1e-12);
  expect_refusal([&] { inward_velocities(section, {1.0}, 1.0); }, {"profile of 1"});
}

}  // namespace
}  // namespace ostia::solver
