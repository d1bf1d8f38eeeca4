#pragma once
/// \file What commands say on standard output, as text or as JSON.

#include "ostia/geometry/mesh_topology.h"
#include "ostia/geometry/tri_mesh.h"
#include "ostia/imaging/dicom.h"
#include "ostia/imaging/volume.h"

#include <string>
#include <vector>

namespace ostia::app {

/// What there is to say about an image.
/// One value of a mask.
struct LabelFacts {
  int label = 0;
  std::size_t voxels = 0;
};
struct ImageFacts {
  std::string kind;
  imaging::Geometry geometry;
  double least = 0.0, largest = 0.0, median = 0.0;
  std::vector<std::string> warnings;
  std::vector<LabelFacts> labels{};  ///< of a mask, in their order
};
std::string image_text(const ImageFacts& facts, bool json);

struct SurfaceFacts {
  std::size_t points = 0, triangles = 0;
  double area_mm2 = 0.0, volume_mm3 = 0.0;
  geometry::Box3 box;
  geometry::SurfaceFaults faults;
};
std::string surface_text(const SurfaceFacts& facts, bool json);

/// The series of a DICOM folder, for the terminal.
std::string series_text(const imaging::DicomFolder& folder, bool json);

}  // namespace ostia::app
