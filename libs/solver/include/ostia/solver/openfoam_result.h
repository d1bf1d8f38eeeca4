#pragma once
/// \file What OpenFOAM has computed, read back.

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace ostia::solver {

/// Values of a field at the cells (in the mesh's order: tetrahedra, then prisms) and at the facets of the
/// patches that hold values (in the order of Section), in the field's own unit (SI; kinematic pressure and
/// shear stress are over the density).
struct OpenfoamField {
  std::size_t components = 1;                          ///< 1 or 3
  std::vector<double> cells;                           ///< components together
  std::map<std::string, std::vector<double>> patches;  ///< as `cells`; those without `value` are left out
  double magnitude(const std::vector<double>& values, std::size_t i) const;
};

/// Reads an ASCII volScalarField or volVectorField; uniform values are spread over `cells` cells and over the
/// patches that have as many facets as `facets` says. Throws InvalidInput that names file and line: no such
/// field, another number of values, binary.
OpenfoamField read_openfoam_field(const std::filesystem::path& file, std::size_t cells,
                                  const std::map<std::string, std::size_t>& facets);

/// A time (or, in a steady run, an iteration) whose fields have been written.
struct OpenfoamTime {
  double time = 0.0;
  std::filesystem::path folder;
};
/// Those after 0, in order. Throws IoError.
std::vector<OpenfoamTime> times_of(const std::filesystem::path& case_folder);

/// The folder of the last time in a case. Throws InvalidInput when it has none after 0: it has not been run.
std::filesystem::path last_time(const std::filesystem::path& case_folder);

}  // namespace ostia::solver
