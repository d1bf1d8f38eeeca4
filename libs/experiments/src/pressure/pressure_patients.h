#pragma once
/// \file Real patients' trees as cases of the pressure experiment.

#include "ostia/experiments/pressure.h"

namespace ostia::experiments {

struct PressurePatient {
  PressureCase planned;
  lumen::LumenModel model;  ///< of one root; each vessel has a name of its own
};
/// A patient's wall in numbers: of each vessel the axis with its radii, and the samples' mean distance.
std::string text_of(const lumen::LumenModel& model);
/// The larger tree of a mask (session::model_of_mask), under adenosine by its root's calibre. Throws IoError
/// where there is no such file, and what model_of_mask throws.
PressurePatient pressure_patient(const std::filesystem::path& masks, const std::string& name,
                                 const core::TaskContext& task);

}  // namespace ostia::experiments
