#include "label_parts.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <numeric>

namespace ostia::dicom {

LabelLayers::LabelLayers(imaging::Geometry grid, std::size_t segments)
    : grid_(std::move(grid)), layers_(segments) {}

void LabelLayers::finish(LabelObject& to) {
  std::vector<std::size_t> sizes(layers_.size(), 0);
  std::vector<std::size_t> present;
  for (std::size_t s = 0; s < layers_.size(); ++s) {
    auto& runs = layers_[s].runs;
    std::sort(runs.begin(), runs.end());  // several frames of one plane may overlap
    std::size_t end = 0;
    for (auto& [first, last] : runs) {
      first = std::max(first, end);
      last = std::max(last, first);
      end = std::max(end, last);
      sizes[s] += last - first;
    }
    if (sizes[s] > 0) present.push_back(s);
  }
  if (present.empty()) throw InvalidInput("no segment has a voxel");
  if (present.size() > 255)
    throw InvalidInput(std::to_string(present.size()) +
                       " segments have voxels; at most 255 can be read at once: write those that are vessels "
                       "into a file of their own");
  for (std::size_t i = 0; i < present.size(); ++i)
    to.segments[present[i]].value = static_cast<std::uint8_t>(i + 1);
  // Numbers that fit stay as they are.
  const bool fit = std::all_of(present.begin(), present.end(), [&](std::size_t s) {
    return to.segments[s].number >= 1 && to.segments[s].number <= 255;
  });
  if (fit)
    for (const std::size_t s : present)
      to.segments[s].value = static_cast<std::uint8_t>(to.segments[s].number);
  std::vector<std::size_t> order = present;  // the largest first
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return sizes[a] > sizes[b]; });
  to.volume.geometry = grid_;
  to.volume.voxels.assign(static_cast<std::size_t>(grid_.voxels()), 0);
  std::size_t shared = 0;
  for (const std::size_t s : order) {
    for (const auto& [first, last] : layers_[s].runs) {
      for (std::size_t at = first; at < last; ++at) {
        shared += to.volume.voxels[at] != 0;
        to.volume.voxels[at] = to.segments[s].value;
      }
    }
  }
  if (shared > 0)
    to.warnings.push_back("segments overlap in " + std::to_string(shared) +
                          " voxels: there the one with fewer voxels counts");
}

void require_room(const imaging::Geometry& grid, std::int64_t most_voxels) {
  std::int64_t left = most_voxels;
  for (const std::int64_t n : grid.size) {
    if (n < 1) throw InvalidInput("it has no voxels");
    left /= n;
  }
  if (left < 1)
    throw InvalidInput("its grid would have " + std::to_string(grid.size[0]) + " x " +
                       std::to_string(grid.size[1]) + " x " + std::to_string(grid.size[2]) +
                       " voxels; that is more than " + std::to_string(most_voxels));
}

}  // namespace ostia::dicom
