#pragma once
/// \file Results on a surface as they are listed: names in words, units, values.

#include "ostia/io/surface_fields.h"
#include "ostia/view/surface_field_scene.h"

#include <QString>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace ostia::workstation {

struct FlowArray {
  std::string name;  ///< as the file has it
  view::FieldAt at = view::FieldAt::points;
  bool magnitude = false;  ///< `values` are the lengths of vectors
  std::vector<double> values;
};

struct FlowSurface {
  std::shared_ptr<const view::FieldSurface> surface;
  std::vector<FlowArray> arrays;  ///< at least one; those at points first
};
/// Several (the walls of left and right artery) as one surface, with the arrays that all have. Throws
/// InvalidInput for files without such arrays, and as io::read_surface_with_fields does.
FlowSurface read_flow_surface(const std::vector<std::filesystem::path>& files);

/// Of a surface that has been read. Throws InvalidInput where it has no values.
FlowSurface flow_surface_of(io::SurfaceWithFields read);

/// The unit that a name ends in: "Pa" of wall_shear_stress_Pa; empty where it names none.
QString unit_of_array(const std::string& name);
/// "wall shear stress", in the interface's language where it is one that Ostia writes.
QString title_of_array(const FlowArray& array);
/// With the unit, as over the bar: "wall shear stress, Pa".
QString title_with_unit(const FlowArray& array);
/// Three digits that count, with the unit.
QString value_text(double value, const FlowArray& array);
/// The array that is shown at first.
std::size_t first_shown(const std::vector<FlowArray>& arrays);

}  // namespace ostia::workstation
