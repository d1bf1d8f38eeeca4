#pragma once
/// \file A template's lumen found in the images of other phases of the heart. See
/// docs/methods/motion-images.md.

#include "ostia/core/task_context.h"
#include "ostia/imaging/volume.h"
#include "ostia/pipeline/motion_fit.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace ostia::pipeline {

/// The image of one phase, read when it is needed: at most two beside the template's are held at a time.
struct PhaseView {
  double phase = 0.0;  ///< share of the cycle since the R peak, in [0, 1)
  std::string name;    ///< of its file, for messages
  std::function<std::shared_ptr<const imaging::ImageVolume>(const core::TaskContext&)> read;
};

/// What brings the template into another image, before its wall is looked for there.
enum class ImageCarrier {
  cage,      ///< our own: cages from coarse to fine, by the values about the wall
  b_splines  ///< ITK's, by all of the image within 25 mm of the template (registration::register_phases)
};

struct ImagePhasesOptions {
  ImageCarrier carrier = ImageCarrier::cage;
  double template_phase = 0.75;  ///< at which the template is; there must be an image of it
  int depth = 4;                 ///< of the cage, as motion::RegistrationOptions; [1, 5]
  double margin = 0.1;           ///< of the cage, as there
  double least_likeness = 0.5;   ///< below this correlation with the template's image a phase has no vessel
};

/// What an image has shown of the template.
struct ImagePhase {
  double phase = 0.0;
  double likeness = 0.0;       ///< correlation of the values about the wall with the template's, [-1, 1]
  double inside_share = 0.0;   ///< of the template's points that lie within the image
  double wall_shift_mm = 0.0;  ///< mean of how far the wall was moved along its normals in the end
  bool found = false;
};

struct ImagePhases {
  /// As the views, rising: the template's triangles where each image shows its wall, with the cage that
  /// brought them there; without triangles, and with a reason, where the vessel is not seen.
  std::vector<PhaseSurface> surfaces;
  std::vector<ImagePhase> found;
  std::vector<std::string> warnings;
};

/// Carries the template to every phase by its image: outward in time, both ways, each from its neighbour's
/// cage. The values about the template's wall in its own image are looked for in the other's, from blurred
/// to sharp and from coarse cages to fine ones; then each point's wall is moved along its normal to where the
/// profile of intensities is most like the template's. With ITK's B-splines each phase's map begins with the
/// rigid part of its neighbour's. Images may be on any grids of one frame. Throws
/// InvalidInput: a template without triangles, no image of the template's phase, a template that lies
/// outside of it, two views of one phase, fewer than three; Cancelled; what `read` throws. Deterministic.
ImagePhases surfaces_from_images(const geometry::TriMesh& shape, std::vector<PhaseView> views,
                                 const ImagePhasesOptions& options = {},
                                 const core::TaskContext& task = core::no_task());

}  // namespace ostia::pipeline
