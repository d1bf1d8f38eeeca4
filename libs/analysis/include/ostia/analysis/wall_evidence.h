#pragma once
/// \file What an image shows of a vessel's wall, section by section (docs/methods/evaluability.md).

#include "ostia/core/task_context.h"
#include "ostia/geometry/axis_curve.h"
#include "ostia/imaging/volume.h"

#include <functional>
#include <vector>

namespace ostia::analysis {

/// A section's ring of rays. Figures are of the image at the wall as it is modelled, wherever that came from.
struct WallEvidence {
  double s_mm = 0.0;
  bool in_image = true;        ///< the whole ring; all that follows is 0 where it is not
  double calibre_mm = 0.0;     ///< diameter of the circle with the lumen's area
  double lumen_hu = 0.0;       ///< median of the inner half
  double contrast_hu = 0.0;    ///< lumen less what surrounds it (median of the rays, calcium left out)
  double clear_share = 0.0;    ///< of the rays without calcium: the brightness falls where the wall is
  double calcium_share = 0.0;  ///< of all rays: what lies behind the wall outshines the lumen
  /// Deviation of the Gaussian that the least sharp quarter of the edge looks blurred by: the scanner's own,
  /// and motion on top of it. 0 where no edge is clear enough to tell.
  double blur_mm = 0.0;
};

struct WallEvidenceOptions {
  double step_mm = 0.5;    ///< between sections, [0.1, 5]
  int around = 32;         ///< rays of a section, a multiple of 8 in [16, 128]
  double noise_hu = 25.0;  ///< of the image (imaging::noise_level_hu), [0, 500]
};
void validate(const WallEvidenceOptions& options);  ///< throws InvalidInput

/// The modelled wall: its distance from the axis at an abscissa and an angle (geometry::radial_direction); at
/// 0.1 mm and below the lumen counts as shut. Asked from several threads.
using WallRadius = std::function<double(double s_mm, double theta)>;

/// Sections at equal steps, ends included. Where the lumen is shut, contrast and edge are 0 and calcium is
/// looked for about the axis. Deterministic, the same for any number of threads. Throws InvalidInput for bad
/// options or a stretch that the axis has not, Cancelled.
std::vector<WallEvidence> wall_evidence(const imaging::ImageVolume& image, const geometry::AxisCurve& axis,
                                        const WallRadius& wall_mm, double from_mm, double to_mm,
                                        const WallEvidenceOptions& options = {},
                                        const core::TaskContext& task = core::no_task());

}  // namespace ostia::analysis
