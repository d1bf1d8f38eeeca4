#pragma once
/// \file Rows of what a report says beside its measurements: CAD-RADS as it is written, high-risk plaque, the
/// standard segments, technique, versions.

#include "ostia/session/case_report.h"

#include <string>
#include <utility>
#include <vector>

namespace ostia::session::report_parts {

using Rows = std::vector<std::vector<std::string>>;
using Facts = std::vector<std::pair<std::string, std::string>>;

std::string extent(analysis::CadRads category);  ///< "minimal", ..., "occlusion"

Facts cad_rads_facts(const CaseReport& report);
std::string dominance_text(const CaseReport& report);
std::string technique_text(const CaseReport& report);  ///< a line each; empty: nothing is known

std::vector<std::string> high_risk_header();
Rows high_risk_rows(const CaseReport& report);  ///< features that are there, or that a reader speaks of
std::string high_risk_note(const CaseReport& report);

std::vector<std::string> standard_header();
Rows standard_rows(const CaseReport& report);

std::vector<std::string> version_header();
Rows version_rows(const CaseReport& report);
std::string version_note(const CaseReport& report);

}  // namespace ostia::session::report_parts
