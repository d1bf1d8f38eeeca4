#include "ostia/session/dicom_objects.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/core/parallel.h"
#include "ostia/core/version.h"
#include "ostia/dicom/documents.h"
#include "ostia/dicom/segmentation.h"
#include "ostia/lumen/tree_surface.h"
#include "ostia/session/doubts.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <sstream>

namespace ostia::session {
namespace fs = std::filesystem;
namespace {

using dicom::ObjectOptions;
using geometry::Vec3;

constexpr std::int64_t most_fine_voxels = 1LL << 32;
constexpr int parts_of_voxel = 4;  // a side

struct KindName {
  DicomObjectKind kind;
  const char* word;
};
constexpr KindName kind_names[] = {
    {DicomObjectKind::segmentation, "seg"}, {DicomObjectKind::fractional, "fractional"},
    {DicomObjectKind::report, "pdf"},       {DicomObjectKind::surface, "stl"},
    {DicomObjectKind::measurements, "sr"},  {DicomObjectKind::images, "images"}};

/// Of the case's last step.
ObjectOptions object_options(const CaseFile& file) {
  ObjectOptions options;
  options.software_version = core::version();
  const std::vector<JournalEntry> journal = file.journal();
  if (journal.empty()) return options;
  options.instance_number = journal.back().number;
  std::int64_t latest = 0;
  for (const JournalEntry& step : journal) latest = std::max(latest, step.time_s);
  if (latest == 0) return options;
  const auto seconds = static_cast<std::time_t>(latest);
  std::tm utc{};
  gmtime_r(&seconds, &utc);
  char text[16];
  std::strftime(text, sizeof text, "%Y%m%d", &utc);
  options.content_date = text;
  std::strftime(text, sizeof text, "%H%M%S", &utc);
  options.content_time = text;
  return options;
}

ObjectOptions described(ObjectOptions options, std::int64_t series_number, const char* what) {
  options.series_number = series_number;
  options.series_description = what;
  return options;
}

std::vector<dicom::Segment> segments_of_plaque(const LabelVolume& labels) {
  namespace codes = dicom::codes;
  std::vector<dicom::Segment> segments;
  segments.push_back({"Coronary lumen",
                      "",
                      codes::body_structure,
                      codes::vessel_lumen,
                      codes::coronary_artery,
                      {0.85, 0.1, 0.1},
                      {label_lumen}});
  const bool walls = std::any_of(labels.counts.begin(), labels.counts.end(),
                                 [](const LabelCount& one) { return one.value > label_lumen; });
  if (walls)
    segments.push_back({"Coronary artery within its outer wall",
                        "Lumen, wall and plaque",
                        codes::body_structure,
                        codes::artery,
                        codes::coronary_artery,
                        {0.95, 0.8, 0.55},
                        {1, 2, 3, 4, 5, 6}});
  const struct {
    std::uint8_t value;
    const char* label;
    const dicom::Code& type;
    std::array<double, 3> rgb;
  } classes[] = {{3, "Plaque, low attenuation", codes::soft_plaque, {0.55, 0.2, 0.7}},
                 {4, "Plaque, fibrofatty", codes::fibrolipidic_plaque, {0.2, 0.65, 0.3}},
                 {5, "Plaque, fibrous", codes::fibrous_plaque, {0.2, 0.45, 0.85}},
                 {6, "Plaque, calcified", codes::calcified_plaque, {1.0, 1.0, 1.0}}};
  for (const auto& one : classes)
    if (std::any_of(labels.counts.begin(), labels.counts.end(),
                    [&](const LabelCount& count) { return count.value == one.value; }))
      segments.push_back(
          {one.label, "", codes::abnormal_structure, one.type, codes::coronary_artery, one.rgb, {one.value}});
  return segments;
}

/// The name is the person's, who asked for it by naming the series.
imaging::ShownIdentity named_in_report(const dicom::SourceSeries& source) {
  return source.pseudonym ? imaging::ShownIdentity{} : imaging::shown_identity(source.identity);
}

dicom::CapturedPicture captured(const KeyImage& image) {
  const figure::Raster raster = image.picture.raster();
  dicom::CapturedPicture picture{raster.width, raster.height, {}, image.caption};
  picture.rgb.reserve(static_cast<std::size_t>(raster.width) * static_cast<std::size_t>(raster.height) * 3);
  for (int y = 0; y < raster.height; ++y)
    for (int x = 0; x < raster.width; ++x) {
      const std::uint8_t* pixel = raster.pixel(x, y);
      picture.rgb.insert(picture.rgb.end(), pixel, pixel + 3);
    }
  return picture;
}

/// Puts the objects of a case together.
class ObjectMaker {
 public:
  ObjectMaker(const CaseFile& file, const dicom::SourceSeries& source, const imaging::ImageVolume* image,
              const DicomObjectsOptions& options)
      : model_(file.model()),
        source_(source),
        image_(image),
        options_(options),
        head_(object_options(file)) {}

