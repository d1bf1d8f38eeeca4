// The picture of docs/reformations.md: a vessel of a data set straightened and stretched, with the twins.
//   reformation_picture DATASET_FOLDER VESSEL_FOLDER OUTPUT.png

#include "ostia/core/error.h"
#include "ostia/figure/slice_figure.h"
#include "ostia/geometry/centerline.h"
#include "ostia/imaging/image_file.h"
#include "ostia/io/rotterdam_file.h"
#include "ostia/reformat/curved_reformation.h"

#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>

namespace {

using namespace ostia;
using geometry::Vec2;
using geometry::Vec3;

std::shared_ptr<const geometry::AxisCurve> axis_of(const io::RotterdamReference& reference) {
  geometry::Centerline dense;
  dense.points = reference.points;
  dense.radius = reference.radius;
  geometry::complete(dense);
  return std::make_shared<const geometry::AxisCurve>(geometry::resample(dense, 0.5));
}

/// The view as a flat picture whose rulers read mm from the axis and mm along the vessel.
figure::Picture panel(const imaging::ImageVolume& image, const reformat::CurvedReformation& view,
                      const std::string& title) {
  const reformat::CurvedOptions& o = view.options();
  reformat::PlaneImage flat;
  flat.plane.pixel_mm = o.pixel_mm;
  flat.plane.width = o.width;
  flat.plane.height = o.height;
  flat.plane.origin = Vec3(-0.5 * o.width * o.pixel_mm, o.s_start_mm, 0.0);
  flat.values = reformat::reformatted(image, view, imaging::Interpolation::cubic).values;
  figure::SliceFigureOptions how;
  how.title = title;
  how.patient_letters = false;
  how.plane_name = false;
  how.image_width_px = static_cast<int>(std::lround(o.width * o.pixel_mm * 6.0));
  return figure::slice_figure(flat, {}, {}, how);
}

void make(const std::filesystem::path& dataset, const std::string& vessel, const std::filesystem::path& out) {
  std::filesystem::path file;
  for (const auto& entry : std::filesystem::directory_iterator(dataset))
    if (entry.path().extension() == ".nrrd" && entry.path().stem().string().rfind("image", 0) == 0)
      file = entry.path();
  if (file.empty()) throw InvalidInput("no image*.nrrd in " + dataset.string());
  const imaging::ImageVolume image = imaging::read_image(file).volume;
  const auto axis = axis_of(io::read_rotterdam_reference(dataset / vessel / "reference.txt"));
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
  if (argc != 4) {
    std::fprintf(stderr, "usage: reformation_picture DATASET_FOLDER VESSEL_FOLDER OUTPUT.png\n");
    return 2;
  }
  try {
    make(argv[1], argv[2], argv[3]);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "reformation_picture: %s\n", error.what());
    return 3;
  }
}
