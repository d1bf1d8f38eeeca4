#pragma once
/// \file Whose wall it is along a vessel.

#include "ostia/analysis/lumen_profile.h"

#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace ostia::analysis {

/// The stretches of a vessel's way that belong to one vessel each, and their walls once asked for.
class OwnedWalls {
 public:
  /// Throws InvalidInput for a vessel that the model has not, or no `surface_of`.
  OwnedWalls(const lumen::LumenModel& model, const SurfaceOfVessel& surface_of, std::int32_t vessel);

  const geometry::AxisCurve& axis() const { return *axis_; }
  std::int32_t owner(double s_mm) const;  ///< lumen::owner_at, without measuring the way anew
  /// Asks for the wall at an abscissa, if it is not known. Throws InvalidInput where there is none.
  void ask(double s_mm);
  const lumen::ImplicitSurface& wall(double s_mm) const { return *walls_.at(owner(s_mm)); }  ///< once asked

 private:
  const SurfaceOfVessel& surface_of_;
  std::shared_ptr<const geometry::AxisCurve> axis_;
  std::vector<std::pair<double, std::int32_t>> stretches_;  // from where, whose
  std::map<std::int32_t, std::shared_ptr<const lumen::ImplicitSurface>> walls_;
};

}  // namespace ostia::analysis
