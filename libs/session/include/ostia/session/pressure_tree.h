#pragma once
/// \file A case's tree, or one of lines with radii, as a network of flow, with its narrowings.

#include "ostia/analysis/ostial_way.h"
#include "ostia/analysis/stenosis.h"
#include "ostia/core/task_context.h"
#include "ostia/geometry/axis_curve.h"
#include "ostia/hemodynamics/readings.h"

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace ostia::session {

struct PressureTreeOptions {
  analysis::ProfileOptions profile;
  analysis::ReferenceOptions reference;
  analysis::StenosisOptions stenosis;
  double bend_chord_mm = 2.0;  ///< half of what the curvature of an axis is measured over, [0.2, 20]
};
void validate(const PressureTreeOptions& options);  ///< throws InvalidInput

/// What is measured of a vessel of its own.
struct PressureVessel {
  std::int32_t vessel = 0;
  std::string name;
  std::shared_ptr<const geometry::AxisCurve> axis;
  double own_from_mm = 0.0, ostium_mm = 0.0;       ///< its part begins; its way leaves the parent's lumen
  bool of_walls = false;                           ///< measured; else round sections of the axis' radii
  analysis::LumenProfile profile;                  ///< from the root
  std::vector<hemodynamics::SectionShape> shapes;  ///< one a section; of its own part the real form
  analysis::ReferenceLine reference;
};

/// A branch is what lies between two forks: a segment of the tree.
struct PressureTree {
  hemodynamics::Network network;
  std::map<std::int32_t, PressureVessel> vessels;  ///< by id; those that own a part of the tree
  std::vector<hemodynamics::LesionPlace> lesions;  ///< "S1", ...: as a case's report numbers them
  std::vector<std::string> warnings;
};

/// Sections of the solved walls with their real forms. A section whose wall is open is left out, and told;
/// one that is shut is an occlusion, but at a vessel's end. `surface_of` is asked from the calling thread.
/// Throws InvalidInput for options, a fault of the tree, or one without vessels; Cancelled.
PressureTree pressure_tree(const lumen::LumenModel& model, const analysis::SurfaceOfVessel& surface_of,
                           const PressureTreeOptions& options = {},
                           const core::TaskContext& task = core::no_task());
/// Round sections of the axes' radii. Throws InvalidInput for radii that are not above 0, too.
PressureTree pressure_tree(const geometry::VesselTree& tree, const PressureTreeOptions& options = {},
                           const core::TaskContext& task = core::no_task());

/// After an edit that moved walls of one vessel between two abscissas alone: its sections are measured again
/// there, lesions are found anew, and the branches that changed are returned (indices into the network), to
/// be put into a PreparedNetwork with `with_branch`. The tree's axes are as before. Throws as update_profile
/// does.
std::vector<std::size_t> update_pressure_tree(PressureTree& tree, const lumen::LumenModel& model,
                                              const analysis::SurfaceOfVessel& surface_of,
                                              std::int32_t vessel, double from_mm, double to_mm,
                                              const PressureTreeOptions& options = {});

/// The place of the network that is at an abscissa of a vessel, or the nearest one of its branches. Throws
/// InvalidInput where the vessel has none.
hemodynamics::TreePlace place_on(const hemodynamics::Network& network, std::int32_t vessel, double s_mm);

}  // namespace ostia::session
