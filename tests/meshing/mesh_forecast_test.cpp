// Each kind of trouble made on purpose and found at its place; nothing found where there is none.
#include "ostia/meshing/mesh_forecast.h"

#include "boundary_layer_shapes.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/geometry/mesh_topology.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace ostia::meshing {
namespace {

using geometry::FacedSurface;
using geometry::TriMesh;
using geometry::Vec3;

FacedSurface plain(TriMesh mesh) {
  return {std::move(mesh), {}, {}};
}

/// An open tube along z of radius `radius`, its axis at (x, 0).
TriMesh open_tube(double radius = 1.5, double x = 0.0, double length_mm = 12.0, int around = 24) {
  TriMesh mesh =
      geometry::structured_surface(geometry::straight_tube(length_mm, radius).tubes[0], around, 0.4);
  for (Vec3& p : mesh.points) p.x() += x;
  return mesh;
}

ForecastOptions with_layers() {
  ForecastOptions options;
  options.layers = BoundaryLayerOptions{};
  return options;
}

std::vector<ForecastPlace> of_kind(const MeshForecast& forecast, TroubleKind kind) {
  std::vector<ForecastPlace> found;
  for (const ForecastPlace& place : forecast.places)
    if (place.kind == kind) found.push_back(place);
  return found;
}

/// The only trouble is of this kind, there.
ForecastPlace expect_only(const MeshForecast& forecast, TroubleKind kind, const Vec3& where,
                          double within_mm) {
  EXPECT_EQ(forecast.places.size(), 1u) << forecast.summary();
  const auto found = of_kind(forecast, kind);
  if (found.empty()) {
    ADD_FAILURE() << name_of(kind) << " not found: " << forecast.summary();
    return {};
  }
  EXPECT_LE((found[0].point - where).norm(), within_mm) << found[0].sentence;
  EXPECT_FALSE(found[0].sentence.empty());
  EXPECT_FALSE(found[0].repair_sentence.empty());
  EXPECT_GT(found[0].count, 0u);
  return found[0];
}

TEST(MeshForecast, FindsNothingOnCleanSurfaces) {
  const auto nothing = [](const FacedSurface& surface, const ForecastOptions& options) {
    const MeshForecast forecast = mesh_forecast(surface, options);
    EXPECT_EQ(forecast.summary(), "nothing found");
    EXPECT_FALSE(forecast.fails());
  };
  nothing(plain(open_tube()), with_layers());
  nothing(capped_tube(), with_layers());
  nothing(structured_tube(16, 1.5, 0.5, 12), with_layers());
  for (const double angle : {60.0, 25.0}) {
    const geometry::AnalyticShape fork = geometry::y_junction(8.0, 14.0, 2.0, 1.4, angle);
    const geometry::VesselTree tree = tree_of(fork);
    ForecastOptions options = with_layers();
    options.tree = &tree;
    nothing(plain(geometry::surface_of(fork, 0.25, true)), options);
    nothing(capped(fork, 0.25, false), options);
    nothing(remeshed(fork, 0.35), options);
  }
  nothing(plain(geometry::surface_of(geometry::torus(6.0, 1.5), 0.3, false)), with_layers());
}

TEST(MeshForecast, FindsAHoleAndNotTheEnds) {
  TriMesh mesh = open_tube();
  const auto middle =
      std::min_element(mesh.triangles.begin(), mesh.triangles.end(), [&](const auto& a, const auto& b) {
        const Vec3 aim(1.5, 0, 6);
        return (mesh.points[static_cast<std::size_t>(a[0])] - aim).norm() <
               (mesh.points[static_cast<std::size_t>(b[0])] - aim).norm();
      });
  mesh.triangles.erase(middle);
  const ForecastPlace place =
      expect_only(mesh_forecast(plain(mesh)), TroubleKind::open_edges, {1.5, 0, 6}, 0.7);
  EXPECT_EQ(place.count, 3u);
  EXPECT_TRUE(place.fails);
  EXPECT_EQ(place.repair, OfferedRepair::fill_holes);
  EXPECT_EQ(place.triangles.size(), 3u);
  ForecastOptions closed;
  closed.open_ends = false;
  EXPECT_EQ(of_kind(mesh_forecast(plain(mesh), closed), TroubleKind::open_edges).size(), 3u);
}

TEST(MeshForecast, FindsTrianglesThatAreNotJoined) {
  const TriMesh joined = open_tube();
  TriMesh apart;
  for (const geometry::Triangle& t : joined.triangles) {
    const auto n = static_cast<std::int32_t>(apart.points.size());
    for (const std::int32_t v : t) apart.points.push_back(joined.points[static_cast<std::size_t>(v)]);
    apart.triangles.push_back({n, n + 1, n + 2});
  }
  const MeshForecast forecast = mesh_forecast(plain(apart));
  const auto found = of_kind(forecast, TroubleKind::open_edges);
  ASSERT_EQ(found.size(), 10u);
  EXPECT_EQ(found[0].repair, OfferedRepair::repair_surface);
  EXPECT_THAT(found.back().sentence, ::testing::HasSubstr("more places)"));
}

TEST(MeshForecast, FindsAFin) {
  FacedSurface surface = structured_tube(16, 1.5, 0.5, 12);
  const geometry::Triangle t = surface.mesh.triangles[200];
  const Vec3 at = surface.mesh.points[static_cast<std::size_t>(t[0])];
  surface.mesh.points.push_back(at + 0.5 * Vec3(at.x(), at.y(), 0).normalized());
  surface.mesh.triangles.push_back({t[0], t[1], static_cast<std::int32_t>(surface.mesh.points.size()) - 1});
  surface.face_ids.push_back(1);
  const MeshForecast forecast = mesh_forecast(surface);
  const auto found = of_kind(forecast, TroubleKind::non_manifold);
  ASSERT_EQ(found.size(), 1u) << forecast.summary();
  EXPECT_LE((found[0].point - at).norm(), 0.8);
  EXPECT_EQ(found[0].count, 1u);
  EXPECT_EQ(found[0].repair, OfferedRepair::repair_surface);
}

TEST(MeshForecast, FindsATurnedTriangle) {
  FacedSurface surface = structured_tube(16, 1.5, 0.5, 12);
  std::swap(surface.mesh.triangles[200][0], surface.mesh.triangles[200][1]);
  const Vec3 at = surface.mesh.points[static_cast<std::size_t>(surface.mesh.triangles[200][0])];
  const ForecastPlace place = expect_only(mesh_forecast(surface), TroubleKind::turned_triangles, at, 0.9);
  EXPECT_EQ(place.count, 3u);
  EXPECT_EQ(place.repair, OfferedRepair::orient);
}

TEST(MeshForecast, FindsSurfacesThatLookInward) {
  for (TriMesh mesh : {open_tube(), structured_tube(16, 1.5, 0.5, 12).mesh}) {
    for (geometry::Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
    const MeshForecast forecast = mesh_forecast(plain(mesh));
    const auto found = of_kind(forecast, TroubleKind::inward);
    ASSERT_EQ(found.size(), 1u) << forecast.summary();
    EXPECT_EQ(found[0].count, mesh.triangles.size());
    EXPECT_EQ(found[0].repair, OfferedRepair::orient);
  }
}

TEST(MeshForecast, FindsWhereVesselsCross) {
  TriMesh across = open_tube(1.0);
  for (Vec3& p : across.points) p = Vec3(p.z() - 6.0, p.y() + 0.3, p.x() + 6.0);
  for (geometry::Triangle& t : across.triangles) std::swap(t[1], t[2]);
  const MeshForecast forecast = mesh_forecast(plain(geometry::merged(open_tube(), across)));
  const auto found = of_kind(forecast, TroubleKind::self_intersections);
  ASSERT_FALSE(found.empty()) << forecast.summary();
  EXPECT_LE(std::abs(std::hypot(found[0].point.x(), found[0].point.y()) - 1.5), 0.6);
  EXPECT_LE(std::abs(found[0].point.z() - 6.0), 1.5);
  EXPECT_TRUE(forecast.fails());
  EXPECT_EQ(found[0].repair, OfferedRepair::repair_surface);
}

TEST(MeshForecast, FindsTwoVesselsThatTouch) {
  // Side by side with a gap of 0.05 mm; edges are 0.4 mm.
  const TriMesh mesh = geometry::merged(open_tube(1.5, -1.525), open_tube(1.5, 1.525));
  const ForecastPlace place =
      expect_only(mesh_forecast(plain(mesh)), TroubleKind::touching_walls, {0, 0, 6}, 6.1);
  EXPECT_LE(std::hypot(place.point.x(), place.point.y()), 0.5);
  EXPECT_TRUE(place.fails);
  EXPECT_THAT(place.sentence, ::testing::HasSubstr("as close as 0.05 mm outside"));
  const TriMesh apart = geometry::merged(open_tube(1.5, -2.0), open_tube(1.5, 2.0));
  EXPECT_EQ(mesh_forecast(plain(apart)).summary(), "nothing found");
}

TEST(MeshForecast, FindsOneVesselThatComesBackToItself) {
  // Turns of 3.4 mm, of which the vessel takes 3.02 mm along the axis.
  const FacedSurface surface =
      plain(geometry::surface_of(geometry::helix_tube(5.0, 3.4, 1.6, 1.5), 0.2, false));
  ForecastOptions options;
  options.edge_lengths_mm.assign(surface.mesh.points.size(), 0.5);
  const auto found = of_kind(mesh_forecast(surface, options), TroubleKind::touching_walls);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(std::hypot(found[0].point.x(), found[0].point.y()), 5.0, 0.8);
  EXPECT_GT(found[0].extent_mm, 4.0);  // all along the turn
  options.edge_lengths_mm.assign(surface.mesh.points.size(), 0.3);
  EXPECT_EQ(mesh_forecast(surface, options).summary(), "nothing found");
}

TEST(MeshForecast, FindsAnEndSmallerThanAnEdge) {
  const geometry::AnalyticShape shape = geometry::tapered_tube(20.0, 2.0, 0.15);
  for (const bool capped_ends : {true, false}) {
    SCOPED_TRACE(capped_ends);
    FacedSurface surface =
        capped_ends ? capped(shape, 0.1, false) : plain(geometry::surface_of(shape, 0.1, true));
    ForecastOptions options;
    options.edge_lengths_mm.assign(surface.mesh.points.size(), 0.4);
    options.min_edges_across = 0.0;
    const ForecastPlace place =
        expect_only(mesh_forecast(surface, options), TroubleKind::small_end, {0, 0, 20}, 0.7);
    EXPECT_TRUE(place.fails);
    EXPECT_EQ(place.repair, OfferedRepair::smaller_edges);
    EXPECT_LT(place.factor, 1.0);
    if (capped_ends) {
      EXPECT_THAT(place.sentence, ::testing::HasSubstr("outlet_"));
    }
  }
}

TEST(MeshForecast, FindsANarrowLumen) {
  const geometry::AnalyticShape shape = geometry::stenosed_tube(20.0, 1.6, 0.8, 10.0, 6.0);
  const FacedSurface surface = plain(geometry::surface_of(shape, 0.1, true));
  ForecastOptions options;
  options.edge_lengths_mm.assign(surface.mesh.points.size(), 0.4);  // the throat is 0.64 mm wide
  const ForecastPlace place =
      expect_only(mesh_forecast(surface, options), TroubleKind::narrow_lumen, {0, 0, 10}, 0.6);
  EXPECT_FALSE(place.fails);
  EXPECT_NEAR(place.factor, 0.64 / 0.4 / 3.0, 0.05);
  options.edge_lengths_mm.assign(surface.mesh.points.size(), 0.8);
  const auto larger = of_kind(mesh_forecast(surface, options), TroubleKind::edge_size);
  ASSERT_EQ(larger.size(), 1u);
  EXPECT_TRUE(larger[0].fails);
  EXPECT_THAT(larger[0].sentence, ::testing::HasSubstr("the edge is larger than the vessel"));
  // Edges that follow the vessel's size pass through.
  const geometry::VesselTree tree = tree_of(shape);
  ForecastOptions sized;
  sized.tree = &tree;
  EXPECT_EQ(mesh_forecast(surface, sized).summary(), "nothing found");
}

TEST(MeshForecast, FindsEdgeLengthsOfZero) {
  const TriMesh mesh = open_tube();
  ForecastOptions options;
  options.edge_lengths_mm.assign(mesh.points.size(), 0.4);
  options.edge_lengths_mm[70] = 0.0;
  options.edge_lengths_mm[71] = std::numeric_limits<double>::quiet_NaN();
  const ForecastPlace place =
      expect_only(mesh_forecast(plain(mesh), options), TroubleKind::edge_size, mesh.points[70], 1e-12);
  EXPECT_EQ(place.count, 2u);
  EXPECT_TRUE(place.fails);
}

/// A tube whose section is a lens with two sharp edges.
TriMesh lens_tube(double flatness) {
  TriMesh mesh = open_tube(1.5, 0.0, 12.0, 48);
  for (Vec3& p : mesh.points) p.y() *= flatness * (1.0 - std::abs(p.x()) / 1.5) + 1e-9;
  return mesh;
}

TEST(MeshForecast, TheSurfacesOwnEdgesAreNoRequest) {
  const TriMesh flat = lens_tube(0.05);  // 0.15 mm wide, with edges of 0.4 mm
  const MeshForecast own = mesh_forecast(plain(flat));
  EXPECT_FALSE(of_kind(own, TroubleKind::narrow_lumen).empty()) << own.summary();
  EXPECT_FALSE(own.fails()) << own.summary();
  ForecastOptions asked;
  asked.edge_lengths_mm.assign(flat.points.size(), 0.4);
  EXPECT_FALSE(of_kind(mesh_forecast(plain(flat), asked), TroubleKind::edge_size).empty());
}

TEST(MeshForecast, FindsFoldsTooSharpForLayers) {
  ForecastOptions options = with_layers();
  options.min_edges_across = 0.0;
  const MeshForecast sharp = mesh_forecast(plain(lens_tube(0.25)), options);
  const auto folds = of_kind(sharp, TroubleKind::sharp_fold);
  ASSERT_EQ(folds.size(), 2u) << sharp.summary();
  for (const ForecastPlace& fold : folds) {
    EXPECT_NEAR(std::abs(fold.point.x()), 1.5, 0.05);
    EXPECT_EQ(fold.repair, OfferedRepair::smooth);
  }
  options.layers.reset();
  EXPECT_TRUE(of_kind(mesh_forecast(plain(lens_tube(0.25)), options), TroubleKind::sharp_fold).empty());
}

TEST(MeshForecast, FindsWhereThereIsNoRoomForLayers) {
  const geometry::AnalyticShape shape = geometry::stenosed_tube(20.0, 1.6, 0.8, 10.0, 6.0);
  const FacedSurface surface = plain(geometry::surface_of(shape, 0.1, true));
  ForecastOptions options = with_layers();
  options.min_edges_across = 0.0;
  options.edge_lengths_mm.assign(surface.mesh.points.size(), 0.4);
  options.layers->thickness = 1.0;  // 0.4 mm in a throat of radius 0.32 mm, where half of that is for layers
  const ForecastPlace place =
      expect_only(mesh_forecast(surface, options), TroubleKind::no_room_for_layers, {0, 0, 10}, 0.6);
  EXPECT_FALSE(place.fails);
  EXPECT_LT(place.factor, 0.16 / 0.4 + 0.01);
  EXPECT_GT(place.factor, 0.75 * 0.16 / 0.4);  // facets come nearer than the wall they stand for
  EXPECT_EQ(place.repair, OfferedRepair::thinner_layers);
  options.layers->thickness = 0.3;
  EXPECT_EQ(mesh_forecast(surface, options).summary(), "nothing found");
}

TEST(MeshForecast, FindsUnitsThatAreNotMillimetres) {
  TriMesh mesh = open_tube(1.5, 0.0, 60.0);
  for (Vec3& p : mesh.points) p *= 1e-3;
  const ForecastPlace metres =
      expect_only(mesh_forecast(plain(mesh)), TroubleKind::units, {0, 0, 0.03}, 1e-3);
  EXPECT_EQ(metres.factor, 1000.0);
  EXPECT_EQ(metres.repair, OfferedRepair::convert_units);
  EXPECT_THAT(metres.sentence, ::testing::HasSubstr("that looks like metres"));
  for (Vec3& p : mesh.points) p *= 1e6;
  EXPECT_EQ(expect_only(mesh_forecast(plain(mesh)), TroubleKind::units, {0, 0, 3e4}, 1e3).factor, 0.001);
}

TEST(MeshForecast, TellsOfPointsWithoutAPlace) {
  TriMesh mesh = open_tube();
  mesh.points[5].y() = std::numeric_limits<double>::infinity();
  const MeshForecast forecast = mesh_forecast(plain(mesh));
  ASSERT_EQ(forecast.places.size(), 1u);
  EXPECT_EQ(forecast.places[0].kind, TroubleKind::not_finite);
  EXPECT_TRUE(forecast.fails());
}

TEST(MeshForecast, PutsWhatFailsFirstAndIsTheSameForAnyNumberOfThreads) {
  const geometry::AnalyticShape shape = geometry::stenosed_tube(20.0, 1.6, 0.8, 10.0, 6.0);
  TriMesh mesh = geometry::surface_of(shape, 0.1, true);
  mesh.triangles.erase(mesh.triangles.begin() + 700);
  ForecastOptions options;
  options.edge_lengths_mm.assign(mesh.points.size(), 0.4);
  std::vector<std::string> summaries;
  for (const int threads : {1, 3}) {
    core::set_max_threads(threads);
    const MeshForecast forecast = mesh_forecast(plain(mesh), options);
    ASSERT_GE(forecast.places.size(), 2u);
    EXPECT_TRUE(forecast.places.front().fails);
    EXPECT_FALSE(forecast.places.back().fails);
    summaries.push_back(forecast.summary());
  }
  core::set_max_threads(0);
  EXPECT_EQ(summaries[0], summaries[1]);
}

TEST(MeshForecast, RefusesListsThatDoNotBelongTogether) {
  EXPECT_THROW(mesh_forecast(plain({})), InvalidInput);
  FacedSurface surface = plain(open_tube());
  surface.face_ids = {1, 2};
  EXPECT_THROW(mesh_forecast(surface), InvalidInput);
  surface.face_ids.clear();
  ForecastOptions options;
  options.edge_lengths_mm = {1.0};
  EXPECT_THROW(mesh_forecast(surface, options), InvalidInput);
  options.edge_lengths_mm.clear();
  options.max_places = 0;
  EXPECT_THROW(mesh_forecast(surface, options), InvalidInput);
  surface.mesh.triangles[0][0] = -3;
  EXPECT_THROW(mesh_forecast(surface), InvalidInput);
  core::TaskContext task;
  task.cancel();
  EXPECT_THROW(mesh_forecast(plain(open_tube()), {}, task), Cancelled);
}

}  // namespace
}  // namespace ostia::meshing
