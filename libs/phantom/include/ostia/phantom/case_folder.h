#pragma once
/// \file Cases on disk, in the layout of the Rotterdam centerline challenge and ours
/// (docs/methods/phantom-cases.md).

#include "ostia/core/task_context.h"
#include "ostia/phantom/phantom_case.h"
#include "ostia/phantom/vessel_motion.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace ostia::phantom {

/// What is made: `cases` cases with the seeds from `first.seed` on.
struct SuiteOptions {
  CaseOptions first;
  int cases = 1;            ///< 1 to 100
  bool truth_only = false;  ///< no image and no label volume
  bool mhd = true, nrrd = true, dicom = true;
  bool report = true;  ///< report.html and report/*.png
  /// Of the heart's beat, at equal distances, 1 to 100; 1: the heart stands still
  /// (docs/methods/phantom-motion.md).
  int phases = 1;
  /// Each case's disease, variant and scan are drawn from its seed, as the suite `hard` has them (hard_case),
  /// not taken from `first`.
  bool hard = false;
};
void validate(const SuiteOptions& options);  ///< throws InvalidInput
std::string parameters_json(const SuiteOptions& options);

struct CaseRecord {
  std::string folder;  ///< "dataset00"
  std::uint64_t seed = 0;
  int healthy = 0, diseased = 0;  ///< sections
  double healthy_mm = 0.0, diseased_mm = 0.0;
  std::vector<std::string> warnings;
  std::vector<VesselMotion> motion;  ///< empty where the heart stands still
};
struct SuiteRecord {
  std::vector<CaseRecord> cases;
  int sections() const;
  double healthy_mm() const;
  double diseased_mm() const;
};

/// `case.json` (docs/schemas/phantom-case.schema.json) and `suite.json`
/// (docs/schemas/phantom-suite.schema.json).
std::string case_json(const CasePlan& plan, int number, bool with_image, int phases = 1);
std::string suite_json(const SuiteOptions& options, const SuiteRecord& record);

/// Writes dataset00, dataset01, ... and suite.json into a folder beside `folder`, calls `finish` with that
/// folder (for what else belongs there), and renames it: whole or not at all. Throws InvalidInput, IoError,
/// ResourceError, Cancelled.
SuiteRecord write_suite(const std::filesystem::path& folder, const SuiteOptions& options,
                        const std::function<void(const std::filesystem::path&, const SuiteRecord&)>& finish,
                        const core::TaskContext& task = core::no_task());

}  // namespace ostia::phantom
