#pragma once
/// \file What is known at the elements and nodes of a volume mesh, such as a solver's result, in a VTU file.

#include "ostia/geometry/mixed_mesh.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace ostia::io {

/// Components together: x0 y0 z0 x1 y1 z1 ...
struct FieldValues {
  int components = 1;  ///< 1 to 9
  std::vector<double> values;
};

/// By name. A name that ends in a unit says it: `pressure_Pa`, `velocity_m_s`.
struct VolumeFields {
  std::map<std::string, FieldValues> cells;   ///< tetrahedra, then prisms
  std::map<std::string, FieldValues> points;  ///< as MixedMesh::points
};

/// Writes what export_mesh writes as VTU, with the fields. On the boundary's cells, which the file holds as
/// well, cell fields are NaN. Throws InvalidInput where a field has another number of values, IoError.
void write_vtu_with_fields(const std::filesystem::path& path, const geometry::MixedMesh& mesh,
                           const VolumeFields& fields);

/// The fields of a VTU file, those of cells at its elements in the order in which read_volume_mesh reads
/// them. Arrays that are no numbers or of more than 9 components, and the ids of faces and elements that
/// Ostia writes, are left out. Throws InvalidInput as read_volume_mesh does.
VolumeFields read_vtu_fields(const std::filesystem::path& path);

}  // namespace ostia::io
