#include "graphs.h"

#include "array.h"
#include "meshes.h"

#include "ostia/core/error.h"
#include "ostia/geometry/vessel_graph.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace ostia::python {
namespace {

using geometry::GraphEdge;
using geometry::VesselGraph;

/// A record an edge: start, end, radius_start, radius_end.
py::dtype edge_type() {
  static_assert(sizeof(GraphEdge) == 24 && offsetof(GraphEdge, radius_from) == 8);
  py::list fields;
  fields.append(py::make_tuple("start", "<i4"));
  fields.append(py::make_tuple("end", "<i4"));
  fields.append(py::make_tuple("radius_start", "<f8"));
  fields.append(py::make_tuple("radius_end", "<f8"));
  return py::dtype::from_args(fields);
}

py::array edges_view(const py::object& self) {
  const auto& edges = self.cast<const VesselGraph&>().edges;
  return view_of(edge_type(), {static_cast<py::ssize_t>(edges.size())}, edges.data(), self);
}

/// (m,) of a column: one number for all, or one an edge.
std::vector<double> radii_of(const py::object& given, std::size_t edges, const std::string& name) {
  if (PyFloat_Check(given.ptr()) || PyLong_Check(given.ptr())) {
    const double one = PyFloat_AsDouble(given.ptr());
    if (PyErr_Occurred() != nullptr) throw py::error_already_set();
    if (!std::isfinite(one)) throw InvalidInput(name + ": not finite; in mm");
    return std::vector<double>(edges, one);
  }
  const auto values = numbers_of(given, name);
  if (values.size() != edges)
    throw InvalidInput(name + ": " + std::to_string(values.size()) + " numbers for " + std::to_string(edges) +
                       " edges; give one an edge");
  return values;
}

VesselGraph graph_of(const py::object& points, const py::object& edges, const py::object& radius_start,
                     const py::object& radius_end) {
  VesselGraph graph;
  graph.points = places_of(points, "points");
  const py::array pairs = taken(edges, {"edges", 'i', 4, {-1, 2}}, {});
  require_indices(pairs, graph.points.size(), "edges");
  const auto count = static_cast<std::size_t>(pairs.shape(0));
  const auto start = radii_of(radius_start, count, "radius_start");
  const auto end = radius_end.is_none() ? start : radii_of(radius_end, count, "radius_end");
  const auto* pair = static_cast<const std::int32_t*>(pairs.data());
  graph.edges.resize(count);
  for (std::size_t i = 0; i < count; ++i) graph.edges[i] = {pair[2 * i], pair[2 * i + 1], start[i], end[i]};
  return graph;
}

py::tuple state_of(const py::object& self) {
  return py::make_tuple(self.attr("points"), self.attr("edges"), self.attr("references"));
}

VesselGraph graph_of_state(const py::tuple& state) {
  VesselGraph graph;
  graph.points = places_of(state[0], "points");
  const auto edges = state[1].cast<py::array>();
  graph.edges.resize(static_cast<std::size_t>(edges.size()));
  std::memcpy(static_cast<void*>(graph.edges.data()), edges.data(), static_cast<std::size_t>(edges.nbytes()));
  const auto references = state[2].cast<py::array_t<std::int64_t>>();
  graph.references.assign(references.data(), references.data() + references.size());
  return graph;
}

}  // namespace

void bind_graphs(py::module_& m) {
  py::class_<VesselGraph, std::shared_ptr<VesselGraph>>(
      m, "VesselGraph", "A network of straight pieces of vessels, of any size, as its arrays.")
      .def(py::init(&graph_of), py::arg("points"), py::arg("edges"), py::arg("radius_start"),
           py::arg("radius_end") = py::none())
      .def_property_readonly(
          "points",
          [](const py::object& self) { return view_of(self.cast<const VesselGraph&>().points, self); },
          "(n, 3) float64, mm")
      .def_property_readonly("edges", &edges_view,
                             "(m,) records of start, end (indices of points), radius_start, radius_end (mm)")
      .def_property_readonly(
          "references",
          [](const py::object& self) { return view_of(self.cast<const VesselGraph&>().references, self); },
          "(m,) int64, what the file calls each edge; (0,): its index")
      .def("__len__", [](const VesselGraph& graph) { return graph.edges.size(); })
      .def("__repr__",
           [](const VesselGraph& graph) {
             return py::str("<ostia.VesselGraph: {} points, {} edges>")
                 .format(graph.points.size(), graph.edges.size());
           })
      .def("__copy__", [](const py::object& self) { return self; })
      .def(
          "__deepcopy__", [](const py::object& self, const py::object&) { return self; }, py::arg("memo"))
      .def(py::pickle(&state_of, &graph_of_state));
}

}  // namespace ostia::python
