#pragma once
/// \file `ostia dicom`: what it is told.

#include "commands.h"

#include <filesystem>
#include <functional>
#include <string>

namespace CLI {
class App;
}

namespace ostia::app {

struct DicomCommand {
  std::filesystem::path input;   ///< case, or an object that is to be told
  std::filesystem::path series;  ///< DICOM folder of the CT; empty: a pseudonym
  std::filesystem::path image;   ///< the CT for its voxels alone
  std::filesystem::path ffr;     ///< ffr.json; empty: none
  std::filesystem::path output;  ///< folder that is made
  std::string objects;           ///< "seg,pdf"; empty: the usual ones
  std::string date, language = "en";
  bool json = false;
};
ExitCode run_dicom(const DicomCommand& options, const core::TaskContext& task);

/// Adds `dicom`.
void define_dicom(CLI::App& app, DicomCommand& dicom, std::function<ExitCode(const core::TaskContext&)>& run);

}  // namespace ostia::app
