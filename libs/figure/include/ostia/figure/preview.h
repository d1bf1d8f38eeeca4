#pragma once
/// \file Small pictures of values as a notebook shows them: made in a fraction of a second, and small as
/// files.

#include "ostia/core/task_context.h"
#include "ostia/figure/picture.h"
#include "ostia/geometry/axis_curve.h"
#include "ostia/geometry/mixed_mesh.h"
#include "ostia/geometry/tri_mesh.h"
#include "ostia/geometry/vessel_tree.h"
#include "ostia/imaging/volume.h"

#include <memory>
#include <string>
#include <vector>

namespace ostia::figure {

// All throw InvalidInput for what has nothing to be seen, and as what they are drawn by does.

/// Shaded, from the side on which most of it is seen, with a scale.
Picture surface_preview(const geometry::TriMesh& surface);
/// Its boundary, with the elements' edges where they can be told apart.
Picture mesh_preview(const geometry::MixedMesh& mesh);
/// Axes as tubes of their radius, one colour a vessel, with names.
Picture tree_preview(const geometry::VesselTree& tree);
/// The same of what is no tree: vessels that begin where their walls do.
struct NamedTube {
  std::string name;
  std::vector<geometry::Vec3> points;
  std::vector<double> radius_mm;  ///< one a point, > 0
};
Picture tube_preview(const std::vector<NamedTube>& tubes);

/// The middle axial, coronal and sagittal planes of voxels side by side: a CT at level 250 and window 900 HU,
/// other values from the least to the largest that is seen.
Picture volume_preview(const imaging::ImageVolume& image);
Picture volume_preview(const imaging::MaskVolume& mask);
Picture volume_preview(const imaging::FloatVolume& values);

/// The image along a vessel, straightened, at `theta_deg` and at right angles to it.
struct VesselView {
  std::shared_ptr<const geometry::AxisCurve> axis;
  std::string name;
  double theta_deg = 0.0;
};
Picture vessel_preview(const imaging::ImageVolume& image, const VesselView& view,
                       const core::TaskContext& task = core::no_task());

}  // namespace ostia::figure
