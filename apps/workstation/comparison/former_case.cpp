#include "comparison/former_case.h"

#include "opening/technique.h"

#include "ostia/core/error.h"
#include "ostia/core/log.h"
#include "ostia/imaging/image_axes.h"
#include "ostia/pipeline/source.h"
#include "ostia/session/image_digest.h"
#include "ostia/session/report_digest.h"

namespace ostia::workstation {
namespace {

struct ReadImage {
  std::string sha256;
  std::shared_ptr<const imaging::ImageVolume> volume;
  imaging::ScanTechnique technique;
};

ReadImage read_image(const session::KnownImage& known, const core::TaskContext& task) {
  core::redact_in_logs(known.path.string(), "the former image");
  if (known.series_uid.empty()) {
    pipeline::SourceOptions reading;
    reading.dicom.assume_axial = true;  // whoever made the case of it has seen how it lies
    const pipeline::Source source = pipeline::load_ct(known.path, reading, task);
    return {source.sha256, source.image, source.technique.value_or(imaging::ScanTechnique())};
  }
  const auto series = series_of_image(known, task.sub(0.0, 0.1));
  if (!series) throw InvalidInput("the series of the former image is not in its folder any more");
  imaging::DicomReadOptions reading;
  reading.assume_axial = true;
  const std::string sha256 = session::image_reference(*series, task.sub(0.1, 0.3)).sha256;
  auto read = imaging::read_dicom_series(*series, reading, task.sub(0.3, 1.0));
  return {sha256, std::make_shared<const imaging::ImageVolume>(std::move(read.volume)),
          imaging::scan_technique(*series)};
}

}  // namespace

std::shared_ptr<const FormerCase> read_former_case(const std::filesystem::path& path) {
  auto file = session::CaseFile::open(path, session::OpenMode::read_only);
  if (file.model()->vessels.empty())
    throw InvalidInput("the former case has no vessels; choose one with a coronary tree");
  auto former = std::make_shared<FormerCase>();
  former->moment = session::moment_of(file);
  former->digest = session::report_digest(file);
  former->session = std::make_shared<session::Session>(std::move(file));
  return former;
}

FormerImage read_former_image(const FormerCase& former, const FormerImage& image,
                              const core::TaskContext& task) {
  const std::optional<session::ImageReference>& wanted = former.moment.reference;
  if (image.volume || !image.known || !wanted) return image;
  ReadImage read = read_image(*image.known, task);
  if (read.sha256 != wanted->sha256)
    throw InvalidInput("what was chosen is another image than that of the former case");
  if (!wanted->axes.empty())
    read.volume =
        std::make_shared<const imaging::ImageVolume>(imaging::with_axes(*read.volume, wanted->axes));
  return {image.known, read.volume, read.technique.tube_kv};
}

session::ComparedCase measured_former(const FormerCase& former, const FormerImage& image,
                                      const core::TaskContext& task) {
  session::CaseMoment moment = former.moment;
  moment.image = image.volume;
  moment.tube_kv = image.tube_kv;
  const analysis::SurfaceOfVessel surfaces = session::solved_surfaces(*moment.model, task.sub(0.0, 0.3));
  return session::measured_case(moment, surfaces, task.sub(0.3, 1.0));
}

session::Comparison compared_now(session::ComparedCase before, session::CaseMoment now,
                                 const std::optional<session::KnownImage>& known,
                                 const core::TaskContext& task) {
  if (now.image) now.tube_kv = technique_of(known, task.sub(0.0, 0.05)).tube_kv;
  const analysis::SurfaceOfVessel surfaces = session::solved_surfaces(*now.model, task.sub(0.05, 0.3));
  session::ComparedCase after = session::measured_case(now, surfaces, task.sub(0.3, 0.95));
  session::ComparisonOptions options;
  options.anyway = true;
  return session::compare_cases(std::move(before), std::move(after), options);
}

}  // namespace ostia::workstation
