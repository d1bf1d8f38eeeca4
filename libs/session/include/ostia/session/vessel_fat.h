#pragma once
/// \file The fat about a case's main arteries (docs/methods/fat-around-vessels.md).

#include "ostia/analysis/fat_attenuation.h"
#include "ostia/core/task_context.h"
#include "ostia/figure/picture.h"
#include "ostia/session/outer_walls.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ostia::session {

/// Of RCA, LAD or LCX.
struct VesselFat {
  std::int32_t vessel = 0;
  std::string name;
  /// Where 0 of its range is, mm from the root: the ostium, of LAD and LCX where the two part.
  double origin_mm = 0.0;
  double asked_mm = 0.0;         ///< length of the range; the profile's may be less
  analysis::FatProfile profile;  ///< abscissas from the root
  double seen_share = 0.0;       ///< of the outer wall that borders on fat; the rest is a bridge
  std::shared_ptr<const VesselWalls> walls = {};  ///< about which it was measured
};

struct CaseFat {
  std::vector<VesselFat> vessels;  ///< RCA, LAD, LCX, as far as they are there
  std::optional<double> tube_kv;   ///< of the scan, where it is known
  std::vector<std::string> warnings;
};

struct CaseFatOptions {
  analysis::FatOptions fat;
  OuterWallsOptions walls;
  std::optional<double> tube_kv;  ///< [40, 200]
};
void validate(const CaseFatOptions& options);  ///< throws InvalidInput

/// Outer walls are found in the image. `surface_of` is asked from the calling thread. Vessels that are not
/// there, have no name, or of which less than 5 mm of the range were measured are left out, with a warning.
/// Throws InvalidInput for bad options, and Cancelled.
CaseFat case_fat(const lumen::LumenModel& model, const analysis::SurfaceOfVessel& surface_of,
                 const imaging::ImageVolume& image, const CaseFatOptions& options = {},
                 const core::TaskContext& task = core::no_task());

std::string fat_json(const CaseFat& fat);     ///< docs/schemas/fat.schema.json
std::string fat_csv(const CaseFat& fat);      ///< one line a vessel
std::string fat_map_csv(const CaseFat& fat);  ///< one line a piece of the map
/// Its mean along each vessel. Nothing where there is none.
std::optional<figure::Picture> fat_picture(const CaseFat& fat);

}  // namespace ostia::session
