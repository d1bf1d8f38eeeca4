#include "naming_rules.h"

#include <algorithm>
#include <cmath>

namespace ostia::coronary {
namespace {

constexpr double sure_lad_depth = 40.0;  // past the ends of the diagonal branches' first halves
constexpr double same_vessel = 0.8;      // of its length: a fork near its end is no rival
constexpr double single_vessel = 0.65;   // sure that the right tree's only course is the RCA
constexpr double least_single_mm = 20.0;
// Degrees of the groove for a millimetre towards the apex: the RCA goes on to a posterolateral branch.
constexpr double lcx_per_mm = 0.6, rca_per_mm = 0.3;
constexpr double about_aorta_mm = 25.0;  // of an LCX with an ostium of its own, before it reaches the groove

/// A path's way up to an abscissa.
TreePath first_part(const TreePath& path, double to_mm) {
  const std::size_t count = std::min(path.index(to_mm) + 1, path.at.size());
  TreePath part;
  part.points.assign(path.points.begin(), path.points.begin() + static_cast<std::ptrdiff_t>(count));
  part.s_mm.assign(path.s_mm.begin(), path.s_mm.begin() + static_cast<std::ptrdiff_t>(count));
  part.at.assign(path.at.begin(), path.at.begin() + static_cast<std::ptrdiff_t>(count));
  return part;
}

/// The farther a path follows the groove, the better; what turns to the apex is a branch of it.
double groove_score(const TreePath& path, double from_mm, double sign, double per_mm) {
  return sweep_deg(path, from_mm, sign) -
         per_mm * std::max(0.0, path.ending().depth_mm - path.at[path.index(from_mm)].depth_mm);
}

std::vector<int> unnamed_of_side(const std::vector<PathName>& names, CoronarySide side) {
  std::vector<int> result;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i].side == side && names[i].kind.empty()) result.push_back(static_cast<int>(i));
  return result;
}

struct Choice {
  int path = -1;
  double score = 0.0, next = 0.0;  ///< `next`: of the best that is another vessel
};
template <class Score>
Choice best_of(const std::vector<TreePath>& paths, const std::vector<int>& among, const Score& score) {
  constexpr double none = -1e9;
  Choice choice{-1, none, none};
  std::vector<double> scores;
  for (const int i : among) {
    scores.push_back(score(i));
    if (scores.back() > choice.score) {
      choice.score = scores.back();
      choice.path = i;
    }
  }
  if (choice.path < 0) return choice;
  const TreePath& best = paths[static_cast<std::size_t>(choice.path)];
  for (std::size_t n = 0; n < among.size(); ++n) {
    const TreePath& other = paths[static_cast<std::size_t>(among[n])];
    if (shared_mm(best, other) > same_vessel * best.length() || among[n] == choice.path) continue;
    choice.next = std::max(choice.next, scores[n]);
  }
  return choice;
}

/// A limb of a fork that is known a shorter way than the other is not to lose for that alone: where it is the
/// better one as far as both are known, by `margin`, the vessel goes on in it.
template <class Score>
Choice as_far_as_known(const std::vector<TreePath>& paths, const std::vector<int>& among, Choice choice,
                       double margin, const Score& score) {
  constexpr double least_limb_mm = 2.0, little_less_mm = 16.0, least_share = 0.25;
  while (choice.path >= 0) {  // each turn goes to a shorter path
    const TreePath& best = paths[static_cast<std::size_t>(choice.path)];
    Choice better;
    double gain = margin;
    for (const int i : among) {
      const TreePath& other = paths[static_cast<std::size_t>(i)];
      const double fork = shared_mm(best, other), limb = other.length() - fork, known = best.length() - fork;
      if (other.root != best.root || i == choice.path || fork > same_vessel * best.length()) continue;
      if (limb >= known || limb < least_limb_mm ||
          (limb < least_share * known && limb < known - little_less_mm))
        continue;
      const double own = score(i, fork + limb), theirs = score(choice.path, fork + limb);
      if (own - theirs <= gain) continue;
      gain = own - theirs;
      better = {i, own, theirs};
    }
    if (better.path < 0) break;
    choice = better;
  }
  return choice;
}

