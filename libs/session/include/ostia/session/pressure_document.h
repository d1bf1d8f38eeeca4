#pragma once
/// \file The pressures of a tree as pages that a person reads: inputs with their sources, curves, tables,
/// what if, and the sentence on research use.

#include "ostia/core/phrasebook.h"
#include "ostia/figure/picture.h"
#include "ostia/session/pressure_report.h"

#include <cstdint>
#include <string>
#include <vector>

namespace ostia::session {

/// FFR along each vessel's way that has a narrowing (the two with the lowest FFR where none has), before and
/// after the report's stretches, with the threshold; the vessel's id beside its picture.
struct PressureCurve {
  std::int32_t vessel = 0;
  std::string name;
  figure::Picture picture;
};
std::vector<PressureCurve> pressure_curves(const PressureReport& report,
                                           const PressureDocumentOptions& options);

/// Of these pages, the inputs' meanings and sources, and marks. English: without phrases.
const core::Phrasebook& pressure_words(ReportLanguage language);

std::string pressure_html(const PressureReport& report, const PressureDocumentOptions& options = {});
/// What pressure_pdf writes, a picture a page.
std::vector<figure::Picture> pressure_pages(const PressureReport& report,
                                            const PressureDocumentOptions& options = {});
std::string pressure_pdf(const PressureReport& report, const PressureDocumentOptions& options = {});

}  // namespace ostia::session
