#include "options/validators.h"
#include "output/outputs.h"
#include "tree/reconstruct.h"
#include "tree/tree_input.h"

#include "ostia/core/error.h"
#include "ostia/core/log.h"
#include "ostia/geometry/graph_faults.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/io/hex_mesh_file.h"
#include "ostia/io/quad_surface_file.h"
#include "ostia/io/surface_fields.h"
#include "ostia/io/surface_file.h"
#include "ostia/reconstruction/frusta.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <nlohmann/json.hpp>

#include <cstdio>
#include <string>
#include <utility>

namespace ostia::app {
namespace {

using Json = nlohmann::ordered_json;
using reconstruction::ReconstructedSurface;

void warn(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) core::log_warning(warning);
}

geometry::VesselGraph network_of(const ReconstructCommand& c, Json& done, const core::TaskContext& task) {
  task.set_stage("reading");
  io::LoadedGraph loaded = read_tree(c.input, c.tree, done, task.sub(0.0, 0.9));
  if (!c.tree.repair) join_lines_side_by_side(loaded, task.sub(0.9, 1.0));
  geometry::require_sound(loaded.graph, c.input.input.filename().string(), false, task,
                          loaded.reference_name);
  const geometry::GraphFacts facts = geometry::facts_of(loaded.graph, task.sub(0.9, 1.0));
  if (facts.least_radius_mm * static_cast<double>(facts.branches) > facts.length_mm)
    core::log_warning(
        "its branches are shorter on average than the least radius: are radii and places in different "
        "units? --units m --radius-units mm settles it");
  done["segments"] = facts.segments;
  done["branches"] = facts.branches;
  return std::move(loaded.graph);
}

/// Around the network with circles of its radii, or with elliptic sections as `--wall` has them.
ReconstructedSurface surface_of(const ReconstructCommand& c, const geometry::VesselGraph& graph,
                                const reconstruction::ReconstructionOptions& options, Json& done,
                                const core::TaskContext& task) {
  if (c.wall.empty()) return reconstruction::reconstruct_surface(graph, options, task);
  const geometry::TriMesh wall = io::read_surface(c.wall).surface.mesh;
  const reconstruction::FittedSections fit =
      reconstruction::fit_elliptic_sections(graph, wall, {}, task.sub(0.0, 0.3));
  if (fit.used == 0)
    throw InvalidInput(
        c.wall.filename().string() + ": of " + std::to_string(fit.cut) +
        " sections across the vessels none is closed, elliptic and of about the tree's radius: "
        "--wall must be a surface in millimetres around this tree");
  done["sections"] = {{"cut", fit.cut}, {"used", fit.used}};
  return reconstruction::reconstruct_surface(fit.graph, fit.sections, options, task.sub(0.3, 1.0));
}

void tell(const ReconstructedSurface& made, Json& done) {
  const geometry::SurfaceFaults faults = geometry::find_faults(made.surface.mesh, false);
  done["points"] = made.points.size();
  done["quads"] = made.quads.size();
  done["open_edges"] = faults.open_edges;
  done["non_manifold_edges"] = faults.non_manifold_edges;
  done["self_intersections"] = made.self_intersections;
  done["closed"] = faults.closed_manifold() && made.self_intersections == 0;
  done["volume_mm3"] = geometry::volume(made.surface.mesh);
  done["narrowed"] = Json::array();
  for (const reconstruction::Narrowing& n : made.narrowed)
    done["narrowed"].push_back({{"branch", n.branch}, {"radius_factor", n.radius_factor}});
  done["moved"] = made.moved;
}

void print_reconstructed(const Json& done, bool as_json) {
  if (as_json) {
    std::fputs((done.dump(2) + "\n").c_str(), stdout);
  } else if (done.contains("triangles")) {
    std::printf("%zu segments; %zu triangles of truncated cones\n", done["segments"].get<std::size_t>(),
                done["triangles"].get<std::size_t>());
  } else {
    std::printf("%zu branches; level %d, %zu quadrilaterals, %s\n", done["branches"].get<std::size_t>(),
                done["level"].get<int>(), done["quads"].get<std::size_t>(),
                done["closed"].get<bool>() ? "closed" : "not closed");
    std::printf("self-intersections: %zu; branches narrowed: %zu, moved: %zu\n",
                done["self_intersections"].get<std::size_t>(), done["narrowed"].size(), done["moved"].size());
    if (done.contains("hexahedra"))
      std::printf("%zu hexahedra; scaled Jacobian at least %.3f, in the mean %.3f; folded: %zu\n",
                  done["hexahedra"]["count"].get<std::size_t>(),
                  done["hexahedra"]["least_scaled_jacobian"].get<double>(),
                  done["hexahedra"]["mean_scaled_jacobian"].get<double>(),
                  done["hexahedra"]["folded"].get<std::size_t>());
    if (done.contains("sections"))
      std::printf("elliptic sections: %zu cut, %zu used\n", done["sections"]["cut"].get<std::size_t>(),
                  done["sections"]["used"].get<std::size_t>());
  }
}

/// The mesh within, if asked for; whether it can be used.
bool write_hexahedra(const ReconstructCommand& c, const ReconstructedSurface& made, Json& done,
                     const core::TaskContext& task) {
  if (c.hexahedra.empty()) return true;
  task.set_stage("sweeping");
  const reconstruction::SweptHexahedra swept =
      reconstruction::sweep_hexahedra(made, c.sweep, task.sub(0.0, 0.8));
  io::write_hex_mesh(c.hexahedra, swept.mesh, task.sub(0.8, 1.0));
  done["hexahedra"] = {{"count", swept.mesh.hexahedra.size()},
                       {"points", swept.mesh.points.size()},
                       {"volume_mm3", swept.volume_mm3},
                       {"least_scaled_jacobian", swept.least_jacobian},
                       {"mean_scaled_jacobian", swept.mean_jacobian},
                       {"folded", swept.folded}};
  if (swept.folded > 0)
    core::log_warning(
        std::to_string(swept.folded) + " of " + std::to_string(swept.mesh.hexahedra.size()) +
        " hexahedra are folded, as where a thin branch leaves at a small angle: no solver takes "
        "them; try --sides 4, another --level, or `ostia mesh` on the surface");
  return swept.folded == 0;
}

ExitCode write_frusta(const ReconstructCommand& c, Json& done, const core::TaskContext& task) {
  reconstruction::FrustaOptions options;
  options.sides = c.sides.value_or(options.sides);
  const geometry::VesselGraph graph = network_of(c, done, task.sub(0.0, 0.3));
  const reconstruction::FrustaMesh made = reconstruction::frusta(graph, options, task.sub(0.3, 0.8));
  if (!has_extension(c.output, {".vtp"})) {
    io::write_surface(c.output, made.mesh);
    core::log_warning("normals and texture coordinates are left out: .vtp holds them");
  } else {
    io::PointFields fields{{"Normals", {3, {}}}, {"TextureCoordinates", {2, {}}}};
    for (const geometry::Vec3& n : made.normals)
      fields["Normals"].values.insert(fields["Normals"].values.end(), {n.x(), n.y(), n.z()});
    for (const geometry::Vec2& t : made.texture)
      fields["TextureCoordinates"].values.insert(fields["TextureCoordinates"].values.end(), {t.x(), t.y()});
    io::write_vtp_with_fields(c.output, {made.mesh, {}, {}}, fields);
  }
  done["points"] = made.mesh.points.size();
  done["triangles"] = made.mesh.triangles.size();
  print_reconstructed(done, c.json);
  return ExitCode::ok;
}

}  // namespace

