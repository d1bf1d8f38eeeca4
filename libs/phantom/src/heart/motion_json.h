#pragma once
/// \file How the vessels move, as JSON.

#include "ostia/phantom/vessel_motion.h"

#include <nlohmann/json.hpp>

#include <vector>

namespace ostia::phantom {

nlohmann::json vessel_motion_json(const std::vector<VesselMotion>& vessels);

}  // namespace ostia::phantom
