#pragma once
/// \file The colours of vessels: those of their segments' names.

#include "ostia/figure/color.h"
#include "ostia/session/workbench.h"

#include <cstdint>
#include <string>

namespace ostia::view {

/// Of LM, LAD and their branches warm ones, of LCX and marginals green, of the right tree blue; a name that
/// is not known has one of four others by the vessel's id, which is never used again. So a colour stays when
/// other vessels come, go, or change places. Told apart by the colour-blind as far as systems and main
/// vessels go.
figure::Color vessel_color(const std::string& name, std::int32_t id);
/// The one that a person has chosen for it, else by its name.
figure::Color vessel_color(const session::Workbench& bench, std::int32_t vessel);

}  // namespace ostia::view