ExitCode run_reconstruct(const ReconstructCommand& c, const core::TaskContext& task) {
  require_output(c.output, c.frusta ? surface_outputs : quad_outputs);
  reconstruction::ReconstructionOptions options = c.options;
  options.sides = c.sides.value_or(options.sides);
  if (!c.frusta && options.sides % 2 != 0)
    throw UsageError("--sides: " + std::to_string(options.sides) + " is odd; sections have an even number");
  Json done{{"v", 1}, {"kind", c.frusta ? "frusta" : "reconstruction"}};
  if (c.frusta) return write_frusta(c, done, task);
  reconstruction::validate(options);
  reconstruction::validate(c.sweep);
  if (!c.hexahedra.empty() && options.level < 1)
    throw UsageError("--hexahedra: sections of level 0 have no middle of a side; give --level 1 or more");
  if (c.hexahedra.has_extension()) require_output(c.hexahedra, {".vtu"});
  const geometry::VesselGraph graph = network_of(c, done, task.sub(0.0, 0.1));
  task.set_stage("reconstructing");
  ReconstructedSurface made = surface_of(c, graph, options, done, task.sub(0.1, 0.8));
  done["level"] = options.level;
  tell(made, done);
  const bool usable = write_hexahedra(c, made, done, task.sub(0.8, 0.9));
  task.set_stage("writing");
  warn(io::write_quad_surface(
      c.output, io::quads_of_pairs(made.surface, std::move(made.points), std::move(made.branch_of_quad)),
      task.sub(0.9, 1.0)));
  print_reconstructed(done, c.json);
  if (done["closed"].get<bool>()) return usable ? ExitCode::ok : ExitCode::quality_failed;
  core::log_warning("pairs of triangles that still cross: " + done["self_intersections"].dump() +
                    "; vessels that overlap need more rounds (--untangling), or other radii");
  return ExitCode::quality_failed;
}

