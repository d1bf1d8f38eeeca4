#include "growth/growth_topology.h"

#include "growth/growth_random.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace ostia::analysis {
namespace {

class TopologyMaker {
 public:
  TopologyMaker(const Morphometry& table, const std::vector<GrowthRoot>& roots, std::uint64_t seed,
                std::int64_t most_segments)
      : table_(table), roots_(roots), seed_(seed), most_segments_(most_segments) {
    waiting_.resize(static_cast<std::size_t>(table.highest()) + 1);
    made_.root_element.assign(roots.size(), -1);
  }

  GrowthTopology make(const core::TaskContext& task) {
    for (std::int32_t n = table_.highest(); n >= 1; --n) {
      task.throw_if_cancelled();
      const std::size_t first = made_.elements.size();
      add_roots(n);
      const auto& from_above = waiting_[static_cast<std::size_t>(n)];
      made_.elements.insert(made_.elements.end(), from_above.begin(), from_above.end());
      branch_out(n, first);
      give_diameters(n, first);
      give_lengths(n, first);
      waiting_[static_cast<std::size_t>(n)] = {};
    }
    return std::move(made_);
  }

 private:
  void add_roots(std::int32_t n) {
    for (std::size_t i = 0; i < roots_.size(); ++i) {
      if (roots_[i].order != n) continue;
      made_.root_element[i] = static_cast<std::int32_t>(made_.elements.size());
      GrowthElement element;
      element.order = n;
      element.diameter_mm = roots_[i].diameter_mm;
      made_.elements.push_back(element);
    }
  }

  /// The list grows while it is walked: an element may have daughters of its own order.
  void branch_out(std::int32_t n, std::size_t first) {
    GrowthRandom random(seed_, static_cast<std::uint64_t>(n));
    std::vector<double> carried(static_cast<std::size_t>(n) + 1);
    for (double& c : carried) c = random.uniform();
    std::vector<std::int32_t> daughters;
    for (std::size_t e = first; e < made_.elements.size(); ++e) {
      daughters.clear();
      for (std::int32_t m = 0; m <= n; ++m) {
        double& sum = carried[static_cast<std::size_t>(m)];
        sum += table_.springs(m, n);
        const auto whole = static_cast<std::int32_t>(sum);
        sum -= whole;
        daughters.insert(daughters.end(), static_cast<std::size_t>(whole), m);
      }
      place_daughters(e, n, daughters, random);
      made_.segments += made_.elements[e].segments;
      if (made_.segments > most_segments_)
        throw ResourceError("growth would make more than " + std::to_string(most_segments_) +
                            " segments; begin at thinner vessels or allow more");
    }
  }

  /// The two widest of lower order part the element's end; all others leave along it.
  void place_daughters(std::size_t e, std::int32_t n, std::vector<std::int32_t>& daughters,
                       GrowthRandom& random) {
    const auto same = static_cast<std::ptrdiff_t>(std::count(daughters.begin(), daughters.end(), n));
    const auto end = daughters.end() - same;  // they stand in rising order
    const auto pair = std::min<std::ptrdiff_t>(2, end - daughters.begin());
    std::rotate(end - pair, end, daughters.end());
    const auto along = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(daughters.size()) - pair);
    for (std::size_t i = along; i > 1; --i)
      std::swap(daughters[i - 1],
                daughters[static_cast<std::size_t>(random.uniform() * static_cast<double>(i))]);
    made_.elements[e].segments = static_cast<std::int32_t>(along) + 1;
    for (std::size_t i = 0; i < daughters.size(); ++i) {
      if (daughters[i] == 0) continue;
      GrowthElement daughter;
      daughter.order = daughters[i];
      daughter.parent = static_cast<std::int32_t>(e);
      daughter.fork = static_cast<std::int32_t>(std::min(i, along));
      if (daughter.order == n)
        made_.elements.push_back(daughter);
      else
        waiting_[static_cast<std::size_t>(daughter.order)].push_back(daughter);
    }
  }

