#include "flow/case_continue.h"

#include "ostia/core/private_folder.h"
#include "ostia/solver/openfoam_continue.h"

#include <algorithm>
#include <cstdio>

namespace ostia::app {
namespace {

void print(const solver::CaseLength& length, const std::filesystem::path& folder) {
  const char* unit = length.pulsatile ? "s" : "iterations";
  std::printf("goes on from %g to %g %s\nrun it: %s/Allrun\n", length.now, length.end, unit, folder.c_str());
}

}  // namespace

ExitCode continue_case(const CaseCommand& c) {
  std::optional<int> iterations, cycles;
  for (const std::string& option : c.given) {
    if (option == "--iterations")
      iterations = c.iterations;
    else if (option == "--cycles")
      cycles = c.cycles;
    else if (option != "MESH" && option != "--output" && option != "--processes" && option != "--json")
      throw UsageError(option + " would make another case of " + c.mesh.string() +
                       ", which is there; --iterations and --cycles let it go on");
  }
  if (!c.output.empty() && c.output.lexically_normal() != c.mesh.lexically_normal())
    throw UsageError(c.mesh.string() + " is a case: it goes on where it is, without -o");
  print(solver::continue_openfoam_case(c.mesh, iterations, cycles), c.mesh);
  return ExitCode::ok;
}

void continue_same_case(const geometry::MixedMesh& mesh, const pipeline::SolverCase& asked,
                        const CaseCommand& c, const core::TaskContext& task) {
  const core::PrivateFolder folder;
  pipeline::write_solver_case(mesh, asked, folder.path() / "case", task);
  const std::string other = solver::difference_of_cases(c.output, folder.path() / "case");
  if (!other.empty())
    throw InvalidInput("cannot write the case to " + c.output.string() +
                       ": the folder holds something already, another case (its " + other +
                       " is different); name a new folder");
  const bool pulsatile = solver::length_of(c.output).pulsatile;
  print(solver::continue_openfoam_case(c.output, pulsatile ? std::nullopt : std::optional(c.iterations),
                                       pulsatile ? std::optional(c.cycles) : std::nullopt),
        c.output);
}

}  // namespace ostia::app
