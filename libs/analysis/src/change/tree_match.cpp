#include "ostia/analysis/tree_match.h"

#include "change/axis_laying.h"
#include "change/paired_vessels.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"
#include "ostia/geometry/along.h"
#include "ostia/lumen/lumen_model.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

namespace ostia::analysis {
namespace {

using geometry::AxisCurve;
using geometry::AxisFoot;
using geometry::VesselTree;

constexpr double name_counts_mm = 3.0, end_slack_mm = 0.3, held_along = 0.35;
constexpr std::size_t least_landmarks = 3;

/// A vessel's way with its carried places, step by step from the root.
struct TreeWay {
  std::int32_t id = 0;
  std::string name;
  double own_mm = 0.0;
  const AxisCurve* axis = nullptr;
  double own_length() const { return axis->length() - own_mm; }
};

std::vector<TreeWay> ways_of(const VesselTree& tree, const std::vector<AxisCurve>& axes) {
  std::vector<TreeWay> ways;
  for (std::size_t i = 0; i < axes.size(); ++i)
    ways.push_back({tree.vessels[i].id, telling_name(tree.vessels[i]),
                    lumen::own_from_mm(tree, tree.vessels[i].id), &axes[i]});
  return ways;
}

struct CarriedWay {
  std::vector<double> s_mm;
  std::vector<Vec3> places;
};

CarriedWay carried(const TreeWay& way, const PointMap& map, double step_mm) {
  CarriedWay out;
  const auto steps = std::max(1.0, std::ceil(way.axis->length() / step_mm));
  for (double i = 0.0; i <= steps; ++i) {
    out.s_mm.push_back(way.axis->length() * i / steps);
    out.places.push_back(map(way.axis->point(out.s_mm.back())));
    if (!out.places.back().allFinite())
      throw InvalidInput("the map between the scans gives no place for one on " +
                         (way.name.empty() ? "a vessel" : way.name));
  }
  return out;
}

/// How the own parts of two vessels run beside each other.
struct Beside {
  std::size_t before = 0, after = 0;
  bool by_name = false;
  double distance_mm = 0.0, shared_mm = 0.0;
  double score() const { return distance_mm - (by_name ? name_counts_mm : 0.0); }
};

Beside run_beside(const TreeWay& was, const CarriedWay& along, const TreeWay& is, double reach_mm) {
  Beside out;
  double sum = 0.0;
  std::size_t count = 0, own = 0;
  for (std::size_t i = 0; i < along.s_mm.size(); ++i) {
    if (along.s_mm[i] < was.own_mm) continue;
    ++own;
    const AxisFoot foot = is.axis->nearest_foot(along.places[i]);
    if (foot.past_end || foot.s_mm < is.own_mm || foot.rho_mm > reach_mm) continue;
    sum += foot.rho_mm;
    ++count;
  }
  if (count == 0) return out;
  out.distance_mm = sum / static_cast<double>(count);
  out.shared_mm = was.own_length() * static_cast<double>(count) / static_cast<double>(own);
  return out;
}

/// Values that never fall, as near to the given ones as can be (pool adjacent violators).
std::vector<double> rising(const std::vector<double>& values) {
  std::vector<std::pair<double, std::size_t>> pools;  // mean and count
  for (const double value : values) {
    pools.emplace_back(value, 1);
    while (pools.size() > 1 && pools[pools.size() - 2].first > pools.back().first) {
      const auto [mean, count] = pools.back();
      pools.pop_back();
      auto& [other, others] = pools.back();
      other = (other * static_cast<double>(others) + mean * static_cast<double>(count)) /
              static_cast<double>(others + count);
      others += count;
    }
  }
  std::vector<double> out;
  for (const auto& [mean, count] : pools) out.insert(out.end(), count, mean);
  return out;
}

/// Ascending in both: of places that fall together on the later axis the first alone.
std::vector<MatchedPlace> paired(const CarriedWay& along, const TreeWay& is, double reach_mm, bool lay) {
  geometry::RigidFit own;
  if (lay) {
    PlacesOnAxis all{{}, is.axis};
    for (const Vec3& place : along.places)
      if (is.axis->nearest_foot(place).rho_mm <= reach_mm) all.places.push_back(place);
    own = lay_on_axes({all}, own, held_along).motion;
  }
  std::vector<double> before, after;
  for (std::size_t i = 0; i < along.s_mm.size(); ++i) {
    const AxisFoot foot = is.axis->nearest_foot(own(along.places[i]));
    // At the very end of an axis a place may lie on either side of it.
    if (foot.rho_mm > (foot.past_end ? end_slack_mm : reach_mm)) continue;
    before.push_back(along.s_mm[i]);
    after.push_back(foot.s_mm);
  }
  after = rising(after);
  std::vector<MatchedPlace> places;
  for (std::size_t i = 0; i < before.size(); ++i)
    if (places.empty() || after[i] > places.back().after_mm) places.push_back({before[i], after[i]});
  return places;
}

std::optional<double> place_between(const std::vector<MatchedPlace>& places, double s_mm,
                                    double MatchedPlace::*of, double MatchedPlace::*to) {
  if (places.size() < 2 || s_mm < places.front().*of || s_mm > places.back().*of) return std::nullopt;
  return geometry::value_along(
      places, s_mm, [of](const MatchedPlace& one) { return one.*of; },
      [to](const MatchedPlace& one) { return one.*to; });
}

double own_length(const std::vector<TreeWay>& ways) {
  double sum = 0.0;
  for (const TreeWay& way : ways) sum += way.own_length();
  return sum;
}

void require_within(double value, double least, double most, const char* what) {
  if (!(value >= least && value <= most))
    throw InvalidInput(std::string("matching of trees: ") + what + " is from " +
                       core::trimmed_text(least, 2) + " to " + core::trimmed_text(most, 2) + ", not " +
                       core::shown_text(value, 3));
}

}  // namespace

void validate(const TreeMatchOptions& o) {
  require_within(o.reach_mm, 0.5, 30.0, "reach_mm");
  require_within(o.named_reach_mm, 0.5, 50.0, "named_reach_mm");
  require_within(o.least_share, 0.05, 1.0, "least_share");
  require_within(o.step_mm, 0.1, 5.0, "step_mm");
}

std::optional<double> VesselMatch::to_after(double before_mm) const {
  return place_between(places, before_mm, &MatchedPlace::before_mm, &MatchedPlace::after_mm);
}

std::optional<double> VesselMatch::to_before(double after_mm) const {
  return place_between(places, after_mm, &MatchedPlace::after_mm, &MatchedPlace::before_mm);
}

const VesselMatch* TreeMatch::of_before(std::int32_t vessel) const {
  const auto found = std::ranges::find(vessels, vessel, &VesselMatch::before);
  return found != vessels.end() ? &*found : nullptr;
}

const VesselMatch* TreeMatch::of_after(std::int32_t vessel) const {
  const auto found = std::ranges::find(vessels, vessel, &VesselMatch::after);
  return found != vessels.end() ? &*found : nullptr;
}

TreeMatch match_trees(const VesselTree& before, const VesselTree& after, const PointMap& map,
                      const TreeMatchOptions& options) {
  validate(options);
  const std::vector<AxisCurve> b_axes = axes_of(before), a_axes = axes_of(after);
  const std::vector<TreeWay> was = ways_of(before, b_axes), is = ways_of(after, a_axes);
  std::vector<CarriedWay> along;
  for (const TreeWay& way : was) along.push_back(carried(way, map, options.step_mm));
  std::vector<Beside> candidates;
  for (std::size_t b = 0; b < was.size(); ++b)
    for (std::size_t a = 0; a < is.size(); ++a) {
      const bool named = !was[b].name.empty() && was[b].name == is[a].name;
      Beside one = run_beside(was[b], along[b], is[a], named ? options.named_reach_mm : options.reach_mm);
      const double shorter = std::min(was[b].own_length(), is[a].own_length());
      if (!(one.shared_mm > 0.0 && one.shared_mm >= options.least_share * shorter)) continue;
      one.before = b, one.after = a, one.by_name = named;
      candidates.push_back(one);
    }
  std::ranges::stable_sort(candidates, {},
                           [](const Beside& one) { return std::tuple(one.score(), -one.shared_mm); });
  TreeMatch match;
  std::set<std::size_t> b_taken, a_taken;
  std::vector<std::pair<std::size_t, VesselMatch>> found;
  for (const Beside& one : candidates) {
    if (b_taken.contains(one.before) || a_taken.contains(one.after)) continue;
    const double reach = one.by_name ? options.named_reach_mm : options.reach_mm;
    auto places = paired(along[one.before], is[one.after], reach, options.lay_axes);
    if (places.size() < 2) continue;
    b_taken.insert(one.before), a_taken.insert(one.after);
    found.emplace_back(one.before, VesselMatch{was[one.before].id, is[one.after].id, one.by_name,
                                               one.distance_mm, one.shared_mm, std::move(places)});
  }
  std::ranges::sort(found, {}, [](const auto& one) { return one.first; });
  double shared = 0.0;
  for (auto& [index, one] : found) {
    shared += one.shared_mm;
    match.vessels.push_back(std::move(one));
  }
  for (std::size_t b = 0; b < was.size(); ++b)
    if (!b_taken.contains(b)) match.before_alone.push_back(was[b].id);
  for (std::size_t a = 0; a < is.size(); ++a)
    if (!a_taken.contains(a)) match.after_alone.push_back(is[a].id);
  const double shorter = std::min(own_length(was), own_length(is));
  match.shared_share = shorter > 0.0 ? std::min(1.0, shared / shorter) : 0.0;
  return match;
}

std::string why_another_patient(const TreeFit& fit, const TreeMatch& match, const SamePatientBounds& bounds) {
  if (fit.axes_mm > bounds.axes_mm) {
    if (fit.mirrored_mm < 0.5 * fit.axes_mm)
      return "one of the trees is mirrored: as they are their axes are " + core::fixed_text(fit.axes_mm, 1) +
             " mm apart, mirrored " + core::fixed_text(fit.mirrored_mm, 1) + " mm";
    return "the axes of the vessels with the same names are " + core::fixed_text(fit.axes_mm, 1) +
           " mm apart when the trees lie on each other as well as they can (one patient's: up to " +
           core::fixed_text(bounds.axes_mm, 1) + " mm)";
  }
  std::vector<double> off = fit.landmark_residuals_mm;
  std::ranges::sort(off);
  if (off.size() >= least_landmarks && off[off.size() / 2] > bounds.landmarks_mm)
    return "half of the ostia and forks with the same names are " + core::fixed_text(off[off.size() / 2], 1) +
           " mm or more apart when the trees lie on each other as well as they can (one patient's: up to " +
           core::fixed_text(bounds.landmarks_mm, 1) + " mm)";
  if (match.shared_share < bounds.shared_share)
    return "only " + core::fixed_text(100.0 * match.shared_share, 0) +
           " % of the shorter tree runs beside the other (one patient's: " +
           core::fixed_text(100.0 * bounds.shared_share, 0) + " % or more)";
  return {};
}

}  // namespace ostia::analysis
