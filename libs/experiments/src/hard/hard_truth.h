#pragma once
/// \file What is known of a synthetic patient, without a folder.

#include "ostia/experiments/extraction.h"
#include "ostia/phantom/phantom_case.h"

namespace ostia::experiments {

/// As read_extraction_truth has it of the case's folder: the challenge's four vessels with their references,
/// the others from their own axes; only those whose own lumen begins `least_mm` wide or more. Where the
/// plan's scan has steps between blocks of slices, all lies where the image shows it; contours that a step
/// tears are left out.
ExtractionTruth truth_of_plan(const phantom::CasePlan& plan, double least_mm);

/// The same with the challenge's four vessels along the mean of what the observers traced, as a reference of
/// real scans is; where nobody traced, as it was.
ExtractionTruth truth_as_traced(const phantom::CasePlan& plan, ExtractionTruth truth);

}  // namespace ostia::experiments
