#include "graphs.h"

#include "array.h"
#include "call.h"
#include "figures.h"
#include "meshes.h"
#include "options.h"

#include "ostia/core/error.h"
#include "ostia/geometry/graph_faults.h"
#include "ostia/geometry/graph_repair.h"
#include "ostia/geometry/graph_tree.h"
#include "ostia/geometry/vessel_graph.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>

namespace ostia::python {

using geometry::GraphFacts;
using geometry::GraphRepairOptions;
using geometry::GraphRepairStep;
OSTIA_OPTIONS(GraphRepairOptions, (merge_within_mm, roots, keep_directions), ())
OSTIA_FIGURES(GraphRepairStep, (what, count, text), ())
OSTIA_FIGURES(GraphFacts,
              (points, segments, branches, parts, roots, ends, forks, trifurcations, joins, loops, length_mm,
               least_radius_mm, largest_radius_mm),
              (box))

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

/// A dictionary a kind of fault, as `ostia info` names them.
py::list faults_of(const VesselGraph& graph) {
  py::list rows;
  for (const auto& fault : unlocked([&] { return geometry::find_faults(graph); }).found) {
    py::dict row;
    row["what"] = std::string(geometry::name_of(fault.kind));
    row["count"] = fault.count;
    row["edges"] = array_of(fault.edges);
    row["points"] = array_of(fault.points);
    row["text"] = geometry::text_of(fault, graph);
    rows.append(row);
  }
  return rows;
}

void bind_repair(py::module_& m) {
  const std::string text = with_options<GraphRepairOptions>(
      m, "repair_graph",
      "A faulty network made fit for use, and put in order: (VesselGraph, what was done, a dictionary each "
      "with what, count, text). roots: places (k, 3) where its parts begin, mm.");
  m.def(
      "repair_graph",
      [](const VesselGraph& graph, const py::object& progress, const py::kwargs& options) {
        const auto how = options_of<GraphRepairOptions>(options);
        auto fixed = watched(
            progress, [&](const core::TaskContext& task) { return geometry::repaired(graph, how, task); });
        return py::make_tuple(std::make_shared<VesselGraph>(std::move(fixed.graph)), figures_of(fixed.steps));
      },
      py::arg("graph"), py::kw_only(), py::arg("progress") = py::none(), text.c_str());
}

}  // namespace

void bind_graphs(py::module_& m) {
  py::class_<VesselGraph, std::shared_ptr<VesselGraph>>(
      m, "VesselGraph",
      "A network of straight pieces of vessels, of any size, as its arrays: points (n, 3), mm; edges (m, 2), "
      "indices of points; the radius at both ends of each, (m,) or one for all, mm.")
      .def(py::init(&graph_of), py::arg("points"), py::arg("edges"), py::arg("radius_start"),
           py::arg("radius_end") = py::none())
      .def_property_readonly(
          "points",
          [](const py::object& self) { return view_of(self.cast<const VesselGraph&>().points, self); },
          "(n, 3) float64, mm, LPS")
      .def_property_readonly("edges", &edges_view,
                             "(m,) records of start, end (indices of points), radius_start, radius_end (mm)")
      .def_property_readonly(
          "references",
          [](const py::object& self) { return view_of(self.cast<const VesselGraph&>().references, self); },
          "(m,) int64, the id of each edge in its file; (0,): its index")
      .def_static(
          "of_tree",
          [](const geometry::VesselTree& tree) { return unlocked([&] { return geometry::graph_of(tree); }); },
          py::arg("tree"), "Every step of every axis of a VesselTree as an edge.")
      .def(
          "tree", [](const VesselGraph& graph) { return unlocked([&] { return geometry::tree_of(graph); }); },
          "The VesselTree that a sound graph is: a segment a branch, a vessel an end.")
      .def_property_readonly(
          "facts",
          [](const VesselGraph& graph) {
            return figures(unlocked([&] { return geometry::facts_of(graph); }));
          },
          "How many points, segments, branches, parts, forks, loops; length and radii, mm.")
      .def_property_readonly("faults", &faults_of, "What is wrong with it, a dictionary a kind; [] if sound.")
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
  bind_repair(m);
}

}  // namespace ostia::python