  void segmentation(const core::TaskContext& task) {
    const LabelVolume labels = label_volume(*model_, image_->geometry, VoxelLabels::plaque, image_,
                                            options_.report.walls, task.sub(0.0, 0.8));
    made.warnings.insert(made.warnings.end(), labels.warnings.begin(), labels.warnings.end());
    dicom::SegmentationOptions how;
    how.object = described(head_, 9001, "Ostia: coronary arteries, segmentation");
    add("segmentation.dcm", DicomObjectKind::segmentation,
        dicom::segmentation(source_, labels.volume, segments_of_plaque(labels), how, task.sub(0.8, 1.0)));
  }
  void fractional(const core::TaskContext& task) {
    dicom::SegmentationOptions how;
    how.object = described(head_, 9002, "Ostia: coronary lumen, occupancy");
    how.fractional = true;
    how.most = full_occupancy;
    const imaging::MaskVolume volume = lumen_occupancy(*model_, image_->geometry, task);
    add("occupancy.dcm", DicomObjectKind::fractional,
        dicom::segmentation(source_, volume,
                            {{"Coronary lumen",
                              "Share of each voxel",
                              dicom::codes::body_structure,
                              dicom::codes::vessel_lumen,
                              dicom::codes::coronary_artery,
                              {0.85, 0.1, 0.1},
                              {}}},
                            how, core::no_task()));
  }
  void surface(const core::TaskContext& task) {
    add("lumen.dcm", DicomObjectKind::surface,
        dicom::encapsulated_stl(source_, lumen::surface_of(*model_, 0.0, task), "Coronary lumen",
                                described(head_, 9003, "Ostia: coronary lumen, surface")));
  }
  void report(const CaseReport& report, const std::vector<KeyImage>& pictures) {
    add("report.dcm", DicomObjectKind::report,
        dicom::encapsulated_pdf(source_, report_pdf(report, pictures, named_in_report(source_)),
                                "Coronary CT angiography: report", described(head_, 9004, "Ostia: report")));
  }
  void measurements(const CaseReport& report) {
    add("measurements.dcm", DicomObjectKind::measurements,
        dicom::measurement_report(source_, dicom_measurements(report, options_.ffr_json),
                                  described(head_, 9005, "Ostia: measurements")));
  }
  void images(const std::vector<KeyImage>& pictures) {
    std::int64_t number = 0;
    for (const KeyImage& one : pictures) {
      ObjectOptions how = described(head_, 9006, "Ostia: key images");
      how.instance_number = head_.instance_number * 1000 + ++number;
      add("image-" + one.name + ".dcm", DicomObjectKind::images,
          dicom::secondary_capture(source_, captured(one), how));
    }
  }

  DicomObjects made;

