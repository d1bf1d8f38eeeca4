#pragma once
/// \file The circle's number, for all sources of the room: they share units of compilation.

#include <numbers>

namespace ostia::hemodynamics {

constexpr double pi = std::numbers::pi;

}  // namespace ostia::hemodynamics
