#include "ostia/dicom/measurement_report.h"

#include "tags.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"

#include <cmath>
#include <map>

namespace ostia::dicom {
namespace {

constexpr const char* comprehensive_3d_sr = "1.2.840.10008.5.1.4.1.1.88.34";
constexpr imaging::DicomTag content = 0x0040A730, relation = 0x0040A010, value_type = 0x0040A040,
                            concept_name = 0x0040A043, concept_code = 0x0040A168, text_value = 0x0040A160,
                            uid_value = 0x0040A124, measured_value = 0x0040A300, numeric_value = 0x0040A30A,
                            units = 0x004008EA;

const Code finding_code{"121071", "DCM", "Finding"};
const Code site_code{"363698007", "SCT", "Finding Site"};
const Code tracking_id{"112039", "DCM", "Tracking Identifier"};
const Code tracking_uid{"112040", "DCM", "Tracking Unique Identifier"};
const Code group_code{"125007", "DCM", "Measurement Group"};
const Code measurements_code{"126010", "DCM", "Imaging Measurements"};
const Code qualitative_code{"C0034375", "UMLS", "Qualitative Evaluations"};
const Code derivation_code{"121401", "DCM", "Derivation"};

DicomDataset item_of(const char* how, const char* type, const Code& name) {
  DicomDataset item;
  item.set_text(relation, "CS", how);
  item.set_text(value_type, "CS", type);
  set_code(item, concept_name, name);
  return item;
}

DicomDataset container(const char* how, const Code& name, const char* continuity = "SEPARATE") {
  DicomDataset item = item_of(how, "CONTAINER", name);
  item.set_text(0x0040A050, "CS", continuity);
  return item;
}

DicomDataset code_item(const char* how, const Code& name, const Code& value) {
  DicomDataset item = item_of(how, "CODE", name);
  set_code(item, concept_code, value);
  return item;
}

DicomDataset text_item(const char* how, const Code& name, const std::string& text, const DicomDataset& root) {
  DicomDataset item = item_of(how, "TEXT", name);
  set_own_text(item, root, text_value, "UT", text);
  return item;
}

DicomDataset uid_item(const char* how, const Code& name, const std::string& uid) {
  DicomDataset item = item_of(how, "UIDREF", name);
  item.set_text(uid_value, "UI", uid);
  return item;
}

DicomDataset number_item(const MeasuredNumber& number) {
  if (!std::isfinite(number.value))
    throw InvalidInput("DICOM report: " + number.name.meaning + " is not a finite number");
  DicomDataset item = item_of("CONTAINS", "NUM", number.name);
  DicomDataset& value = item.add_item(measured_value);
  value.set_text(numeric_value, "DS", core::significant_text(number.value, 6));
  value.set_f64(0x0040A161, number.value);
  set_code(value, units, number.unit);
  if (number.derivation)
    item.add_item(content) = code_item("HAS CONCEPT MOD", derivation_code, *number.derivation);
  return item;
}

DicomDataset statement_item(const Statement& one, const DicomDataset& root) {
  return one.value ? code_item("CONTAINS", one.name, *one.value)
                   : text_item("CONTAINS", one.name, one.text, root);
}

DicomDataset group_item(const MeasurementGroup& group, const DicomDataset& root, const SourceSeries& source) {
  DicomDataset item = container("CONTAINS", group_code);
  DicomDataset& used = item.add_item(0x0040A504);
  used.set_text(0x00080105, "CS", "DCMR");
  used.set_text(0x0040DB00, "CS", "1501");
  item.add_item(content) = text_item("HAS OBS CONTEXT", tracking_id, group.tracking, root);
  item.add_item(content) = uid_item("HAS OBS CONTEXT", tracking_uid,
                                    imaging::dicom_uid(source.series_uid + "/tracked/" + group.tracking));
  if (group.finding) item.add_item(content) = code_item("CONTAINS", finding_code, *group.finding);
  if (group.site) item.add_item(content) = code_item("HAS CONCEPT MOD", site_code, *group.site);
  for (const MeasuredNumber& number : group.numbers) item.add_item(content) = number_item(number);
  for (const Statement& one : group.statements) item.add_item(content) = statement_item(one, root);
  return item;
}

/// The program as the one that observes (TID 1001, 1002, 1004).
void add_observer(DicomDataset& root, const ObjectOptions& options) {
  root.add_item(content) =
      code_item("HAS OBS CONTEXT", {"121005", "DCM", "Observer Type"}, {"121007", "DCM", "Device"});
  root.add_item(content) = uid_item("HAS OBS CONTEXT", {"121012", "DCM", "Device Observer UID"},
                                    imaging::dicom_uid("Ostia as an observer " + options.software_version));
  root.add_item(content) =
      text_item("HAS OBS CONTEXT", {"121013", "DCM", "Device Observer Name"}, "Ostia", root);
  root.add_item(content) =
      text_item("HAS OBS CONTEXT", {"121014", "DCM", "Device Observer Manufacturer"}, "Ostia", root);
  root.add_item(content) =
      text_item("HAS OBS CONTEXT", {"121015", "DCM", "Device Observer Model Name"}, "Ostia", root);
}

/// The images that it was measured on, as TID 1600 has them.
void add_image_library(DicomDataset& root, const SourceSeries& source) {
  DicomDataset library = container("CONTAINS", {"111028", "DCM", "Image Library"});
  DicomDataset group = container("CONTAINS", {"126200", "DCM", "Image Library Group"});
  std::map<std::string, bool> seen;
  for (const SourceFrame& frame : source.frames) {
    if (!seen.emplace(frame.sop_instance, true).second) continue;
    DicomDataset image;
    image.set_text(relation, "CS", "CONTAINS");
    image.set_text(value_type, "CS", "IMAGE");
    DicomDataset& reference = image.add_item(0x00081199);
    reference.set_text(tag::referenced_class, "UI", frame.sop_class);
    reference.set_text(tag::referenced_instance, "UI", frame.sop_instance);
    group.add_item(content) = std::move(image);
  }
  library.add_item(content) = std::move(group);
  root.add_item(content) = std::move(library);
}

void add_evidence(DicomDataset& root, const SourceSeries& source) {
  DicomDataset& study = root.add_item(0x0040A375);
  DicomDataset& series = study.add_item(tag::referenced_series);
  add_source_instances(source, series, 0x00081199);
  series.set_text(tag::series_uid, "UI", source.series_uid);
  study.set_text(tag::study_uid, "UI", source.study_uid);
}

DicomDataset report_head(const SourceSeries& source, const ObjectOptions& options) {
  DicomDataset root = object_head(source, comprehensive_3d_sr, "SR", "measurements", options);
  DicomDataset& own_scheme = root.add_item(0x00080110);
  own_scheme.set_text(0x00080102, "SH", "99OSTIA");
  own_scheme.set_text(0x00080115, "ST", "Ostia");
  own_scheme.set_text(0x00080116, "ST", "Ostia");
  root.set_sequence(0x00081111);  // no performed procedure step is known
  root.set_text(value_type, "CS", "CONTAINER");
  set_code(root, concept_name, {"126000", "DCM", "Imaging Measurement Report"});
  root.set_text(0x0040A050, "CS", "SEPARATE");
  root.set_sequence(0x0040A372);
  root.set_text(0x0040A491, "CS", "COMPLETE");
  root.set_text(0x0040A493, "CS", "UNVERIFIED");
  DicomDataset& used = root.add_item(0x0040A504);
  used.set_text(0x00080105, "CS", "DCMR");
  used.set_text(0x0040DB00, "CS", "1500");
  return root;
}

std::optional<MeasuredNumber> number_of(const DicomDataset& item) {
  const std::optional<Code> name = code_of(item, concept_name);
  const DicomDataset* value = item.item(measured_value);
  if (!name || !value) return std::nullopt;
  const std::optional<double> number = value->decimal(numeric_value);
  const std::optional<Code> unit = code_of(*value, units);
  if (!number || !unit) return std::nullopt;
  MeasuredNumber read{*name, *number, *unit, {}};
  for (const DicomDataset& below : item.items(content))
    if (const auto what = code_of(below, concept_name); what && *what == derivation_code)
      read.derivation = code_of(below, concept_code);
  return read;
}

std::optional<Statement> statement_of(const DicomDataset& item) {
  const std::optional<Code> name = code_of(item, concept_name);
  if (!name) return std::nullopt;
  const std::string type = item.text(value_type);
  if (type == "CODE") return Statement{*name, code_of(item, concept_code), {}};
  if (type == "TEXT") return Statement{*name, {}, item.text(text_value)};
  return std::nullopt;
}

MeasurementGroup group_of(const DicomDataset& container_item) {
  MeasurementGroup group;
  for (const DicomDataset& item : container_item.items(content)) {
    const std::optional<Code> name = code_of(item, concept_name);
    if (!name) continue;
    if (item.text(value_type) == "NUM") {
      if (const auto number = number_of(item)) group.numbers.push_back(*number);
    } else if (*name == tracking_id) {
      group.tracking = item.text(text_value);
    } else if (*name == finding_code) {
      group.finding = code_of(item, concept_code);
    } else if (*name == site_code) {
      group.site = code_of(item, concept_code);
    } else if (const auto said = statement_of(item)) {
      group.statements.push_back(*said);
    }
  }
  return group;
}

void gather(const DicomDataset& item, std::size_t depth, MeasurementReport& to) {
  if (depth > 16) return;
  const std::optional<Code> name = code_of(item, concept_name);
  if (name && *name == group_code) {
    to.groups.push_back(group_of(item));
    return;
  }
  const bool evaluations = name && *name == qualitative_code;
  for (const DicomDataset& below : item.items(content)) {
    if (evaluations) {
      if (const auto said = statement_of(below)) to.statements.push_back(*said);
    }
    gather(below, depth + 1, to);
  }
}

}  // namespace

DicomDataset measurement_report(const SourceSeries& source, const MeasurementReport& report,
                                const ObjectOptions& options) {
  if (report.groups.empty()) throw InvalidInput("DICOM report: nothing was measured");
  DicomDataset root = report_head(source, options);
  root.add_item(content) =
      code_item("HAS CONCEPT MOD", {"121049", "DCM", "Language of Content Item and Descendants"},
                {"en", "RFC5646", "English"});
  add_observer(root, options);
  root.add_item(content) = code_item("HAS CONCEPT MOD", {"121058", "DCM", "Procedure reported"},
                                     {"25045-6", "LN", "CT unspecified body region"});
  if (!source.frames.empty()) {
    add_image_library(root, source);
    add_evidence(root, source);
  }
  DicomDataset measurements = container("CONTAINS", measurements_code);
  for (const MeasurementGroup& group : report.groups)
    measurements.add_item(content) = group_item(group, root, source);
  root.add_item(content) = std::move(measurements);
  if (!report.statements.empty()) {
    DicomDataset evaluations = container("CONTAINS", qualitative_code);
    for (const Statement& one : report.statements) evaluations.add_item(content) = statement_item(one, root);
    root.add_item(content) = std::move(evaluations);
  }
  seal(root);
  return root;
}

MeasurementReport read_measurement_report(const std::filesystem::path& path) {
  const DicomDataset data = imaging::require_dicom_object(path).data;
  MeasurementReport report;
  if (data.text(value_type) != "CONTAINER" || data.items(content).empty())
    throw InvalidInput(path.string() +
                       ": ContentSequence (0040,A730) is missing; it is no structured report");
  gather(data, 0, report);
  if (report.groups.empty())
    throw InvalidInput(
        path.string() +
        ": it holds no measurement group (125007, DCM); only reports of template 1500 can be read");
  return report;
}

}  // namespace ostia::dicom
