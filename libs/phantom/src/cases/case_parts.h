#pragma once
/// \file What the folder of a case and those of its phases have in common.

#include "ostia/phantom/case_folder.h"
#include "ostia/phantom/heartbeat.h"
#include "ostia/phantom/scan.h"
#include "ostia/phantom/vessel_motion.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace ostia::phantom {

/// "07".
std::string two_digits(int number);

/// vesselM: reference line, points, and the observers' lines where there are some.
void write_vessel(const std::filesystem::path& folder, const ChallengeVessel& vessel);

/// The image in the formats asked for, and its labels; `percent` of RR for an image of one phase of several.
void write_image(const std::filesystem::path& folder, int number, const SuiteOptions& options,
                 const CasePlan& plan, const Scan& scan, std::optional<double> percent,
                 const core::TaskContext& task);

/// phase-00, ... with image and truth; lumen/phase-00.vtp, ... (the same surfaces), heartbeat.json,
/// motion.json, ecg.hea, ecg.dat, ecg.atr. `lumen` is the template's surface. Returns how the vessels move.
std::vector<VesselMotion> write_phases(const std::filesystem::path& folder, int number,
                                       const SuiteOptions& options, const CasePlan& plan,
                                       const geometry::TriMesh& lumen, const core::TaskContext& task);

/// docs/schemas/heartbeat.schema.json
std::string heartbeat_json(const Heartbeat& beat, const std::vector<double>& percents,
                           const std::vector<VesselMotion>& vessels);
/// docs/schemas/motion.schema.json: points on the axes (`axis_points`) at each phase.
std::string motion_json(const CoronaryTree& tree, const Heartbeat& beat, const std::vector<double>& percents);

}  // namespace ostia::phantom
