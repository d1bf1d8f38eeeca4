// What OpenGL draws of a tree, held against where its segments are.

#include "ostia/glview/tree_drawing.h"

#include "ostia/glview/beating_scene.h"
#include "ostia/glview/offscreen.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace ostia::glview {
namespace {

using geometry::Vec2;
using geometry::Vec3;

constexpr int tree_drawing_width = 640, tree_drawing_height = 480;

#define REQUIRE_OPENGL() \
  if (const std::string why = offscreen_trouble(); !why.empty()) GTEST_SKIP() << why

/// Pixels that are not background.
std::vector<std::array<int, 2>> drawn(const figure::Raster& picture) {
  std::vector<std::array<int, 2>> out;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x)
      if (picture.rgba[4 * static_cast<std::size_t>(y * picture.width + x)] > 40) out.push_back({x, y});
  return out;
}

class Picture {
 public:
  explicit Picture(geometry::VesselGraph graph)
      : offscreen_(tree_drawing_width, tree_drawing_height),
        drawing_(std::make_shared<const geometry::SegmentBlocks>(graph)) {
    eye.width_px = tree_drawing_width;
    eye.height_px = tree_drawing_height;
  }
  figure::Raster taken(std::span<const std::uint8_t> shown = {}, std::int32_t highlight = -1) {
    offscreen_.bind();
    begin_part({0, 0, tree_drawing_width, tree_drawing_height}, {0.0, 0.0, 0.0, 1.0});
    drawing_.draw(eye, 1.0, shown, highlight);
    return offscreen_.read();
  }
  TreeCamera eye;

 private:
  Offscreen offscreen_;
  TreeDrawing drawing_;
};

geometry::VesselGraph one_segment(double radius_from, double radius_to) {
  geometry::VesselGraph graph;
  graph.points = {Vec3(-10.0, 0.0, -3.0), Vec3(10.0, 0.0, 5.0)};
  graph.edges = {{0, 1, radius_from, radius_to}};
  return graph;
}

// A cone with round ends: as wide across its axis as its radii, and no longer than its balls.
TEST(TreeDrawingGui, ASegmentIsWhereItIsAndAsWideAsItIs) {
  REQUIRE_OPENGL();
  Picture picture(one_segment(2.0, 1.0));
  picture.eye.distance_mm = 400.0;  // rays all but parallel
  picture.eye = nearer(picture.eye, 0.15);
  const double px = 1.0 / picture.eye.pixel_mm();
  const Vec2 from = *picture.eye.place_of({-10.0, 0.0, -3.0}), to = *picture.eye.place_of({10.0, 0.0, 5.0});
  const Vec2 along = (to - from).normalized();
  double area = 0.0;
  for (const auto& [x, y] : drawn(picture.taken())) {
    const Vec2 at = Vec2(x + 0.5, y + 0.5) - from;
    const double t = std::clamp(at.dot(along) / (to - from).norm(), 0.0, 1.0);
    EXPECT_LT((at - t * (to - from)).norm(), (2.0 - t) * px + 1.0);
    area += 1.0;
  }
  const double length = (to - from).norm();
  const double truth = length * (2.0 + 1.0) * px + 0.5 * 3.14159265 * (4.0 + 1.0) * px * px;
  EXPECT_NEAR(area, truth, 0.03 * truth);
}

// Seen along its axis a vessel is a disc, not a line.
TEST(TreeDrawingGui, ASegmentSeenAlongItselfIsRound) {
  REQUIRE_OPENGL();
  geometry::VesselGraph graph;
  graph.points = {Vec3(0.0, -5.0, 0.0), Vec3(0.0, 5.0, 0.0)};
  graph.edges = {{0, 1, 2.0, 2.0}};
  Picture picture(graph);
  picture.eye.distance_mm = 60.0;
  const auto pixels = drawn(picture.taken());
  const double radius = 2.0 / picture.eye.pixel_mm() * 60.0 / 55.0;  // of the near end
  EXPECT_NEAR(static_cast<double>(pixels.size()), 3.14159265 * radius * radius,
              0.2 * 3.14159265 * radius * radius);  // one half is the far end's
}

