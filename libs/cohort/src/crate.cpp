#include "ostia/cohort/crate.h"

#include "stage_results.h"
#include "workflow_runs.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/pipeline/manifest.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <map>
#include <set>

namespace ostia::cohort {
namespace fs = std::filesystem;
namespace {

using Entity = nlohmann::ordered_json;

constexpr const char* crate_11 = "https://w3id.org/ro/crate/1.1";
constexpr const char* profiles[][3] = {
    {"https://w3id.org/ro/wfrun/process/0.5", "Process Run Crate", "0.5"},
    {"https://w3id.org/ro/wfrun/workflow/0.5", "Workflow Run Crate", "0.5"},
    {"https://w3id.org/ro/wfrun/provenance/0.5", "Provenance Run Crate", "0.5"},
    {"https://w3id.org/workflowhub/workflow-ro-crate/1.0", "Workflow RO-Crate", "1.0"}};
constexpr const char* snakefile_id = "workflow/Snakefile";
constexpr const char* language_id = "https://w3id.org/workflowhub/workflow-ro-crate#snakemake";

Entity link_to(const std::string& id) {
  return {{"@id", id}};
}

/// References of one property, which may be many: kept as text.
class References {
 public:
  void add(const std::string& id) { text_ += (text_.empty() ? "" : ",") + link_to(id).dump(); }
  /// The entity's text with the property `name` of these.
  static std::string with(std::string text, const char* name, const References& all) {
    text.pop_back();
    return text + ",\"" + name + "\":[" + all.text_ + "]}";
  }

 private:
  std::string text_;
};

const char* format_of(const std::string& name) {
  constexpr std::pair<std::string_view, const char*> formats[] = {{".json", "application/json"},
                                                                  {".csv", "text/csv"},
                                                                  {".html", "text/html"},
                                                                  {".pdf", "application/pdf"},
                                                                  {".png", "image/png"},
                                                                  {".py", "text/x-python"},
                                                                  {".stl", "model/stl"},
                                                                  {".vtu", "application/xml"},
                                                                  {".vtp", "application/xml"},
                                                                  {".nrrd", "application/nrrd"},
                                                                  {".ostia", "application/vnd.sqlite3"}};
  for (const auto& [ending, format] : formats)
    if (name.ends_with(ending)) return format;
  return "application/octet-stream";
}

class CrateWriter {
 public:
  CrateWriter(const fs::path& file, const OpenCohort& cohort, const CrateOptions& options)
      : stream_(file, std::ios::binary),
        cohort_(cohort),
        options_(options),
        runs_(workflow_runs(cohort.folder())) {
    stream_ << R"({"@context":["https://w3id.org/ro/crate/1.1/context",)"
               R"("https://w3id.org/ro/terms/workflow-run/context"],"@graph":[)"
            << "\n";
  }
  void take(const CohortScan& scan);
  CrateResult close();

 private:
  void add(const std::string& entity) { stream_ << (first_ ? "" : ",\n") << entity, first_ = false; }
  void add(const Entity& entity) { add(entity.dump(-1, ' ', false, Entity::error_handler_t::replace)); }
  bool is_new(const std::string& id) { return told_.insert(id).second; }
  Entity property(const std::string& id, const char* name, const Entity& value, const char* unit = "");
  std::string add_program(const Entity& program);
  std::string add_parameters(const Entity& manifest);
  void add_done(const CohortScan& scan, std::size_t stage);
  void add_failed(const CohortScan& scan, std::size_t stage);
  void add_step(const Entity& action, std::size_t stage);
  std::vector<std::string> add_results(const CohortScan& scan, std::size_t stage, const Entity& outputs);
  std::string add_content(const std::string& digest);
  void add_workflow();
  void add_runs();
  void add_root();

