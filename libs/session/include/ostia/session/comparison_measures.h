#pragma once
/// \file What a comparison measures of one of its cases.

#include "ostia/session/comparison.h"

#include <memory>
#include <optional>
#include <vector>

namespace ostia::session {

/// A case as it was at one moment, for any thread.
struct CaseMoment {
  std::shared_ptr<const lumen::LumenModel> model;
  std::shared_ptr<const Annotations> annotations;
  std::vector<JournalEntry> journal;
  std::optional<ImageReference> reference;            ///< how the case knows its image
  std::shared_ptr<const imaging::ImageVolume> image;  ///< null: neither plaque nor fat is compared
  std::optional<double> tube_kv;                      ///< of the scan, where it is known
};
/// Without its image.
CaseMoment moment_of(const CaseFile& file);

/// Report and fat of a case, for compare_cases. `surfaces`: solved_surfaces of its model, asked from the
/// calling thread. Throws as make_case_report and case_fat do.
ComparedCase measured_case(const CaseMoment& of, const analysis::SurfaceOfVessel& surfaces,
                           const core::TaskContext& task = core::no_task());

}  // namespace ostia::session
