#include "output/told.h"
#include "pacs/pacs_server.h"

#include "ostia/core/log.h"

#include <cstdio>

namespace ostia::app {
namespace {

pacs::Level asked_level(const PacsFindCommand& o) {
  if (o.level == "study" || (o.level.empty() && o.study.empty())) return pacs::Level::study;
  if (o.level == "series" || (o.level.empty() && o.series.empty())) return pacs::Level::series;
  return pacs::Level::image;
}

ToldJson found_json(const pacs::Found& one, pacs::Level level) {
  ToldJson json{{"study_uid", one.study_uid}};
  const auto add = [&json](const char* name, const std::string& value) {
    if (!value.empty()) json[name] = value;
  };
  if (level == pacs::Level::study) {
    add("patient_name", one.patient_name);
    add("patient_id", one.patient_id);
    add("birth_date", one.birth_date);
    add("study_date", one.study_date);
    add("study_time", one.study_time);
    add("accession", one.accession);
    add("study_description", one.study_description);
  } else {
    json["series_uid"] = one.series_uid;
  }
  if (level == pacs::Level::series) {
    add("series_number", one.series_number);
    add("series_description", one.series_description);
  }
  if (level == pacs::Level::image) {
    json["sop_uid"] = one.sop_uid;
    add("sop_class", one.sop_class);
    return json;
  }
  add("modality", one.modality);
  if (one.images >= 0) json["images"] = one.images;
  return json;
}

void print_found(const pacs::Found& one, pacs::Level level) {
  const std::string images =
      one.images < 0 ? "" : "  " + counted(static_cast<std::size_t>(one.images), "image");
  if (level == pacs::Level::study)
    std::printf("%s  %s  %s  %s  %s%s\n  %s\n", one.study_date.c_str(), one.patient_name.c_str(),
                one.patient_id.c_str(), one.modality.c_str(), one.study_description.c_str(), images.c_str(),
                one.study_uid.c_str());
  else if (level == pacs::Level::series)
    std::printf("%s  %s  %s%s\n  %s\n", one.series_number.c_str(), one.modality.c_str(),
                one.series_description.c_str(), images.c_str(), one.series_uid.c_str());
  else
    std::printf("%s\n", one.sop_uid.c_str());
}

}  // namespace

ExitCode run_pacs_echo(const PacsEchoCommand& o, const core::TaskContext& task) {
  archive_at(o.at)->echo(task);
  task.set_progress(1.0);
  tell("pacs-echo", {{"answers", true}}, "the server answers", o.json);
  return ExitCode::ok;
}

ExitCode run_pacs_find(const PacsFindCommand& o, const core::TaskContext& task) {
  pacs::Query query;
  query.level = asked_level(o);
  query.patient_name = o.patient_name;
  query.patient_id = o.patient_id;
  query.from_date = o.from;
  query.to_date = o.to;
  query.description = o.description;
  query.modality = o.modality;
  query.study_uid = o.study;
  query.series_uid = o.series;
  query.most = o.most;
  pacs::validate(query);
  for (const std::string& secret : {o.patient_name, o.patient_id}) core::redact_in_logs(secret, "PATIENT");
  task.set_stage("searching");
  const pacs::FindResult result = archive_at(o.at)->find(query, task);
  task.set_progress(1.0);
  for (const std::string& warning : result.warnings) core::log_warning(warning);
  if (result.cut_off)
    core::log_warning("there is more than " + std::to_string(o.most) +
                      "; the first are shown: ask for less, or raise --most");
  ToldJson found = ToldJson::array();
  for (const pacs::Found& one : result.found) found.push_back(found_json(one, query.level));
  if (!o.json)
    for (const pacs::Found& one : result.found) print_found(one, query.level);
  const char* level = query.level == pacs::Level::study    ? "study"
                      : query.level == pacs::Level::series ? "series"
                                                           : "image";
  tell("pacs-find", {{"level", level}, {"cut_off", result.cut_off}, {"found", std::move(found)}},
       std::to_string(result.found.size()) + " found", o.json);
  return ExitCode::ok;
}

}  // namespace ostia::app
