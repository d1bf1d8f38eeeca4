#include "naming_sides.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace ostia::coronary {
namespace {

/// Paths that lie on one side of the heart together.
struct SideGroup {
  std::vector<std::size_t> paths;
  double left = 0.5;  ///< probability, by the first centimetres alone
};

using RootPaths = std::map<std::int32_t, std::vector<std::size_t>>;

RootPaths roots_of(const std::vector<TreePath>& paths, const std::vector<PathName>& names) {
  RootPaths roots;
  for (std::size_t i = 0; i < paths.size(); ++i)
    if (names[i].kind.empty()) roots[paths[i].root].push_back(i);
  return roots;
}

/// Whether a path runs into vessels of another root.
bool joins_another(const std::vector<TreePath>& paths, const TreePath& graft) {
  constexpr double behind_mm = 30.0, near_mm = 4.0;
  for (std::size_t k = graft.index(behind_mm); k < graft.points.size(); ++k)
    for (const TreePath& other : paths)
      if (other.root != graft.root &&
          std::any_of(other.points.begin(), other.points.end(),
                      [&](const Vec3& p) { return (p - graft.points[k]).norm() < near_mm; }))
        return true;
  return false;
}

/// A graft begins on the ascending aorta, above both coronary ostia, which lie in different sinuses.
void name_grafts(const std::vector<TreePath>& paths, std::vector<PathName>& names) {
  constexpr double sinuses_apart_mm = 16.0, over_ostia_mm = 15.0, softness_mm = 2.5, does_not_join = 0.85;
  const RootPaths roots = roots_of(paths, names);
  const auto ostium = [&](const auto& root) { return paths[root.second.front()].points.front(); };
  const auto lowest = std::min_element(roots.begin(), roots.end(), [&](const auto& a, const auto& b) {
    return ostium(a).z() < ostium(b).z();
  });
  double other_sinus_z = 1e9;
  for (const auto& root : roots)
    if ((ostium(root) - ostium(*lowest)).norm() > sinuses_apart_mm)
      other_sinus_z = std::min(other_sinus_z, ostium(root).z());
  for (const auto& root : roots) {
    const double sure_of_it = sure(ostium(root).z() - other_sinus_z - over_ostia_mm, softness_mm);
    if (sure_of_it < 0.5) continue;
    for (const std::size_t i : root.second) {
      names[i].kind = "SVG";
      names[i].confidence = sure_of_it * (joins_another(paths, paths[i]) ? 1.0 : does_not_join);
    }
  }
}

/// How far to the left the first centimetres lead.
double left_of(const HeartFrame& frame, const std::vector<TreePath>& paths,
               const std::vector<std::size_t>& members, const Vec3& middle) {
  constexpr double looked_at_mm = 60.0, softness_mm = 3.0;
  const Vec3 ostium = paths[members.front()].points.front();
  double aside = 0.0, count = 0.0;
  for (const std::size_t i : members)
    for (std::size_t k = 0; k < paths[i].points.size() && paths[i].s_mm[k] < looked_at_mm; ++k) {
      aside += (paths[i].points[k] - ostium).dot(frame.side);
      count += 1.0;
    }
  return sure(aside / count + 0.5 * (ostium - middle).dot(frame.side), softness_mm);
}

/// The halves of a root from which a right coronary artery and an LAD come; the second is empty where they
/// do not.
std::pair<SideGroup, SideGroup> halves_of(const std::vector<TreePath>& paths,
                                          const std::vector<std::size_t>& members) {
  constexpr double right_sweep = 60.0, lad_depth = 40.0, off_groove = 45.0, trunk_mm = 40.0, half_sure = 0.95;
  const TreePath *right = nullptr, *lad = nullptr;
  for (const std::size_t i : members) {
    const TreePath& path = paths[i];
    const HeartPlace way = way_to_apex(path);
    if (sweep_deg(path, 0.0, -1.0) > (right ? sweep_deg(*right, 0.0, -1.0) : right_sweep)) right = &path;
    if (way.depth_mm > (lad ? way_to_apex(*lad).depth_mm : lad_depth) &&
        std::abs(way.angle_deg - anterior_groove) < off_groove)
      lad = &path;
  }
  std::pair<SideGroup, SideGroup> halves;
  if (!right || !lad || right == lad || shared_mm(*right, *lad) > trunk_mm) {
    halves.first.paths = members;
    return halves;
  }
  halves.first.left = half_sure;
  halves.second.left = 1.0 - half_sure;
  for (const std::size_t i : members) {
    const double with_right = shared_mm(paths[i], *right), with_lad = shared_mm(paths[i], *lad);
    const bool to_right = with_right == with_lad ? sweep_deg(paths[i], with_lad, -1.0) > 0.5 * right_sweep
                                                 : with_right > with_lad;
    (to_right ? halves.second : halves.first).paths.push_back(i);
  }
  return halves;
}

std::vector<SideGroup> side_groups(const HeartFrame& frame, const std::vector<TreePath>& paths,
                                   const std::vector<PathName>& names) {
  constexpr double never_sure = 0.05;
  const RootPaths roots = roots_of(paths, names);
  Vec3 middle = Vec3::Zero();
  for (const auto& [root, members] : roots)
    middle += paths[members.front()].points.front() / static_cast<double>(roots.size());
  std::vector<SideGroup> groups;
  for (const auto& [root, members] : roots) {
    auto [first, second] = halves_of(paths, members);
    if (second.paths.empty())
      first.left = std::clamp(left_of(frame, paths, members, middle), never_sure, 1.0 - never_sure);
    else
      groups.push_back(std::move(second));
    groups.push_back(std::move(first));
  }
  return groups;
}

/// The main vessels with sides as they are chosen; their score is the logarithm of how likely all that is.
SidedNames under(const std::vector<TreePath>& paths, const std::vector<SideGroup>& groups,
                 const std::vector<bool>& left, const std::vector<PathName>& grafts) {
  constexpr double missing = 0.005;
  SidedNames sided;
  sided.names = grafts;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    sided.log_likelihood += std::log(left[g] ? groups[g].left : 1.0 - groups[g].left);
    for (const std::size_t i : groups[g].paths) {
      sided.names[i].side = left[g] ? CoronarySide::left : CoronarySide::right;
      sided.names[i].confidence = 1.0;
    }
  }
  sided.main = name_main_vessels(paths, sided.names);
  for (const int i : {sided.main.lad, sided.main.lcx, sided.main.rca})
    sided.log_likelihood +=
        std::log(i < 0 ? missing : std::max(missing, sided.names[static_cast<std::size_t>(i)].confidence));
  return sided;
}

}  // namespace

