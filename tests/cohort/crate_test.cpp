#include "ostia/cohort/crate.h"

#include "made_results.h"

#include "ostia/cohort/reproduction.h"
#include "ostia/cohort/review.h"
#include "ostia/core/error.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>
#include <set>

namespace ostia::cohort {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

std::string chain_name(std::size_t stage) {
  return std::string("made-") + stages[stage].name;
}

/// As a run of the workflow leaves it.
void leave_workflow(const MadeCohort& cohort) {
  const fs::path folder = cohort.folder() / "workflow";
  core::write_file(folder / "Snakefile", "rule all:\n");
  core::write_file(folder / "step.py", "pass\n");
  for (std::size_t i = 0; i < stages.size(); ++i)
    core::write_file(folder / "chains" / (chain_name(i) + ".json"), i < 2 ? "{scan}" : "{case}");
  core::write_file(cohort.folder() / "logs/runs/1.json",
                   R"({"v":1,"kind":"cohort run","number":1,"begun":"2026-03-01T12:00:00Z",
  "ended":null,"well":null,"program":"0.2.0","workflow_sha256":"00","engine":{"name":"snakemake",
  "version":"7.21.0","python":"3.11.2"},"settings":{"threads":1,"needs_review":false},
  "machine":{"processor":"a processor","processors":2,"memory_mb":4000,"system":"Linux x86_64"}})");
}

void leave_record(const MadeCohort& cohort, std::size_t scan, std::size_t stage, int code) {
  core::write_file(cohort.folder() / "logs" / cohort.scan(scan) / (std::string(stages[stage].name) + ".json"),
                   R"({"v":1,"kind":"cohort step","exit_code":)" + std::to_string(code) +
                       R"(,"signal":null,"seconds":1.5,"message":"no heart was found","chain":")" +
                       chain_name(stage) + "\"}");
}

void make_whole(const MadeCohort& cohort, std::size_t scan) {
  cohort.make_all(scan, R"({"v":1,"kind":"case report"})");
  for (std::size_t i = 0; i < stages.size(); ++i) leave_record(cohort, scan, i, 0);
}

/// By identifier.
std::map<std::string, json> entities_of(const fs::path& folder) {
  std::map<std::string, json> out;
  const json crate = json::parse(core::read_file(folder / crate_name));
  EXPECT_THAT(crate.at("@context"), Contains("https://w3id.org/ro/crate/1.1/context"));
  for (const json& one : crate.at("@graph"))
    EXPECT_TRUE(out.emplace(one.at("@id").get<std::string>(), one).second) << one.at("@id");
  return out;
}

std::set<std::string> ids_in(const json& value) {
  std::set<std::string> out;
  if (value.is_object() && value.contains("@id")) out.insert(value.at("@id").get<std::string>());
  if (value.is_array())
    for (const json& one : value) out.merge(ids_in(one));
  return out;
}

bool is_a(const json& entity, const std::string& type) {
  const json& is = entity.at("@type");
  return is.is_array() ? std::ranges::find(is, json(type)) != is.end() : is == type;
}

class Crates : public ::testing::Test {
 protected:
  MadeCohort begun(const std::string& name, int scans) {
    MadeCohort cohort(name, scans);
    leave_workflow(cohort);
    return cohort;
  }
};

