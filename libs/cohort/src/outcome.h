#pragma once
/// \file A scan's figures that a page shows: the worst or the sum of what its results have.

#include "stage_results.h"

#include <limits>
#include <string>

namespace ostia::cohort {

/// NaN: not known.
struct Outcome {
  std::string cad_rads;
  double mla_mm2 = std::numeric_limits<double>::quiet_NaN();           ///< least area of all segments
  double stenosis_percent = std::numeric_limits<double>::quiet_NaN();  ///< greatest diameter stenosis
  double plaque_mm3 = std::numeric_limits<double>::quiet_NaN();        ///< sum over the vessels
  double ffr = std::numeric_limits<double>::quiet_NaN();               ///< least of all vessels' ends
};

/// Reads them off the results of a scan, each once: they are kept in the cohort while it keeps.
class Outcomes {
 public:
  explicit Outcomes(const OpenCohort& cohort);
  Outcome of(const CohortScan& scan);

 private:
  const OpenCohort* cohort_;
  std::optional<Query> known_, put_;
};

}  // namespace ostia::cohort
