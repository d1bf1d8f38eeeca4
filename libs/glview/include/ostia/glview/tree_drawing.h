#pragma once
/// \file A vessel tree of up to millions of segments, drawn by OpenGL. See docs/methods/huge-trees.md.

#include "ostia/geometry/segment_blocks.h"
#include "ostia/glview/tree_camera.h"

#include <cstdint>
#include <memory>
#include <span>

namespace ostia::glview {

/// Each segment is a strip that faces the eye, shaded as the cone with round ends that it stands for and
/// never thinner than a pixel; of those that are, as many as the picture needs (SegmentBlocks::choose). The
/// same OpenGL context, 3.3 or later, is current in all of this, the destructor too.
class TreeDrawing {
 public:
  /// Throws NumericalError with the driver's message where it does not take the shaders.
  explicit TreeDrawing(std::shared_ptr<const geometry::SegmentBlocks> blocks);
  ~TreeDrawing();
  TreeDrawing(const TreeDrawing&) = delete;
  TreeDrawing& operator=(const TreeDrawing&) = delete;
  /// Into the viewport, whose depths it uses; colours and depths are to be cleared before. `shown` as in
  /// SegmentBlocks::choose; `highlight` is drawn thicker, in yellow, however small it is; -1: none.
  void draw(const TreeCamera& eye, double pixel_ratio, std::span<const std::uint8_t> shown,
            std::int32_t highlight);
  const geometry::BlockChoice& choice() const;  ///< of the last picture
  /// Segments in a picture, but for thick ones, of which none is left out.
  static constexpr std::size_t most_segments = 170000;
  void set_most(std::size_t segments);  ///< or SegmentBlocks::everything

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ostia::glview
