#include "images/image_splines.h"

#include "ostia/registration/register.h"

#include <string>
#include <utility>

namespace ostia::pipeline {

using geometry::Vec3;

namespace {

// Of the template's points: the image is compared 25 mm about each, so that few do.
constexpr std::size_t most_guides = 2000;
constexpr std::size_t most_landmarks = 60;

std::size_t every_of(std::size_t count, std::size_t most) {
  return (count + most - 1) / most;
}

}  // namespace

ImageSplines::ImageSplines(const geometry::TriMesh& shape, std::shared_ptr<const imaging::ImageVolume> still)
    : still_(std::move(still)) {
  for (std::size_t i = 0; i < shape.points.size(); i += every_of(shape.points.size(), most_guides))
    points_.push_back(shape.points[i]);
}

registration::Transform ImageSplines::fitted(const imaging::ImageVolume& image,
                                             const std::function<Vec3(const Vec3&)>& start,
                                             const core::TaskContext& task) const {
  registration::Guidance guidance;
  guidance.vessels_mm = points_;
  for (std::size_t i = 0; i < points_.size(); i += every_of(points_.size(), most_landmarks))
    guidance.landmarks.push_back({std::to_string(i), points_[i], start(points_[i])});
  return registration::register_phases(*still_, image, guidance, registration::phase_options(), task)
      .transform;
}

}  // namespace ostia::pipeline
