#include "input/case_image.h"
#include "measure/dicom_objects.h"
#include "output/refusal.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/core/log.h"
#include "ostia/dicom/label_object.h"
#include "ostia/dicom/presentation.h"
#include "ostia/imaging/archive.h"
#include "ostia/imaging/dicom.h"
#include "ostia/session/dicom_objects.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Validators.hpp>
#include <nlohmann/json.hpp>

#include <cstdio>

namespace ostia::app {
namespace {

using Json = nlohmann::ordered_json;

/// The series of a folder that the case's image is.
imaging::DicomSeries series_of_case(const std::filesystem::path& folder, const session::CaseFile& file,
                                    const core::TaskContext& task) {
  const std::optional<session::ImageReference> own = file.image();
  if (!own)
    throw InvalidInput("the case does not know its image, so that nobody can tell whether " +
                       own_name(folder) +
                       " is the patient's: leave --series out for objects with a pseudonym");
  const imaging::DicomFolder found = imaging::scan_dicom(folder, task.sub(0.0, 0.3));
  for (const imaging::DicomSeries& one : found.series)
    if (imaging::series_digest(one, task.sub(0.3, 1.0)) == own->sha256) return one;
  throw InvalidInput(own_name(folder) + ": none of its " + std::to_string(found.series.size()) +
                     " series is the image that the case was made with (" + own->pseudonym +
                     "); give the folder that it was extracted from");
}

/// Whose the objects are, and the voxels that they lie on.
struct ObjectSource {
  dicom::SourceSeries series;
  std::shared_ptr<const imaging::ImageVolume> image;
};

ObjectSource object_source(const DicomCommand& o, const session::CaseFile& file,
                           const core::TaskContext& task) {
  ObjectSource source;
  if (!o.series.empty()) {
    task.set_stage("reading");
    core::redact_in_logs(o.series.string(), "series");
    const imaging::DicomSeries series = series_of_case(o.series, file, task.sub(0.0, 0.3));
    source.series = dicom::source_of(series, task.sub(0.3, 0.6));
    imaging::DicomReadOptions reading;
    reading.assume_axial = true;
    auto loaded = imaging::read_dicom_series(series, reading, task.sub(0.6, 1.0));
    for (const std::string& warning : loaded.header.warnings) core::log_warning(warning);
    source.image = std::make_shared<const imaging::ImageVolume>(std::move(loaded.volume));
    return source;
  }
  const std::optional<session::ImageReference> own = file.image();
  source.series = dicom::pseudonymous_source(own ? own->pseudonym : "case",
                                             own ? own->sha256 : lumen::digest(*file.model()));
  if (!o.image.empty()) source.image = case_image(o.image, file, task).image;
  return source;
}

Json json_of_labels(const dicom::LabelObject& read) {
  Json segments = Json::array();
  for (const dicom::ReadSegment& one : read.segments) {
    segments.push_back({{"number", one.number}, {"label", one.label}, {"value", one.value}});
    if (one.type) segments.back()["type"] = one.type->meaning;
  }
  return {{"v", 1},
          {"kind", "DICOM label object"},
          {"size", read.volume.geometry.size},
          {"segments", segments},
          {"warnings", read.warnings}};
}

Json json_of_windows(const std::vector<dicom::PresentedWindow>& windows) {
  Json list = Json::array();
  for (const dicom::PresentedWindow& one : windows)
    list.push_back({{"centre", one.centre}, {"width", one.width}, {"images", one.instances.size()}});
  return {{"v", 1}, {"kind", "DICOM presentation state"}, {"windows", list}};
}

void put(const Json& json) {
  std::fputs((json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n").c_str(), stdout);
}

/// What an object that was given holds.
ExitCode tell_object(const std::filesystem::path& file, const core::TaskContext& task) {
  task.set_stage("reading");
  if (dicom::label_object_kind(file) != dicom::LabelObjectKind::none) {
    put(json_of_labels(dicom::read_label_object(file, {}, task)));
    return ExitCode::ok;
  }
  const std::string sop_class = imaging::dicom_sop_class(file);
  if (sop_class.empty()) throw InvalidInput(own_name(file) + " is neither a case nor a DICOM object");
  if (sop_class.starts_with("1.2.840.10008.5.1.4.1.1.88.")) {
    std::fputs(session::dicom_measurements_json(dicom::read_measurement_report(file)).c_str(), stdout);
    return ExitCode::ok;
  }
  if (sop_class.starts_with("1.2.840.10008.5.1.4.1.1.11.")) {
    put(json_of_windows(dicom::read_presented_windows(file)));
    return ExitCode::ok;
  }
  throw InvalidInput(
      own_name(file) + ": SOPClassUID (0008,0016) is " + sop_class +
      "; segmentations, structure sets, structured reports and presentation states can be told");
}

}  // namespace

ExitCode run_dicom(const DicomCommand& o, const core::TaskContext& task) {
  if (o.input.extension() != ".ostia") {
    if (!o.output.empty() || !o.series.empty() || !o.image.empty() || !o.objects.empty() || !o.ffr.empty())
      throw UsageError("objects are made of a case (.ostia); an object is told without other options");
    return tell_object(o.input, task);
  }
  if (o.output.empty()) throw UsageError("a case needs -o, the folder for its objects");
  if (!o.series.empty() && !o.image.empty())
    throw UsageError("--series has the image already; --image is for objects without a patient");
  session::DicomObjectsOptions options;
  options.kinds = session::dicom_object_kinds(o.objects);
  options.report.date = o.date;
  options.report.language = session::report_language(o.language);
  if (!o.ffr.empty()) options.ffr_json = core::read_file(o.ffr, 64U << 20);
  const session::CaseFile file = session::CaseFile::open(o.input, session::OpenMode::read_only);
  const ObjectSource source = object_source(o, file, task.sub(0.0, 0.2));
  if (!source.image && o.objects.empty()) {
    options.kinds.erase(session::DicomObjectKind::segmentation);
    core::log_warning("without the CT there is no segmentation");
  }
  const session::DicomObjects made =
      session::dicom_objects(file, source.series, source.image.get(), options, task.sub(0.2, 0.95));
  for (const std::string& warning : made.warnings) core::log_warning(warning);
  task.set_stage("writing");
  const std::string json = session::write_dicom_objects(o.output, made, source.series, task.sub(0.95, 1.0));
  task.set_progress(1.0);
  if (o.json) {
    std::fputs(json.c_str(), stdout);
  } else {
    for (const session::DicomObjectFile& one : made.objects)
      std::printf("%-11s %s\n", session::to_string(one.kind).c_str(), one.name.c_str());
  }
  return ExitCode::ok;
}

void define_dicom(CLI::App& app, DicomCommand& c, std::function<ExitCode(const core::TaskContext&)>& run) {
  CLI::App* dicom = app.add_subcommand(
      "dicom", "A case's results as DICOM objects for the patient's record; what such an object holds");
  dicom->footer(
      "Example:\n  ostia dicom heart.ostia --image heart.nrrd -o objects\n  ostia dicom "
      "objects/measurements.dcm");
  dicom->fallthrough();
  dicom
      ->add_option("INPUT", c.input,
                   "Case (.ostia); or an object to be told as JSON: segmentation, structure set, structured "
                   "report, presentation state")
      ->required();
  dicom->add_option(
      "--series", c.series,
      "DICOM folder of the CT that the case was made with: the objects name its patient and refer "
      "to it; left out: a pseudonym");
  dicom->add_option("--image", c.image, "Without --series: the CT, for its voxels alone");
  dicom->add_option("-o,--output", c.output, "Folder that is made: a file an object, and objects.json");
  dicom->add_option("--objects", c.objects,
                    "Which: seg (binary), fractional, pdf, stl, sr, images, with commas; left out: all but "
                    "fractional");
  dicom->add_option("--ffr", c.ffr, "ffr.json of ostia ffr, for the structured report");
  dicom->add_option("--date", c.date, "Date as it is to stand in the PDF; left out: none");
  dicom->add_option("--language", c.language, "Of the PDF and the key images: en or de")
      ->check(CLI::IsMember({"en", "de"}));
  dicom->add_flag("--json", c.json, "objects.json on standard output");
  dicom->callback([&] { run = [&](const core::TaskContext& task) { return run_dicom(c, task); }; });
}

}  // namespace ostia::app
