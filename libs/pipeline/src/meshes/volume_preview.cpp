#include "ostia/pipeline/volume_preview.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"
#include "ostia/figure/slice_figure.h"
#include "ostia/reformat/plane_image.h"

#include <algorithm>
#include <string>

namespace ostia::pipeline {
namespace fs = std::filesystem;
namespace {

using geometry::Vec3;

Vec3 centre_of(const imaging::Geometry& grid) {
  return grid.world(Vec3(static_cast<double>(grid.size[0] - 1), static_cast<double>(grid.size[1] - 1),
                         static_cast<double>(grid.size[2] - 1)) /
                    2.0);
}

}  // namespace

std::vector<std::string> write_preview(const imaging::ImageVolume& image, const fs::path& folder,
                                       const PreviewOptions& options) {
  if (options.axial_slices < 0 || options.axial_slices > 100)
    throw InvalidInput("--preview-slices must lie in [0, 100]");
  const Vec3 centre = options.position.value_or(centre_of(image.geometry));
  if (!image.geometry.contains(centre)) throw InvalidInput("the preview's position lies outside the image");
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw IoError("cannot make the folder " + folder.string() + ": " + error.message());
  figure::SliceFigureOptions look;
  look.level_hu = options.level_hu;
  look.window_hu = options.window_hu;
  std::vector<std::string> names{"planes.png"};
  figure::three_planes(image, centre, {}, {}, look).write_png(folder / names[0]);

  const Vec3 first = image.geometry.world(Vec3::Zero());
  const Vec3 last = image.geometry.world(Vec3(static_cast<double>(image.geometry.size[0] - 1),
                                              static_cast<double>(image.geometry.size[1] - 1),
                                              static_cast<double>(image.geometry.size[2] - 1)));
  const double low = std::min(first.z(), last.z()), high = std::max(first.z(), last.z());
  for (int i = 0; i < options.axial_slices; ++i) {
    const double z = low + (high - low) * (i + 0.5) / options.axial_slices;
    look.title = "axial, z = " + core::rounded_text(z, 0) + " mm";
    const auto plane = reformat::axial_plane(image.geometry, Vec3(centre.x(), centre.y(), z));
    std::string number = std::to_string(i + 1);
    number.insert(0, 3 - number.size(), '0');
    names.push_back("axial-" + number + ".png");
    figure::slice_figure(reformat::slice(image, plane), {}, {}, look).write_png(folder / names.back());
  }
  return names;
}

}  // namespace ostia::pipeline
