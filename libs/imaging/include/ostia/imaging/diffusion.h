#pragma once
/// \file Smoothing that stops at edges.

#include "ostia/core/task_context.h"
#include "ostia/imaging/volume.h"

namespace ostia::imaging {

/// What flows where. u is the image, k the contrast of the options.
enum class Diffusion {
  /// u_t = div(D grad u) + beta (u0 - u), after K. Krissian (IEEE Trans. Med. Imaging 21:1440-1442, 2002):
  /// where the image is flat D is 1, on an edge nothing flows but along the direction in which the edge's
  /// surface is curved least, i.e. along a vessel: D = g + (1 - g) e e', g = exp(-|grad u_s|^2 / k^2). g and
  /// e
  /// are those of u_s, the image blurred by one voxel.
  flux,
  /// u_t = div(c grad u), c = exp(-|grad u|^2 / (2 k^2)) (P. Perona and J. Malik, IEEE Trans. Pattern Anal.
  /// Mach. Intell. 12:629-639, 1990), c and differences taken between the voxels as in ITK's
  /// GradientAnisotropicDiffusionImageFilter, whose k is its conductance times the root mean square gradient.
  gradient,
  /// u_t = |grad u| div(c grad u / |grad u|): level sets move by their curvature, weighted by c (R. Whitaker
  /// and X. Xue, ICIP 2001), with the differences of ITK's CurvatureAnisotropicDiffusionImageFilter.
  curvature
};

struct DiffusionOptions {
  Diffusion method = Diffusion::flux;
  int iterations = 5;  ///< in [0, 1000]
  /// k: edges steeper than this stay, HU/mm, >= 0; 0: chosen from the noise (`diffusion_contrast`).
  double contrast_hu_per_mm = 0.0;
  double attachment = 0.05;  ///< beta of `flux`, in [0, 1]: keeps the image near the one it began with
  double step = 0.75;        ///< part of the longest stable step, 1 / (2 sum 1/h^2), in (0, 1]; half of
                             ///< that for `curvature`
};
/// Throws InvalidInput that names the option.
void validate(const DiffusionOptions& options);

/// The contrast that is used where none is given: three times the noise of one component of the gradient on
/// which the method's diffusivity is read. That noise is the gradient's median over 1.538, as in an image
/// whose most part is flat; voxels with the image's least value (padding) do not count. At least 1 HU/mm.
double diffusion_contrast(const FloatVolume& image, Diffusion method,
                          const core::TaskContext& task = core::no_task());

/// The image after `iterations` explicit steps; nothing flows through its border; spacings are those of the
/// axes. The same bits for any number of threads. Needs five times the image's memory in floats. Throws
/// InvalidInput (options; values that are not finite), Cancelled.
FloatVolume diffused(const FloatVolume& image, const DiffusionOptions& options = {},
                     const core::TaskContext& task = core::no_task());
/// The same of a CT, rounded to whole HU.
ImageVolume diffused(const ImageVolume& image, const DiffusionOptions& options = {},
                     const core::TaskContext& task = core::no_task());

}  // namespace ostia::imaging
