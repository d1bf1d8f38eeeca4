#pragma once
/// \file What vessels' names mean.

#include <string>

namespace ostia::analysis {

enum class VesselKind {
  unknown,
  lm,
  lad,
  lcx,
  rca,
  diagonal,
  septal,
  marginal,
  ramus,
  pda,
  plb,
  left_pda,
  left_plb,
  acute,
  right
};

/// A vessel's name as "OM" and 2.
struct ParsedName {
  VesselKind kind = VesselKind::unknown;
  int number = 0;
};

ParsedName parsed(const std::string& name);

}  // namespace ostia::analysis
