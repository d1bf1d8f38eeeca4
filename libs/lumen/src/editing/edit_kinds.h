#pragma once
/// \file The edits, one function each; `apply` chooses among them.

#include "ostia/lumen/edit.h"

namespace ostia::lumen {

// wall_editing*.cpp
EditOutcome apply_to(const LumenModel& model, const CprStroke& edit);
EditOutcome apply_to(const LumenModel& model, const SectionContour& edit);
EditOutcome apply_to(const LumenModel& model, const WallDrag& edit);
EditOutcome apply_to(const LumenModel& model, const WallPush& edit);
// axis_editing.cpp, branch_editing.cpp
EditOutcome apply_to(const LumenModel& model, const AxisMove& edit);
EditOutcome apply_to(const LumenModel& model, const AxisInsert& edit);
EditOutcome apply_to(const LumenModel& model, const AxisDelete& edit);
EditOutcome apply_to(const LumenModel& model, const AxisExtend& edit);
EditOutcome apply_to(const LumenModel& model, const AxisTrim& edit);
EditOutcome apply_to(const LumenModel& model, const BranchAdd& edit);
EditOutcome apply_to(const LumenModel& model, const BranchDelete& edit);
EditOutcome apply_to(const LumenModel& model, const BranchAttach& edit);
EditOutcome apply_to(const LumenModel& model, const BranchConnect& edit);
EditOutcome apply_to(const LumenModel& model, const VesselRename& edit);
// vessel_adding.cpp
EditOutcome apply_to(const LumenModel& model, const VesselAdd& edit);
// branch_splitting.cpp
EditOutcome apply_to(const LumenModel& model, const BranchSplit& edit);
EditOutcome apply_to(const LumenModel& model, const BranchMerge& edit);
EditOutcome apply_to(const LumenModel& model, const BranchCut& edit);

}  // namespace ostia::lumen
