#include "cases/case_parts.h"

#include "ostia/imaging/dicom_writer.h"
#include "ostia/imaging/image_file.h"
#include "ostia/io/rotterdam_file.h"
#include "ostia/phantom/moving_case.h"

namespace ostia::phantom {
namespace fs = std::filesystem;

std::string two_digits(int number) {
  return (number < 10 ? "0" : "") + std::to_string(number);
}

void write_vessel(const fs::path& folder, const ChallengeVessel& vessel) {
  fs::create_directory(folder);
  io::write_rotterdam_reference(folder / "reference.txt", vessel.reference);
  io::write_rotterdam_point(folder / "pointA.txt", vessel.point_a);
  io::write_rotterdam_point(folder / "pointB.txt", vessel.point_b);
  io::write_rotterdam_point(folder / "pointS.txt", vessel.point_s);
  io::write_rotterdam_point(folder / "pointE.txt", vessel.point_e);
  for (std::size_t i = 0; i < vessel.observers.size(); ++i) {
    io::write_rotterdam_line(folder / ("observer" + std::to_string(i + 1) + ".txt"), vessel.observers[i]);
  }
}

void write_image(const fs::path& folder, int number, const SuiteOptions& options, const CasePlan& plan,
                 const Scan& scan, std::optional<double> percent, const core::TaskContext& task) {
  const std::string name = "image" + two_digits(number);
  if (options.mhd) imaging::write_image(folder / (name + ".mhd"), scan.image);
  task.set_progress(0.2);
  task.throw_if_cancelled();
  if (options.nrrd) imaging::write_image(folder / (name + ".nrrd"), scan.image);
  task.set_progress(0.6);
  task.throw_if_cancelled();
  if (options.dicom) {
    imaging::DicomSeriesOptions series;
    series.study_seed = series.uid_seed = parameters_json(plan.options);
    series.cardiac_phase_percent = percent;
    if (percent) series.uid_seed += "/" + phase_name(*percent);
    series.patient_id = "OSTIA-PHANTOM-" + std::to_string(plan.options.seed);
    imaging::write_dicom_series(folder / "dicom", scan.image, series, task.sub(0.6, 0.9));
  }
  task.throw_if_cancelled();
  imaging::write_image(folder / "labels.nrrd", scan.labels);
  task.set_progress(1.0);
}

}  // namespace ostia::phantom
