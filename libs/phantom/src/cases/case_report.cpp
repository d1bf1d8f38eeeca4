#include "ostia/phantom/case_report.h"

#include "cases/report_views.h"
#include "coronaries/axis_place.h"

#include "ostia/core/parallel.h"
#include "ostia/core/text.h"
#include "ostia/figure/html_report.h"
#include "ostia/figure/plot.h"
#include "ostia/figure/scene.h"
#include "ostia/figure/slice_figure.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ostia::phantom {
namespace {

using core::fixed_text;
using figure::Picture;

Picture tree_picture(const CasePlan& plan, const geometry::TriMesh& lumen, const core::TaskContext& task) {
  figure::Scene scene;
  scene.meshes.push_back({.mesh = lumen});
  for (const CoronaryVessel& vessel : plan.tree.vessels) {
    const double s =
        std::min(vessel.axis.abscissa.back(), 0.6 * (vessel.s_free_mm + vessel.axis.abscissa.back()));
    scene.labels.push_back({place_at(vessel.axis, s).point, vessel.name});
  }
  for (const CoronaryVessel& vessel : plan.tree.vessels) {
    for (const Stenosis& one : vessel.stenoses) {
      const AxisPlace place = place_at(vessel.axis, one.s_throat_mm);
      scene.tubes.push_back({.points = {place.point},
                             .radius_mm = {1.15 * vessel.wall.max_at(one.s_throat_mm)},
                             .color = figure::palette(1)});
    }
  }
  if (!scene.tubes.empty()) scene.tubes.front().label = "stenosis";
  figure::RenderOptions options;
  options.width_px = 620;
  options.height_px = 600;
  options.samples = 2;
  std::vector<Picture> panels;
  options.title = "LAO 40, cranial 10";
  panels.push_back(figure::scene_figure(scene, figure::cameras::angiographic(40.0, 10.0), options, task));
  options.title = "RAO 30, cranial 10";
  panels.push_back(figure::scene_figure(scene, figure::cameras::angiographic(-30.0, 10.0), options, task));
  return figure::grid(panels, {.columns = 2});
}

Picture calibre_picture(const CasePlan& plan) {
  std::vector<figure::Series> series;
  for (const ChallengeVessel& vessel : plan.challenge.vessels) {
    figure::Series one;
    one.name = vessel.name;
    const auto& reference = vessel.reference;
    double s = 0.0;
    for (std::size_t i = 0; i < reference.points.size(); i += 10) {
      if (i > 0) s += (reference.points[i] - reference.points[i - 10]).norm();
      one.x.push_back(s);
      one.y.push_back(2.0 * reference.radius[i]);
    }
    series.push_back(std::move(one));
  }
  figure::PlotOptions options;
  options.title = "Mean lumen diameter along the vessels";
  options.x_label = "from the start (mm)";
  options.y_label = "diameter (mm)";
  options.y_from_zero = true;
  return figure::line_plot(series, options);
}

Picture histogram_picture(const Scan& scan) {
  constexpr int low = -1100, high = 1300, bin = 10;
  constexpr auto bins = static_cast<std::size_t>((high - low) / bin);
  struct Group {
    const char* name;
    std::array<bool, 256> labels{};
  };
  const auto group = [](const char* name, std::initializer_list<Label> labels) {
    Group out{name, {}};
    for (const Label one : labels) out.labels[static_cast<std::size_t>(one)] = true;
    return out;
  };
  Group all{"all voxels", {}};
  all.labels.fill(true);
  const std::vector<Group> groups{all,
                                  group("aorta", {Label::aorta}),
                                  group("left ventricle", {Label::left_ventricle}),
                                  group("myocardium", {Label::myocardium}),
                                  group("fat", {Label::fat, Label::epicardial_fat}),
                                  group("lung", {Label::lung})};
  std::vector<std::vector<std::size_t>> counts(groups.size(), std::vector<std::size_t>(bins, 0));
  const bool labelled = scan.labels.voxels.size() == scan.image.voxels.size();
  for (std::size_t i = 0; i < scan.image.voxels.size(); ++i) {
    const int at = (scan.image.voxels[i] - low) / bin;
    if (at < 0 || at >= static_cast<int>(bins)) continue;
    ++counts[0][static_cast<std::size_t>(at)];
    if (!labelled) continue;
    for (std::size_t g = 1; g < groups.size(); ++g)
      counts[g][static_cast<std::size_t>(at)] += groups[g].labels[scan.labels.voxels[i]] ? 1 : 0;
  }
  std::vector<figure::Series> series;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    figure::Series one;
    one.name = groups[g].name;
    for (std::size_t b = 0; b < bins; ++b) {
      one.x.push_back(low + bin * (static_cast<double>(b) + 0.5));
      one.y.push_back(std::log10(1.0 + static_cast<double>(counts[g][b])));
    }
    if (std::any_of(counts[g].begin(), counts[g].end(), [](std::size_t n) { return n > 0; }))
      series.push_back(std::move(one));
  }
  figure::PlotOptions options;
  options.title = "CT numbers";
  options.x_label = "HU";
  options.y_label = "log10 (1 + voxels in 10 HU)";
  options.y_from_zero = true;
  return figure::line_plot(series, options);
}

