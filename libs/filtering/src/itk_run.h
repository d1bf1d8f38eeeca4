#pragma once
/// \file ITK's images and filters, run by Ostia's threads. Private to the room.

#include "calls.h"

#include <itkImage.h>
#include <itkProcessObject.h>

#include <cstdint>
#include <functional>

namespace ostia::filtering::detail {

using ItkImage = itk::Image<float, 3>;
using ItkMask = itk::Image<std::uint8_t, 3>;

/// Gives a grid to an image of ITK's that has no voxels yet.
void set_grid(itk::ImageBase<3>& image, const imaging::Geometry& grid);

/// The volume as ITK sees it, without a copy. Filters may read it alone: `run` sees to that.
template <class T>
typename itk::Image<T, 3>::Pointer view_of(const imaging::Volume<T>& volume) {
  auto image = itk::Image<T, 3>::New();
  set_grid(*image, volume.geometry);
  image->GetPixelContainer()->SetImportPointer(const_cast<T*>(volume.voxels.data()), volume.voxels.size(),
                                               false);
  return image;
}

/// A filter's result on its own grid, copied.
template <class T>
Image volume_of(const itk::Image<T, 3>& image, const imaging::Geometry& grid) {
  const T* first = image.GetBufferPointer();
  return {grid, {first, first + image.GetBufferedRegion().GetNumberOfPixels()}};
}

/// Updates a filter: its progress is the task's, and it ends where the task is cancelled.
void update(itk::ProcessObject& filter, const core::TaskContext& task);

template <class Filter>
void run(Filter& filter, const core::TaskContext& task) {
  if constexpr (requires { filter.InPlaceOff(); }) filter.InPlaceOff();  // what it is given is only lent
  update(filter, task);
}

/// Calls `step` so that all that ITK does in it on several threads is done by core's, in pieces that do not
/// depend on their number, and asks before each piece whether `task` was cancelled. What ITK throws becomes
/// an error of ours that begins with `name`.
Image in_our_threads(const std::string& name, const core::TaskContext& task,
                     const std::function<Image()>& step);

}  // namespace ostia::filtering::detail
