#include "ostia/phantom/coronary_tree.h"

#include "hand_made_tree.h"

#include "ostia/core/error.h"
#include "ostia/geometry/polyline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace ostia::phantom {
namespace {

CoronaryTree drawn(std::uint64_t seed, double disease = 0.0) {
  return draw_coronaries(draw_heart(seed), {seed, disease});
}

const CoronaryVessel* find(const CoronaryTree& tree, const std::string& name) {
  for (const CoronaryVessel& v : tree.vessels) {
    if (v.name == name) return &v;
  }
  return nullptr;
}

class CoronaryTreeOfSeed : public ::testing::TestWithParam<int> {
 protected:
  CoronaryTree tree = drawn(static_cast<std::uint64_t>(GetParam()));
};

TEST_P(CoronaryTreeOfSeed, MainVesselsHaveUsualLengthsAndWidths) {
  const std::map<std::string, std::array<double, 4>> usual{// length, diameter at the beginning
                                                           {"LAD", {100, 160, 3.4, 5.6}},
                                                           {"LCX", {50, 160, 2.2, 5.2}},
                                                           {"RCA", {70, 210, 1.8, 5.2}}};
  for (const auto& [name, bounds] : usual) {
    const CoronaryVessel* v = find(tree, name);
    ASSERT_NE(v, nullptr) << name;
    EXPECT_GT(v->axis.abscissa.back(), bounds[0]) << name;
    EXPECT_LT(v->axis.abscissa.back(), bounds[1]) << name;
    EXPECT_GT(2.0 * v->healthy_radius_mm.front(), bounds[2]) << name;
    EXPECT_LT(2.0 * v->healthy_radius_mm.front(), bounds[3]) << name;
  }
  for (const CoronaryVessel& v : tree.vessels) {
    EXPECT_TRUE(std::is_sorted(v.healthy_radius_mm.rbegin(), v.healthy_radius_mm.rend())) << v.name;
    EXPECT_GE(v.healthy_radius_mm.back(), 0.35) << v.name;
    EXPECT_LE(v.healthy_radius_mm.back(), 0.85) << v.name;
  }
}

TEST_P(CoronaryTreeOfSeed, MurraysLawHoldsAtBranches) {
  for (const CoronaryVessel& child : tree.vessels) {
    if (child.parent < 0) continue;
    const CoronaryVessel& parent = tree.vessels[static_cast<std::size_t>(child.parent)];
    const auto radius = [&](double s) {
      const auto i = static_cast<std::size_t>(std::clamp(s / parent.axis.abscissa.back(), 0.0, 1.0) *
                                              static_cast<double>(parent.axis.size() - 1));
      return parent.healthy_radius_mm[i];
    };
    const bool crowded = std::any_of(tree.vessels.begin(), tree.vessels.end(), [&](const auto& other) {
      return other.parent == child.parent && other.id != child.id &&
             std::abs(other.parent_s_mm - child.parent_s_mm) < 8.0;
    });
    if (crowded || child.parent_s_mm + 6.0 > parent.axis.abscissa.back()) continue;
    const double before = radius(child.parent_s_mm - 1.5), after = radius(child.parent_s_mm + 5.5);
    // The taper over these seven millimetres comes on top.
    EXPECT_NEAR(std::cbrt(std::pow(child.healthy_radius_mm.front(), 3.0) + std::pow(after, 3.0)), before,
                0.12 * before)
        << child.name;
  }
}

TEST_P(CoronaryTreeOfSeed, BendsAreWideAndBranchesBeginOnTheirParents) {
  for (const CoronaryVessel& v : tree.vessels) {
    for (std::size_t i = 8; i + 8 < v.axis.size(); i += 4) {
      const Vec3 turn = v.axis.points[i + 8] - 2.0 * v.axis.points[i] + v.axis.points[i - 8];
      ASSERT_LT(turn.norm() / 0.64 * v.healthy_radius_mm[i], 1.0 / 2.5) << v.name;
    }
    for (std::size_t i = 0; i + 1 < v.axis.size(); ++i)
      ASSERT_NEAR((v.axis.points[i + 1] - v.axis.points[i]).norm(), 0.1, 2e-3);
    if (v.parent < 0) continue;
    const CoronaryVessel& parent = tree.vessels[static_cast<std::size_t>(v.parent)];
    EXPECT_NEAR((geometry::at_abscissa(parent.axis.points, v.parent_s_mm).point - v.axis.points[0]).norm(),
                0.0, 1e-6);
    EXPECT_GT(v.s_free_mm, 0.5) << v.name;
    EXPECT_LT(v.s_free_mm, 15.0) << v.name;
  }
}

TEST_P(CoronaryTreeOfSeed, VesselsDoNotTouchAwayFromBranches) {
  for (const CoronaryVessel& a : tree.vessels) {
    for (const CoronaryVessel& b : tree.vessels) {
      if (b.id <= a.id) continue;
      const bool siblings = a.parent >= 0 && a.parent == b.parent;
      const double skip = b.parent == a.id || siblings ? 12.0 : 0.0;
      for (std::size_t j = 0; j < b.axis.size(); j += 8) {
        if (b.axis.abscissa[j] < skip) continue;
        for (std::size_t i = 0; i < a.axis.size(); i += 8) {
          if (siblings && a.axis.abscissa[i] < skip) continue;
          const double walls = 1.2 * (a.healthy_radius_mm[i] + b.healthy_radius_mm[j]) + 0.5;
          ASSERT_GT((a.axis.points[i] - b.axis.points[j]).norm(), walls)
              << a.name << " at " << a.axis.abscissa[i] << ", " << b.name << " at " << b.axis.abscissa[j];
        }
      }
    }
  }
}

TEST_P(CoronaryTreeOfSeed, CoursesLieInTheFatOnTheHeart) {
  const HeartShape heart = draw_heart(static_cast<std::uint64_t>(GetParam()));
  for (const CoronaryVessel& v : tree.vessels) {
    if (v.name == "S1") continue;  // runs in the septum
    for (std::size_t i = 300; i < v.axis.size(); i += 10) {
      const double outwards = heart.epicardial_distance(v.axis.points[i]);
      ASSERT_GT(outwards, 0.2) << v.name << " at " << v.axis.abscissa[i];
      ASSERT_LT(outwards, 7.5) << v.name << " at " << v.axis.abscissa[i];
    }
  }
}

TEST_P(CoronaryTreeOfSeed, SegmentsCoverVesselsAndBearTheAhaNumbers) {
  std::array<int, 18> seen{};
  for (const CoronaryVessel& v : tree.vessels) {
    double reached = 0.0;
    for (const SegmentSpan& span : v.segments) {
      ASSERT_GE(span.aha, 1);
      ASSERT_LE(span.aha, 18);
      ++seen[static_cast<std::size_t>(span.aha) - 1];
      EXPECT_FALSE(span.name.empty());
      EXPECT_NEAR(span.s_from_mm, reached, 0.6) << v.name;
      reached = span.s_to_mm;
    }
    if (!v.segments.empty()) {
      EXPECT_NEAR(reached, v.axis.abscissa.back(), 0.6) << v.name;
    }
  }
  for (const int needed : {1, 2, 5, 6, 7, 11, 13}) EXPECT_EQ(seen[static_cast<std::size_t>(needed) - 1], 1);
  EXPECT_LE(*std::max_element(seen.begin(), seen.end()), 1);
}

TEST_P(CoronaryTreeOfSeed, AxesMakeASoundTree) {
  EXPECT_EQ(geometry::find_fault(vessel_tree(tree)), std::nullopt);
  EXPECT_EQ(geometry::roots(vessel_tree(tree)).size(), 2U);
}

INSTANTIATE_TEST_SUITE_P(Seeds, CoronaryTreeOfSeed, ::testing::Range(1, 21));

TEST(CoronaryTree, DominanceHasItsFrequencies) {
  std::array<int, 3> count{};
  constexpr int trees = 400;
  for (int seed = 1; seed <= trees; ++seed)
    ++count[static_cast<std::size_t>(drawn(static_cast<std::uint64_t>(seed)).dominance)];
  // 82, 9 and 9 of 100, within three standard deviations.
  EXPECT_NEAR(count[0], 328, 24);
  EXPECT_NEAR(count[1], 36, 18);
  EXPECT_NEAR(count[2], 36, 18);
}

TEST(CoronaryTree, DominanceDecidesWhoGivesThePosteriorDescending) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const CoronaryTree tree = drawn(seed);
    const CoronaryVessel* posterior = find(tree, "PDA");
    ASSERT_NE(posterior, nullptr) << seed;
    EXPECT_EQ(tree.vessels[static_cast<std::size_t>(posterior->parent)].name,
              tree.dominance == Dominance::left ? "LCX" : "RCA")
        << seed;
  }
}

