#include "naming_rules.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace ostia::coronary {
namespace {

// Angles about the long axis, degrees.
constexpr double anterior_groove = 5.0;
constexpr double marginal_to_posterolateral = 112.0;  // on the left
constexpr double posterolateral_to_posterior = 136.0;
constexpr double acute_to_posterior = -165.0;  // on the right

// Depths towards the apex, mm.
constexpr double groove_depth = 30.0;  // no deeper: still between atria and ventricles
constexpr double least_lad_depth = 26.0;
constexpr double sure_lad_depth = 40.0;  // past the ends of the diagonal branches' first halves
constexpr double least_reach = 8.0;      // of a branch of the ventricle

constexpr double side_looked_at_mm = 60.0;
constexpr double ramus_mm = 5.0;        // from the end of the left main
constexpr double same_vessel = 0.8;     // of its length: a fork near its end is no rival
constexpr double single_vessel = 0.75;  // sure that the right tree's only course is the RCA
constexpr double least_single_mm = 20.0;

/// How far a path follows the groove between atria and ventricles, `sign` * degrees, from `from_mm` on.
double sweep_deg(const TreePath& path, double from_mm, double sign) {
  const std::size_t first = path.index(from_mm);
  double most = 0.0;
  for (std::size_t i = first; i < path.at.size() && path.at[i].depth_mm < groove_depth; ++i)
    most = std::max(most, sign * (path.at[i].angle_deg - path.at[first].angle_deg));
  return most;
}

/// The farther a path follows the groove, the better; what turns to the apex is a branch of it.
double groove_score(const TreePath& path, double from_mm, double sign) {
  constexpr double per_mm = 0.3;
  return sweep_deg(path, from_mm, sign) -
         per_mm * std::max(0.0, path.ending().depth_mm - path.at[path.index(from_mm)].depth_mm);
}

std::vector<int> of_side(const std::vector<PathName>& names, CoronarySide side) {
  std::vector<int> result;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i].side == side) result.push_back(static_cast<int>(i));
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

/// How deep a path comes, and the angle at which it runs there: past its turn from the base, and before it
/// may wrap about the apex, where angles say nothing.
HeartPlace way_to_apex(const TreePath& path) {
  constexpr double from = 0.5, to = 0.85;  // of the depth
  const auto deepest = std::max_element(path.at.begin(), path.at.end(),
                                        [](const auto& a, const auto& b) { return a.depth_mm < b.depth_mm; });
  HeartPlace way = path.ending(10.0);
  double angle = 0.0, count = 0.0;
  for (auto at = path.at.begin(); at != deepest; ++at) {
    if (at->depth_mm < from * deepest->depth_mm || at->depth_mm > to * deepest->depth_mm) continue;
    angle += at->angle_deg;
    count += 1.0;
  }
  if (count < 1.0 || deepest->depth_mm < least_lad_depth) return way;
  way.depth_mm = std::max(way.depth_mm, deepest->depth_mm);
  way.angle_deg = angle / count;
  return way;
}

