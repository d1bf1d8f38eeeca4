#pragma once
/// \file What a steady run starts from, where it is not blood at rest: a solution in one dimension, so that
/// fewer iterations are left.

#include "ostia/geometry/vec.h"
#include "ostia/hemodynamics/network_solver.h"

#include <functional>

namespace ostia::solver {

struct BoundaryFlow;

struct StartFlow {
  geometry::Vec3 velocity_m_s = geometry::Vec3::Zero();
  double pressure_pa = 0.0;  ///< above that of the outlet with the most flow
};
/// At a place, mm. Asked from many threads.
using StartFlowAt = std::function<StartFlow(const geometry::Vec3& place_mm)>;

/// By what flows through the ends of a mesh.
using StartOf = std::function<StartFlowAt(const BoundaryFlow& flow)>;

/// Of a solution in one dimension whose sections have points: at a place the section that is nearest, by its
/// radius; there its pressure, and along the axis a profile of its flow and momentum (a parabola; a flatter
/// one in throats; in a jet a parabola of the jet's width, and dead water beside it). Throws InvalidInput for
/// a network without sections.
StartFlowAt start_flow(const hemodynamics::PreparedNetwork& network, const hemodynamics::Solution& solution);

/// Of the vessels that were meshed, the profile at their root developed: solves the network for the outlets'
/// shares, which are known by their vessels' names ("outlet_LAD"); blood is at rest where none is. Throws
/// InvalidInput as PreparedNetwork does.
StartOf start_from(hemodynamics::Network network);

}  // namespace ostia::solver
