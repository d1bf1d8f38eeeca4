#include "ostia/figure/preview.h"

#include "test_shapes.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace ostia::figure {
namespace {

constexpr std::size_t most_bytes = 100'000;

/// Whether a pixel is of another colour than the picture's ground, which is that of its upper middle edge.
struct Seen {
  Raster raster;
  explicit Seen(const Picture& picture) : raster(picture.raster()) {}
  int distance(int x, int y) const {
    const std::uint8_t *a = raster.pixel(x, y), *ground = raster.pixel(raster.width / 2, 2);
    return std::max({std::abs(a[0] - ground[0]), std::abs(a[1] - ground[1]), std::abs(a[2] - ground[2])});
  }
  bool operator()(int x, int y) const { return distance(x, y) > 30; }
  /// First and last column of the middle third's rows that has something, and as many.
  double share() const {
    int seen = 0;
    for (int y = 0; y < raster.height; ++y)
      for (int x = 0; x < raster.width; ++x) seen += (*this)(x, y) ? 1 : 0;
    return seen / static_cast<double>(raster.width * raster.height);
  }
};

/// How wide what lies about the middle is in the row and in the column there, px.
std::array<int, 2> extent(const Seen& seen) {
  const int cx = seen.raster.width / 2, cy = seen.raster.height / 2;
  int width = 0, height = 0;
  for (int x = cx; x < seen.raster.width && seen(x, cy); ++x) ++width;
  for (int x = cx - 1; x >= 0 && seen(x, cy); --x) ++width;
  for (int y = cy; y < seen.raster.height && seen(cx, y); ++y) ++height;
  for (int y = cy - 1; y >= 0 && seen(cx, y); --y) ++height;
  return {width, height};
}

TEST(Preview, ABallIsRound) {
  const Picture picture = surface_preview(ball(5.0));
  EXPECT_LT(picture.png().size(), most_bytes);
  const auto [width, height] = extent(Seen(picture));
  EXPECT_GT(width, picture.height() / 2);
  EXPECT_NEAR(width, height, 4);
}

/// The boundary of a box: two triangles below, quadrilaterals on the other sides.
geometry::MixedMesh box_of_quads(double x, double y, double z) {
  geometry::MixedMesh mesh;
  for (int corner = 0; corner < 8; ++corner)
    mesh.points.emplace_back(corner & 1 ? x : 0.0, corner & 2 ? y : 0.0, corner & 4 ? z : 0.0);
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}};
  mesh.quads = {{4, 5, 7, 6}, {0, 1, 5, 4}, {1, 3, 7, 5}, {3, 2, 6, 7}, {2, 0, 4, 6}};
  return mesh;
}

TEST(Preview, ABoxIsSeenFromItsBroadSide) {
  const Picture picture = mesh_preview(box_of_quads(12.0, 2.0, 6.0));
  EXPECT_LT(picture.png().size(), most_bytes);
  const auto [width, height] = extent(Seen(picture));
  const double ratio = std::max(width, height) / static_cast<double>(std::min(width, height));
  EXPECT_NEAR(ratio, 2.0, 0.15) << width << " x " << height;
}

geometry::VesselTree straight_tree() {
  geometry::Centerline axis;
  for (int i = 0; i <= 40; ++i) {
    axis.points.emplace_back(0.0, 0.0, i);
    axis.radius.push_back(1.5);
  }
  geometry::complete(axis);
  geometry::VesselTree tree;
  tree.nodes = {{1, axis.points.front()}, {2, axis.points.back()}};
  tree.segments = {{3, 1, 2, axis}};
  tree.vessels = {{4, "LAD", {3}}};
  return tree;
}

TEST(Preview, ATreeIsItsTubes) {
  const Picture picture = tree_preview(straight_tree());
  EXPECT_LT(picture.png().size(), most_bytes);
  const Seen seen(picture);
  const auto [width, height] = extent(seen);
  EXPECT_GT(height, 3 * picture.height() / 4) << "upright, as long as the picture allows";
  EXPECT_NEAR(width / static_cast<double>(height), 3.0 / 43.0, 0.03);
}

