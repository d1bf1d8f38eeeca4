#pragma once
/// \file One pair of cases, read and compared.

#include "ostia/core/task_context.h"
#include "ostia/pipeline/manifest.h"
#include "ostia/session/case_file.h"
#include "ostia/session/comparison.h"

#include <filesystem>
#include <string>

namespace ostia::app {

struct PairPaths {
  std::filesystem::path before, after;              ///< cases
  std::filesystem::path before_image, after_image;  ///< empty: none
};

/// What a comparison is made with, as canonical JSON.
std::string comparison_parameters(const session::ComparisonOptions& options);

/// A pair whose cases are open.
class OpenedPair {
 public:
  /// Throws InvalidInput and IoError as CaseFile::open does; a message names the file.
  explicit OpenedPair(const PairPaths& paths);

  /// Digests of both cases and images, and what they are compared with.
  pipeline::JobKey job(const session::ComparisonOptions& options) const;
  /// Reads images, measures both cases, compares.
  session::Comparison compared(const session::ComparisonOptions& options,
                               const core::TaskContext& task) const;

 private:
  session::ComparedCase measured(const session::CaseFile& file, const std::filesystem::path& image,
                                 const core::TaskContext& task) const;
  PairPaths paths_;
  session::CaseFile before_, after_;
};

}  // namespace ostia::app
