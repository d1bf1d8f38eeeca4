#include "ostia/session/pressure_what_if.h"

#include "ostia/core/error.h"
#include "ostia/core/quantity_text.h"
#include "ostia/core/text.h"
#include "ostia/geometry/along.h"
#include "ostia/session/pressure_readout.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

namespace ostia::session {
namespace {

using hemodynamics::Branch;
using hemodynamics::Station;

/// Of the reference line at an abscissa; 0 where there is none.
double healthy_mm(const PressureVessel& vessel, double s_mm) {
  const auto& sections = vessel.profile.sections;
  const auto& line = vessel.reference.diameter_mm;
  if (sections.size() < 2 || line.size() != sections.size()) return 0.0;
  const geometry::PlaceAlong at = geometry::place_along(sections, s_mm, &analysis::SectionMeasures::s_mm);
  return at.between(line[at.index], line[at.index + 1]);
}

/// Of the reference, what is wanted at an abscissa.
double share_at(const WhatIf& one, double s_mm) {
  const double missing = 0.01 * one.percent;
  if (one.kind == WhatIfKind::open) return 1.0 - missing;
  const double along = (s_mm - one.from_mm) / (one.to_mm - one.from_mm);
  return 1.0 - missing * 0.5 * (1.0 - std::cos(2.0 * std::numbers::pi * along));
}

bool change(Station& station, double wanted_mm, WhatIfKind kind) {
  const double now = station.diameter_mm();
  if (!(wanted_mm > 0.0) || (kind == WhatIfKind::open ? wanted_mm <= now : wanted_mm >= now)) return false;
  station.area_mm2 = 0.25 * std::numbers::pi * wanted_mm * wanted_mm;
  station.shape = {};
  return true;
}

std::string stretch_text(const PressureTree& tree, const WhatIf& one) {
  const auto vessel = tree.vessels.find(one.vessel);
  const std::string name = vessel != tree.vessels.end() && !vessel->second.name.empty()
                               ? vessel->second.name
                               : "vessel " + std::to_string(one.vessel);
  return name + " from " + core::length_text(one.from_mm) + " to " + core::length_text(one.to_mm) + " mm";
}

double number_of(std::string_view text, const std::string& whole) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
    throw InvalidInput("\"" + whole + "\" has \"" + std::string(text) +
                       "\" where a number belongs; write VESSEL:FROM-TO or VESSEL:FROM-TO:PERCENT");
  return value;
}

std::int32_t vessel_named(const std::string& name, const geometry::VesselTree& tree) {
  std::vector<std::int32_t> found;
  std::string names;
  for (const geometry::Vessel& one : tree.vessels) {
    if (one.name == name) found.push_back(one.id);
    names += (names.empty() ? "" : ", ") + (one.name.empty() ? std::to_string(one.id) : one.name);
  }
  if (found.empty())
    for (const geometry::Vessel& one : tree.vessels)
      if (std::to_string(one.id) == name) found.push_back(one.id);
  if (found.empty()) throw InvalidInput("the tree has no vessel \"" + name + "\"; it has " + names);
  if (found.size() > 1)
    throw InvalidInput(std::to_string(found.size()) + " vessels are called \"" + name +
                       "\"; name the vessel by its id");
  return found.front();
}

}  // namespace

std::map<std::size_t, Branch> branches_if(const PressureTree& tree, const std::vector<WhatIf>& what_ifs,
                                          std::vector<std::string>* notes) {
  std::map<std::size_t, Branch> changed;
  for (const WhatIf& one : what_ifs) {
    validate(one);
    bool any = false;
    for (const std::size_t b : branches_on_way(tree.network, one.vessel)) {
      Branch branch = changed.contains(b) ? changed.at(b) : tree.network.branches[b];
      const PressureVessel& vessel = tree.vessels.at(branch.vessel);
      bool here = false;
      for (Station& station : branch.stations)
        if (station.s_mm >= one.from_mm - 1e-6 && station.s_mm <= one.to_mm + 1e-6)
          here = change(station, share_at(one, station.s_mm) * healthy_mm(vessel, station.s_mm), one.kind) ||
                 here;
      if (here) changed[b] = std::move(branch);
      any = any || here;
    }
    if (!any && notes)
      notes->push_back(stretch_text(tree, one) + ": no section there is " +
                       (one.kind == WhatIfKind::open ? "narrower" : "wider") +
                       " than what is asked for; nothing is changed");
  }
  return changed;
}

PressureAfter pressure_after(const PressureReport& report, std::vector<std::string>* notes) {
  using hemodynamics::State;
  PressureAfter after{*report.network, {}, {}, {}, {}};
  for (auto& [index, branch] : branches_if(report.tree, report.options.what_ifs, notes))
    after.network = after.network.with_branch(index, std::move(branch));
  const hemodynamics::Conditions& conditions = report.options.conditions;
  after.hyperaemia = hemodynamics::flow_state(after.network, conditions, report.resting, State::hyperaemia,
                                              &report.hyperaemia.solution);
  after.rest =
      hemodynamics::flow_state(after.network, conditions, report.resting, State::rest, &report.rest.solution);
  after.under_hyperaemia =
      hemodynamics::read_tree(after.network, after.hyperaemia, report.tree.lesions, report.options.reading);
  after.at_rest =
      hemodynamics::read_tree(after.network, after.rest, report.tree.lesions, report.options.reading);
  return after;
}

WhatIf what_if_of_text(const std::string& text, WhatIfKind kind, const geometry::VesselTree& tree) {
  std::vector<std::string> parts;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(':', at), text.size());
    parts.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  const bool open = kind == WhatIfKind::open;
  const std::size_t dash = parts.size() > 1 ? parts[1].find('-') : std::string::npos;
  if (parts.size() < (open ? 2U : 3U) || parts.size() > 3 || parts[0].empty() || dash == std::string::npos)
    throw InvalidInput(
        "\"" + text + "\" is no stretch; write " +
        (open ? "VESSEL:FROM-TO or VESSEL:FROM-TO:LEFT, LEFT in percent" : "VESSEL:FROM-TO:PERCENT"));
  WhatIf one;
  one.kind = kind;
  one.vessel = vessel_named(parts[0], tree);
  one.from_mm = number_of(std::string_view(parts[1]).substr(0, dash), text);
  one.to_mm = number_of(std::string_view(parts[1]).substr(dash + 1), text);
  if (parts.size() > 2) one.percent = number_of(parts[2], text);
  validate(one);
  return one;
}

}  // namespace ostia::session