/// What RO-Crate 1.1, Workflow RO-Crate 1.0 and Process, Workflow and Provenance Run Crate 0.5 say MUST be
/// there.
TEST_F(Crates, HaveWhatTheirProfilesRequire) {
  const MadeCohort cohort = begun("crate_profile", 2);
  make_whole(cohort, 0);
  leave_record(cohort, 1, 0, 3);
  const CrateResult made = write_crate(cohort.folder(), {"A study", "https://spdx.org/licenses/CC0-1.0"});
  EXPECT_EQ(made.scans, 2u);
  EXPECT_EQ(made.steps, stages.size());
  EXPECT_EQ(made.failed, 1u);
  EXPECT_EQ(made.left_out, 0u);
  const auto all = entities_of(cohort.folder());

  EXPECT_EQ(all.at(crate_name).at("about").at("@id"), "./");
  EXPECT_THAT(ids_in(all.at(crate_name).at("conformsTo")), Contains("https://w3id.org/ro/crate/1.1"));
  const json& root = all.at("./");
  EXPECT_TRUE(is_a(root, "Dataset"));
  for (const char* name : {"name", "description", "datePublished", "license"})
    EXPECT_TRUE(root.contains(name));
  for (const char* profile : {"process", "workflow", "provenance"}) {
    const std::string id = std::string("https://w3id.org/ro/wfrun/") + profile + "/0.5";
    EXPECT_THAT(ids_in(root.at("conformsTo")), Contains(id));
    EXPECT_TRUE(is_a(all.at(id), "CreativeWork"));
  }
  const std::string main_id = root.at("mainEntity").at("@id");
  const json& workflow = all.at(main_id);
  for (const char* type : {"File", "SoftwareSourceCode", "ComputationalWorkflow", "HowTo"})
    EXPECT_TRUE(is_a(workflow, type)) << type;
  EXPECT_TRUE(
      is_a(all.at(workflow.at("programmingLanguage").at("@id").get<std::string>()), "ComputerLanguage"));

  std::size_t runs = 0, of_tools = 0, controls = 0, organised = 0;
  for (const auto& [id, one] : all) {
    if (is_a(one, "CreateAction")) {
      const std::string tool = one.at("instrument").at("@id");
      ++(tool == main_id ? runs : of_tools);
      if (tool != main_id) {
        EXPECT_THAT(ids_in(workflow.at("hasPart")), Contains(tool));
      }
      EXPECT_THAT(ids_in(root.at("mentions")), Contains(id));
      const bool failed = ids_in(one.at("actionStatus")).contains("http://schema.org/FailedActionStatus");
      EXPECT_EQ(one.contains("error"), failed);
    }
    if (is_a(one, "ControlAction")) {
      ++controls;
      const std::string step = one.at("instrument").at("@id");
      EXPECT_TRUE(is_a(all.at(step), "HowToStep"));
      EXPECT_THAT(ids_in(workflow.at("step")), Contains(step));
      EXPECT_FALSE(ids_in(all.at(step).at("workExample")).empty());
      EXPECT_TRUE(is_a(all.at(one.at("object").at("@id").get<std::string>()), "CreateAction"));
    }
    if (is_a(one, "OrganizeAction")) {
      ++organised;
      for (const std::string& engine : ids_in(one.at("instrument")))
        EXPECT_TRUE(is_a(all.at(engine), "SoftwareApplication"));
      EXPECT_EQ(ids_in(one.at("result")), std::set<std::string>{"#run"});
      EXPECT_EQ(ids_in(one.at("object")).size(), stages.size() + 1);
    }
  }
  EXPECT_EQ(runs, 1u);
  EXPECT_EQ(of_tools, stages.size() + 1);
  EXPECT_EQ(controls, stages.size() + 1);
  EXPECT_EQ(organised, 1u);
}

/// Every reference within the crate is to something that it tells of, and every file that it tells of is
/// there as it is told of.
TEST_F(Crates, TellOfFilesThatAreThere) {
  const MadeCohort cohort = begun("crate_files", 1);
  make_whole(cohort, 0);
  write_crate(cohort.folder());
  const auto all = entities_of(cohort.folder());
  std::set<std::string> reachable = ids_in(all.at("./").at("hasPart"));
  for (const std::string& folder : std::set(reachable))
    if (all.contains(folder) && all.at(folder).contains("hasPart"))
      reachable.merge(ids_in(all.at(folder).at("hasPart")));
  std::size_t files = 0;
  for (const auto& [id, one] : all) {
    for (const auto& [name, value] : one.items()) {
      if (name == "@type") continue;
      for (const std::string& other : ids_in(value))
        EXPECT_TRUE(other.starts_with("http") || all.contains(other)) << id << " " << name << " " << other;
    }
    if (!is_a(one, "File")) continue;
    ++files;
    EXPECT_EQ(one.at("sha256"), core::sha256_file(cohort.folder() / id)) << id;
    EXPECT_THAT(reachable, Contains(id));
  }
  EXPECT_GE(files, stages.size() * 2 + 2);
}

