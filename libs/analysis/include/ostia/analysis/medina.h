#pragma once
/// \file The lesions of a bifurcation by Medina's class (Medina et al. 2006; docs/methods/branches.md).

#include "ostia/analysis/ostial_way.h"

#include <cstdint>
#include <string>
#include <vector>

namespace ostia::analysis {

struct MedinaOptions {
  double region_mm = 5.0;       ///< of each branch that belongs to the bifurcation, [1, 15]
  double least_percent = 50.0;  ///< of the diameter, in whole percents: from here on a branch is a 1, [5, 95]
  double least_side_mm = 1.5;   ///< calibre of a side branch that counts (Sianos et al. 2005), [0, 5]
};
void validate(const MedinaOptions& options);  ///< throws InvalidInput

/// What was measured of a vessel.
struct MeasuredVessel {
  const LumenProfile& profile;
  const ReferenceLine& reference;
};

struct MedinaClass {
  std::int32_t main = 0, side = 0;  ///< vessels; the main one owns the way before the bifurcation
  double joint_mm = 0.0;            ///< on both
  double region_mm = 0.0;
  /// The worst section within the region before the joint, and behind the side branch's ostium in either
  /// vessel, percent of diameter; 0 where nothing is narrowed, 100 where it is shut.
  double proximal_percent = 0.0, distal_percent = 0.0, side_percent = 0.0;
  bool proximal = false, distal = false, side_branch = false;
  bool any() const { return proximal || distal || side_branch; }
  /// Whether an abscissa of one of both vessels lies in the bifurcation's region.
  bool holds(std::int32_t vessel, double from_mm, double to_mm) const;
  double ostium_mm = 0.0;  ///< of the side branch
};
std::string to_string(const MedinaClass& medina);  ///< "1,0,1": main proximal, main distal, side

/// Of a bifurcation. `ostium` is the side's. Throws InvalidInput for bad options or a profile without a
/// reference line of its own.
MedinaClass medina_class(const MeasuredVessel& main, const MeasuredVessel& side, const Ostium& ostium,
                         const MedinaOptions& options = {});
/// The calibre of the side branch at its ostium by its reference line, mm: what `least_side_mm` asks for.
double side_calibre_mm(const MeasuredVessel& side, const Ostium& ostium);

}  // namespace ostia::analysis
