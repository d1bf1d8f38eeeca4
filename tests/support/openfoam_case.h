#pragma once
/// \file What OpenFOAM's tools ask for besides a mesh.

#include "ostia/core/files.h"

#include <filesystem>
#include <string>

namespace ostia::testing {

/// A case around constant/polyMesh, as far as OpenFOAM's tools ask for one.
inline void add_control(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder / "system");
  const std::string head = "FoamFile { version 2.0; format ascii; class dictionary; object ";
  core::write_file(
      folder / "system" / "controlDict",
      head +
          "controlDict; }\napplication checkMesh; startFrom startTime; startTime 0; stopAt endTime;"
          " endTime 1; deltaT 1; writeControl timeStep; writeInterval 1; writePrecision 12;\n");
  core::write_file(folder / "system" / "fvSchemes",
                   head +
                       "fvSchemes; }\nddtSchemes{} gradSchemes{} divSchemes{} laplacianSchemes{}"
                       " interpolationSchemes{} snGradSchemes{}\n");
  core::write_file(folder / "system" / "fvSolution", head + "fvSolution; }\n");
}

}  // namespace ostia::testing
