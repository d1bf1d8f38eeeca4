#pragma once
/// \file `ostia evaluate`: what it is told, and what its parts share.

#include "commands.h"

#include "ostia/geometry/tri_mesh.h"
#include "ostia/geometry/vessel_tree.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace ostia::app {

using Json = nlohmann::ordered_json;

struct EvaluateCommand {
  std::filesystem::path reference, result;
  std::filesystem::path report;           ///< -o
  std::filesystem::path picture;          ///< surface: the coloured surface alone, .png
  std::string units;                      ///< of surfaces and lines: "", "m", "cm", "mm"
  std::vector<std::string> requirements;  ///< "msd_mm<=0.3"
  bool json = false;
  std::string rules = "challenge";  ///< centerline: how OF and OT are read: challenge, paper
  std::filesystem::path tolerance;  ///< suite
  bool covered_only = false;        ///< surface: only where the result's centerlines run
  double resolution_mm = 0.2;       ///< volume: voxels of surfaces
  double sample_mm = 0.2;           ///< surface
  bool curvature = false;           ///< surface: also curvatures
  bool floor = false;               ///< lumen: the floor table instead
  bool find_stenoses = false;       ///< lumen: detection and grading of stenoses
  double stenosis_threshold = 0.5;  ///< lumen: least diameter stenosis that counts, share
};
ExitCode run_evaluate_centerline(const EvaluateCommand& command, const core::TaskContext& task);
ExitCode run_evaluate_lumen(const EvaluateCommand& command, const core::TaskContext& task);
ExitCode run_evaluate_surface(const EvaluateCommand& command, const core::TaskContext& task);
ExitCode run_evaluate_volume(const EvaluateCommand& command, const core::TaskContext& task);
ExitCode run_evaluate_motion(const EvaluateCommand& command, const core::TaskContext& task);
ExitCode run_evaluate_suite(const EvaluateCommand& command, const core::TaskContext& task);

/// Adds `evaluate` and its subcommands.
void define_evaluate(CLI::App& app, EvaluateCommand& command,
                     std::function<ExitCode(const core::TaskContext&)>& run);

/// One case of a data set with where its reference and its result lie.
struct CasePair {
  std::string name;  ///< "dataset00"; empty for a single pair
  std::filesystem::path reference, result;
  bool missing = false;  ///< there is no result
};
/// Folders `dataset*` of a reference folder, each with the folder of the same name below `result`; for
/// anything else the pair itself. Throws InvalidInput where no case has a result.
std::vector<CasePair> case_pairs(const std::filesystem::path& reference, const std::filesystem::path& result);

/// Throws UsageError unless both are named.
void require_pair(const EvaluateCommand& command);

/// `path` itself when it is a file, else the first of `names` in the folder. Throws InvalidInput naming them.
std::filesystem::path file_in(const std::filesystem::path& path, const std::vector<std::string>& names,
                              const std::string& what);

/// The same for the parts of a result: where the folder itself has none of `names`, those of its subfolders,
/// by name (models of the left and of the right coronary artery, say).
std::vector<std::filesystem::path> files_in(const std::filesystem::path& path,
                                            const std::vector<std::string>& names, const std::string& what);

/// Parts side by side: a result's surfaces, its lines with ids of their own.
geometry::TriMesh surface_of_parts(const std::vector<std::filesystem::path>& parts, const std::string& units);
geometry::VesselTree lines_of_parts(const std::vector<std::filesystem::path>& parts,
                                    const std::string& units);

geometry::TriMesh surface_from(const std::filesystem::path& path, const std::string& units);
geometry::VesselTree lines_from(const std::filesystem::path& path, const std::string& units);

/// Prints a result as JSON or as text made from it; 4 where a requirement is not met. Throws UsageError for a
/// requirement that cannot be read or names no figure.
ExitCode finish(const EvaluateCommand& command, const Json& result);
/// The text of a result: single values one a line, lists of objects as tables.
std::string table_text(const Json& result);

}  // namespace ostia::app
