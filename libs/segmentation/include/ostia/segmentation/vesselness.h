#pragma once
/// \file How much a voxel looks like the middle of a bright tube, how wide that tube is, and where it runs.

#include "ostia/core/task_context.h"
#include "ostia/imaging/volume.h"

#include <array>
#include <optional>
#include <vector>

namespace ostia::segmentation {

/// Whose eigenvalues tell a tube from a plate and a blob.
enum class TubeMethod {
  flux,  ///< the gradient's flux through a sphere (optimally oriented flux; M. W. K. Law and A. C. S. Chung,
         ///< Three dimensional curvilinear structure detection using optimally oriented flux, ECCV 2008)
  hessian  ///< second derivatives of Gaussians (Y. Sato et al., Med. Image Anal. 2:143-168, 1998;
           ///< A. F. Frangi et al., MICCAI 1998)
};

enum class TubeAxes { none, computed };

struct VesselnessOptions {
  TubeMethod method = TubeMethod::flux;
  /// Radii of the tubes looked for, ascending, each in [0.2, 10] mm, 1 to 16 of them.
  std::vector<double> radii_mm{0.75, 1.06, 1.5, 2.12, 3.0};
  /// The scanner's point spread (standard deviation), [0, 1.5] mm: radii are those of the tube before it.
  double image_blur_mm = 0.3;
  /// Flux: standard deviation of the Gaussian under the sphere, in voxels (the geometric mean of the
  /// spacing), [0.5, 3]. More of it bears more noise and leaks further into a neighbour.
  double flux_blur_voxels = 0.7;
  /// Part of a tube's strength that darkness in its middle along its own axis takes away (alpha of Sato et
  /// al. 1998, section 2.2), [0, 1].
  double gap_weight = 0.25;
  /// Intensities are cut to these before anything else: a ceiling above the lumen's keeps calcium from being
  /// the brightest tube, a floor below the fat's keeps lung from being the darkest wall. least < most.
  double least_hu = -32768.0;
  double most_hu = 32767.0;
  TubeAxes axes = TubeAxes::none;
};
/// Throws InvalidInput for a value outside its range.
void validate(const VesselnessOptions& options);

/// Where the answer is wanted; the image beside it is used all the same.
struct VesselnessPlace {
  std::optional<imaging::Region> region = std::nullopt;  ///< all of the image when absent
  /// Nonzero where an answer is wanted, on the grid of the image or of the region; everywhere when null. The
  /// cost goes with the voxels it names, and with how scattered they are.
  const imaging::MaskVolume* mask = nullptr;
};

/// On the grid of the region, x fastest; 0 where the mask is 0 and where nothing is brighter than its
/// surroundings.
struct Vesselness {
  /// Contrast, in HU, of the ideal tube that would answer so in its axis: a straight round tube C HU brighter
  /// than its surroundings has C on its axis, whatever its radius (within the radii looked for).
  imaging::FloatVolume response_hu;
  /// Radius of that tube; between the radii looked for by interpolation, never beyond the first and the last.
  imaging::FloatVolume radius_mm;
  /// Unit vectors along the tube (LPS; either sign), one a voxel; empty unless asked for.
  std::vector<std::array<float, 3>> axis;
  /// The radii looked for: those that the voxels and the blur can tell apart. What was asked for below the
  /// least of them is looked for there, once.
  std::vector<double> radii_mm;
};

/// Tube-likeness at several scales.
///
/// A symmetric 3 x 3 matrix is made of the image about each voxel at each scale, whose eigenvalues
/// l1 <= l2 <= l3 are second derivatives across and along a tube. The answer of a scale is
/// -l2 + min(l3, -gap_weight l3), or 0: l2 is 0 in a plate, all three are alike in a blob, and l3 is 0 along
/// a tube (Sato et al. 1998, with both exponents 1: linear in HU). Its eigenvector is the axis. The result is
/// the largest over the scales, interpolated between them.
///
/// hessian: of the image blurred to a variance of t = R^2 / 2 (image_blur_mm included), times e t. For a tube
/// of radius R that has l1 = l2 = -R^2 / (2 t^2) exp(-R^2 / 2 t) times its contrast, no other scale or radius
/// answers more.
/// flux: of the mean over a ball of radius r of the image blurred by flux_blur_voxels, times r / 3: the flux
/// of its gradient through the sphere over the sphere's area (the divergence theorem; Law and Chung 2008, eq.
/// 3). r is such that, among tubes of equal contrast, that of radius R answers most; its answer is the unit.
///
/// Beyond the image its border is repeated. Spacing enters each derivative, ball and Gaussian; directions are
/// in world space. Memory: 2 floats a voxel of the region (5 with axes) and, for the radii by default in
/// voxels of 0.4 mm, less than 25 MiB a thread (less than 120 in any case). The same bits for any number of
/// threads, any mask and any region. Throws InvalidInput for options out of range, a region that is empty or
/// not inside the image, a mask on another grid, an image without voxels or with bad spacing, and radii that
/// reach over more than 64 voxels; Cancelled.
Vesselness vesselness(const imaging::ImageVolume& image, const VesselnessPlace& place = {},
                      const VesselnessOptions& options = {}, const core::TaskContext& task = core::no_task());

}  // namespace ostia::segmentation
