// Flow extensions of a shape, or of a surface file: the lumen, what was added, the axes, and what was
// measured.

#include "extension_shapes.h"
#include "picture.h"

#include "ostia/centerline/extract_centerlines.h"
#include "ostia/figure/scene.h"
#include "ostia/geometry/aabb_tree.h"
#include "ostia/meshing/caps.h"
#include "ostia/meshing/flow_extension.h"
#include "ostia/meshing/quality.h"
#include "ostia/meshing/remesh.h"
#include "ostia/phantom/phantom_case.h"
#include "ostia/phantom/vessel_field.h"
#include "ostia/pipeline/repair.h"
#include "ostia/pipeline/source.h"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <utility>

namespace {

using namespace ostia;
using geometry::Vec3;

struct Input {
  geometry::TriMesh lumen;
  geometry::VesselTree tree;
  meshing::FlowExtensionOptions options;
};

Input of_shape(const geometry::AnalyticShape& shape, double spacing_mm) {
  return {geometry::raw_surface_of(shape, spacing_mm, false), meshing::tree_of(shape), {}};
}

Input phantom_tree(std::uint64_t seed) {
  phantom::CaseOptions options;
  options.seed = seed;
  const phantom::CasePlan plan = phantom::plan_case(options);
  return {phantom::tree_surface(phantom::VesselField(plan.tree), phantom::Boundary::lumen, 0.2),
          phantom::vessel_tree(plan.tree),
          {}};
}

Input made(const std::string& what) {
  if (what == "sections") {  // 3:1 and hollow on one side; one end bent
    meshing::OpenTube tube = meshing::tube_of_section(meshing::kidney, 40, 6.0, 1.0);
    Input input{std::move(tube.mesh), std::move(tube.tree), {}};
    input.options.bend_deg = 60.0;
    input.options.bend_towards = Vec3::UnitX();
    return input;
  }
  if (what == "fork") return of_shape(geometry::y_junction(6.0, 10.0, 2.0, 1.4, 60.0), 0.25);
  if (what == "coronary") return of_shape(geometry::coronary_like_tree(), 0.25);
  if (what.starts_with("phantom")) return phantom_tree(std::stoull(what.substr(7)));
  pipeline::Source source = pipeline::load(what);
  Input input;
  input.lumen = pipeline::repaired(source.surface).mesh;
  input.tree = centerline::extract_centerlines(input.lumen, std::nullopt, {}).tree;
  return input;
}

void tell(const meshing::ExtendedEnds& out, double seconds) {
  for (const meshing::FlowExtension& e : out.extensions)
    std::printf(
        "%s: diameter %.2f, length %.2f of %.2f mm, bend %.0f, area %.4f and %.4f mm2, seam %.1f degrees\n",
        e.end.c_str(), e.diameter_mm, e.length_mm, e.wanted_length_mm, e.bend_deg, e.section_area_mm2,
        e.end_area_mm2, e.seam_angle_deg);
  for (const std::string& warning : out.warnings) std::printf("warning: %s\n", warning.c_str());
  const auto quality = meshing::surface_quality(out.surface.mesh);
  std::printf("%zu triangles, %zu self-intersections, %.2f s\n", quality.triangles,
              quality.self_intersections, seconds);
}

void draw(const meshing::ExtendedEnds& out, const geometry::TriMesh& lumen, const figure::Camera& camera,
          const std::string& file) {
  const geometry::AabbTree before(lumen);
  figure::MeshActor vessel, added;
  vessel.label = "lumen";
  added.label = "extensions";
  added.color = figure::colors::cut;
  vessel.mesh.points = added.mesh.points = out.surface.mesh.points;
  for (const geometry::Triangle& t : out.surface.mesh.triangles) {
    Vec3 centre = Vec3::Zero();
    for (const std::int32_t v : t) centre += out.surface.mesh.points[static_cast<std::size_t>(v)] / 3.0;
    (before.closest(centre).distance < 0.02 ? vessel : added).mesh.triangles.push_back(t);
  }
  figure::Scene scene;
  const bool few = out.surface.mesh.triangles.size() < 60000;
  for (figure::MeshActor* actor : {&vessel, &added}) {
    actor->shading = few ? figure::Shading::flat : figure::Shading::smooth;
    actor->edges = few;
    actor->edge_width_px = 0.5;
    scene.meshes.push_back(std::move(*actor));
  }
  figure::RenderOptions render;
  render.width_px = 1100;
  render.height_px = 900;
  render.look = figure::Look::light;
  figure::scene_figure(scene, camera, render).write(file, 1.0);
}

void make(const std::string& what, const std::string& file) {
  const Input input = made(what);
  const auto clipped = meshing::clip_ends(input.lumen, input.tree);
  const auto start = std::chrono::steady_clock::now();
  const auto out = meshing::extend_ends(clipped, input.tree, input.options);
  tell(out, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  // The hollow side of the sections is seen aslant; all else as broad as it is.
  const figure::Camera aslant{.direction = Vec3(-0.5, -1.0, -0.45), .up = Vec3::UnitZ()};
  draw(out, clipped.mesh, what == "sections" ? aslant : figure::cameras::broadside(out.surface.mesh.points),
       file);
  const auto capped = meshing::cap_ends(out.surface);
  const auto sizes = meshing::target_edge_lengths(capped.mesh, meshing::TubeFunction(out.tree));
  const auto even = meshing::remesh(capped, sizes);
  std::printf("remeshed: %zu triangles, smallest angle %.1f degrees, %zu self-intersections\n",
              even.surface.mesh.triangles.size(), even.report.min_angle_deg, even.report.self_intersections);
}

}  // namespace

int main(int argc, char** argv) {
  return bench::make_picture(argc, argv, "sections|fork|coronary|phantomSEED|SURFACE PICTURE.png", 2,
                             [](const std::vector<std::string>& a) { make(a[0], a[1]); });
}
