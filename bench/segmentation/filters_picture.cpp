// The picture of docs/methods/filters.md: a slice of a phantom's data set as it is, without bones, and what
// each diffusion makes of a piece of it.
//   filters_picture DATASET_FOLDER VESSEL_FOLDER OUTPUT.png

#include "dataset.h"
#include "picture.h"

#include "ostia/figure/slice_figure.h"
#include "ostia/imaging/diffusion.h"
#include "ostia/segmentation/tissue_removal.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

namespace {

using namespace ostia;
using geometry::Vec3;

figure::Picture panel(const imaging::ImageVolume& image, const Vec3& at, const std::string& title) {
  figure::SliceFigureOptions how;
  how.title = title;
  how.level_hu = 200.0;
  how.window_hu = 900.0;
  how.image_width_px = 380;
  how.rulers = false;
  how.patient_letters = false;
  how.plane_name = false;
  return figure::slice_figure(
      reformat::slice(image, reformat::axial_plane(image.geometry, at), imaging::Interpolation::nearest), {},
      {}, how);
}

/// A box of `side_mm` about a point.
imaging::ImageVolume piece(const imaging::ImageVolume& image, const Vec3& at, double side_mm) {
  imaging::Region region;
  const Vec3 index = image.geometry.index(at);
  for (int d = 0; d < 3; ++d) {
    const auto axis = static_cast<std::size_t>(d);
    const auto half = static_cast<std::int64_t>(0.5 * side_mm / image.geometry.spacing[d]);
    region.lower[axis] = std::max<std::int64_t>(std::llround(index[d]) - half, 0);
    region.upper[axis] = std::min<std::int64_t>(std::llround(index[d]) + half, image.geometry.size[axis]);
  }
  return imaging::cropped(image, region);
}

void make(const std::filesystem::path& dataset, const std::string& vessel, const std::filesystem::path& out) {
  const imaging::ImageVolume image = bench::image_of(dataset);
  const auto axis = bench::axis_of(dataset, vessel);
  const Vec3 at = axis->point(20.0);
  segmentation::TissueOptions bone;
  bone.bone = true;
  const imaging::ImageVolume without =
      segmentation::without_tissues(image, segmentation::tissues_to_remove(image, {at}, bone), bone.fill_hu);
  const imaging::ImageVolume small = piece(image, at, 30.0);
  const auto smoothed = [&](imaging::Diffusion method) {
    imaging::DiffusionOptions options;
    options.method = method;
    return imaging::diffused(small, options);
  };
  figure::GridOptions grid;
  grid.columns = 3;
  grid.title = "Removal of bones, and diffusion that stops at edges";
  figure::grid({panel(image, at, "the image"), panel(without, at, "without bones"),
                panel(small, at, "30 mm of it"), panel(smoothed(imaging::Diffusion::flux), at, "flux"),
                panel(smoothed(imaging::Diffusion::gradient), at, "gradient"),
                panel(smoothed(imaging::Diffusion::curvature), at, "curvature")},
               grid)
      .write_png(out);
}

}  // namespace

int main(int argc, char** argv) {
  return ostia::bench::make_picture(
      argc, argv, "DATASET_FOLDER VESSEL_FOLDER OUTPUT.png", 3,
      [](const std::vector<std::string>& given) { make(given[0], given[1], given[2]); });
}
