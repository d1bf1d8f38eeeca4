// The options that say how a surface is meshed.

#include "mesh/cli_mesh.h"

#include "flow/solver_case.h"
#include "options/shown_defaults.h"
#include "options/validators.h"

#include "ostia/io/mesh_export.h"
#include "ostia/io/volume_mesh_file.h"
#include "ostia/meshing/sizing.h"
#include "ostia/meshing/tetrahedralize.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <algorithm>
#include <string>
#include <vector>

namespace ostia::app {
namespace {

void add_planes(CLI::App& app, MeshOptions& o) {
  app.add_option("--plane", o.planes,
                 "Cuts an end here, [END=]x,y,z:nx,ny,nz, a point inside the lumen and a normal; END is "
                 "inlet_<vessel> or outlet_<vessel>, left out: the nearest; repeat")
      ->allow_extra_args(false);
  app.add_option("--planes", o.planes_file, "The same as a .csv: end,x,y,z,nx,ny,nz");
  app.add_option("--ends", o.ends,
                 "flat: cut across the axis, open ends and caps that are flat stay where they are, the "
                 "default; as-they-are: every open end stays, however it stands; round: led on to a circle")
      ->check(CLI::IsMember({"flat", "as-they-are", "round"}));
  app.add_option(
         "--side-branches", o.side_branches,
         "Blind branches on which no --target lies: closed: they stay so, in the mesh, the default; axes: "
         "each gets an axis and an outlet at its end; stubs: each is cut off a diameter from its mouth, "
         "with an outlet")
      ->check(CLI::IsMember({"closed", "axes", "stubs"}));
}

/// All that a case is told goes with --with-case alone.
void add_with_case(CLI::App& app, MeshOptions& o) {
  CLI::Option* with = app.add_option("--with-case", o.with_case,
                                     "Also a case that a solver runs as it is, in the folder " +
                                         of_all_solvers(&pipeline::SolverTraits::folder, " or ") + ": " +
                                         of_all_solvers(&pipeline::SolverTraits::name, ", ") +
                                         "; the options from --flow to --processes are its own")
                          ->check(CLI::IsMember(solver_names()));
  const std::vector<CLI::Option*> before = app.get_options();
  add_case_options(app, o.solver_case, "--solver-iterations");
  for (CLI::Option* option : app.get_options())
    if (std::ranges::find(before, option) == before.end()) option->needs(with);
}

}  // namespace

std::vector<std::string> mesh_format_names() {
  std::vector<std::string> names;
  for (const io::MeshFormat format : io::mesh_formats) names.emplace_back(io::name_of(format));
  return names;
}

void add_mesh(CLI::App& app, MeshOptions& o) {
  app.add_option("--edge-ratio", o.edge_ratio,
                 "Edge length over the distance to the centerline, 0.02 to 2" +
                     default_text(meshing::SizingOptions().edge_ratio))
      ->check(CLI::Range(0.02, 2.0));
  app.add_option("--size", o.size, "What the edges follow: distance to the centerline, or inscribed radius")
      ->check(CLI::IsMember({"distance", "radius"}));
  app.add_option("--min-edge", o.min_edge_mm, "Shortest edge, mm; left out: no bound")->check(above_zero());
  app.add_option("--max-edge", o.max_edge_mm, "Longest edge, mm; left out: no bound")->check(above_zero());
  app.add_option("--size-radii", o.most_distance_radii,
                 "Bound on the distance to the centerline in inscribed radii, 1 or more, for aneurysms; left "
                 "out: none")
      ->check(CLI::Range(1.0, 100.0));
  app.add_option(
         "--curvature-ratio", o.curvature_ratio,
         "Edge length over the wall's least radius of curvature, 0.02 to 2, for shorter edges in crotches; "
         "left out: not looked at")
      ->check(CLI::Range(0.02, 2.0));
  app.add_option("--stenosis-edges", o.stenosis_share,
                 "Edges at stenoses over those of the vessel, 0.05 to 1; default 1")
      ->check(CLI::Range(0.05, 1.0));
  app.add_option("--volume-size", o.size_factor,
                 "Edges inside over edges of the surface" +
                     default_text(meshing::TetrahedralizeOptions().size_factor))
      ->check(above_zero());
  app.add_option("--inset", o.inset_radii,
                 "How far inside its end a vessel is cut, in radii; default 1, of an image 0.4")
      ->check(zero_or_above());
  app.add_option("--flow-extensions", o.extensions,
                 "Tubes that lead the flow in and out, 0.25 to 100 diameters long; left out: none")
      ->check(CLI::Range(0.25, 100.0));
  app.add_option("--layers", o.layers, "Layers of prisms on the wall, 1 to 20; 0, the default: none")
      ->check(CLI::Range(0, 20));
  app.add_option("--layer-thickness", o.layer_thickness,
                 "Of all layers together, over the wall's local edge, up to 3; default 0.25")
      ->check(CLI::Range(1e-3, 3.0));
  app.add_option("--layer-growth", o.layer_growth,
                 "Thickness of a layer over that of the next nearer the wall, 1 to 3; default 1.2")
      ->check(CLI::Range(1.0, 3.0));
  app.add_flag("--split-prisms", o.split_prisms,
               "The layers' prisms as tetrahedra, for programs that know one kind of element");
  app.add_option("--order", o.order,
                 "Of the elements: 1, the default, or 2 with nodes on the edges, those of the wall on the "
                 "surface as it was before remeshing")
      ->check(CLI::IsMember({1, 2}));
  app.add_option("--export", o.formats, "Formats besides mesh.vtu, separated by commas")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::IsMember(mesh_format_names()));
  app.add_option("--size-array", o.size_array,
                 "Edge lengths, mm: a point array of the surface (.vtp), in place of the vessel's size");
  add_planes(app, o);
  add_with_case(app, o);
}

namespace {

void add_refinement(CLI::App& app, MeshCommand& o) {
  app.add_option(
      "--refine-from", o.refine_from,
      "A solver's result (result.vtu) on an earlier mesh: edges become shorter where its field bends");
  app.add_option("--by", o.refine_by, "Which field of the result, such as velocity_m_s");
  app.add_option("--refine-error", o.refine_error,
                 "Interpolation error that an element may have, over the field's range; default 0.02")
      ->check(CLI::Range(1e-6, 1.0));
  app.add_option("--refine-elements", o.refine_elements,
                 "How many elements are wanted; the error follows from it")
      ->check(CLI::Range(100.0, 1e9));
  app.add_option("--refine-coarsening", o.refine_coarsening,
                 "How much longer edges may become where the field is smooth, 1 to 20 times; default 1")
      ->check(CLI::Range(1.0, 20.0));
}

}  // namespace

void add_mesh_command(CLI::App& app, MeshCommand& o) {
  add_refinement(app, o);
  app.add_option("-o,--output", o.output, "Folder that is made");
  app.add_option("--centerline", o.centerline, "Centerlines; left out: computed");
  app.add_option("--check", o.check,
                 "Only judges a surface or a volume mesh: " + io::readable_volume_meshes());
  app.add_flag(
      "--forecast", o.forecast,
      "Only tells where the surface would fail or come out poor with these sizes and layers, and the "
      "way out");
  app.add_flag("--json", o.json, "One JSON object on standard output");
}

}  // namespace ostia::app