void define_reconstruct(CLI::App& app, ReconstructCommand& c,
                        std::function<ExitCode(const core::TaskContext&)>& run) {
  reconstruction::ReconstructionOptions& o = c.options;
  CLI::App* sub = app.add_subcommand(
      "reconstruct", "A smooth closed surface of quadrilaterals around a tree or another network of vessels");
  sub->footer(
      "Example:\n  ostia reconstruct tree.vtp -o surface.vtp --level 2\n"
      "  ostia reconstruct tree.vtp -o surface.vtp --sides 4 --level 2 --hexahedra case\n"
      "  ostia reconstruct grown.vtk -o cones.vtp --frusta --units m --radius-units mm");
  sub->fallthrough();
  sub->add_option("TREE", c.input.input, "Network of vessels: .vtp, .vtk, .swc, .csv, .gxl")->required();
  sub->add_option("-o,--output", c.output, ".vtp, .vtk, .ply or .obj; .stl as triangles")->required();
  sub->add_option("--units", c.input.units, "Unit of length of the tree")
      ->check(CLI::IsMember({"m", "cm", "mm"}));
  sub->add_flag("--repair", c.tree.repair,
                "Drop bad segments, join equal points, fill missing radii in, turn and order the segments");
  add_tree_input(*sub, c.tree, "", "Repair: ");
  CLI::Option* level =
      sub->add_option("--level", o.level, "Subdivisions; each makes four of one")->check(CLI::Range(0, 3));
  sub->add_option("--sides", c.sides, "Of a cross-section before any subdivision; 8. Cones: 12")
      ->check(CLI::Range(4, 32));
  CLI::Option* frusta = sub->add_flag(
      "--frusta", c.frusta, "Truncated cones along smooth axes instead, which overlap at forks: to draw");
  const auto own = [frusta](CLI::Option* option) { frusta->excludes(option); };
  own(level);
  own(sub->add_option("--wall", c.wall,
                      "Surface around the tree, in mm: sections are ellipses as it has them, not circles"));
  own(sub->add_option("--spacing", o.spacing, "Half the distance of sections, in radii")
          ->check(CLI::Range(0.1, 10.0)));
  own(sub->add_option("--bending", o.bending, "How much closer sections are in bends")
          ->check(CLI::Range(0.0, 100.0)));
  own(sub->add_option("--lambda", o.lambda, "Weight of angles against radii where a vessel goes on at a fork")
          ->check(CLI::Range(0.0, 1.0)));
  own(sub->add_option("--blend", o.blend, "Rounding of the crotches, in radii of the thinner vessel")
          ->check(CLI::Range(0.0, 1.0)));
  own(sub->add_option("--untangling", o.untangling, "Rounds in which vessels that overlap are narrowed")
          ->check(CLI::Range(0, 200)));
  own(sub->add_option("--hexahedra", c.hexahedra,
                      "Also hexahedra swept along the vessels: .vtu, or a folder for OpenFOAM"));
  own(sub->add_option("--layers", c.sweep.layers, "Of hexahedra along the wall; default 2^(level - 1)")
          ->check(CLI::Range(1, 32)));
  own(sub->add_option("--layer-growth", c.sweep.growth, "From layer to layer, away from the wall")
          ->check(CLI::Range(1.0, 2.0)));
  sub->add_flag("--json", c.json, "One JSON object on standard output");
  sub->callback(
      [&c, &run] { run = [&c](const core::TaskContext& task) { return run_reconstruct(c, task); }; });
}

}  // namespace ostia::app
