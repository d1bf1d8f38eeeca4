#pragma once
/// \file The coronary tree of a contrast-enhanced CT, found and named without a click.

#include "ostia/coronary/axes.h"
#include "ostia/coronary/certainty.h"
#include "ostia/coronary/labels.h"

#include <string>
#include <vector>

namespace ostia::coronary {

/// Of each step; docs/methods/coronary-extract.md says how they follow each other.
struct ExtractOptions {
  AortaOptions aorta;
  OstiaOptions ostia;
  GrowthOptions growth;
  AxesOptions axes;
  LabelOptions labels;
};
void validate(const ExtractOptions& options);  ///< throws InvalidInput

struct Extraction {
  Aorta aorta;
  std::vector<Ostium> ostia;
  LabelledTree vessels;          ///< axes with radii, named as far as that is sure
  std::vector<AxisNotes> notes;  ///< one a vessel, in the tree's order: of the branch that ends where it does
  std::vector<VesselCertainty> certainty;  ///< one a vessel, in the tree's order
  std::vector<std::string> warnings;       ///< of all steps, in plain words
  std::vector<std::string> left_out;       ///< CentredTree::left_out, also among the warnings
};

/// Looks first whether the image can hold a coronary tree (docs/methods/coronary-input.md); then aorta,
/// ostia, growth, axes, names, each step as its own header has it; the task's stage says which one runs.
/// Deterministic, the same for any number of threads. Throws InvalidInput for options out of range and for an
/// image that is too small, too coarse, noise or not in HU, GeometryError where there is no chest, no aorta,
/// no heart below it, no ostium or no artery (what was looked for and what to do), Cancelled.
Extraction extract(const imaging::ImageVolume& image, const ExtractOptions& options = {},
                   const core::TaskContext& task = core::no_task());

/// Whether there is no contrast agent, as in a scan for the calcium score: why the search fails there. Throws
/// Cancelled.
bool lacks_contrast(const imaging::ImageVolume& image, const core::TaskContext& task = core::no_task());

}  // namespace ostia::coronary
