// Pictures of a bush with as many segments as they need, held against those with all; and of rods, whose
// width is known.

#include "test_bush.h"

#include "ostia/glview/offscreen.h"
#include "ostia/glview/tree_drawing.h"

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

namespace ostia::glview {
namespace {

using geometry::SegmentBlocks;
using geometry::Vec3;
using geometry::VesselGraph;

constexpr int tree_cover_width = 640, tree_cover_height = 480;

#define REQUIRE_OPENGL() \
  if (const std::string why = offscreen_trouble(); !why.empty()) GTEST_SKIP() << why

struct Easel {
  Offscreen offscreen{tree_cover_width, tree_cover_height};
  std::shared_ptr<const SegmentBlocks> blocks;
  TreeDrawing drawing;
  TreeCamera eye;

  explicit Easel(const VesselGraph& graph)
      : blocks(std::make_shared<const SegmentBlocks>(graph)), drawing(blocks) {
    eye.width_px = tree_cover_width;
    eye.height_px = tree_cover_height;
    eye = fitted(eye, blocks->low(), blocks->high());
  }
  figure::Raster picture(const std::vector<std::uint8_t>& shown = {}) {
    offscreen.bind();
    glViewport(0, 0, tree_cover_width, tree_cover_height);
    glClearColor(1, 1, 1, 1);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    drawing.draw(eye, 1.0, shown, -1);
    offscreen.finish();
    return offscreen.read();
  }
};

bool covered(const figure::Raster& raster, int x, int y) {
  const std::uint8_t* p = raster.pixel(x, y);
  return p[0] != 255 || p[1] != 255 || p[2] != 255;
}

template <class Of>
int count(const figure::Raster& raster, const Of& of) {
  int sum = 0;
  for (int y = 0; y < raster.height; ++y)
    for (int x = 0; x < raster.width; ++x) sum += of(raster, x, y) ? 1 : 0;
  return sum;
}

int covered_in_row(const figure::Raster& raster, int y) {
  int sum = 0;
  for (int x = 0; x < raster.width; ++x) sum += covered(raster, x, y) ? 1 : 0;
  return sum;
}

VesselGraph rod(double length, double radius) {
  VesselGraph graph;
  graph.points = {Vec3(0, 0, -0.5 * length), Vec3(0, 0, 0.5 * length)};
  graph.edges = {{0, 1, radius, radius}};
  return graph;
}

TEST(TreeCover, VesselsOfAnySizeAreAsWideAsTheyAre) {
  REQUIRE_OPENGL();
  for (const double scale : {0.01, 1.0, 1000.0}) {
    Easel easel(rod(20.0 * scale, scale));
    EXPECT_NEAR(covered_in_row(easel.picture(), tree_cover_height / 2), 2.0 * scale / easel.eye.pixel_mm(),
                1.01)
        << scale;
  }
}

TEST(TreeCover, VesselsAreNeverThinnerThanAPixel) {
  REQUIRE_OPENGL();
  Easel easel(rod(20.0, 1e-6));
  const figure::Raster raster = easel.picture();
  const int half = static_cast<int>(10.0 / easel.eye.pixel_mm()) - 2;
  ASSERT_GT(half, 100);
  for (int y = tree_cover_height / 2 - half; y < tree_cover_height / 2 + half; ++y) {
    EXPECT_GE(covered_in_row(raster, y), 1) << y;
    EXPECT_LE(covered_in_row(raster, y), 2) << y;
  }
}

TEST(TreeCover, BendsHaveNoGap) {
  REQUIRE_OPENGL();
  VesselGraph bend;
  bend.points = {Vec3(-10, 0, 0), Vec3(0, 0, 0), Vec3(0, 0, 10)};
  bend.edges = {{0, 1, 2.0, 2.0}, {1, 2, 2.0, 2.0}};
  Easel easel(bend);
  const auto middle = easel.eye.place_of(Vec3::Zero());
  ASSERT_TRUE(middle);
  const double radius = 2.0 / easel.eye.pixel_mm();
  const auto near = [&](int x, int y) {
    return (geometry::Vec2(x + 0.5, y + 0.5) - *middle).norm() < radius - 1.0;
  };
  const figure::Raster raster = easel.picture();
  const int inside = count(raster, [&](const figure::Raster&, int x, int y) { return near(x, y); });
  EXPECT_GT(inside, 500);
  EXPECT_EQ(count(raster, [&](const auto& r, int x, int y) { return near(x, y) && covered(r, x, y); }),
            inside);
}

TEST(TreeCover, AFewOfABushCoverWhatAllOfItCovers) {
  REQUIRE_OPENGL();
  Easel easel(test_bush(400'000));
  const TreeCamera overview = easel.eye;
  for (const double away : {8.0, 4.0, 2.0, 1.0, 0.5, 0.25, 0.125, 0.1}) {
    easel.eye = overview;
    easel.eye.distance_mm *= away;
    easel.drawing.set_most(SegmentBlocks::everything);
    const figure::Raster whole = easel.picture();
    const std::size_t all = easel.drawing.choice().chosen;
    easel.drawing.set_most(TreeDrawing::most_segments);
    const figure::Raster few = easel.picture();
    const std::size_t some = easel.drawing.choice().chosen;
    const int of_all = count(whole, covered), of_few = count(few, covered);
    if (const char* folder = std::getenv("OSTIA_PICTURES")) {
      std::printf("%g: %d of %d px, %zu of %zu segments\n", away, of_few, of_all, some, all);
      const std::string name = std::string(folder) + "/" + std::to_string(away);
      figure::picture_of(whole).write_png(name + "-all.png");
      figure::picture_of(few).write_png(name + "-few.png");
    }
    EXPECT_LE(of_few, of_all) << away;  // none is drawn that is not there
    EXPECT_GE(of_few, 0.95 * of_all) << away;
    EXPECT_LE(some, all);
    if (away >= 1.0) {
      EXPECT_LT(static_cast<double>(some), 0.5 * static_cast<double>(all)) << away;
    }
  }
}

TEST(TreeCover, PicturesComeBackToWhatTheyWere) {
  REQUIRE_OPENGL();
  Easel easel(test_bush(50'000));
  const TreeCamera before = easel.eye;
  const auto first = easel.picture().rgba;
  easel.eye = turned(easel.eye, {100, 0});
  EXPECT_NE(easel.picture().rgba, first);
  easel.eye = before;
  EXPECT_EQ(easel.picture().rgba, first);
  const std::vector<std::uint8_t> none(easel.blocks->size(), 0);
  EXPECT_EQ(count(easel.picture(none), covered), 0);
}

}  // namespace
}  // namespace ostia::glview
