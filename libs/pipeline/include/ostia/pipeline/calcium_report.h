#pragma once
/// \file A calcium score as a folder: JSON, table and pictures.

#include "ostia/analysis/calcium_score.h"
#include "ostia/figure/picture.h"
#include "ostia/pipeline/manifest.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace ostia::pipeline {

struct ScoredScan {
  analysis::ScoredCalcium scored;
  std::string pseudonym;          ///< of the image
  std::optional<double> tube_kv;  ///< where the scan says it
};

std::string calcium_json(const ScoredScan& scan);  ///< docs/schemas/calcium.schema.json
std::string calcium_csv(const ScoredScan& scan);   ///< one line a lesion
/// The slices with the most coronary calcium (at most `most`), from top to bottom, lesions outlined in the
/// colour of their vessel. Nothing without any.
std::vector<figure::Picture> calcium_pictures(const ScoredScan& scan, std::size_t most = 6);

/// calcium.json, lesions.csv, lesions.nrrd (the number of each voxel's lesion), slices.png where there is
/// calcium and, last, manifest.json. The folder appears whole or not at all. Throws InvalidInput for a folder
/// that holds other files, IoError, ResourceError, Cancelled.
void write_calcium_report(const std::filesystem::path& folder, const ScoredScan& scan, const JobKey& key,
                          double seconds_before, const core::TaskContext& task = core::no_task());

}  // namespace ostia::pipeline
