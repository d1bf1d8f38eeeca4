#pragma once
/// \file Quantities for a reader's eyes: each with as many digits wherever it is shown, and in one unit,
/// which the function does not write. Zero has no sign; what is not known, or not finite, is "-". For files
/// that programs read: text.h.

#include <optional>
#include <string>

namespace ostia::core {

/// Millimetres across: diameters, thicknesses, voxels, measured distances. "2.71", from 10 mm on "23.4".
std::string calibre_text(std::optional<double> mm);
/// Millimetres along: places on a vessel and in the patient, lengths, slabs, slices. "12.5".
std::string length_text(std::optional<double> mm);
/// Square millimetres, three digits that count: "4.21", "12.6", "512".
std::string area_text(std::optional<double> mm2);
/// Cubic millimetres: "34.2", from 100 on "512".
std::string volume_text(std::optional<double> mm3);
/// Percent of anything but a stenosis: "57".
std::string percent_text(std::optional<double> percent);
/// A stenosis's percent: what is open is never "100".
std::string stenosis_text(std::optional<double> percent);
/// CT numbers: "345".
std::string hu_text(std::optional<double> hu);
/// Degrees: "31.4" where they were measured, "30" where they were set.
std::string measured_angle_text(std::optional<double> deg);
std::string set_angle_text(std::optional<double> deg);
/// Numbers without a unit: remodelling index, Dice, contrast over noise. "1.12".
std::string ratio_text(std::optional<double> value);

}  // namespace ostia::core
