#pragma once
/// \file What real scans show and an ideal scanner does not: how noise, edges and contrast look in a patient,
/// and what patients carry (docs/methods/phantom-realism.md).

#include <string>
#include <vector>

namespace ostia::phantom {

/// Every member's default changes nothing: the same bytes as without. All deterministic by the scan's seed;
/// the same for any number of threads. The truth (lines, contours, surfaces, labels) stays as it is; what a
/// patient carries is labelled metal where it lies.
struct ScanRealism {
  // The scanner.
  /// How much noise follows the attenuation of the rays that meet at a place: more in the middle of the body,
  /// streaky along the directions in which the body is thick. The variance of a ray is exp(noise_structure *
  /// its line integral of attenuation); 1 is physics without a bowtie and tube current modulation.
  /// `ScanOptions::noise_hu` is then the deviation at the heart's centre (the grid's, where no ball moves),
  /// in [0, 1].
  double noise_structure = 0.0;
  /// Iterative reconstruction: share of the fine noise that is taken out where the image is flat; at edges
  /// half as much. `ScanOptions::noise_hu` is the deviation where it is flat, in [0, 0.95].
  double iterative = 0.0;
  /// Sharp kernel: how far an edge in the plane falls below its low side and rises above its high side, as a
  /// share of its height, in [0, 0.15]. The width of the line-spread function stays
  /// `ScanOptions::psf_fwhm_mm`.
  double undershoot = 0.0;
  /// Blooming: share of the point-spread function in the plane that lies in wide tails, in [0, 0.4] ...
  double tail = 0.0;
  double tail_fwhm_mm = 3.0;  ///< ... and their width, in [1.5, 10]
  /// Light and dark streaks that leave dense things (metal, bright cava), because views do not agree; 1 is
  /// usual beside a bright cava, in [0, 5].
  double streaks = 0.0;
  /// Half-scan motion: the heart moves so far along a line while the tube turns by half a turn; edges are
  /// shown where they were when the rays ran along them, which gives tails and double contours, in [0, 10].
  double half_scan_motion_mm = 0.0;

  // Contrast.
  /// How badly contrast is mixed in superior cava and right heart: layers and swirls between blood and the
  /// cava's brightest, in [0, 1].
  double mixing = 0.0;
  /// The brightest in the superior cava, HU, in [100, 3000]; 0: as drawn.
  double cava_hu = 0.0;

  // What patients carry: numbers of things.
  int sternal_wires = 0;      ///< loops about the sternum, in [0, 8]
  int clips = 0;              ///< surgical clips (beside grafts; else behind the sternum), in [0, 30]
  int ecg_leads = 0;          ///< electrodes with wires on the skin, in [0, 6]
  int pacemaker_leads = 0;    ///< 1: right ventricle; 2: right atrium, too
  bool stent_struts = false;  ///< stents are rings of struts instead of an even tube

  bool operator==(const ScanRealism&) const = default;
};

void validate(const ScanRealism& realism);  ///< throws InvalidInput, naming what lies outside its range

/// A member by its name, which is the struct's, for command lines and files.
struct RealismMember {
  std::string name;
  double least = 0.0, most = 0.0;
  bool whole = false;  ///< a number of things; 0 or 1 of a switch
};
const std::vector<RealismMember>& realism_members();
/// Throw InvalidInput where no member has the name; the second where the value lies outside its range.
double value_of(const ScanRealism& realism, const std::string& name);
void set_value(ScanRealism& realism, const std::string& name, double value);

}  // namespace ostia::phantom
