#pragma once
/// \file What a case says of its patient as DICOM objects that a PACS keeps
/// (docs/reference/dicom-objects.md).

#include "ostia/core/task_context.h"
#include "ostia/dicom/measurement_report.h"
#include "ostia/dicom/object.h"
#include "ostia/session/case_report.h"
#include "ostia/session/label_volume.h"

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace ostia::session {

enum class DicomObjectKind {
  segmentation,  ///< "seg": lumen, outer wall and classes of plaque, binary; without a CT the lumen alone
  fractional,    ///< "fractional": the lumen's share of each voxel
  report,        ///< "pdf"
  surface,       ///< "stl"
  measurements,  ///< "sr"
  images,        ///< "images": the report's key images
};
std::string to_string(DicomObjectKind kind);
/// "seg,pdf"; empty: all but the fractional one. Throws InvalidInput for a word that is none.
std::set<DicomObjectKind> dicom_object_kinds(const std::string& words);

struct DicomObjectsOptions {
  std::set<DicomObjectKind> kinds = dicom_object_kinds("");
  ReportOptions report;
  std::string ffr_json;  ///< ffr.json of `ostia ffr` of this case; empty: none was computed
};

struct DicomObjectFile {
  std::string name;  ///< of its file: "segmentation.dcm"
  DicomObjectKind kind = DicomObjectKind::segmentation;
  dicom::DicomDataset data;
};
struct DicomObjects {
  std::vector<DicomObjectFile> objects;
  std::vector<std::string> warnings;
};

/// All from the case's model, solved afresh. Date, time and number of the objects are those of the case's
/// last step, so that an unchanged case gives the same objects with the same UIDs, and a changed one new
/// instances of the same series. `image`: the CT, on its file's own grid; null: no segmentation, no plaque,
/// key images show the model alone. A person who sees the objects is the source's patient: the report names
/// them where the source does. Throws InvalidInput for a case whose image lies otherwise than its file says
/// (its frame of reference would be a wrong one), for segmentations without an image, or an FFR that is not
/// this format; Cancelled.
DicomObjects dicom_objects(const CaseFile& file, const dicom::SourceSeries& source,
                           const imaging::ImageVolume* image, const DicomObjectsOptions& options = {},
                           const core::TaskContext& task = core::no_task());

/// The measurements alone, as the structured report has them.
dicom::MeasurementReport dicom_measurements(const CaseReport& report, const std::string& ffr_json = {});
/// {"v": 1, "kind": "measurements of a structured report", ...} (schema `dicom-measurements`).
std::string dicom_measurements_json(const dicom::MeasurementReport& report);

/// Occupancies of the lumen, 0 to 64: of 4 x 4 x 4 places in each voxel. Throws as label_volume does.
imaging::MaskVolume lumen_occupancy(const lumen::LumenModel& model, const imaging::Geometry& grid,
                                    const core::TaskContext& task = core::no_task());
inline constexpr std::uint8_t full_occupancy = 64;

/// A file an object and objects.json (schema `dicom-objects`), which is also returned. The folder appears
/// whole or not at all and must not hold other files. Throws IoError, ResourceError, Cancelled.
std::string write_dicom_objects(const std::filesystem::path& folder, const DicomObjects& made,
                                const dicom::SourceSeries& source,
                                const core::TaskContext& task = core::no_task());

}  // namespace ostia::session
