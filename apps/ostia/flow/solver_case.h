#pragma once
/// \file `ostia case`, and the cases that other commands write with their meshes.

#include "commands.h"
#include "flow/case_options.h"

#include "ostia/pipeline/volume_mesh.h"

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
}

namespace ostia::app {

struct CaseCommand : CaseOptions {
  std::filesystem::path mesh;    ///< volume mesh with named faces, or the folder of a case that goes on
  std::filesystem::path output;  ///< folder that is made
  bool json = false;
  std::vector<std::string> given;  ///< names of the options that are on the command line
};
ExitCode run_case(const CaseCommand& options, const core::TaskContext& task);

/// What the command line calls the solvers: pipeline::solver_kinds.
std::vector<std::string> solver_names();
/// That text of each, with `between` between two of them: "openfoam or svmultiphysics".
std::string of_all_solvers(std::string_view pipeline::SolverTraits::*text, const std::string& between);
/// Flow, fluid and steps; `iterations` is the name of the option of that name ("--iterations").
void add_case_options(CLI::App& app, CaseOptions& options, const std::string& iterations);
/// What the command line has asked for, as the library takes it. Throws UsageError and InvalidInput for what
/// is out of range or does not go together; reads a waveform's table.
pipeline::SolverCase solver_case(const CaseOptions& options);
/// How the case beside a mesh is run; nothing where there is none.
void tell_case(const pipeline::VolumeOptions& options, const std::filesystem::path& folder);

/// Adds `case`.
void define_case(CLI::App& app, CaseCommand& command, std::function<ExitCode(const core::TaskContext&)>& run);

}  // namespace ostia::app
