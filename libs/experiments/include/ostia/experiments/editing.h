#pragma once
/// \file The editing experiment of [Wels] 3: how near to an observer's contours a lumen is brought by how
/// many strokes.

#include "ostia/core/task_context.h"
#include "ostia/evaluation/lumen_scores.h"
#include "ostia/experiments/simulated_reader.h"
#include "ostia/geometry/vessel_tree.h"
#include "ostia/lumen/lumen_model.h"

#include <filesystem>
#include <string>
#include <vector>

namespace ostia::experiments {

struct EditingOptions {
  ReaderOptions reader;
  std::string observer = "observer1";  ///< whose contours are the overlay
  double start_excess_mm = 0.65;       ///< the start's regular radius is the section's mean radius and this
  double margin_mm = 6.0;              ///< the model reaches so far beyond the section, where the axis does
  double start_spacing_mm = 1.0;       ///< of the start's samples
};
void validate(const EditingOptions& options);  ///< throws InvalidInput

/// Distances of a surface from one observer's, or from the exact wall.
struct Distances {
  double msd_mm = 0.0, max_sd_mm = 0.0, dice = 0.0;
};

/// A section as it was edited.
struct SectionRun {
  std::string case_name, section, vessel;
  geometry::Health health = geometry::Health::healthy;
  double length_mm = 0.0, start_radius_mm = 0.0;
  Distances observer_against_truth;  ///< the observer's own ruled surface
  double floor_mm = 0.0;             ///< evaluation::discretisation_floor_mm of the observer's contours
  struct Step {
    int strokes = 0;
    double seconds = 0.0;  ///< modelled, from the start
    Distances to_observer, to_truth;
  };
  std::vector<Step> steps;  ///< the start first
  std::vector<lumen::Edit> edits;
  int section_strokes = 0;
  std::vector<std::string> refusals;  ///< why the program did not take a stroke, one a stroke
  std::string stopped;
  lumen::LumenModel start;  ///< what the edits are applied to
  std::string digest;       ///< of the final model
  const Step& first() const { return steps.front(); }
  const Step& last() const { return steps.back(); }
};

/// One section of a case: `tree` holds the given axes, `contours` the observer's and the exact ("truth")
/// contours.
SectionRun edit_section(const geometry::VesselTree& tree, const geometry::ContourSet& contours,
                        const std::string& section, const EditingOptions& options = {},
                        const core::TaskContext& task = core::no_task());

/// All sections of a suite as `ostia phantom` writes it: folders dataset*, each with centerlines.vtp and
/// contours.json. Throws InvalidInput where there is none, naming what is missing.
std::vector<SectionRun> edit_suite(const std::filesystem::path& suite, const EditingOptions& options = {},
                                   const core::TaskContext& task = core::no_task());

/// What the table at the end says, one health at a time; lengths weigh.
struct EditingSummary {
  std::size_t sections = 0;
  double length_mm = 0.0;
  Distances start, final, final_to_truth, start_to_truth, observer_against_truth;
  double floor_msd_mm = 0.0;
  double median_strokes = 0.0, section_share = 0.0, mean_seconds = 0.0;
};
EditingSummary summarize(const std::vector<SectionRun>& runs, geometry::Health health);

}  // namespace ostia::experiments
