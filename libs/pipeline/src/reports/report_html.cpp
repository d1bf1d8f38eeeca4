#include "ostia/core/text.h"
#include "ostia/core/version.h"
#include "ostia/figure/cut_open.h"
#include "ostia/figure/html_report.h"
#include "ostia/figure/plot.h"
#include "ostia/figure/scene.h"
#include "ostia/figure/slice_figure.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/pipeline/manifest.h"
#include "ostia/pipeline/report.h"

#include <algorithm>
#include <cmath>

namespace ostia::pipeline {
namespace {

using core::fixed_text;
using figure::HtmlReport;
using geometry::Vec3;

/// A point of the lumen in the middle of the first vessel: what the slices go through.
Vec3 middle(const Model& model) {
  const geometry::Centerline line =
      geometry::vessel_axis(model.meshed.centerlines.tree, model.meshed.centerlines.tree.vessels.front());
  return line.points[line.size() / 2];
}

figure::Camera overview(const Model& model) {
  return figure::cameras::broadside(model.meshed.surface.mesh.points);
}

/// The voxels of the lumen's box and what lies around it, so that the lumen is seen and not the whole chest.
imaging::Region neighbourhood(const imaging::Geometry& grid, const geometry::Box3& box) {
  const double margin = std::max(20.0, 0.25 * box.diagonal().norm());
  geometry::Box3 voxels;
  for (int corner = 0; corner < 8; ++corner) {
    voxels.extend(grid.index(box.corner(static_cast<geometry::Box3::CornerType>(corner))));
  }
  imaging::Region region;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<Eigen::Index>(axis);
    const double reach = margin / grid.spacing[a];
    region.lower[axis] =
        std::clamp<std::int64_t>(std::llround(voxels.min()[a] - reach), 0, grid.size[axis] - 1);
    region.upper[axis] = std::clamp<std::int64_t>(std::llround(voxels.max()[a] + reach) + 1,
                                                  region.lower[axis] + 1, grid.size[axis]);
  }
  return region;
}

figure::Picture slices(const Model& model) {
  figure::SliceFigureOptions look;
  look.image_width_px = 420;
  const imaging::Region region =
      neighbourhood(model.source.image->geometry, geometry::bounds(model.lumen.points));
  return figure::three_planes(imaging::cropped(*model.source.image, region), middle(model), {model.lumen}, {},
                              look);
}

figure::Picture surface(const Model& model, const core::TaskContext& task) {
  figure::Scene scene;
  figure::MeshActor wall;
  wall.mesh = model.lumen;
  wall.color.a = 0.35;
  wall.label = "lumen";
  scene.meshes.push_back(std::move(wall));
  for (std::size_t i = 0; i < model.meshed.centerlines.tree.vessels.size(); ++i) {
    const geometry::Centerline line =
        geometry::vessel_axis(model.meshed.centerlines.tree, model.meshed.centerlines.tree.vessels[i]);
    const double thin = 0.08 * *std::max_element(line.radius.begin(), line.radius.end());
    figure::TubeActor tube = figure::tube_of(line, std::max(thin, 0.05), figure::palette(i));
    tube.label = model.meshed.centerlines.tree.vessels[i].name;
    scene.tubes.push_back(std::move(tube));
  }
  return figure::scene_figure(scene, overview(model), {}, task);
}

figure::Picture mesh(const Model& model, const core::TaskContext& task) {
  const figure::Camera camera = overview(model);
  figure::Scene scene;
  scene.meshes = figure::cut_actors(model.meshed.mesh, {middle(model), -camera.direction});
  return figure::scene_figure(scene, camera, {}, task);
}

figure::Picture diameters(const Model& model) {
  std::vector<figure::Series> series;
  for (const geometry::Vessel& vessel : model.meshed.centerlines.tree.vessels) {
    const geometry::Centerline axis = geometry::vessel_axis(model.meshed.centerlines.tree, vessel);
    figure::Series one;
    one.name = vessel.name;
    one.x = axis.abscissa;
    for (const double r : axis.radius) one.y.push_back(2.0 * r);
    series.push_back(std::move(one));
  }
  figure::PlotOptions options;
  options.x_label = "distance from the inlet (mm)";
  options.y_label = "inscribed diameter (mm)";
  options.y_from_zero = true;
  return figure::line_plot(series, options);
}

void add_truth(HtmlReport& html, const TruthErrors& errors) {
  html.section("Against the truth");
  html.key_values({{"mean surface distance", fixed_text(errors.lumen.msd_mm, 3) + " mm"},
                   {"95 % Hausdorff distance", fixed_text(errors.lumen.hd95_mm, 3) + " mm"},
                   {"signed mean (positive: too wide)", fixed_text(errors.lumen.signed_mean_mm, 3) + " mm"},
                   {"axis, mean distance", fixed_text(errors.axis.mean_mm, 3) + " mm"},
                   {"radius, median error", fixed_text(100.0 * errors.axis.radius_median_relative, 1) + " %"},
                   {"throat radius", fixed_text(errors.throat_radius_mm, 3) + " mm (true " +
                                         fixed_text(errors.true_throat_radius_mm, 3) + " mm, off by " +
                                         fixed_text(100.0 * errors.throat_relative, 1) + " %)"}});
}

void add_figures(HtmlReport& html, const Model& model) {
  html.section("Figures");
  std::vector<std::vector<std::string>> vessels;
  for (const geometry::Vessel& vessel : model.meshed.centerlines.tree.vessels) {
    const geometry::Centerline axis = geometry::vessel_axis(model.meshed.centerlines.tree, vessel);
    const double least = *std::min_element(axis.radius.begin(), axis.radius.end());
    vessels.push_back({vessel.name, fixed_text(axis.abscissa.back(), 1),
                       fixed_text(2.0 * axis.radius.front(), 2), fixed_text(2.0 * axis.radius.back(), 2),
                       fixed_text(2.0 * least, 2)});
  }
  html.table({"vessel", "length (mm)", "first diameter (mm)", "last diameter (mm)", "least diameter (mm)"},
             vessels);
  const auto& s = model.meshed.quality.surface;
  const auto& v = model.meshed.quality.volume;
  html.key_values(
      {{"triangles", std::to_string(s.triangles)},
       {"least angle", fixed_text(s.min_angle_deg, 1) + " degrees"},
       {"mean of the least angles", fixed_text(s.mean_min_angle_deg, 1) + " degrees"},
       {"open edges, non-manifold edges, self-intersections",
        std::to_string(s.open_edges) + ", " + std::to_string(s.non_manifold_edges) + ", " +
            std::to_string(s.self_intersections)},
       {"tetrahedra, prisms", std::to_string(v.tetrahedra.count) + ", " + std::to_string(v.prisms.count)},
       {"least dihedral angle", fixed_text(least_dihedral_deg(v), 1) + " degrees"},
       {"least scaled Jacobian", fixed_text(least_scaled_jacobian(v), 2)},
       {"inverted elements", std::to_string(v.inverted())},
       {"non-orthogonality, skewness (as OpenFOAM has them)",
        fixed_text(v.openfoam.max_non_orthogonality_deg, 1) + " degrees, " +
            fixed_text(v.openfoam.max_skewness, 2)},
       {"volume", fixed_text(v.volume_mm3(), 1) + " mm\xc2\xb3"}});
  if (const auto& layers = model.meshed.quality.layers)
    html.key_values({{"wall with layers of full thickness", fixed_text(100.0 * layers->full_share, 1) + " %"},
                     {"least scaled Jacobian of the layers", fixed_text(layers->min_scaled_jacobian, 2)}});
  std::vector<std::vector<std::string>> faces;
  for (const meshing::FaceQuality& face : v.faces)
    faces.push_back({std::to_string(face.id), face.name, fixed_text(face.area_mm2, 2)});
  html.table({"CellEntityIds", "face", "area (mm\xc2\xb2)"}, faces);
  std::vector<std::vector<std::string>> stages;
  for (const StageTime& stage : model.stages) stages.push_back({stage.name, fixed_text(stage.seconds, 2)});
  html.table({"stage", "seconds"}, stages);
}

}  // namespace

