#include "trees.h"

#include "array.h"
#include "values.h"

#include "ostia/core/error.h"
#include "ostia/geometry/vessel_tree.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <cstring>

namespace ostia::python {
namespace {

using geometry::Centerline;
using geometry::VesselTree;

/// (n, 3, 3): tangent, normal, binormal of each point.
py::array frames_view(const py::object& self) {
  static_assert(sizeof(geometry::Frame) == 9 * sizeof(double));
  const auto& frames = self.cast<const Centerline&>().frames;
  return view_of(py::dtype::of<double>(), {static_cast<py::ssize_t>(frames.size()), 3, 3}, frames.data(),
                 self);
}

Centerline line_of(const py::object& points, const py::object& radius) {
  Centerline line;
  line.points = places_of(points, "points");
  line.radius = numbers_of(radius, "radius");
  if (line.points.size() < 2) throw InvalidInput("points: a line has two or more");
  if (line.radius.size() != line.points.size())
    throw InvalidInput("radius: " + std::to_string(line.radius.size()) + " numbers for " +
                       std::to_string(line.points.size()) + " points; give one a point");
  if (!std::all_of(line.radius.begin(), line.radius.end(), [](double r) { return r > 0.0; }))
    throw InvalidInput("radius: in mm, each above 0");
  geometry::complete(line);
  return line;
}

py::tuple state_of(const py::object& line) {
  return py::make_tuple(line.attr("points"), line.attr("radius"), line.attr("abscissa"), line.attr("frames"));
}

/// With abscissas and frames to the last bit.
Centerline line_of_state(const py::tuple& state) {
  Centerline line;
  line.points = places_of(state[0], "points");
  line.radius = numbers_of(state[1], "radius");
  line.abscissa = numbers_of(state[2], "abscissa");
  const py::array frames = taken(state[3], {"frames", 'f', 8, {-1, 3, 3}}, {true, true});
  line.frames.resize(static_cast<std::size_t>(frames.shape(0)));
  std::memcpy(static_cast<void*>(line.frames.data()), frames.data(),
              static_cast<std::size_t>(frames.nbytes()));
  return line;
}

py::tuple state_of_tree(const VesselTree& tree, const py::object& self) {
  py::list nodes, segments, vessels;
  for (const auto& node : tree.nodes) nodes.append(py::make_tuple(node.id, tuple_of(node.position)));
  for (const py::handle segment : self.attr("segments"))
    segments.append(py::make_tuple(segment.attr("id"), segment.attr("start"), segment.attr("end"),
                                   state_of(segment.attr("axis"))));
  for (const auto& vessel : tree.vessels)
    vessels.append(py::make_tuple(vessel.id, vessel.name, vessel.segments));
  return py::make_tuple(nodes, segments, vessels);
}

VesselTree sound(VesselTree tree) {
  if (const auto fault = geometry::find_fault(tree)) throw InvalidInput("tree: " + *fault);
  return tree;
}

VesselTree tree_of_state(const py::tuple& state) {
  VesselTree tree;
  for (const py::handle row : state[0]) {
    const auto node = row.cast<py::tuple>();
    tree.nodes.push_back({node[0].cast<std::int32_t>(), place_of(node[1], "position")});
  }
  for (const py::handle row : state[1]) {
    const auto segment = row.cast<py::tuple>();
    tree.segments.push_back({segment[0].cast<std::int32_t>(), segment[1].cast<std::int32_t>(),
                             segment[2].cast<std::int32_t>(), line_of_state(segment[3].cast<py::tuple>())});
  }
  for (const py::handle row : state[2]) {
    const auto vessel = row.cast<py::tuple>();
    tree.vessels.push_back({vessel[0].cast<std::int32_t>(), vessel[1].cast<std::string>(),
                            vessel[2].cast<std::vector<std::int32_t>>()});
  }
  return sound(std::move(tree));
}

/// One vessel: two nodes, a segment.
VesselTree single(const py::object& points, const py::object& radius, const std::string& name) {
  Centerline line = line_of(points, radius);
  VesselTree tree;
  tree.nodes = {{1, line.points.front()}, {2, line.points.back()}};
  tree.segments.push_back({1, 1, 2, std::move(line)});
  tree.vessels.push_back({1, name, {1}});
  return sound(std::move(tree));
}

std::int32_t vessel_id(const VesselTree& tree, const py::object& which) {
  std::string names;
  for (const geometry::Vessel& vessel : tree.vessels) {
    if (py::isinstance<py::str>(which) ? which.cast<std::string>() == vessel.name
                                       : which.equal(py::int_(vessel.id)))
      return vessel.id;
    names += (names.empty() ? "" : ", ") + std::to_string(vessel.id) + " " + vessel.name;
  }
  throw InvalidInput("vessel: there is none " + py::repr(which).cast<std::string>() + "; there are " + names);
}

Centerline axis_of(const VesselTree& tree, const py::object& which) {
  const std::int32_t id = vessel_id(tree, which);
  const auto found =
      std::find_if(tree.vessels.begin(), tree.vessels.end(), [&](const auto& v) { return v.id == id; });
  return geometry::vessel_axis(tree, *found);
}

void bind_parts(py::module_& m) {
  py::class_<geometry::TreeNode>(m, "TreeNode", "A point where axes begin, end or join.")
      .def_readonly("id", &geometry::TreeNode::id, "What segments name it by.")
      .def_property_readonly(
          "position", [](const geometry::TreeNode& n) { return tuple_of(n.position); }, "(x, y, z), mm, LPS")
      .def("__repr__", [](const geometry::TreeNode& n) {
        return py::str("<ostia.TreeNode {} at {}>").format(n.id, tuple_of(n.position));
      });
  py::class_<geometry::TreeSegment>(m, "TreeSegment", "An edge between two nodes, with axis and radius.")
      .def_readonly("id", &geometry::TreeSegment::id, "What vessels name it by.")
      .def_readonly("start", &geometry::TreeSegment::from, "node id, proximal")
      .def_readonly("end", &geometry::TreeSegment::to, "node id, distal")
      .def_readonly("axis", &geometry::TreeSegment::axis, "Centerline, proximal first.")
      .def("__repr__", [](const geometry::TreeSegment& s) {
        return py::str("<ostia.TreeSegment {}: node {} to {}, {} points>")
            .format(s.id, s.from, s.to, s.axis.size());
      });
  py::class_<geometry::Vessel>(m, "Vessel", "A named path of segments.")
      .def_readonly("id", &geometry::Vessel::id, "What functions and edits name it by.")
      .def_readonly("name", &geometry::Vessel::name, "'LAD', 'vessel_1'.")
      .def_readonly("segments", &geometry::Vessel::segments, "segment ids, proximal first")
      .def("__repr__",
           [](const geometry::Vessel& v) { return py::str("<ostia.Vessel {} '{}'>").format(v.id, v.name); });
}

}  // namespace

void bind_trees(py::module_& m) {
  py::class_<Centerline, std::shared_ptr<Centerline>>(m, "Centerline",
                                                      "The axis of a vessel, from proximal to distal: points "
                                                      "(n, 3), mm, LPS, and the radius (n,) at each, mm.")
      .def(py::init(&line_of), py::arg("points"), py::arg("radius"))
      .def_property_readonly(
          "points",
          [](const py::object& self) { return view_of(self.cast<const Centerline&>().points, self); },
          "(n, 3) float64, mm, LPS")
      .def_property_readonly(
          "radius",
          [](const py::object& self) { return view_of(self.cast<const Centerline&>().radius, self); },
          "(n,) float64, of the maximal inscribed sphere, mm")
      .def_property_readonly(
          "abscissa",
          [](const py::object& self) { return view_of(self.cast<const Centerline&>().abscissa, self); },
          "(n,) float64, arc length from the first point, mm")
      .def_property_readonly(
          "frames", &frames_view,
          "(n, 3, 3) float64: tangent, normal, binormal, unit vectors, rotation-minimising")
      .def_property_readonly(
          "length", [](const Centerline& c) { return c.abscissa.empty() ? 0.0 : c.abscissa.back(); }, "mm")
      .def("__len__", &Centerline::size)
      .def("__repr__",
           [](const Centerline& c) {
             return py::str("<ostia.Centerline: {} points, {:.4g} mm>")
                 .format(c.size(), c.abscissa.empty() ? 0.0 : c.abscissa.back());
           })
      .def("__copy__", [](const py::object& self) { return self; })
      .def(
          "__deepcopy__", [](const py::object& self, const py::object&) { return self; }, py::arg("memo"))
      .def(py::pickle(&state_of, &line_of_state));
  bind_parts(m);
  py::class_<VesselTree, std::shared_ptr<VesselTree>>(
      m, "VesselTree", "A tree of vessels: nodes, segments between them, named vessels.")
      .def_static("single", &single, py::arg("points"), py::arg("radius"), py::arg("name") = "vessel_1",
                  "A tree of one vessel along points (n, 3), mm, LPS, proximal first, with the radius (n,) "
                  "at each, mm.")
      .def_property_readonly(
          "nodes", [](const py::object& self) { return items(self.cast<const VesselTree&>().nodes, self); },
          "A list of TreeNode.")
      .def_property_readonly(
          "segments",
          [](const py::object& self) { return items(self.cast<const VesselTree&>().segments, self); },
          "A list of TreeSegment.")
      .def_property_readonly(
          "vessels",
          [](const py::object& self) { return items(self.cast<const VesselTree&>().vessels, self); },
          "A list of Vessel.")
      .def("axis", &axis_of, py::arg("vessel"), "The axis of a whole vessel, by name or id, from the root.")
      .def_property_readonly("roots", &geometry::roots, "ids of nodes without a parent segment")
      .def_property_readonly("ends", &geometry::ends, "ids of nodes without a child segment")
      .def("__len__", [](const VesselTree& t) { return t.vessels.size(); })
      .def("__repr__",
           [](const VesselTree& t) {
             std::string names;
             for (const auto& vessel : t.vessels) names += (names.empty() ? "" : ", ") + vessel.name;
             return py::str("<ostia.VesselTree: {} segments, vessels {}>").format(t.segments.size(), names);
           })
      .def("__copy__", [](const py::object& self) { return self; })
      .def(
          "__deepcopy__", [](const py::object& self, const py::object&) { return self; }, py::arg("memo"))
      .def(py::pickle(
          [](const py::object& self) { return state_of_tree(self.cast<const VesselTree&>(), self); },
          &tree_of_state));
}

}  // namespace ostia::python
