#include "ostia/dicom/object.h"

#include "tags.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/core/utf8.h"
#include "ostia/dicom/code.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>

namespace ostia::dicom {
namespace {

struct Copied {
  imaging::DicomTag tag;
  const char* vr;
};
/// Of patient and study, what every object of one study repeats (PS3.3 C.7.1.1, C.7.1.3, C.7.2.1, C.7.2.2).
constexpr std::array copied{
    Copied{0x00080005, "CS"}, Copied{0x00080020, "DA"}, Copied{0x00080030, "TM"}, Copied{0x00080050, "SH"},
    Copied{0x00080090, "PN"}, Copied{0x00080201, "SH"}, Copied{0x00081030, "LO"}, Copied{0x00100010, "PN"},
    Copied{0x00100020, "LO"}, Copied{0x00100021, "LO"}, Copied{0x00100030, "DA"}, Copied{0x00100040, "CS"},
    Copied{0x00101010, "AS"}, Copied{0x00101020, "DS"}, Copied{0x00101030, "DS"}, Copied{0x00120062, "CS"},
    Copied{0x00120063, "LO"}, Copied{0x0020000D, "UI"}, Copied{0x00200010, "SH"},
};
/// What must be there, if empty (type 2).
constexpr std::array always{Copied{0x00080020, "DA"}, Copied{0x00080030, "TM"}, Copied{0x00080050, "SH"},
                            Copied{0x00080090, "PN"}, Copied{0x00100010, "PN"}, Copied{0x00100020, "LO"},
                            Copied{0x00100030, "DA"}, Copied{0x00100040, "CS"}, Copied{0x00200010, "SH"}};

std::string needed(const DicomDataset& data, imaging::DicomTag tag, const char* name,
                   const std::filesystem::path& file) {
  std::string value = data.text(tag);
  if (value.empty())
    throw InvalidInput(file.string() + ": " + name + " " + imaging::dicom_tag_text(tag) +
                       " is missing; objects cannot refer to this series");
  return value;
}

bool all_ascii(const DicomDataset& data) {
  for (const auto& [tag, element] : data.elements())
    for (const char c : element.value)
      if (static_cast<unsigned char>(c) >= 0x80 || c == 0x1B) return false;
  return true;
}

DicomDataset identity_of(const DicomDataset& data) {
  DicomDataset identity;
  for (const Copied& one : copied) {
    const imaging::DicomElement* element = data.find(one.tag);
    // A study's optional texts that are empty are no use; what has a type is completed below.
    if (!element || element->value.empty()) continue;
    identity.set(one.tag, {one.vr, element->value});
  }
  // Made anew: of a file of implicit value representations the items have none.
  if (const std::optional<Code> method = code_of(data, tag::deidentification_codes))
    set_code(identity, tag::deidentification_codes, *method);
  for (const Copied& one : always)
    if (!identity.has(one.tag)) identity.set_text(one.tag, one.vr, "");
  // Plain ASCII is UTF-8, too, so that our own texts need not be changed. Character sets that are escaped to
  // are left as they are.
  if (all_ascii(identity)) identity.set_text(0x00080005, "CS", "ISO_IR 192");
  return identity;
}

/// The place of one frame of an object.
std::optional<Vec3> position_of(const DicomDataset& data, std::size_t frame) {
  std::vector<double> p = data.decimals(tag::image_position);
  if (p.size() != 3) {
    const std::vector<DicomDataset>& groups = data.items(tag::per_frame_groups);
    const DicomDataset* plane = frame < groups.size() ? groups[frame].item(tag::plane_position) : nullptr;
    if (!plane) {
      const DicomDataset* shared = data.item(tag::shared_groups);
      plane = shared ? shared->item(tag::plane_position) : nullptr;
    }
    if (plane) p = plane->decimals(tag::image_position);
  }
  if (p.size() != 3) return std::nullopt;
  return Vec3(p[0], p[1], p[2]);
}

}  // namespace

SourceSeries source_of(const imaging::DicomSeries& series, const core::TaskContext& task) {
  SourceSeries source;
  std::map<std::string, DicomDataset> read;  // a multi-frame file once
  for (std::size_t k = 0; k < series.files.size(); ++k) {
    task.throw_if_cancelled();
    const std::filesystem::path& file = series.files[k];
    auto [at, is_new] = read.try_emplace(file.string());
    if (is_new) at->second = imaging::require_dicom_object(file, {.pixels = false}).data;
    const DicomDataset& data = at->second;
    const std::size_t frame = k < series.frames.size() ? static_cast<std::size_t>(series.frames[k]) : 0;
    SourceFrame one{needed(data, tag::sop_class, "SOPClassUID", file),
                    needed(data, tag::sop_instance, "SOPInstanceUID", file), 0};
    const std::string study = needed(data, tag::study_uid, "StudyInstanceUID", file);
    const std::string own_series = needed(data, tag::series_uid, "SeriesInstanceUID", file);
    const std::string frame_uid = needed(data, tag::frame_of_reference, "FrameOfReferenceUID", file);
    if (source.frames.empty()) {
      source.identity = identity_of(data);
      source.study_uid = study;
      source.series_uid = own_series;
      source.frame_of_reference = frame_uid;
    } else if (study != source.study_uid || own_series != source.series_uid ||
               data.text(tag::patient_id) != source.identity.text(tag::patient_id) ||
               data.text(tag::patient_name) != source.identity.text(tag::patient_name)) {
      throw InvalidInput(file.string() + " is of another patient, study or series than the files before it");
    } else if (frame_uid != source.frame_of_reference) {
      throw InvalidInput(file.string() +
                         ": FrameOfReferenceUID (0020,0052) is not that of the files before it; the slices' "
                         "places cannot be compared");
    }
    if (data.integer(tag::number_of_frames).value_or(1) > 1) one.frame = static_cast<int>(frame) + 1;
    if (const auto position = position_of(data, frame)) one.position = *position;
    source.frames.push_back(std::move(one));
    if (read.size() > 1 && !data.has(tag::per_frame_groups)) read.erase(file.string());
    task.set_progress(static_cast<double>(k + 1) / static_cast<double>(series.files.size()));
  }
  if (source.frames.empty()) throw InvalidInput("the series has no files");
  return source;
}

SourceSeries pseudonymous_source(const std::string& pseudonym, const std::string& seed) {
  SourceSeries source;
  source.pseudonym = true;
  source.study_uid = imaging::dicom_uid(seed + "/study");
  source.series_uid = imaging::dicom_uid(seed + "/series");
  source.frame_of_reference = imaging::dicom_uid(seed + "/frame of reference");
  DicomDataset data;
  data.set_text(tag::patient_name, "PN", "OSTIA^PSEUDONYM");
  data.set_text(tag::patient_id, "LO", pseudonym);
  data.set_text(tag::study_uid, "UI", source.study_uid);
  data.set_text(0x00120062, "CS", "YES");
  data.set_text(0x00120063, "LO", "No identity was at hand: a pseudonym");
  source.identity = identity_of(data);
  return source;
}

DicomDataset object_head(const SourceSeries& source, const std::string& sop_class,
                         const std::string& modality, const std::string& kind, const ObjectOptions& options) {
  DicomDataset d = source.identity;
  d.set_text(tag::sop_class, "UI", sop_class);
  d.set_text(0x00080023, "DA", options.content_date);
  d.set_text(0x00080033, "TM", options.content_time);
  d.set_text(0x00080060, "CS", modality);
  d.set_text(0x00080070, "LO", "Ostia");
  d.set_text(0x00081090, "LO", "Ostia");
  set_own_text(d, d, 0x0008103E, "LO", options.series_description);
  d.set_text(0x00181000, "LO", "none");  // a program has no serial number
  set_own_text(d, d, 0x00181020, "LO",
               options.software_version.empty() ? "unknown" : options.software_version);
  d.set_text(tag::study_uid, "UI", source.study_uid);
  d.set_text(tag::series_uid, "UI", imaging::dicom_uid(source.series_uid + "/" + kind));
  d.set_text(0x00200011, "IS", std::to_string(options.series_number));
  d.set_text(0x00200013, "IS", std::to_string(options.instance_number));
  return d;
}

void seal(DicomDataset& object) {
  object.erase(tag::sop_instance);
  object.set_text(tag::sop_instance, "UI", imaging::dicom_uid("instance/" + core::sha256(object.encoded())));
}

std::string own_text(const DicomDataset& object, const std::string& utf8, std::size_t most) {
  const bool holds_all = object.text(0x00080005) == "ISO_IR 192";
  std::string result;
  std::size_t characters = 0;
  for (std::size_t i = 0; i < utf8.size() && characters < most; ++characters) {
    const auto c = static_cast<unsigned char>(utf8[i]);
    const std::size_t length = core::utf8_length(std::string_view(utf8).substr(i));
    if (c >= 0x80)
      result += holds_all && length > 0 ? utf8.substr(i, length) : "?";
    else
      result += c < 0x20 || c == 0x7F ? ' ' : c == '\\' ? '/' : static_cast<char>(c);
    i += std::max<std::size_t>(length, 1);
  }
  return result;
}

void set_own_text(DicomDataset& object, const DicomDataset& root, imaging::DicomTag tag, const char* vr,
                  const std::string& utf8) {
  const std::string_view kind = vr;
  const std::size_t most = kind == "LO" ? 64 : kind == "SH" ? 16 : kind == "ST" ? 1024 : 65'000;
  object.set_text(tag, vr, own_text(root, utf8, most));
}

void add_source_instances(const SourceSeries& source, DicomDataset& to, imaging::DicomTag tag) {
  std::set<std::string> seen;
  for (const SourceFrame& one : source.frames) {
    if (!seen.insert(one.sop_instance).second) continue;
    DicomDataset& item = to.add_item(tag);
    item.set_text(tag::referenced_class, "UI", one.sop_class);
    item.set_text(tag::referenced_instance, "UI", one.sop_instance);
  }
}

void add_referenced_series(const SourceSeries& source, DicomDataset& to) {
  if (source.frames.empty()) return;
  DicomDataset& referenced = to.add_item(tag::referenced_series);
  referenced.set_text(tag::series_uid, "UI", source.series_uid);
  add_source_instances(source, referenced, 0x0008114A);
}

}  // namespace ostia::dicom
