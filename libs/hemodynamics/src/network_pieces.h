#pragma once
/// \file A network cut into cones for other programs.

#include "ostia/hemodynamics/network_export.h"

#include <vector>

namespace ostia::hemodynamics {

/// A part of a branch, between two of its sections.
struct NetworkPiece {
  std::size_t branch = 0;
  int parent = -1;      ///< piece before it; none: it begins at the aorta
  bool outlet = false;  ///< nothing follows
  bool first = false;   ///< of its branch
  double length_mm = 0.0, from_mm2 = 0.0, to_mm2 = 0.0;
  Vec3 from = Vec3::Zero(), to = Vec3::Zero();
  double friction_pa_s_ml = 0.0;  ///< developed
  double from_pa = 0.0, to_pa = 0.0;
  double flow_ml_s = 0.0;
};

/// Pieces of all branches that something can flow through, a parent before its children. A branch without
/// sections is a piece of a tenth of a millimetre, as wide as what it leaves.
std::vector<NetworkPiece> pieces_of(const PreparedNetwork& network, const Solution& solution,
                                    double tolerance);
/// Of the outlet that a branch ends in.
const Outlet& outlet_of(const PreparedNetwork& network, const Boundary& boundary, std::size_t branch);

NetworkFile svzerod_file(const PreparedNetwork& network, const Boundary& boundary, const Solution& solution,
                         const std::vector<NetworkPiece>& pieces);
/// Of one root: its pieces alone. `number`: 0 where there is one root, else from 1.
NetworkFile svoned_file(const PreparedNetwork& network, const Boundary& boundary, const Solution& solution,
                        const std::vector<NetworkPiece>& pieces, int number);
std::vector<NetworkFile> openbf_files(const PreparedNetwork& network, const Boundary& boundary,
                                      const std::vector<NetworkPiece>& pieces, int number);

}  // namespace ostia::hemodynamics
