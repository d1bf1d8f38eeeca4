#pragma once
/// \file One pair of cases, read and compared.

#include "ostia/core/task_context.h"
#include "ostia/pipeline/manifest.h"
#include "ostia/session/case_file.h"
#include "ostia/session/comparison.h"
#include "ostia/session/scan_map.h"

#include <filesystem>
#include <memory>
#include <string>

namespace ostia::app {

struct PairPaths {
  std::filesystem::path before, after;              ///< cases
  std::filesystem::path before_image, after_image;  ///< empty: none
};

/// What a comparison is made with, as canonical JSON.
std::string comparison_parameters(const session::ComparisonOptions& options, session::MapBy by);

/// A pair whose cases are open.
class OpenedPair {
 public:
  /// Throws InvalidInput and IoError as CaseFile::open does; a message names the file.
  explicit OpenedPair(const PairPaths& paths);

  /// Digests of both cases and images, and what they are compared with.
  pipeline::JobKey job(const session::ComparisonOptions& options, session::MapBy by) const;
  /// Reads images, measures both cases, lays them onto each other, compares.
  session::Comparison compared(const session::ComparisonOptions& options, session::MapBy by,
                               const core::TaskContext& task) const;

 private:
  struct Measured {
    session::ComparedCase compared;
    std::shared_ptr<const imaging::ImageVolume> image;  ///< null: none was given
  };
  Measured measured(const session::CaseFile& file, const std::filesystem::path& image,
                    const core::TaskContext& task) const;
  PairPaths paths_;
  session::CaseFile before_, after_;
};

}  // namespace ostia::app
