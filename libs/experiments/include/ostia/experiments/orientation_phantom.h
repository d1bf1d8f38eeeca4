#pragma once
/// \file The phantom of [Luboz] 3 as straight pieces of tube, and a scanner that looks at it from all sides.

#include "ostia/core/task_context.h"
#include "ostia/geometry/vec.h"
#include "ostia/imaging/volume.h"

#include <cstdint>
#include <string>
#include <vector>

namespace ostia::experiments {

using geometry::Mat3;
using geometry::Vec3;

/// A straight tube. Where another one begins or ends at the same place the two are joined; a free end is
/// flat.
struct PhantomTube {
  std::string name;
  Vec3 from = Vec3::Zero(), to = Vec3::Zero();  ///< of its axis, mm
  double radius_mm = 0.0;
  double length_mm() const { return (to - from).norm(); }
};

/// 17 tubes of radii 0.78 to 2.34 mm: a ring of six, three stems into it, three vessels out of it of which
/// two fork, and a tube on its own. The paper gives number and radii; the layout is ours.
std::vector<PhantomTube> vascular_phantom();

/// How the phantom lies in the scanner: turned about the origin.
struct Orientation {
  std::string name;  ///< "X45 Y90": about x by 45, then about y by 90 degrees
  Mat3 turn = Mat3::Identity();
};
/// Twelve, by turns of 45 and 90 degrees about one axis or several ([Luboz] 3).
std::vector<Orientation> twelve_orientations();

struct TubeScanOptions {
  Vec3 spacing_mm{0.6, 0.6, 1.25};
  double psf_fwhm_mm = 0.7, psf_fwhm_z_mm = 1.25;  ///< the slices are as thick as they are apart
  double lumen_hu = 1276.0;                        ///< 2300 as the paper's scanner stores it, 1024 more
  double gel_hu = 150.0;                           ///< silicone; an assumption
  double noise_hu = 25.0;
  double margin_mm = 8.0;  ///< about the tubes
  std::uint64_t seed = 1;
};
void validate(const TubeScanOptions& options);  ///< throws InvalidInput

/// A CT of the turned tubes. The same bits for any number of threads. Throws InvalidInput (no tube, options),
/// Cancelled.
imaging::ImageVolume scan_of(const std::vector<PhantomTube>& tubes, const Orientation& orientation,
                             const TubeScanOptions& options = {},
                             const core::TaskContext& task = core::no_task());

}  // namespace ostia::experiments
