#pragma once
/// \file What one pair of files is compared by. Each function fills `file.figures` and appends findings.

#include "ostia/evaluation/suite.h"

namespace ostia::evaluation {

/// Both files of a pair with where they belong.
struct FilePair {
  std::string name;  ///< relative path
  std::filesystem::path golden, result;
};

FileKind kind_of(const std::filesystem::path& path);

/// The first rule whose pattern fits the file; the type's defaults when none does.
template <class Rule>
Rule rule_for(const std::vector<Rule>& rules, const std::string& file) {
  for (const Rule& rule : rules)
    if (fits(rule.file, file)) return rule;
  return {};
}

/// Judges one figure and appends a finding where it is off by more than its tolerance.
void judge(const FigurePair& figure, ComparedFile& file, std::vector<Finding>& findings);
/// A distance (or 1 - Dice) that should be 0 and may be `allowed`.
void judge_distance(const std::string& key, double value, double allowed, ComparedFile& file,
                    std::vector<Finding>& findings);

void compare_figures(const FilePair& pair, const Tolerances& tolerances, ComparedFile& file,
                     std::vector<Finding>& findings);
void compare_surface_files(const FilePair& pair, const Tolerances& tolerances, ComparedFile& file,
                           std::vector<Finding>& findings, const core::TaskContext& task);
void compare_line_files(const FilePair& pair, const Tolerances& tolerances, ComparedFile& file,
                        std::vector<Finding>& findings);
void compare_contour_files(const FilePair& pair, const Tolerances& tolerances, ComparedFile& file,
                           std::vector<Finding>& findings);
void compare_point_files(const FilePair& pair, const Tolerances& tolerances, ComparedFile& file,
                         std::vector<Finding>& findings);
void compare_image_files(const FilePair& pair, const Tolerances& tolerances, ComparedFile& file,
                         std::vector<Finding>& findings, const core::TaskContext& task);

}  // namespace ostia::evaluation
