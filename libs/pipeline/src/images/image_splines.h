#pragma once
/// \file A template brought from its image into another one by ITK's B-splines.

#include "ostia/core/task_context.h"
#include "ostia/geometry/tri_mesh.h"
#include "ostia/imaging/volume.h"
#include "ostia/registration/transform.h"

#include <functional>
#include <memory>
#include <vector>

namespace ostia::pipeline {

/// The template's image is compared with others about the template (registration::register_phases).
class ImageSplines {
 public:
  ImageSplines(const geometry::TriMesh& shape, std::shared_ptr<const imaging::ImageVolume> still);
  /// Where the template's surroundings lie in `image`, from where `start` has its points on. Throws
  /// InvalidInput for images that cannot be compared, Cancelled.
  registration::Transform fitted(const imaging::ImageVolume& image,
                                 const std::function<geometry::Vec3(const geometry::Vec3&)>& start,
                                 const core::TaskContext& task) const;

 private:
  std::vector<geometry::Vec3> points_;  // some of the template's
  std::shared_ptr<const imaging::ImageVolume> still_;
};

}  // namespace ostia::pipeline
