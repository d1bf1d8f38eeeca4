#include "ostia/geometry/branch_groups.h"

#include "branch_exits.h"

#include "ostia/geometry/disjoint_sets.h"

#include <algorithm>
#include <tuple>

namespace ostia::geometry {
namespace {

// Shorter stretches are none.
constexpr double least_tract_mm = 1e-9;

/// A bifurcation on a vessel's way: one fork, or several that overlap.
struct Bifurcation {
  std::int32_t set = 0;
  LinePlace from, to;
};

/// The bifurcations on one vessel's way, in its order; each fork's set is `set_of` its node.
template <class SetOf>
std::vector<Bifurcation> bifurcations_of(const std::vector<ForkOnLine>& forks, const SetOf& set_of) {
  std::map<std::int32_t, Bifurcation> by_set;
  for (const ForkOnLine& fork : forks) {
    const std::int32_t set = set_of(fork.node);
    const auto [found, added] = by_set.try_emplace(set, Bifurcation{set, fork.from, fork.to});
    found->second.from = std::min(found->second.from, fork.from);
    found->second.to = std::max(found->second.to, fork.to);
  }
  std::vector<Bifurcation> all;
  for (const auto& [set, one] : by_set) all.push_back(one);
  std::sort(all.begin(), all.end(),
            [](const Bifurcation& a, const Bifurcation& b) { return a.from < b.from; });
  return all;
}

std::vector<LinePlace> stretch(const LinePlace& from, const LinePlace& to) {
  std::vector<LinePlace> places{from};
  for (std::size_t k = from.piece + 1; LinePlace{k, 0.0} < to; ++k) places.push_back({k, 0.0});
  places.push_back(to);
  return places;
}

class Grouping {
 public:
  explicit Grouping(const VesselTree& tree) : lines_(vessel_lines(tree)) {
    BranchExits exits(tree, lines_);
    for (std::size_t i = 0; i < lines_.size(); ++i) forks_.push_back(exits.forks(i));
    for (const auto& forks : forks_)
      for (const ForkOnLine& fork : forks)
        index_.try_emplace(fork.node, static_cast<std::int32_t>(index_.size()));
    sets_ = DisjointSets(index_.size());
    while (unite_overlapping()) {
    }
  }

  BranchedLines result() {
    BranchedLines out;
    for (std::size_t i = 0; i < lines_.size(); ++i) out.lines.push_back(branched(i));
    out.groups = static_cast<std::int32_t>(groups_.size());
    return out;
  }

 private:
  /// A bifurcation: its set and -1. A branch: the bifurcation that it leaves (-1: none), and -2 less the one
  /// that it runs to; where there is none, the segment on which it begins. Lines that run apart from the root
  /// on, but within each other's tubes, are one branch so.
  using Key = std::pair<std::int32_t, std::int32_t>;

  std::vector<Bifurcation> on_line(std::size_t i) {
    return bifurcations_of(forks_[i], [&](std::int32_t node) { return sets_.find(index_.at(node)); });
  }

  bool unite_overlapping() {
    bool united = false;
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      const std::vector<Bifurcation> all = on_line(i);
      for (std::size_t b = 1; b < all.size(); ++b) {
        if (all[b - 1].to < all[b].from) continue;
        sets_.join(all[b - 1].set, all[b].set);
        united = true;
      }
    }
    return united;
  }

  std::int32_t segment_at(const VesselLine& line, const LinePlace& place) const {
    const auto found = std::upper_bound(line.ends.begin(), line.ends.end(), place.piece);
    const auto k = static_cast<std::size_t>(found - line.ends.begin());
    return line.vessel->segments[std::min(k, line.vessel->segments.size() - 1)];
  }

  void add(const VesselLine& line, const LinePlace& from, const LinePlace& to, bool blanked, const Key& key,
           std::vector<Tract>& tracts) {
    if (value_at(line.axis.abscissa, to) - value_at(line.axis.abscissa, from) < least_tract_mm) return;
    const auto next = static_cast<std::int32_t>(groups_.size());
    tracts.push_back({groups_.try_emplace(key, next).first->second, blanked, stretch(from, to)});
  }

  BranchedLine branched(std::size_t i) {
    VesselLine& line = lines_[i];
    BranchedLine out;
    out.vessel = line.vessel->id;
    LinePlace at;
    std::int32_t behind = -1;
    for (const Bifurcation& one : on_line(i)) {
      add(line, at, one.from, false, {behind, -2 - one.set}, out.tracts);
      add(line, one.from, one.to, true, {one.set, -1}, out.tracts);
      at = one.to;
      behind = one.set;
    }
    add(line, at, {line.axis.size() - 1, 0.0}, false, {behind, segment_at(line, at)}, out.tracts);
    for (std::size_t p = 0; p < line.axis.size(); ++p) {
      const auto k = std::lower_bound(line.ends.begin(), line.ends.end(), p) - line.ends.begin();
      out.segments.push_back(line.vessel->segments[static_cast<std::size_t>(k)]);
    }
    out.axis = std::move(line.axis);
    return out;
  }

  std::vector<VesselLine> lines_;
  std::vector<std::vector<ForkOnLine>> forks_;  // of each line
  std::map<std::int32_t, std::int32_t> index_;  // of each fork's node
  DisjointSets sets_{0};
  std::map<Key, std::int32_t> groups_;
};

}  // namespace

BranchedLines branch_groups(const VesselTree& tree) {
  return Grouping(tree).result();
}

Centerline tract_axis(const BranchedLine& line, const Tract& tract) {
  Centerline out;
  for (const LinePlace& place : tract.places) {
    out.points.push_back(value_at(line.axis.points, place));
    out.radius.push_back(value_at(line.axis.radius, place));
    out.abscissa.push_back(value_at(line.axis.abscissa, place));
    const std::vector<Frame>& frames = line.axis.frames;
    out.frames.push_back(place.t == 0.0
                             ? frames[place.piece]
                             : interpolated(frames[place.piece], frames[place.piece + 1], place.t));
  }
  return out;
}

}  // namespace ostia::geometry
