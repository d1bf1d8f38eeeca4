#include "growth.h"

#include "call.h"
#include "figures.h"
#include "options.h"
#include "values.h"

#include "ostia/analysis/graph_overlaps.h"
#include "ostia/analysis/tree_growth.h"
#include "ostia/core/error.h"
#include "ostia/geometry/graph_faults.h"
#include "ostia/geometry/mesh_topology.h"

#include <pybind11/stl.h>

namespace ostia::python {

using analysis::CoronaryArtery;
using analysis::GraphOverlap;
using analysis::GrowthOptions;
using analysis::MyocardialShell;
using analysis::OverlapOptions;

template <>
struct WordsOf<CoronaryArtery> {
  static constexpr std::pair<const char*, CoronaryArtery> words[] = {
      {"right", CoronaryArtery::right},
      {"left_anterior", CoronaryArtery::left_anterior},
      {"circumflex", CoronaryArtery::circumflex}};
};
OSTIA_OPTIONS(GrowthOptions, (artery, seed, most_segments), ())
OSTIA_OPTIONS(MyocardialShell, (base, axis, length_mm, radius_mm, wall_mm, whole), ())
OSTIA_OPTIONS(OverlapOptions, (bend_reach, fork_reach, least_depth, most), ())
OSTIA_FIGURES(GraphOverlap, (first, second, depth_mm, place), ())

namespace {

using analysis::GrownTree;
using geometry::TriMesh;
using geometry::VesselGraph;

analysis::GrowthDomain domain_of(const py::object& given, const VesselGraph& graph) {
  if (given.is_none()) return analysis::domain_of(analysis::shell_about(graph));
  if (py::isinstance<py::float_>(given) || py::isinstance<py::int_>(given))
    return analysis::domain_of(analysis::shell_about(graph, given.cast<double>()));
  if (py::isinstance<py::dict>(given)) {
    MyocardialShell shell;
    take(shell, given, "domain");
    return analysis::domain_of(shell);
  }
  if (!py::isinstance<TriMesh>(given))
    refuse_call("domain: a closed TriMesh, the wall's thickness in mm, a dictionary of a shell, or None");
  const auto& surface = given.cast<const TriMesh&>();
  const auto facts = geometry::find_faults(surface, false);
  if (facts.open_edges > 0)
    throw InvalidInput("domain: it has " + std::to_string(facts.open_edges) +
                       " open edges: an open surface has no inside to grow in; repair_surface with "
                       "fill_holes_up_to_mm closes it");
  return analysis::domain_of(surface);
}

void bind_grown(py::module_& m) {
  py::class_<GrownTree, std::shared_ptr<GrownTree>>(m, "GrownTree", "What grow_tree made.")
      .def_property_readonly("graph", part(&GrownTree::graph),
                             "VesselGraph: the scanned segments first, as they were")
      .def_property_readonly("order", view(&GrownTree::order), "(m,) int32 of each segment; 0: scanned")
      .def_property_readonly("element", view(&GrownTree::element), "(m,) int32, its element; -1: scanned")
      .def_readonly("elements", &GrownTree::elements, "That were asked for, with those left out.")
      .def_readonly("elements_left_out", &GrownTree::elements_left_out, "That had no room.")
      .def_readonly("elements_shortened", &GrownTree::elements_shortened, "That had too little.")
      .def("__repr__", [](const GrownTree& g) {
        return py::str("<ostia.GrownTree: {} segments, {} elements, {} left out>")
            .format(g.graph.edges.size(), g.elements, g.elements_left_out);
      });
  const std::string text = with_options<GrowthOptions>(
      m, "grow_tree",
      "From the ends of a tree down to the capillaries, by published morphometry of pigs' hearts. domain: a "
      "closed TriMesh in which vessels may grow; a number: the thickness of a spherical shell about the "
      "tree, "
      "mm; a dictionary: base, axis, length_mm, radius_mm, wall_mm, whole of a ventricle; None: the shell.");
  m.def(
      "grow_tree",
      [](const VesselGraph& graph, const py::object& domain, const py::object& progress,
         const py::kwargs& options) {
        const auto how = options_of<GrowthOptions>(options);
        geometry::require_sound(graph, "graph", true);
        const auto where = domain_of(domain, graph);
        return std::make_shared<GrownTree>(watched(
            progress, [&](const auto& task) { return analysis::grow_tree(graph, where, how, task); }));
      },
      py::arg("graph"), py::arg("domain") = py::none(), py::kw_only(), py::arg("progress") = py::none(),
      text.c_str());
}

void bind_overlaps(py::module_& m) {
  const std::string text =
      with_options<OverlapOptions>(m, "find_overlaps",
                                   "Where vessels of a network run into each other: a dictionary a pair of "
                                   "edges: first, second, depth_mm, "
                                   "place (mm).");
  m.def(
      "find_overlaps",
      [](const VesselGraph& graph, const py::object& progress, const py::kwargs& options) {
        const auto how = options_of<OverlapOptions>(options);
        return figures_of(watched(progress, [&](const auto& task) {
          return analysis::find_overlaps(graph, geometry::GraphIncidence(graph), how, task);
        }));
      },
      py::arg("graph"), py::kw_only(), py::arg("progress") = py::none(), text.c_str());
}

}  // namespace

void bind_growth(py::module_& m) {
  bind_grown(m);
  bind_overlaps(m);
}

}  // namespace ostia::python