TEST_F(Crates, AreTheSameBytesEachTimeAndNameNobody) {
  const MadeCohort cohort = begun("crate_bytes", 2);
  make_whole(cohort, 0);
  write_crate(cohort.folder());
  const std::string first = core::read_file(cohort.folder() / crate_name);
  write_crate(cohort.folder());
  EXPECT_EQ(core::read_file(cohort.folder() / crate_name), first);
  EXPECT_THAT(first, Not(HasSubstr(cohort.folder().string())));
  EXPECT_THAT(first, Not(HasSubstr("scan0.nrrd")));
  EXPECT_THAT(first, HasSubstr("a processor"));
}

TEST_F(Crates, LeaveOutWhatNoRecordSaysHowItWasMade) {
  const MadeCohort cohort = begun("crate_left_out", 1);
  cohort.make_all(0, R"({"v":1,"kind":"case report"})");
  leave_record(cohort, 0, 0, 0);
  const CrateResult made = write_crate(cohort.folder());
  EXPECT_EQ(made.steps, 1u);
  EXPECT_EQ(made.left_out, stages.size() - 1);
}

TEST_F(Crates, NeedAWorkflowThatWasRun) {
  const MadeCohort cohort("crate_no_run", 1);
  EXPECT_THROW(write_crate(cohort.folder()), InvalidInput);
  EXPECT_FALSE(fs::exists(cohort.folder() / crate_name));
  EXPECT_THROW(reproduce({cohort.folder(), "", cohort.beside("again"), 0}, nullptr), InvalidInput);
  core::write_file(cohort.folder() / crate_name, "{\"@graph\": [");
  EXPECT_THROW(reproduce({cohort.folder(), "", cohort.beside("again"), 0}, nullptr), InvalidInput);
  EXPECT_FALSE(fs::exists(cohort.beside("again")));
}

/// A program that makes what MadeCohort makes.
struct Maker {
  std::map<std::string, std::string> other{};  ///< by stage: another content
  std::string fails{};
  std::map<std::string, std::string> read{};  ///< by stage
  ChainRun run() {
    return [this](const fs::path& chain, const fs::path& folder, const auto& values) {
      const std::string name = chain.stem().string().substr(5);
      const std::size_t stage = stage_of(name);
      read[name] = values.at(0).second;
      if (name == fails) return 3;
      const std::string content = other.contains(name)            ? other.at(name)
                                  : stage == stage_of("measures") ? R"({"v":1,"kind":"case report"})"
                                  : stage == stage_of("pressure") ? MadeCohort::made_pressure
                                                                  : name;
      core::write_file(folder / stages[stage].result, content);
      pipeline::ManifestRecord record;
      record.key = {"run", {{"input 1", core::sha256_file(values.at(0).second)}}, "{}"};
      pipeline::write_manifest(folder, record);
      return 0;
    };
  }
};

TEST_F(Crates, AreReproducedBitByBit) {
  const MadeCohort cohort = begun("crate_again", 5);
  for (std::size_t i = 0; i < 5; ++i) make_whole(cohort, i);
  write_crate(cohort.folder());
  Maker maker;
  const Reproduction found = reproduce({cohort.folder(), "", cohort.beside("again"), 3}, maker.run());
  EXPECT_EQ(found.scans, 3u);
  EXPECT_EQ(found.steps, 3 * stages.size());
  EXPECT_EQ(found.count(FileVerdict::same), 3 * stages.size());
  EXPECT_TRUE(found.is_same());
  EXPECT_THAT(core::read_file(cohort.beside("again") / "files.csv"),
              HasSubstr(cohort.scan(0) + ",import,scan.nrrd,"));
  EXPECT_THAT(core::read_file(cohort.beside("again") / "files.csv"), Not(HasSubstr(cohort.scan(2))));
}

