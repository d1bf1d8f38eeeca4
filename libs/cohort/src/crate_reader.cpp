#include "crate_reader.h"

#include "ostia/cohort/crate.h"
#include "ostia/core/error.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <functional>

namespace ostia::cohort {
namespace fs = std::filesystem;
namespace {

using nlohmann::json;

constexpr std::string_view digest_id = "#sha256-";
constexpr const char* no_crate = ": it is no crate that `ostia cohort crate` has made";

void for_each_entity(const fs::path& folder, const std::function<void(const json&)>& take) {
  std::ifstream stream(folder / crate_name, std::ios::binary);
  if (!stream)
    throw InvalidInput("cannot reproduce " + folder.string() + ": it has no " + crate_name +
                       "; `ostia cohort crate` writes it into a cohort");
  const auto look = [&](int depth, json::parse_event_t event, json& entity) {
    if (depth != 2 || event != json::parse_event_t::object_end) return true;
    take(entity);
    return false;  // not kept
  };
  try {
    if (!json::parse(stream, look).is_object())
      throw InvalidInput("cannot reproduce " + folder.string() + no_crate);
  } catch (const json::exception&) {
    throw InvalidInput("cannot reproduce " + folder.string() + no_crate + ", or it is damaged");
  }
}

std::string text_in(const json& entity, const char* name) {
  const auto value = entity.find(name);
  return value != entity.end() && value->is_string() ? value->get<std::string>() : "";
}

std::string id_in(const json& entity, const char* name) {
  const auto value = entity.find(name);
  return value != entity.end() && value->is_object() ? text_in(*value, "@id") : "";
}

bool is_pseudonym(std::string_view text) {
  return text.starts_with("p-") && text.size() > 2 &&
         text.find_first_not_of("0123456789abcdef", 2) == text.npos;
}

/// "#p-.../extract", of a step that has a result: its scan and stage.
std::optional<std::pair<std::string, std::size_t>> done_step(const json& entity) {
  const std::string id = text_in(entity, "@id");
  const std::size_t slash = id.find('/');
  if (text_in(entity, "@type") != "CreateAction" || slash == id.npos || !id.starts_with("#") ||
      id_in(entity, "actionStatus") != "http://schema.org/CompletedActionStatus")
    return {};
  const std::string scan = id.substr(1, slash - 1);
  const std::size_t stage = stage_of(id.substr(slash + 1));
  if (!is_pseudonym(scan) || stage == stages.size()) return {};
  return std::pair(scan, stage);
}

std::vector<std::string> evenly(const std::vector<std::string>& all, std::size_t only) {
  if (only == 0 || only >= all.size()) return all;
  std::vector<std::string> out;
  for (std::size_t i = 0; i < only; ++i) out.push_back(all[i * all.size() / only]);
  return out;
}

class CrateReader {
 public:
  explicit CrateReader(const std::vector<std::string>& scans) {
    for (const std::string& one : scans) scans_[one] = {one, {}};
  }
  void take(const json& entity);
  RecordedCrate result(const std::vector<std::string>& order);

 private:
  void take_file(const std::string& id, const std::string& digest);
  void take_step(const std::string& scan, std::size_t stage, const json& entity);

  std::map<std::string, RecordedScan> scans_;
  std::map<std::string, std::map<std::string, std::string>> files_;  ///< by "folder/scan"
  RecordedCrate out_;
};

void CrateReader::take_file(const std::string& id, const std::string& digest) {
  if (id.starts_with("workflow/")) {
    out_.digests[id] = digest;
    return;
  }
  const std::size_t scan = id.find('/') + 1, name = id.find('/', scan) + 1;
  if (scan == 0 || name == 0 || !scans_.contains(id.substr(scan, name - 1 - scan))) return;
  files_[id.substr(0, name - 1)][id.substr(name)] = digest;
}

void CrateReader::take_step(const std::string& scan, std::size_t stage, const json& entity) {
  const auto known = scans_.find(scan);
  if (known == scans_.end()) return;
  RecordedStep step;
  step.chain = id_in(entity, "instrument");
  for (const json& read : entity.value("object", json::array()))
    if (const std::string id = text_in(read, "@id"); id.starts_with(digest_id))
      step.read.insert(id.substr(digest_id.size()));
  known->second.steps[stage] = std::move(step);
}

void CrateReader::take(const json& entity) {
  if (const auto step = done_step(entity)) return take_step(step->first, step->second, entity);
  const std::string id = text_in(entity, "@id"), made = id_in(entity, "isBasedOn");
  // Of what a person has corrected: as the step made it.
  const std::string digest =
      made.starts_with(digest_id) ? made.substr(digest_id.size()) : text_in(entity, "sha256");
  if (!digest.empty() && !id.starts_with("#")) take_file(id, digest);
  if (text_in(entity, "name") == "ostia") out_.programs.insert(text_in(entity, "softwareVersion"));
}

RecordedCrate CrateReader::result(const std::vector<std::string>& order) {
  for (const std::string& scan : order) {
    RecordedScan& one = scans_.at(scan);
    for (std::size_t i = 0; i < stages.size(); ++i)
      if (one.steps[i]) one.steps[i]->files = files_[std::string(stages[i].folder) + "/" + scan];
    out_.scans.push_back(std::move(one));
  }
  return std::move(out_);
}

}  // namespace

RecordedCrate read_crate(const fs::path& folder, std::size_t only) {
  std::vector<std::string> all;
  for_each_entity(folder, [&](const json& entity) {
    const auto step = done_step(entity);
    if (step && (all.empty() || all.back() != step->first)) all.push_back(step->first);
  });
  if (all.empty())
    throw InvalidInput("cannot reproduce " + folder.string() + ": its " + crate_name +
                       " tells of no step that has a result");
  const std::vector<std::string> chosen = evenly(all, only);
  CrateReader reader(chosen);
  for_each_entity(folder, [&](const json& entity) { reader.take(entity); });
  return reader.result(chosen);
}

}  // namespace ostia::cohort
