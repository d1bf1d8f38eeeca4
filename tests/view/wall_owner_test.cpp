#include "ostia/view/wall_owner.h"

#include "vessel_trees.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/lumen/start_surface.h"
#include "ostia/lumen/tree_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace ostia::view {
namespace {

using lumen::LumenModel;

LumenModel coronary_tree() {
  return lumen::model_of_tubes(lumen::testing::tree_of(geometry::coronary_like_tree()));
}

TEST(WallOwner, KnowsVesselAndAbscissaOfATube) {
  const LumenModel model = lumen::model_of_tubes(lumen::testing::straight_vessel(40.0, 2.0));
  const WallOwner owner(model);
  for (double z = 1.0; z < 39.0; z += 1.7) {
    const WallPlace place = owner.at(Vec3(1.2, -1.6, z));
    EXPECT_EQ(place.vessel, 4);
    EXPECT_NEAR(place.s_mm, z, 0.26);
    EXPECT_NEAR(place.radius_mm, 2.0, 0.02);
  }
}

TEST(WallOwner, OfATreeIsTheTubeThatTheWallBelongsTo) {
  const geometry::AnalyticShape shape = geometry::coronary_like_tree();
  const LumenModel model = coronary_tree();
  const WallOwner owner(model);
  // Places on one tube's wall that lie well clear of all others belong to the vessel with that tube's name.
  const geometry::TubeDistance distance(shape);
  int asked = 0;
  for (std::size_t t = 0; t < shape.tubes.size(); ++t) {
    geometry::AnalyticShape others = shape;
    others.tubes.erase(others.tubes.begin() + static_cast<std::ptrdiff_t>(t));
    const geometry::TubeDistance to_others(others);
    const geometry::Centerline& axis = shape.tubes[t].axis;
    for (std::size_t i = 0; i < axis.size(); i += 15) {
      const Vec3 place = axis.points[i] + axis.radius[i] * axis.frames[i].normal;
      if (std::abs(distance(place)) > 0.05 || to_others(place) < 0.6) continue;
      const WallPlace found = owner.at(place);
      const auto vessel = std::find_if(model.tree.vessels.begin(), model.tree.vessels.end(),
                                       [&](const auto& v) { return v.id == found.vessel; });
      ASSERT_NE(vessel, model.tree.vessels.end());
      EXPECT_EQ(vessel->name, shape.tubes[t].name);
      EXPECT_GE(found.s_mm, lumen::vessel(model, found.vessel).own_from_mm - 1e-9);
      ++asked;
    }
  }
  EXPECT_GT(asked, 80);
}

TEST(WallOwner, ManyPlacesAreAnsweredAsOneByOne) {
  const LumenModel model = coronary_tree();
  const WallOwner owner(model);
  std::vector<Vec3> places = lumen::surface_of(model, 0.6).points;
  std::mt19937 random(3);
  std::shuffle(places.begin() + static_cast<std::ptrdiff_t>(places.size() / 2), places.end(), random);
  const std::vector<WallPlace> together = owner.at(places);
  core::set_max_threads(1);
  const std::vector<WallPlace> alone = owner.at(places);
  core::set_max_threads(0);
  ASSERT_EQ(together.size(), places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    const WallPlace one = owner.at(places[i]);
    EXPECT_EQ(one.vessel, together[i].vessel);
    EXPECT_EQ(one.s_mm, together[i].s_mm);
    EXPECT_EQ(alone[i].s_mm, together[i].s_mm);
  }
}

TEST(WallOwner, FollowsAnEditWithWhatIsSharedKept) {
  const LumenModel model = coronary_tree();
  const WallOwner before(model);
  LumenModel edited = model;
  auto wider = std::make_shared<lumen::VesselLumen>(*model.vessels[1]);
  for (auto& sample : wider->samples)
    sample.position += 0.5 * (sample.position - wider->axis->point(sample.s_mm));
  edited.vessels[1] = wider;
  const WallOwner after(edited, &before), fresh(edited);
  for (const auto& vessel : edited.vessels) {
    const double s = vessel->axis->length() - 4.0;
    const Vec3 place = vessel->axis->place(s, 1.0, vessel->axis->radius(s));
    EXPECT_EQ(after.at(place).radius_mm, fresh.at(place).radius_mm);
    EXPECT_EQ(after.at(place).s_mm, fresh.at(place).s_mm);
  }
  const double s = wider->axis->length() - 4.0;
  const Vec3 place = wider->axis->place(s, 1.0, wider->axis->radius(s));
  EXPECT_NEAR(after.at(place).radius_mm, 1.5 * before.at(place).radius_mm, 0.02);
  EXPECT_THROW(WallOwner(LumenModel{}), InvalidInput);
}

}  // namespace
}  // namespace ostia::view
