#include "ostia/lumen/lumen_model.h"

#include "vessel_trees.h"

#include "ostia/core/error.h"
#include "ostia/lumen/start_surface.h"

#include <gtest/gtest.h>

#include <functional>

namespace ostia::lumen {
namespace {

using testing::straight_vessel;
using testing::tree_of;

geometry::VesselTree junction() {
  return tree_of(geometry::y_junction(15.0, 12.0, 1.8, 1.4, 70.0, 0.25));
}

TEST(LumenModel, OwnersAreTheFirstVesselsOnTheWay) {
  const auto tree = tree_of(geometry::coronary_like_tree(0.25));
  ASSERT_EQ(tree.vessels.size(), 4U);
  const std::int32_t trunk = tree.vessels[0].id, first = tree.vessels[1].id, third = tree.vessels[3].id;
  EXPECT_DOUBLE_EQ(own_from_mm(tree, trunk), 0.0);
  EXPECT_NEAR(own_from_mm(tree, first), 10.0, 0.2);
  EXPECT_NEAR(own_from_mm(tree, tree.vessels[2].id), 26.0, 0.2);
  EXPECT_NEAR(own_from_mm(tree, third), 42.0, 0.2);
  EXPECT_EQ(owner_at(tree, first, 3.0), trunk);
  EXPECT_EQ(owner_at(tree, first, 9.0), trunk);
  EXPECT_EQ(owner_at(tree, first, 11.0), first);
  EXPECT_EQ(owner_at(tree, third, 41.0), trunk);
  EXPECT_EQ(owner_at(tree, third, 43.0), third);
  EXPECT_EQ(owner_at(tree, third, 1e3), third);
  EXPECT_EQ(owner_at(tree, third, -1.0), trunk);
  EXPECT_EQ(owner_at(tree, trunk, 50.0), trunk);
  EXPECT_THROW(owner_at(tree, 999, 1.0), InvalidInput);
  EXPECT_THROW(own_from_mm(tree, 999), InvalidInput);
}

TEST(LumenModel, AbscissasOfVesselsAgreeOnTheSharedWay) {
  const auto tree = junction();
  const LumenModel model = model_of_tubes(tree);
  const auto &a = *model.vessels[0]->axis, &b = *model.vessels[1]->axis;
  for (double s = 0.0; s < model.vessels[1]->own_from_mm; s += 0.7)
    EXPECT_LT((a.point(s) - b.point(s)).norm(), 1e-4);
  EXPECT_NEAR(model.vessels[1]->own_from_mm, 15.0, 1e-6);
}

TEST(LumenModel, UnknownVesselsAreNamed) {
  const LumenModel model = model_of_tubes(straight_vessel(15.0, 1.0));
  EXPECT_EQ(vessel(model, 4).vessel, 4);
  try {
    vessel(model, 17);
    FAIL();
  } catch (const InvalidInput& error) {
    EXPECT_NE(std::string(error.what()).find("17"), std::string::npos);
  }
}

/// A model with one thing changed in its first vessel.
LumenModel altered(const LumenModel& model, const std::function<void(VesselLumen&)>& change) {
  LumenModel other = model;
  auto lumen = std::make_shared<VesselLumen>(*model.vessels[0]);
  change(*lumen);
  other.vessels[0] = lumen;
  return other;
}

TEST(LumenModel, EqualDigestsAreEqualModels) {
  const LumenModel model = model_of_tubes(junction());
  EXPECT_EQ(digest(model), digest(model_of_tubes(junction())));
  const std::string before = digest(model);
  EXPECT_EQ(before.size(), 64U);
  std::vector<LumenModel> others(8, model);
  others[0].next_sample_id += 1;
  others[1].next_tree_id += 1;
  others[2].blend.width_mm = std::nextafter(others[2].blend.width_mm, 1.0);
  others[3].blend.joints = JointShape::sharp;
  others[4].tree.vessels[0].name += "x";
  others[5].tree.segments[0].axis.radius[3] = std::nextafter(others[5].tree.segments[0].axis.radius[3], 0.0);
  others[6].tree.segments[1].axis.frames[2].normal *= 1.0 + 1e-15;
  others[7].tree.nodes[0].position.y() += 1e-300;
  const auto with = [&](const std::function<void(VesselLumen&)>& change) {
    others.push_back(altered(model, change));
  };
  with([](VesselLumen& v) { v.samples[5].position.x() = std::nextafter(v.samples[5].position.x(), 99.0); });
  with([](VesselLumen& v) { v.samples[5].normal.z() += 1e-16 + 1e-9; });
  with([](VesselLumen& v) { v.samples[5].s_mm += 1e-9; });
  with([](VesselLumen& v) { v.samples[5].origin = SampleOrigin::edit; });
  with([](VesselLumen& v) { v.samples[5].id += 1000; });
  with([](VesselLumen& v) { v.samples.pop_back(); });
  with([](VesselLumen& v) { v.own_from_mm += 1e-9; });
  with([](VesselLumen& v) { v.interpolation.kernel = Kernel::morse_c0; });
  with([](VesselLumen& v) { v.interpolation.support_radius_mm += 1e-9; });
  with([](VesselLumen& v) { v.interpolation.offset_mm += 1e-9; });
  with([](VesselLumen& v) { v.interpolation.far_field = FarField::linear; });
  for (std::size_t i = 0; i < others.size(); ++i) EXPECT_NE(digest(others[i]), before) << i;
}

TEST(LumenModel, FaultsAreNamed) {
  const LumenModel model = model_of_tubes(junction());
  ASSERT_EQ(find_fault(model), std::nullopt);
  const auto expect = [](const LumenModel& other, const std::string& word) {
    const auto fault = find_fault(other);
    ASSERT_TRUE(fault) << word;
    EXPECT_NE(fault->find(word), std::string::npos) << *fault;
  };
  expect(altered(model, [](VesselLumen& v) { std::swap(v.samples[3], v.samples[40]); }), "order");
  expect(altered(model, [](VesselLumen& v) { v.samples[3].normal *= 1.1; }), "unit");
  expect(altered(model, [](VesselLumen& v) { v.samples[3].position.x() = std::nan(""); }), "finite");
  expect(altered(model, [](VesselLumen& v) { v.samples[3].id = v.samples[2].id; }), "two samples");
  expect(altered(model, [](VesselLumen& v) { v.samples.clear(); }), "no samples");
  expect(altered(model, [](VesselLumen& v) { v.axis = nullptr; }), "no axis");
  expect(altered(model, [](VesselLumen& v) { v.own_from_mm = 2.0; }), "2.0");
  expect(altered(model, [&](VesselLumen& v) { v.axis = model.vessels[1]->axis; }), "axis");
  LumenModel other = model;
  other.next_sample_id = 10;
  expect(other, "below");
  other = model;
  other.next_tree_id = 3;
  expect(other, "below");
  other = model;
  other.vessels.pop_back();
  expect(other, "1");
  other = model;
  std::swap(other.vessels[0], other.vessels[1]);
  expect(other, "place");
  other = model;
  other.tree.segments[0].to = 99;
  expect(other, "99");
}

}  // namespace
}  // namespace ostia::lumen
