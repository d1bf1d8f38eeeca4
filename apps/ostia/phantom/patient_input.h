#pragma once
/// \file A patient's coronary tree, from a mask or a case, to build a synthetic heart around.

#include "ostia/core/task_context.h"
#include "ostia/phantom/patient_tree.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>

namespace ostia::app {

/// A mask (as `ostia extract` takes it) or a case. `rim_mm`: nothing: 0.5 mm of a mask, 0 of a case. `seed`:
/// of the heart. Throws what the readers and session::patient_of_mask throw, with the file's name.
std::shared_ptr<const phantom::PatientTree> read_patient(const std::filesystem::path& file,
                                                         std::optional<double> rim_mm, std::uint64_t seed,
                                                         const core::TaskContext& task);

}  // namespace ostia::app
