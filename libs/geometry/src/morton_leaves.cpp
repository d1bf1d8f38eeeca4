#include "morton_leaves.h"

#include "ostia/core/parallel.h"

#include <algorithm>

namespace ostia::geometry::detail {
namespace {

constexpr int bits = 20;  // of each axis
constexpr int bucket_bits = 9;
constexpr std::size_t grain = 4096;

struct Item {
  std::uint64_t key;
  std::int32_t index;
  bool operator<(const Item& other) const {
    return key < other.key || (key == other.key && index < other.index);
  }
};

/// Two zeros after each bit.
std::uint64_t spread(std::uint64_t x) {
  x = (x | x << 32) & 0x1f00000000ffffULL;
  x = (x | x << 16) & 0x1f0000ff0000ffULL;
  x = (x | x << 8) & 0x100f00f00f00f00fULL;
  x = (x | x << 4) & 0x10c30c30c30c30c3ULL;
  return (x | x << 2) & 0x1249249249249249ULL;
}

BvhBox bounds(const std::vector<BvhBox>& boxes) {
  const auto join = [](BvhBox a, const BvhBox& b) {
    a.extend(b);
    return a;
  };
  return core::parallel_reduce(
      boxes.size(), 8 * grain, BvhBox::nothing(),
      [&](std::size_t first, std::size_t last) {
        BvhBox box = BvhBox::nothing();
        for (std::size_t i = first; i < last; ++i) box.extend(boxes[i]);
        return box;
      },
      join);
}

std::vector<Item> keyed(const std::vector<BvhBox>& boxes) {
  const BvhBox all = bounds(boxes);
  double scale[3];
  for (int a = 0; a < 3; ++a) {
    const double extent = all.upper[a] - all.lower[a];
    scale[a] = extent > 1e-300 ? (static_cast<double>(1 << bits) - 1.0) / extent : 0.0;
  }
  std::vector<Item> items(boxes.size());
  core::parallel_for(boxes.size(), grain, [&](std::size_t i) {
    std::uint64_t key = 0;
    for (int a = 0; a < 3; ++a) {
      const double middle = 0.5 * boxes[i].lower[a] + 0.5 * boxes[i].upper[a];
      key |= spread(static_cast<std::uint64_t>((middle - all.lower[a]) * scale[a])) << a;
    }
    items[i] = {key, static_cast<std::int32_t>(i)};
  });
  return items;
}

/// Into buckets by the highest bits, which are then sorted side by side.
std::vector<Item> sorted(const std::vector<Item>& items) {
  constexpr std::size_t buckets = 1u << bucket_bits;
  const auto bucket = [](const Item& item) {
    return static_cast<std::size_t>(item.key >> (3 * bits - bucket_bits));
  };
  std::vector<std::size_t> first(buckets + 1, 0);
  for (const Item& item : items) ++first[bucket(item) + 1];
  for (std::size_t b = 0; b < buckets; ++b) first[b + 1] += first[b];
  std::vector<std::size_t> next(first.begin(), first.end() - 1);
  std::vector<Item> result(items.size());
  for (const Item& item : items) result[next[bucket(item)]++] = item;
  core::parallel_for(buckets, 1, [&](std::size_t b) {
    std::sort(result.begin() + static_cast<std::ptrdiff_t>(first[b]),
              result.begin() + static_cast<std::ptrdiff_t>(first[b + 1]));
  });
  return result;
}

}  // namespace

MortonLeaves morton_leaves(const std::vector<BvhBox>& boxes) {
  MortonLeaves tree;
  if (boxes.empty()) return tree;
  const std::vector<Item> items = sorted(keyed(boxes));
  tree.order.resize(boxes.size());
  for (std::size_t i = 0; i < items.size(); ++i) tree.order[i] = items[i].index;
  tree.levels.emplace_back((boxes.size() + MortonLeaves::per_leaf - 1) / MortonLeaves::per_leaf,
                           BvhBox::nothing());
  core::parallel_for(tree.leaves(), 512, [&](std::size_t leaf) {
    for (std::size_t i = tree.first(leaf); i < tree.last(leaf); ++i)
      tree.levels[0][leaf].extend(boxes[static_cast<std::size_t>(tree.order[i])]);
  });
  while (tree.levels.back().size() > 1) {
    const std::vector<BvhBox>& below = tree.levels.back();
    std::vector<BvhBox> level((below.size() + 1) / 2, BvhBox::nothing());
    for (std::size_t i = 0; i < below.size(); ++i) level[i / 2].extend(below[i]);
    tree.levels.push_back(std::move(level));
  }
  return tree;
}

}  // namespace ostia::geometry::detail