TEST(TreeDrawingGui, WhatIsChosenIsSeenAtAnyDistance) {
  REQUIRE_OPENGL();
  geometry::VesselGraph graph = one_segment(0.001, 0.001);
  for (int i = 0; i < 3000; ++i) {
    const auto n = static_cast<std::int32_t>(graph.points.size());
    graph.points.push_back(Vec3(std::sin(0.1 * i), std::cos(0.1 * i), 0.01 * i));
    graph.points.push_back(graph.points.back() + Vec3(0.01, 0.0, 0.0));
    graph.edges.push_back({n, n + 1, 0.001, 0.001});
  }
  Picture picture(graph);
  for (const double distance : {30.0, 3000.0}) {
    picture.eye.distance_mm = distance;
    const figure::Raster raster = picture.taken({}, 300);
    std::size_t yellow = 0;
    for (std::size_t i = 0; i < raster.rgba.size(); i += 4)
      yellow += raster.rgba[i + 1] > 150 && raster.rgba[i] > 150 ? 1 : 0;
    EXPECT_GE(yellow, 4U) << distance;
  }
}

TEST(TreeDrawingGui, WhatIsNotWantedIsNotThere) {
  REQUIRE_OPENGL();
  geometry::VesselGraph graph = one_segment(1.0, 1.0);
  graph.points.push_back(Vec3(0.0, 0.0, 12.0));
  graph.edges.push_back({0, 2, 1.0, 1.0});
  Picture picture(graph);
  picture.eye.distance_mm = 80.0;
  const std::vector<std::uint8_t> none{0, 0}, first{1, 0};
  EXPECT_TRUE(drawn(picture.taken(none)).empty());
  const std::size_t one = drawn(picture.taken(first)).size(), all = drawn(picture.taken()).size();
  EXPECT_GT(one, 100U);
  EXPECT_GT(all, one + 100U);
}

// Three eighths of a bush, without any order in it, cover three quarters of what all of it does.
TEST(TreeDrawingGui, FewSegmentsFromAfarCoverWhatAllCover) {
  REQUIRE_OPENGL();
  geometry::VesselGraph graph;
  std::mt19937 random(3);
  std::normal_distribution<double> place(0.0, 5.0), step(0.0, 0.1);
  for (int i = 0; i < 400000; ++i) {
    const Vec3 from(place(random), place(random), place(random));
    graph.points.push_back(from);
    graph.points.push_back(from + Vec3(step(random), step(random), step(random)));
    graph.edges.push_back({2 * i, 2 * i + 1, 0.004, 0.004});
  }
  Picture picture(graph);
  picture.eye.distance_mm = 100.0;
  const double few = static_cast<double>(drawn(picture.taken()).size());
  // All of it: in parts so small that none is left out.
  std::vector<std::uint8_t> covered(static_cast<std::size_t>(tree_drawing_width * tree_drawing_height), 0);
  for (int part = 0; part < 8; ++part) {
    geometry::VesselGraph piece;
    for (int i = part * 50000; i < (part + 1) * 50000; ++i) {
      const auto n = static_cast<std::int32_t>(piece.points.size());
      piece.points.push_back(graph.points[static_cast<std::size_t>(2 * i)]);
      piece.points.push_back(graph.points[static_cast<std::size_t>(2 * i + 1)]);
      piece.edges.push_back({n, n + 1, 0.06, 0.06});  // as wide as they are drawn, so never left out
    }
    Picture apart(piece);
    apart.eye = picture.eye;
    for (const auto& [x, y] : drawn(apart.taken()))
      covered[static_cast<std::size_t>(y * tree_drawing_width + x)] = 1;
  }
  const double all = static_cast<double>(std::count(covered.begin(), covered.end(), 1));
  EXPECT_GT(few / all, 0.75);
  EXPECT_LT(few / all, 1.05);
}

}  // namespace
}  // namespace ostia::glview
