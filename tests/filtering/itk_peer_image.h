#pragma once
/// \file Images of ITK for its filters beside ours.

#include "ostia/core/parallel.h"
#include "ostia/imaging/volume.h"
#include "ostia/itk.h"

#include <itkMultiThreaderBase.h>

#include <algorithm>
#include <memory>

namespace ostia::filtering::peers {

using PeerImage = itk::Image<float, 3>;

/// As many threads as ours.
inline void use_our_number_of_threads() {
  itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(
      static_cast<unsigned>(std::max(1, core::max_threads())));
}

/// Seen, and neither copied nor kept.
inline PeerImage::ConstPointer lent(const imaging::FloatVolume& volume) {
  return itk_image(std::shared_ptr<const imaging::FloatVolume>(&volume, [](const auto*) {}));
}

inline imaging::FloatVolume taken(const PeerImage& image, const imaging::Geometry& grid) {
  const float* first = image.GetBufferPointer();
  return {grid, {first, first + grid.voxels()}};
}

}  // namespace ostia::filtering::peers