SidedNames name_sided(const HeartFrame& frame, const std::vector<TreePath>& paths) {
  constexpr std::size_t most_tried = 4;  // more beginnings at the aorta are taken as their courses look
  std::vector<PathName> grafts(paths.size());
  name_grafts(paths, grafts);
  const std::vector<SideGroup> groups = side_groups(frame, paths, grafts);
  const std::size_t ways = groups.size() <= most_tried ? std::size_t{1} << groups.size() : 1;
  std::vector<SidedNames> tried;
  for (std::size_t way = 0; way < ways; ++way) {
    std::vector<bool> left;
    for (std::size_t g = 0; g < groups.size(); ++g)
      left.push_back(ways > 1 ? ((way >> g) & 1U) != 0U : groups[g].left >= 0.5);
    tried.push_back(under(paths, groups, left, grafts));
  }
  const auto likeliest = std::ranges::max_element(tried, {}, &SidedNames::log_likelihood);
  double all = 0.0, same = 0.0;  // `same`: with the same main vessels
  for (const SidedNames& one : tried) {
    const double likelihood = std::exp(one.log_likelihood);
    all += likelihood;
    if (one.main.lad == likeliest->main.lad && one.main.lcx == likeliest->main.lcx &&
        one.main.rca == likeliest->main.rca)
      same += likelihood;
  }
  SidedNames best = std::move(*likeliest);
  const double share = same / all;
  for (PathName& name : best.names)
    if (name.kind != "SVG") name.confidence *= share;
  // With no other main vessel to agree with, the side alone says what it is.
  const int mains =
      (best.main.lad >= 0 ? 1 : 0) + (best.main.lcx >= 0 ? 1 : 0) + (best.main.rca >= 0 ? 1 : 0);
  for (const SideGroup& group : groups)
    for (const std::size_t i : group.paths)
      if (mains == 1 && !best.names[i].kind.empty())
        best.names[i].confidence *= best.names[i].side == CoronarySide::left ? group.left : 1.0 - group.left;
  best.log_likelihood = std::log(all);
  return best;
}

}  // namespace ostia::coronary