TEST_F(Crates, SayWhatDiffersAndWhatIsMissing) {
  const MadeCohort cohort = begun("crate_differs", 1);
  make_whole(cohort, 0);
  write_crate(cohort.folder());
  Maker maker;
  maker.other["mesh"] = "another mesh";
  maker.fails = "lumen";
  const Reproduction found = reproduce({cohort.folder(), "", cohort.beside("again"), 0}, maker.run());
  EXPECT_FALSE(found.is_same());
  for (const ReproducedFile& one : found.files)
    EXPECT_EQ(one.verdict, one.stage == "mesh"    ? FileVerdict::differs
                           : one.stage == "lumen" ? FileVerdict::missing
                                                  : FileVerdict::same)
        << one.stage;
}

TEST_F(Crates, AScanThatIsAnotherNowIsTold) {
  const MadeCohort cohort = begun("crate_other_scan", 1);
  make_whole(cohort, 0);
  write_crate(cohort.folder());
  core::write_file(cohort.beside("scan0.nrrd"), "another");
  Maker maker;
  const Reproduction found = reproduce({cohort.folder(), "", cohort.beside("again"), 0}, maker.run());
  EXPECT_EQ(found.count(FileVerdict::differs), 1u);
  EXPECT_EQ(found.files.front().file, "the scan itself");
}

TEST_F(Crates, WithoutThePrivateFolderTheyBeginWithWhatWasImported) {
  const MadeCohort cohort = begun("crate_shared", 1);
  make_whole(cohort, 0);
  write_crate(cohort.folder());
  const fs::path shared = cohort.beside("shared");
  fs::copy(cohort.folder(), shared, fs::copy_options::recursive);
  Maker maker;
  const Reproduction found = reproduce({shared, "", cohort.beside("again"), 0}, maker.run());
  EXPECT_EQ(found.steps, stages.size() - 1);
  EXPECT_EQ(found.count(FileVerdict::not_compared), 1u);
  EXPECT_EQ(found.count(FileVerdict::same), stages.size() - 1);
  fs::remove_all(shared / "inputs");
  EXPECT_THROW(reproduce({shared, "", cohort.beside("never"), 0}, maker.run()), InvalidInput);
  EXPECT_FALSE(fs::exists(cohort.beside("never")));
}

TEST_F(Crates, ACaseThatAPersonHasCorrectedIsWhatFollowsItReads) {
  const MadeCohort cohort = begun("crate_corrected", 1);
  make_whole(cohort, 0);
  const std::size_t lumen = stage_of("lumen");
  const fs::path file = cohort.at(0, reviewed_stage) / "case.ostia";
  core::write_file(file, "corrected");
  take_reviews(cohort.folder(),
               {{cohort.scan(0), Verdict::ok, "R", "2026-03-01T12:00:00Z", core::sha256("extract")}});
  cohort.make(0, lumen,
              "lumen");  // made of it; what else follows is stale, and the crate does not tell of it
  EXPECT_EQ(write_crate(cohort.folder()).steps, 3u);
  const std::string id = "cases/" + cohort.scan(0) + "/case.ostia";
  EXPECT_EQ(entities_of(cohort.folder()).at(id).at("sha256"), core::sha256("corrected"));
  Maker maker;
  const Reproduction found = reproduce({cohort.folder(), "", cohort.beside("again"), 0}, maker.run());
  EXPECT_EQ(maker.read.at("lumen"), fs::absolute(file).string());
  EXPECT_EQ(found.count(FileVerdict::same), 3u);
}

TEST_F(Crates, AChainThatIsNotTheRecordedOneIsRefused) {
  const MadeCohort cohort = begun("crate_chain", 1);
  make_whole(cohort, 0);
  write_crate(cohort.folder());
  core::write_file(cohort.folder() / "workflow/chains" / (chain_name(0) + ".json"), "another");
  Maker maker;
  EXPECT_THROW(reproduce({cohort.folder(), "", cohort.beside("again"), 0}, maker.run()), InvalidInput);
  EXPECT_THAT(maker.read, IsEmpty());
}

}  // namespace
}  // namespace ostia::cohort
