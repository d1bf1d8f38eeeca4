#pragma once
/// \file Abaqus' format has no end: our writer says in its head that a last line stands at the end, so that a
/// file that was cut short is known.

#include <string_view>

namespace ostia::io {

/// Comments, without "** ".
inline constexpr std::string_view abaqus_end_announced = "the last line is: end of mesh";
inline constexpr std::string_view abaqus_end = "end of mesh";

}  // namespace ostia::io
