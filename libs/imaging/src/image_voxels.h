#pragma once
/// \file What the readers of images and of masks share: a file's voxels block by block, and their grid.

#include "affine_resample.h"
#include "image_data.h"
#include "image_source.h"
#include "pixel_types.h"
#include "placement.h"

#include "ostia/core/error.h"
#include "ostia/imaging/image_file.h"

#include <algorithm>
#include <filesystem>
#include <new>
#include <vector>

namespace ostia::imaging {

inline constexpr std::size_t block_voxels = std::size_t{1} << 16;

/// Calls visit(first voxel, pointer to values of the stored type, count) block by block; returns whether
/// there is more data than needed. `visit` returns false to stop early.
template <class Visit>
bool visit_voxels(const ImageSource& source, const core::TaskContext& task, const Visit& visit) {
  VoxelStream stream(source);
  std::vector<std::uint64_t> buffer(block_voxels);  // room for the widest type, aligned for all
  const std::size_t voxels = static_cast<std::size_t>(source.voxels());
  bool on = true;
  for (std::size_t first = 0; first < voxels && on; first += block_voxels) {
    task.throw_if_cancelled();
    const std::size_t count = std::min(block_voxels, voxels - first);
    stream.read(buffer.data(), count);
    with_pixel_type(source.pixel_type, [&](auto zero) {
      on = visit(first, reinterpret_cast<const decltype(zero)*>(buffer.data()), count);
    });
    task.set_progress(static_cast<double>(first + count) / static_cast<double>(voxels));
  }
  return on && stream.more_than_needed();
}

struct Prepared {
  ImageSource source;
  Placement placement;
  ImageHeader header;
};

/// Reads and checks the header.
Prepared prepare(const std::filesystem::path& path);

template <class T>
std::vector<T> room_for(const ImageSource& source) {
  try {
    return std::vector<T>(static_cast<std::size_t>(source.voxels()));
  } catch (const std::bad_alloc&) {
    throw ResourceError(source.header_path.string() + ": not enough memory for " +
                        std::to_string(source.voxels()) + " voxels");
  }
}

/// Puts the stored voxels in the order, and on the grid, of the placement.
template <class T>
LoadedImage<T> placed(Prepared&& p, std::vector<T>&& stored, Interpolation how, Beyond beyond, T outside,
                      const core::TaskContext& task) {
  if (p.placement.slices_reversed) {
    const std::int64_t slice = p.source.size[0] * p.source.size[1], slices = p.source.size[2];
    for (std::int64_t k = 0; k < slices / 2; ++k)
      std::swap_ranges(stored.begin() + k * slice, stored.begin() + (k + 1) * slice,
                       stored.begin() + (slices - 1 - k) * slice);
  }
  LoadedImage<T> result;
  result.header = std::move(p.header);
  result.volume.geometry = p.placement.geometry;
  if (p.placement.sheared) {
    affine_resample(stored.data(), p.source.size, p.placement.linear, p.placement.offset, how, beyond,
                    outside, result.volume, task);
  } else {
    result.volume.voxels = std::move(stored);
  }
  return result;
}

/// Warns of data behind the last voxel.
void note_surplus(Prepared& p, bool surplus);

}  // namespace ostia::imaging
