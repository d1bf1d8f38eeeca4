#pragma once
/// \file A cage about a template brought from the template's image into another one, by the images' values.

#include "ostia/core/task_context.h"
#include "ostia/geometry/cage.h"
#include "ostia/geometry/tri_mesh.h"
#include "ostia/imaging/volume.h"

#include <vector>

namespace ostia::pipeline {

/// The part of an image about a box (LPS, mm) as float; empty where they do not meet.
imaging::FloatVolume part_about(const imaging::ImageVolume& image, const geometry::Box3& box,
                                double margin_mm);

/// Where images are compared while a cage of one depth moves.
struct ImageCageLevel {
  int depth = 0;
  double sigma_mm = 0.0;
  std::vector<geometry::Vec3> places;         ///< in the template's image
  std::vector<double> values;                 ///< there
  std::vector<geometry::CagePoint> fine;      ///< in the whole grid
  std::vector<geometry::CagePoint> own;       ///< in this level's grid
  std::vector<std::vector<std::int32_t>> of;  ///< places of each cell of this level's grid
};

struct ImageCageFit {
  std::vector<geometry::Vec3> control_points;  ///< of the whole grid
  double likeness = 0.0;                       ///< correlation of the values about the wall
  double inside_share = 0.0;                   ///< of the template's points, within the image
};

/// What is compared: places about the template's wall, and the values of its own image there, blurred as each
/// level asks for.
class ImageCage {
 public:
  ImageCage(const geometry::TriMesh& shape, const imaging::ImageVolume& still, int depth, double margin,
            const core::TaskContext& task);
  const geometry::CageGrid& grid() const { return grids_.back(); }
  /// The control points, from the better of `starts` on, at which `image` is most like the template's.
  ImageCageFit fitted(const imaging::ImageVolume& image,
                      const std::vector<std::vector<geometry::Vec3>>& starts,
                      const core::TaskContext& task) const;
  /// How like the template's `image` is with these control points.
  ImageCageFit judged(const imaging::ImageVolume& image, std::vector<geometry::Vec3> control_points,
                      const core::TaskContext& task) const;

 private:
  std::vector<geometry::Vec3> carried_points(const std::vector<geometry::Vec3>& control_points) const;
  std::vector<geometry::CageGrid> grids_;  ///< of depth 0, 1, ...
  std::vector<ImageCageLevel> levels_;
  std::vector<geometry::Vec3> points_;  ///< some of the template's
};

}  // namespace ostia::pipeline