  std::ofstream stream_;
  const OpenCohort& cohort_;
  const CrateOptions& options_;
  const std::vector<nlohmann::json> runs_;
  bool first_ = true;
  std::set<std::string> told_;
  std::set<std::string> chains_[stages.size()];
  std::map<std::string, std::string> program_of_chain_;
  References parts_, mentions_, controls_, results_;
  std::string last_;  ///< when the last result was made
  CrateResult out_;
};

Entity CrateWriter::property(const std::string& id, const char* name, const Entity& value, const char* unit) {
  Entity entity{{"@id", id}, {"@type", "PropertyValue"}, {"name", name}, {"value", value}};
  if (*unit != '\0') entity["unitText"] = unit;
  add(entity);
  return link_to(id);
}

/// As a manifest has it: the program, and the libraries that decide on results.
std::string CrateWriter::add_program(const Entity& program) {
  const std::string version = program.at("version").get<std::string>(), id = "#ostia-" + version;
  if (!is_new(id)) return id;
  Entity entity{{"@id", id},
                {"@type", "SoftwareApplication"},
                {"name", "ostia"},
                {"softwareVersion", version},
                {"softwareRequirements", Entity::array()}};
  for (const auto& [name, of] : program.at("libraries").items()) {
    const std::string library = "#" + name + "-" + of.get<std::string>();
    if (is_new(library))
      add({{"@id", library}, {"@type", "SoftwareApplication"}, {"name", name}, {"softwareVersion", of}});
    entity["softwareRequirements"].push_back(link_to(library));
  }
  add(entity);
  return id;
}

std::string CrateWriter::add_parameters(const Entity& manifest) {
  const std::string text = manifest.at("parameters").dump();
  const std::string id = "#parameters-" + core::sha256(text).substr(0, 16);
  if (is_new(id)) property(id, "parameters", text);
  return id;
}

/// What has this digest, wherever it lies.
std::string CrateWriter::add_content(const std::string& digest) {
  const std::string id = "#sha256-" + digest;
  if (is_new(id))
    add({{"@id", id}, {"@type", "CreativeWork"}, {"name", "content of this digest"}, {"sha256", digest}});
  return id;
}

std::vector<std::string> CrateWriter::add_results(const CohortScan& scan, std::size_t stage,
                                                  const Entity& outputs) {
  const std::string folder = std::string(stages[stage].folder) + "/" + scan.pseudonym + "/";
  const bool is_reviewed = stage == reviewed_stage && scan.review;
  std::vector<std::string> ids;
  References files;
  for (const auto& [name, digest] : outputs.items()) {
    const std::string id = folder + name;
    Entity entity{{"@id", id}, {"@type", "File"}, {"sha256", digest}, {"encodingFormat", format_of(name)}};
    std::error_code error;
    const std::uintmax_t size = fs::file_size(cohort_.folder() / id, error);
    if (!error) entity["contentSize"] = std::to_string(size);
    if (is_reviewed && name == stages[stage].result && scan.review->result != digest) {
      entity["sha256"] = scan.review->result;  // a person has corrected what the step made
      entity["isBasedOn"] = link_to(add_content(digest.get<std::string>()));
    }
    add(entity);
    files.add(id);
    ids.push_back(id);
    ++out_.files;
  }
  add(References::with(Entity{{"@id", folder}, {"@type", "Dataset"}, {"name", folder}}.dump(), "hasPart",
                       files));
  parts_.add(folder);
  return ids;
}

/// A step is told of twice, as what the program did, and as what the workflow had it do.
void CrateWriter::add_step(const Entity& action, std::size_t stage) {
  const std::string id = action.at("@id").get<std::string>(), control = id + "/step";
  add(action);
  add({{"@id", control},
       {"@type", "ControlAction"},
       {"instrument", link_to(std::string("#step-") + stages[stage].name)},
       {"object", link_to(id)},
       {"actionStatus", action.at("actionStatus")}});
  mentions_.add(id);
  controls_.add(control);
}

Entity action_of(const CohortScan& scan, std::size_t stage, const char* status) {
  const std::string name = stages[stage].name;
  return {{"@id", "#" + scan.pseudonym + "/" + name},
          {"@type", "CreateAction"},
          {"name", name + " of " + scan.pseudonym},
          {"actionStatus", link_to(std::string("http://schema.org/") + status)}};
}

void CrateWriter::add_done(const CohortScan& scan, std::size_t stage) {
  const Stage& one = stages[stage];
  const std::string chain = chain_of_step(cohort_.folder(), scan.pseudonym, one.name);
  const Entity manifest =
      Entity::parse(pipeline::manifest_of(cohort_.folder() / one.folder / scan.pseudonym), nullptr, false);
  if (chain.empty() || !manifest.is_object() || !manifest.contains("program")) {
    ++out_.left_out;
    return;
  }
  chains_[stage].insert(chain);
  program_of_chain_[chain] = add_program(manifest.at("program"));
  Entity action = action_of(scan, stage, "CompletedActionStatus");
  const std::string id = action.at("@id").get<std::string>();
  action["instrument"] = link_to("workflow/chains/" + chain + ".json");
  action["endTime"] = manifest.at("finished");
  last_ = std::max(last_, manifest.at("finished").get<std::string>());
  action["object"] = Entity::array({link_to(add_parameters(manifest))});
  for (const Entity& digest : manifest.at("inputs"))
    action["object"].push_back(link_to(add_content(digest.get<std::string>())));
  if (one.after >= 0) {
    const Stage& before = stages[static_cast<std::size_t>(one.after)];
    action["object"].push_back(
        link_to(std::string(before.folder) + "/" + scan.pseudonym + "/" + before.result));
  }
  action["result"] = Entity::array();
  for (const std::string& file : add_results(scan, stage, manifest.at("outputs")))
    action["result"].push_back(link_to(file));
  results_.add(std::string(one.folder) + "/" + scan.pseudonym + "/");
  action["resourceUsage"] = {property(id + "/exit-code", "exit code", manifest.at("exit_code")),
                             property(id + "/seconds", "run time", manifest.at("seconds"), "s"),
                             property(id + "/memory", "most memory resident", manifest.at("peak_mb"), "MB")};
  add_step(action, stage);
  ++out_.steps;
}

void CrateWriter::add_failed(const CohortScan& scan, std::size_t stage) {
  const std::string chain = chain_of_step(cohort_.folder(), scan.pseudonym, stages[stage].name);
  if (chain.empty()) {
    ++out_.left_out;
    return;
  }
  chains_[stage].insert(chain);
  Entity action = action_of(scan, stage, "FailedActionStatus");
  const StageResult& result = scan.results[stage];
  action["instrument"] = link_to("workflow/chains/" + chain + ".json");
  action["error"] = "exit code " + std::to_string(result.exit_code) + ": " + result.reason;
  add_step(action, stage);
  ++out_.failed;
}

void CrateWriter::take(const CohortScan& scan) {
  ++out_.scans;
  for (std::size_t i = 0; i < stages.size(); ++i) {
    if (is_done(scan.results[i].state)) add_done(scan, i);
    if (scan.results[i].state == StageState::failed) add_failed(scan, i);
  }
}

void CrateWriter::add_workflow() {
  Entity workflow{{"@id", snakefile_id},
                  {"@type", {"File", "SoftwareSourceCode", "ComputationalWorkflow", "HowTo"}},
                  {"name", "Ostia's workflow for cohorts"},
                  {"programmingLanguage", link_to(language_id)},
                  {"hasPart", Entity::array()},
                  {"step", Entity::array()}};
  for (const std::string& file : workflow_files(cohort_.folder())) {
    parts_.add(file);
    const Entity digest = core::sha256_file(cohort_.folder() / file);
    if (file == snakefile_id) {
      workflow["sha256"] = digest;
      continue;
    }
    Entity entity{{"@id", file}, {"@type", "File"}, {"sha256", digest}, {"encodingFormat", format_of(file)}};
    const std::string chain = fs::path(file).stem().string();
    if (file.starts_with("workflow/chains/")) {
      entity["@type"] = {"File", "SoftwareSourceCode"};
      entity["name"] = chain;
      workflow["hasPart"].push_back(link_to(file));
      if (const auto program = program_of_chain_.find(chain); program != program_of_chain_.end())
        entity["softwareRequirements"] = link_to(program->second);
    }
    add(entity);
  }
  for (std::size_t i = 0; i < stages.size(); ++i) {
    if (chains_[i].empty()) continue;
    Entity step{{"@id", std::string("#step-") + stages[i].name},
                {"@type", "HowToStep"},
                {"name", stages[i].name},
                {"position", std::to_string(i + 1)},
                {"workExample", Entity::array()}};
    for (const std::string& chain : chains_[i])
      step["workExample"].push_back(link_to("workflow/chains/" + chain + ".json"));
    add(step);
    workflow["step"].push_back(link_to(step.at("@id").get<std::string>()));
  }
  add(workflow);
  add({{"@id", language_id},
       {"@type", "ComputerLanguage"},
       {"name", "Snakemake"},
       {"alternateName", "Snakemake"},
       {"identifier", link_to("https://doi.org/10.1093/bioinformatics/bts480")},
       {"url", link_to("https://snakemake.readthedocs.io")}});
}

/// All runs are one: killed ones and those that went on.
void CrateWriter::add_runs() {
  Entity workflow{{"@id", "#run"},
                  {"@type", "CreateAction"},
                  {"name", "The workflow over all scans"},
                  {"instrument", link_to(snakefile_id)},
                  {"startTime", runs_.front().at("begun")},
                  {"actionStatus", link_to("http://schema.org/CompletedActionStatus")},
                  {"object", Entity::array()},
                  {"resourceUsage", Entity::array()}};
  std::set<std::string> engines;
  for (const nlohmann::json& run : runs_) {
    const std::string number = "#run-" + std::to_string(run.at("number").get<long>());
    for (const auto& [name, value] : run.at("settings").items()) {
      const std::string id = number + "/" + name;
      workflow["object"].push_back(property(id, name.c_str(), Entity(value)));
    }
    for (const auto& [name, value] : run.at("machine").items()) {
      const std::string id = number + "/machine/" + name;
      workflow["resourceUsage"].push_back(property(id, name.c_str(), Entity(value)));
    }
    if (run.value("ended", nlohmann::json()).is_string()) {
      workflow["endTime"] = run.at("ended");
      last_ = std::max(last_, run.at("ended").get<std::string>());
    }
    const std::string version = run.at("engine").value("version", "unknown");
    const std::string name = run.at("engine").value("name", "unknown"), engine = "#" + name + "-" + version;
    if (engines.insert(engine).second)
      add({{"@id", engine},
           {"@type", "SoftwareApplication"},
           {"name", name},
           {"softwareVersion", version},
           {"softwareRequirements", "Python " + run.at("engine").value("python", "unknown")}});
  }
  add(References::with(workflow.dump(), "result", results_));
  Entity organised{{"@id", "#organised"},
                   {"@type", "OrganizeAction"},
                   {"name", "The engine"},
                   {"instrument", Entity::array()},
                   {"result", link_to("#run")}};
  for (const std::string& engine : engines) organised["instrument"].push_back(link_to(engine));
  add(References::with(organised.dump(), "object", controls_));
  mentions_.add("#run");
  mentions_.add("#organised");
}

void CrateWriter::add_root() {
  Entity about{{"@id", crate_name},
               {"@type", "CreativeWork"},
               {"about", link_to("./")},
               {"conformsTo", {link_to(crate_11), link_to(profiles[3][0])}}};
  add(about);
  Entity root{
      {"@id", "./"},
      {"@type", "Dataset"},
      {"name", options_.name},
      {"description", std::to_string(out_.scans) + " scans by pseudonym, " + std::to_string(out_.steps) +
                          " steps with a result and " + std::to_string(out_.failed) + " without"},
      {"datePublished", last_.empty() ? runs_.back().at("begun").get<std::string>() : last_},
      {"mainEntity", link_to(snakefile_id)},
      {"conformsTo", Entity::array()}};
  root["license"] = options_.license.empty() ? Entity("none was given: ask whom the scans belong to")
                    : options_.license.starts_with("http") ? link_to(options_.license)
                                                           : Entity(options_.license);
  for (const auto& [id, name, version] : profiles) {
    root["conformsTo"].push_back(link_to(id));
    add({{"@id", id}, {"@type", "CreativeWork"}, {"name", name}, {"version", version}});
  }
  if (options_.license.starts_with("http"))
    add({{"@id", options_.license}, {"@type", "CreativeWork"}, {"name", options_.license}});
  add(References::with(References::with(root.dump(), "hasPart", parts_), "mentions", mentions_));
}

CrateResult CrateWriter::close() {
  add_workflow();
  add_runs();
  add_root();
  stream_ << "\n]}\n";
  stream_.close();
  if (!stream_) throw ResourceError("cannot write the crate: the disk is full, or out of order");
  return out_;
}

}  // namespace

CrateResult write_crate(const fs::path& folder, const CrateOptions& options, const core::TaskContext& task) {
  const OpenCohort cohort(folder);
  core::StagedFile staged(folder / crate_name);
  CrateWriter writer(staged.temporary(), cohort, options);
  cohort.for_each({}, task, [&](const CohortScan& scan) { writer.take(scan); });
  CrateResult out = writer.close();
  staged.commit();
  out.file = folder / crate_name;
  return out;
}

}  // namespace ostia::cohort
