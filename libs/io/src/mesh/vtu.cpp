// VTK's unstructured grid: elements and boundary facets together, told apart by CellEntityIds.

#include "mesh/formats.h"
#include "mesh/text.h"
#include "mesh/vtk_cells.h"
#include "vtk/xml.h"

namespace ostia::io {

void write_vtu(const PreparedMesh& mesh, const std::filesystem::path& file) {
  write_whole(file, grid_text(*grid_of(mesh)));
}

}  // namespace ostia::io
