#include "branches/line_derivatives.h"

#include "moving/smooth_cage.h"
#include "moving_shapes.h"

#include <gtest/gtest.h>

namespace ostia::analysis {
namespace {

using testing::Helix;

TEST(LineDerivatives, PolynomialsOfDegreeFiveAreExactAtTheEndsToo) {
  std::vector<double> s{0.0};
  while (s.back() < 20.0) s.push_back(s.back() + 0.3 + 0.2 * std::sin(3.0 * s.back()));
  std::vector<Vec3> values;
  const auto x = [](double t) { return t / 10.0 - 1.0; };
  for (const double t : s)
    values.emplace_back(std::pow(x(t), 5), std::pow(x(t), 3) - 2.0 * x(t), 4.0 + std::pow(x(t), 2));
  const auto d = LineDerivatives(s, 4.0)(values);
  for (std::size_t i = 0; i < s.size(); ++i) {
    const double t = x(s[i]);
    EXPECT_LT((d[0][i] - Vec3(5 * std::pow(t, 4), 3 * t * t - 2, 2 * t) / 10.0).norm(), 1e-10);
    EXPECT_LT((d[1][i] - Vec3(20 * t * t * t, 6 * t, 2) / 100.0).norm(), 1e-9);
    EXPECT_LT((d[2][i] - Vec3(60 * t * t, 6, 0) / 1000.0).norm(), 1e-8);
  }
}

TEST(LineDerivatives, AHelixBendsAndTurnsAsItsFormulaSays) {
  const Helix helix{8.0, testing::whole_turn / 60.0};
  const auto points = helix.points(40.0);
  std::vector<double> s;
  for (std::size_t i = 0; i < points.size(); ++i) s.push_back(0.5 * static_cast<double>(i));
  const auto d = LineDerivatives(s, 4.0)(points);
  for (std::size_t i = 0; i < s.size(); ++i) {
    const Vec3 across = d[0][i].cross(d[1][i]);
    EXPECT_NEAR(d[0][i].norm(), 1.0, 1e-5);
    EXPECT_NEAR(across.norm() / helix.curvature(), 1.0, 1e-3);
    EXPECT_NEAR(across.dot(d[2][i]) / across.squaredNorm() / helix.torsion(), 1.0, 5e-3);
  }
}

TEST(LineDerivatives, FewPointsMakeThePieceLonger) {
  const std::vector<double> s{0, 10, 20, 30, 40, 50};
  std::vector<Vec3> values;
  for (const double t : s) values.emplace_back(t, t * t, 0.0);
  const auto d = LineDerivatives(s, 1.0)(values);
  for (std::size_t i = 0; i < s.size(); ++i) {
    EXPECT_LT((d[0][i] - Vec3(1, 2 * s[i], 0)).norm(), 1e-9);
    EXPECT_LT((d[1][i] - Vec3(0, 2, 0)).norm(), 1e-9);
  }
}

geometry::CageGrid grid() {
  return geometry::cage_around({Vec3(-20, -10, -30), Vec3(20, 10, 30)}, 3);
}

TEST(SmoothCage, LinearDisplacementsStayAsTheyAreUpToTheBorder) {
  const SmoothCage cage(grid());
  const auto map = [](const Vec3& p) {
    return Vec3(1 + 0.1 * p.y(), -0.2 * p.x() + 0.3 * p.z(), 0.05 * p.x());
  };
  std::vector<Vec3> displacements;
  for (const Vec3& p : geometry::rest_points(grid())) displacements.push_back(map(p));
  const Vec3 least = grid().origin, size = grid().cells * grid().cell_mm;
  for (const double t : {0.0, 0.01, 0.37, 0.5, 0.99, 1.0})
    for (const double u : {0.0, 0.6, 1.0}) {
      const Vec3 p = least + size.cwiseProduct(Vec3(t, u, 1.0 - t));
      EXPECT_LT((cage.displacement(cage.weights(p), displacements) - map(p)).norm(), 1e-12);
    }
}

TEST(SmoothCage, HasNoKinkBetweenCells) {
  const SmoothCage cage(grid());
  std::vector<Vec3> displacements;
  for (const Vec3& p : geometry::rest_points(grid()))
    displacements.emplace_back(std::sin(0.1 * p.x()), std::cos(0.08 * p.x() * p.y()), 0.0);
  const double face = grid().origin.x() + 3.0 * grid().cell_mm.x(), h = 1e-3;
  const auto at = [&](double x) { return cage.displacement(cage.weights({x, 3.0, 4.0}), displacements); };
  const Vec3 before = (at(face) - at(face - h)) / h, after = (at(face + h) - at(face)) / h;
  EXPECT_LT((after - before).norm(), 1e-4);
  const Vec3 second = (at(face + 1.0) - 2.0 * at(face) + at(face - 1.0));
  EXPECT_GT(second.norm(), 1e-3);  // there is a bend that a kink could hide in
}

}  // namespace
}  // namespace ostia::analysis
