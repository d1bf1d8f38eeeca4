#pragma once
/// \file Narrowings: their size against a reference, and CAD-RADS.

#include "ostia/analysis/lumen_profile.h"

#include <optional>
#include <string>
#include <vector>

namespace ostia::analysis {

/// Where a vessel's way leaves one vessel for the next (Ostium in ostial_way.h), abscissas of the way.
struct WayJoint {
  double joint_mm = 0.0;   ///< where the axes part
  double ostium_mm = 0.0;  ///< where the way leaves the former vessel's lumen; before `joint_mm`: there
};
/// The calibre that the vessel would have without disease, one value a section of the profile.
struct ReferenceLine {
  std::vector<double> diameter_mm;
  /// From proximal to distal. Between joint and ostium the line leads from the parent's to the next vessel's
  /// own, and no lesion is looked for. Those whose lumina meet are one. None: one vessel.
  std::vector<WayJoint> joints = {};
};
struct ReferenceOptions {
  double window_mm = 20.0;  ///< length over which the healthy calibre is followed, [5, 100]
  /// Where its way leaves one vessel for the next: each has a line of its own, since a side branch may be
  /// half as wide. In any order; those outside the vessel, and those that would leave fewer than two sections
  /// to a line, do not count.
  std::vector<WayJoint> joints = {};
};
/// A robust line through the healthy parts of the profile (docs/methods/analysis.md): penalised least squares
/// (Eilers 2003), reweighted so that neither narrowings nor ectasias have a say. It never rises, and may step
/// down where a branch leaves (`branches_mm`, abscissas of the vessel's bifurcations; those beyond its ends
/// do not matter). All 0 where no section was found. Throws InvalidInput for bad options, a profile of fewer
/// than two sections or a branch that is not finite.
ReferenceLine reference_line(const LumenProfile& profile, const std::vector<double>& branches_mm,
                             const ReferenceOptions& options = {});
/// Where other segments leave a vessel's way, ascending; throws InvalidInput for a vessel that is not there.
std::vector<double> branch_abscissas(const lumen::LumenModel& model, std::int32_t vessel);

/// A narrowing of one vessel.
struct Stenosis {
  std::int32_t vessel = 0;
  /// The lesion: narrowed by more than a tenth, or by half of its own or the least narrowing if that is less.
  double from_mm = 0.0, to_mm = 0.0;
  double throat_mm = 0.0;  ///< abscissa of the least area; the middle of what is shut
  /// Places of reference: chosen, or the nearest healthy ones (the lesion's own end where none is near).
  double proximal_mm = 0.0, distal_mm = 0.0;
  double least_diameter_mm = 0.0;  ///< MLD: of the circle with the least area
  double least_area_mm2 = 0.0;     ///< MLA
  /// At the throat: of the reference line, or linear between the two chosen places.
  double reference_diameter_mm = 0.0, reference_area_mm2 = 0.0;
  double diameter_percent = 0.0, area_percent = 0.0;  ///< 100 (1 - least / reference)
  double length_mm() const { return to_mm - from_mm; }
};
/// By two places of reference that a person chose. Throws InvalidInput where they do not enclose two sections
/// or the profile is broken between them.
Stenosis stenosis_between(const LumenProfile& profile, double proximal_mm, double distal_mm);

struct StenosisOptions {
  double least_percent = 20.0;  ///< of diameter, to count, [5, 95]
  double least_length_mm = 1.0;
};
/// All narrowings against the reference line, from proximal to distal; 100 % where the lumen is shut. A
/// section whose wall is open says nothing. The way that a side branch shares with its parent is searched,
/// too: what lies before VesselLumen::own_from_mm is the parent's. A lesion, and its places of reference, are
/// on one side of each ostium. Throws InvalidInput for bad options or a
/// line of another profile.
std::vector<Stenosis> find_stenoses(const LumenProfile& profile, const ReferenceLine& reference,
                                    const StenosisOptions& options = {});

/// CAD-RADS 2.0 (Cury et al. 2022), by the largest stenosis in percent of diameter.
enum class CadRads { zero, one, two, three, four_a, four_b, five };
/// Of one stenosis: 0, 1-24, 25-49, 50-69, 70-99, 100 %, rounded to whole percents, but only what is shut is
/// 100. Less than nothing is 0. Throws InvalidInput above 100 % and for what is not a number.
CadRads cad_rads(double diameter_percent);
/// Of the patient: 5 for any occlusion, else 4B for the left main from 50 % or three vessels from 70 %.
/// `main_vessel` of each: "LM", "LAD", "LCX", "RCA" (main_vessel_of in aha_segments.h).
struct GradedStenosis {
  std::string main_vessel;
  double diameter_percent = 0.0;
};
CadRads cad_rads(const std::vector<GradedStenosis>& stenoses);
/// Of the patient with what could not be judged: N stands for a study that is not diagnostic as a whole. With
/// a stenosis from 50 % on it is a modifier ("4A/N"), else it is the category (Cury et al. 2022).
struct PatientCategory {
  std::optional<CadRads> category;  ///< nothing: N by itself
  bool not_diagnostic = false;      ///< N, by itself or behind the category
};
/// `all_judged`: every artery that counts was found, and all of it could be judged.
PatientCategory patient_category(const std::vector<GradedStenosis>& stenoses, bool all_judged);
std::string to_string(const PatientCategory& category);    ///< "3", "3/N", "N"
std::string description(const PatientCategory& category);  ///< as below, and what N says
std::string to_string(CadRads category);                   ///< "0", "1", ..., "4A", "4B", "5"
std::string description(CadRads category);                 ///< "Mild stenosis (25-49 %)"

}  // namespace ostia::analysis
