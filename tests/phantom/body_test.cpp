#include "ostia/phantom/body.h"

#include "ostia/core/error.h"
#include "ostia/phantom/noise.h"
#include "ostia/phantom/vessel_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace ostia::phantom {
namespace {

struct Chest {
  explicit Chest(std::uint64_t seed)
      : heart(draw_heart(seed)),
        tree(draw_coronaries(heart, {.seed = seed})),
        body(heart, tree, draw_body(seed)) {}
  HeartShape heart;
  CoronaryTree tree;
  Body body;
};

const Chest& chest() {
  static const Chest made(1);
  return made;
}

Vec3 place_in(const geometry::Box3& box, std::uint64_t seed, std::uint64_t index) {
  Vec3 p;
  for (int axis = 0; axis < 3; ++axis)
    p[axis] =
        box.min()[axis] + box.sizes()[axis] * uniform(seed, 3 * index + static_cast<std::uint64_t>(axis));
  return p;
}

const geometry::Box3 field_of_view(Vec3(-76, -97, -72), Vec3(102, 82, 62));

TEST(Body, KnownPlacesBearTheirTissue) {
  const Chest& c = chest();
  const HeartShape& h = c.heart;
  const auto local = [&](double right, double up, double along) {
    return Vec3(h.base + right * h.right + up * h.up + along * h.long_axis);
  };
  const auto label = [&](const Vec3& p) { return c.body.at(p).label; };
  EXPECT_EQ(label(local(-12, 0, 35)), Label::left_ventricle);
  EXPECT_EQ(label(h.base + (h.length_mm - 4.0) * h.long_axis), Label::myocardium);
  EXPECT_EQ(label(local(-36, 0, 30)), Label::myocardium);  // lateral wall
  EXPECT_EQ(label(local(29, 0, 25)), Label::right_ventricle);
  EXPECT_EQ(label(local(-17, -9, -22)), Label::left_atrium);
  EXPECT_EQ(label(local(34, -7, -26)), Label::right_atrium);
  const AorticRoot& root = h.root;
  for (const Vec3& sinus : {root.left_sinus, root.right_sinus}) {
    const Vec3 middle = root.annulus + 0.62 * root.sinus_height_mm * root.axis;
    EXPECT_EQ(label(middle + (root.sinus_radius_mm - 2.0) * sinus), Label::aorta);
    const Vec3 beyond = middle + (root.sinus_radius_mm + 3.5) * sinus;
    EXPECT_NE(label(beyond), Label::aorta);
  }
  EXPECT_EQ(label({16, 72, -20}), Label::aorta);  // descending
  EXPECT_EQ(label({-70, 30, 0}), Label::lung);
  EXPECT_EQ(label({-8, 84, -4}), Label::marrow);
  EXPECT_EQ(label({-50, 8, -90}), Label::liver);
  EXPECT_EQ(label({4, 62, 0}), Label::oesophagus);
  EXPECT_EQ(label({0, -400, 0}), Label::outside_air);
}

TEST(Body, ArteriesHaveTheirMaterialAndLieInFatOrWall) {
  const Chest& c = chest();
  const VesselField field(c.tree);
  for (const CoronaryVessel& vessel : c.tree.vessels) {
    for (std::size_t i = 100; i + 20 < vessel.axis.size(); i += 25) {
      const Material m = c.body.at(vessel.axis.points[i]);
      EXPECT_EQ(m.label, Label::coronary_lumen) << vessel.name << " at point " << i;
      EXPECT_GT(m.hu, 250.0f);
      if (vessel.name.starts_with("S")) continue;  // in the septum
      // Just outside the wall lies neither a chamber nor the lung.
      for (int k = 0; k < 8; ++k) {
        const double theta = k * M_PI / 4.0;
        const geometry::Frame& f = vessel.axis.frames[i];
        const double r = vessel.wall.at(vessel.axis.abscissa[i], theta) + 0.4;
        const Vec3 p =
            vessel.axis.points[i] + r * (std::cos(theta) * f.normal + std::sin(theta) * f.binormal);
        const Label beside = c.body.at(p).label;
        const std::set<Label> allowed{Label::epicardial_fat, Label::vessel_wall,    Label::coronary_lumen,
                                      Label::soft_plaque,    Label::fibrous_plaque, Label::calcified_plaque,
                                      Label::coronary_vein};
        if (vessel.axis.abscissa[i] < 15.0) continue;  // the aorta is beside the origins
        EXPECT_TRUE(allowed.count(beside) > 0)
            << vessel.name << " s " << vessel.axis.abscissa[i] << ": label " << static_cast<int>(beside);
      }
    }
  }
}

TEST(Body, ContrastFallsAlongTheArteries) {
  const Chest& c = chest();
  for (const CoronaryVessel& vessel : c.tree.vessels) {
    if (vessel.parent >= 0) continue;
    const float near_ostium = c.body.at(vessel.axis.points[60]).hu;
    const float distal = c.body.at(vessel.axis.points[vessel.axis.size() - 60]).hu;
    EXPECT_GT(near_ostium, distal) << vessel.name;
  }
}

TEST(Body, VeinsKeepAGapFromArteries) {
  const Chest& c = chest();
  const VesselField field(c.tree);
  int met = 0;
  for (std::uint64_t i = 0; i < 400000; ++i) {
    const Vec3 p = place_in(field_of_view, 77, i);
    if (std::abs(c.heart.epicardial_distance(p)) > 15.0) continue;
    if (c.body.at(p).label != Label::coronary_vein) continue;
    ++met;
    EXPECT_GT(field.value(Boundary::wall, p, 5.0), 0.75);
  }
  EXPECT_GT(met, 50);
}

TEST(Body, APartAgreesWithALargerPart) {
  const Chest& c = chest();
  for (std::uint64_t b = 0; b < 300; ++b) {
    const Vec3 corner = place_in(field_of_view, 5, b);
    const geometry::Box3 small(corner, corner + Vec3::Constant(5.0));
    const geometry::Box3 large(corner - Vec3(9, 14, 4), corner + Vec3(12, 8, 21));
    const auto one = c.body.part(small), other = c.body.part(large);
    const auto all = one->uniform();
    for (std::uint64_t i = 0; i < 60; ++i) {
      const Vec3 p = place_in(small, 100 + b, i);
      const Material m = one->at(p), n = other->at(p);
      ASSERT_EQ(m.label, n.label) << p.transpose();
      ASSERT_EQ(m.hu, n.hu) << p.transpose();
      if (all) {
        ASSERT_EQ(all->label, m.label);
        ASSERT_EQ(all->hu, m.hu);
      }
    }
  }
}

TEST(Body, FarOutsideIsOneMaterial) {
  const auto part = chest().body.part({Vec3(0, -500, 0), Vec3(5, -495, 5)});
  ASSERT_TRUE(part->uniform().has_value());
  EXPECT_EQ(part->uniform()->label, Label::outside_air);
}

TEST(Body, IsFineNearArteries) {
  const Chest& c = chest();
  const Vec3 on = c.tree.vessels.front().axis.points[200];
  const auto part = c.body.part({on - Vec3::Constant(3), on + Vec3::Constant(3)});
  EXPECT_TRUE(part->fine_near(on, 0.3));
  const Vec3 lung(-70, 30, 0);
  EXPECT_FALSE(c.body.part({lung - Vec3::Ones(), lung + Vec3::Ones()})->fine_near(lung, 0.3));
}

TEST(Body, TheSameSeedGivesTheSameAndAnotherSeedAnother) {
  const Chest again(1), other(2);
  int different = 0;
  for (std::uint64_t i = 0; i < 400; ++i) {
    const Vec3 p = place_in(field_of_view, 9, i);
    const Material a = chest().body.at(p), b = again.body.at(p);
    ASSERT_EQ(a.label, b.label);
    ASSERT_EQ(a.hu, b.hu);
    different += other.body.at(p).hu != a.hu ? 1 : 0;
  }
  EXPECT_GT(different, 200);
}

TEST(Body, ChambersHaveNormalVolumes) {
  const Chest& c = chest();
  int left = 0, right = 0, atrium = 0;
  const std::uint64_t count = 60000;
  for (std::uint64_t i = 0; i < count; ++i) {
    const Label label = c.body.at(place_in(field_of_view, 21, i)).label;
    left += label == Label::left_ventricle;
    right += label == Label::right_ventricle;
    atrium += label == Label::left_atrium;
  }
  const double ml = field_of_view.volume() / 1000.0 / static_cast<double>(count);
  EXPECT_NEAR(left * ml, 105.0, 45.0);
  EXPECT_NEAR(right * ml, 90.0, 50.0);
  EXPECT_NEAR(atrium * ml, 85.0, 35.0);
}

TEST(Body, RejectsOptionsOutOfRange) {
  const Chest& c = chest();
  BodyOptions options;
  options.texture = 4.0;
  EXPECT_THROW(Body(c.heart, c.tree, options), InvalidInput);
  options.texture = 1.0;
  options.hu.fat = std::nanf("");
  EXPECT_THROW(Body(c.heart, c.tree, options), InvalidInput);
  options.hu.fat = -100.0f;
  options.hu.coronary_drop = 1.0f;
  EXPECT_THROW(Body(c.heart, c.tree, options), InvalidInput);
}

}  // namespace
}  // namespace ostia::phantom
