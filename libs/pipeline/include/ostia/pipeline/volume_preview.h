#pragma once
/// \file Slices of an image with rulers in world mm, from which seed points are read.

#include "ostia/imaging/volume.h"

#include <filesystem>
#include <optional>
#include <vector>

namespace ostia::pipeline {

struct PreviewOptions {
  std::optional<geometry::Vec3>
      position;           ///< through which the three planes go; left out: the image's centre
  int axial_slices = 12;  ///< evenly spread over the image, one sheet; in [0, 100]
  double level_hu = 250.0, window_hu = 900.0;
};

/// Writes planes.png (axial, coronal, sagittal) and axial-NNN.png files into `folder`, which is made. Returns
/// the files' names.
std::vector<std::string> write_preview(const imaging::ImageVolume& image, const std::filesystem::path& folder,
                                       const PreviewOptions& options = {});

}  // namespace ostia::pipeline
