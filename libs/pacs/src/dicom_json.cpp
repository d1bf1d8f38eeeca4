#include "dicom_json.h"

#include "text.h"
#include "uid.h"

#include <nlohmann/json.hpp>

namespace ostia::pacs {
namespace {

using DicomJson = nlohmann::json;

const DicomJson* first_value(const DicomJson& entry, const char* tag) {
  const auto element = entry.find(tag);
  if (element == entry.end() || !element->is_object()) return nullptr;
  const auto values = element->find("Value");
  if (values == element->end() || !values->is_array() || values->empty()) return nullptr;
  return &values->front();
}

std::string text_in(const DicomJson& entry, const char* tag) {
  const DicomJson* value = first_value(entry, tag);
  if (value == nullptr) return {};
  if (value->is_string()) return clean_text(value->get_ref<const std::string&>());
  return value->is_number() ? value->dump() : std::string();
}

std::string name_in(const DicomJson& entry, const char* tag) {
  const DicomJson* value = first_value(entry, tag);
  if (value == nullptr) return {};
  if (value->is_string()) return clean_name(value->get_ref<const std::string&>());
  for (const char* group : {"Alphabetic", "Ideographic", "Phonetic"})
    if (value->is_object() && value->contains(group) && (*value)[group].is_string())
      return clean_name((*value)[group].get_ref<const std::string&>());
  return {};
}

long count_in(const DicomJson& entry, const char* tag) {
  const DicomJson* value = first_value(entry, tag);
  if (value == nullptr) return -1;
  // Some servers write the text of an IS as it is.
  const DicomJson number =
      value->is_string() ? DicomJson::parse(value->get_ref<const std::string&>(), nullptr, false) : *value;
  if (!number.is_number()) return -1;
  const double count = number.get<double>();
  return count >= 0.0 && count < 1e9 ? static_cast<long>(count) : -1;
}

std::string all_in(const DicomJson& entry, const char* tag) {
  std::string all;
  if (first_value(entry, tag) == nullptr) return all;
  for (const DicomJson& value : entry[tag]["Value"])
    if (value.is_string()) all += (all.empty() ? "" : "\\") + clean_text(value.get_ref<const std::string&>());
  return all;
}

Found found_of(const DicomJson& entry) {
  Found one;
  one.study_uid = text_in(entry, "0020000D");
  one.series_uid = text_in(entry, "0020000E");
  one.sop_uid = text_in(entry, "00080018");
  one.sop_class = text_in(entry, "00080016");
  one.patient_name = name_in(entry, "00100010");
  one.patient_id = text_in(entry, "00100020");
  one.birth_date = text_in(entry, "00100030");
  one.study_date = text_in(entry, "00080020");
  one.study_time = text_in(entry, "00080030");
  one.accession = text_in(entry, "00080050");
  one.study_description = text_in(entry, "00081030");
  one.modality = text_in(entry, "00080060");
  if (one.modality.empty()) one.modality = all_in(entry, "00080061");
  one.series_description = text_in(entry, "0008103E");
  one.series_number = text_in(entry, "00200011");
  one.images = count_in(entry, "00201209");
  if (one.images < 0) one.images = count_in(entry, "00201208");
  return one;
}

}  // namespace

FoundPage found_in_json(const std::string& body, Level level) {
  const DicomJson all = DicomJson::parse(body, nullptr, false);
  if (!all.is_array()) throw InvalidInput("sends what is no DICOM JSON");
  FoundPage page;
  page.entries = all.size();
  for (const DicomJson& entry : all) {
    Found one = entry.is_object() ? found_of(entry) : Found{};
    const std::string& uid = level == Level::study    ? one.study_uid
                             : level == Level::series ? one.series_uid
                                                      : one.sop_uid;
    if (is_uid(uid))
      page.found.push_back(std::move(one));
    else
      ++page.without_uid;
  }
  return page;
}

std::uint32_t failure_in_json(const std::string& body) {
  const DicomJson answer = DicomJson::parse(body, nullptr, false);
  if (!answer.is_object()) return 0;
  constexpr std::uint32_t processing_failure = 0x0110;
  const DicomJson* failed = first_value(answer, "00081198");
  if (failed == nullptr || !failed->is_object()) return 0;
  const long reason = count_in(*failed, "00081197");
  return reason > 0 ? static_cast<std::uint32_t>(reason) : processing_failure;
}

}  // namespace ostia::pacs
