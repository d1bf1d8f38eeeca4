#include "network_system.h"

#include "circle.h"

#include "ostia/hemodynamics/junction_loss.h"

#include <algorithm>
#include <cmath>

namespace ostia::hemodynamics {

Links links_of(const PreparedNetwork& network) {
  Links links;
  links.children.resize(network.size());
  links.below.resize(network.size());
  const auto& branches = network.network().branches;
  std::vector<char> blocked(network.size(), 0);
  for (std::size_t i = 0; i < network.size(); ++i) {
    const int parent = branches[i].parent;
    if (parent >= 0) links.children[static_cast<std::size_t>(parent)].push_back(i);
    blocked[i] = network.branch(i).shut() || (parent >= 0 && blocked[static_cast<std::size_t>(parent)] != 0);
  }
  for (std::size_t k = 0; k < network.outlets().size(); ++k) {
    const std::size_t leaf = network.outlets()[k];
    if (blocked[leaf] != 0) continue;
    for (int b = static_cast<int>(leaf); b >= 0; b = branches[static_cast<std::size_t>(b)].parent)
      links.below[static_cast<std::size_t>(b)].push_back(links.open.size());
    links.open.push_back(leaf);
    links.open_outlets.push_back(k);
  }
  return links;
}

namespace {

std::vector<double> branch_flows(const Links& links, const Eigen::VectorXd& open) {
  std::vector<double> flow(links.below.size(), 0.0);
  for (std::size_t b = 0; b < flow.size(); ++b)
    for (const std::size_t k : links.below[b]) flow[b] += open[static_cast<Eigen::Index>(k)];
  return flow;
}

void add_forks(const PreparedNetwork& network, const FlowModel& model, const Links& links, Losses& losses) {
  if (model.junctions == JunctionLaw::none || !model.inertia) return;
  for (std::size_t parent = 0; parent < network.size(); ++parent) {
    const double area = network.branch(parent).last_area_mm2;
    if (!(area > 0.0)) continue;
    std::vector<ForkBranch> fork;
    std::vector<std::size_t> of;
    for (const std::size_t child : links.children[parent]) {
      const double first = network.branch(child).first_area_mm2;
      if (links.below[child].empty() || !(first > shut_mm2)) continue;
      fork.push_back({losses.flow[child], first, network.network().branches[child].angle_rad});
      of.push_back(child);
    }
    const auto drops = fork_drops(model.density_kg_m3 * model.inertia_scale, losses.flow[parent], area, fork);
    for (std::size_t i = 0; i < of.size(); ++i) {
      losses.at_fork[of[i]] = drops[i].pa;
      losses.by_own[of[i]] = drops[i].by_own_pa_s_ml;
      losses.by_parent[of[i]] = drops[i].by_parent_pa_s_ml;
    }
  }
}

/// The profile at the beginning of a branch, and how it changes with flows.
struct Profile {
  double momentum = developed_momentum;
  std::vector<ByFlow> by;
};

/// Of a jet that comes to the fork. It goes straight on, and the fork's edge, which lies half way between the
/// branches' directions, splits it where they turn nearly alike. One that is occluded takes none.
double share_of_jet(const PreparedNetwork& network, const Links& links, std::size_t parent,
                    std::size_t child) {
  constexpr double misses_rad = 30.0 * pi / 180.0;  // so much less of a turn, and all goes there
  const auto turn = [&](std::size_t b) { return std::abs(network.network().branches[b].angle_rad); };
  double least = HUGE_VAL, all = 0.0;
  for (const std::size_t b : links.children[parent])
    if (!links.below[b].empty()) least = std::min(least, turn(b));
  const auto weight = [&](std::size_t b) {
    const double left = std::max(0.0, 1.0 - (turn(b) - least) / misses_rad);
    return left * left;
  };
  for (const std::size_t b : links.children[parent])
    if (!links.below[b].empty()) all += weight(b);
  return weight(child) / all;
}

/// What of a jet's excess over the developed profile goes a branch's way keeps its speed, so that the
/// coefficient goes with the ratio of the mean speeds.
Profile handed_on(const PreparedNetwork& network, std::size_t parent, const Profile& behind,
                  std::size_t child, double share, const std::vector<double>& flow) {
  Profile profile;
  const double before = network.branch(parent).last_area_mm2, first = network.branch(child).first_area_mm2;
  const double excess = behind.momentum - developed_momentum;
  const double along = share * std::cos(network.network().branches[child].angle_rad);
  if (!(excess > 0.0 && along > 0.0 && flow[child] > 0.0 && flow[parent] > 0.0 && first > shut_mm2))
    return profile;
  const double ratio = along * flow[parent] * first / (before * flow[child]);
  profile.momentum += excess * ratio;
  for (const ByFlow& one : behind.by) profile.by.push_back({one.branch, one.value * ratio});
  profile.by.push_back({parent, excess * ratio / flow[parent]});
  profile.by.push_back({child, -excess * ratio / flow[child]});
  return profile;
}

/// Along all branches, a parent before its children.
void add_branches(const PreparedNetwork& network, const FlowModel& model, const Links& links,
                  Losses& losses) {
  std::vector<Profile> behind(network.size());
  for (std::size_t b = 0; b < network.size(); ++b) {
    if (links.below[b].empty()) continue;
    const int parent = network.network().branches[b].parent;
    Profile start{network.branch(b).start_momentum, {}};
    if (parent >= 0 && model.inertia)
      start = handed_on(network, static_cast<std::size_t>(parent), behind[static_cast<std::size_t>(parent)],
                        b, share_of_jet(network, links, static_cast<std::size_t>(parent), b), losses.flow);
    const Passage passage = pass(network.branch(b), model, losses.flow[b], start.momentum,
                                 !model.inertia || links.children[b].empty(), !start.by.empty());
    losses.along[b] = passage.pa;
    losses.by_flow[b] = passage.by_flow_pa_s_ml;
    losses.start_momentum[b] = start.momentum;
    behind[b].momentum = passage.momentum;
    if (passage.momentum_by_flow_s_ml != 0.0) behind[b].by.push_back({b, passage.momentum_by_flow_s_ml});
    for (const ByFlow& one : start.by) {
      losses.by_others[b].push_back({one.branch, one.value * passage.by_momentum_pa});
      if (passage.momentum_by_momentum != 0.0)
        behind[b].by.push_back({one.branch, one.value * passage.momentum_by_momentum});
    }
  }
}

void add_entries(const PreparedNetwork& network, const FlowModel& model, const Links& links, Losses& losses) {
  if (!model.inertia || !model.from_rest) return;
  for (std::size_t root = 0; root < network.size(); ++root) {
    const double area = network.branch(root).first_area_mm2;
    if (network.network().branches[root].parent >= 0 || links.below[root].empty() || !(area > shut_mm2))
      continue;
    const double flow = std::max(0.0, losses.flow[root]);
    const double energy = 1.0 + 3.0 * (model.root_momentum - 1.0);
    const double scale = model.density_kg_m3 * model.inertia_scale * energy / (area * area);
    losses.at_fork[root] = 0.5 * scale * flow * flow;
    losses.by_own[root] = scale * flow;
  }
}

}  // namespace

Losses losses_of(const PreparedNetwork& network, const FlowModel& model, const Links& links,
                 const Eigen::VectorXd& open) {
  Losses losses;
  losses.flow = branch_flows(links, open);
  const std::size_t count = network.size();
  for (auto* one : {&losses.along, &losses.by_flow, &losses.at_fork, &losses.by_own, &losses.by_parent})
    one->assign(count, 0.0);
  losses.start_momentum.resize(count);
  for (std::size_t b = 0; b < count; ++b) losses.start_momentum[b] = network.branch(b).start_momentum;
  losses.by_others.resize(count);
  add_branches(network, model, links, losses);
  add_forks(network, model, links, losses);
  add_entries(network, model, links, losses);
  return losses;
}

}  // namespace ostia::hemodynamics
