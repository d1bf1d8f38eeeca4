#include "input/edit_script.h"
#include "output/outputs.h"
#include "vessel/lumen.h"

#include "ostia/core/log.h"
#include "ostia/session/edit_json.h"

#include <nlohmann/json.hpp>

#include <cstdio>

namespace ostia::app {
namespace {

bool is_journal(const std::filesystem::path& path) {
  return path.extension() == ".jsonl";
}

/// The case that a journal belongs to: named, or the one beside it.
std::filesystem::path case_of(const ReplayCommand& o) {
  if (!is_journal(o.input)) {
    if (!o.start.empty()) throw UsageError("--start is for a journal (.jsonl); a case has its own");
    return o.input;
  }
  if (!o.start.empty()) return o.start;
  std::filesystem::path beside = o.input;
  beside.replace_extension(".ostia");
  if (!std::filesystem::exists(beside))
    throw InvalidInput(
        o.input.string() +
        ": a journal holds edits alone; name the case that they start from with --start (there "
        "is no " +
        beside.string() + ")");
  return beside;
}

}  // namespace

ExitCode run_replay(const ReplayCommand& o, const core::TaskContext& task) {
  require_output(o.output, {".ostia", ".jsonl"});
  task.set_stage("reading");
  const std::filesystem::path path = case_of(o);
  const session::CaseFile file = session::CaseFile::open(path, session::OpenMode::read_only);
  const EditScript script = is_journal(o.input) ? read_edit_script(o.input) : edits_of_case(file, o.input);
  task.set_stage("edits");
  std::vector<std::string> notes;
  std::string digest;
  if (o.output.empty() || is_journal(o.output)) {
    digest = lumen::digest(edited(*file.starting_model(), script, notes, task));
  } else {
    NewCase made(o.output);
    digest = lumen::digest(made.make(*file.starting_model(), script, file.image(), notes, task));
    task.throw_if_cancelled();
    made.commit();
  }
  if (is_journal(o.output)) session::write_edits(o.output, script.edits);
  const std::string stored = lumen::digest(*file.model());
  const bool same = digest == stored;
  if (o.json) {
    const nlohmann::ordered_json out{
        {"v", 1},           {"kind", "replay"},        {"edits", script.edits.size()},
        {"digest", digest}, {"stored_digest", stored}, {"same", same},
        {"warnings", notes}};
    std::printf("%s\n", out.dump(2).c_str());
  } else {
    std::printf("%zu edits\nreplayed %s\nstored   %s\n%s\n", script.edits.size(), digest.c_str(),
                stored.c_str(), same ? "the same to the last bit" : "not the same");
  }
  if (!same)
    core::log_warning(
        "the edits do not make the stored model: another build, another journal, or a case "
        "that was changed by other means");
  task.set_progress(1.0);
  return same ? ExitCode::ok : ExitCode::quality_failed;
}

}  // namespace ostia::app
