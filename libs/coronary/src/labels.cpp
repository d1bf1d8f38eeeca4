#include "ostia/coronary/labels.h"

#include "branch_rules.h"
#include "name_certainty.h"
#include "name_reading.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace ostia::coronary {
namespace {

/// All paths named, and the order in which that was done: parents first.
struct Naming {
  std::vector<PathName> names;
  MainVessels main;
  std::vector<int> order;
};

/// The path that was named and shares most with this one; ties go to the one named first.
void find_parent(const std::vector<TreePath>& paths, const std::vector<int>& done, int path, PathName& name) {
  name.parent = -1;
  name.leave_mm = -1.0;
  const TreePath& own = paths[static_cast<std::size_t>(path)];
  for (const int other : done) {
    const TreePath& that = paths[static_cast<std::size_t>(other)];
    if (that.root != own.root) continue;
    const double shared = shared_mm(own, that);
    if (shared <= name.leave_mm) continue;
    name.leave_mm = shared;
    name.parent = other;
  }
  name.leave_mm = std::max(0.0, name.leave_mm);
}

/// Of the paths without a name, the one with the longest way of its own (a fork within a branch is its
/// branch).
int longest_left(const std::vector<TreePath>& paths, Naming& naming) {
  int best = -1;
  double longest = -1.0;
  for (int i = 0; i < static_cast<int>(paths.size()); ++i) {
    if (std::find(naming.order.begin(), naming.order.end(), i) != naming.order.end()) continue;
    PathName& name = naming.names[static_cast<std::size_t>(i)];
    find_parent(paths, naming.order, i, name);
    const double own = paths[static_cast<std::size_t>(i)].length() - name.leave_mm;
    if (own <= longest) continue;
    longest = own;
    best = i;
  }
  return best;
}

Naming named_by(const NameReading& reading) {
  Naming naming;
  naming.names = reading.sided.names;
  naming.main = reading.sided.main;
  for (const int main : {naming.main.lad, naming.main.lcx, naming.main.rca})
    if (main >= 0) naming.order.push_back(main);
  for (std::size_t i = 0; i < naming.names.size(); ++i)
    if (naming.names[i].kind == "SVG") naming.order.push_back(static_cast<int>(i));
  for (int next = longest_left(reading.paths, naming); next >= 0;
       next = longest_left(reading.paths, naming)) {
    name_branch(reading.paths, naming.main, naming.names, next);
    naming.order.push_back(next);
  }
  settle_posterior(reading.paths, naming.names);
  return naming;
}

/// What the rules say becomes a probability, and that of the heart's lie comes into it.
void make_probable(const NameReading& reading, Naming& naming) {
  for (PathName& name : naming.names) {
    const double raw = name.confidence;
    name.confidence = reading.probability * as_probability(raw);
    // The second has its share of what the first leaves.
    const double left = reading.probability - name.confidence;
    name.second_confidence = raw < 1.0 ? left * name.second_confidence / (1.0 - raw) : 0.0;
  }
}

/// Numbers branches of a kind from their parent's beginning: D1, D2; the first of others has none: AM, AM2.
class Numbering {
 public:
  Numbering(const Naming& naming, double least_confidence) {
    std::map<std::string, std::vector<int>> of_kind;
    for (const int i : naming.order) {
      const PathName& name = naming.names[static_cast<std::size_t>(i)];
      if (!name.kind.empty()) of_kind[name.kind].push_back(i);
    }
    for (auto& [kind, members] : of_kind) {
      std::stable_sort(members.begin(), members.end(), [&](int a, int b) {
        const PathName &x = naming.names[static_cast<std::size_t>(a)],
                       &y = naming.names[static_cast<std::size_t>(b)];
        return x.leave_mm < y.leave_mm;
      });
      int number = 1;
      for (const int i : members) {
        const bool given = naming.names[static_cast<std::size_t>(i)].confidence >= least_confidence;
        likeliest_[i] = numbered(kind, number);
        if (!given) continue;
        name_[i] = likeliest_[i];
        ++number;
      }
    }
    for (const int i : naming.order) {
      const PathName& own = naming.names[static_cast<std::size_t>(i)];
      if (own.second.empty()) continue;
      const auto before = std::count_if(naming.order.begin(), naming.order.end(), [&](int other) {
        const PathName& that = naming.names[static_cast<std::size_t>(other)];
        return that.kind == own.second && name_.contains(other) && that.leave_mm < own.leave_mm;
      });
      second_[i] = numbered(own.second, 1 + static_cast<int>(before));
    }
  }
  std::string likeliest(int path) const { return at(likeliest_, path); }
  std::string name(int path) const { return at(name_, path); }
  std::string second(int path) const { return at(second_, path); }

