#pragma once
/// \file One case: a heart, its coronary tree, what is annotated in it, and its image.

#include "ostia/core/task_context.h"
#include "ostia/imaging/volume.h"
#include "ostia/phantom/body.h"
#include "ostia/phantom/carried.h"
#include "ostia/phantom/coronary_tree.h"
#include "ostia/phantom/heart.h"
#include "ostia/phantom/obstacles.h"
#include "ostia/phantom/patient_heart.h"
#include "ostia/phantom/presets.h"
#include "ostia/phantom/scan.h"
#include "ostia/phantom/sections.h"
#include "ostia/phantom/truth.h"
#include "ostia/phantom/variant.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ostia::phantom {

/// Everything that decides a case. The same options, the same bytes.
struct CaseOptions {
  std::uint64_t seed = 1;
  Preset preset = Preset::full;
  double disease = 1.0;  ///< CoronaryOptions::disease, in [0, 5]; 0: no lesion and no diseased section
  CaseVariant variant;
  Obstacles obstacles;
  /// The heart is built around these arteries instead of drawn ones (docs/methods/phantom-trees.md); null:
  /// drawn.
  std::shared_ptr<const PatientTree> patient = nullptr;
  ScanOptions scan;  ///< `grid` and `seed` are set from the preset and the case's seed
  ContourOptions contours;
  ObserverOptions observers;         ///< `seed` is set from the case's seed
  double surface_spacing_mm = 0.15;  ///< of lumen.vtp and wall.vtp, in [0.05, 1]
};
void validate(const CaseOptions& options);  ///< throws InvalidInput

/// A case before its image is made: all that is known of it.
struct CasePlan {
  CaseOptions options;  ///< with grid and seeds set
  HeartShape heart;
  CoronaryTree tree;
  std::shared_ptr<const HeartWarp> warp;  ///< what heart and chest are bent by; null: not
  std::optional<PatientRecord> patient;   ///< how the heart came to lie under a patient's arteries
  SectionPlan sections;
  ChallengeVessels challenge;
  std::vector<std::string> warnings;  ///< of sections and vessels
};
/// Heart and tree drawn from the seed, lesions added where the sections need them, sections and vessels
/// chosen. Quick: no surface, no image.
CasePlan plan_case(const CaseOptions& options);

/// The tissues of a case: drawn from its seed, with the variant's contrast.
BodyOptions body_of(const CaseOptions& options);

/// What the case's patient carries; `body` is the case's.
std::vector<CarriedThing> things_of(const CasePlan& plan, const Body& body);

/// The case as the scanner sees it.
Scan scan_case(const CasePlan& plan, const core::TaskContext& task = core::no_task());

const char* preset_name(Preset preset);  ///< "tiny", "small", "full"

/// Canonical JSON of all options that decide a case.
std::string parameters_json(const CaseOptions& options);

}  // namespace ostia::phantom
