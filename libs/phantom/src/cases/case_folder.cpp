#include "ostia/phantom/case_folder.h"

#include "cases/case_parts.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/core/parallel.h"
#include "ostia/io/centerline_file.h"
#include "ostia/io/contour_file.h"
#include "ostia/io/surface_file.h"
#include "ostia/phantom/case_report.h"
#include "ostia/phantom/hard_suite.h"
#include "ostia/phantom/vessel_field.h"

namespace ostia::phantom {
namespace fs = std::filesystem;
namespace {

using geometry::Health;

struct Surfaces {
  geometry::TriMesh lumen, wall;
};

void write_truth(const fs::path& folder, const CasePlan& plan, const Surfaces& surfaces,
                 const core::TaskContext& task) {
  for (const ChallengeVessel& vessel : plan.challenge.vessels)
    write_vessel(folder / ("vessel" + std::to_string(vessel.number)), vessel);
  io::write_contours(folder / "contours.json", annotate(plan.tree, plan.sections.sections,
                                                        plan.options.contours, plan.options.observers));
  task.throw_if_cancelled();
  io::write_centerlines(folder / "centerlines.vtp", vessel_tree(plan.tree));
  io::write_surface(folder / "lumen.vtp", surfaces.lumen);
  task.throw_if_cancelled();
  io::write_surface(folder / "wall.vtp", surfaces.wall);
  task.set_progress(1.0);
}

/// Both surfaces are made while the image is written, of which compression is the most work.
Surfaces make_surfaces(const CasePlan& plan, const std::function<void()>& meanwhile,
                       const core::TaskContext& task) {
  const VesselField field(plan.tree);
  const double spacing = plan.options.surface_spacing_mm;
  Surfaces out;
  core::parallel_for(3, 1, [&](std::size_t job) {
    if (job == 0) out.lumen = tree_surface(field, Boundary::lumen, spacing, task.sub(0.0, 0.5));
    if (job == 1) out.wall = tree_surface(field, Boundary::wall, spacing, task.sub(0.5, 1.0));
    if (job == 2) meanwhile();
  });
  return out;
}

void write_report(const fs::path& folder, const CasePlan& plan, const Scan* scan,
                  const geometry::TriMesh& lumen, const std::vector<VesselMotion>& motion,
                  const core::TaskContext& task) {
  task.set_stage("report");
  std::vector<CasePicture> pictures = case_pictures(plan, scan, lumen, task.sub(0.0, 0.8));
  if (!motion.empty()) pictures.push_back(motion_picture(motion));
  write_case_report(folder / "report.html", plan, scan, pictures);
  fs::create_directory(folder / "report");
  for (const CasePicture& one : pictures) {
    task.throw_if_cancelled();
    one.picture.write_png(folder / "report" / (one.name + ".png"), 1.5);
  }
  task.set_progress(1.0);
}

CaseRecord record_of(const CasePlan& plan, std::string folder) {
  CaseRecord record;
  record.folder = std::move(folder);
  record.seed = plan.options.seed;
  record.warnings = plan.warnings;
  for (const AnnotatedSection& one : plan.sections.sections) {
    const bool healthy = one.health == Health::healthy;
    (healthy ? record.healthy : record.diseased) += 1;
    (healthy ? record.healthy_mm : record.diseased_mm) += one.length_mm();
  }
  return record;
}

CaseRecord write_case(const fs::path& folder, int number, const SuiteOptions& options,
                      const core::TaskContext& task) {
  CaseOptions own = options.first;
  own.seed += static_cast<std::uint64_t>(number);
  if (options.hard) own = hard_case(own);
  task.set_stage("case " + std::to_string(number + 1) + ": anatomy");
  const CasePlan plan = plan_case(own);
  task.throw_if_cancelled();
  fs::create_directory(folder);
  const bool beats = options.phases > 1;
  std::optional<Scan> scan;
  if (!options.truth_only && !beats) {
    task.set_stage("case " + std::to_string(number + 1) + ": image");
    scan = scan_case(plan, task.sub(0.02, 0.6));
  }
  task.set_stage("case " + std::to_string(number + 1) + ": truth");
  const auto meanwhile = [&] {
    if (scan) write_image(folder, number, options, plan, *scan, {}, task.sub(0.6, 0.8));
  };
  // Of a case that beats, the phases take most of the time.
  const core::TaskContext still = beats ? task.sub(0.0, options.truth_only ? 0.3 : 0.05) : task;
  const Surfaces surfaces = make_surfaces(plan, meanwhile, still.sub(scan ? 0.6 : 0.05, 0.8));
  write_truth(folder, plan, surfaces, still.sub(0.8, 0.9));
  CaseRecord record = record_of(plan, folder.filename().string());
  if (beats) {
    task.set_stage("case " + std::to_string(number + 1) + ": phases");
    record.motion = write_phases(folder, number, options, plan, surfaces.lumen,
                                 task.sub(options.truth_only ? 0.3 : 0.05, 0.95));
  }
  if (options.report) {
    const core::TaskContext last = beats ? task.sub(0.95, 1.0) : task.sub(0.9, 1.0);
    write_report(folder, plan, scan ? &*scan : nullptr, surfaces.lumen, record.motion, last);
  }
  core::write_file(folder / "case.json", case_json(plan, number, !options.truth_only, options.phases));
  task.set_progress(1.0);
  return record;
}

}  // namespace

void validate(const SuiteOptions& options) {
  validate(options.first);
  if (options.cases < 1 || options.cases > 100)
    throw InvalidInput("the number of cases is " + std::to_string(options.cases) + "; it must be 1 to 100");
  if (options.phases < 1 || options.phases > 100)
    throw InvalidInput("the number of phases is " + std::to_string(options.phases) + "; it must be 1 to 100");
  if (!options.truth_only && !options.mhd && !options.nrrd && !options.dicom)
    throw InvalidInput("no image format is asked for; name one of mhd, nrrd, dicom, or make the truth alone");
}

int SuiteRecord::sections() const {
  int sum = 0;
  for (const CaseRecord& one : cases) sum += one.healthy + one.diseased;
  return sum;
}

double SuiteRecord::healthy_mm() const {
  double sum = 0.0;
  for (const CaseRecord& one : cases) sum += one.healthy_mm;
  return sum;
}

double SuiteRecord::diseased_mm() const {
  double sum = 0.0;
  for (const CaseRecord& one : cases) sum += one.diseased_mm;
  return sum;
}

SuiteRecord write_suite(const fs::path& folder, const SuiteOptions& options,
                        const std::function<void(const fs::path&, const SuiteRecord&)>& finish,
                        const core::TaskContext& task) {
  validate(options);
  core::StagedFolder staged(folder);
  SuiteRecord record;
  for (int i = 0; i < options.cases; ++i) {
    task.throw_if_cancelled();
    record.cases.push_back(write_case(
        staged.temporary() / ("dataset" + two_digits(i)), i, options,
        task.sub(static_cast<double>(i) / options.cases, static_cast<double>(i + 1) / options.cases)));
  }
  core::write_file(staged.temporary() / "suite.json", suite_json(options, record));
  task.throw_if_cancelled();
  if (finish) finish(staged.temporary(), record);
  staged.commit();
  return record;
}

}  // namespace ostia::phantom
