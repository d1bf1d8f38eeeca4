#pragma once
/// \file Coronary calcium in a CT without contrast agent (docs/methods/calcium-score.md).

#include "ostia/core/task_context.h"
#include "ostia/imaging/volume.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ostia::analysis {

using geometry::Vec3;

/// Where a spot of calcium lies. The first four are counted.
enum class CalciumPlace { left_main, lad, lcx, rca, aorta, valve, bone, other };
inline constexpr std::size_t calcium_places = 8, coronary_places = 4;
std::string to_string(CalciumPlace place);  ///< "LM", "LAD", "LCX", "RCA", "aorta", "valve", "bone", "other"
/// Throws InvalidInput for another word; upper and lower case are alike, and "none" is `other`.
CalciumPlace calcium_place(std::string_view word);
constexpr bool is_coronary(CalciumPlace place) {
  return static_cast<std::size_t>(place) < coronary_places;
}

struct CalciumOptions {
  double threshold_hu = 130.0;  ///< calcium is as bright or brighter, [50, 1000] (Agatston et al. 1990)
  double least_area_mm2 = 1.0;  ///< of a spot in a slice; smaller ones are noise, [0, 100]
  double definition_mm = 3.0;   ///< slices that the Agatston score is defined for, [0.5, 10]
  bool average_thin = true;     ///< neighbouring thin slices are averaged to such slices first
  /// Of the scan's slices, where it is known: more than their distance where they overlap, (0, 20].
  std::optional<double> slice_thickness_mm;
  double largest_slice_mm = 5.0;  ///< slices farther apart are refused, [1, 10]
  /// mg of hydroxyapatite in 1 cm^3 for each HU, of the scanner and protocol (McCollough et al. 2007); (0,
  /// 5]. Without it there is no mass.
  std::optional<double> calibration;
};
void validate(const CalciumOptions& options);  ///< throws InvalidInput

/// What is measured of a spot, a vessel, a patient. Nothing of it is rounded.
struct CalciumAmount {
  double agatston = 0.0;          ///< of 3 mm slices, whatever the scan's are
  double volume_mm3 = 0.0;        ///< voxels times their size, no interpolation
  double interpolated_mm3 = 0.0;  ///< with values linear between slices (after Callister et al. 1998)
  double mass_mg = 0.0;           ///< hydroxyapatite; 0 without a calibration
};

/// A connected spot of calcium (through faces of voxels).
struct CalciumLesion {
  int number = 0;  ///< from 1 on, by amount within its place, in the order of places
  CalciumPlace place = CalciumPlace::other;  ///< as it is counted
  CalciumPlace proposed = CalciumPlace::other;
  double confidence = 0.0;     ///< of the proposal, [0, 1]
  bool assigned = false;       ///< a person has said the place
  Vec3 centre = Vec3::Zero();  ///< LPS, mm, weighted by HU above the threshold
  double peak_hu = 0.0;
  int slices = 0;  ///< that it is seen in
  CalciumAmount amount;
};

/// By the Agatston score: 0, 1-10, 11-100, 101-400, more (Rumberger et al. 1999).
enum class CalciumCategory { none, minimal, mild, moderate, severe };
CalciumCategory calcium_category(double agatston);
std::string to_string(CalciumCategory category);  ///< "0", "1-10", "11-100", "101-400", ">400"
/// "A0", "A1/N2": CAC-DRS, the score's class (0, 1-99, 100-299, 300 and more) and how many of LM, LAD, LCX
/// and RCA have calcium (Hecht et al. 2018).
std::string cac_drs(double agatston, int vessels);

/// Plain data.
struct CalciumScore {
  CalciumOptions options;
  CalciumAmount total;                                   ///< of LM, LAD, LCX and RCA
  std::array<CalciumAmount, calcium_places> by_place{};  ///< by CalciumPlace
  std::vector<CalciumLesion> lesions;                    ///< those that are not coronary, too
  double slice_mm = 0.0;                                 ///< distance of the scan's slices
  int averaged = 1;                                      ///< how many of them make one that was scored
  double scored_slice_mm = 0.0;                          ///< distance of those
  int chest_parts = 0;  ///< bright parts that are bones, or far from the heart: no lesions
  std::vector<std::string> warnings;
  const CalciumAmount& of(CalciumPlace place) const { return by_place[static_cast<std::size_t>(place)]; }
  int vessels() const;  ///< of LM, LAD, LCX, RCA that have some
  CalciumCategory category() const { return calcium_category(total.agatston); }
};

/// The lesions beside the number of each voxel of the image that was scored (0: none).
struct ScoredCalcium {
  CalciumScore score;
  imaging::FloatVolume image;                    ///< as it was scored, HU; its slices lie along k
  imaging::Volume<std::int32_t> lesion_numbers;  ///< on its grid
};

/// Finds the spots, proposes where each lies and counts. The score of other slices than 3 mm is that of
/// slices of about 3 mm made of them, times the rest of their distance over 3 mm. The same for any number of
/// threads. Throws InvalidInput for bad options, slices too far apart, an image that is too small or whose
/// blood has contrast agent, and Cancelled.
ScoredCalcium score_calcium(const imaging::ImageVolume& image, const CalciumOptions& options = {},
                            const core::TaskContext& task = core::no_task());

/// With a person's word on some lesions (number: place), counted anew; numbers stay. Throws InvalidInput for
/// a number that is not there.
CalciumScore with_places(CalciumScore score, const std::map<int, CalciumPlace>& places);

}  // namespace ostia::analysis
