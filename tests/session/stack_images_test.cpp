#include "ostia/core/error.h"
#include "ostia/session/series_stack.h"

#include <gtest/gtest.h>

#include <limits>

namespace ostia::session {
namespace {

constexpr std::size_t one_of_stack = 10 * 10 * 10 * 2;

StackImages::Image cube(std::int64_t side = 10) {
  imaging::ImageVolume image;
  image.geometry.size = {side, side, side};
  image.voxels.assign(static_cast<std::size_t>(side * side * side), 1);
  return std::make_shared<const imaging::ImageVolume>(std::move(image));
}

TEST(StackImages, AllAreHeldWhereTheyFit) {
  StackImages images(std::vector<std::size_t>(5, one_of_stack), 5 * one_of_stack);
  EXPECT_TRUE(images.all_fit());
  EXPECT_EQ(images.frame_voxels(), std::numeric_limits<std::int64_t>::max());
  for (std::size_t n = 0; n < 5; ++n) images.take_frame(n, cube());
  for (std::size_t n = 0; n < 5; ++n) EXPECT_TRUE(images.whole(n)) << n << ": a frame is the whole image";
  EXPECT_EQ(images.held(), images.needed());
}

TEST(StackImages, TheLastShownAreKeptWithinTheBound) {
  StackImages images(std::vector<std::size_t>(8, one_of_stack), 6 * one_of_stack);
  EXPECT_FALSE(images.all_fit());
  for (const std::size_t n : {0u, 1u, 2u}) images.take(n, cube());
  images.shown(0);
  images.take(5, cube());
  EXPECT_TRUE(images.whole(0)) << "looked at since";
  EXPECT_FALSE(images.whole(1));
  EXPECT_TRUE(images.whole(2));
  EXPECT_TRUE(images.whole(5));
  EXPECT_EQ(images.frame(5), images.whole(5));
}

TEST(StackImages, ACineOfMoreThanFitsIsCoarserAndWithinTheBound) {
  StackImages images(std::vector<std::size_t>(20, one_of_stack), 4 * one_of_stack);
  const std::int64_t voxels = images.frame_voxels();
  EXPECT_LE(20 * voxels * 2, static_cast<std::int64_t>(images.budget() / 2));
  EXPECT_GT(voxels, 64);
  for (std::size_t n = 0; n < 20; ++n) images.take_frame(n, cube(4));
  for (std::size_t n = 0; n < 20; ++n) images.take(n, cube());
  for (std::size_t n = 0; n < 20; ++n) EXPECT_TRUE(images.frame(n)) << n;
  EXPECT_EQ(images.frame(19)->voxels.size(), 1000u) << "whole, where it is held";
  EXPECT_EQ(images.frame(0)->voxels.size(), 64u);
  EXPECT_LE(images.held(), images.budget());
}

TEST(StackImages, SizesThatAreNotKnownAreThoseOfTheFirst) {
  StackImages images(std::vector<std::size_t>(6, 0), 4 * one_of_stack);
  EXPECT_TRUE(images.all_fit()) << "nothing is known yet";
  images.take(0, cube());
  EXPECT_EQ(images.needed(), 6 * one_of_stack);
  EXPECT_FALSE(images.all_fit());
}

TEST(StackImages, OneIsHeldHoweverLargeItIs) {
  StackImages images({one_of_stack, one_of_stack}, 10);
  images.take(0, cube());
  EXPECT_TRUE(images.whole(0));
  images.take(1, cube());
  EXPECT_FALSE(images.whole(0));
  EXPECT_TRUE(images.whole(1));
  images.forget(1);
  EXPECT_EQ(images.held(), 0u);
  EXPECT_THROW(images.take(0, nullptr), InvalidInput);
  EXPECT_THROW(images.take(7, cube()), std::out_of_range);
  EXPECT_GT(StackImages::usual_budget(), 0u);
  EXPECT_LE(StackImages::usual_budget(), StackImages::default_budget);
}

}  // namespace
}  // namespace ostia::session
