#pragma once
/// \file The vesselness of one brick of the image, worked out in buffers of its own.

#include "vesselness/tube_loops.h"
#include "vesselness/tube_scales.h"

#include "ostia/imaging/volume.h"
#include "ostia/segmentation/vesselness.h"

#include <array>
#include <cstdint>
#include <vector>

namespace ostia::segmentation::detail {

using Index = std::array<std::int64_t, 3>;

/// The voxels [lower, upper) of an axis-parallel box.
struct Box {
  Index lower{0, 0, 0}, upper{0, 0, 0};
};

/// A part of a ball along x: weight on the voxels -reach .. reach of the row y voxels beside.
struct BallRun {
  std::int64_t y = 0, reach = 0;
  float weight = 0.0F;
};

/// The same for all bricks of a call.
struct TubePlan {
  TubePlan(const imaging::ImageVolume& image, const VesselnessOptions& options);

  struct Scale {
    std::array<std::vector<float>, 3> blur;  // hessian: weights from the centre on, along x, y, z
    std::vector<std::vector<BallRun>> ball;  // flux: of the planes 0, +-1, +-2 .. along z; all weights' sum 1
    std::array<float, 3> pure{}, mixed{};    // see TubeRow
  };

  const imaging::ImageVolume& image;
  const VesselnessOptions& options;
  TubeScales scales;
  std::vector<Scale> per_scale;
  std::array<std::vector<float>, 3> blur;  // flux: under the sphere
  Index reach{};                           // voxels read beside the brick
};

/// Floats with x fastest, rows `pitch` apart, and room for whole packs.
struct Block {
  Index size{};
  std::int64_t pitch = 0;
  std::vector<float> values;

  void shape(const Index& new_size);
  float* row(std::int64_t y, std::int64_t z) { return values.data() + pitch * (y + size[1] * z); }
  std::int64_t plane() const { return pitch * size[1]; }
};

/// Works bricks out, one after the other. Not for several threads at once.
class TubeBrick {
 public:
  explicit TubeBrick(const TubePlan& plan) : plan_(plan) {}

  static constexpr std::int64_t kLength = 60;  ///< of a brick along x: with the margins whole packs

  /// A brick of kLength voxels along x, from a multiple of that on: the same bits then whatever the region.
  /// It may reach beyond the image. `wanted` has a byte a voxel of it, x fastest.
  void work_out(const Box& box, const std::vector<std::uint8_t>& wanted, const core::TaskContext& task);

  /// Of the last brick, at a voxel counted from its lower corner: only where it was wanted.
  TubeScales::Peak peak(std::int64_t x, std::int64_t y, std::int64_t z) const;
  std::array<float, 3> axis(std::int64_t x, std::int64_t y, std::int64_t z) const;

 private:
  struct Span {
    std::int64_t lower = 0, upper = 0;
    bool empty() const { return lower >= upper; }
  };

  void find_spans(const std::vector<std::uint8_t>& wanted);
  void gather();
  void blur(Block& in, Block& out, int axis, const std::vector<float>& weights, Box& box);
  void sum_rows(const Box& box);
  void ball_means(const TubePlan::Scale& scale);
  void ball_means_of_plane(const TubePlan::Scale& scale, std::int64_t z);
  void gaussian(const TubePlan::Scale& scale);
  void answers(const TubePlan::Scale& scale, std::size_t number);
  Span& span(std::int64_t y, std::int64_t z) { return spans_[static_cast<std::size_t>(y + size_[1] * z)]; }
  Span around(std::int64_t y, std::int64_t z);
  std::ptrdiff_t place(std::int64_t x, std::int64_t y, std::int64_t z) const {
    return x + kPitch * (y + size_[1] * z);
  }

  static constexpr std::int64_t kPitch = kLength + 8;

  const TubePlan& plan_;
  Box box_;
  Index size_{};
  std::vector<Span> spans_;   // of the brick's rows: what is wanted
  std::vector<Span> around_;  // of the rows with two more on each side
  Block source_, first_,
      second_;                  // the image, and what the passes make of it, with the reach about the brick
  Block field_;                 // of one scale, with two voxels about the brick
  std::vector<float> answers_;  // scale by scale
  std::vector<float> best_, axis_[3];
  Block plane_;  // the running sums of two planes, added
  std::vector<std::vector<RunTap>> taps_;
};

}  // namespace ostia::segmentation::detail