Vec3 left_ostium(const CasePlan& plan) {
  for (const CoronaryVessel& vessel : plan.tree.vessels)
    if (vessel.name == "LM" || vessel.name == "LAD") return vessel.axis.points.front();
  return plan.heart.root.annulus;
}

void add_image_pictures(std::vector<CasePicture>& out, const CasePlan& plan, const Scan& scan,
                        const core::TaskContext& task) {
  const imaging::ImageVolume& image = scan.image;
  Vec3 centre = left_ostium(plan);
  if (!image.geometry.contains(centre)) {
    centre = image.geometry.world(0.5 * Vec3(static_cast<double>(image.geometry.size[0] - 1),
                                             static_cast<double>(image.geometry.size[1] - 1),
                                             static_cast<double>(image.geometry.size[2] - 1)));
  }
  figure::SliceFigureOptions options;
  options.level_hu = 200.0;
  options.window_hu = 800.0;
  options.image_width_px = 420;
  out.push_back({"planes", "Three planes",
                 "Axial, coronal and sagittal slice through the left ostium; window 800, level 200 HU.",
                 figure::three_planes(image, centre, {}, {}, options)});
  task.set_progress(0.15);
  out.push_back({"axial", "Axial slices", "From above, equally far apart; window 800, level 200 HU.",
                 axial_gallery(image)});
  task.set_progress(0.3);
  out.push_back({"mip", "Maximum intensity projections",
                 "Slabs at the aortic root, and a thick one through the heart seen from the front.",
                 projections(plan, image, task)});
  task.set_progress(0.5);
  if (!plan.challenge.vessels.empty()) {
    out.push_back({"straightened", "Straightened vessels",
                   "The image along each vessel, cut along the normal of its rotation-minimising frame, "
                   "plain and with the true boundaries.",
                   straightened_views(plan, image)});
  }
  if (has_stenosis_in(plan, image.geometry)) {
    out.push_back({"stenoses", "Stenoses",
                   "Across the vessel at the throats of the worst stenoses, seen looking distally, with the "
                   "true lumen and outer wall.",
                   stenosis_sections(plan, image)});
  }
  out.push_back({"histogram", "Histogram", "CT numbers of the whole image and within the truth's labels.",
                 histogram_picture(scan)});
  task.set_progress(0.7);
}

std::vector<std::vector<std::string>> vessel_rows(const CasePlan& plan) {
  std::vector<std::vector<std::string>> rows;
  for (const CoronaryVessel& vessel : plan.tree.vessels) {
    std::string segments;
    for (const SegmentSpan& span : vessel.segments)
      segments += (segments.empty() ? "" : ", ") + std::to_string(span.aha);
    const double length = vessel.axis.abscissa.back();
    rows.push_back({vessel.name, vessel.parent < 0 ? "aorta" : vessel_of(plan.tree, vessel.parent).name,
                    segments, fixed_text(length - vessel.s_free_mm, 1),
                    fixed_text(2.0 * vessel.lumen.mean_at(vessel.s_free_mm), 2),
                    fixed_text(2.0 * vessel.lumen.mean_at(length), 2)});
  }
  return rows;
}

std::vector<std::vector<std::string>> stenosis_rows(const CasePlan& plan) {
  std::vector<std::vector<std::string>> rows;
  for (const CoronaryVessel& vessel : plan.tree.vessels) {
    for (const Stenosis& one : vessel.stenoses) {
      rows.push_back({vessel.name, fixed_text(one.s_throat_mm, 1), fixed_text(one.s_to_mm - one.s_from_mm, 1),
                      fixed_text(100.0 * one.diameter_stenosis, 0), fixed_text(100.0 * one.area_stenosis, 0),
                      fixed_text(one.eccentricity, 2), word(one.kind),
                      std::to_string(stenosis_category(one.diameter_stenosis))});
    }
  }
  return rows;
}

std::vector<std::vector<std::string>> section_rows(const CasePlan& plan) {
  std::vector<std::vector<std::string>> rows;
  for (const AnnotatedSection& one : plan.sections.sections) {
    rows.push_back({one.key, vessel_of(plan.tree, one.vessel).name, fixed_text(one.s_from_mm, 1),
                    fixed_text(one.s_to_mm, 1), fixed_text(one.length_mm(), 1),
                    one.health == geometry::Health::healthy ? "healthy" : "diseased"});
  }
  return rows;
}

}  // namespace

