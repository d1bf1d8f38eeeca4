#pragma once
/// \file Which inputs of the conditions are uncertain, and one draw of them.

#include "ostia/hemodynamics/uncertainty.h"

#include <optional>
#include <span>
#include <string_view>

namespace ostia::hemodynamics {

/// The flow at rest that the tree asks for, whatever it is known by.
constexpr std::string_view rest_flow_key = "rest_flow";

/// The group that an input belongs to; none of one that has no say in FFR, or is not known.
std::optional<InputGroup> group_of(std::string_view key);

struct DrawnInputs {
  Conditions conditions;
  double flow_factor = 1.0;  ///< of the flow at rest
};
/// Each told value moved by its spread times its normal number, and kept within what is physiology (or within
/// what was told, where that is beyond): diastolic below systolic, venous below the mean aortic pressure.
DrawnInputs drawn_inputs(const Conditions& told, std::span<const InputSpread> spreads,
                         std::span<const double> normal);

}  // namespace ostia::hemodynamics