  void give_diameters(std::int32_t n, std::size_t first) {
    const Morphometry::Order& row = table_.order(n);
    const double margin = 1e-3 * row.diameter_mm;
    const double low = (n > 1 ? table_.upper_mm(n - 1) : 0.5 * row.diameter_mm) + margin;
    const double high = std::min(table_.upper_mm(n), 2.0 * row.diameter_mm) - margin;
    GrowthRandom random(seed_, 1000U + static_cast<std::uint64_t>(n));
    std::vector<std::size_t> drawn;
    for (std::size_t e = first; e < made_.elements.size(); ++e) {
      if (made_.elements[e].diameter_mm > 0.0) continue;
      made_.elements[e].diameter_mm =
          std::clamp(row.diameter_mm + row.diameter_sd_mm * random.normal(), low, high);
      drawn.push_back(e);
    }
    // What the bounds cut off moves the mean; a shift of all brings it back.
    for (int round = 0; round < 20 && !drawn.empty(); ++round) {
      double sum = 0.0;
      for (const std::size_t e : drawn) sum += made_.elements[e].diameter_mm;
      const double shift = row.diameter_mm - sum / static_cast<double>(drawn.size());
      for (const std::size_t e : drawn)
        made_.elements[e].diameter_mm = std::clamp(made_.elements[e].diameter_mm + shift, low, high);
    }
    // A daughter of its parent's own order is the narrower of the two, or it would be the one that continues.
    for (bool again = true; again;) {
      again = false;
      for (const std::size_t e : drawn) {
        GrowthElement& own = made_.elements[e];
        if (own.parent < static_cast<std::int32_t>(first)) continue;
        GrowthElement& parent = made_.elements[static_cast<std::size_t>(own.parent)];
        if (parent.diameter_mm >= own.diameter_mm) continue;
        if (parent.parent < 0) {
          own.diameter_mm = parent.diameter_mm;  // a root keeps its own
        } else {
          std::swap(parent.diameter_mm, own.diameter_mm);
          again = true;
        }
      }
    }
  }

  void give_lengths(std::int32_t n, std::size_t first) {
    const Morphometry::Order& row = table_.order(n);
    GrowthRandom random(seed_, 2000U + static_cast<std::uint64_t>(n));
    const double spread = row.length_sd_mm / row.length_mm;
    double sum = 0.0, free = 0.0;
    std::vector<double> least(made_.elements.size() - first);
    for (std::size_t e = first; e < made_.elements.size(); ++e) {
      GrowthElement& own = made_.elements[e];
      // The element begins on its parent's axis: it must come out of it, however wide that is, and should
      // have room for its forks.
      const double parent =
          own.parent < 0 ? 0.0 : made_.elements[static_cast<std::size_t>(own.parent)].diameter_mm;
      const double out = 0.6 * parent + own.diameter_mm;
      least[e - first] =
          std::max(own.parent < 0 ? 0.0 : out,
                   std::min(out + 1.5 * own.diameter_mm * (own.segments - 1), 0.9 * row.length_mm));
      own.length_mm = row.length_mm * (spread > 0.0 ? random.gamma(std::min(spread, 0.95)) : 1.0);
      own.length_mm = std::max(own.length_mm - least[e - first], 0.0);
      sum += least[e - first];
      free += own.length_mm;
    }
    const auto count = static_cast<double>(made_.elements.size() - first);
    const double scale = free > 0.0 ? std::max(count * row.length_mm - sum, 0.0) / free : 0.0;
    for (std::size_t e = first; e < made_.elements.size(); ++e)
      made_.elements[e].length_mm = least[e - first] + scale * made_.elements[e].length_mm;
  }

  const Morphometry& table_;
  const std::vector<GrowthRoot>& roots_;
  std::uint64_t seed_;
  std::int64_t most_segments_;
  std::vector<std::vector<GrowthElement>> waiting_;  ///< by order: what springs from higher ones
  GrowthTopology made_;
};

}  // namespace

GrowthTopology grow_topology(const Morphometry& table, const std::vector<GrowthRoot>& roots,
                             std::uint64_t seed, std::int64_t most_segments, const core::TaskContext& task) {
  for (const GrowthRoot& root : roots)
    if (root.order < 1 || root.order > table.highest())
      throw InvalidInput("growth: there is no order " + std::to_string(root.order) + " in the " + table.name +
                         "'s table; it has orders 1 to " + std::to_string(table.highest()));
  return TopologyMaker(table, roots, seed, most_segments).make(task);
}

}  // namespace ostia::analysis
