// The folder of a report.

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/core/parallel.h"
#include "ostia/core/parallel_invoke.h"
#include "ostia/session/annotation_json.h"
#include "ostia/session/case_report.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <set>

namespace ostia::session {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;

constexpr double image_density = 2.0;

void check_names(const std::vector<KeyImage>& images) {
  std::set<std::string> names;
  for (const KeyImage& image : images) {
    const bool fit =
        !image.name.empty() && image.name.size() <= 64 &&
        std::all_of(image.name.begin(), image.name.end(), [](unsigned char c) {
          return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-';
        });
    if (!fit)
      throw InvalidInput("a report's image is called \"" + image.name +
                         "\"; take up to 64 letters, digits and dashes");
    std::string folded = image.name;
    std::transform(folded.begin(), folded.end(), folded.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (!names.insert(folded).second)
      throw InvalidInput("two images of a report are called \"" + image.name + "\"; give each its own name");
  }
}

Json image_json(const std::optional<ImageReference>& image) {
  if (!image) return {};
  Json known{{"sha256", image->sha256}, {"pseudonym", image->pseudonym}};
  if (!image->axes.empty()) known["axes"] = image->axes;
  return known;
}

Json walls_json(const OuterWallsOptions& o) {
  const segmentation::OuterWallOptions& w = o.wall;
  const analysis::PlaqueOptions& p = o.plaque;
  return {o.step_mm,
          o.around,
          w.radial_step_mm,
          w.least_thickness_mm,
          w.largest_thickness_mm,
          w.blur_sigma_mm,
          w.wall_hu,
          w.fat_hu,
          w.largest_slope_along,
          w.largest_slope_around,
          p.low_attenuation_hu,
          p.fibrofatty_hu,
          p.fibrous_hu,
          p.thin_wall_mm,
          p.healthy_margin_mm,
          p.step_mm,
          p.around,
          p.deep,
          p.blur_sigma_mm};
}

void write_data(const fs::path& folder, const CaseReport& report, const std::vector<KeyImage>& images) {
  core::write_file(folder / "report.json", report_json(report, images));
  core::write_file(folder / "segments.csv", segments_csv(report));
  core::write_file(folder / "stenoses.csv", stenoses_csv(report));
  core::write_file(folder / "plaque.csv", plaque_csv(report));
  core::write_file(folder / "measurements.csv", measurements_csv(report));
}

}  // namespace

std::string report_digest(const CaseFile& file) {
  const Annotations& notes = *file.annotations();
  Json all{{"model", lumen::digest(*file.model())}, {"image", image_json(file.image())}};
  for (const analysis::Measurement& one : notes.measurements)
    all["measurements"].push_back(to_json(AnnotationCommand(MeasureChange{one})));
  for (const VesselMark& mark : notes.marks)
    all["marks"].push_back(to_json(AnnotationCommand(MarkVessel{mark})));
  for (const JournalEntry& entry : file.journal())
    all["journal"].push_back({entry.number, entry.op, entry.parameters, entry.undone, entry.notes});
  return core::sha256(all.dump(-1, ' ', false, Json::error_handler_t::replace));
}

pipeline::JobKey report_job(const CaseFile& file, bool with_image, const ReportOptions& o,
                            const std::vector<KeyImage>& further, bool named) {
  Json parameters{{"date", o.date},
                  {"profile", {o.profile.step_mm, o.profile.around}},
                  {"reference_window_mm", o.reference.window_mm},
                  {"least_percent", o.stenosis.least_percent},
                  {"least_length_mm", o.stenosis.least_length_mm},
                  {"plaque_stretches",
                   {o.plaque_stretches.least_area_mm2, o.plaque_stretches.least_length_mm,
                    o.plaque_stretches.gap_mm, o.plaque_stretches.least_beside_mm}},
                  {"least_graded_mm", o.least_graded_mm},
                  {"walls", walls_json(o.walls)},
                  {"picture_percent", o.picture_percent},
                  {"theta_deg", o.theta_deg},
                  {"grey", {o.level_hu, o.window_hu}},
                  {"further", Json::array()}};
  if (named) parameters["named"] = true;
  if (o.language != ReportLanguage::english) parameters["language"] = to_string(o.language);
  if (o.form != ReportTemplate::full) parameters["template"] = to_string(o.form);
  if (o.agatston) parameters["agatston"] = *o.agatston;
  if (!o.impression.empty()) parameters["impression"] = core::sha256(o.impression);
  if (!o.certainty.empty()) {
    parameters["certainty"] = Json::array();
    for (const coronary::VesselCertainty& one : o.certainty)
      parameters["certainty"].push_back({one.vessel, one.probability});
  }
  const analysis::HighRiskOptions& h = o.high_risk;
  parameters["high_risk"] = {h.least_low_mm3,  h.least_remodelling, h.spot_mm,
                             h.least_spot_mm3, h.ring_deg,          h.ring_mm};
  pipeline::JobKey key{"report", {{"case", report_digest(file)}}, parameters.dump()};
  if (with_image && o.image) key.inputs["image"] = o.image->sha256;
  add_further(key, further);
  return key;
}

void add_further(pipeline::JobKey& job, const std::vector<KeyImage>& further) {
  if (further.empty()) return;
  Json parameters = Json::parse(job.parameters);
  for (const KeyImage& one : further)
    parameters["further"].push_back({one.name, one.caption, core::sha256(one.picture.png(image_density))});
  job.parameters = parameters.dump();
}

void write_case_report(const fs::path& folder, const CaseReport& report, const std::vector<KeyImage>& images,
                       const pipeline::JobKey& job, double seconds_before, const core::TaskContext& task,
                       const imaging::ShownIdentity& named) {
  const auto start = std::chrono::steady_clock::now();
  check_names(images);
  pipeline::require_free_folder(folder);
  task.throw_if_cancelled();
  task.set_stage("writing");
  core::StagedFolder staged(folder);
  const fs::path& made = staged.temporary();
  fs::create_directory(made / "images");
  core::parallel_for(images.size(), 1, [&](std::size_t i) {
    task.throw_if_cancelled();
    images[i].picture.write_png(made / "images" / (images[i].name + ".png"), image_density);
  });
  task.set_progress(0.4);
  // Pictures are drawn by one at a time: the page shows the PNG files that are there by now.
  core::parallel_invoke([&] { core::write_file(made / "report.pdf", report_pdf(report, images, named)); },
                        [&] {
                          core::write_file(made / "report.html", report_html(report, images, named));
                          write_data(made, report, images);
                        });
  task.throw_if_cancelled();
  const double seconds =
      seconds_before + std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  pipeline::write_manifest(made, {job, ExitCode::ok, seconds, report.warnings, {}});
  staged.commit();
  task.set_progress(1.0);
}

}  // namespace ostia::session