TEST(CoronaryTree, SameSeedSameTreeAndOtherSeedAnother) {
  const CoronaryTree a = drawn(5, 1.0), b = drawn(5, 1.0), c = drawn(6, 1.0);
  ASSERT_EQ(a.vessels.size(), b.vessels.size());
  for (std::size_t i = 0; i < a.vessels.size(); ++i) {
    EXPECT_EQ(a.vessels[i].axis.points, b.vessels[i].axis.points);
    EXPECT_EQ(a.vessels[i].axis.radius, b.vessels[i].axis.radius);
    EXPECT_EQ(a.vessels[i].plaques.size(), b.vessels[i].plaques.size());
  }
  EXPECT_NE(a.vessels[0].axis.points, c.vessels[0].axis.points);
}

TEST(CoronaryTree, DiseaseOfZeroIsHealthyAndBadAmountsAreRefused) {
  for (const CoronaryVessel& v : drawn(4).vessels) EXPECT_TRUE(v.stenoses.empty() && v.plaques.empty());
  std::size_t lesions = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    for (const CoronaryVessel& v : drawn(seed, 1.0).vessels) {
      lesions += v.stenoses.size();
      for (std::size_t i = 0; i < v.axis.size(); i += 50) {
        for (double theta = 0.0; theta < 6.3; theta += 0.7)
          ASSERT_GT(v.wall.at(v.axis.abscissa[i], theta), v.lumen.at(v.axis.abscissa[i], theta));
      }
    }
  }
  EXPECT_GE(lesions, 20U);
  EXPECT_LE(lesions, 60U);
  EXPECT_THROW(draw_coronaries(draw_heart(1), {1, -1.0}), InvalidInput);
  EXPECT_THROW(draw_coronaries(draw_heart(1), {1, std::nan("")}), InvalidInput);
}

