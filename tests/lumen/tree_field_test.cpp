#include "ostia/lumen/tree_field.h"

#include "formula_fields.h"
#include "vessel_trees.h"

#include "ostia/core/error.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/lumen/start_surface.h"
#include "ostia/lumen/tree_surface.h"

#include <gtest/gtest.h>

#include <map>
#include <numbers>
#include <random>

namespace ostia::lumen {
namespace {

using test::ball;
using test::capsule;

using Branches = std::vector<std::shared_ptr<const ScalarField>>;
constexpr double width = 0.25;

std::vector<Vec3> places_in(const Box3& box, std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<Vec3> places;
  for (std::size_t i = 0; i < count; ++i) {
    Vec3 p;
    for (int a = 0; a < 3; ++a)
      p[a] = box.min()[a] + box.sizes()[a] * (static_cast<double>(random()) / 4294967295.0);
    places.push_back(p);
  }
  return places;
}

Branches fork() {
  return {capsule({0, 0, -9}, {0, 0, 9}, 1.6), capsule({0, 0, -2}, {7, 0, 5}, 1.1),
          capsule({0, 0, -4}, {-6, 2, 2}, 0.8)};
}
double least(const Branches& branches, const Vec3& place) {
  double f = 1e9;
  for (const auto& branch : branches) f = std::min(f, branch->value(place));
  return f;
}

TEST(FieldFunction, IsEquationFour) {
  EXPECT_DOUBLE_EQ(field_function(-3.0, 0.5), -1.0);
  EXPECT_DOUBLE_EQ(field_function(-0.5, 0.5), -1.0);
  EXPECT_DOUBLE_EQ(field_function(-0.25, 0.5), -0.75);
  EXPECT_DOUBLE_EQ(field_function(0.0, 0.5), -0.5);
  EXPECT_DOUBLE_EQ(field_function(0.25, 0.5), -0.25);
  EXPECT_DOUBLE_EQ(field_function(0.5, 0.5), 0.0);
  EXPECT_DOUBLE_EQ(field_function(9.0, 0.5), 0.0);
}

TEST(TreeField, SharpIsTheLeastFieldFunction) {
  const Branches branches = fork();
  const TreeField tree(branches, {width, JointShape::sharp});
  for (const Vec3& p : places_in(tree.box(), 20000, 1)) {
    double g = 0.0;
    for (const auto& branch : branches) g = std::min(g, field_function(branch->value(p), width));
    EXPECT_NEAR(tree.value(p), g + 0.5, 1e-15);
  }
}

TEST(TreeField, SmoothRemovesNothingAndIsSharpWhereOneWallAloneIsNear) {
  const Branches branches = fork();
  const TreeField sharp(branches, {width, JointShape::sharp}), smooth(branches, {width, JointShape::smooth});
  std::size_t fillets = 0, alone = 0;
  for (const Vec3& p : places_in({Vec3(-3, -2, -5), Vec3(4, 2, 4)}, 60000, 2)) {
    const double a = sharp.value(p), b = smooth.value(p);
    EXPECT_LE(b, a + 1e-15);
    EXPECT_GE(2.0 * width * b, 2.0 * width * a - 0.59 * width);
    // What becomes inside was never farther from the walls than this.
    if (b < 0.0 && a > 0.0) {
      EXPECT_LE(2.0 * width * a, 0.293 * width);
    }
    int near = 0;
    for (const auto& branch : branches) near += branch->value(p) < width ? 1 : 0;
    if (near < 2) {
      EXPECT_EQ(a, b);
      ++alone;
    } else if (b < a - 1e-6) {
      ++fillets;
    }
  }
  EXPECT_GT(fillets, 300u);
  EXPECT_GT(alone, 30000u);
}

TEST(TreeField, WallsAtRightAnglesGetAnArcOfRadiusW) {
  // Two flat walls: inside is x < 0 or y < 0.
  const auto half_space = [](int axis) {
    return std::make_shared<const test::Formula>([axis](const Vec3& p) { return p[axis]; },
                                                 [axis](const Vec3&) -> Vec3 { return Vec3::Unit(axis); },
                                                 Box3(Vec3::Constant(-5), Vec3::Constant(5)));
  };
  const TreeField tree(Branches{half_space(0), half_space(1)}, {width, JointShape::smooth});
  for (double angle = 0.0; angle <= 90.0; angle += 7.5) {
    const double a = angle * std::numbers::pi / 180.0;
    const Vec3 on_arc(width - width * std::cos(a), width - width * std::sin(a), 1.0);
    EXPECT_NEAR(tree.value(on_arc), 0.0, 1e-12) << angle;
  }
}

TEST(TreeField, ABranchInsideOrAlongAnotherDoesNotLiftItsWall) {
  const auto parent = capsule({0, 0, -9}, {0, 0, 9}, 1.5);
  std::size_t along = 0;
  // Along the wall from inside: concentric, touching, and leaving it by 5 to 15 degrees.
  for (const double radius : {0.8, 1.4, 1.49, 1.5}) {
    for (const double slope : {0.0, 0.0875, 0.27}) {
      const Vec3 from(1.5 - radius, 0, -1), to(1.5 - radius + 3.0 * slope, 0, 2);
      const TreeField tree(Branches{parent, capsule(from, to, radius)}, {width, JointShape::smooth});
      for (double z = -1.0; z <= 2.0; z += 0.05) {
        for (double turn = 0.0; turn < 6.28; turn += 0.05) {
          const Vec3 out(std::cos(turn), std::sin(turn), 0.0);
          const Vec3 above = 1.5 * out + Vec3(0, 0, z) + 0.005 * width * out;
          const double cosine = parent->gradient(above).dot(tree.branches()[1]->gradient(above));
          if (least(tree.branches(), above) > 0.0049 * width && cosine > 0.94) {
            ++along;
            EXPECT_GT(tree.value(above), 0.0) << above;
          }
        }
      }
    }
  }
  EXPECT_GT(along, 10000u);
}

TEST(TreeField, TheGradientIsTheSlopeOfTheValue) {
  for (const JointShape joints : {JointShape::sharp, JointShape::smooth}) {
    const TreeField tree(fork(), {width, joints});
    const double step = 1e-6;
    std::size_t checked = 0, off = 0;
    for (const Vec3& p : places_in({Vec3(-3, -2, -5), Vec3(4, 2, 4)}, 20000, 3)) {
      if (std::abs(tree.value(p)) > 0.45) continue;
      Vec3 slope;
      for (int a = 0; a < 3; ++a)
        slope[a] =
            (tree.value(p + step * Vec3::Unit(a)) - tree.value(p - step * Vec3::Unit(a))) / (2.0 * step);
      ++checked;
      off += (slope - tree.gradient(p)).norm() > 1e-3 ? 1 : 0;
    }
    EXPECT_GT(checked, 1000u);
    EXPECT_LE(off, checked / 500);  // across a crease the difference is neither side's slope
  }
}

TEST(TreeField, ManyAtOnceAreTheSameBits) {
  const TreeField tree(fork(), {width, JointShape::smooth});
  const std::vector<Vec3> places = places_in(tree.box(), 5000, 4);
  std::vector<double> many(places.size());
  tree.values(places, many);
  for (std::size_t i = 0; i < places.size(); ++i) EXPECT_EQ(many[i], tree.value(places[i]));
}

TEST(TreeField, AsksABranchInItsBoxAlone) {
  const auto near = ball({0, 0, 0}, 1.0), far = ball({50, 0, 0}, 1.0);
  const TreeField tree(Branches{near, far}, {width, JointShape::smooth});
  const std::vector<Vec3> places = places_in(near->box(), 1000, 5);
  std::vector<double> values(places.size());
  tree.values(places, values);
  for (const Vec3& p : places) tree.value(p);
  EXPECT_EQ(near->asked, 2000u);
  EXPECT_EQ(far->asked, 0u);
  EXPECT_EQ(tree.value({25, 0, 0}), 0.5);
  EXPECT_EQ(tree.gradient({25, 0, 0}), Vec3(Vec3::Zero()));
}

// The sharpest turn of the wall near a place: the largest angle between triangles on an edge, degrees.
double sharpest_turn(const geometry::TriMesh& mesh, const Box3& where) {
  std::map<std::pair<std::int32_t, std::int32_t>, Vec3> normals;
  double least_cosine = 1.0;
  for (const auto& t : mesh.triangles) {
    const auto at = [&](std::size_t c) { return mesh.points[static_cast<std::size_t>(t[c])]; };
    const Vec3 across = (at(1) - at(0)).cross(at(2) - at(0));
    if (across.norm() < 2e-4 || !where.contains(at(0))) continue;  // needles turn anyhow
    for (std::size_t c = 0; c < 3; ++c) {
      const auto edge = std::minmax(t[c], t[(c + 1) % 3]);
      const auto [other, first] = normals.emplace(edge, across.normalized());
      if (!first) least_cosine = std::min(least_cosine, other->second.dot(across.normalized()));
    }
  }
  return std::acos(least_cosine) * 180.0 / std::numbers::pi;
}

TEST(TreeField, AFilletTakesTheCreaseFromTheCrotchForLittleVolume) {
  const Branches branches{capsule({0, 0, -6}, {0, 0, 6}, 1.6), capsule({0, 0, 0}, {7, 0, 0}, 1.2)};
  const Box3 crotch(Vec3(1.2, -0.4, 1.0), Vec3(2.6, 0.4, 2.2));
  double volume[2], turn[2];
  const double fillet = 0.5;
  for (const JointShape joints : {JointShape::sharp, JointShape::smooth}) {
    TreeSurface surface({.cell_mm = 0.1});
    surface.build(std::make_shared<const TreeField>(branches, BlendOptions{fillet, joints}), {{1.6, 0, -4}});
    const geometry::TriMesh mesh = surface.mesh();
    const auto i = static_cast<std::size_t>(joints);
    volume[i] = geometry::volume(mesh);
    turn[i] = sharpest_turn(mesh, crotch);
  }
  EXPECT_GT(turn[0], 35.0);
  EXPECT_LT(turn[1], 0.6 * turn[0]);
  // Along a crease of length L at right angles the arc adds (1 - pi/4) w^2 L; here the crease is less than
  // 2 pi 1.6 mm long, and acute angles add up to twice that.
  EXPECT_GT(volume[1], volume[0] + 0.05);
  EXPECT_LT(volume[1], volume[0] + 2.0 * (1.0 - std::numbers::pi / 4.0) * fillet * fillet * 2.0 *
                                       std::numbers::pi * 1.6);
}

TEST(TreeField, FilletsOfSolvedVesselsStayAtTheJoint) {
  // A vessel's function is a constant of 0.25 mm far away, less than the wider w: it must not act there.
  const geometry::AnalyticShape shape = geometry::y_junction(12.0, 14.0, 1.6, 1.2, 70.0);
  LumenModel model = model_of_tubes(testing::tree_of(shape));
  std::vector<std::shared_ptr<const ImplicitSurface>> branches;
  for (const auto& vessel : model.vessels)
    branches.push_back(std::make_shared<const ImplicitSurface>(solve(*vessel)));
  ASSERT_EQ(branches.size(), 2u);
  for (const double w : {0.25, 1.0}) {
    const TreeField sharp(branches, {w, JointShape::sharp}), smooth(branches, {w, JointShape::smooth});
    std::size_t away = 0, filled = 0, all = 0;
    for (std::size_t i = 0; i < 2; ++i) {
      const geometry::TubeDistance other({{shape.tubes[0], shape.tubes[2 - i]}, shape.box});
      for (const SurfaceSample& sample : model.vessels[i]->samples) {
        const double lift = 2.0 * w * (sharp.value(sample.position) - smooth.value(sample.position));
        EXPECT_GE(lift, -1e-12);
        const bool far = i == 1 && other(sample.position) > 0.6;
        if (far) {
          EXPECT_LT(lift, 1e-3) << sample.position;
        }
        ++all;
        away += far ? 1 : 0;
        filled += lift > 1e-3 ? 1 : 0;
      }
    }
    EXPECT_GT(away, 100u);
    EXPECT_LT(filled * 5, all);
  }
}

TEST(TreeField, RefusesWhatIsNoTree) {
  EXPECT_THROW(TreeField(Branches{}, BlendOptions{}), InvalidInput);
  EXPECT_THROW(TreeField(Branches{nullptr}, BlendOptions{}), InvalidInput);
  for (const double w : {0.0, -1.0, 2.1, std::nan("")})
    EXPECT_THROW(TreeField(fork(), {w, JointShape::sharp}), InvalidInput);
}

}  // namespace
}  // namespace ostia::lumen