 private:
  static std::string numbered(const std::string& kind, int number) {
    const bool first_too = kind == "D" || kind == "OM" || kind == "S";
    return number > 1 || first_too ? kind + std::to_string(number) : kind;
  }
  static std::string at(const std::map<int, std::string>& names, int path) {
    const auto found = names.find(path);
    return found == names.end() ? std::string() : found->second;
  }
  std::map<int, std::string> likeliest_, name_, second_;
};

/// Ids of the vessels that reached each end before, and new ones for the others.
std::vector<std::int32_t> vessel_ids(const geometry::VesselTree& tree, const std::vector<TreePath>& paths) {
  std::map<std::int32_t, std::int32_t> by_last;  // segment -> vessel
  std::int32_t next = 1;
  for (const geometry::Vessel& vessel : tree.vessels) {
    by_last.emplace(vessel.segments.back(), vessel.id);
    next = std::max(next, vessel.id + 1);
  }
  std::vector<std::int32_t> ids;
  for (const TreePath& path : paths) {
    const auto found = by_last.find(path.segments.back());
    ids.push_back(found != by_last.end() ? found->second : next++);
  }
  return ids;
}

/// Where neither main vessel of the left tree lies where it should, the names of the right one are not to be
/// trusted either: it may be a part of a heart alone.
bool doubtful(std::size_t ostia, Naming& naming) {
  constexpr double unsure = 0.65;
  const auto weak = [&](int path) {
    return path < 0 || naming.names[static_cast<std::size_t>(path)].confidence < unsure;
  };
  const bool left = std::any_of(naming.names.begin(), naming.names.end(),
                                [](const PathName& name) { return name.side == CoronarySide::left; });
  if ((!left && ostia < 2) || !weak(naming.main.lad) || !weak(naming.main.lcx)) return false;
  for (PathName& name : naming.names) {
    name.confidence *= 0.5;
    name.second_confidence *= 0.5;
  }
  return true;
}

std::size_t count_of_roots(const std::vector<TreePath>& paths) {
  std::set<std::int32_t> roots;
  for (const TreePath& path : paths) roots.insert(path.root);
  return roots.size();
}

void tell(const Naming& naming, LabelledTree& result) {
  const auto missing = [&](int path, const char* what) {
    if (path < 0) result.warnings.push_back(std::string("no vessel runs as the ") + what + " does");
  };
  const auto any = [&](CoronarySide side) {
    return std::any_of(naming.names.begin(), naming.names.end(),
                       [&](const PathName& name) { return name.side == side; });
  };
  if (any(CoronarySide::left)) {
    missing(naming.main.lad, "LAD");
    missing(naming.main.lcx, "LCX");
  } else {
    result.warnings.push_back("there is no left coronary artery");
  }
  if (!any(CoronarySide::right)) result.warnings.push_back("there is no right coronary artery");
  const auto unnamed = std::count_if(result.tree.vessels.begin(), result.tree.vessels.end(),
                                     [](const geometry::Vessel& v) { return v.name.front() == 'V'; });
  if (unnamed > 0)
    result.warnings.push_back(std::to_string(unnamed) + (unnamed == 1 ? " vessel has" : " vessels have") +
                              " a number for a name: where it runs does not say what it is");
}

}  // namespace

void validate(const LabelOptions& options) {
  const auto& axis = options.heart.long_axis;
  if (axis && !(axis->allFinite() && axis->norm() > 1e-6))
    throw InvalidInput("names of coronary arteries: the heart's long axis is no direction");
  if (!(options.least_confidence >= 0.0 && options.least_confidence <= 1.0))
    throw InvalidInput("names of coronary arteries: the least confidence is " +
                       std::to_string(options.least_confidence) + "; give 0 to 1");
}

const char* word(CoronaryDominance dominance) {
  switch (dominance) {
    case CoronaryDominance::right:
      return "right";
    case CoronaryDominance::left:
      return "left";
    case CoronaryDominance::balanced:
      return "balanced";
    case CoronaryDominance::unknown:
      break;
  }
  return "unknown";
}

LabelledTree label_branches(const geometry::VesselTree& tree, const LabelOptions& options) {
  validate(options);
  if (const auto fault = geometry::find_fault(tree))
    throw InvalidInput("names of coronary arteries: " + *fault);
  const std::vector<TreePath> paths = paths_of(tree);
  if (paths.empty()) throw InvalidInput("names of coronary arteries: the tree has no segments");
  const NameReading reading = likeliest_reading(paths, options.heart.long_axis);
  Naming naming = named_by(reading);
  make_probable(reading, naming);

  LabelledTree result;
  result.lie = {word(reading), reading.probability, as_given(reading)};
  const bool unsure = doubtful(count_of_roots(paths), naming);
  if (!result.lie.as_given)
    result.warnings.push_back("the arteries lie as in a heart that is " + result.lie.word + " (probability " +
                              std::to_string(std::lround(100.0 * reading.probability)) +
                              " %): look whether the image is mirrored or turned; no vessel has a name");
  else if (unsure)
    result.warnings.push_back(
        "the left coronary arteries do not lie as they do in a heart: look whether the image is mirrored or "
        "shows a part of the heart alone");
  result.tree.nodes = tree.nodes;
  result.tree.segments = tree.segments;
  result.long_axis = reading.frame.long_axis.cwiseProduct(reading.signs);
  constexpr double never = 2.0;
  const Numbering numbering(naming, options.least_confidence);
  const std::vector<std::int32_t> ids = vessel_ids(tree, paths);
  int unnamed = 0;
  for (const int i : naming.order) {
    const auto n = static_cast<std::size_t>(i);
    const PathName& own = naming.names[n];
    std::string name = result.lie.as_given ? numbering.name(i) : "";
    const bool given = !name.empty();
    if (!given) name = "V" + std::to_string(++unnamed);
    result.tree.vessels.push_back({ids[n], name, paths[n].segments});
    result.labels.push_back({ids[n], own.side, numbering.likeliest(i), own.confidence, numbering.second(i),
                             own.second.empty() ? 0.0 : own.second_confidence, given});
  }
  result.dominance = dominance_of(reading.paths, naming.main, naming.names,
                                  result.lie.as_given ? options.least_confidence : never);
  tell(naming, result);
  return result;
}

}  // namespace ostia::coronary
