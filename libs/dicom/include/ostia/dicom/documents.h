#pragma once
/// \file Documents, surfaces and pictures as DICOM objects.

#include "ostia/dicom/code.h"
#include "ostia/dicom/object.h"
#include "ostia/geometry/tri_mesh.h"

#include <cstdint>
#include <string>
#include <vector>

namespace ostia::dicom {

/// A PDF (PS3.3 A.45.1). Throws InvalidInput for bytes that are none, or of 4 GiB and more.
DicomDataset encapsulated_pdf(const SourceSeries& source, std::string pdf, const std::string& title,
                              const ObjectOptions& options = {});

/// A closed or open surface, world LPS mm, as binary STL in the source's frame of reference (PS3.3 A.85.1);
/// the unit is UCUM's mm. Throws InvalidInput for a surface without triangles.
DicomDataset encapsulated_stl(const SourceSeries& source, const geometry::TriMesh& surface,
                              const std::string& title, const ObjectOptions& options = {});

/// A picture.
struct CapturedPicture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;  ///< three bytes a pixel, row by row from the top
  std::string caption;            ///< ImageComments
};
/// A Secondary Capture (PS3.3 A.8.1), RGB, uncompressed. Throws InvalidInput for a picture that is empty,
/// larger than 65,535 or does not fill its size.
DicomDataset secondary_capture(const SourceSeries& source, const CapturedPicture& picture,
                               const ObjectOptions& options = {});

}  // namespace ostia::dicom
