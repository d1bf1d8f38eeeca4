#pragma once
/// \file What a person measures: places in the patient, and what follows from them.

#include "ostia/analysis/lumen_profile.h"
#include "ostia/analysis/measurement_kinds.h"
#include "ostia/imaging/volume.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace ostia::analysis {

/// Plain value, kept in a case file; world points, LPS mm.
struct Measurement {
  std::int32_t id = 0;  ///< never used again within a case
  MeasureKind kind = MeasureKind::distance;
  std::string name;  ///< free text of the person; may be empty
  std::vector<Vec3> points;
  std::int32_t vessel = 0;                ///< of stenosis, volume, ring_hu (and of diameter, 0 for none)
  double from_mm = 0.0, to_mm = 0.0;      ///< abscissas; ring_hu: from_mm is its abscissa
  double inner_mm = 0.0, outer_mm = 1.0;  ///< of ring_hu: distances outside the wall
};
/// What is wrong with it in itself ("an angle needs three points"); nothing if sound.
std::optional<std::string> find_fault(const Measurement& measurement);

struct MeasuredValue {
  std::string name;  ///< "length", "area", "percent diameter", "MLD", ...
  double value = 0.0;
  std::string unit;  ///< "mm", "mm2", "mm3", "deg", "%", "HU"
};

/// What measuring draws on; any may be missing for kinds that do not need it.
struct MeasureContext {
  const lumen::LumenModel* model = nullptr;
  SurfaceOfVessel surface_of;
  std::function<const LumenProfile&(std::int32_t vessel)> profile_of;
  const imaging::ImageVolume* image = nullptr;
};
/// The first value is the one shown beside the mark; remarks have none. Throws InvalidInput for a fault, a
/// vessel that is not there, an abscissa outside it, or a context that lacks what the kind needs.
std::vector<MeasuredValue> measured(const Measurement& measurement, const MeasureContext& context);

/// "12.3 mm", "4.21 mm²": with the decimals that its unit deserves.
std::string to_text(const MeasuredValue& value);

}  // namespace ostia::analysis
