#include "ostia/analysis/scan_change.h"

#include "change/stretch_change.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"
#include "ostia/geometry/disjoint_sets.h"
#include "ostia/lumen/lumen_model.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ostia::analysis {
namespace {

using geometry::VesselTree;

/// Where a stretch of one tree lies on a matched pair of vessels; abscissas of the pair's own vessel.
struct Located {
  const VesselMatch* match = nullptr;
  double from_mm = 0.0, to_mm = 0.0;  ///< in the scan that it is of, as far as the other reaches
  double there_from_mm = 0.0, there_to_mm = 0.0;
};

enum class Side { before, after };

class Comparer {
 public:
  Comparer(const ScannedTree& before, const ScannedTree& after, const PointMap& map,
           const ScanChangeOptions& options)
      : before_(before), after_(after), options_(options) {
    out_.match = match_trees(before.tree, after.tree, map, options.match);
  }

  void compare_lesions();
  void compare_segments();
  void compare_vessels();
  void name_unmatched();
  ScanChange take() { return std::move(out_); }

 private:
  const ScannedTree& tree(Side side) const { return side == Side::before ? before_ : after_; }
  static std::int32_t vessel_of(const VesselMatch& match, Side side) {
    return side == Side::before ? match.before : match.after;
  }
  static std::optional<double> carry(const VesselMatch& match, Side from, double s_mm) {
    return from == Side::before ? match.to_after(s_mm) : match.to_before(s_mm);
  }

  /// A place of a vessel has the same abscissa on each way that shares it.
  bool on_way(Side side, std::int32_t way, std::int32_t owner, double s_mm) const {
    return way == owner || (s_mm < lumen::own_from_mm(tree(side).tree, way) &&
                            lumen::owner_at(tree(side).tree, way, s_mm) == owner);
  }
  std::optional<Located> located(Side side, std::int32_t owner, double from_mm, double at_mm,
                                 double to_mm) const;
  std::optional<Located> located(Side side, const ScannedLesion& lesion) const {
    const Stenosis& s = lesion.stenosis;
    return located(side, s.vessel, s.from_mm, s.throat_mm, s.to_mm);
  }
  /// The vessel whose measures count at a place of a way.
  const ScannedVessel& measured(Side side, std::int32_t way, double s_mm) const;
  StretchPair pair_of(const VesselMatch& match, double from_mm, double to_mm, double there_from_mm,
                      double there_to_mm) const;
  void add_lesions(const std::vector<std::size_t>& before, const std::vector<std::size_t>& after);
  void measure(LesionChange& change, const VesselMatch& match, double from_mm, double to_mm);
  Difference remodelling(const StretchPair& pair, const LesionChange& change) const;
  Difference lengths(const LesionChange& change) const;
  std::optional<PlacedChange> placed(const std::string& label, std::int32_t vessel, double from_mm,
                                     double to_mm, ChangeScope scope, StretchPair* pair = nullptr);
  void say_not_reached(const std::string& what) {
    out_.unmatched.push_back(what + " is not compared: less than half of it is in both trees");
  }