void name_lad(const std::vector<TreePath>& paths, std::vector<PathName>& names, MainVessels& main) {
  std::vector<int> among;
  double deepest = 0.0, least_angle = 1e9;
  for (const int i : of_side(names, CoronarySide::left)) {
    const HeartPlace end = way_to_apex(paths[static_cast<std::size_t>(i)]);
    deepest = std::max(deepest, end.depth_mm);
  }
  for (const int i : of_side(names, CoronarySide::left)) {
    const HeartPlace end = way_to_apex(paths[static_cast<std::size_t>(i)]);
    if (end.depth_mm < std::max(least_lad_depth, 0.6 * deepest)) continue;
    among.push_back(i);
    least_angle = std::min(least_angle, end.angle_deg);
  }
  const Choice choice = best_of(paths, among, [&](int i) {
    const HeartPlace end = way_to_apex(paths[static_cast<std::size_t>(i)]);
    return end.depth_mm / 80.0 - (end.angle_deg - least_angle) / 60.0 -
           std::abs(end.angle_deg - anterior_groove) / 180.0;
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
    return main.lad < 0
               ? 0.0
               : shared_mm(paths[static_cast<std::size_t>(main.lad)], paths[static_cast<std::size_t>(i)]);
  };
  std::vector<int> among = of_side(names, CoronarySide::left);
  std::erase(among, main.lad);
  const Choice choice = best_of(
      paths, among, [&](int i) { return groove_score(paths[static_cast<std::size_t>(i)], from(i), 1.0); });
  if (choice.path < 0) return;
  const TreePath& path = paths[static_cast<std::size_t>(choice.path)];
  const double sweep = sweep_deg(path, from(choice.path), 1.0);
  // A small one beside a large right artery ends early, but nothing else leaves so near to the ostium.
  const bool first = main.lad >= 0 && from(choice.path) < first_branch_mm &&
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
  const Choice choice = best_of(paths, of_side(names, CoronarySide::right), [&](int i) {
    return groove_score(paths[static_cast<std::size_t>(i)], 0.0, -1.0);
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

/// Where a branch ends, as seen from where it leaves.
struct Course {
  HeartPlace leaving, ending;
  double own_mm = 0.0;
  double reach_mm() const { return ending.depth_mm - leaving.depth_mm; }
};
Course course_of(const TreePath& path, double leave_mm) {
  const double own = path.length() - leave_mm;
  return {path.at[path.index(leave_mm)], path.ending(std::min(5.0, 0.5 * own)), own};
}

struct Guess {
  std::string kind;
  double confidence = 0.0;
};
Guess likelier(const Guess& a, const Guess& b) {
  return b.confidence > a.confidence ? b : a;
}

Guess ramus(const Course& course, double leave_mm, double bifurcation_mm) {
  if (bifurcation_mm < 0.0 || std::abs(leave_mm - bifurcation_mm) > 1.4 * ramus_mm) return {};
  return {"RI", sure(ramus_mm - std::abs(leave_mm - bifurcation_mm) + 0.5, 0.8) *
                    sure(course.reach_mm() - least_reach, 3.0)};
}

/// By how much the heart is turned about its long axis, as far as the LAD tells.
double roll_of(const std::vector<TreePath>& paths, const MainVessels& main) {
  constexpr double share = 0.7, most = 25.0;  // the groove itself varies too
  if (main.lad < 0) return 0.0;
  const double angle = way_to_apex(paths[static_cast<std::size_t>(main.lad)]).angle_deg;
  return std::clamp(share * (angle - anterior_groove), -most, most);
}

/// Beside the LAD on the heart's surface, or from it into the septum.
Guess branch_of_lad(const TreePath& lad, const Course& course, double leave_mm) {
  const HeartPlace* beside = &lad.at.back();
  for (std::size_t i = lad.index(leave_mm); i < lad.at.size(); ++i)
    if (std::abs(lad.at[i].depth_mm - course.ending.depth_mm) <
        std::abs(beside->depth_mm - course.ending.depth_mm))
      beside = &lad.at[i];
  const double aside = (course.ending.angle_deg - beside->angle_deg) * std::numbers::pi / 180.0 * 0.5 *
                       (beside->away_mm + course.ending.away_mm);
  const double inwards = beside->away_mm - course.ending.away_mm;
  const Guess diagonal{"D", sure(aside - 0.8 * std::max(0.0, inwards) - 4.0, 1.5)};
  const Guess septal{"S", sure(inwards - 0.6 * std::abs(aside) - 4.0, 1.5)};
  return likelier(diagonal, septal);
}

Guess branch_of_lcx(const TreePath& lcx, const Course& course, double leave_mm, double roll_deg) {
  const double angle = course.ending.angle_deg - roll_deg, down = sure(course.reach_mm() - least_reach, 2.5);
  const Guess marginal{"OM", down * sure(marginal_to_posterolateral - angle, 6.0)};
  const Guess posterolateral{"PLB", down * sure(angle - marginal_to_posterolateral, 6.0) *
                                        sure(posterolateral_to_posterior - angle, 6.0)};
  const Guess posterior{"PDA", down * sure(angle - posterolateral_to_posterior, 6.0) *
                                   sure(leave_mm / lcx.length() - 0.55, 0.05)};
  return likelier(likelier(marginal, posterolateral), posterior);
}

Guess branch_of_rca(const TreePath& rca, const Course& course, double leave_mm, double roll_deg) {
  constexpr double conus_mm = 28.0;
  const double angle = course.ending.angle_deg - roll_deg, down = sure(course.reach_mm() - least_reach, 2.5);
  const Guess conus{"CB", sure(conus_mm - leave_mm, 4.0) *
                              sure(course.ending.angle_deg - course.leaving.angle_deg + 5.0, 5.0) *
                              sure(course.ending.depth_mm - course.leaving.depth_mm, 3.0)};
  const Guess acute{"AM", down * sure(angle - acute_to_posterior, 6.0) * sure(leave_mm - conus_mm, 4.0)};
  const Guess posterior{
      "PDA", down * sure(acute_to_posterior - angle, 6.0) * sure(leave_mm / rca.length() - 0.5, 0.05)};
  return likelier(likelier(conus, acute), posterior);
}

}  // namespace

double sure(double over, double softness) {
  return 1.0 / (1.0 + std::exp(-over / softness));
}

void name_sides(const HeartFrame& frame, const std::vector<TreePath>& paths, std::vector<PathName>& names) {
  std::map<std::int32_t, std::vector<std::size_t>> of_root;
  for (std::size_t i = 0; i < paths.size(); ++i) of_root[paths[i].root].push_back(i);
  Vec3 middle = Vec3::Zero();
  for (const auto& [root, members] : of_root)
    middle += paths[members.front()].points.front() / static_cast<double>(of_root.size());
  for (const auto& [root, members] : of_root) {
    const Vec3 ostium = paths[members.front()].points.front();
    double aside = 0.0, count = 0.0;
    for (const std::size_t i : members)
      for (std::size_t k = 0; k < paths[i].points.size() && paths[i].s_mm[k] < side_looked_at_mm; ++k) {
        aside += (paths[i].points[k] - ostium).dot(frame.side);
        count += 1.0;
      }
    aside = aside / count + 0.5 * (ostium - middle).dot(frame.side);
    for (const std::size_t i : members) {
      names[i] = {};
      names[i].side = aside >= 0.0 ? CoronarySide::left : CoronarySide::right;
      names[i].confidence = sure(std::abs(aside), 3.0);
    }
  }
}

MainVessels name_main_vessels(const std::vector<TreePath>& paths, std::vector<PathName>& names) {
  MainVessels main;
  name_lad(paths, names, main);
  name_lcx(paths, names, main);
  name_rca(paths, names, main);
  return main;
}

void name_branch(const std::vector<TreePath>& paths, const MainVessels& main, std::vector<PathName>& names,
                 int branch) {
  PathName& name = names[static_cast<std::size_t>(branch)];
  if (name.parent < 0) {
    name.confidence = 0.0;
    return;
  }
  const TreePath& parent = paths[static_cast<std::size_t>(name.parent)];
  const Course course = course_of(paths[static_cast<std::size_t>(branch)], name.leave_mm);
  Guess guess;
  if (name.parent == main.lad || name.parent == main.lcx)
    guess = ramus(course, name.leave_mm, main.bifurcation_mm);
  if (guess.kind.empty() && name.parent == main.lad) guess = branch_of_lad(parent, course, name.leave_mm);
  if (guess.kind.empty() && name.parent == main.lcx)
    guess = branch_of_lcx(parent, course, name.leave_mm, roll_of(paths, main));
  if (name.parent == main.rca) guess = branch_of_rca(parent, course, name.leave_mm, roll_of(paths, main));
  name.kind = guess.kind;
  name.confidence =
      guess.kind.empty() ? 0.0 : guess.confidence * names[static_cast<std::size_t>(name.parent)].confidence;
}

void settle_posterior(const std::vector<TreePath>& paths, std::vector<PathName>& names) {
  constexpr double deep_enough = 0.6;  // of the deepest: what goes down in the groove itself
  const auto depth = [&](int i) { return paths[static_cast<std::size_t>(i)].ending().depth_mm; };
  const auto name = [&](int i) -> PathName& { return names[static_cast<std::size_t>(i)]; };
  std::vector<int> among;
  double deepest = 0.0;
  for (int i = 0; i < static_cast<int>(names.size()); ++i) {
    if (name(i).kind != "PDA") continue;
    among.push_back(i);
    deepest = std::max(deepest, depth(i));
  }
  // The groove between the ventricles comes first for one who follows the right artery.
  int first = -1;
  for (const int i : among) {
    if (depth(i) < deep_enough * deepest) continue;
    if (first < 0) first = i;
    const bool better = name(i).parent == name(first).parent ? name(i).leave_mm < name(first).leave_mm
                                                             : depth(i) > depth(first);
    if (better) first = i;
  }
  for (const int i : among)
    if (i != first) name(i).kind = "PLB";
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
  take(main.lcx, std::max(behind_ostium_mm, main.bifurcation_mm + 5.0), 1.0);
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
