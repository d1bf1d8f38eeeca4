#include "ostia/experiments/vessel_chain_report.h"

#include "ostia/core/files.h"
#include "ostia/core/text.h"
#include "ostia/evaluation/distance_picture.h"
#include "ostia/figure/html_report.h"
#include "ostia/figure/scene.h"
#include "ostia/io/graph_file.h"
#include "ostia/io/quad_surface_file.h"
#include "ostia/io/surface_file.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace ostia::experiments {
namespace fs = std::filesystem;
namespace {

using core::fixed_text;
using Json = nlohmann::ordered_json;

Json json_of(const std::vector<Vec3>& places) {
  Json out = Json::array();
  for (const Vec3& p : places) out.push_back({p.x(), p.y(), p.z()});
  return out;
}

Json json_of(const ChainMesh& mesh) {
  return {{"sides", mesh.sides}, {"spacing", mesh.spacing}, {"level", mesh.level}};
}

Json json_of(const ChainSurface& s) {
  Json out = json_of(s.how);
  out["triangles"] = s.triangles;
  out["share"] = s.share;
  out["rms_sd_mm"] = s.apart.rms_sd_mm;
  out["msd_mm"] = s.apart.msd_mm;
  out["hd95_mm"] = s.apart.hd95_mm;
  out["hausdorff_mm"] = s.apart.max_sd_mm;
  out["signed_mean_mm"] = s.apart.signed_mean_mm;
  out["closed"] = s.closed;
  out["self_intersections"] = s.self_intersections;
  return out;
}

std::string rows_of(const ChainResult& result) {
  std::string text =
      "sides,spacing,level,triangles,share,rms_sd_mm,msd_mm,hd95_mm,hausdorff_mm,signed_mean_mm,closed,self_"
      "intersections\n";
  for (const ChainSurface& s : result.surfaces) {
    text += std::to_string(s.how.sides) + "," + fixed_text(s.how.spacing, 2) + "," +
            std::to_string(s.how.level) + "," + std::to_string(s.triangles) + "," + fixed_text(s.share, 5);
    for (const double d :
         {s.apart.rms_sd_mm, s.apart.msd_mm, s.apart.hd95_mm, s.apart.max_sd_mm, s.apart.signed_mean_mm})
      text += "," + fixed_text(d, 4);
    text += std::string(s.closed ? ",yes," : ",no,") + std::to_string(s.self_intersections) + "\n";
  }
  return text;
}

/// The one that is shown.
const ChainSurface& shown(const ChainResult& result) {
  const ChainSurface* few = nearest_within(result, chain_share);
  return few != nullptr ? *few : *nearest_within(result, INFINITY);
}

/// Distances beyond this have the last colour, as in the paper.
constexpr double farthest_shown_mm = 3.0;

/// Blue, green, red, as the paper's figure 6 has them.
figure::Color distance_color(double t) {
  const double x = std::clamp(t, 0.0, 1.0);
  const double up = std::min(1.0, 2.0 * x), down = std::max(0.0, 2.0 * x - 1.0);
  return {down + 0.15 * (1.0 - down), 0.25 + 0.6 * (up - down), 0.9 * (1.0 - up) + 0.1, 1.0};
}

figure::Picture isosurface_panel(const ChainResult& result, const ChainSurface& surface,
                                 const figure::Camera& camera, const figure::RenderOptions& how,
                                 const core::TaskContext& task) {
  const std::vector<double> distance =
      evaluation::signed_distances(surface.made.surface.mesh, result.isosurface, task.sub(0.0, 0.3));
  figure::MeshActor actor;
  actor.mesh = result.isosurface;
  for (const double d : distance)
    actor.triangle_colors.push_back(distance_color(std::abs(d) / farthest_shown_mm));
  figure::RenderOptions options = how;
  options.title = "isosurface, " + std::to_string(result.isosurface.triangles.size()) +
                  " triangles; distance 0 (blue) to 3 mm (red)";
  figure::Scene scene;
  scene.meshes.push_back(std::move(actor));
  return figure::scene_figure(scene, camera, options, task.sub(0.3, 1.0));
}

/// Two triangles a quadrilateral, such that the edge between them is not drawn.
figure::MeshActor actor_of(const reconstruction::ReconstructedSurface& made) {
  figure::MeshActor actor;
  actor.mesh.points = made.points;
  for (const geometry::Quad& q : made.quads) {
    actor.mesh.triangles.push_back({q[0], q[1], q[2]});
    actor.mesh.triangles.push_back({q[2], q[3], q[0]});
  }
  actor.half_of_quad.assign(actor.mesh.triangles.size(), true);
  actor.edges = true;
  actor.edge_width_px = 0.6;
  return actor;
}

figure::Picture surface_panel(const ChainSurface& surface, const figure::Camera& camera,
                              const figure::RenderOptions& how, const core::TaskContext& task) {
  figure::RenderOptions options = how;
  options.title = "level " + std::to_string(surface.how.level) + ", " + std::to_string(surface.triangles) +
                  " triangles (" + fixed_text(100.0 * surface.share, 1) +
                  " %): " + fixed_text(surface.apart.rms_sd_mm, 2) + " mm RMS";
  figure::Scene scene;
  scene.meshes.push_back(actor_of(surface.made));
  return figure::scene_figure(scene, camera, options, task);
}

figure::Picture figure_of(const ChainResult& result, const core::TaskContext& task) {
  const ChainSurface &few = shown(result), &best = *nearest_within(result, INFINITY);
  const figure::Camera camera = figure::cameras::broadside(result.isosurface.points);
  figure::RenderOptions how;
  how.width_px = 620;
  how.height_px = 760;
  how.look = figure::Look::light;
  std::vector<figure::Picture> panels{isosurface_panel(result, few, camera, how, task.sub(0.0, 0.4)),
                                      surface_panel(few, camera, how, task.sub(0.4, 0.7))};
  if (&best != &few) panels.push_back(surface_panel(best, camera, how, task.sub(0.7, 1.0)));
  return figure::grid(panels, {.look = figure::Look::light});
}

void write_models(const fs::path& folder, const ChainResult& result) {
  io::write_surface(folder / "isosurface.vtp", result.isosurface);
  io::write_graph(folder / "network.vtp", result.network);
  const reconstruction::ReconstructedSurface& made = shown(result).made;
  io::write_quad_surface(folder / "reconstructed.vtp",
                         {made.points, made.quads, made.branch_of_quad, {}, {}});
}

}  // namespace

