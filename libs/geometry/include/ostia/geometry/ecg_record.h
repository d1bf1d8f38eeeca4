#pragma once
/// \file The electrocardiogram: voltages over time, and the beats in it.

#include <cstddef>
#include <string>
#include <vector>

namespace ostia::geometry {

struct EcgLead {
  std::string name;            ///< "MLII", "V5"; may be empty
  std::string unit = "mV";     ///< of the values
  std::vector<double> values;  ///< NaN where the record has none
};

/// All leads have the same number of samples.
struct EcgRecord {
  double samples_per_second = 0.0;
  std::vector<EcgLead> leads;
  std::size_t samples() const { return leads.empty() ? 0 : leads.front().values.size(); }
};

/// A heartbeat at its R peak.
struct EcgBeat {
  std::size_t sample = 0;
  char kind = 'N';  ///< as PhysioNet writes it: N normal, V ventricular ectopic, A atrial premature, ...
  bool ectopic() const { return kind != 'N'; }
};

}  // namespace ostia::geometry