 private:
  void add(std::string name, DicomObjectKind kind, dicom::DicomDataset data) {
    made.objects.push_back({std::move(name), kind, std::move(data)});
  }
  std::shared_ptr<const lumen::LumenModel> model_;
  const dicom::SourceSeries& source_;
  const imaging::ImageVolume* image_;
  const DicomObjectsOptions& options_;
  ObjectOptions head_;
};

/// The part of a grid that a model may lie in, in whole voxels.
imaging::Region region_about(const lumen::LumenModel& model, const imaging::Geometry& grid) {
  constexpr double margin_mm = 6.0;
  Vec3 low = Vec3::Constant(1e300), high = Vec3::Constant(-1e300);
  for (const auto& vessel : model.vessels)
    for (const lumen::SurfaceSample& sample : vessel->samples) {
      const Vec3 index = grid.index(sample.position);
      low = low.cwiseMin(index);
      high = high.cwiseMax(index);
    }
  imaging::Region region;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const double more = margin_mm / grid.spacing[axis];
    const auto size = static_cast<double>(grid.size[a]);
    region.lower[a] = static_cast<std::int64_t>(std::clamp(std::floor(low[axis] - more), 0.0, size - 1.0));
    region.upper[a] = static_cast<std::int64_t>(std::clamp(std::ceil(high[axis] + more) + 1.0, 1.0, size));
    region.upper[a] = std::max(region.upper[a], region.lower[a] + 1);
  }
  return region;
}

}  // namespace

std::string to_string(DicomObjectKind kind) {
  for (const KindName& one : kind_names)
    if (one.kind == kind) return one.word;
  return {};
}

std::set<DicomObjectKind> dicom_object_kinds(const std::string& words) {
  std::set<DicomObjectKind> kinds;
  if (words.empty())
    return {DicomObjectKind::segmentation, DicomObjectKind::report, DicomObjectKind::surface,
            DicomObjectKind::measurements, DicomObjectKind::images};
  std::istringstream list(words);
  for (std::string word; std::getline(list, word, ',');) {
    const auto* found = std::find_if(std::begin(kind_names), std::end(kind_names),
                                     [&](const KindName& one) { return word == one.word; });
    if (found == std::end(kind_names))
      throw InvalidInput("'" + word + "' is no kind of DICOM object: seg, fractional, pdf, stl, sr, images");
    kinds.insert(found->kind);
  }
  return kinds;
}

imaging::MaskVolume lumen_occupancy(const lumen::LumenModel& model, const imaging::Geometry& grid,
                                    const core::TaskContext& task) {
  const imaging::Region region = region_about(model, grid);
  imaging::Geometry fine = grid;
  std::int64_t voxels = 1;
  for (std::size_t a = 0; a < 3; ++a) {
    const auto axis = static_cast<Eigen::Index>(a);
    fine.size[a] = (region.upper[a] - region.lower[a]) * parts_of_voxel;
    fine.spacing[axis] = grid.spacing[axis] / parts_of_voxel;
    voxels *= fine.size[a];
  }
  if (voxels > most_fine_voxels)
    throw ResourceError("the occupancy of voxels would need " + std::to_string(voxels) + " places");
  // The first part's centre lies (1 - 1/n)/2 of a voxel before the voxel's.
  const double before = 0.5 - 0.5 / parts_of_voxel;
  fine.origin = grid.world(geometry::Vec3(static_cast<double>(region.lower[0]) - before,
                                          static_cast<double>(region.lower[1]) - before,
                                          static_cast<double>(region.lower[2]) - before));
  const imaging::MaskVolume inside =
      label_volume(model, fine, VoxelLabels::lumen, nullptr, {}, task.sub(0.0, 0.9)).volume;
  imaging::MaskVolume result{grid, std::vector<std::uint8_t>(static_cast<std::size_t>(grid.voxels()), 0)};
  core::parallel_for(static_cast<std::size_t>(fine.size[2] / parts_of_voxel), 1, [&](std::size_t slice) {
    const auto k = static_cast<std::int64_t>(slice);
    for (std::int64_t kk = k * parts_of_voxel; kk < (k + 1) * parts_of_voxel; ++kk)
      for (std::int64_t j = 0; j < fine.size[1]; ++j)
        for (std::int64_t i = 0; i < fine.size[0]; ++i)
          if (inside(i, j, kk) != 0)
            ++result(region.lower[0] + i / parts_of_voxel, region.lower[1] + j / parts_of_voxel,
                     region.lower[2] + k);
  });
  task.set_progress(1.0);
  return result;
}

