#pragma once
/// \file A patient's coronary tree, of a model or a mask, to build a synthetic heart around
/// (docs/methods/phantom-trees.md).

#include "ostia/core/task_context.h"
#include "ostia/imaging/volume.h"
#include "ostia/lumen/lumen_model.h"
#include "ostia/phantom/patient_tree.h"

#include <cstdint>

namespace ostia::session {

/// Axes, mean radii, and names that are standard ones; long axis and dominance as coronary::label_branches
/// sees them. No rim, no digest. Throws as label_branches does.
phantom::PatientTree patient_of(const lumen::LumenModel& model);

/// The same of a mask (model_of_mask), with its remarks. Where its arteries lie on no heart as its axes say,
/// it is tried with its axes turned and mirrored: one way that is right with a probability of 0.8 and more is
/// taken, and that is a remark. `seed`: of the heart that it is laid on. Throws as model_of_mask does;
/// GeometryError where no way shows an LAD, or none is sure; Cancelled.
phantom::PatientTree patient_of_mask(const imaging::MaskVolume& labels, std::uint64_t seed = 1,
                                     const core::TaskContext& task = core::no_task());

}  // namespace ostia::session
