#include "ostia/session/case_report.h"

#include "report/case_report_grading.h"
#include "report/case_report_text.h"
#include "walls/vessel_look.h"
#include "walls/vessels_beside.h"

#include "ostia/core/error.h"
#include "ostia/core/quantity_text.h"
#include "ostia/core/text.h"
#include "ostia/core/version.h"
#include "ostia/session/doubts.h"
#include "ostia/session/lesion_board.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace ostia::session {
namespace {

using analysis::LumenProfile;
using analysis::SectionMeasures;

/// Measures of a stretch: sections within it, and its ends.
struct Sizes {
  std::optional<double> mean_diameter_mm, least_diameter_mm, least_area_mm2;
};

/// The stretch without the vessel's ends: there, within a radius, the wall closes over the lumen or opens to
/// the aorta, and is no calibre. A stretch that is nothing else stays as it is.
std::pair<double, double> within_ends(const LumenProfile& profile, const analysis::ReferenceLine& reference,
                                      double from_mm, double to_mm) {
  const double first = 0.5 * reference.diameter_mm.front();
  const double last = profile.length_mm - 0.5 * reference.diameter_mm.back();
  const double from = std::max(from_mm, first), to = std::min(to_mm, last);
  return from < to ? std::pair{from, to} : std::pair{from_mm, to_mm};
}

Sizes sizes_of(const LumenProfile& profile, double from_mm, double to_mm) {
  std::vector<SectionMeasures> sections;
  const auto add_end = [&](double s_mm) {
    const SectionMeasures end = analysis::at(profile, s_mm);
    if (end.found) sections.push_back(end);  // between a measured section and a shut one nothing is known
  };
  add_end(from_mm);
  for (const SectionMeasures& section : profile.sections)
    if (section.s_mm > from_mm && section.s_mm < to_mm) sections.push_back(section);
  add_end(to_mm);
  // Trapezia between measured neighbours; a shut lumen measures nothing, an open wall says nothing.
  const auto says = [](const SectionMeasures& section) { return section.found || !section.open; };
  double sum = 0.0, length = 0.0, least = std::numeric_limits<double>::infinity(), area = least;
  for (std::size_t i = 0; i < sections.size(); ++i) {
    if (!says(sections[i])) continue;
    least = std::min(least, sections[i].diameter_mm);
    area = std::min(area, sections[i].area_mm2);
    if (i + 1 == sections.size() || !says(sections[i + 1])) continue;
    const double step = sections[i + 1].s_mm - sections[i].s_mm;
    sum += 0.5 * step * (sections[i].diameter_mm + sections[i + 1].diameter_mm);
    length += step;
  }
  Sizes sizes;
  if (std::isfinite(least)) sizes.least_diameter_mm = least, sizes.least_area_mm2 = area;
  if (length > 0.0) sizes.mean_diameter_mm = sum / length;
  return sizes;
}

std::optional<double> volume_of(const LumenProfile& profile, double from_mm, double to_mm) {
  try {
    return analysis::volume_mm3(profile, from_mm, to_mm);
  } catch (const InvalidInput&) {
    return std::nullopt;  // a section is missing
  }
}

double unmeasured_mm(const LumenProfile& profile, double from_mm) {
  if (profile.sections.size() < 2) return 0.0;
  const double step = profile.length_mm / static_cast<double>(profile.sections.size() - 1);
  return step * static_cast<double>(std::count_if(
                    profile.sections.begin(), profile.sections.end(),
                    [&](const SectionMeasures& s) { return s.s_mm >= from_mm && !s.found && s.open; }));
}

/// Of one vessel, measured beside the others.
struct MeasuredVessel {
  LumenProfile profile;
  std::vector<analysis::Ostium> ostia;
  analysis::ReferenceLine reference;
};

/// What the image shows of a vessel; of its outer wall, or why it was not looked for.
struct LookedAt {
  VesselEvaluability judged;
  std::optional<VesselWalls> walls;
  std::string problem;
};

/// The report as it grows.
class Maker {
 public:
  Maker(const lumen::LumenModel& model, const analysis::SurfaceOfVessel& surface_of,
        const Annotations& annotations, const ReportOptions& options)
      : model_(model),
        surface_of_(held_surfaces(model, surface_of)),
        annotations_(annotations),
        cut_(analysis::segments_of(model)) {
    report_.options = options;
    report_.program_version = core::version();
    report_.model_digest = lumen::digest(model);
    report_.notes = annotations.report;
  }

  void measure_vessels(const core::TaskContext& task) {
    const std::vector<geometry::Vessel>& vessels = model_.tree.vessels;
    auto measured = beside<MeasuredVessel>(
        vessels.size(), task,
        [&](std::size_t i, const core::TaskContext& part) { return measure(vessels[i], part); },
        own_lengths(model_));
    for (std::size_t i = 0; i < vessels.size(); ++i) add_vessel(vessels[i], std::move(measured[i]));
  }

