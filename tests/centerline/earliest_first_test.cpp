#include "earliest_first.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <utility>
#include <vector>

namespace ostia::centerline {
namespace {

TEST(EarliestFirst, gives_times_in_order_and_of_equal_ones_the_lower_point) {
  std::mt19937 generator(3);
  std::vector<std::pair<double, std::int32_t>> entries;
  EarliestFirst queue;
  for (std::int32_t i = 0; i < 5000; ++i) {
    const double time = static_cast<double>(generator() % 50);  // many are equal
    const auto point = static_cast<std::int32_t>(generator() % 1000);
    entries.emplace_back(time, point);
    queue.push(time, point);
  }
  std::ranges::sort(entries);
  for (const auto& [time, point] : entries) {
    ASSERT_FALSE(queue.empty());
    const EarliestFirst::Entry entry = queue.pop();
    ASSERT_EQ(entry.time, time);
    ASSERT_EQ(entry.point, point);
  }
  EXPECT_TRUE(queue.empty());
}

TEST(EarliestFirst, takes_new_ones_while_it_is_emptied) {
  EarliestFirst queue;
  queue.push(1.0, 10);
  queue.push(3.0, 30);
  EXPECT_EQ(queue.pop().point, 10);
  queue.push(2.0, 20);
  queue.push(3.0, 29);
  for (const std::int32_t expected : {20, 29, 30}) EXPECT_EQ(queue.pop().point, expected);
  EXPECT_TRUE(queue.empty());
}

}  // namespace
}  // namespace ostia::centerline