/// In the groove between the ventricles, on the heart's surface, far towards the apex; about which angles say
/// nothing.
double lad_limb_score(const TreePath& path, double to_mm) {
  constexpr double narrow_mm = 15.0, end_mm = 4.0;
  const HeartPlace end = first_part(path, to_mm).ending(end_mm);
  const double off = (end.angle_deg - anterior_groove) * std::min(1.0, end.away_mm / narrow_mm);
  return end.depth_mm / 80.0 - off / 60.0 - std::abs(off) / 180.0 + end.away_mm / 40.0;
}

void name_lad(const std::vector<TreePath>& paths, std::vector<PathName>& names, MainVessels& main) {
  std::vector<int> among;
  double deepest = 0.0, least_angle = 1e9;
  for (const int i : unnamed_of_side(names, CoronarySide::left)) {
    const HeartPlace end = way_to_apex(paths[static_cast<std::size_t>(i)]);
    deepest = std::max(deepest, end.depth_mm);
  }
  for (const int i : unnamed_of_side(names, CoronarySide::left)) {
    const HeartPlace end = way_to_apex(paths[static_cast<std::size_t>(i)]);
    if (end.depth_mm < std::max(least_lad_depth, 0.6 * deepest)) continue;
    among.push_back(i);
    least_angle = std::min(least_angle, end.angle_deg);
  }
  Choice choice = best_of(paths, among, [&](int i) {
    const HeartPlace end = way_to_apex(paths[static_cast<std::size_t>(i)]);
    return end.depth_mm / 80.0 - (end.angle_deg - least_angle) / 60.0 -
           std::abs(end.angle_deg - anterior_groove) / 180.0;
  });
  constexpr double margin = 0.05;
  choice = as_far_as_known(paths, among, choice, margin, [&](int i, double to_mm) {
    return lad_limb_score(paths[static_cast<std::size_t>(i)], to_mm);
  });
  if (choice.path < 0) return;
  const HeartPlace end = way_to_apex(paths[static_cast<std::size_t>(choice.path)]);
  PathName& name = names[static_cast<std::size_t>(choice.path)];
  name.kind = "LAD";
  name.confidence *= sure(choice.score - choice.next + 0.1, 0.1) *
                     sure(60.0 - std::abs(end.angle_deg - anterior_groove), 8.0) *
                     sure(end.depth_mm - sure_lad_depth, 4.0);
  main.lad = choice.path;
}

void name_lcx(const std::vector<TreePath>& paths, std::vector<PathName>& names, MainVessels& main) {
  constexpr double least_sweep = 22.0, sure_sweep = 32.0;
  constexpr double first_branch_mm = 20.0, least_first_sweep = 6.0, first_branch = 0.6;
  const auto from = [&](int i) {
    const TreePath& path = paths[static_cast<std::size_t>(i)];
    if (main.lad < 0) return 0.0;
    const TreePath& lad = paths[static_cast<std::size_t>(main.lad)];
    return lad.root == path.root ? shared_mm(lad, path) : std::min(about_aorta_mm, 0.3 * path.length());
  };
  const std::vector<int> among = unnamed_of_side(names, CoronarySide::left);
  Choice choice = best_of(paths, among, [&](int i) {
    return groove_score(paths[static_cast<std::size_t>(i)], from(i), 1.0, lcx_per_mm);
  });
  constexpr double margin_deg = 1.5;
  choice = as_far_as_known(paths, among, choice, margin_deg, [&](int i, double to_mm) {
    return groove_score(first_part(paths[static_cast<std::size_t>(i)], to_mm), from(i), 1.0, lcx_per_mm);
  });
  if (choice.path < 0) return;
  const TreePath& path = paths[static_cast<std::size_t>(choice.path)];
  const double sweep = sweep_deg(path, from(choice.path), 1.0);
  // A small one beside a large right artery ends early, but nothing else leaves so near to the ostium.
  const bool first = main.lad >= 0 && paths[static_cast<std::size_t>(main.lad)].root == path.root &&
                     from(choice.path) < first_branch_mm &&
                     path.length() - from(choice.path) >= least_single_mm;
  if (sweep < (first ? least_first_sweep : least_sweep)) return;
  PathName& name = names[static_cast<std::size_t>(choice.path)];
  name.kind = "LCX";
  name.confidence *= std::max(sure(sweep - sure_sweep, 5.0) * sure(choice.score - choice.next + 3.0, 4.0),
                              first ? first_branch : 0.0);
  main.lcx = choice.path;
  if (main.lad < 0 || paths[static_cast<std::size_t>(main.lad)].root != path.root) return;
  main.bifurcation_mm = name.leave_mm = from(choice.path);
  name.parent = main.lad;
}

