#pragma once
/// \file A phantom's own tree as if it were a patient's: of known places and calibres.

#include "ostia/phantom/coronary_tree.h"
#include "ostia/phantom/patient_tree.h"
#include "ostia/phantom/vessel_field.h"

#include <functional>
#include <string>

namespace ostia::testing {

/// `moved`: where the patient lies. Vessels of the other names are left out, with those that hang on them.
inline phantom::PatientTree patient_of_phantom(
    const phantom::CoronaryTree& tree, const std::function<geometry::Vec3(const geometry::Vec3&)>& moved,
    const std::function<bool(const std::string&)>& kept = [](const std::string&) { return true; },
    double length_share = 1.0) {
  phantom::PatientTree patient;
  patient.dominance = tree.dominance;
  std::vector<std::int32_t> place(tree.vessels.size(), -1);
  for (const phantom::CoronaryVessel& vessel : tree.vessels) {
    phantom::PatientVessel one;
    if (!kept(vessel.name)) continue;
    if (vessel.parent >= 0) {
      one.parent = place[static_cast<std::size_t>(vessel.parent)];
      if (one.parent < 0) continue;
      const phantom::CoronaryVessel& parent = tree.vessels[static_cast<std::size_t>(vessel.parent)];
      if (vessel.parent_s_mm > length_share * parent.axis.abscissa.back()) continue;
    }
    one.name = vessel.name;
    const double until = length_share * vessel.axis.abscissa.back();
    for (std::size_t i = 0; i < vessel.axis.size() && vessel.axis.abscissa[i] <= until; i += 5) {
      one.points.push_back(moved(vessel.axis.points[i]));
      one.radius_mm.push_back(vessel.healthy_radius_mm[i]);
    }
    place[static_cast<std::size_t>(vessel.id)] = static_cast<std::int32_t>(patient.vessels.size());
    patient.vessels.push_back(std::move(one));
  }
  return patient;
}

}  // namespace ostia::testing