  const ScannedTree &before_, &after_;
  const ScanChangeOptions& options_;
  ScanChange out_;
  std::vector<std::optional<Located>> before_places_, after_places_;
};

std::optional<Located> Comparer::located(Side side, std::int32_t owner, double from_mm, double at_mm,
                                         double to_mm) const {
  for (const VesselMatch& match : out_.match.vessels) {
    if (!on_way(side, vessel_of(match, side), owner, at_mm)) continue;
    if (!carry(match, side, at_mm)) continue;
    const auto &first = match.places.front(), &last = match.places.back();
    Located out{&match};
    out.from_mm = std::max(from_mm, side == Side::before ? first.before_mm : first.after_mm);
    out.to_mm = std::min(to_mm, side == Side::before ? last.before_mm : last.after_mm);
    const auto there_from = carry(match, side, out.from_mm), there_to = carry(match, side, out.to_mm);
    if (!there_from || !there_to) continue;
    out.there_from_mm = *there_from, out.there_to_mm = *there_to;
    return out;
  }
  return std::nullopt;
}

const ScannedVessel& Comparer::measured(Side side, std::int32_t way, double s_mm) const {
  const std::int32_t owner = lumen::owner_at(tree(side).tree, way, s_mm);
  const auto found = std::ranges::find(tree(side).vessels, owner, &ScannedVessel::vessel);
  if (found == tree(side).vessels.end())
    throw InvalidInput("a tree is compared without the measures of its vessel " + std::to_string(owner));
  return *found;
}

StretchPair Comparer::pair_of(const VesselMatch& match, double from_mm, double to_mm, double there_from_mm,
                              double there_to_mm) const {
  StretchPair pair;
  pair.before = {&measured(Side::before, match.before, 0.5 * (from_mm + to_mm)), from_mm, to_mm,
                 [&match](double s_mm) { return match.to_after(s_mm); }};
  pair.after = {&measured(Side::after, match.after, 0.5 * (there_from_mm + there_to_mm)), there_from_mm,
                there_to_mm, [&match](double s_mm) { return match.to_before(s_mm); }};
  return pair;
}

void Comparer::compare_lesions() {
  for (const ScannedLesion& one : before_.lesions) before_places_.push_back(located(Side::before, one));
  for (const ScannedLesion& one : after_.lesions) after_places_.push_back(located(Side::after, one));
  const std::size_t count = before_places_.size(), all = count + after_places_.size();
  geometry::DisjointSets sets(all);
  for (std::size_t i = 0; i < count; ++i) {
    if (!before_places_[i]) continue;
    const Located& place = *before_places_[i];
    for (std::size_t j = 0; j < after_places_.size(); ++j) {
      const Stenosis& other = after_.lesions[j].stenosis;
      if (on_way(Side::after, place.match->after, other.vessel, other.throat_mm) &&
          std::min(place.there_to_mm, other.to_mm) > std::max(place.there_from_mm, other.from_mm))
        sets.join(static_cast<std::int32_t>(i), static_cast<std::int32_t>(count + j));
    }
  }
  for (std::size_t i = 0; i < all; ++i) {
    if (sets.find(static_cast<std::int32_t>(i)) != static_cast<std::int32_t>(i)) continue;
    std::vector<std::size_t> before, after;
    for (std::size_t k = i; k < all; ++k) {
      if (sets.find(static_cast<std::int32_t>(k)) != static_cast<std::int32_t>(i)) continue;
      if (k < count)
        before.push_back(k);
      else
        after.push_back(k - count);
    }
    add_lesions(before, after);
  }
}

void Comparer::add_lesions(const std::vector<std::size_t>& before, const std::vector<std::size_t>& after) {
  LesionChange change;
  change.before = before;
  change.after = after;
  const Side named = before.empty() ? Side::after : Side::before;
  const ScannedLesion& first =
      named == Side::before ? before_.lesions[before.front()] : after_.lesions[after.front()];
  const auto& vessels = tree(named).vessels;
  const auto vessel = std::ranges::find(vessels, first.stenosis.vessel, &ScannedVessel::vessel);
  if (vessel != vessels.end()) change.vessel_name = vessel->name;
  if (const VesselSegment* segment =
          segment_at(tree(named).segments, first.stenosis.vessel, first.stenosis.throat_mm))
    change.segment = segment->label;
  const auto& place = named == Side::before ? before_places_[before.front()] : after_places_[after.front()];
  if (!place) {
    change.fate = named == Side::before ? LesionFate::after_unseen : LesionFate::before_unseen;
    const PlacedStretch own{first.stenosis.vessel, first.stenosis.from_mm, first.stenosis.to_mm};
    (named == Side::before ? change.before_stretch : change.after_stretch) = own;
    out_.lesions.push_back(std::move(change));
    return;
  }
  change.fate = after.empty() ? LesionFate::gone : before.empty() ? LesionFate::appeared : LesionFate::both;
  const VesselMatch& match = *place->match;
  const bool first_before = named == Side::before;
  double from = first_before ? place->from_mm : place->there_from_mm;
  double to = first_before ? place->to_mm : place->there_to_mm;
  const auto widen = [&](double other_from, double other_to) {
    from = std::min(from, std::max(other_from, match.places.front().before_mm));
    to = std::max(to, std::min(other_to, match.places.back().before_mm));
  };
  for (const std::size_t i : before) {
    const Stenosis& s = before_.lesions[i].stenosis;
    if (on_way(Side::before, match.before, s.vessel, s.throat_mm)) widen(s.from_mm, s.to_mm);
  }
  for (const std::size_t j : after) {
    const Stenosis& s = after_.lesions[j].stenosis;
    if (!on_way(Side::after, match.after, s.vessel, s.throat_mm)) continue;
    const double first_mm = std::max(s.from_mm, match.places.front().after_mm);
    const double last_mm = std::min(s.to_mm, match.places.back().after_mm);
    const auto there_from = match.to_before(first_mm), there_to = match.to_before(last_mm);
    if (there_from && there_to) widen(*there_from, *there_to);
  }
  measure(change, match, from, to);
  out_.lesions.push_back(std::move(change));
}

void Comparer::measure(LesionChange& change, const VesselMatch& match, double from_mm, double to_mm) {
  const auto there_from = match.to_after(from_mm), there_to = match.to_after(to_mm);
  if (!there_from || !there_to) return;
  const StretchPair pair = pair_of(match, from_mm, to_mm, *there_from, *there_to);
  change.before_stretch = PlacedStretch{pair.before.vessel->vessel, from_mm, to_mm};
  change.after_stretch = PlacedStretch{pair.after.vessel->vessel, *there_from, *there_to};
  change.change = measured_change(pair, ChangeScope::lesion, options_.repeatability);
  change.change[static_cast<std::size_t>(ChangeMeasure::length)] = lengths(change);
  change.change[static_cast<std::size_t>(ChangeMeasure::remodelling)] = remodelling(pair, change);
}

Difference Comparer::lengths(const LesionChange& change) const {
  const auto length = [](const std::vector<std::size_t>& which, const std::vector<ScannedLesion>& lesions) {
    double sum = 0.0;
    for (const std::size_t i : which) sum += lesions[i].stenosis.length_mm();
    return sum;
  };
  return difference(length(change.before, before_.lesions), length(change.after, after_.lesions),
                    ChangeScope::lesion, ChangeMeasure::length, options_.repeatability);
}

/// At the same three places in both: those of the former lesion, or of the later where it is new.
Difference Comparer::remodelling(const StretchPair& pair, const LesionChange& change) const {
  const bool of_before = !change.before.empty();
  const Stenosis& told = of_before ? before_.lesions[change.before.front()].stenosis
                                   : after_.lesions[change.after.front()].stenosis;
  const StretchSide& there = of_before ? pair.before : pair.after;
  Stenosis carried = told;
  const auto throat = there.to_other(told.throat_mm), proximal = there.to_other(told.proximal_mm),
             distal = there.to_other(told.distal_mm);
  if (!throat || !proximal || !distal) return {};
  carried.throat_mm = *throat, carried.proximal_mm = *proximal, carried.distal_mm = *distal;
  const auto index = [](const ScannedVessel& vessel, const Stenosis& at) {
    return vessel.plaque ? remodelling_index(*vessel.plaque, at) : std::nullopt;
  };
  return difference(index(*pair.before.vessel, of_before ? told : carried),
                    index(*pair.after.vessel, of_before ? carried : told), ChangeScope::lesion,
                    ChangeMeasure::remodelling, options_.repeatability);
}

std::optional<PlacedChange> Comparer::placed(const std::string& label, std::int32_t vessel, double from_mm,
                                             double to_mm, ChangeScope scope, StretchPair* kept) {
  const double length = to_mm - from_mm;
  if (!(length > 0.0)) return std::nullopt;
  // On the pair of ways that reaches most of it.
  std::optional<Located> best;
  for (const VesselMatch& match : out_.match.vessels) {
    if (!on_way(Side::before, match.before, vessel, 0.5 * (from_mm + to_mm))) continue;
    const double first = std::max(from_mm, match.places.front().before_mm);
    const double last = std::min(to_mm, match.places.back().before_mm);
    if (!(last > first) || (best && last - first <= best->to_mm - best->from_mm)) continue;
    const auto there_first = match.to_after(first), there_last = match.to_after(last);
    if (!there_first || !there_last || !(*there_last > *there_first)) continue;
    best = Located{&match, first, last, *there_first, *there_last};
  }
  if (!best || best->to_mm - best->from_mm < options_.least_covered * length) return std::nullopt;
  const StretchPair pair =
      pair_of(*best->match, best->from_mm, best->to_mm, best->there_from_mm, best->there_to_mm);
  PlacedChange out;
  out.label = label;
  out.before_vessel = vessel;
  out.covered_share = (best->to_mm - best->from_mm) / length;
  out.before_stretch = {pair.before.vessel->vessel, best->from_mm, best->to_mm};
  out.after_stretch = {pair.after.vessel->vessel, best->there_from_mm, best->there_to_mm};
  out.change = measured_change(pair, scope, options_.repeatability);
  if (kept) *kept = pair;
  return out;
}

void Comparer::compare_segments() {
  for (const VesselSegment& one : before_.segments) {
    auto change = placed(one.label, one.vessel, one.from_mm, one.to_mm, ChangeScope::segment);
    if (change)
      out_.segments.push_back(std::move(*change));
    else if (out_.match.of_before(one.vessel))
      say_not_reached("the segment " + one.label);
  }
}

void Comparer::compare_vessels() {
  PlaquePair all;
  bool any = false;
  for (const ScannedVessel& one : before_.vessels) {
    StretchPair pair;
    auto change =
        placed(one.name, one.vessel, one.own_from_mm, one.profile.length_mm, ChangeScope::vessel, &pair);
    if (!change) continue;
    if (one.fat_hu && pair.after.vessel->fat_hu)
      change->change[static_cast<std::size_t>(ChangeMeasure::fat)] =
          difference(one.fat_hu, pair.after.vessel->fat_hu, ChangeScope::vessel, ChangeMeasure::fat,
                     options_.repeatability);
    if (const auto plaque = plaque_of_both(pair)) {
      add(all.before, plaque->before);
      add(all.after, plaque->after);
      any = true;
    }
    out_.vessels.push_back(std::move(*change));
  }
  if (any) set_plaque(out_.patient, all, ChangeScope::patient, options_.repeatability);
}

void Comparer::name_unmatched() {
  const auto name = [](const ScannedTree& tree, std::int32_t id) {
    const auto found = std::ranges::find(tree.tree.vessels, id, &geometry::Vessel::id);
    return found != tree.tree.vessels.end() ? found->name : std::to_string(id);
  };
  for (const std::int32_t id : out_.match.before_alone)
    out_.unmatched.push_back(name(before_, id) + " is in the former tree alone");
  for (const std::int32_t id : out_.match.after_alone)
    out_.unmatched.push_back(name(after_, id) + " is in the later tree alone");
}

}  // namespace

