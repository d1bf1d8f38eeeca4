#pragma once
/// \file The overall plaque burden of CAD-RADS 2.0: P1 to P4 (docs/methods/cad-rads.md).

#include <array>
#include <string>

namespace ostia::analysis {

/// Ascending.
enum class PlaqueBurden { none, p1, p2, p3, p4 };
std::string to_string(PlaqueBurden burden);           ///< "none", "P1", ..., "P4"
PlaqueBurden plaque_burden(const std::string& text);  ///< of to_string; throws InvalidInput
std::string description(PlaqueBurden burden);  ///< "no plaque", "mild", "moderate", "severe", "extensive"

/// By the segment involvement score (Min et al. 2007), how many standard segments have plaque: 1-2, 3-4, 5-7,
/// from 8 on (Cury et al. 2022). Throws InvalidInput outside [0, 18].
PlaqueBurden burden_by_segments(int segments);
/// An Agatston score as it is reported: whole, and 1 at least where there is any calcium.
double whole_agatston(double agatston);
/// By the Agatston score: 1-100, 101-300, 301-999, from 1000 on. Whole numbers; what is above 0 is 1 at
/// least. Throws InvalidInput for a negative or infinite one.
PlaqueBurden burden_by_calcium(double agatston);

/// How much plaque a reader sees in a vessel.
enum class PlaqueAmount { none, mild, moderate, severe };
std::string to_string(PlaqueAmount amount);           ///< "none", "mild", "moderate", "severe"
PlaqueAmount plaque_amount(const std::string& text);  ///< of to_string; throws InvalidInput
/// By sight, of LAD, LCX and RCA: P1 for a mild amount in one or two; P2 for a moderate one in one or two, or
/// a mild one in three; P3 for a moderate one in three, or a severe one in one; P4 for a severe one in two or
/// three.
PlaqueBurden burden_by_sight(const std::array<PlaqueAmount, 3>& vessels);

}  // namespace ostia::analysis
