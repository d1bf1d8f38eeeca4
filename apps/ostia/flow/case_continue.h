#pragma once
/// \file `ostia case` for a case that is there already.

#include "flow/solver_case.h"

namespace ostia::app {

/// Of `ostia case CASE --iterations N`, or `--cycles N`: the case in `c.mesh` runs for longer. Throws
/// UsageError for other options, which would make another case of it.
ExitCode continue_case(const CaseCommand& c);

/// Of `ostia case MESH -o CASE ...` where CASE is there: whether it is the very case that `asked` makes of
/// the mesh, which then runs for as long as is asked. Throws InvalidInput that names what is different where
/// it is another one.
void continue_same_case(const geometry::MixedMesh& mesh, const pipeline::SolverCase& asked,
                        const CaseCommand& c, const core::TaskContext& task);

}  // namespace ostia::app
