#pragma once
/// \file The extraction experiment's tables: one definition for page, files and JSON.

#include "ostia/experiments/extraction.h"

#include <string>
#include <vector>

namespace ostia::experiments {

struct Table {
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
};

/// A row a case and, where there are several, one for all.
Table case_table(const std::vector<ExtractionRun>& runs, const ExtractionScoreOptions& options);
Table vessel_table(const std::vector<ExtractionRun>& runs);
Table section_table(const std::vector<ExtractionRun>& runs);
/// True and found lesions that reach the threshold, and what became of each.
Table stenosis_table(const std::vector<ExtractionRun>& runs, const ExtractionScoreOptions& options);
/// What a person should look at first: the worst vessel, section and grade of stenosis.
std::vector<std::string> worst_of(const std::vector<ExtractionRun>& runs,
                                  const ExtractionScoreOptions& options);

}  // namespace ostia::experiments