DicomObjects dicom_objects(const CaseFile& file, const dicom::SourceSeries& source,
                           const imaging::ImageVolume* image, const DicomObjectsOptions& options,
                           const core::TaskContext& task) {
  const std::set<DicomObjectKind>& kinds = options.kinds;
  const auto wanted = [&](DicomObjectKind kind) { return kinds.count(kind) != 0; };
  const std::optional<ImageReference> own = file.image();
  if (own && !own->axes.empty())
    throw InvalidInput(
        "the axes of this case's image were set by a person, since its file says them wrongly: objects on "
        "the "
        "file's own frame of reference would be shown in the wrong place. Have the series corrected first");
  if (image == nullptr && (wanted(DicomObjectKind::segmentation) || wanted(DicomObjectKind::fractional)))
    throw InvalidInput("a segmentation lies on the voxels of the CT: give it");
  ObjectMaker maker(file, source, image, options);
  if (source.pseudonym)
    maker.made.warnings.push_back(
        "no series was given: the objects carry a pseudonym and belong to no study of a PACS");
  if (wanted(DicomObjectKind::segmentation)) maker.segmentation(task.sub(0.0, 0.3));
  if (wanted(DicomObjectKind::fractional)) maker.fractional(task.sub(0.3, 0.4));
  if (wanted(DicomObjectKind::surface)) maker.surface(task.sub(0.4, 0.5));
  const bool pictures = wanted(DicomObjectKind::report) || wanted(DicomObjectKind::images);
  if (pictures || wanted(DicomObjectKind::measurements)) {
    ReportOptions how = options.report;
    if (!how.image) how.image = own;
    how.certainty = kept_certainty(file);
    const analysis::SurfaceOfVessel surfaces = solved_surfaces(*file.model(), task.sub(0.5, 0.6));
    const CaseReport report = make_case_report(*file.model(), surfaces, *file.annotations(), file.journal(),
                                               image, how, task.sub(0.6, 0.75));
    maker.made.warnings.insert(maker.made.warnings.end(), report.warnings.begin(), report.warnings.end());
    std::vector<KeyImage> images;
    if (pictures) images = key_images(report, *file.model(), surfaces, image, task.sub(0.75, 0.95));
    if (wanted(DicomObjectKind::report)) maker.report(report, images);
    if (wanted(DicomObjectKind::measurements)) maker.measurements(report);
    if (wanted(DicomObjectKind::images)) maker.images(images);
  }
  task.set_progress(1.0);
  return std::move(maker.made);
}

std::string write_dicom_objects(const fs::path& folder, const DicomObjects& made,
                                const dicom::SourceSeries& source, const core::TaskContext& task) {
  std::error_code error;
  if (fs::exists(folder, error) && !(fs::is_directory(folder, error) && fs::is_empty(folder, error)))
    throw IoError("cannot write to " + folder.string() + ": it is there already and not an empty folder");
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  core::StagedFolder staged(folder);
  for (const DicomObjectFile& one : made.objects) {
    task.throw_if_cancelled();
    const std::string bytes = imaging::dicom_file(one.data);
    core::write_file(staged.temporary() / one.name, bytes);
    list.push_back({{"file", one.name},
                    {"kind", to_string(one.kind)},
                    {"sop_class", one.data.text(0x00080016)},
                    {"sop_instance", one.data.text(0x00080018)},
                    {"series", one.data.text(0x0020000E)},
                    {"bytes", bytes.size()},
                    {"sha256", core::sha256(bytes)}});
  }
  const std::string json = nlohmann::ordered_json{{"v", 1},
                                                  {"kind", "DICOM objects"},
                                                  {"study", source.study_uid},
                                                  {"pseudonym", source.pseudonym},
                                                  {"objects", list},
                                                  {"warnings", made.warnings}}
                               .dump(2) +
                           "\n";
  core::write_file(staged.temporary() / "objects.json", json);
  staged.commit();
  return json;
}

}  // namespace ostia::session