std::string parameters_json(const ChainOptions& o, const std::vector<Vec3>& seeds,
                            const std::vector<Vec3>& rivals) {
  Json out{{"seeds", json_of(seeds)},
           {"rivals", json_of(rivals)},
           {"least_hu", o.growth.least_hu},
           {"snap_mm", o.growth.snap_mm},
           {"diffusion_iterations", o.diffusion_iterations},
           {"thinnest_mm", o.thinnest_mm},
           {"curvature", o.curvature},
           {"iterations", o.iterations},
           {"prune_mm", o.prune_mm},
           {"gap_mm", o.gap_mm},
           {"sigma_mm", o.sigma_mm},
           {"knots_mm", o.knots_mm},
           {"elliptic", o.elliptic}};
  out["meshes"] = Json::array();
  for (const ChainMesh& mesh : o.meshes) out["meshes"].push_back(json_of(mesh));
  return out.dump();
}

std::string chain_json(const ChainResult& r, const ChainOptions& options, const std::vector<Vec3>& seeds,
                       const std::vector<Vec3>& rivals) {
  Json out{{"v", 1}, {"kind", "chain"}};
  out["parameters"] = Json::parse(parameters_json(options, seeds, rivals));
  out["own_voxels"] = r.own_voxels;
  out["rival_voxels"] = r.rival_voxels;
  out["vessel_hu"] = r.vessel_hu;
  out["background_hu"] = r.background_hu;
  out["iterations"] = r.iterations;
  out["isosurface_triangles"] = r.isosurface.triangles.size();
  out["lines"] = r.lines;
  out["components"] = r.components;
  out["loops"] = r.loops;
  out["length_mm"] = r.length_mm;
  out["surfaces"] = Json::array();
  for (const ChainSurface& s : r.surfaces) out["surfaces"].push_back(json_of(s));
  return out.dump(1) + "\n";
}

std::string chain_text(const ChainResult& r) {
  std::string text = std::to_string(r.lines) + " lines, " + fixed_text(r.length_mm, 0) + " mm, " +
                     std::to_string(r.components) + " part(s), " + std::to_string(r.loops) +
                     " loop(s); isosurface of " + std::to_string(r.isosurface.triangles.size()) +
                     " triangles\n"
                     "sides  spacing  level  triangles  share  RMS distance  Hausdorff  closed  crossings\n";
  for (const ChainSurface& s : r.surfaces) {
    char line[160];
    std::snprintf(line, sizeof line, "%5d %8.1f %6d %10zu %4.1f %% %10.3f mm %7.2f mm %7s %10zu\n",
                  s.how.sides, s.how.spacing, s.how.level, s.triangles, 100.0 * s.share, s.apart.rms_sd_mm,
                  s.apart.max_sd_mm, s.closed ? "yes" : "no", s.self_intersections);
    text += line;
  }
  return text;
}

void write_chain_report(const fs::path& folder, const ChainResult& result, const core::TaskContext& task) {
  core::write_file(folder / "surfaces.csv", rows_of(result));
  write_models(folder, result);
  const figure::Picture picture = figure_of(result, task);
  picture.write_png(folder / "figure.png", 2.0);
  figure::HtmlReport page("From a scan to a surface of quadrilaterals", "The whole chain on one scan");
  page.paragraph(std::to_string(result.lines) + " vessels, " + fixed_text(result.length_mm, 0) +
                 " mm of them, in " + std::to_string(result.components) +
                 " part(s). Distances go both ways between the isosurface and what is reconstructed from its "
                 "skeleton, ends and joints included.");
  page.picture(
      picture,
      "The isosurface, coloured by its distance from the next surface; that; and the nearest of all.");
  std::vector<std::vector<std::string>> rows;
  for (const ChainSurface& s : result.surfaces)
    rows.push_back({std::to_string(s.how.sides), fixed_text(s.how.spacing, 1), std::to_string(s.how.level),
                    std::to_string(s.triangles), fixed_text(100.0 * s.share, 1),
                    fixed_text(s.apart.rms_sd_mm, 3), fixed_text(s.apart.hd95_mm, 2),
                    fixed_text(s.apart.max_sd_mm, 2), s.closed ? "yes" : "no",
                    std::to_string(s.self_intersections)});
  page.table({"sides", "spacing", "level", "triangles", "% of the isosurface's", "RMS distance", "95 %",
              "Hausdorff", "closed", "self-intersections"},
             rows, "Distances in mm; spacing is half the distance of sections in radii.");
  page.write(folder / "report.html");
}

}  // namespace ostia::experiments
