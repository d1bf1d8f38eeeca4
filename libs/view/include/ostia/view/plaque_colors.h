#pragma once
/// \file The colours of plaque in 2D views, by its class.

#include "ostia/analysis/plaque.h"
#include "ostia/figure/color.h"
#include "ostia/view/overlay.h"

#include <array>

namespace ostia::view {

struct PlaqueColor {
  Role role;
  figure::Color color;  ///< over images and on paper alike
};

/// One a class, in the order of analysis::PlaqueClass. Told apart by the colour-blind, too, also over grey:
/// warm is soft, blue is hard.
inline constexpr std::array<PlaqueColor, analysis::plaque_classes> plaque_colors{{
    {Role::low_attenuation, {213 / 255.0, 94 / 255.0, 0.0}},
    {Role::fibrofatty, {240 / 255.0, 228 / 255.0, 66 / 255.0}},
    {Role::fibrous, {40 / 255.0, 90 / 255.0, 1.0}},
    {Role::calcified, {86 / 255.0, 180 / 255.0, 233 / 255.0}},
}};

}  // namespace ostia::view
