#include "call.h"
#include "figures.h"
#include "options.h"
#include "rooms.h"
#include "volume.h"

#include "ostia/coronary/aorta_mask.h"

#include <pybind11/stl.h>

namespace ostia::python {

using coronary::AortaOptions;
using coronary::AortaStation;
OSTIA_OPTIONS(AortaOptions,
              (least_hu, most_hu, smallest_radius_mm, largest_radius_mm, work_spacing_mm, least_column_mm),
              ())
OSTIA_FIGURES(AortaStation, (centre, tangent, radius_mm, round), ())

void bind_coronary(py::module_& m) {
  const std::string text =
      with_options<AortaOptions>(m, "segment_aorta",
                                 "The aorta of a contrast-enhanced CT, found without a click: (mask on the "
                                 "image's grid, uint8; a dictionary "
                                 "a section from the root on: centre, tangent, radius_mm, round; mm).");
  m.def(
      "segment_aorta",
      [](const AnyVolume& image, const py::object& progress, const py::kwargs& options) {
        const auto how = options_of<AortaOptions>(options);
        const imaging::ImageVolume& ct = image.image("image");
        auto found = watched(progress, [&](const core::TaskContext& task) {
          coronary::Aorta aorta = coronary::find_aorta(ct, how, task.sub(0.0, 0.6));
          imaging::MaskVolume mask = coronary::aorta_mask(ct, aorta, {}, task.sub(0.6, 1.0));
          return std::pair(std::move(aorta), std::move(mask));
        });
        return py::make_tuple(AnyVolume(std::move(found.second)), figures_of(found.first.stations));
      },
      py::arg("image"), py::kw_only(), py::arg("progress") = py::none(), text.c_str());
}

}  // namespace ostia::python
