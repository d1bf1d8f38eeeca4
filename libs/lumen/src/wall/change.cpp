#include "wall/change.h"

#include "ostia/core/parallel.h"
#include "ostia/geometry/cube_patterns.h"

#include <bitset>
#include <cmath>
#include <map>

namespace ostia::lumen {
namespace {

constexpr int brick_cells = 4;
constexpr int bricks_along = block_cells / brick_cells;

/// Bricks of a block and those around it, which matter to the nodes on its faces.
class Bricks {
 public:
  static constexpr int along = bricks_along + 2;
  static constexpr std::size_t count = std::size_t{along} * along * along;

  /// The brick of a node of the block.
  static std::size_t of(const Place& node) {
    return at({(node[0] + brick_cells) / brick_cells, (node[1] + brick_cells) / brick_cells,
               (node[2] + brick_cells) / brick_cells});
  }
  static std::size_t at(const Place& brick) {
    return static_cast<std::size_t>(brick[0] + along * (brick[1] + along * brick[2]));
  }
  static Place place(std::size_t number) {
    const int n = static_cast<int>(number);
    return {n % along, n / along % along, n / (along * along)};
  }
};
using BrickSet = std::bitset<Bricks::count>;
using ChangedBricks = std::map<GridIndex, BrickSet>;  // by block

// Whether anything that the block was made from lies in a box. A seed's surroundings reach one cell further.
bool depends_on(const WallBlock& block, const Box3& box, double cell_mm) {
  Vec3 low, high;
  for (int a = 0; a < 3; ++a) {
    const int first = block.index[static_cast<std::size_t>(a)] * block_cells;
    low[a] = cell_mm * (first - 1);
    high[a] = cell_mm * (first + block_cells + 1);
  }
  return box.intersects(Box3(low, high));
}

/// A place where a block knows what the field was.
struct ChangeSample {
  Vec3 place;
  double value = 0.0;
  std::size_t brick = 0;
};

/// Chooses places in a box that tell whether the wall there is what it was.
class Sampling {
 public:
  Sampling(const WallJob& job, const WallBlock& block, const Box3& box)
      : job_(job), block_(block), box_(box) {}

  // Points of the wall: values at nodes may be clamped and hide a change. One crossing in four, and one node
  // of bricks without a crossing (around seeds off the wall, and behind it).
  std::vector<ChangeSample> samples() {
    each_crossing([&](const ChangeSample& sample, const Place& node) {
      if ((node[0] & 1) == (node[1] & 1) && (node[1] & 1) == (node[2] & 1)) take(sample);
    });
    each_crossing([&](const ChangeSample& sample, const Place&) { take_first(sample); });
    for (const auto& [code, value] : block_.kept.nodes) {
      const Place node = place_of_node(code);
      take_first({job_.node(in_grid(node, block_.index)), value, Bricks::of(node)});
    }
    return std::move(samples_);
  }

 private:
  template <class Visit>
  void each_crossing(const Visit& visit) const {
    for (const auto& [code, fraction] : block_.kept.crossings) {
      if (std::abs(fraction - 0.5) > 0.4995 - geometry::node_clearance) continue;  // kept off its node
      const Place node = place_of_node(node_of_edge(code));
      visit({job_.place(in_grid(node, block_.index), code % 3, fraction), 0.0, Bricks::of(node)}, node);
    }
  }
  void take(const ChangeSample& sample) {
    if (!box_.contains(sample.place)) return;
    samples_.push_back(sample);
    sampled_.set(sample.brick);
  }
  void take_first(const ChangeSample& sample) {
    if (!sampled_.test(sample.brick)) take(sample);
  }

