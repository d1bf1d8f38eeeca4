#pragma once
/// \file What of a report may be graded, and the patient's category.

#include "ostia/session/case_report.h"

namespace ostia::session {

/// `ReportStenosis::graded`, `evaluable` of lesions and segments, `not_judged` and the category; everything
/// else of the report is there. A lesion is graded where its vessel is wide enough and either a person has
/// checked the vessel or the program finds all of the lesion evaluable; a reader's "not evaluable" holds in
/// any case. Something is not judged: an artery that was not found, a stretch of a vessel wide enough that
/// is not evaluable and that no person has checked, a lesion from 25 % on that is wide enough and not graded,
/// all vessels where no image is at hand and no person has checked them.
void grade_report(CaseReport& report);
/// Fills in `bifurcations`, and what lesions belong to.
void classify_bifurcations(CaseReport& report);
/// `features` and `high_risk` of lesions; after grade_report, for its walls with maps.
void find_high_risk_plaque(CaseReport& report);
/// `standard_segments`, `dominance`, `burden` and `statement`; after find_high_risk_plaque.
void state_category(CaseReport& report, const std::vector<analysis::VesselSegment>& cut);
/// `impression_draft`, `impression` and `is_signed`, last.
void write_impression(CaseReport& report);

}  // namespace ostia::session
