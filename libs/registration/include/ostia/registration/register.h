#pragma once
/// \file Two scans of one heart laid onto each other by their images.

#include "ostia/core/task_context.h"
#include "ostia/imaging/volume.h"
#include "ostia/registration/landmarks.h"
#include "ostia/registration/transform.h"

#include <cstdint>
#include <string>
#include <vector>

namespace ostia::registration {

/// What is known beforehand.
struct Guidance {
  /// Points on the vessels' axes in the fixed scan, a few mm apart: the image is compared about them. Without
  /// any, all of the fixed scan is.
  std::vector<Vec3> vessels_mm;
  /// Where to begin, from three pairs on; fewer are not used. The image alone decides from there, so that
  /// what is left at them tells how good the result is.
  std::vector<LandmarkPair> landmarks;
};

enum class Likeness {
  mutual_information,  ///< Mattes et al. 2003: contrast and noise may differ
  mean_squares,        ///< for images that differ by motion alone
};

struct RegistrationOptions {
  Likeness likeness = Likeness::mutual_information;
  bool linear = true;             ///< begin with a rigid and an affine map
  double region_mm = 25.0;        ///< how far from the vessels the image is compared; [5, 100]
  double linear_voxel_mm = 3.0;   ///< images of the rigid and the affine map; [1, 10]
  double finest_voxel_mm = 1.5;   ///< images of the last B-spline; [0.5, 5]
  double node_spacing_mm = 12.0;  ///< of the last B-spline's nodes; [4, 100]
  int levels = 3;  ///< B-splines, each with half of the nodes' spacing of the one before; 0: none, up to 5
  std::int64_t samples = 60000;  ///< voxels that are compared; [1000, 1e7]
  double bending_weight = 2e-3;  ///< of the spline's bending against the images' likeness; >= 0
  int iterations = 30;           ///< at most, of each step; [1, 1000]
  bool hounsfield = true;        ///< both images are CT; else their ranges are taken as they are
  double least_jacobian = 0.1;   ///< a B-spline that comes below is made again, stiffer; (0, 1)
};
void validate(const RegistrationOptions& options);

enum class Verdict { good, doubtful, failed };
const char* name_of(Verdict verdict);

struct Quality {
  double landmarks_mean_mm = 0.0, landmarks_max_mm = 0.0;  ///< left at the landmarks; 0 without any
  double jacobian_min = 1.0, jacobian_max = 1.0;  ///< determinants over the region, linear part apart
  /// Mean distance between a point and itself, there with this transformation (before the last refinement)
  /// and back with one that was found from the other scan's side.
  double inverse_consistency_mm = 0.0;
  double correlation_linear = 0.0, correlation = 0.0;      ///< of the images over the region, [-1, 1]
  double overlap = 1.0;                                    ///< share of the region that the moving scan shows
  double vessels_fixed_hu = 0.0, vessels_moving_hu = 0.0;  ///< medians on the axes, 0 without any
  Verdict verdict = Verdict::good;
  std::string reason;  ///< why not good, one sentence; empty when it is
};

struct Registration {
  Transform rigid, affine;  ///< the steps on the way
  Transform transform;
  Quality quality;
};

/// Where the points of the fixed scan lie in the moving one: landmarks, then rigid, affine and B-spline maps
/// from coarse to fine, by ITK's metric of mutual information and its L-BFGS-B, with a penalty on bending.
/// Of CT a B-spline that does not raise the images' correlation is left out, and `transform` is `affine`.
/// The images are cropped to the region and never used at full size. The same bits for any number of threads.
/// Throws InvalidInput for empty images, guidance that is not finite or outside the fixed scan, images
/// without Hounsfield units where `hounsfield`, scans that do not overlap, mirrored landmarks or bad options;
/// Cancelled. A result that is not to be trusted is told by its verdict.
Registration register_scans(const imaging::ImageVolume& fixed, const imaging::ImageVolume& moving,
                            const Guidance& guidance = {}, const RegistrationOptions& options = {},
                            const core::TaskContext& task = core::no_task());

/// What suits two phases of one scan: no linear maps, mean squares, finer nodes.
RegistrationOptions phase_options();
/// register_scans with options for phases.
Registration register_phases(const imaging::ImageVolume& fixed, const imaging::ImageVolume& moving,
                             const Guidance& guidance = {},
                             const RegistrationOptions& options = phase_options(),
                             const core::TaskContext& task = core::no_task());

}  // namespace ostia::registration
