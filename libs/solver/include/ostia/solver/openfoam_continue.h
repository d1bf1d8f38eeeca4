#pragma once
/// \file A case that was run goes on for longer, with the fields that it has.

#include <filesystem>
#include <optional>
#include <string>

namespace ostia::solver {

/// How far a case has come, and shall come: iterations of a steady one, seconds of a pulsatile one.
struct CaseLength {
  bool pulsatile = false;
  double now = 0.0;  ///< of the newest result; 0: it was not run
  double end = 0.0;  ///< at which the run ends
};

/// Whether `folder` holds a case of write_openfoam_case.
bool is_openfoam_case(const std::filesystem::path& folder);

/// Throws InvalidInput where there is no such case.
CaseLength length_of(const std::filesystem::path& folder);

/// A steady case ends at so many iterations, a pulsatile one after so many cycles (of which the inlets'
/// velocities are written, too). Results stay, and the next ./Allrun goes on from the newest. Throws
/// InvalidInput: no case, iterations for a pulsatile one or cycles for a steady one, neither or both, a
/// number out of range, less than it has come to already; IoError, ResourceError.
CaseLength continue_openfoam_case(const std::filesystem::path& folder, std::optional<int> iterations,
                                  std::optional<int> cycles);

/// What sets the case in `folder` apart from `fresh`, one that was written and not run, but for how long they
/// run and on how many processes: the first file of `fresh` that is another one; empty: nothing.
std::string difference_of_cases(const std::filesystem::path& folder, const std::filesystem::path& fresh);

}  // namespace ostia::solver
