#include "call.h"
#include "figures.h"
#include "options.h"
#include "pipeline_parts.h"
#include "values.h"
#include "volume.h"

#include "ostia/analysis/graph_report.h"
#include "ostia/core/error.h"
#include "ostia/core/log.h"
#include "ostia/geometry/branch_groups.h"
#include "ostia/geometry/graph_faults.h"
#include "ostia/geometry/graph_tree.h"
#include "ostia/pipeline/branch_report.h"
#include "ostia/pipeline/skeleton.h"
#include "ostia/pipeline/tree_report.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

namespace ostia::python {

using centerline::EndOptions;
using centerline::GapOptions;
using centerline::JunctionOptions;
using centerline::OrientOptions;
using centerline::PruneOptions;
using centerline::SectionOptions;
using centerline::SkeletonNodeKind;
using centerline::SkeletonSection;
using centerline::SplineOptions;
using pipeline::SkeletonCommands;
using pipeline::SkeletonOptions;

template <>
struct WordsOf<SkeletonNodeKind> {
  static constexpr std::pair<const char*, SkeletonNodeKind> words[] = {
      {"point", SkeletonNodeKind::point},
      {"end", SkeletonNodeKind::end},
      {"passage", SkeletonNodeKind::passage},
      {"junction", SkeletonNodeKind::junction},
      {"loop_anchor", SkeletonNodeKind::loop_anchor}};
};
OSTIA_OPTIONS(PruneOptions, (length_mm, junction_radii, isolated), ())
OSTIA_OPTIONS(EndOptions, (trimmed_radii, direction_mm, most_radii, most_voxels), ())
OSTIA_OPTIONS(JunctionOptions, (trimmed_radii, direction_mm, most_radii), ())
OSTIA_OPTIONS(GapOptions, (distance_mm, angle_deg, direction_mm), ())
OSTIA_OPTIONS(OrientOptions, (snap_mm, guess), ())
OSTIA_OPTIONS(SplineOptions, (knot_spacing_mm, step_mm), ())
OSTIA_OPTIONS(SectionOptions,
              (sigma_mm, rays, largest_radius_mm, direction_mm, relevant, recentre, move_points, correct_blur,
               image_blur_mm),
              ())
OSTIA_OPTIONS(SkeletonCommands, (cuts, removals), (connections))  // pairs, by the keyword connections
OSTIA_OPTIONS(SkeletonOptions,
              (fill_cavities, prune, open_loops, ends, gaps, commands, orient, smooth, settle, sections,
               step_mm, inlets),
              ())
OSTIA_FIGURES(SkeletonSection,
              (centre, normal, radius_mm, ellipse_centre, major_axis, semi_major_mm, semi_minor_mm, support,
               measured),
              ())

namespace {

namespace fs = std::filesystem;
using core::TaskContext;
using geometry::TriMesh;
using geometry::VesselGraph;
using geometry::VesselTree;
using pipeline::MeasuredTree;
using pipeline::SkeletonResult;
using py::literals::operator""_a;

/// Nodes and lines of a skeleton, as they are.
py::dict lines_of(const SkeletonResult& result) {
  py::list nodes, lines;
  for (const auto& node : result.skeleton.graph.nodes)
    nodes.append(py::dict("id"_a = node.id, "position"_a = tuple_of(node.position),
                          "kind"_a = detail::word_of(node.kind), "radius_mm"_a = node.radius_mm));
  for (const auto& edge : result.skeleton.graph.edges)
    lines.append(py::dict("id"_a = edge.id, "start"_a = edge.from, "end"_a = edge.to,
                          "points"_a = array_of(edge.points), "radius_mm"_a = array_of(edge.radius_mm)));
  return py::dict("nodes"_a = nodes, "lines"_a = lines);
}

std::vector<std::pair<geometry::Vec3, geometry::Vec3>> pairs_of(const py::sequence& given) {
  std::vector<std::pair<geometry::Vec3, geometry::Vec3>> pairs;
  for (const py::handle one : given) {
    const std::string name = "connections[" + std::to_string(pairs.size()) + "]";
    const auto places = places_of(py::reinterpret_borrow<py::object>(one), name);
    if (places.size() != 2) throw InvalidInput(name + ": two places, from and to");
    pairs.emplace_back(places[0], places[1]);
  }
  return pairs;
}

void bind_skeleton(py::module_& m) {
  py::class_<SkeletonResult, std::shared_ptr<SkeletonResult>>(m, "Skeleton", "What skeleton_of found.")
      .def_property_readonly(
          "tree",
          [](const py::object& self) { return part_of(self.cast<SkeletonResult&>().tree.tree, self); },
          "VesselTree, its loops opened")
      .def_property_readonly("graph", &lines_of,
                             "The lines with their loops: nodes and lines, a dictionary each; points (n, 3), "
                             "radius_mm (n,)")
      .def_property_readonly(
          "sections",
          [](const SkeletonResult& r) {
            py::list lines;
            for (const auto& sections : r.skeleton.sections) lines.append(figures_of(sections));
            return lines;
          },
          "Of each line a dictionary a point: circle and ellipse across it, mm")
      .def_property_readonly(
          "sections_csv", [](const SkeletonResult& r) { return pipeline::sections_csv(r.skeleton); },
          "The same as a table")
      .def_readonly("object_voxels", &SkeletonResult::object_voxels, "Of the mask.")
      .def_readonly("skeleton_voxels", &SkeletonResult::skeleton_voxels, "After thinning.")
      .def_readonly("components", &SkeletonResult::components, "Connected parts.")
      .def_readonly("loops", &SkeletonResult::loops, "Independent ones.")
      .def_readonly("length_mm", &SkeletonResult::length_mm, "Of all lines, mm.")
      .def_readonly("warnings", &SkeletonResult::warnings, "What a person should know.")
      .def("__repr__", [](const SkeletonResult& r) {
        return py::str("<ostia.Skeleton: {} lines, {:.4g} mm, {} loops>")
            .format(r.skeleton.graph.edges.size(), r.length_mm, r.loops);
      });
  const std::string text = with_options<SkeletonOptions>(
      m, "skeleton_of",
      "Centerlines of a mask (uint8) by thinning, with loops seen and radii of circles and ellipses; image: "
      "the CT that it was made of, for the radii. connections: pairs of places, (2, 3), mm, joined by "
      "straight "
      "lines.");
  m.def(
      "skeleton_of",
      [](const AnyVolume& mask, const AnyVolume* image, const py::sequence& connections,
         const py::object& progress, const py::kwargs& options) {
        auto how = options_of<SkeletonOptions>(options);
        how.commands.connections = pairs_of(connections);
        const imaging::MaskVolume& voxels = mask.mask("mask");
        const imaging::ImageVolume* ct = image != nullptr ? &image->image("image") : nullptr;
        return std::make_shared<SkeletonResult>(watched(
            progress, [&](const TaskContext& task) { return pipeline::skeleton_of(voxels, ct, how, task); }));
      },
      py::arg("mask"), py::arg("image") = py::none(), py::kw_only(), py::arg("connections") = py::list(),
      py::arg("progress") = py::none(), text.c_str());
}

/// Columns by name, (rows,) each.
py::dict columns_of(const analysis::GraphTable& table) {
  py::dict columns;
  for (const auto& column : table.columns) {
    py::array_t<double> values(static_cast<py::ssize_t>(table.rows));
    double* to = values.mutable_data();
    for (std::size_t row = 0; row < table.rows; ++row) *to++ = column.value(row);
    columns[column.name.c_str()] =
        column.whole ? py::object(values.attr("astype")("int64")) : py::object(std::move(values));
  }
  return columns;
}

py::dict tables_of(const MeasuredTree& tree) {
  py::dict tables;
  for (const auto& table : analysis::tree_tables(tree.graph, tree.report))
    tables[table.name.c_str()] = columns_of(table);
  return tables;
}

void bind_measured(py::module_& m) {
  py::class_<MeasuredTree, std::shared_ptr<MeasuredTree>>(m, "MeasuredTree", "What measure_tree found.")
      .def_property_readonly(
          "measures", [](const MeasuredTree& t) { return json_of(pipeline::tree_measures_json(t)); },
          "Totals, orders, scaling laws, angles, overlaps, as measures.json has them; mm")
      .def_property_readonly("tables", &tables_of,
                             "segments, branches, orders, connectivity, forks: each a dictionary of columns, "
                             "(m,) arrays with units in their names, for pandas.DataFrame")
      .def_property_readonly("graph", part(&MeasuredTree::graph), "VesselGraph that was measured")
      .def("__repr__", [](const MeasuredTree& t) {
        return py::str("<ostia.MeasuredTree: {} segments, {:.6g} mm>")
            .format(t.graph.edges.size(), t.report.total.length_mm);
      });
  m.def(
      "measure_tree",
      [](const py::object& of, const py::object& progress) {
        const auto* graph = py::isinstance<VesselGraph>(of) ? of.cast<const VesselGraph*>() : nullptr;
        const auto* tree = py::isinstance<VesselTree>(of) ? of.cast<const VesselTree*>() : nullptr;
        if (graph == nullptr && tree == nullptr) refuse_call("of: a VesselGraph or a VesselTree");
        return std::make_shared<MeasuredTree>(watched(progress, [&](const TaskContext& task) {
          VesselGraph measured = graph != nullptr ? *graph : geometry::graph_of(*tree);
          geometry::require_sound(measured, "of", true, task);
          return pipeline::measured(std::move(measured), task);
        }));
      },
      py::arg("of"), py::kw_only(), py::arg("progress") = py::none(),
      "Lengths, areas, volumes, orders, angles, scaling laws and overlaps of a tree, of millions of segments "
      "perhaps.");
  m.def(
      "measure_branches",
      [](const VesselTree& tree, const TriMesh* wall, bool bifurcations, bool sections, int section_spheres,
         const std::optional<double>& patch_length_mm, int patch_sectors, const py::object& progress) {
        pipeline::BranchReportOptions how;
        how.bifurcations = bifurcations;
        how.sections = sections;
        how.section.spheres_apart = section_spheres;
        if (patch_length_mm) how.patches = analysis::PatchOptions{*patch_length_mm, patch_sectors};
        std::optional<pipeline::BranchWall> of_wall;
        if (wall != nullptr) of_wall = pipeline::BranchWall{*wall, {}};
        return json_of(watched(progress, [&](const TaskContext& task) {
          const auto report = pipeline::measured_branches(geometry::branch_groups(tree), of_wall, how, task);
          for (const std::string& warning : report.warnings) core::log_warning(warning);
          return pipeline::branch_measures_json(report);
        }));
      },
      py::arg("tree"), py::arg("wall") = py::none(), py::kw_only(), py::arg("bifurcations") = true,
      py::arg("sections") = false, py::arg("section_spheres") = 1, py::arg("patch_length_mm") = py::none(),
      py::arg("patch_sectors") = 1, py::arg("progress") = py::none(),
      "Branches and bifurcations of a tree by their inscribed spheres, and sections and patches of its wall "
      "(a "
      "TriMesh, mm), as branches.json has them.");
}

}  // namespace

void bind_pipeline_trees(py::module_& m) {
  bind_skeleton(m);
  bind_measured(m);
}

}  // namespace ostia::python