  const WallJob& job_;
  const WallBlock& block_;
  const Box3& box_;
  std::vector<ChangeSample> samples_;
  BrickSet sampled_;
};

/// One block's part in finding what has changed.
struct Probe {
  WallBlock* block = nullptr;
  BrickSet changed;
};

void look(WallJob& job, Probe& probe, const Box3& box, double tolerance) {
  const std::vector<ChangeSample> samples = Sampling(job, *probe.block, box).samples();
  std::vector<Vec3> places;
  places.reserve(samples.size());
  for (const ChangeSample& sample : samples) places.push_back(sample.place);
  const std::vector<double> values = job.ask(places);
  for (std::size_t i = 0; i < samples.size(); ++i)
    if (!(std::abs(values[i] - samples[i].value) <= tolerance)) probe.changed.set(samples[i].brick);
}

// Tells a block's changed bricks to all blocks that they reach into.
void hand_out(const Probe& probe, ChangedBricks& changed) {
  for (std::size_t number = 0; number < Bricks::count; ++number) {
    if (!probe.changed.test(number)) continue;
    const Place brick = Bricks::place(number);
    for (int z = -1; z <= 1; ++z)
      for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
          const Place there{brick[0] - bricks_along * x, brick[1] - bricks_along * y,
                            brick[2] - bricks_along * z};
          if (std::any_of(there.begin(), there.end(), [](int b) { return b < 0 || b >= Bricks::along; }))
            continue;
          const GridIndex& from = probe.block->index;
          changed[{from[0] + x, from[1] + y, from[2] + z}].set(Bricks::at(there));
        }
  }
}

/// Forgets what of one block lies both in a box and in some bricks or within a cell of them: the wall may
/// have moved on to a node beside a brick.
class Forgetting {
 public:
  Forgetting(const WallJob& job, WallBlock& block, const Box3& box, const BrickSet& bricks)
      : job_(job), block_(block), box_(box), near_(node_codes, 0) {
    for (std::size_t brick = 0; brick < Bricks::count; ++brick)
      if (bricks.test(brick)) mark_near(Bricks::place(brick));
  }

  void forget() {
    const std::size_t nodes = std::erase_if(block_.kept.nodes, [&](const auto& known) {
      return near_[known.first] != 0 && box_.contains(at(known.first));
    });
    const std::size_t crossings =
        std::erase_if(block_.kept.crossings, [&](const auto& known) { return holds_edge(known.first); });
    if (nodes + crossings > 0) forget_pieces(block_);
    std::erase_if(block_.seeds, [&](const WallSeed& seed) { return !seed.crossed || holds_cell(seed.cell); });
  }

 private:
  void mark_near(const Place& brick) {
    Place from, to;
    for (std::size_t a = 0; a < 3; ++a) {
      const int first = brick_cells * (brick[a] - 1);
      from[a] = std::max(first - 1, 0);
      to[a] = std::min(first + brick_cells, block_cells);
    }
    for (int z = from[2]; z <= to[2]; ++z)
      for (int y = from[1]; y <= to[1]; ++y)
        for (int x = from[0]; x <= to[0]; ++x) near_[node_code({x, y, z})] = 1;
  }
  Vec3 at(NodeCode node) const { return job_.node(in_grid(place_of_node(node), block_.index)); }
  bool holds_edge(EdgeCode edge) const {
    const NodeCode from = node_of_edge(edge), to = end_of_edge(edge);
    return (near_[from] != 0 || near_[to] != 0) && box_.intersects(Box3(at(from), at(to)));
  }
  bool holds_cell(CellCode cell) const {
    const Place place = place_of_cell(cell);
    for (int corner = 0; corner < 8; ++corner)
      if (near_[node_code(corner_of(place, corner))] != 0) return true;
    return false;
  }

  const WallJob& job_;
  WallBlock& block_;
  const Box3& box_;
  std::vector<char> near_;  // nodes, by NodeCode
};

// The seeds that found no wall in their cell are always looked at again: nothing near them is sampled.
void forget_seeds_off_the_wall(WallBlock& block) {
  std::erase_if(block.seeds, [](const WallSeed& seed) { return !seed.crossed; });
}

}  // namespace

void forget_changed(WallJob& job, WallBlocks& blocks, const Box3& box, double tolerance) {
  std::vector<Probe> probes;
  for (auto& [index, block] : blocks)
    if (depends_on(block, box, job.cell_mm())) probes.push_back({&block, {}});
  ChangedBricks changed;
  if (tolerance > 0.0) {
    core::parallel_for(probes.size(), 1, [&](std::size_t i) { look(job, probes[i], box, tolerance); });
    for (const Probe& probe : probes) hand_out(probe, changed);
  }
  const BrickSet all = BrickSet().set();
  core::parallel_for(probes.size(), 1, [&](std::size_t i) {
    WallBlock& block = *probes[i].block;
    const auto found = changed.find(block.index);
    if (tolerance == 0.0)
      Forgetting(job, block, box, all).forget();
    else if (found != changed.end())
      Forgetting(job, block, box, found->second).forget();
    else
      forget_seeds_off_the_wall(block);
  });
}

}  // namespace ostia::lumen