/// A bright ball about the middle, in dark.
template <class T>
imaging::Volume<T> bright_ball(double inside, double outside) {
  imaging::Volume<T> volume;
  volume.geometry.size = {40, 40, 20};
  volume.geometry.spacing = {0.5, 0.5, 1.0};
  volume.voxels.resize(static_cast<std::size_t>(volume.geometry.voxels()));
  for (std::int64_t k = 0; k < 20; ++k)
    for (std::int64_t j = 0; j < 40; ++j)
      for (std::int64_t i = 0; i < 40; ++i) {
        const double r = std::hypot(0.5 * (i - 19.5), 0.5 * (j - 19.5), 1.0 * (k - 9.5));
        volume(i, j, k) = static_cast<T>(r < 5.0 ? inside : outside);
      }
  return volume;
}

void expect_three_discs(const Picture& picture) {
  EXPECT_LT(picture.png().size(), most_bytes);
  const Raster raster = picture.raster();
  const auto bright = [&](int x, int y) { return raster.pixel(x, y)[0] > 200; };
  // Along the middle row: three stretches of the ball's diameter, half of a slice each.
  std::vector<int> stretches;
  for (int x = 0, run = 0; x < raster.width; ++x) {
    run = bright(x, raster.height / 2) ? run + 1 : 0;
    if (run > 0 && (x + 1 == raster.width || !bright(x + 1, raster.height / 2))) stretches.push_back(run);
  }
  ASSERT_EQ(stretches.size(), 3u);
  for (const int stretch : stretches) EXPECT_NEAR(stretch, 60, 7) << "10 of 20 mm, of 120 pixels";
}

TEST(Preview, AVolumeIsThreePlanesOfOneScale) {
  expect_three_discs(volume_preview(bright_ball<std::int16_t>(690, -100)));
  expect_three_discs(volume_preview(bright_ball<std::uint8_t>(1, 0)));
  expect_three_discs(volume_preview(bright_ball<float>(0.9, 0.1)));
}

TEST(Preview, AVesselIsStraight) {
  imaging::ImageVolume image;
  image.geometry.size = {48, 48, 90};
  image.geometry.spacing = {0.5, 0.5, 0.5};
  image.geometry.origin = {-11.75, -11.75, -2.0};
  image.voxels.resize(static_cast<std::size_t>(image.geometry.voxels()));
  for (std::int64_t k = 0; k < 90; ++k)
    for (std::int64_t j = 0; j < 48; ++j)
      for (std::int64_t i = 0; i < 48; ++i) {
        const geometry::Vec3 at = image.geometry.world({double(i), double(j), double(k)});
        image(i, j, k) = std::hypot(at.x(), at.y()) < 3.0 ? 700 : -200;
      }
  const geometry::VesselTree tree = straight_tree();
  const auto axis = std::make_shared<const geometry::AxisCurve>(geometry::vessel_axis(tree, tree.vessels[0]));
  const Picture picture = vessel_preview(image, {axis, "LAD"});
  EXPECT_LT(picture.png().size(), most_bytes);
  const Raster raster = picture.raster();
  int rows = 0;
  for (int y = 0; y < raster.height; ++y) {
    int white = 0;
    for (int x = 0; x < raster.width / 2; ++x) {
      const std::uint8_t* pixel = raster.pixel(x, y);
      // The ground of the picture is light, too, but lies outside of the dark strip.
      bool in_strip = false;
      for (int d = 1; d < 60 && x - d >= 0; ++d) in_strip = in_strip || raster.pixel(x - d, y)[0] < 30;
      white += in_strip && pixel[0] > 240 && pixel[2] > 240 ? 1 : 0;
    }
    rows += white > 20 ? 1 : 0;
  }
  EXPECT_GT(rows, raster.height / 2) << "a bright band from end to end";
}

TEST(Preview, NothingIsRefused) {
  EXPECT_THROW(surface_preview({}), InvalidInput);
  EXPECT_THROW(mesh_preview({}), InvalidInput);
  EXPECT_THROW(tree_preview({}), InvalidInput);
  EXPECT_THROW(volume_preview(imaging::ImageVolume()), InvalidInput);
  EXPECT_THROW(vessel_preview({}, {}), InvalidInput);
}

}  // namespace
}  // namespace ostia::figure
