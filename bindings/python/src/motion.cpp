#include "motion.h"

#include "call.h"
#include "figures.h"
#include "options.h"
#include "rooms.h"
#include "values.h"

#include "ostia/core/error.h"
#include "ostia/core/log.h"
#include "ostia/geometry/mixed_mesh.h"
#include "ostia/geometry/vessel_tree.h"
#include "ostia/io/cage_motion_file.h"
#include "ostia/io/surface_file.h"
#include "ostia/motion/r_peaks.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

namespace ostia::python {

using geometry::PhaseOrigin;

namespace {

namespace fs = std::filesystem;
using geometry::CageMotion;
using geometry::FacedSurface;
using geometry::MixedMesh;
using geometry::TriMesh;
using geometry::Vec3;
using geometry::VesselTree;
using geometry::VolumeMesh;
using Points = std::vector<Vec3>;

void require_phase(double phase) {
  if (!std::isfinite(phase)) throw InvalidInput("phase: a share of the cycle, a number; 1.25 is 0.25");
}

/// Throws InvalidInput where most lie outside of the cage; warns where some do.
Points carried(const Motion& motion, const Points& points, double phase, const std::string& what) {
  const motion::CarriedPoints weights(motion.cage.grid, points);
  const std::string warning = motion::judge_outside(weights, what);
  if (!warning.empty()) core::log_warning(warning);
  return weights.places(motion.moving.at(phase));
}

VesselTree carried(const Motion& motion, VesselTree tree, double phase) {
  Points all;  // nodes first, so that they and the ends of axes stay together
  for (const auto& node : tree.nodes) all.push_back(node.position);
  for (const auto& segment : tree.segments)
    all.insert(all.end(), segment.axis.points.begin(), segment.axis.points.end());
  const Points moved = carried(motion, all, phase, "the axes");
  auto next = moved.begin();
  for (auto& node : tree.nodes) node.position = *next++;
  for (auto& segment : tree.segments) {
    for (Vec3& p : segment.axis.points) p = *next++;
    geometry::complete(segment.axis);
  }
  return tree;
}

/// A value whose points are moved, all else as it was.
template <class Value>
auto carrier(Points Value::*points, const char* what) {
  return [points, what](const Motion& motion, const Value& value, double phase) {
    require_phase(phase);
    return unlocked([&] {
      Value moved = value;
      moved.*points = carried(motion, value.*points, phase, what);
      return std::make_shared<Value>(std::move(moved));
    });
  };
}

py::array phases_of(const Motion& motion) {
  std::vector<double> phases;
  for (const auto& one : motion.cage.phases) phases.push_back(one.phase);
  return array_of(phases);
}

py::list origins_of(const Motion& motion) {
  py::list origins;
  for (const auto& one : motion.cage.phases) origins.append(detail::word_of(one.origin));
  return origins;
}

py::tuple state_of(const Motion& motion) {
  const auto& grid = motion.cage.grid;
  py::list phases;
  for (const auto& one : motion.cage.phases)
    phases.append(py::make_tuple(one.phase, array_of(one.control_points), detail::word_of(one.origin)));
  const py::object surface =
      motion.surface
          ? py::object(py::make_tuple(array_of(motion.surface->points), array_of(motion.surface->triangles)))
          : py::none();
  return py::make_tuple(tuple_of(grid.origin), tuple_of(grid.cell_mm), grid.cells, motion.cage.template_phase,
                        phases, surface);
}

std::shared_ptr<Motion> motion_of_state(const py::tuple& s) {
  CageMotion cage;
  cage.grid = {place_of(s[0], "origin"), place_of(s[1], "cell_mm"), s[2].cast<int>()};
  cage.template_phase = s[3].cast<double>();
  for (const py::handle row : s[4]) {
    const auto one = row.cast<py::tuple>();
    PhaseOrigin origin{};
    take(origin, one[2], "origin");
    cage.phases.push_back({one[0].cast<double>(), places_of(one[1], "control_points"), origin});
  }
  std::optional<TriMesh> surface;
  if (!s[5].is_none()) {
    const auto parts = s[5].cast<py::tuple>();
    surface = TriMesh{places_of(parts[0], "points"), rows_of<3>(parts[1], "triangles")};
  }
  return std::make_shared<Motion>(std::move(cage), std::move(surface));
}

void bind_carried(py::class_<Motion, std::shared_ptr<Motion>>& type) {
  constexpr const char* text =
      "A value as it is at a phase (share of the cycle; 1.25 is 0.25): TriMesh, FacedSurface, VesselTree, "
      "VolumeMesh, MixedMesh, or places (n, 3), mm. It is given as the template's phase has it.";
  type.def("carried", carrier(&TriMesh::points, "the surface"), py::arg("value"), py::arg("phase"), text)
      .def(
          "carried",
          [](const Motion& motion, const FacedSurface& value, double phase) {
            require_phase(phase);
            return unlocked([&] {
              FacedSurface moved = value;
              moved.mesh.points = carried(motion, value.mesh.points, phase, "the surface");
              return std::make_shared<FacedSurface>(std::move(moved));
            });
          },
          py::arg("value"), py::arg("phase"))
      .def("carried", carrier(&VolumeMesh::points, "the mesh"), py::arg("value"), py::arg("phase"))
      .def("carried", carrier(&MixedMesh::points, "the mesh"), py::arg("value"), py::arg("phase"))
      .def(
          "carried",
          [](const Motion& motion, const VesselTree& value, double phase) {
            require_phase(phase);
            return unlocked([&] { return std::make_shared<VesselTree>(carried(motion, value, phase)); });
          },
          py::arg("value"), py::arg("phase"))
      .def(
          "carried",
          [](const Motion& motion, const py::object& value, double phase) {
            require_phase(phase);
            const Points places = places_of(value, "value");
            return array_of(unlocked([&] { return carried(motion, places, phase, "the places"); }));
          },
          py::arg("value"), py::arg("phase"))
      .def(
          "velocity",
          [](const Motion& motion, const py::object& places, double phase) {
            require_phase(phase);
            const Points where = places_of(places, "places");
            return array_of(unlocked([&] {
              return motion::CarriedPoints(motion.cage.grid, where).rates(motion.moving.rate(phase));
            }));
          },
          py::arg("places"), py::arg("phase"),
          "How places (n, 3) of the template move at a phase: (n, 3), mm a cycle.");
}

void bind_type(py::module_& m) {
  py::class_<Motion, std::shared_ptr<Motion>> type(
      m, "Motion", "A surface that beats: a cage about it over the cycle of the heart.");
  type.def_property_readonly("phases", &phases_of, "(p,), shares of the cycle since the R peak, [0, 1)")
      .def_property_readonly("origins", &origins_of, "of each phase: at_rest, fitted or bridged")
      .def_property_readonly(
          "template_phase", [](const Motion& motion) { return motion.cage.template_phase; },
          "share of the cycle")
      .def_property_readonly(
          "cells", [](const Motion& motion) { return motion.cage.grid.cells; }, "of the cage, a side")
      .def_property_readonly(
          "surface",
          [](const py::object& self) -> py::object {
            auto& motion = self.cast<Motion&>();
            if (!motion.surface) return py::none();
            return py::cast(part_of(*motion.surface, self));
          },
          "TriMesh at the template's phase; None where the file has none")
      .def(
          "control_points",
          [](const Motion& motion, double phase) {
            require_phase(phase);
            return array_of(motion.moving.at(phase));
          },
          py::arg("phase"), "(k, 3) of the cage at a phase, mm")
      .def("__repr__",
           [](const Motion& motion) {
             return py::str("<ostia.Motion: {} phases, {} cells a side>")
                 .format(motion.cage.phases.size(), motion.cage.grid.cells);
           })
      .def(py::pickle(&state_of, &motion_of_state));
  bind_carried(type);
  same_when_copied(type);
}

/// motion.json, or the folder that holds it; with the template's surface beside it.
std::shared_ptr<Motion> read_motion(const fs::path& path) {
  const fs::path file = fs::is_directory(path) ? path / "motion.json" : path;
  io::CageMotionFile read = io::read_cage_motion(file);
  std::optional<TriMesh> surface;
  const fs::path shape = file.parent_path() / read.surface;
  if (!read.surface.empty() && fs::exists(shape)) surface = io::read_surface(shape).surface.mesh;
  return std::make_shared<Motion>(std::move(read.motion), std::move(surface));
}

void write_motion(const fs::path& path, const Motion& motion) {
  const std::string name = motion.surface ? path.stem().string() + "_template.vtp" : std::string();
  if (motion.surface) io::write_surface(path.parent_path() / name, *motion.surface);
  io::write_cage_motion(path, {motion.cage, name});
}

}  // namespace

void bind_motion(py::module_& m) {
  bind_type(m);
  m.def(
      "read_motion",
      [](const fs::path& path) {
        return watched_or_left(py::none(), [path](const auto&) { return read_motion(path); });
      },
      py::arg("path"), "Of motion.json, or the folder of `ostia motion fit`.");
  m.def(
      "write_motion",
      [](const fs::path& path, const Motion& motion) {
        watched_or_left(py::none(),
                        [path, motion = kept(motion)](const auto&) { write_motion(path, *motion); });
      },
      py::arg("path"), py::arg("motion"), "A .json, with the template's surface beside it.");
  m.def(
      "r_peaks",
      [](const py::object& lead, double samples_per_second) {
        const auto values = numbers_of(lead, "lead");
        const auto found = unlocked([&] { return motion::r_peaks(values, samples_per_second); });
        return array_of(std::vector<std::int64_t>(found.begin(), found.end()));
      },
      py::arg("lead"), py::arg("samples_per_second"),
      "R peaks in a lead of an electrocardiogram (n,): indices of samples, (k,) int64.");
}

}  // namespace ostia::python