const Difference& of(const StretchChange& change, ChangeMeasure measure) {
  return change[static_cast<std::size_t>(measure)];
}

std::string to_string(LesionFate fate) {
  switch (fate) {
    case LesionFate::both:
      return "both";
    case LesionFate::appeared:
      return "new";
    case LesionFate::gone:
      return "gone";
    case LesionFate::before_unseen:
      return "not reached before";
    case LesionFate::after_unseen:
      break;
  }
  return "not reached now";
}

void validate(const ScanChangeOptions& options) {
  validate(options.match);
  if (!(options.least_covered > 0.0 && options.least_covered <= 1.0))
    throw InvalidInput("a comparison asks that a share above 0 and up to 1 of a segment is in both, not " +
                       core::shown_text(options.least_covered, 3));
  for (const auto& scope : options.repeatability.spreads)
    for (const DifferenceSpread& one : scope)
      if (!(one.sd >= 0.0 && one.share >= 0.0 && std::isfinite(one.sd) && std::isfinite(one.share)))
        throw InvalidInput("a table of repeatability has standard deviations and shares from 0 on");
}

ScanChange compare_scans(const ScannedTree& before, const ScannedTree& after, const PointMap& map,
                         const ScanChangeOptions& options) {
  validate(options);
  Comparer comparer(before, after, map, options);
  comparer.name_unmatched();
  comparer.compare_lesions();
  comparer.compare_segments();
  comparer.compare_vessels();
  return comparer.take();
}

}  // namespace ostia::analysis
