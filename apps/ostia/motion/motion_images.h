#pragma once
/// \file `ostia motion fit --template`: a template's lumen in the images of other phases.

#include "motion/motion_input.h"

#include "ostia/pipeline/motion_images.h"

#include <string>
#include <vector>

namespace ostia::app {

/// Whether these are images, and not surfaces, masks or cases. Throws InvalidInput that names one of each
/// where there are both.
bool are_images(const std::vector<PhaseFile>& files);
/// By content, the voxels of a DICOM series among them.
std::string digest_of(const PhaseFile& one, const core::TaskContext& task);
/// As pipeline::surfaces_from_images, each image read when it is needed.
pipeline::ImagePhases phases_in_images(const std::vector<PhaseFile>& files, const geometry::TriMesh& shape,
                                       const pipeline::ImagePhasesOptions& options,
                                       const core::TaskContext& task);
/// Puts `shape` in the place of the surface at its phase. Throws InvalidInput where it has no triangles.
void put_template(geometry::TriMesh shape, double phase, const std::string& name,
                  std::vector<pipeline::PhaseSurface>& phases);

}  // namespace ostia::app
