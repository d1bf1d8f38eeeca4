// Pictures of values, as notebooks show them. Of the room session, whose values it may know, like all below.

#include "call.h"
#include "rooms.h"
#include "trees.h"
#include "volume.h"

#include "ostia/analysis/lumen_profile.h"
#include "ostia/core/error.h"
#include "ostia/figure/plot.h"
#include "ostia/figure/preview.h"
#include "ostia/lumen/lumen_model.h"

#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

namespace ostia::python {
namespace {

using figure::Picture;
using geometry::VesselTree;

constexpr double model_step_mm = 1.0;  // about as far apart as the samples of a start

Picture plot_of(const analysis::LumenProfile& profile) {
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  figure::Series mean{"mean", {}, {}, {}}, least{"least", {}, {}, {}, figure::LineStyle::dashed, 1.2};
  for (const analysis::SectionMeasures& section : profile.sections) {
    mean.x.push_back(section.s_mm);
    mean.y.push_back(section.found ? section.diameter_mm : nothing);
    least.x.push_back(section.s_mm);
    least.y.push_back(section.found ? section.least_diameter_mm : nothing);
  }
  figure::PlotOptions how;
  how.x_label = "mm along the vessel";
  how.y_label = "diameter (mm)";
  how.width_px = 480;
  how.height_px = 260;
  how.y_from_zero = true;
  return figure::line_plot({mean, least}, how);
}

/// A model's vessels as round as their samples are far from the axis: solving its walls would take too long.
std::vector<figure::NamedTube> tubes_of(const lumen::LumenModel& model) {
  std::vector<figure::NamedTube> tubes;
  for (const geometry::Vessel& named : model.tree.vessels) {
    const lumen::VesselLumen& one = lumen::vessel(model, named.id);
    const double length = one.axis->length() - one.own_from_mm;
    const auto steps = static_cast<std::size_t>(std::max(1.0, std::ceil(length / model_step_mm)));
    std::vector<double> sums(steps + 1), counts(steps + 1);
    for (const lumen::SurfaceSample& sample : one.samples) {
      if (sample.origin == lumen::SampleOrigin::cap) continue;
      const double share = std::clamp((sample.s_mm - one.own_from_mm) / std::max(length, 1e-9), 0.0, 1.0);
      const auto at = static_cast<std::size_t>(std::lround(share * static_cast<double>(steps)));
      sums[at] += (sample.position - one.axis->point(sample.s_mm)).norm();
      counts[at] += 1.0;
    }
    figure::NamedTube tube{named.name, {}, {}};
    for (std::size_t i = 0; i <= steps; ++i) {
      if (counts[i] == 0.0) continue;
      tube.points.push_back(
          one.axis->point(one.own_from_mm + length * static_cast<double>(i) / static_cast<double>(steps)));
      tube.radius_mm.push_back(std::max(sums[i] / counts[i], 0.05));
    }
    tubes.push_back(std::move(tube));
  }
  return tubes;
}

Picture picture_of_value(const py::object& value) {
  const auto as = [&](auto* type) {
    using T = std::remove_pointer_t<decltype(type)>;
    return py::isinstance<T>(value) ? &value.cast<const T&>() : nullptr;
  };
  if (const auto* volume = as(static_cast<AnyVolume*>(nullptr)))
    return unlocked(
        [&] { return volume->visit([](const auto& voxels) { return figure::volume_preview(voxels); }); });
  if (const auto* mesh = as(static_cast<geometry::TriMesh*>(nullptr)))
    return unlocked([&] { return figure::surface_preview(*mesh); });
  if (const auto* faced = as(static_cast<geometry::FacedSurface*>(nullptr)))
    return unlocked([&] { return figure::surface_preview(faced->mesh); });
  if (const auto* mixed = as(static_cast<geometry::MixedMesh*>(nullptr)))
    return unlocked([&] { return figure::mesh_preview(*mixed); });
  if (const auto* tetrahedra = as(static_cast<geometry::VolumeMesh*>(nullptr)))
    return unlocked([&] { return figure::mesh_preview(geometry::mixed(*tetrahedra)); });
  if (const auto* tree = as(static_cast<VesselTree*>(nullptr)))
    return unlocked([&] { return figure::tree_preview(*tree); });
  if (const auto* profile = as(static_cast<analysis::LumenProfile*>(nullptr)))
    return unlocked([&] { return plot_of(*profile); });
  if (const auto* model = as(static_cast<lumen::LumenModel*>(nullptr)))
    return unlocked([&] { return figure::tube_preview(tubes_of(*model)); });
  throw InvalidInput("value: a Volume, a mesh, a VesselTree, a LumenModel or a LumenProfile, not " +
                     py::type::of(value).attr("__name__").cast<std::string>());
}

/// The vessel of a name or an id, or the first.
const geometry::Vessel& chosen_vessel(const VesselTree& tree, const py::object& which) {
  if (tree.vessels.empty()) throw InvalidInput("value: the tree has no vessel");
  if (which.is_none()) return tree.vessels.front();
  const bool by_name = py::isinstance<py::str>(which);
  std::string all;
  for (const geometry::Vessel& one : tree.vessels) {
    if (by_name ? one.name == which.cast<std::string>() : one.id == which.cast<std::int32_t>()) return one;
    all += (all.empty() ? "" : ", ") + one.name;
  }
  throw InvalidInput("vessel: there is no such vessel; there are " + all);
}

Picture picture_along(const py::object& value, const AnyVolume& volume, const py::object& vessel,
                      double theta_deg) {
  const imaging::ImageVolume& image = volume.image("image");
  const VesselTree* tree = nullptr;
  if (py::isinstance<VesselTree>(value)) tree = &value.cast<const VesselTree&>();
  if (py::isinstance<lumen::LumenModel>(value)) tree = &value.cast<const lumen::LumenModel&>().tree;
  if (tree == nullptr)
    throw InvalidInput("value: with an image a VesselTree or a LumenModel, whose vessel it is shown along");
  const geometry::Vessel& one = chosen_vessel(*tree, vessel);
  return unlocked([&] {
    const auto axis = std::make_shared<const geometry::AxisCurve>(geometry::vessel_axis(*tree, one));
    return figure::vessel_preview(image, {axis, one.name, theta_deg});
  });
}

py::bytes png_of(const Picture& picture, double density = 1.0) {
  return py::bytes(unlocked([&] { return picture.png(density); }));
}

/// What nothing can be seen of, such as an empty mesh, is shown by its words.
void show_in_notebooks(const py::module_& m, const char* name) {
  const py::object type = m.attr(name);
  type.attr("_repr_png_") = py::cpp_function(
      [](const py::object& self) -> py::object {
        try {
          return png_of(picture_of_value(self));
        } catch (const Error&) {
          return py::none();
        }
      },
      py::name("_repr_png_"), py::is_method(type), "A picture of it, as notebooks ask for it; PNG.");
}

}  // namespace

void bind_display(py::module_& m) {
  py::class_<Picture>(m, "Picture", "A drawing; notebooks show it by themselves.")
      .def_property_readonly("width", &Picture::width, "CSS pixels, 1/96 inch")
      .def_property_readonly("height", &Picture::height, "CSS pixels, 1/96 inch")
      .def("png", &png_of, py::arg("density") = 1.0, "As the bytes of a PNG; so many raster pixels a pixel.")
      .def(
          "write",
          [](const Picture& picture, const std::filesystem::path& path, double density) {
            unlocked([&] { picture.write(path, density); });
          },
          py::arg("path"), py::arg("density") = 1.0, ".png, .svg or .pdf")
      .def("_repr_png_", [](const Picture& picture) { return png_of(picture); })
      .def("__repr__", [](const Picture& picture) {
        return py::str("<ostia.Picture: {} x {} pixels>").format(picture.width(), picture.height());
      });
  m.def(
      "picture",
      [](const py::object& value, const py::object& image, const py::object& vessel, double theta_deg) {
        if (image.is_none()) return picture_of_value(value);
        return picture_along(value, image.cast<const AnyVolume&>(), vessel, theta_deg);
      },
      py::arg("value"), py::kw_only(), py::arg("image") = py::none(), py::arg("vessel") = py::none(),
      py::arg("theta_deg") = 0.0,
      "A small picture: slices of a Volume, a mesh, a tree, a model, a profile's diameters; with an image, "
      "that along a vessel (name or id; the first) of a tree or model, straightened, at theta_deg and at "
      "right angles to it.");
  for (const char* name : {"Volume", "TriMesh", "FacedSurface", "MixedMesh", "VolumeMesh", "VesselTree",
                           "LumenProfile", "LumenModel"})
    show_in_notebooks(m, name);
}

}  // namespace ostia::python
