#include "doctor/doctor.h"
#include "output/told.h"

#include "ostia/core/child_process.h"
#include "ostia/core/error.h"
#include "ostia/core/log.h"
#include "ostia/core/process_cell.h"
#include "ostia/core/processor.h"
#include "ostia/core/strays.h"
#include "ostia/core/text.h"
#include "ostia/core/version.h"
#include "ostia/core/worker_program.h"
#include "ostia/session/case_file.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <sys/sysinfo.h>

#include <cstdio>
#include <string>
#include <thread>

namespace ostia::app {
namespace {

namespace fs = std::filesystem;

constexpr double gigabyte = 1024.0 * 1024.0 * 1024.0;
constexpr double least_temporary_gb = 2.0;  // a scan's voxels and its meshes, some times over
constexpr int usage_code = 2;               // of the worker without a task

/// What is found, as lines for a person and as JSON; neither has a name or a path.
struct Findings {
  ToldJson json = ToldJson::object();
  std::vector<std::string> lines;
  bool well = true;

  void add(const char* name, const std::string& text, bool fine = true) {
    note(name, text, fine);
    well = well && fine;
  }
  /// What nobody here can mend is marked, and all is well for that.
  void note(const char* name, const std::string& text, bool fine) {
    lines.push_back(std::string(fine ? "   " : "!  ") + name +
                    std::string(12 - std::string_view(name).size(), ' ') + text);
  }
};

std::string gigabytes(double bytes) {
  return core::shown_text(bytes / gigabyte, 1) + " GB";
}

void look_at_machine(Findings& found) {
  struct sysinfo memory {};
  ::sysinfo(&memory);
  const double unit = memory.mem_unit, all = unit * static_cast<double>(memory.totalram),
               free = unit * static_cast<double>(memory.freeram + memory.bufferram);
  const unsigned processors = std::thread::hardware_concurrency();
  found.json["processors"] = processors;
  found.json["avx2"] = core::has_avx2();
  found.json["memory_gb"] = all / gigabyte;
  found.json["free_memory_gb"] = free / gigabyte;
  found.add("machine", counted(processors, "processor") +
                           (core::has_avx2() ? " with AVX2, " : " without AVX2, ") + gigabytes(all) +
                           " of memory, " + gigabytes(free) + " free");
  std::error_code error;
  const fs::space_info room = fs::space(fs::temp_directory_path(error), error);
  const double left = error ? 0.0 : static_cast<double>(room.available);
  found.json["free_temporary_gb"] = left / gigabyte;
  const bool enough = left / gigabyte >= least_temporary_gb;
  found.add("temporary",
            gigabytes(left) + " free" + (enough ? "" : "; set TMPDIR to a folder with more room"), enough);
}

void look_at_worker(Findings& found, const core::TaskContext& task) {
  std::string problem;
  try {
    const core::ChildResult answer = core::run_child(core::worker_program(), {}, {}, task);
    if (answer.signal != 0 || answer.exit_code != usage_code) problem = "it " + answer.describe();
  } catch (const IoError&) {
    problem = "it is not there or cannot be run; install Ostia whole";
  }
  found.json["worker"] = problem.empty() ? ToldJson("runs") : ToldJson(problem);
  found.add("worker", problem.empty() ? "runs" : problem, problem.empty());
  const core::CellWalls cell = core::possible_cell();
  found.json["cell"] = {{"calls", cell.calls}, {"files", cell.files}};
  const std::string lacking = cell.calls && !cell.files
                                  ? "its files (no Landlock: Linux 5.13 and later have it)"
                              : !cell.calls && cell.files ? "its system calls (no seccomp)"
                                                          : "its files and system calls";
  found.note("cell",
             cell.whole() ? "what reads foreign files has no network, no program and no other file"
                          : "this kernel cannot bound what reads foreign files in " + lacking,
             cell.whole());
}

void look_at_folder(const fs::path& folder, bool mend, Findings& found, ToldJson& told) {
  const std::vector<fs::path> strays = core::strays_below(folder);
  const std::size_t removed = mend ? core::remove_strays(strays) : 0;
  told = {{"kind", "folder"}, {"strays", strays.size()}, {"removed", removed}};
  const bool fine = strays.size() == removed;
  std::string text = strays.empty() ? "nothing left of runs that were killed"
                                    : counted(strays.size(), "stray") + " of runs that were killed";
  if (removed > 0) text += ", " + std::to_string(removed) + " removed";
  if (!fine) text += mend ? "; another program holds the rest" : "; --mend removes what no program holds";
  found.add("folder", text, fine);
}

void look_at_case(const fs::path& file, Findings& found, ToldJson& told) {
  told = {{"kind", "case"}, {"sound", true}};
  try {
    const session::CaseFile opened = session::CaseFile::open(file, session::OpenMode::read_only);
    told["steps"] = opened.journal().size();
    found.add("case", "sound, " + counted(opened.journal().size(), "step"));
  } catch (const Error& error) {
    told["sound"] = false;
    found.add("case", core::redacted_for_log(error.what()), false);
  }
}

}  // namespace

ExitCode run_doctor(const DoctorCommand& o, const core::TaskContext& task) {
  for (const fs::path& path : o.paths) core::redact_in_logs(path.string(), "what was looked at");
  for (const fs::path& path : o.paths)
    if (!fs::exists(path))
      throw IoError("cannot read " + path.string() + ": there is no such file or folder");
  Findings found;
  found.json["version"] = core::version();
  found.add("program", "Ostia " + core::version());
  look_at_machine(found);
  look_at_worker(found, task);
  found.json["looked_at"] = ToldJson::array();
  for (const fs::path& path : o.paths) {
    task.throw_if_cancelled();
    ToldJson told;
    if (fs::is_directory(path))
      look_at_folder(path, o.mend, found, told);
    else
      look_at_case(path, found, told);
    found.json["looked_at"].push_back(std::move(told));
  }
  found.json["well"] = found.well;
  std::string text;
  for (const std::string& line : found.lines) text += (text.empty() ? "" : "\n") + line;
  tell("doctor", found.json, text, o.json);
  return found.well ? ExitCode::ok : ExitCode::quality_failed;
}

void define_doctor(CLI::App& app, DoctorCommand& c, std::function<ExitCode(const core::TaskContext&)>& run) {
  CLI::App* doctor = app.add_subcommand(
      "doctor", "Whether this machine and this installation are well, and what killed runs left in folders");
  doctor->footer("Example:\n  ostia doctor");
  doctor->fallthrough();
  doctor->add_option("PATH", c.paths,
                     "Folders to look for strays in, cases (.ostia) to open; none is changed");
  doctor->add_flag("--mend", c.mend, "Remove the strays, unless a program that runs holds them");
  doctor->add_flag("--json", c.json,
                   "One JSON object on standard output, without names and paths: for a report of a fault");
  doctor->callback([&] { run = [&](const core::TaskContext& task) { return run_doctor(c, task); }; });
}

}  // namespace ostia::app
