#pragma once
/// \file What the smoothness experiment leaves behind.

#include "ostia/experiments/smoothness.h"

#include <filesystem>
#include <string>
#include <vector>

namespace ostia::experiments {

/// "S0", "L1", "L1 areas", "L1 elliptic", "S0 less 70 %", "S0 smoothed 100 times".
std::string name_of(const SurfaceFigures& surface);

/// Over all orientations at one level, with sections of one kind.
struct LevelSummary {
  SurfaceKind kind = SurfaceKind::level;
  int level = 0;
  std::size_t scans = 0;
  double worst_rms_mm = 0.0, mean_rms_mm = 0.0, worst_hausdorff_mm = 0.0;
  double worst_tubes_rms_mm = 0.0, worst_true_rms_mm = 0.0;
  double worst_kappa1_tubes = 0.0, worst_kappa1_wall = 0.0, worst_kappa1 = 0.0;
  std::size_t self_intersections = 0, not_closed = 0;
};
std::vector<LevelSummary> summarize(const std::vector<SurfaceFigures>& surfaces);

/// What decides whether the experiment was done already.
std::string parameters_json(const SmoothnessOptions& options, std::size_t orientations);
/// The figures as JSON (docs/schemas/experiment-smoothness.schema.json): parameters, levels, surfaces.
std::string smoothness_json(const std::vector<SurfaceFigures>& surfaces, const SmoothnessOptions& options,
                            std::size_t orientations);
/// A table for the terminal.
std::string smoothness_text(const std::vector<SurfaceFigures>& surfaces);

/// Into an existing folder: surfaces.csv, report.html, distance.png and smoothness.png ([Luboz] figure 5).
void write_smoothness_report(const std::filesystem::path& folder, const std::vector<SurfaceFigures>& surfaces,
                             const SmoothnessOptions& options);

}  // namespace ostia::experiments
