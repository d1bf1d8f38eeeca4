#pragma once
/// \file What a scale of the vesselness is: which ball or Gaussian belongs to a tube's radius, and how the
/// answer of an ideal tube depends on its radius.

#include "ostia/geometry/vec.h"
#include "ostia/segmentation/vesselness.h"

#include <cstddef>
#include <vector>

namespace ostia::segmentation::detail {

struct TubeScale {
  double radius_mm = 0.0;  ///< of the tube that this scale answers most to, with its contrast
  double ball_mm = 0.0;    ///< flux: the sphere's radius
  double sigma_mm = 0.0;   ///< of the Gaussian (under the sphere)
  double factor = 0.0;     ///< second derivatives of the ball's mean or of the blurred image to HU
};

/// The scales for the radii of `options`, ascending, and the corrections for what lies between them.
class TubeScales {
 public:
  TubeScales(const VesselnessOptions& options, const geometry::Vec3& spacing_mm);

  const std::vector<TubeScale>& list() const { return scales_; }

  struct Peak {
    float response = 0.0F;
    float radius_mm = 0.0F;
  };
  /// From the answers of all scales, `stride` apart: the largest, a parabola over log radius through it and
  /// its neighbours (at the ends the one neighbour's share), and what that is off by for an ideal tube.
  Peak peak(const float* answers, std::ptrdiff_t stride) const;

 private:
  struct Parabola {
    float step[2];     // log radius to the neighbours below and above
    float log_radius;  // of the scale
  };
  struct Raw {
    float response = 0.0F;
    float log_radius = 0.0F;
  };
  struct Measured {  // of an ideal tube: the log radius that `raw_peak` says, and what is
    float said;
    Peak is;  // the response: of unit contrast, over what was said
  };
  double ideal(const TubeScale& scale, double tube_mm) const;  // answer to a tube of unit contrast
  void add_correction();
  void tabulate(const std::vector<Measured>& measured);
  Raw raw_peak(const float* answers, std::ptrdiff_t stride) const;

  TubeMethod method_;
  double blur_mm_ = 0.0;  // all of it, under the sphere
  std::vector<TubeScale> scales_;
  std::vector<Parabola> parabolas_;
  float end_ratio_[2] = {0.0F, 0.0F};  // neighbour's answer over their own, of the first and the last scale
  float first_said_ = 0.0F, steps_per_log_ = 0.0F;
  std::vector<Peak> corrections_;  // from first_said_ on
};

/// Second derivative across an ideal tube of unit contrast, with the sign turned, times the sphere's radius /
/// 3: the flux through a sphere about its axis, for a disc of `tube_mm` blurred by `blur_mm`. 1/mm.
double flux_of_tube(double ball_mm, double tube_mm, double blur_mm);

}  // namespace ostia::segmentation::detail