void name_rca(const std::vector<TreePath>& paths, std::vector<PathName>& names, MainVessels& main) {
  constexpr double least_sweep = 40.0;
  const Choice choice = best_of(paths, unnamed_of_side(names, CoronarySide::right), [&](int i) {
    return groove_score(paths[static_cast<std::size_t>(i)], 0.0, -1.0, rca_per_mm);
  });
  if (choice.path < 0) return;
  const TreePath& path = paths[static_cast<std::size_t>(choice.path)];
  PathName& name = names[static_cast<std::size_t>(choice.path)];
  double certain = sure(sweep_deg(path, 0.0, -1.0) - least_sweep, 5.0);
  if (path.length() >= least_single_mm && choice.next < -1e8) certain = std::max(certain, single_vessel);
  name.kind = "RCA";
  name.confidence *= certain * sure(choice.score - choice.next + 3.0, 4.0);
  main.rca = choice.path;
}

}  // namespace

MainVessels name_main_vessels(const std::vector<TreePath>& paths, std::vector<PathName>& names) {
  MainVessels main;
  name_lad(paths, names, main);
  name_lcx(paths, names, main);
  name_rca(paths, names, main);
  return main;
}

double roll_of(const std::vector<TreePath>& paths, const MainVessels& main) {
  constexpr double share = 0.7, most = 25.0;  // the groove itself varies too
  if (main.lad < 0) return 0.0;
  const double angle = way_to_apex(paths[static_cast<std::size_t>(main.lad)]).angle_deg;
  return std::clamp(share * (angle - anterior_groove), -most, most);
}

std::vector<Vec3> groove_points(const std::vector<TreePath>& paths, const MainVessels& main) {
  constexpr double behind_ostium_mm = 20.0;  // before that it comes down from the root
  constexpr double turned_deg = 6.0;         // what goes no farther round has turned to the apex
  std::vector<Vec3> points;
  const auto take = [&](int path, double from_mm, double sign) {
    if (path < 0) return;
    const TreePath& way = paths[static_cast<std::size_t>(path)];
    const std::size_t first = way.index(from_mm);
    const double all = sweep_deg(way, from_mm, sign);
    for (std::size_t i = first; i < way.at.size() && way.at[i].depth_mm < groove_depth; ++i) {
      points.push_back(way.points[i]);
      if (sign * (way.at[i].angle_deg - way.at[first].angle_deg) > all - turned_deg) break;
    }
  };
  take(main.rca, behind_ostium_mm, -1.0);
  const bool own_ostium = main.lad >= 0 && main.bifurcation_mm < 0.0;
  take(main.lcx, own_ostium ? 2.0 * about_aorta_mm : std::max(behind_ostium_mm, main.bifurcation_mm + 5.0),
       1.0);
  return points;
}

CoronaryDominance dominance_of(const std::vector<TreePath>& paths, const MainVessels& main,
                               const std::vector<PathName>& names, double least_confidence) {
  constexpr double beyond_mm = 12.0;  // of the crux: the RCA feeds the left ventricle's back
  constexpr double near_crux = 110.0;
  for (const PathName& name : names) {
    if (name.kind != "PDA" || name.confidence < least_confidence) continue;
    if (name.side == CoronarySide::left) return CoronaryDominance::left;
    if (name.parent != main.rca) continue;
    const TreePath& rca = paths[static_cast<std::size_t>(main.rca)];
    if (rca.length() - name.leave_mm >= beyond_mm || main.lcx < 0) return CoronaryDominance::right;
    const double end = paths[static_cast<std::size_t>(main.lcx)].ending().angle_deg;
    return end > near_crux ? CoronaryDominance::balanced : CoronaryDominance::right;
  }
  // A main vessel that is known no farther than the crux may turn down there itself.
  const double roll = roll_of(paths, main);
  const auto turns_down = [&](int path, double sign, double from_angle) {
    if (path < 0 || names[static_cast<std::size_t>(path)].confidence < least_confidence) return false;
    const HeartPlace end = paths[static_cast<std::size_t>(path)].ending();
    return end.depth_mm > groove_depth && sign * (end.angle_deg - roll) > from_angle;
  };
  if (turns_down(main.rca, -1.0, -acute_to_posterior)) return CoronaryDominance::right;
  if (turns_down(main.lcx, 1.0, posterolateral_to_posterior)) return CoronaryDominance::left;
  return CoronaryDominance::unknown;
}

}  // namespace ostia::coronary
