#pragma once
/// \file A phantom's data set as pictures need it: its image, a vessel's true axis, views as flat pictures.

#include "ostia/core/error.h"
#include "ostia/geometry/axis_curve.h"
#include "ostia/imaging/image_file.h"
#include "ostia/io/rotterdam_file.h"
#include "ostia/reformat/curved_reformation.h"
#include "ostia/reformat/plane_image.h"

#include <filesystem>
#include <memory>

namespace ostia::bench {

inline imaging::ImageVolume image_of(const std::filesystem::path& dataset) {
  for (const auto& entry : std::filesystem::directory_iterator(dataset))
    if (entry.path().extension() == ".nrrd" && entry.path().stem().string().rfind("image", 0) == 0)
      return imaging::read_image(entry.path()).volume;
  throw InvalidInput("no image*.nrrd in " + dataset.string());
}

inline std::shared_ptr<const geometry::AxisCurve> axis_of(const std::filesystem::path& dataset,
                                                          const std::string& vessel) {
  const io::RotterdamReference reference =
      io::without_repeated(io::read_rotterdam_reference(dataset / vessel / "reference.txt"));
  geometry::Centerline dense;
  dense.points = reference.points;
  dense.radius = reference.radius;
  geometry::complete(dense);
  return std::make_shared<const geometry::AxisCurve>(geometry::resample(dense, 0.5));
}

/// A view as a flat picture whose rulers read mm from the axis and mm along the vessel.
inline reformat::PlaneImage flattened(const imaging::ImageVolume& image,
                                      const reformat::CurvedReformation& view) {
  const reformat::CurvedOptions& o = view.options();
  reformat::PlaneImage flat;
  flat.plane.pixel_mm = o.pixel_mm;
  flat.plane.width = o.width;
  flat.plane.height = o.height;
  flat.plane.origin = geometry::Vec3(-0.5 * o.width * o.pixel_mm, o.s_start_mm, 0.0);
  flat.values = reformat::reformatted(image, view, imaging::Interpolation::cubic).values;
  return flat;
}

}  // namespace ostia::bench
