#include "ostia/centerline/eikonal.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace ostia::centerline {
namespace {

using geometry::Vec3;

// A sheet of count x count quadrilaterals over the square of `side`, lifted by `place`.
struct Sheet {
  InnerVoronoi diagram;
  std::int32_t count = 0;
  std::int32_t at(std::int32_t i, std::int32_t j) const { return i * (count + 1) + j; }
};

void index_incidence(InnerVoronoi& d) {
  std::vector<std::vector<std::int32_t>> around(d.points.size());
  for (std::size_t p = 0; p < d.polygon_count(); ++p)
    for (std::int32_t k = d.polygon_first[p]; k < d.polygon_first[p + 1]; ++k)
      around[static_cast<std::size_t>(d.corners[static_cast<std::size_t>(k)])].push_back(
          static_cast<std::int32_t>(p));
  d.incidence_first = {0};
  for (const auto& list : around) {
    d.incidence.insert(d.incidence.end(), list.begin(), list.end());
    d.incidence_first.push_back(static_cast<std::int32_t>(d.incidence.size()));
  }
  d.links.assign(d.points.size(), {-1, -1, -1, -1});
}

Sheet sheet(std::int32_t count, const std::function<Vec3(double, double)>& place,
            const std::function<double(const Vec3&)>& radius) {
  Sheet s;
  s.count = count;
  for (std::int32_t i = 0; i <= count; ++i)
    for (std::int32_t j = 0; j <= count; ++j) {
      s.diagram.points.push_back(place(static_cast<double>(i) / count, static_cast<double>(j) / count));
      s.diagram.radius.push_back(radius(s.diagram.points.back()));
    }
  s.diagram.polygon_first = {0};
  for (std::int32_t i = 0; i < count; ++i)
    for (std::int32_t j = 0; j < count; ++j) {
      for (const std::int32_t corner : {s.at(i, j), s.at(i + 1, j), s.at(i + 1, j + 1), s.at(i, j + 1)})
        s.diagram.corners.push_back(corner);
      s.diagram.polygon_first.push_back(static_cast<std::int32_t>(s.diagram.corners.size()));
    }
  index_incidence(s.diagram);
  return s;
}

Vec3 plane(double u, double v) {
  return {10.0 * u, 10.0 * v, 0.0};
}

TEST(Eikonal, time_is_distance_over_radius_on_a_plane) {
  const Sheet s = sheet(40, plane, [](const Vec3&) { return 2.0; });
  const std::int32_t source = s.at(20, 20);
  const ArrivalTimes arrival = arrival_times(s.diagram, source);
  for (std::size_t i = 0; i < s.diagram.points.size(); ++i) {
    const double exact =
        (s.diagram.points[i] - s.diagram.points[static_cast<std::size_t>(source)]).norm() / 2.0;
    EXPECT_NEAR(arrival.time[i], exact, 0.03 * exact + 0.02);  // first order near the source
    EXPECT_GE(arrival.time[i], exact * (1.0 - 1e-12));
  }
}

TEST(Eikonal, follows_the_hyperbolic_metric_where_the_radius_grows_linearly) {
  // |grad T| = 1/x on the half plane x > 0 is solved by arcosh(1 + d^2 / (2 x x0)).
  const Sheet s = sheet(
      100, [](double u, double v) { return Vec3(1.0 + 4.0 * u, 4.0 * v, 0.0); },
      [](const Vec3& p) { return p.x(); });
  const std::int32_t source = s.at(25, 0);
  const Vec3 from = s.diagram.points[static_cast<std::size_t>(source)];
  const ArrivalTimes arrival = arrival_times(s.diagram, source);
  for (std::size_t i = 0; i < s.diagram.points.size(); ++i) {
    const Vec3& p = s.diagram.points[i];
    const double exact = std::acosh(1.0 + (p - from).squaredNorm() / (2.0 * p.x() * from.x()));
    EXPECT_NEAR(arrival.time[i], exact, 0.03 * exact + 0.01);
  }
}

TEST(Eikonal, goes_round_a_fold_as_on_the_unfolded_sheet) {
  const Sheet s = sheet(
      40,
      [](double u, double v) {
        return u < 0.5 ? Vec3(10.0 * u, 10.0 * v, 0.0) : Vec3(5.0, 10.0 * v, 10.0 * (u - 0.5));
      },
      [](const Vec3&) { return 1.0; });
  const ArrivalTimes arrival = arrival_times(s.diagram, s.at(0, 0));
  EXPECT_NEAR(arrival.time[static_cast<std::size_t>(s.at(40, 40))], std::sqrt(200.0), 0.3);
  EXPECT_NEAR(arrival.time[static_cast<std::size_t>(s.at(40, 0))], 10.0, 1e-9);
}

TEST(Eikonal, handles_obtuse_polygons) {
  // Sheared cells with angles of 143 degrees.
  const Sheet s = sheet(
      60, [](double u, double v) { return Vec3(10.0 * u + 8.0 * v, 6.0 * v, 0.0); },
      [](const Vec3&) { return 1.0; });
  const std::int32_t source = s.at(30, 30);
  const Vec3 from = s.diagram.points[static_cast<std::size_t>(source)];
  const ArrivalTimes arrival = arrival_times(s.diagram, source);
  for (std::size_t i = 0; i < s.diagram.points.size(); ++i) {
    const double exact = (s.diagram.points[i] - from).norm();
    EXPECT_GE(arrival.time[i], exact * (1.0 - 1e-12));
    EXPECT_NEAR(arrival.time[i], exact, 0.03 * exact + 0.15);
  }
}

TEST(Eikonal, descends_straight_on_a_plane) {
  const Sheet s = sheet(40, plane, [](const Vec3&) { return 1.0; });
  const std::int32_t source = s.at(0, 0), target = s.at(40, 23);
  const ArrivalTimes arrival = arrival_times(s.diagram, source, {target});
  const DiagramPath path = descend(s.diagram, arrival, target);
  const Vec3 a = path.points.front(), b = path.points.back();
  EXPECT_EQ(b, s.diagram.points[static_cast<std::size_t>(source)]);
  double length = 0.0;
  for (std::size_t i = 1; i < path.points.size(); ++i) length += (path.points[i] - path.points[i - 1]).norm();
  EXPECT_LT(length, 1.01 * (b - a).norm());
  const Vec3 along = (b - a).normalized();
  for (const Vec3& p : path.points) EXPECT_LT(((p - a) - (p - a).dot(along) * along).norm(), 0.3);
}

TEST(Eikonal, a_path_prefers_the_wide_ridge) {
  // The radius is largest along y = 5; the cheapest way between two low corners bends towards it.
  const Sheet s =
      sheet(50, plane, [](const Vec3& p) { return 0.2 + 2.0 * std::exp(-std::pow(p.y() - 5.0, 2)); });
  const std::int32_t target = s.at(50, 10);
  const ArrivalTimes arrival = arrival_times(s.diagram, s.at(0, 10));
  double highest = 0.0;
  for (const Vec3& p : descend(s.diagram, arrival, target).points) highest = std::max(highest, p.y());
  EXPECT_GT(highest, 4.5);
}

TEST(Eikonal, names_what_was_not_reached) {
  Sheet s = sheet(2, plane, [](const Vec3&) { return 1.0; });
  s.diagram.points.emplace_back(50, 50, 50);
  s.diagram.radius.push_back(1.0);
  s.diagram.links.push_back({-1, -1, -1, -1});
  s.diagram.incidence_first.push_back(s.diagram.incidence_first.back());
  const ArrivalTimes arrival = arrival_times(s.diagram, 0);
  EXPECT_TRUE(std::isinf(arrival.time.back()));
  EXPECT_THROW(descend(s.diagram, arrival, 9), GeometryError);
  EXPECT_THROW(arrival_times(s.diagram, 10), InvalidInput);
}

}  // namespace
}  // namespace ostia::centerline
