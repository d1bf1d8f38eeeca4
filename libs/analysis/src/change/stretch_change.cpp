#include "change/stretch_change.h"

#include "ostia/geometry/along.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace ostia::analysis {
namespace {

constexpr double least_known_share = 0.5;

double reference_at(const ScannedVessel& vessel, double s_mm) {
  const auto& sections = vessel.profile.sections;
  const auto& diameters = vessel.reference.diameter_mm;
  if (sections.size() < 2 || diameters.size() != sections.size()) return 0.0;
  const geometry::PlaceAlong place = geometry::place_along(sections, s_mm, &SectionMeasures::s_mm);
  return place.between(diameters[place.index], diameters[place.index + 1]);
}

bool is_calibre(const ScannedVessel& vessel, double s_mm) {
  const double length = vessel.profile.length_mm;
  if (s_mm < 0.5 * reference_at(vessel, 0.0) || s_mm > length - 0.5 * reference_at(vessel, length))
    return false;
  return std::ranges::none_of(vessel.reference.joints, [&](const WayJoint& joint) {
    return s_mm > joint.joint_mm && s_mm < joint.ostium_mm;
  });
}

std::pair<double, double> sides_of(const PlaqueVolumes& before, const PlaqueVolumes& after,
                                   ChangeMeasure measure) {
  const auto by_class = [&](PlaqueClass one) { return std::pair(before.of(one), after.of(one)); };
  switch (measure) {
    case ChangeMeasure::low_attenuation:
      return by_class(PlaqueClass::low_attenuation);
    case ChangeMeasure::fibrofatty:
      return by_class(PlaqueClass::fibrofatty);
    case ChangeMeasure::fibrous:
      return by_class(PlaqueClass::fibrous);
    case ChangeMeasure::calcified:
      return by_class(PlaqueClass::calcified);
    case ChangeMeasure::burden:
      return {before.burden_percent(), after.burden_percent()};
    default:
      return {before.plaque_mm3(), after.plaque_mm3()};
  }
}

}  // namespace

StretchMeasures lumen_measures(const StretchSide& side, const ScannedVessel& other) {
  const ScannedVessel& vessel = *side.vessel;
  std::optional<SectionMeasures> narrowest;
  const auto look = [&](const SectionMeasures& section) {
    if (section.s_mm < side.from_mm || section.s_mm > side.to_mm || (!section.found && section.open)) return;
    const std::optional<double> there = side.to_other(section.s_mm);
    if (!is_calibre(vessel, section.s_mm) || !there || !is_calibre(other, *there)) return;
    if (!narrowest || section.area_mm2 < narrowest->area_mm2) narrowest = section;
  };
  if (vessel.profile.sections.empty()) return {};
  for (const double end : {side.from_mm, side.to_mm}) {
    const SectionMeasures section = at(vessel.profile, end);
    if (section.found) look(section);  // between a measured section and a shut one nothing is known
  }
  for (const SectionMeasures& section : vessel.profile.sections) look(section);
  if (!narrowest) return {};
  StretchMeasures out{narrowest->diameter_mm, narrowest->area_mm2, {}};
  if (const double healthy = reference_at(vessel, narrowest->s_mm); healthy > 0.0)
    out.stenosis_percent = std::max(0.0, 100.0 * (1.0 - narrowest->diameter_mm / healthy));
  return out;
}

std::optional<PlaquePair> plaque_of_both(const StretchPair& pair) {
  const auto &before = pair.before.vessel->plaque, &after = pair.after.vessel->plaque;
  if (!before || !after) return std::nullopt;
  // Each side's known part, seen from the former; what lies beyond the matched places is not shared.
  double from = std::max(pair.before.from_mm, before->from_mm);
  double to = std::min(pair.before.to_mm, before->to_mm);
  if (const auto first = pair.after.to_other(after->from_mm)) from = std::max(from, *first);
  if (const auto last = pair.after.to_other(after->to_mm)) to = std::min(to, *last);
  if (!(to - from >= least_known_share * (pair.before.to_mm - pair.before.from_mm) && to > from))
    return std::nullopt;
  const auto there_from = pair.before.to_other(from), there_to = pair.before.to_other(to);
  if (!there_from || !there_to || !(*there_to > *there_from)) return std::nullopt;
  // An end of the other's profile may lie beyond the matched places.
  if (*there_from < after->from_mm - 1e-6 || *there_to > after->to_mm + 1e-6) return std::nullopt;
  return PlaquePair{plaque_between(*before, from, to), plaque_between(*after, *there_from, *there_to)};
}

void set_plaque(StretchChange& change, const PlaquePair& plaque, ChangeScope scope,
                const Repeatability& repeatability) {
  constexpr std::array of_plaque{ChangeMeasure::plaque,     ChangeMeasure::low_attenuation,
                                 ChangeMeasure::fibrofatty, ChangeMeasure::fibrous,
                                 ChangeMeasure::calcified,  ChangeMeasure::burden};
  for (const ChangeMeasure measure : of_plaque) {
    const auto [before, after] = sides_of(plaque.before, plaque.after, measure);
    change[static_cast<std::size_t>(measure)] = difference(before, after, scope, measure, repeatability);
  }
}

StretchChange measured_change(const StretchPair& pair, ChangeScope scope,
                              const Repeatability& repeatability) {
  StretchChange change;
  const StretchMeasures before = lumen_measures(pair.before, *pair.after.vessel);
  const StretchMeasures after = lumen_measures(pair.after, *pair.before.vessel);
  const auto set = [&](ChangeMeasure measure, std::optional<double> StretchMeasures::*member) {
    change[static_cast<std::size_t>(measure)] =
        difference(before.*member, after.*member, scope, measure, repeatability);
  };
  set(ChangeMeasure::least_diameter, &StretchMeasures::least_diameter_mm);
  set(ChangeMeasure::least_area, &StretchMeasures::least_area_mm2);
  set(ChangeMeasure::stenosis, &StretchMeasures::stenosis_percent);
  if (const auto plaque = plaque_of_both(pair)) set_plaque(change, *plaque, scope, repeatability);
  return change;
}

}  // namespace ostia::analysis