  void add_segments() {
    for (const analysis::VesselSegment& cut : cut_) {
      const LumenProfile& profile = report_.profiles.at(cut.vessel);
      ReportSegment segment;
      segment.vessel = cut.vessel;
      segment.vessel_name = report_text::vessel_name(model_, cut.vessel);
      segment.label = cut.label;
      segment.number = cut.aha ? cut.aha->number : 0;
      segment.from_mm = cut.from_mm;
      segment.to_mm = cut.to_mm;
      const auto [from, to] = within_ends(profile, report_.references.at(cut.vessel), cut.from_mm, cut.to_mm);
      const Sizes sizes = sizes_of(profile, from, to);
      segment.mean_diameter_mm = sizes.mean_diameter_mm;
      segment.least_diameter_mm = sizes.least_diameter_mm;
      segment.least_area_mm2 = sizes.least_area_mm2;
      segment.volume_mm3 = volume_of(profile, cut.from_mm, cut.to_mm);
      segment.checked = is_checked(cut.vessel);
      for (const ReportStenosis& one : report_.stenoses) {
        if (one.state == LesionState::rejected ||
            analysis::segment_at(cut_, one.stenosis.vessel, one.stenosis.throat_mm) != &cut ||
            !(one.stenosis.diameter_percent > segment.worst_percent))
          continue;
        segment.worst_stenosis = one.number;
        segment.worst_percent = one.stenosis.diameter_percent;
      }
      report_.segments.push_back(std::move(segment));
    }
  }

  void add_measurements(const imaging::ImageVolume* image) {
    analysis::MeasureContext context;
    context.model = &model_;
    context.surface_of = surface_of_;
    context.image = image;
    context.profile_of = [this](std::int32_t vessel) -> const LumenProfile& {
      const auto found = report_.profiles.find(vessel);
      if (found == report_.profiles.end()) throw InvalidInput("the measurement's vessel is not in the tree");
      return found->second;
    };
    const Orphans orphans = find_orphans(annotations_, model_);
    for (const analysis::Measurement& one : annotations_.measurements) {
      ReportMeasurement measurement{one, {}, {}, {}};
      if (needs_vessel(one)) measurement.vessel_name = report_text::vessel_name(model_, one.vessel);
      if (std::find(orphans.measurements.begin(), orphans.measurements.end(), one.id) !=
          orphans.measurements.end())
        measurement.problem = "not measurable: its vessel was deleted";
      else if (one.kind == analysis::MeasureKind::ring_hu && !image)
        measurement.problem = "not measured: the image was not at hand";
      else
        measure(measurement, context);
      report_.measurements.push_back(std::move(measurement));
    }
  }

  /// How far vessels, segments and lesions can be judged, and what lies between lumen and outer wall.
  void look_at(const imaging::ImageVolume* image, const core::TaskContext& task) {
    report_.has_image = image != nullptr;
    const std::optional<ImageReference>& known = report_.options.image;
    report_.content_digest =
        report_content_digest(model_, annotations_, image && known ? known->sha256 : std::string());
    std::vector<VesselEvaluability> judged;
    if (image) {
      const double noise_hu = noise_about(model_, *image);
      auto looked = beside<LookedAt>(
          report_.vessels.size(), task,
          [&](std::size_t i, const core::TaskContext& part) {
            return looked_at(report_.vessels[i].id, *image, noise_hu, part);
          },
          own_lengths(model_));
      for (std::size_t i = 0; i < looked.size(); ++i) {
        judged.push_back(std::move(looked[i].judged));
        add_plaque(report_.vessels[i], looked[i]);
      }
      report_.quality = scan_quality(image->geometry, noise_hu, judged);
    }
    for (std::size_t i = 0; i < report_.vessels.size(); ++i) {
      ReportVessel& vessel = report_.vessels[i];
      vessel.evaluable =
          judged_over(image ? judged[i].stretches : std::vector<analysis::EvaluableStretch>{},
                      find_mark(annotations_, vessel.id),
                      analysis::EvaluableStretch{vessel.own_from_mm, vessel.length_mm, {}, {}, false});
    }
  }

  void grade() {
    const std::map<std::int32_t, double> unlikely =
        unlikely_vessels(report_.options.certainty, model_, annotations_);
    for (ReportVessel& vessel : report_.vessels)
      if (const auto found = unlikely.find(vessel.id); found != unlikely.end())
        vessel.unlikely = found->second;
    report_.not_found = arteries_not_found(model_, unlikely);
    classify_bifurcations(report_);
    grade_report(report_);
    find_high_risk_plaque(report_);
    state_category(report_, cut_);
  }