std::vector<ReportPicture> report_pictures(const Model& model, const core::TaskContext& task) {
  std::vector<ReportPicture> out;
  if (model.source.image) {
    out.push_back({"slices", "The lumen in the image",
                   "Axial, coronal and sagittal slice through the middle of the first vessel; the line is "
                   "the lumen's surface.",
                   slices(model)});
  }
  task.throw_if_cancelled();
  out.push_back({"surface", "Surface and centerlines",
                 "The lumen's surface, see-through, with the centerlines.", surface(model, task)});
  task.throw_if_cancelled();
  out.push_back({"mesh", "The mesh, cut open",
                 "Elements in front of a plane through the vessel are taken away.", mesh(model, task)});
  out.push_back({"diameter", "Diameter along each vessel", "Diameter of the largest inscribed sphere.",
                 diameters(model)});
  return out;
}

void write_pictures(const std::filesystem::path& folder, const std::vector<ReportPicture>& pictures,
                    const core::TaskContext& task) {
  std::filesystem::create_directory(folder / "pictures");
  for (const ReportPicture& one : pictures) {
    task.throw_if_cancelled();
    one.picture.write_png(folder / "pictures" / (one.name + ".png"), 2.0);
    one.picture.write_svg(folder / "pictures" / (one.name + ".svg"));
  }
}

void write_report_html(const std::filesystem::path& path, const Model& model,
                       const std::vector<ReportPicture>& pictures, const std::optional<TruthErrors>& truth) {
  HtmlReport html("Vessel model",
                  name_of(model.source.kind) + " " + model.source.pseudonym + ", Ostia " + core::version());
  if (model.meshed.quality.verdict.ok()) {
    html.notice(figure::Notice::good, "The mesh passed the quality gate.");
  } else {
    html.notice(figure::Notice::bad, "Look at this case: " + model.meshed.quality.verdict.summary());
  }
  for (const std::string& warning : model.warnings) html.notice(figure::Notice::warning, warning);
  if (truth) add_truth(html, *truth);
  for (const ReportPicture& one : pictures) {
    html.section(one.heading);
    html.picture(one.picture, one.caption);
  }
  add_figures(html, model);
  html.write(path);
}

}  // namespace ostia::pipeline