TEST(CoronaryLesion, IsAsNarrowAsAsked) {
  for (const double grade : {0.25, 0.5, 0.7, 0.9}) {
    for (const double length : {5.0, 12.0, 20.0}) {
      CoronaryTree tree = drawn(2);
      CoronaryVessel& lad = tree.vessels[0];
      ASSERT_EQ(lad.name, "LAD");
      LesionOptions lesion;
      lesion.s_throat_mm = 40.2;
      lesion.length_mm = length;
      lesion.diameter_stenosis = grade;
      lesion.eccentricity = std::min(0.6, 0.96 / grade - 1.0);
      lesion.theta = 1.0;
      lesion.remodelling = 1.15;
      add_lesion(lad, lesion);
      ASSERT_EQ(lad.stenoses.size(), 1U);
      const Stenosis& stenosis = lad.stenoses[0];
      EXPECT_NEAR(stenosis.diameter_stenosis, grade, 0.01);
      const auto i = static_cast<std::size_t>(std::lround(40.2 / 0.1));
      const double measured = 1.0 - lad.lumen.mean_at(lad.axis.abscissa[i]) / lad.healthy_radius_mm[i];
      EXPECT_NEAR(stenosis.diameter_stenosis, measured, 0.002);
      EXPECT_NEAR(lad.axis.radius[i], lad.lumen.mean_at(lad.axis.abscissa[i]), 1e-9);
      // Narrower on the plaque's side, and as before beyond the shoulders.
      EXPECT_LT(lad.lumen.at(40.2, 1.0), lad.lumen.at(40.2, 1.0 + std::numbers::pi));
      const std::size_t j = i + static_cast<std::size_t>(5.0 * length) + 25;
      EXPECT_NEAR(lad.lumen.mean_at(lad.axis.abscissa[j]), lad.healthy_radius_mm[j],
                  0.01 * lad.healthy_radius_mm[j]);
    }
  }
}

TEST(CoronaryLesion, KindsLeaveTheirPlaques) {
  for (const PlaqueKind kind :
       {PlaqueKind::soft, PlaqueKind::fibrous, PlaqueKind::mixed, PlaqueKind::calcified}) {
    CoronaryTree tree = drawn(2);
    LesionOptions lesion;
    lesion.s_throat_mm = 45.0;
    lesion.kind = kind;
    add_lesion(tree.vessels[0], lesion);
    const auto calcified = std::count_if(tree.vessels[0].plaques.begin(), tree.vessels[0].plaques.end(),
                                         [](const Plaque& p) { return p.kind == PlaqueKind::calcified; });
    EXPECT_EQ(calcified > 0, kind == PlaqueKind::mixed || kind == PlaqueKind::calcified);
    for (const Plaque& p : tree.vessels[0].plaques) {
      if (p.kind == PlaqueKind::calcified) {
        EXPECT_GE(p.hu, 300.0f);
        EXPECT_LE(p.hu, 1300.0f);
      } else {
        EXPECT_GE(p.hu, 10.0f);
        EXPECT_LE(p.hu, 130.0f);
      }
    }
  }
}

TEST(CoronaryLesion, BadOptionsAreNamed) {
  CoronaryTree tree = drawn(2);
  const auto refuse = [&](auto change) {
    LesionOptions lesion;
    lesion.s_throat_mm = 40.0;
    change(lesion);
    EXPECT_THROW(add_lesion(tree.vessels[0], lesion), InvalidInput);
    EXPECT_TRUE(tree.vessels[0].stenoses.empty());
  };
  refuse([](LesionOptions& l) { l.s_throat_mm = 3.0; });
  refuse([](LesionOptions& l) { l.s_throat_mm = 500.0; });
  refuse([](LesionOptions& l) { l.length_mm = 0.0; });
  refuse([](LesionOptions& l) { l.diameter_stenosis = 1.0; });
  refuse([](LesionOptions& l) { l.diameter_stenosis = std::nan(""); });
  refuse([](LesionOptions& l) { l.eccentricity = -0.1; });
  refuse([](LesionOptions& l) { l.remodelling = 2.0; });
  refuse([](LesionOptions& l) {
    l.diameter_stenosis = 0.8;
    l.eccentricity = 0.9;
  });
}

}  // namespace
}  // namespace ostia::phantom
