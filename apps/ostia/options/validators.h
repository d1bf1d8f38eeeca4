#pragma once
/// \file Bounds of numbers on the command line, refused in words.

#include <CLI/App.hpp>

namespace ostia::app {

/// A number above 0 (above_zero() names the largest double as the other bound).
CLI::Validator above_zero();
CLI::Validator zero_or_above();

}  // namespace ostia::app
