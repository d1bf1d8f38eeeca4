#include "branch_rules.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

namespace ostia::coronary {
namespace {

constexpr double marginal_to_posterolateral = 112.0;  // degrees about the long axis, on the left
constexpr double stem_mm = 8.0;                       // two branches from one place of their parent
constexpr double least_limb_mm = 20.0;

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

/// What a branch may be: how well it fits, and how often there is one where it leaves.
struct NameCandidate {
  const char* kind;
  double fits;             ///< [0, 1]
  double frequency = 1.0;  ///< as a weight against the other candidates
};

/// The two likeliest. It is any of them as far as one fits, and which, by fit and frequency.
void choose(const std::vector<NameCandidate>& candidates, double of_parent, PathName& name) {
  constexpr double always_doubted = 0.04, least_second = 0.02;
  double fits = 0.0, weights = 0.0;
  std::vector<std::pair<double, const char*>> ranked;
  for (const NameCandidate& one : candidates) {
    fits += one.fits;
    weights += one.fits * one.frequency;
    ranked.emplace_back(one.fits * one.frequency, one.kind);
  }
  name.kind.clear();
  name.second.clear();
  name.confidence = name.second_confidence = 0.0;
  if (!(weights > 0.0)) return;
  std::stable_sort(ranked.begin(), ranked.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  const double any = of_parent * (1.0 - always_doubted) * std::min(1.0, fits);
  name.kind = ranked[0].second;
  name.confidence = any * ranked[0].first / weights;
  if (ranked.size() < 2 || any * ranked[1].first / weights < least_second) return;
  name.second = ranked[1].second;
  name.second_confidence = any * ranked[1].first / weights;
}

/// It runs from the base towards the apex, as branches of the ventricles do and those of the atria do not.
double runs_down(const Course& course) {
  constexpr double least_reach_mm = 4.0, softness_mm = 1.5;
  return sure(course.reach_mm() - least_reach_mm, softness_mm);
}

/// From where LAD and LCX part: what leaves there is a ramus, farther on it is not.
double leaves_as_ramus(double leave_mm, double bifurcation_mm) {
  constexpr double about_mm = 5.5, softness_mm = 1.2;
  if (bifurcation_mm < 0.0) return 0.0;
  return sure(about_mm - std::abs(leave_mm - bifurcation_mm), softness_mm);
}

/// Beside the LAD on the heart's surface, or from it into the septum.
std::vector<NameCandidate> of_lad(const TreePath& lad, const Course& course, double leave_mm,
                                  double bifurcation_mm) {
  constexpr double ramus_reach_mm = 8.0;
  const HeartPlace* beside = &lad.at.back();
  for (std::size_t i = lad.index(leave_mm); i < lad.at.size(); ++i)
    if (std::abs(lad.at[i].depth_mm - course.ending.depth_mm) <
        std::abs(beside->depth_mm - course.ending.depth_mm))
      beside = &lad.at[i];
  const double aside = (course.ending.angle_deg - beside->angle_deg) * std::numbers::pi / 180.0 * 0.5 *
                       (beside->away_mm + course.ending.away_mm);
  const double inwards = beside->away_mm - course.ending.away_mm;
  const double septal = sure(inwards - 0.6 * std::abs(aside) - 4.0, 1.5);
  const double ramus = leaves_as_ramus(leave_mm, bifurcation_mm) *
                       sure(course.reach_mm() - ramus_reach_mm, 3.0) * (1.0 - septal);
  return {{"D", (1.0 - ramus) * sure(aside - 0.8 * std::max(0.0, inwards) - 4.0, 1.5)},
          {"S", septal},
          {"RI", ramus}};
}

/// How often a left coronary artery gives the posterior descending artery, and posterolateral branches: of
/// 100 hearts 76 are right dominant, 9 left dominant and 15 balanced. An RCA that is seen to pass the crux
/// leaves neither to the left; one that ends far before it makes both likelier.
struct LeftPosterior {
  double pda = 0.4, plb = 0.4;
};
LeftPosterior left_posterior(const std::vector<TreePath>& paths, const MainVessels& main, double roll_deg) {
  constexpr double before_crux = -140.0;
  if (main.rca < 0) return {};
  double last = 0.0;
  for (const HeartPlace& at : paths[static_cast<std::size_t>(main.rca)].at)
    if (at.depth_mm < groove_depth) last = std::min(last, at.angle_deg - roll_deg);
  if (last < acute_to_posterior) return {0.2, 0.2};
  return last > before_crux ? LeftPosterior{0.6, 0.6} : LeftPosterior{};
}

std::vector<NameCandidate> of_lcx(const TreePath& lcx, const Course& course, double leave_mm,
                                  double bifurcation_mm, double roll_deg, const LeftPosterior& often) {
  constexpr double softness = 6.0, near_crux = 125.0;
  constexpr double latest = 0.55;  // a marginal branch leaves on the side wall
  const double angle = course.ending.angle_deg - roll_deg, down = runs_down(course);
  const double ramus = leaves_as_ramus(leave_mm, bifurcation_mm) * down;
  const double behind = sure(course.leaving.angle_deg - 90.0, softness);
  const double beyond = sure(angle - marginal_to_posterolateral, softness) * behind;
  const double late = std::max(sure(leave_mm / lcx.length() - latest, 0.05),
                               sure(course.leaving.angle_deg - near_crux, softness));
  return {{"OM", (1.0 - ramus) * down * (1.0 - beyond)},
          {"PLB", down * beyond * sure(posterolateral_to_posterior - angle, softness), often.plb},
          {"PDA", down * sure(angle - posterolateral_to_posterior, softness) * late, often.pda},
          {"RI", ramus}};
}

/// Where an RCA comes to the right sinus, from wherever it begins.
double begins_mm(const std::vector<TreePath>& paths, const MainVessels& main) {
  constexpr double at_sinus = -45.0;
  const TreePath& rca = paths[static_cast<std::size_t>(main.rca)];
  if (main.lad < 0 || paths[static_cast<std::size_t>(main.lad)].root != rca.root) return 0.0;
  const auto there = std::find_if(rca.at.begin(), rca.at.end(),
                                  [](const HeartPlace& at) { return at.angle_deg < at_sinus; });
  return there == rca.at.end() ? 0.0 : rca.s_mm[static_cast<std::size_t>(there - rca.at.begin())];
}

std::vector<NameCandidate> of_rca(const TreePath& rca, double begins, const Course& course, double leave_mm,
                                  double roll_deg) {
  constexpr double conus_mm = 28.0, softness = 6.0, to_the_front = 12.0;
  constexpr double beyond_pda = -225.0, near_crux = -150.0;
  const double angle = course.ending.angle_deg - roll_deg, down = runs_down(course);
  const double rca_there = rca.at[rca.index(leave_mm + course.own_mm)].angle_deg;
  const double conus = sure(conus_mm + begins - leave_mm, 4.0) *
                       sure(course.ending.angle_deg - rca_there - to_the_front, 4.0) *
                       sure(course.reach_mm(), 2.0);
  const double late = std::max(sure(leave_mm / rca.length() - 0.5, 0.05),
                               sure(near_crux - course.leaving.angle_deg, softness));
  const double behind = down * sure(acute_to_posterior - angle, softness) * late;
  const double lateral = sure(beyond_pda - angle, softness);
  return {{"CB", conus},
          {"AM", (1.0 - conus) * down * sure(angle - acute_to_posterior, softness) *
                     sure(leave_mm - begins - conus_mm, 4.0)},
          {"PDA", behind * (1.0 - lateral)},
          {"PLB", behind * lateral}};
}

/// What leaves a branch at its very beginning leaves its parent, by a common stem.
void hang_on_stem(const std::vector<TreePath>& paths, const std::vector<PathName>& names,
                  const MainVessels& main, int branch, PathName& name) {
  const int parent = name.parent;
  if (parent < 0 || parent == main.lad || parent == main.lcx || parent == main.rca) return;
  const PathName& stem = names[static_cast<std::size_t>(parent)];
  const double limb = paths[static_cast<std::size_t>(branch)].length() - name.leave_mm;
  if (stem.parent < 0 || name.leave_mm - stem.leave_mm > stem_mm || limb < least_limb_mm) return;
  name.parent = stem.parent;
  name.leave_mm = stem.leave_mm;
}

/// What would be a PDA beside another that is one: a second in the same groove, or rather something else.
void share_with_pda(const std::string& other, PathName& name) {
  constexpr double something_else = 0.65;
  if (name.kind != "PDA" && !(name.kind == other && name.second == "PDA")) return;
  const double pda = name.kind == "PDA" ? name.confidence : name.second_confidence;
  double rather = something_else * pda;
  if (name.kind == other) rather += name.confidence;
  if (name.second == other) rather += name.second_confidence;
  name.kind = other;
  name.confidence = rather;
  name.second = "PDA";
  name.second_confidence = (1.0 - something_else) * pda;
}

/// Where no branch runs in the middle of the groove, the right artery's first one behind is the PDA.
void take_pda(std::vector<PathName>& names) {
  constexpr double rather = 0.65;
  PathName* first = nullptr;
  for (PathName& name : names)
    if (name.side == CoronarySide::right && name.kind == "PLB" && name.second == "PDA" &&
        (!first || name.leave_mm < first->leave_mm))
      first = &name;
  if (!first) return;
  const double both = first->confidence + first->second_confidence;
  std::swap(first->kind, first->second);
  first->confidence = rather * both;
  first->second_confidence = (1.0 - rather) * both;
}

/// A conus branch may have an ostium of its own beside the right artery's (22 of 100 hearts).
bool begins_beside(const TreePath& path, const TreePath& rca) {
  constexpr double beside_mm = 16.0;
  return (path.points.front() - rca.points.front()).norm() < beside_mm;
}

}  // namespace

void name_branch(const std::vector<TreePath>& paths, const MainVessels& main, std::vector<PathName>& names,
                 int branch) {
  PathName& name = names[static_cast<std::size_t>(branch)];
  const TreePath& path = paths[static_cast<std::size_t>(branch)];
  hang_on_stem(paths, names, main, branch, name);
  const int parent = name.parent;
  const auto at = [&](int i) -> const TreePath& { return paths[static_cast<std::size_t>(i)]; };
  const auto sureness = [&](int i) { return names[static_cast<std::size_t>(i)].confidence; };
  const Course course = course_of(path, name.leave_mm);
  const double roll = roll_of(paths, main);
  if (parent < 0 && main.rca >= 0 && begins_beside(path, at(main.rca))) {
    std::vector<NameCandidate> candidates = of_rca(at(main.rca), 0.0, course, 0.0, roll);
    candidates.resize(1);  // CB
    choose(candidates, sureness(main.rca), name);
  } else if (parent < 0) {
    choose({}, 0.0, name);
  } else if (parent == main.lad) {
    choose(of_lad(at(parent), course, name.leave_mm, main.bifurcation_mm), sureness(parent), name);
  } else if (parent == main.lcx) {
    choose(of_lcx(at(parent), course, name.leave_mm, main.bifurcation_mm, roll,
                  left_posterior(paths, main, roll)),
           sureness(parent), name);
  } else if (parent == main.rca) {
    choose(of_rca(at(parent), begins_mm(paths, main), course, name.leave_mm, roll), sureness(parent), name);
  } else {
    choose({}, 0.0, name);
  }
}

void settle_posterior(const std::vector<TreePath>& paths, std::vector<PathName>& names) {
  constexpr double deep_enough = 0.6;  // of the deepest: what goes down in the groove itself
  constexpr double one_place_mm = 3.0;
  const auto depth = [&](int i) { return paths[static_cast<std::size_t>(i)].ending().depth_mm; };
  const auto name = [&](int i) -> PathName& { return names[static_cast<std::size_t>(i)]; };
  std::vector<int> among;
  double deepest = 0.0;
  for (int i = 0; i < static_cast<int>(names.size()); ++i) {
    if (name(i).kind != "PDA") continue;
    among.push_back(i);
    deepest = std::max(deepest, depth(i));
  }
  if (among.empty()) return take_pda(names);
  // The groove between the ventricles comes first for one who follows the right artery.
  int first = -1;
  for (const int i : among) {
    if (depth(i) < deep_enough * deepest) continue;
    if (first < 0) first = i;
    const bool before = name(i).parent == name(first).parent &&
                        std::abs(name(i).leave_mm - name(first).leave_mm) > one_place_mm;
    if (before ? name(i).leave_mm < name(first).leave_mm : depth(i) > depth(first)) first = i;
  }
  for (int i = 0; i < static_cast<int>(names.size()) && first >= 0; ++i) {
    if (i == first) continue;
    const bool before = name(i).side == CoronarySide::right && name(i).parent == name(first).parent &&
                        name(i).leave_mm < name(first).leave_mm - one_place_mm;
    share_with_pda(before ? "AM" : "PLB", name(i));
  }
}

}  // namespace ostia::coronary
