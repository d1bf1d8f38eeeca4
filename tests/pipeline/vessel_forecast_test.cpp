#include "ostia/pipeline/vessel_forecast.h"

#include "ostia/core/error.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/lumen/start_surface.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace ostia::pipeline {
namespace {

using geometry::Vec3;
using meshing::TroubleKind;

constexpr double vessel_forecast_radius_mm = 1.5, throat_mm = 12.0, vessel_forecast_length_mm = 24.0;

/// Along z; `narrowing` is the share of the radius that is missing at the throat.
geometry::Centerline axis_at(double x_mm, double narrowing) {
  geometry::Centerline axis;
  for (double z = 0.0; z <= vessel_forecast_length_mm; z += 0.5) {
    const double from_throat = std::min(1.0, std::abs(z - throat_mm) / 4.0);
    axis.points.push_back({x_mm, 0.0, z});
    axis.radius.push_back(vessel_forecast_radius_mm *
                          (1.0 - 0.5 * narrowing * (1.0 + std::cos(M_PI * from_throat))));
  }
  geometry::complete(axis);
  return axis;
}

/// A sound vessel at x = 0 and, 20 mm beside it, one that may be narrowed.
lumen::LumenModel two_vessels(double narrowing) {
  geometry::VesselTree tree;
  std::int32_t id = 1;
  for (const double x : {0.0, 20.0}) {
    const geometry::Centerline axis = axis_at(x, x > 0.0 ? narrowing : 0.0);
    tree.nodes.push_back({id, axis.points.front()});
    tree.nodes.push_back({id + 1, axis.points.back()});
    tree.segments.push_back({id + 2, id, id + 1, axis});
    tree.vessels.push_back({id + 3, x > 0.0 ? "RCA" : "LAD", {id + 2}});
    id += 4;
  }
  return lumen::model_of_tubes(tree);
}

MeshExportOptions edges(double around) {
  MeshExportOptions options;
  options.sizing = edges_around(around);
  return options;
}

TEST(VesselForecast, FindsNothingInSoundVessels) {
  const VesselForecast made = forecast_mesh(two_vessels(0.0), edges(16));
  EXPECT_EQ(made.forecast.summary(), "nothing found");
  EXPECT_EQ(geometry::find_faults(made.surface, false).components, 2);
}

TEST(VesselForecast, FindsWhereLayersHaveNoRoomInTheTreeThatIsNarrowed) {
  MeshExportOptions options;
  options.sizing = even_edges(0.4);
  options.volume.layers.emplace();
  options.volume.layers->thickness = 1.5;
  const VesselForecast made = forecast_mesh(two_vessels(0.85), options);
  const auto found = std::ranges::find_if(
      made.forecast.places, [](const auto& place) { return place.kind == TroubleKind::no_room_for_layers; });
  ASSERT_NE(found, made.forecast.places.end()) << made.forecast.summary();
  EXPECT_NEAR(found->point.z(), throat_mm, 4.0);
  EXPECT_NEAR(found->point.x(), 20.0, 1.0);
  // Its triangles are those of the surface of both trees.
  ASSERT_FALSE(found->triangles.empty());
  for (const std::int32_t t : found->triangles)
    for (const std::int32_t corner : made.surface.triangles[static_cast<std::size_t>(t)])
      EXPECT_NEAR(made.surface.points[static_cast<std::size_t>(corner)].x(), 20.0, 2.0);
}

TEST(VesselForecast, FollowsTheSettings) {
  const lumen::LumenModel model = two_vessels(0.0);
  const VesselForecast coarse = forecast_mesh(model, edges(6));
  EXPECT_TRUE(std::ranges::any_of(coarse.forecast.places, [](const auto& place) {
    return place.kind == TroubleKind::narrow_lumen && place.repair == meshing::OfferedRepair::smaller_edges &&
           place.factor < 1.0;
  })) << coarse.forecast.summary();
  MeshExportOptions one = edges(16);
  one.vessels = {4};
  one.extensions.emplace();
  one.extensions->inlet_diameters = one.extensions->outlet_diameters = 3.0;
  const VesselForecast longer = forecast_mesh(model, one);
  geometry::Box3 box;
  for (const Vec3& point : longer.surface.points) box.extend(point);
  EXPECT_NEAR(box.sizes().z(),
              vessel_forecast_length_mm - 2 * 0.4 * vessel_forecast_radius_mm +
                  2 * 3.0 * 2.0 * vessel_forecast_radius_mm,
              0.5);
  EXPECT_LT(box.max().x(), 2.0) << "the other vessel was not asked for";
}

TEST(VesselForecast, RefusesAndIsCancelled) {
  MeshExportOptions options = edges(16);
  options.inset_radii = -1.0;
  EXPECT_THROW(forecast_mesh(two_vessels(0.0), options), InvalidInput);
  core::TaskContext task;
  task.cancel();
  EXPECT_THROW(forecast_mesh(two_vessels(0.0), edges(16), task), Cancelled);
}

}  // namespace
}  // namespace ostia::pipeline
