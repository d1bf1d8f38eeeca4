#include "morton_leaves.h"

#include "ostia/core/parallel.h"

#include <algorithm>
#include <utility>

namespace ostia::geometry::detail {
namespace {

constexpr int bits = 20;  // of each axis
constexpr int bucket_bits = 9;
constexpr std::size_t leaf_grain = 4096;

struct MortonItem {
  std::uint64_t key;
  std::int32_t index;
  bool operator<(const MortonItem& other) const {
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

std::vector<MortonItem> keyed(const std::vector<FloatBox>& boxes) {
  constexpr float most = static_cast<float>(1 << bits) - 1.0f;
  std::vector<MortonItem> items(boxes.size());
  core::parallel_for(boxes.size(), leaf_grain, [&](std::size_t i) {
    std::uint64_t key = 0;
    for (int a = 0; a < 3; ++a) {
      const float middle = 0.25f * (boxes[i].lower[a] + boxes[i].upper[a]) + 0.5f;
      key |= spread(static_cast<std::uint64_t>(std::clamp(middle, 0.0f, 1.0f) * most)) << a;
    }
    items[i] = {key, static_cast<std::int32_t>(i)};
  });
  return items;
}

/// Into buckets by the highest bits, which are then sorted side by side.
std::vector<MortonItem> sorted(const std::vector<MortonItem>& items) {
  constexpr std::size_t buckets = 1u << bucket_bits;
  const auto bucket = [](const MortonItem& item) {
    return static_cast<std::size_t>(item.key >> (3 * bits - bucket_bits));
  };
  std::vector<std::size_t> first(buckets + 1, 0);
  for (const MortonItem& item : items) ++first[bucket(item) + 1];
  for (std::size_t b = 0; b < buckets; ++b) first[b + 1] += first[b];
  std::vector<std::size_t> next(first.begin(), first.end() - 1);
  std::vector<MortonItem> result(items.size());
  for (const MortonItem& item : items) result[next[bucket(item)]++] = item;
  core::parallel_for(buckets, 1, [&](std::size_t b) {
    std::sort(result.begin() + static_cast<std::ptrdiff_t>(first[b]),
              result.begin() + static_cast<std::ptrdiff_t>(first[b + 1]));
  });
  return result;
}

std::vector<std::int32_t> morton_order(const std::vector<FloatBox>& boxes) {
  const std::vector<MortonItem> items = sorted(keyed(boxes));
  std::vector<std::int32_t> order(items.size());
  for (std::size_t i = 0; i < items.size(); ++i) order[i] = items[i].index;
  return order;
}

constexpr std::size_t per_leaf = MortonLeaves::per_leaf;

/// Of eight boxes in a row each; the last may have fewer.
std::vector<FloatBox> blocks_of(const std::vector<FloatBox>& boxes) {
  std::vector<FloatBox> blocks((boxes.size() + per_leaf - 1) / per_leaf, FloatBox::nothing());
  core::parallel_for(blocks.size(), 512, [&](std::size_t b) {
    for (std::size_t i = per_leaf * b; i < std::min(per_leaf * (b + 1), boxes.size()); ++i)
      blocks[b].extend(boxes[i]);
  });
  return blocks;
}

double sum_of_areas(const std::vector<FloatBox>& boxes) {
  const auto sum = [&](std::size_t first, std::size_t last) {
    double part = 0.0;
    for (std::size_t i = first; i < last; ++i) part += boxes[i].half_area();
    return part;
  };
  return core::parallel_reduce(boxes.size(), leaf_grain, 0.0, sum, [](double a, double b) { return a + b; });
}

/// The items of each block in a row, the blocks in Morton order but for the last, which may have fewer.
std::vector<std::int32_t> order_of_blocks(std::vector<FloatBox> blocks, std::size_t count) {
  const auto last = static_cast<std::int32_t>(blocks.size() - 1);
  blocks.pop_back();
  std::vector<std::int32_t> leaves = morton_order(blocks);
  leaves.push_back(last);
  std::vector<std::int32_t> order(count);
  core::parallel_for(count, leaf_grain, [&](std::size_t i) {
    order[i] =
        static_cast<std::int32_t>(per_leaf) * leaves[i / per_leaf] + static_cast<std::int32_t>(i % per_leaf);
  });
  return order;
}

std::vector<std::int32_t> leaf_order(const std::vector<FloatBox>& boxes) {
  // Eight flat triangles of a smooth wall in Morton order have a box of some three times their own areas.
  constexpr double most_growth = 6.0;
  std::vector<FloatBox> blocks = blocks_of(boxes);
  if (sum_of_areas(blocks) <= most_growth * sum_of_areas(boxes))
    return order_of_blocks(std::move(blocks), boxes.size());
  return morton_order(boxes);
}

void add_levels(MortonLeaves& tree) {
  while (tree.levels.back().size() > 1) {
    const std::vector<FloatBox>& below = tree.levels.back();
    std::vector<FloatBox> level((below.size() + 1) / 2, FloatBox::nothing());
    for (std::size_t i = 0; i < below.size(); ++i) level[i / 2].extend(below[i]);
    tree.levels.push_back(std::move(level));
  }
}

}  // namespace

UnitCube::UnitCube(const BvhBox& bounds) {
  for (int a = 0; a < 3; ++a) {
    const double half = 0.5 * bounds.upper[a] - 0.5 * bounds.lower[a];
    middle_[a] = 0.5 * bounds.lower[a] + 0.5 * bounds.upper[a];
    factor_[a] = half > 1e-300 ? 1.0 / half : 0.0;
  }
}

FloatBox UnitCube::operator()(const BvhBox& box) const {
  FloatBox result{};
  for (int a = 0; a < 3; ++a) {
    result.lower[a] = static_cast<float>((box.lower[a] - middle_[a]) * factor_[a]);
    result.upper[a] = static_cast<float>((box.upper[a] - middle_[a]) * factor_[a]);
  }
  return result;
}

MortonLeaves morton_leaves(const std::vector<FloatBox>& boxes) {
  MortonLeaves tree;
  if (boxes.empty()) return tree;
  tree.order = leaf_order(boxes);
  const std::size_t leaves = (boxes.size() + per_leaf - 1) / per_leaf;
  tree.boxes.resize(leaves);
  tree.levels.emplace_back(leaves, FloatBox::nothing());
  core::parallel_for(leaves, 512, [&](std::size_t leaf) {
    for (std::size_t k = 0; k < per_leaf; ++k) {
      const std::size_t i = per_leaf * leaf + k;
      const FloatBox box =
          i < boxes.size() ? boxes[static_cast<std::size_t>(tree.order[i])] : FloatBox::nothing();
      tree.boxes[leaf].set(k, box);
      tree.levels[0][leaf].extend(box);
    }
  });
  add_levels(tree);
  return tree;
}

}  // namespace ostia::geometry::detail
