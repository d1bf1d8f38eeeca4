#include "bvh.h"

#include "ostia/core/parallel.h"

#include <algorithm>
#include <limits>

namespace ostia::geometry::detail {
namespace {

constexpr int bin_count = 12;
// From this depth on the splits are at the median, so that the depth stays within the traversal stacks.
constexpr int balanced_from_depth = 60;
constexpr std::size_t parallel_from = 1u << 15;  // items; below, a task costs more than it gains

struct BoxItem {
  BvhBox box;
  double middle[3];
  std::int32_t index;
};

struct Split {
  int axis = -1;
  int bin = 0;  // the first bin of the right side
  double lower = 0.0;
  double scale = 0.0;
};

/// The boxes of the items in each bin along an axis. Those of empty bins are left as they are.
class Bins {
 public:
  void add(int bin, const BvhBox& box) {
    if (counts_[bin]++ == 0)
      boxes_[bin] = box;
    else
      boxes_[bin].extend(box);
  }

  /// Takes the cheapest plane between two bins into `best` where it costs less than that.
  void improve(const Split& split, Split& best, double& best_cost) const {
    int filled[bin_count];
    int size = 0;
    for (int bin = 0; bin < bin_count; ++bin)
      if (counts_[bin] > 0) filled[size++] = bin;
    double right_cost[bin_count];  // of the filled bins from here on
    BvhBox box = BvhBox::nothing();
    std::size_t count = 0;
    for (int k = size - 1; k > 0; --k) {
      box.extend(boxes_[filled[k]]);
      count += counts_[filled[k]];
      right_cost[k] = box.half_area() * static_cast<double>(count);
    }
    box = BvhBox::nothing();
    count = 0;
    for (int k = 1; k < size; ++k) {
      box.extend(boxes_[filled[k - 1]]);
      count += counts_[filled[k - 1]];
      const double cost = box.half_area() * static_cast<double>(count) + right_cost[k];
      if (!(cost < best_cost)) continue;
      best_cost = cost;
      best = split;
      best.bin = filled[k - 1] + 1;
    }
  }

 private:
  std::size_t counts_[bin_count] = {};
  BvhBox boxes_[bin_count];
};

using Nodes = std::vector<BvhNode>;

struct Builder {
  std::vector<BoxItem> items;
  int leaf_size = 4;

  int bin_of(const BoxItem& item, const Split& split) const {
    return std::min(bin_count - 1, static_cast<int>((item.middle[split.axis] - split.lower) * split.scale));
  }

  /// Empty bins are passed over: a plane behind one parts the items as the plane before it does. Most nodes
  /// have fewer items than there are bins.
  Split best_split(std::size_t first, std::size_t last, const BvhBox& middles) const {
    Split splits[3];
    Bins bins[3];
    for (int axis = 0; axis < 3; ++axis) {
      const double extent = middles.upper[axis] - middles.lower[axis];
      const Split split{axis, 0, middles.lower[axis], bin_count / extent};
      if (extent > 0.0 && split.scale < std::numeric_limits<double>::max()) splits[axis] = split;
    }
    for (std::size_t i = first; i < last; ++i)
      for (int axis = 0; axis < 3; ++axis)
        if (splits[axis].axis >= 0) bins[axis].add(bin_of(items[i], splits[axis]), items[i].box);
    Split best;
    double best_cost = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis)
      if (splits[axis].axis >= 0) bins[axis].improve(splits[axis], best, best_cost);
    return best;
  }

  std::size_t split_at_median(std::size_t first, std::size_t last, const BvhBox& middles) {
    int axis = 0;
    for (int a = 1; a < 3; ++a) {
      if (middles.upper[a] - middles.lower[a] > middles.upper[axis] - middles.lower[axis]) axis = a;
    }
    const std::size_t half = first + (last - first) / 2;
    const auto at = [&](std::size_t i) { return items.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(first), at(half), at(last), [axis](const BoxItem& a, const BoxItem& b) {
      return a.middle[axis] < b.middle[axis] || (a.middle[axis] == b.middle[axis] && a.index < b.index);
    });
    return half;
  }

  /// The first item of the right side.
  std::size_t halve(std::size_t first, std::size_t last, int depth, const BvhBox& middles) {
    const Split split = depth < balanced_from_depth ? best_split(first, last, middles) : Split{};
    if (split.axis < 0) return split_at_median(first, last, middles);
    const auto begin = items.begin();
    const auto middle =
        std::partition(begin + static_cast<std::ptrdiff_t>(first), begin + static_cast<std::ptrdiff_t>(last),
                       [&](const BoxItem& item) { return bin_of(item, split) < split.bin; });
    return static_cast<std::size_t>(middle - begin);
  }

  /// Appends the tree of these items, whose indices of nodes count from the start of `nodes`.
  void build(std::size_t first, std::size_t last, int depth, Nodes& nodes) {
    BvhNode node{BvhBox::nothing(), 0, 0};
    BvhBox middles = BvhBox::nothing();
    for (std::size_t i = first; i < last; ++i) {
      node.box.extend(items[i].box);
      middles.extend(items[i].middle);
    }
    const std::size_t self = nodes.size();
    nodes.push_back(node);
    if (last - first <= static_cast<std::size_t>(leaf_size)) {
      nodes[self].next = static_cast<std::int32_t>(first);
      nodes[self].count = static_cast<std::int32_t>(last - first);
      return;
    }
    const std::size_t half = halve(first, last, depth, middles);
    if (last - first < parallel_from) {
      build(first, half, depth + 1, nodes);
      nodes[self].next = static_cast<std::int32_t>(nodes.size());
      build(half, last, depth + 1, nodes);
      return;
    }
    Nodes sides[2];
    core::parallel_for(2, 1, [&](std::size_t side) {
      sides[side].reserve(last - first);
      if (side == 0)
        build(first, half, depth + 1, sides[0]);
      else
        build(half, last, depth + 1, sides[1]);
    });
    append(sides[0], nodes);
    nodes[self].next = static_cast<std::int32_t>(nodes.size());
    append(sides[1], nodes);
  }

  static void append(const Nodes& more, Nodes& nodes) {
    const auto offset = static_cast<std::int32_t>(nodes.size());
    for (BvhNode node : more) {
      if (node.count == 0) node.next += offset;
      nodes.push_back(node);
    }
  }
};

}  // namespace

double BvhBox::half_area() const {
  const double x = upper[0] - lower[0], y = upper[1] - lower[1], z = upper[2] - lower[2];
  return x * y + y * z + z * x;
}

Bvh build_bvh(const std::vector<BvhBox>& boxes, int leaf_size) {
  if (boxes.empty()) return {};
  Builder builder;
  builder.leaf_size = leaf_size;
  builder.items.resize(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    BoxItem& item = builder.items[i];
    item.box = boxes[i];
    item.index = static_cast<std::int32_t>(i);
    for (int a = 0; a < 3; ++a) item.middle[a] = 0.5 * boxes[i].lower[a] + 0.5 * boxes[i].upper[a];
  }
  Bvh bvh;
  bvh.nodes.reserve(boxes.size());
  builder.build(0, boxes.size(), 0, bvh.nodes);
  bvh.order.resize(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) bvh.order[i] = builder.items[i].index;
  return bvh;
}

}  // namespace ostia::geometry::detail
