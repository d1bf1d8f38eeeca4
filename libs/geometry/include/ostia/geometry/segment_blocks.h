#pragma once
/// \file Segments of a large vessel tree in blocks, for pictures that take no longer than what is seen of it.
/// See docs/methods/huge-trees.md.

#include "ostia/core/task_context.h"
#include "ostia/geometry/vessel_graph.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace ostia::geometry {

/// As it goes to the graphics card: single precision, mm from SegmentBlocks::centre(). Radii that are no
/// positive number are 0.
struct DrawnSegment {
  std::array<float, 3> from{};
  float radius_from = 0.0f;
  std::array<float, 3> to{};
  float radius_to = 0.0f;
  std::int32_t edge = -1;
  float thickness() const { return std::max(radius_from, radius_to); }
};

/// A picture in perspective. Directions are unit; `back` points from what is seen to the eye. Half sizes are
/// tangents of half the angles.
struct BlockView {
  Vec3 eye = Vec3::Zero(), right{1, 0, 0}, up{0, 0, 1}, back{0, -1, 0};
  double half_width = 0.36, half_height = 0.27;
  int height_px = 768;
};

struct BlockChoice {
  std::size_t chosen = 0;
  std::size_t left_out = 0;  ///< wanted, of blocks in the picture: too small to be told apart
  std::size_t outside = 0;   ///< of blocks beside the picture, wanted or not
  std::size_t hidden = 0;    ///< behind others; of whole blocks there, wanted or not
};

/// Blocks of 256 segments along a space-filling curve, thick ones first in each. Segments without finite
/// places are left out. 40 bytes a segment.
class SegmentBlocks {
 public:
  explicit SegmentBlocks(const VesselGraph& graph, const core::TaskContext& task = core::no_task());
  const Vec3& centre() const { return centre_; }
  const Vec3& low() const { return low_; }  ///< of the segments' ends; 0 where there is none
  const Vec3& high() const { return high_; }
  std::size_t size() const { return segments_.size(); }
  /// One of the graph's edges; null where it has no finite place.
  const DrawnSegment* segment(std::int32_t edge) const;

  /// What a picture needs: of each block that it meets, all segments whose radius is half a pixel or more,
  /// and of the others, thick ones first, as many as cover the block's place in the picture. Where that is
  /// more than `most` in all, fewer of the thin ones are taken; where the thick ones alone are more, those
  /// that nearer ones hide are left out, and the others come nearest first. Thick ones that are seen are
  /// never left out. With `everything`, all segments of the blocks that it meets. `shown`, where it is not
  /// empty, has 0 for edges that are not wanted. Replaces `segments`; the same for the same view.
  static constexpr std::size_t everything = static_cast<std::size_t>(-1);
  BlockChoice choose(const BlockView& view, std::span<const std::uint8_t> shown, std::size_t most,
                     std::vector<DrawnSegment>& segments) const;

 private:
  struct Block {
    std::array<float, 3> middle{}, half{};  ///< of its box, with the radii, from centre_
    std::uint32_t first = 0, count = 0;
    float mean_length = 0.0f;
  };
  struct Wanted {
    std::uint32_t block, thick, thin;
    float nearest, farthest;  ///< depths of its box, mm
  };
  void fill_block(Block& block);
  std::vector<Wanted> wanted(const BlockView& view, BlockChoice& choice) const;
  void take(const Wanted& one, double share, std::span<const std::uint8_t> shown,
            std::vector<DrawnSegment>& segments, BlockChoice& choice) const;
  void take_seen(const std::vector<Wanted>& all, double share, const BlockView& view,
                 std::span<const std::uint8_t> shown, std::vector<DrawnSegment>& segments,
                 BlockChoice& choice) const;
  Vec3 centre_ = Vec3::Zero(), low_ = Vec3::Zero(), high_ = Vec3::Zero();
  std::vector<DrawnSegment> segments_;
  std::vector<std::int32_t> place_;  ///< of each edge in segments_; -1: none
  std::vector<Block> blocks_;
};

}  // namespace ostia::geometry
