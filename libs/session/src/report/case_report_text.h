#pragma once
/// \file Words of a report.

#include "ostia/session/case_report.h"

#include <string>

namespace ostia::session::report_text {

/// Whole percents as CAD-RADS rounds them: 100 only where the lumen is shut.
std::string percent(double value);
std::string label(const ReportStenosis& stenosis);  ///< "S1"
std::string kind_words(const std::string& kind);    ///< of a measurement, for a person
std::string listed(const std::vector<std::string>& names);
std::string grade(const analysis::EvaluableStretch& stretch);    ///< "limited", "evaluable (reader)"
std::string reasons(const analysis::EvaluableStretch& stretch);  ///< "no clear edge, the edge is blurred"
/// What a step did, with the vessel's name in the model.
ReportStep step_of(const JournalEntry& entry, const lumen::LumenModel& model);
std::string vessel_name(const lumen::LumenModel& model, std::int32_t id);  ///< "vessel 7" if it is gone

}  // namespace ostia::session::report_text
