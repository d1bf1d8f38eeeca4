#include "slab_rows.h"

#include "ostia/reformat/curved_reformation.h"

namespace ostia::reformat {
namespace {

template <class T>
CurvedImage image_along(const imaging::Volume<T>& image, const CurvedReformation& view,
                        imaging::Interpolation how, const core::TaskContext& task) {
  require_voxels(image, "reformat");
  const CurvedOptions& options = view.options();
  CurvedImage result{options.width, options.height, {}};
  const auto row_of = [&](std::size_t j) {
    const CurvedReformation::Row row = view.row(static_cast<double>(j) + 0.5);
    const Vec3 step = options.pixel_mm * row.along;
    return StraightRow{row.start + 0.5 * step, step, row.across};
  };
  result.values =
      sampled_rows(image, static_cast<std::size_t>(options.width), static_cast<std::size_t>(options.height),
                   row_of, {options.slab, options.slab_mm}, how, task);
  return result;
}

}  // namespace

CurvedImage reformatted(const imaging::ImageVolume& image, const CurvedReformation& view,
                        imaging::Interpolation how, const core::TaskContext& task) {
  return image_along(image, view, how, task);
}

CurvedImage reformatted(const imaging::FloatVolume& image, const CurvedReformation& view,
                        imaging::Interpolation how, const core::TaskContext& task) {
  return image_along(image, view, how, task);
}

}  // namespace ostia::reformat