  void write() { write_impression(report_); }

  /// Narrowings, and plaque where it is known, with what the reader says of them.
  void add_lesions() {
    for (const ReportVessel& vessel : report_.vessels) {
      const auto walls = report_.walls.find(vessel.id);
      const analysis::PlaqueProfile* plaque = walls != report_.walls.end() ? &walls->second.plaque : nullptr;
      for (const analysis::Lesion& one :
           analysis::find_lesions(report_.profiles.at(vessel.id), report_.references.at(vessel.id), plaque,
                                  report_.options.stenosis, report_.options.plaque_stretches))
        if (is_told(one, vessel.own_from_mm, vessel.evaluable)) add_lesion(vessel, one);
    }
    for (ReportStenosis& one : report_.stenoses) {
      const auto walls = report_.walls.find(one.stenosis.vessel);
      if (walls == report_.walls.end()) continue;
      one.plaque = plaque_of(walls->second, one.stenosis.from_mm, one.stenosis.to_mm);
      one.remodelling_index = analysis::remodelling_index(walls->second.plaque, one.stenosis);
    }
  }

  void add_steps(const std::vector<JournalEntry>& journal) {
    for (const JournalEntry& entry : journal)
      if (!entry.undone && entry.kind != StepKind::travel)
        report_.steps.push_back(report_text::step_of(entry, model_));
  }

  void warn() {
    for (const ReportVessel& vessel : report_.vessels) {
      if (vessel.unmeasured_mm > 0.0)
        report_.warnings.push_back(vessel.name + ": " + core::length_text(vessel.unmeasured_mm) +
                                   " mm could not be measured, the wall does not close there");
      if (analysis::main_vessel_of(vessel.name).empty())
        report_.warnings.push_back(vessel.name +
                                   ": no name of a coronary artery; it counts for none of LM, LAD, LCX and "
                                   "RCA in the patient's category");
    }
    if (!report_.has_image)
      report_.warnings.push_back(
          "the image was not at hand: key images show the model alone, CT numbers are not measured");
  }

  CaseReport take() { return std::move(report_); }

 private:
  LookedAt looked_at(std::int32_t vessel, const imaging::ImageVolume& image, double noise_hu,
                     const core::TaskContext& task) const {
    LookedAt out;
    const ReportOptions& o = report_.options;
    const OwnLumen own = own_lumen(model_, surface_of_, vessel, o.evaluability.step_mm, rays_around, task);
    out.judged = evaluability_in(own, model_, image, noise_hu, o.evaluability, task);
    const bool alike = o.walls.step_mm == o.evaluability.step_mm && o.walls.around == rays_around;
    OuterWallsOptions walls = o.walls;
    walls.maps = true;  // what high-risk plaque is told by
    try {
      out.walls = alike ? walls_in(own, model_, image, walls, task)
                        : vessel_walls(model_, surface_of_, vessel, image, walls, task);
    } catch (const InvalidInput& error) {
      out.problem = error.what();
    }
    return out;
  }

  void add_plaque(ReportVessel& vessel, LookedAt& looked) {
    if (!looked.problem.empty())
      report_.warnings.push_back(vessel.name + ": its outer wall was not looked for: " + looked.problem);
    if (!looked.walls) return;
    for (const std::string& warning : looked.walls->outer.surface.warnings)
      report_.warnings.push_back(vessel.name + ": " + warning);
    vessel.plaque = plaque_of(*looked.walls, vessel.own_from_mm, vessel.length_mm);
    report_.walls.emplace(vessel.id, std::move(*looked.walls));
  }

  static std::optional<ReportPlaque> plaque_of(const VesselWalls& walls, double from_mm, double to_mm) {
    ReportPlaque out;
    out.from_mm = std::max(from_mm, walls.plaque.from_mm);
    out.to_mm = std::min(to_mm, walls.plaque.to_mm);
    if (!(out.from_mm < out.to_mm)) return std::nullopt;
    out.volumes = analysis::plaque_between(walls.plaque, out.from_mm, out.to_mm);
    out.seen_share = walls.outer.seen_share;
    return out;
  }
  bool is_checked(std::int32_t vessel) const {
    const VesselMark* mark = find_mark(annotations_, vessel);
    return mark && mark->checked;
  }

  MeasuredVessel measure(const geometry::Vessel& vessel, const core::TaskContext& task) const {
    const ReportOptions& o = report_.options;
    MeasuredVessel out;
    out.profile = analysis::lumen_profile(model_, surface_of_, vessel.id, o.profile, task);
    out.ostia = analysis::ostia_of(model_, surface_of_, vessel.id);
    out.reference = analysis::reference_line(out.profile, analysis::branch_abscissas(model_, vessel.id),
                                             analysis::reading_from_ostium(out.ostia, o.reference));
    return out;
  }

