// The picture of docs/methods/reformations.md: a vessel of a data set straightened and stretched, with the
// twins.
//   reformation_picture DATASET_FOLDER VESSEL_FOLDER OUTPUT.png

#include "dataset.h"
#include "picture.h"

#include "ostia/figure/slice_figure.h"

#include <cmath>
#include <filesystem>

namespace {

using namespace ostia;

figure::Picture panel(const imaging::ImageVolume& image, const reformat::CurvedReformation& view,
                      const std::string& title) {
  const reformat::CurvedOptions& o = view.options();
  figure::SliceFigureOptions how;
  how.title = title;
  how.patient_letters = false;
  how.plane_name = false;
  how.image_width_px = static_cast<int>(std::lround(o.width * o.pixel_mm * 6.0));
  return figure::slice_figure(bench::flattened(image, view), {}, {}, how);
}

void make(const std::filesystem::path& dataset, const std::string& vessel, const std::filesystem::path& out) {
  const imaging::ImageVolume image = bench::image_of(dataset);
  const auto axis = bench::axis_of(dataset, vessel);
  reformat::CurvedOptions o;
  o.pixel_mm = 0.25;
  o.s_start_mm = -4.0;
  o.width = 112;
  o.height = static_cast<int>((axis->length() + 8.0) / o.pixel_mm);
  const reformat::CurvedReformation straightened(axis, o);
  o.mode = reformat::CurvedMode::stretched;
  o.width = 240;
  const reformat::CurvedReformation stretched(axis, o);
  reformat::CurvedOptions thick = stretched.options();
  thick.slab = reformat::Slab::maximum;
  thick.slab_mm = 5.0;
  figure::GridOptions grid;
  grid.columns = 5;
  grid.letters = true;
  grid.title = "y: mm along the vessel (a, b) or its projection (c, d, e); x: mm across";
  figure::grid({panel(image, straightened, "straightened"), panel(image, straightened.twin(), "its twin"),
                panel(image, stretched, "stretched"), panel(image, stretched.twin(), "its twin"),
                panel(image, reformat::CurvedReformation(axis, thick), "stretched, maximum of 5 mm")},
               grid)
      .write_png(out);
}

}  // namespace

int main(int argc, char** argv) {
  return ostia::bench::make_picture(
      argc, argv, "DATASET_FOLDER VESSEL_FOLDER OUTPUT.png", 3,
      [](const std::vector<std::string>& given) { make(given[0], given[1], given[2]); });
}
