#include "picture_cover.h"

#include "ostia/geometry/segment_blocks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace ostia::geometry {
namespace {

constexpr double thick_px = 0.5;       // radius from which a segment is always drawn
constexpr double line_px = 1.0;        // width of what is thinner
constexpr double cover_by_thin = 1.5;  // times a block's place in the picture
constexpr std::size_t slices = 1024;   // of depth

}  // namespace

std::vector<SegmentBlocks::Wanted> SegmentBlocks::wanted(const BlockView& view, BlockChoice& choice) const {
  const Vec3 eye = view.eye - centre_;
  // Outward from the picture's four sides, through the eye.
  const std::array<Vec3, 4> sides{(view.right + view.half_width * view.back).normalized(),
                                  (-view.right + view.half_width * view.back).normalized(),
                                  (view.up + view.half_height * view.back).normalized(),
                                  (-view.up + view.half_height * view.back).normalized()};
  std::vector<Wanted> all;
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    const Block& block = blocks_[b];
    const Vec3 at = Vec3(block.middle[0], block.middle[1], block.middle[2]) - eye,
               half(block.half[0], block.half[1], block.half[2]);
    const auto beyond = [&](const Vec3& outward) { return at.dot(outward) > half.dot(outward.cwiseAbs()); };
    if (beyond(view.back) || std::any_of(sides.begin(), sides.end(), beyond)) {
      choice.outside += block.count;
      continue;
    }
    const double middle = -at.dot(view.back), reach = half.dot(view.back.cwiseAbs()), depth = middle - reach;
    Wanted one{static_cast<std::uint32_t>(b), block.count, 0, static_cast<float>(depth),
               static_cast<float>(middle + reach)};
    if (depth > 0.0) {
      const double px = view.height_px / (2.0 * view.half_height * depth);  // a mm, at the nearest
      const auto begin = segments_.begin() + block.first;
      one.thick = static_cast<std::uint32_t>(
          std::partition_point(begin, begin + block.count,
                               [&](const DrawnSegment& s) { return s.thickness() * px >= thick_px; }) -
          begin);
      // A box's shadow is a quarter of its surface, in the mean over all directions (Cauchy).
      const double area = 2.0 * (half.x() * half.y() + half.y() * half.z() + half.z() * half.x()) * px * px;
      const double enough = cover_by_thin * area / std::max(1.0, line_px * block.mean_length * px);
      one.thin = static_cast<std::uint32_t>(
          std::min(std::ceil(enough) + 1.0, static_cast<double>(block.count - one.thick)));
    }
    all.push_back(one);
  }
  return all;
}

/// What is wanted of one block, as many as `one` says.
void SegmentBlocks::take(const Wanted& one, double share, std::span<const std::uint8_t> shown,
                         std::vector<DrawnSegment>& segments, BlockChoice& choice) const {
  const Block& block = blocks_[one.block];
  const std::size_t count =
      one.thick + static_cast<std::size_t>(std::ceil(share * static_cast<double>(one.thin)));
  const auto begin = segments_.begin() + block.first, end = begin + block.count;
  if (shown.empty()) {
    segments.insert(segments.end(), begin, begin + static_cast<std::ptrdiff_t>(count));
    choice.left_out += block.count - count;
    return;
  }
  std::size_t taken = 0;
  for (auto at = begin; at != end; ++at) {
    if (shown[static_cast<std::size_t>(at->edge)] == 0) continue;
    if (taken++ < count)
      segments.push_back(*at);
    else
      ++choice.left_out;
  }
}

/// What is wanted and not hidden, in slices of depth from the nearest on. A block is opened in the slice
/// where it begins, so that all that could hide it has been counted.
void SegmentBlocks::take_seen(const std::vector<Wanted>& all, double share, const BlockView& view,
                              std::span<const std::uint8_t> shown, std::vector<DrawnSegment>& segments,
                              BlockChoice& choice) const {
  float nearest = std::numeric_limits<float>::max(), farthest = 0.0f;
  for (const Wanted& one : all)
    nearest = std::min(nearest, one.nearest), farthest = std::max(farthest, one.farthest);
  nearest = std::max(nearest, 0.0f);
  const float scale = static_cast<float>(slices - 1) / std::max(farthest - nearest, 1e-30f);
  const auto slice_of = [&](float depth) {
    return static_cast<std::size_t>(
        std::clamp((depth - nearest) * scale, 0.0f, static_cast<float>(slices - 1)));
  };
  struct Slice {
    std::vector<const Wanted*> begins;
    std::vector<std::pair<detail::PlacedSegment, DrawnSegment>> segments;
  };
  std::vector<Slice> sweep(slices);
  for (const Wanted& one : all) sweep[slice_of(one.nearest)].begins.push_back(&one);
  detail::PictureCover cover(view, centre_);
  std::vector<DrawnSegment> of_block;
  for (std::size_t s = 0; s < slices; ++s) {
    for (const Wanted* one : sweep[s].begins) {
      const Block& block = blocks_[one->block];
      if (cover.hides(Vec3(block.middle[0], block.middle[1], block.middle[2]),
                      Vec3(block.half[0], block.half[1], block.half[2]))) {
        choice.hidden += block.count;
        continue;
      }
      of_block.clear();
      take(*one, share, shown, of_block, choice);
      for (const DrawnSegment& segment : of_block) {
        const detail::PlacedSegment placed = cover.place(segment);
        if (placed.depth > 0.0f)
          sweep[std::max(s, slice_of(placed.depth))].segments.emplace_back(placed, segment);
        else
          segments.push_back(segment);  // reaches behind the eye
      }
    }
    for (const auto& [placed, segment] : sweep[s].segments) {
      if (cover.hides(placed)) {
        ++choice.hidden;
        continue;
      }
      cover.add(placed);
      segments.push_back(segment);
    }
    sweep[s] = {};
  }
}

BlockChoice SegmentBlocks::choose(const BlockView& view, std::span<const std::uint8_t> shown,
                                  std::size_t most, std::vector<DrawnSegment>& segments) const {
  BlockChoice choice;
  segments.clear();
  std::vector<Wanted> all = wanted(view, choice);
  if (most == everything)
    for (Wanted& one : all) one.thin = blocks_[one.block].count - one.thick;
  std::size_t thick = 0, thin = 0;
  for (const Wanted& one : all) thick += one.thick, thin += one.thin;
  const std::size_t room = most > thick ? most - thick : 0;
  const double share = thin <= room ? 1.0 : static_cast<double>(room) / static_cast<double>(thin);
  if (thick > most)
    take_seen(all, share, view, shown, segments, choice);
  else
    for (const Wanted& one : all) take(one, share, shown, segments, choice);
  choice.chosen = segments.size();
  return choice;
}

}  // namespace ostia::geometry