  void add_vessel(const geometry::Vessel& vessel, MeasuredVessel measured) {
    const double own = lumen::own_from_mm(model_.tree, vessel.id);
    const VesselMark* mark = find_mark(annotations_, vessel.id);
    report_.vessels.push_back({vessel.id,
                               vessel.name,
                               measured.profile.length_mm,
                               own,
                               is_checked(vessel.id),
                               mark ? mark->note : std::string(),
                               unmeasured_mm(measured.profile, own),
                               {},
                               {}});
    report_.ostia[vessel.id] = measured.ostia.empty() ? analysis::Ostium() : measured.ostia.back();
    report_.references[vessel.id] = std::move(measured.reference);
    report_.profiles[vessel.id] = std::move(measured.profile);
  }

  void add_lesion(const ReportVessel& vessel, const analysis::Lesion& lesion) {
    const analysis::Stenosis& found = lesion.stenosis;
    ReportStenosis one;
    one.number = static_cast<int>(report_.stenoses.size()) + 1;
    one.stenosis = found;
    one.narrows = lesion.narrows;
    one.graded_percent = lesion.graded_percent();
    if (const LesionWord* said = word_on(find_mark(annotations_, vessel.id), found.from_mm, found.to_mm))
      one.state = said->state, one.comment = said->comment;
    one.vessel_name = vessel.name;
    one.main_vessel = analysis::main_vessel_of(vessel.name);
    if (const analysis::VesselSegment* segment = analysis::segment_at(cut_, vessel.id, found.throat_mm)) {
      one.segment = segment->label;
      // The left main's stretch has LAD's or LCX's name; a left posterior branch has none that tells its
      // side.
      const int number = segment->aha ? segment->aha->number : 0;
      if (number == 5) one.main_vessel = "LM";
      if (number == 15 || number == 18) one.main_vessel = "LCX";
    }
    one.category = lesion.category();
    one.checked = is_checked(vessel.id);
    report_.stenoses.push_back(std::move(one));
  }

  void measure(ReportMeasurement& measurement, const analysis::MeasureContext& context) const {
    try {
      measurement.values = analysis::measured(measurement.measurement, context);
    } catch (const InvalidInput& error) {
      measurement.problem = std::string("not measurable: ") + error.what();
    }
  }

  const lumen::LumenModel& model_;
  analysis::SurfaceOfVessel surface_of_;
  const Annotations& annotations_;
  std::vector<analysis::VesselSegment> cut_;
  CaseReport report_;
};

void require(bool fine, const std::string& what) {
  if (!fine) throw InvalidInput("a report " + what);
}

}  // namespace

void validate(const ReportOptions& options) {
  analysis::validate(options.profile);
  validate(options.walls);
  analysis::validate(options.medina);
  analysis::validate(options.plaque_stretches);
  require(options.least_graded_mm >= 0.0 && options.least_graded_mm <= 5.0,
          "grades stenoses of vessels from 0 to 5 mm, not " + core::shown_text(options.least_graded_mm, 2) +
              " mm");
  require(options.picture_percent >= 0.0 && options.picture_percent <= 100.0,
          "shows vessels with stenoses from 0 to 100 %, not " + core::shown_text(options.picture_percent, 1) +
              " %");
  analysis::validate(options.high_risk);
  validate_impression(options.impression);
  if (options.agatston) validate(ReportModifiers{.agatston = options.agatston});
  require(std::isfinite(options.theta_deg), "needs a finite angle of the reformations");
  require(std::isfinite(options.level_hu) && options.window_hu > 0.0 && std::isfinite(options.window_hu),
          "needs a grey window with a finite level and a positive width, HU");
}

std::vector<std::string> CaseReport::unchecked() const {
  std::vector<std::string> names;
  for (const ReportVessel& vessel : vessels)
    if (!vessel.checked) names.push_back(vessel.name);
  return names;
}

CaseReport make_case_report(const lumen::LumenModel& model, const analysis::SurfaceOfVessel& surface_of,
                            const Annotations& annotations, const std::vector<JournalEntry>& journal,
                            const imaging::ImageVolume* image, const ReportOptions& options,
                            const core::TaskContext& task) {
  validate(options);
  task.throw_if_cancelled();
  task.set_stage("measuring");
  Maker maker(model, surface_of, annotations, options);
  maker.measure_vessels(task.sub(0.0, image ? 0.2 : 0.9));
  maker.look_at(image, task.sub(0.2, 0.9));
  maker.add_lesions();
  maker.add_segments();
  maker.grade();
  maker.add_measurements(image);
  maker.add_steps(journal);
  maker.warn();
  maker.write();
  task.throw_if_cancelled();
  task.set_progress(1.0);
  return maker.take();
}

}  // namespace ostia::session