std::vector<CasePicture> case_pictures(const CasePlan& plan, const Scan* scan, const geometry::TriMesh& lumen,
                                       const core::TaskContext& task) {
  std::vector<CasePicture> out;
  if (scan != nullptr) add_image_pictures(out, plan, *scan, task.sub(0.0, 0.8));
  task.throw_if_cancelled();
  out.push_back({"tree", "Coronary tree",
                 "The true lumen with the vessels' names, seen from two angles of an angiograph; balls mark "
                 "stenoses.",
                 tree_picture(plan, lumen, task.sub(0.8, plan.patient ? 0.9 : 1.0))});
  if (plan.patient)
    out.push_back({"heart", "Heart under a patient's arteries",
                   "The phantom's heart, bent until the patient's arteries run on it; what the patient's "
                   "file lacked is "
                   "grown and drawn.",
                   heart_picture(plan, task.sub(0.9, 1.0))});
  if (!plan.challenge.vessels.empty()) {
    out.push_back({"calibre", "Calibre", "Mean diameter of the true lumen along the vessels of the data set.",
                   calibre_picture(plan)});
  }
  task.set_progress(1.0);
  return out;
}

CasePicture motion_picture(const std::vector<VesselMotion>& vessels) {
  std::vector<figure::Series> series;
  for (const VesselMotion& vessel : vessels) {
    figure::Series one;
    one.name = vessel.vessel;
    const std::size_t n = vessel.distance_mm.size();
    for (std::size_t i = 0; i <= n; ++i) {
      one.x.push_back(100.0 * static_cast<double>(i) / static_cast<double>(n));
      one.y.push_back(vessel.distance_mm[i % n]);
    }
    series.push_back(std::move(one));
  }
  figure::PlotOptions options;
  options.title = "Mean distance from the place at 75 % of RR";
  options.x_label = "phase (% of RR)";
  options.y_label = "distance (mm)";
  options.y_from_zero = true;
  return {"motion", "Motion",
          "How far the points of a vessel's axis are from where they are in mid-diastole.",
          figure::line_plot(series, options)};
}

void write_case_report(const std::filesystem::path& path, const CasePlan& plan, const Scan* scan,
                       const std::vector<CasePicture>& pictures) {
  figure::HtmlReport report("Synthetic coronary CT angiogram", "seed " + std::to_string(plan.options.seed));
  report.notice(figure::Notice::note,
                plan.patient
                    ? "This image was computed. Its arteries run as a patient's do; all else is made up."
                    : "This image was computed. It shows no patient.");
  for (const std::string& warning : plan.warnings) report.notice(figure::Notice::warning, warning);
  for (const CasePicture& one : pictures) {
    report.section(one.heading);
    report.picture(one.picture, one.caption, {}, 1.5);
  }
  report.section("Image");
  const imaging::Geometry& grid = plan.options.scan.grid;
  report.key_values(
      {{"Voxels", std::to_string(grid.size[0]) + " x " + std::to_string(grid.size[1]) + " x " +
                      std::to_string(grid.size[2])},
       {"Voxel size (mm)", fixed_text(grid.spacing.x(), 3) + " x " + fixed_text(grid.spacing.y(), 3) + " x " +
                               fixed_text(grid.spacing.z(), 3)},
       {"Noise (HU)", fixed_text(plan.options.scan.noise_hu, 1)},
       {"Point spread, full width at half maximum (mm)",
        fixed_text(plan.options.scan.psf_fwhm_mm, 2) + " in the slice, " +
            fixed_text(plan.options.scan.psf_fwhm_z_mm, 2) + " along z"},
       {"Image", scan != nullptr ? "made" : "left out (truth alone)"}});
  if (plan.patient) {
    const PatientRecord& patient = *plan.patient;
    report.section("Heart under the arteries");
    report.key_values(
        {{"Size of the heart over the phantom's (right, up, along)",
          fixed_text(patient.size.x(), 2) + ", " + fixed_text(patient.size.y(), 2) + ", " +
              fixed_text(patient.size.z(), 2)},
         {"Arteries from their usual height above it, root mean square (mm)",
          fixed_text(patient.height_left_mm, 1) + "; " + fixed_text(patient.height_mm, 1) +
              " before it was bent"},
         {"From their grooves (mm)", fixed_text(patient.groove_left_mm, 1) + "; " +
                                         fixed_text(patient.groove_mm, 1) + " before it was bent"},
         {"Jacobian of the map",
          fixed_text(patient.least_jacobian, 2) + " to " + fixed_text(patient.largest_jacobian, 2)},
         {"Longest way that a place is moved (mm)", fixed_text(patient.longest_mm, 1)}});
  }
  report.section("Vessels");
  report.table({"vessel", "from", "AHA segments", "length (mm)", "first diameter (mm)", "last diameter (mm)"},
               vessel_rows(plan));
  report.section("Stenoses");
  if (const auto rows = stenosis_rows(plan); !rows.empty()) {
    report.table({"vessel", "throat at (mm)", "length (mm)", "diameter (%)", "area (%)", "eccentricity",
                  "plaque", "CAD-RADS"},
                 rows);
  } else {
    report.paragraph("None.");
  }
  report.section("Annotated sections");
  if (const auto rows = section_rows(plan); !rows.empty())
    report.table({"section", "vessel", "from (mm)", "to (mm)", "length (mm)", "lumen"}, rows);
  else
    report.paragraph("None.");
  report.write(path);
}

}  // namespace ostia::phantom
