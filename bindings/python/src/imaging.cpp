#include "array.h"
#include "call.h"
#include "rooms.h"
#include "volume.h"

#include "ostia/core/error.h"
#include "ostia/core/log.h"
#include "ostia/imaging/image_axes.h"
#include "ostia/imaging/image_file.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cmath>
#include <filesystem>

namespace ostia::python {
namespace {

namespace fs = std::filesystem;
using core::TaskContext;

geometry::Mat3 direction_of(const py::object& given) {
  const py::array array = taken(given, {"direction", 'f', 8, {3, 3}}, {true, true});
  require_finite(array, "direction");
  const auto* row = static_cast<const double*>(array.data());
  geometry::Mat3 direction;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) direction(i, j) = row[3 * i + j];
  const double off = (direction.transpose() * direction - geometry::Mat3::Identity()).cwiseAbs().maxCoeff();
  if (off > 1e-6 || direction.determinant() < 0.0)
    throw InvalidInput("direction: its columns are no right-handed orthonormal axes");
  return direction;
}

AnyVolume make(const py::object& array, const py::object& spacing, const py::object& origin,
               const py::object& direction, const py::object& copy) {
  imaging::Geometry grid;
  if (!spacing.is_none()) grid.spacing = place_of(spacing, "spacing");
  if (grid.spacing.minCoeff() <= 0.0) throw InvalidInput("spacing: (x, y, z) in mm, each above 0");
  if (!origin.is_none()) grid.origin = place_of(origin, "origin");
  if (!direction.is_none()) grid.direction = direction_of(direction);
  return AnyVolume::of_array(array, grid, copy);
}

py::array direction_array(const imaging::Geometry& grid) {
  py::array_t<double> out({3, 3});
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) out.mutable_at(i, j) = grid.direction(i, j);
  return out;
}

std::string repr(const AnyVolume& volume) {
  const imaging::Geometry& g = volume.grid();
  return py::str("<ostia.Volume of {}: {} x {} x {} voxels of {:.4g} x {:.4g} x {:.4g} mm, axes {}>")
      .format(volume.type(), g.size[0], g.size[1], g.size[2], g.spacing.x(), g.spacing.y(), g.spacing.z(),
              imaging::axes_of(g))
      .cast<std::string>();
}

py::tuple state_of(const py::object& self) {
  return py::make_tuple(self.attr("array"), self.attr("spacing"), self.attr("origin"),
                        self.attr("direction"));
}

template <class Read>
AnyVolume read(const fs::path& path, const py::object& progress, const Read& reader) {
  auto loaded = watched(progress, [&](const TaskContext& task) {
    auto found = reader(path, task);
    for (const std::string& text : found.header.warnings) core::log_warning(text);
    return found;
  });
  return AnyVolume(std::move(loaded.volume));
}

void bind_volume(py::module_& m) {
  py::class_<AnyVolume>(
      m, "Volume",
      "A scalar image in world space (LPS, mm). `array` is (z, y, x), int16 (HU), uint8 (masks, "
      "labels) or float32, one memory with what was given; immutable. spacing and origin are (x, y, z), mm, "
      "direction (3, 3) with the axes x, y, z as columns.")
      .def(py::init(&make), py::arg("array"), py::kw_only(), py::arg("spacing") = py::none(),
           py::arg("origin") = py::none(), py::arg("direction") = py::none(), py::arg("copy") = py::none())
      .def_property_readonly(
          "array", [](const py::object& self) { return self.cast<const AnyVolume&>().array(self); },
          "A view of the voxels, (z, y, x), HU, labels or what the image is of; nobody may write to it.")
      .def_property_readonly(
          "spacing", [](const AnyVolume& v) { return tuple_of(v.grid().spacing); }, "(x, y, z), mm")
      .def_property_readonly(
          "origin", [](const AnyVolume& v) { return tuple_of(v.grid().origin); },
          "Centre of voxel (0, 0, 0), LPS, mm")
      .def_property_readonly(
          "direction", [](const AnyVolume& v) { return direction_array(v.grid()); },
          "(3, 3) float64; its columns are the axes x, y, z, of unit length")
      .def_property_readonly(
          "size",
          [](const AnyVolume& v) {
            const auto& s = v.grid().size;
            return py::make_tuple(s[0], s[1], s[2]);
          },
          "(x, y, z), voxels")
      .def_property_readonly(
          "dtype", [](const AnyVolume& v) { return v.type(); }, "'int16', 'uint8' or 'float32'")
      .def_property_readonly(
          "axes", [](const AnyVolume& v) { return imaging::axes_of(v.grid()); },
          "What x, y and z rise towards: 'LPS'")
      .def(
          "world",
          [](const AnyVolume& v, const py::object& index) {
            return tuple_of(v.grid().world(place_of(index, "index")));
          },
          py::arg("index"), "Where an index (x, y, z), in voxels, lies: (x, y, z), mm, LPS.")
      .def(
          "index",
          [](const AnyVolume& v, const py::object& world) {
            return tuple_of(v.grid().index(place_of(world, "world")));
          },
          py::arg("world"), "The index (x, y, z), in voxels, of a place (x, y, z), mm, LPS.")
      .def(
          "astype",
          [](const py::object& self, const std::string& dtype) {
            if (dtype != "int16" && dtype != "uint8" && dtype != "float32")
              throw InvalidInput("dtype: one of int16, uint8, float32, not " + dtype);
            const py::tuple state = state_of(self);
            const py::object array = self.attr("array");
            const py::object values = array.attr("astype")(dtype);
            if (!py::module_::import("numpy").attr("array_equal")(values, array).cast<bool>())
              throw InvalidInput("dtype: " + dtype +
                                 " cannot hold the values of this Volume; scale or threshold them");
            return make(values, state[1], state[2], state[3], py::none());
          },
          py::arg("dtype"), "The same values as another type; refused where it cannot hold them.")
      .def(
          "__array__",
          [](const py::object& self, const py::object& dtype) {
            const py::object array = self.attr("array");
            return dtype.is_none() ? array : array.attr("astype")(dtype);
          },
          py::arg("dtype") = py::none())
      .def("__repr__", &repr)
      .def("__copy__", [](const py::object& self) { return self; })
      .def(
          "__deepcopy__", [](const py::object& self, const py::object&) { return self; }, py::arg("memo"))
      .def(
          py::pickle(&state_of, [](const py::tuple& s) { return make(s[0], s[1], s[2], s[3], py::none()); }));
}

}  // namespace

void bind_imaging(py::module_& m) {
  bind_volume(m);
  const auto file = [&](const char* name, auto reader, const char* text) {
    m.def(
        name,
        [reader](const fs::path& path, const py::object& progress) { return read(path, progress, reader); },
        py::arg("path"), py::kw_only(), py::arg("progress") = py::none(), text);
  };
  file("read_image", &imaging::read_image, "A CT image in HU, int16: NRRD, MetaImage or NIfTI.");
  file("read_mask", &imaging::read_mask, "A mask of 0 and 1, uint8.");
  file("read_labels", &imaging::read_labels, "Labels with their values, uint8.");
  file("read_float_image", &imaging::read_float_image, "True values, float32.");
  m.def(
      "write_image",
      [](const fs::path& path, const AnyVolume& volume) {
        watched_or_left(py::none(), [path, volume](const TaskContext&) {
          volume.visit([&](const auto& one) { imaging::write_image(path, one); });
        });
      },
      py::arg("path"), py::arg("volume"),
      "By extension: .nrrd, .mhd, .mha, .nii, .nii.gz; whole or not at all.");
}

}  // namespace ostia::python
