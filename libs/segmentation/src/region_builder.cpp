#include "region_builder.h"

#include "ostia/core/error.h"

#include <algorithm>

namespace ostia::segmentation::detail {
namespace {

template <class Visit>
void for_neighbours(const std::array<std::int64_t, 3>& size, const Voxel& v, const Visit& visit) {
  for (int d = 0; d < 3; ++d) {
    for (const int s : {-1, 1}) {
      Voxel n = v;
      n[d] += s;
      if (n[d] >= 0 && n[d] < size[d]) visit(n);
    }
  }
}

constexpr int kPitNeighbours = 4;  // a convex or flat outside never has as many: filling cannot run away
constexpr int kPitRounds = 10;

}  // namespace

RegionBuilder::RegionBuilder(const imaging::Geometry& geometry)
    : geometry_(geometry), values_(geometry.size, 1.0F) {}

void RegionBuilder::add(const Voxel& v, float value) {
  float& stored = values_.at(v);
  if (value >= stored) return;
  if (stored >= 0.0F && value < 0.0F) inside_.push_back(v);
  stored = value;
}

bool RegionBuilder::add_connected(const BlockGrid<float>& values, const Voxel& from, const Voxel& to) {
  BlockGrid<std::uint8_t> seen(geometry_.size, 0);
  std::vector<Voxel> part{from};
  seen.at(from) = 1;
  for (std::size_t n = 0; n < part.size(); ++n) {
    const Voxel v = part[n];
    for_neighbours(geometry_.size, v, [&](const Voxel& next) {
      if (values.get(next) >= 0.0F || seen.get(next) != 0) return;
      seen.at(next) = 1;
      part.push_back(next);
    });
  }
  if (seen.get(to) == 0) return false;
  for (const Voxel& v : part) add(v, std::min(values.get(v), -1e-3F));
  return true;
}

void RegionBuilder::fill_pits() {
  // Noise leaves single voxels and pits out of the range; a voxel with four of six neighbours inside is one.
  std::vector<Voxel> border = inside_;
  for (int round = 0; round < kPitRounds && !border.empty(); ++round) {
    std::vector<Voxel> filled;
    BlockGrid<std::uint8_t> seen(geometry_.size, 0);
    for (const Voxel& v : border) {
      for_neighbours(geometry_.size, v, [&](const Voxel& outside) {
        if (values_.get(outside) < 0.0F || seen.get(outside) != 0) return;
        seen.at(outside) = 1;
        int count = 0;
        for_neighbours(geometry_.size, outside,
                       [&](const Voxel& n) { count += values_.get(n) < 0.0F ? 1 : 0; });
        if (count >= kPitNeighbours) filled.push_back(outside);
      });
    }
    for (const Voxel& v : filled) add(v, -0.1F);
    border = std::move(filled);
  }
}

InitialRegion RegionBuilder::finish(int margin_voxels) {
  if (inside_.empty()) throw GeometryError("the initial region is empty: place the seeds further apart");
  fill_pits();
  InitialRegion result;
  imaging::Region& box = result.region;
  box.lower = geometry_.size;
  for (const Voxel& v : inside_) {
    for (int d = 0; d < 3; ++d) {
      box.lower[d] = std::min<std::int64_t>(box.lower[d], v[d]);
      box.upper[d] = std::max<std::int64_t>(box.upper[d], v[d] + 1);
    }
  }
  for (int d = 0; d < 3; ++d) {
    result.touches_border |= box.lower[d] == 0 || box.upper[d] == geometry_.size[d];
    box.lower[d] = std::max<std::int64_t>(0, box.lower[d] - margin_voxels);
    box.upper[d] = std::min(geometry_.size[d], box.upper[d] + margin_voxels);
  }
  imaging::Geometry cropped = geometry_;
  for (int d = 0; d < 3; ++d) cropped.size[d] = box.upper[d] - box.lower[d];
  cropped.origin = geometry_.world(Vec3(static_cast<double>(box.lower[0]), static_cast<double>(box.lower[1]),
                                        static_cast<double>(box.lower[2])));
  result.level_set = {cropped, std::vector<float>(static_cast<std::size_t>(cropped.voxels()), 1.0F)};
  for (const Voxel& v : inside_) {
    result.level_set(v[0] - box.lower[0], v[1] - box.lower[1], v[2] - box.lower[2]) = values_.get(v);
  }
  // The outer rim keeps its graded values, so that the zero crossing lies between the voxels.
  for (const Voxel& v : inside_) {
    for_neighbours(geometry_.size, v, [&](const Voxel& n) {
      const float value = values_.get(n);
      if (value >= 0.0F)
        result.level_set(n[0] - box.lower[0], n[1] - box.lower[1], n[2] - box.lower[2]) = value;
    });
  }
  result.voxels = static_cast<std::int64_t>(inside_.size());
  return result;
}

}  // namespace ostia::segmentation::detail
