#include "ostia/dicom/deidentify.h"

#include "deidentify_rules.h"
#include "tags.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/dicom/code.h"
#include "ostia/imaging/files_below.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstdio>
#include <random>
#include <tuple>

namespace ostia::dicom {
namespace fs = std::filesystem;
namespace {

using imaging::DicomDataset;
using imaging::DicomElement;
using imaging::DicomObject;
using imaging::DicomTag;

/// CT and MR, single-frame, enhanced, and enhanced by conversion (PS3.6 annex A).
constexpr std::array image_classes{"1.2.840.10008.5.1.4.1.1.2",   "1.2.840.10008.5.1.4.1.1.2.1",
                                   "1.2.840.10008.5.1.4.1.1.2.2", "1.2.840.10008.5.1.4.1.1.4",
                                   "1.2.840.10008.5.1.4.1.1.4.1", "1.2.840.10008.5.1.4.1.1.4.4"};

bool is_private(DicomTag tag) {
  return (tag >> 16) % 2 != 0;
}

std::string why_not(const DicomDataset& data) {
  const std::string sop_class = data.text(tag::sop_class);
  if (std::find(image_classes.begin(), image_classes.end(), sop_class) == image_classes.end())
    return "it is no image of CT or MR (SOPClassUID (0008,0016) '" + sop_class + "')";
  if (data.text(0x00280301) == "YES")
    return "its pixels are said to show texts (BurnedInAnnotation (0028,0301) YES); they may name the "
           "patient";
  if (data.text(tag::sop_instance).empty() || data.text(tag::series_uid).empty())
    return "it has no SOPInstanceUID (0008,0018) or SeriesInstanceUID (0020,000E)";
  return {};
}

/// A sequence that could not be taken apart: what is in it was not looked at.
bool hides_items(const DicomElement& element) {
  return element.items.empty() && (element.vr.empty() || element.vr == "UN") &&
         element.value.compare(0, 4, "\xFE\xFF\x00\xE0", 4) == 0;
}

std::string new_uid(const std::string& old, const std::string& key) {
  return imaging::dicom_uid("de-identified/" + key + "/" + old);
}

void count_removed(const DicomDataset& data, DeidentifyReport& report) {
  for (const auto& [tag, element] : data.elements()) {
    if (is_private(tag))
      ++report.private_removed;
    else
      ++report.tags[tag].removed;
    for (const DicomDataset& item : element.items) count_removed(item, report);
  }
}

DicomDataset cleaned(const DicomDataset& data, const std::string& key, DeidentifyReport& report) {
  DicomDataset result;
  for (const auto& [tag, element] : data.elements()) {
    switch (is_private(tag) ? TagFate::remove : fate_of(tag)) {
      case TagFate::keep: {
        if (hides_items(element)) {
          ++report.tags[tag].removed;
          break;
        }
        DicomElement copy = element;
        for (DicomDataset& item : copy.items) item = cleaned(item, key, report);
        result.set(tag, std::move(copy));
        break;
      }
      case TagFate::empty:
        ++report.tags[tag].emptied;
        result.set(tag, {element.vr, {}});
        break;
      case TagFate::new_uid: {
        ++report.tags[tag].replaced;
        const std::string old = data.text(tag);
        DicomElement replaced{element.vr, old.empty() ? std::string() : new_uid(old, key)};
        if (replaced.value.size() % 2 != 0) replaced.value.push_back('\0');
        result.set(tag, std::move(replaced));
        break;
      }
      case TagFate::dummy_date:
      case TagFate::dummy_time:
        ++report.tags[tag].replaced;
        result.set(tag, {element.vr, fate_of(tag) == TagFate::dummy_date ? "19700101" : "000000"});
        break;
      case TagFate::remove:
        if (is_private(tag))
          ++report.private_removed;
        else
          ++report.tags[tag].removed;
        for (const DicomDataset& item : element.items) count_removed(item, report);
        break;
    }
  }
  return result;
}

std::string random_key() {
  std::random_device device;
  std::string key;
  for (int i = 0; i < 8; ++i) key += std::to_string(device()) + ".";
  return key;
}

void require_patient(const std::string& patient) {
  const bool fine =
      !patient.empty() && patient.size() <= 64 &&
      std::all_of(patient.begin(), patient.end(), [](char c) { return c >= ' ' && c <= '~' && c != '\\'; });
  if (!fine)
    throw InvalidInput(
        "the patient's new name must be 1 to 64 printable ASCII characters without a backslash");
}

struct ToCopy {
  fs::path file;
  std::string series, instance;  // new UIDs
  std::int64_t number = 0;
};

std::vector<ToCopy> images_below(const fs::path& input, const std::string& key, DeidentifyReport& report,
                                 const core::TaskContext& task) {
  std::error_code error;
  const std::vector<fs::path> files =
      fs::is_directory(input, error) ? imaging::files_below(input) : std::vector{input};
  std::vector<ToCopy> images;
  for (const fs::path& file : files) {
    task.throw_if_cancelled();
    std::optional<DicomObject> object;
    std::string reason;
    try {
      object = imaging::read_dicom_object(file, {.pixels = false});
      reason = object ? why_not(object->data) : "it is no DICOM file";
    } catch (const InvalidInput&) {
      reason = "the DICOM file is damaged";
    }
    if (!reason.empty()) {
      report.left_out.push_back(reason);
      continue;
    }
    images.push_back({file, new_uid(object->data.text(tag::series_uid), key),
                      new_uid(object->data.text(tag::sop_instance), key),
                      object->data.integer(0x00200013).value_or(0)});
  }
  return images;
}

std::string image_name(std::size_t i) {
  char name[32];
  std::snprintf(name, sizeof name, "IM%06zu.dcm", i + 1);
  return name;
}

}  // namespace

DicomDataset deidentified(const DicomDataset& object, const std::string& key, const std::string& patient,
                          DeidentifyReport& report) {
  require_patient(patient);
  if (const std::string reason = why_not(object); !reason.empty()) throw InvalidInput(reason);
  DicomDataset result = cleaned(object, key, report);
  for (const auto& [tag, vr] : {std::pair{DicomTag{0x00080020}, "DA"},
                                {0x00080030, "TM"},
                                {0x00080050, "SH"},
                                {0x00080090, "PN"},
                                {0x00100030, "DA"},
                                {0x00100040, "CS"},
                                {0x00200010, "SH"}})
    if (!result.has(tag)) result.set_text(tag, vr, "");
  for (const DicomTag one : {tag::patient_name, tag::patient_id}) {
    result.set_text(one, one == tag::patient_name ? "PN" : "LO", patient);
    // They were counted as removed; they are replaced.
    if (object.has(one)) --report.tags[one].removed;
    ++report.tags[one].replaced;
  }
  result.set_text(0x00120062, "CS", "YES");
  result.set_text(0x00120063, "LO", "PS3.15 Basic Profile, by a list of what is kept");
  result.erase(tag::deidentification_codes);
  set_code(result, tag::deidentification_codes,
           {"113100", "DCM", "Basic Application Confidentiality Profile"});
  return result;
}

std::string deidentify_json(const DeidentifyReport& report) {
  using Json = nlohmann::ordered_json;
  Json tags = Json::array();
  for (const auto& [tag, counts] : report.tags) {
    if (counts.removed + counts.emptied + counts.replaced == 0) continue;
    tags.push_back({{"tag", imaging::dicom_tag_text(tag)},
                    {"removed", counts.removed},
                    {"emptied", counts.emptied},
                    {"replaced", counts.replaced}});
  }
  std::map<std::string, std::size_t> reasons;
  for (const std::string& one : report.left_out) ++reasons[one];
  Json left_out = Json::array();
  for (const auto& [reason, count] : reasons) left_out.push_back({{"reason", reason}, {"files", count}});
  return Json{{"v", 1},
              {"kind", "de-identified images"},
              {"profile", "PS3.15 Basic Application Level Confidentiality Profile"},
              {"files", report.files},
              {"left_out", left_out},
              {"attributes", tags},
              {"private_attributes_removed", report.private_removed},
              {"warnings", report.warnings}}
             .dump(2) +
         "\n";
}

DeidentifyReport deidentify(const fs::path& input, const fs::path& output, const DeidentifyOptions& options,
                            const core::TaskContext& task) {
  require_patient(options.patient);
  std::error_code error;
  if (!fs::exists(input, error))
    throw IoError("cannot read " + input.string() + ": there is no such file or folder");
  if (fs::exists(output, error) && !(fs::is_directory(output, error) && fs::is_empty(output, error)))
    throw IoError("cannot write to " + output.string() + ": it is there already and not an empty folder");
  const std::string key = options.key.empty() ? random_key() : options.key;
  DeidentifyReport report;
  task.set_stage("looking through the files");
  std::vector<ToCopy> images = images_below(input, key, report, task.sub(0.0, 0.2));
  if (images.empty())
    throw InvalidInput(input.string() + " holds no DICOM image of CT or MR that can be de-identified" +
                       (report.left_out.empty() ? std::string() : ": " + report.left_out.front()));
  std::sort(images.begin(), images.end(), [](const ToCopy& a, const ToCopy& b) {
    return std::tie(a.series, a.number, a.instance) < std::tie(b.series, b.number, b.instance);
  });
  task.set_stage("writing");
  core::StagedFolder staged(output);
  std::string last;
  bool may_show_texts = false;
  for (std::size_t i = 0; i < images.size(); ++i) {
    task.throw_if_cancelled();
    if (images[i].instance == last) {
      report.left_out.push_back("it is there twice (SOPInstanceUID (0008,0018))");
      continue;
    }
    last = images[i].instance;
    DicomObject object = imaging::require_dicom_object(images[i].file);
    may_show_texts = may_show_texts || object.data.text(0x00280301).empty();
    object.data = deidentified(object.data, key, options.patient, report);
    core::write_file(staged.temporary() / image_name(report.files), imaging::dicom_file(object));
    ++report.files;
    task.set_progress(0.2 + 0.8 * static_cast<double>(i + 1) / static_cast<double>(images.size()));
  }
  if (may_show_texts)
    report.warnings.push_back(
        "the files do not say whether their pixels show texts (0028,0301): look at them");
  report.warnings.push_back("pixel data are copied as they are: a face can be made of images of a head");
  core::write_file(staged.temporary() / "deidentified.json", deidentify_json(report));
  staged.commit();
  return report;
}

}  // namespace ostia::dicom
