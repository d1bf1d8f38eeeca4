#include "ostia/solver/openfoam_continue.h"

#include "case_text.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/core/text.h"
#include "ostia/solver/case_record.h"
#include "ostia/solver/openfoam_launch.h"
#include "ostia/solver/openfoam_result.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>
#include <vector>

namespace ostia::solver {
namespace fs = std::filesystem;
namespace {

using core::shortest_text;
using nlohmann::json;

constexpr int most_iterations = 1000000, most_cycles = 100;

/// The line `key value;` of a dictionary's outermost level, with another value.
std::string with_entry(const std::string& text, const std::string& key, const std::string& value) {
  std::istringstream lines(text);
  std::string out;
  for (std::string line; std::getline(lines, line); out += "\n") {
    if (line.starts_with(key + " "))
      line = line.substr(0, line.find_first_not_of(' ', key.size())) + value + ";";
    out += line;
  }
  return out;
}

/// What stands between `mark` and the next blank or line's end, with another value.
std::string with_value(std::string text, const std::string& mark, const std::string& value) {
  const std::size_t at = text.find(mark);
  if (at == std::string::npos) return text;
  const std::size_t from = at + mark.size();
  return text.replace(from, text.find_first_of(" \n", from) - from, value);
}

/// How far a coupled run goes: `[ "$time" -ge 2000 ]` of a steady one, `cycles=3` of a pulsatile one.
std::string with_bound(const std::string& script, const std::string& iterations, const std::string& cycles) {
  return with_value(with_value(script, "\"$time\" -ge ", iterations), "\ncycles=", cycles);
}

void rewrite(const fs::path& file, const std::string& text) {
  const fs::perms was = fs::status(file).permissions();
  core::write_file(file, text);
  fs::permissions(file, was);
}

void require_within(const char* what, int value, int most) {
  if (value < 1 || value > most)
    throw InvalidInput(std::string(what) + " must be in [1, " + std::to_string(most) + "], not " +
                       std::to_string(value));
}

void require_more(const fs::path& folder, double now, double wanted, const std::string& unit) {
  if (now > wanted * (1.0 - 1e-9))
    throw InvalidInput(folder.string() + " has come to " + shortest_text(now) + unit +
                       " already; give more than that");
}

struct Sample {
  double time_s = 0.0;
  fs::path folder;
};

/// The folders of an inlet's velocities over time.
std::vector<Sample> samples_of_inlet(const fs::path& inlet) {
  std::vector<Sample> samples;
  for (const auto& entry : fs::directory_iterator(inlet)) {
    if (!entry.is_directory()) continue;
    std::istringstream name(entry.path().filename().string());
    name.imbue(std::locale::classic());
    double time = 0.0;
    if (name >> time) samples.push_back({time, entry.path()});
  }
  std::ranges::sort(samples, {}, &Sample::time_s);
  return samples;
}

/// The first cycle's velocities again, up to the new end.
void repeat_inlets(const fs::path& folder, double period_s, int cycles) {
  std::error_code error;
  for (const auto& inlet : fs::directory_iterator(folder / "constant" / "boundaryData", error)) {
    const std::vector<Sample> samples = samples_of_inlet(inlet.path());
    const auto per_cycle = std::ranges::count_if(
        samples, [&](const Sample& one) { return one.time_s < period_s * (1.0 - 1e-6); });
    if (per_cycle == 0) continue;
    for (auto i = static_cast<long>(samples.size()); i <= cycles * per_cycle; ++i) {
      const double time = period_s * static_cast<double>(i) / static_cast<double>(per_cycle);
      const fs::path made = inlet.path() / shortest_text(time);
      fs::create_directory(made);
      fs::copy_file(samples[static_cast<std::size_t>(i % per_cycle)].folder / "U", made / "U",
                    fs::copy_options::overwrite_existing);
    }
  }
}

/// What of a file says how long the case runs, or on how many processes, is taken out.
std::string without_length(const std::string& name, const std::string& text) {
  if (name == "system/controlDict") return with_entry(with_entry(text, "endTime", ""), "writeInterval", "");
  if (name == "Allrun") return with_bound(text, "", "");
  if (name != "flow-case.json") return text;
  json record = json::parse(text, nullptr, false);
  if (record.is_object()) record.erase("cycles");
  return record.dump();
}

}  // namespace

bool is_openfoam_case(const fs::path& folder) {
  std::error_code error;
  return fs::is_regular_file(folder / "flow-case.json", error) &&
         fs::is_regular_file(folder / "system" / "controlDict", error);
}

CaseLength length_of(const fs::path& folder) {
  const CaseRecord record = read_case_record(folder);
  if (record.solver != "openfoam")
    throw InvalidInput(folder.string() + " is a case of " + record.solver + "; one of openfoam can go on");
  CaseLength length;
  length.pulsatile = record.pulsatile();
  const std::vector<OpenfoamTime> times = times_of(folder);
  if (!times.empty()) length.now = times.back().time;
  length.end = openfoam_run_plan(folder).end_time;
  return length;
}

CaseLength continue_openfoam_case(const fs::path& folder, std::optional<int> iterations,
                                  std::optional<int> cycles) {
  CaseLength length = length_of(folder);
  if (length.pulsatile ? !cycles || iterations : !iterations || cycles)
    throw InvalidInput(folder.string() + (length.pulsatile ? " is pulsatile: it goes on by --cycles"
                                                           : " is steady: it goes on by --iterations"));
  const fs::path control = folder / "system" / "controlDict";
  if (!length.pulsatile) {
    require_within("iterations", *iterations, most_iterations);
    require_more(folder, length.now, *iterations, " iterations");
    const std::string count = std::to_string(*iterations);
    rewrite(control,
            with_entry(with_entry(core::read_file(control), "endTime", count), "writeInterval", count));
    rewrite(folder / "Allrun", with_bound(core::read_file(folder / "Allrun"), count, ""));
    length.end = *iterations;
    return length;
  }
  require_within("cycles", *cycles, most_cycles);
  json record = json::parse(core::read_file(folder / "flow-case.json"));
  const double period_s = record.at("period_s").get<double>();
  require_more(folder, length.now, period_s * *cycles, " s");
  repeat_inlets(folder, period_s, *cycles);
  length.end = period_s * *cycles;
  record["cycles"] = *cycles;
  rewrite(folder / "flow-case.json", record.dump(2) + "\n");
  rewrite(control, with_entry(core::read_file(control), "endTime", shortest_text(length.end)));
  rewrite(folder / "Allrun", with_bound(core::read_file(folder / "Allrun"), "", std::to_string(*cycles)));
  return length;
}

std::string difference_of_cases(const fs::path& folder, const fs::path& fresh) {
  std::vector<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(fresh))
    if (entry.is_regular_file()) names.push_back(fs::relative(entry.path(), fresh).generic_string());
  std::ranges::sort(names);
  for (const std::string& name : names) {
    // The first is set by ./Allrun N, the others by the cycles that have run.
    if (name == "system/decomposeParDict" || name.starts_with("constant/outletTables/")) continue;
    if (!fs::is_regular_file(folder / name)) {
      // Of more cycles there are more of the inlets' velocities.
      if (name.starts_with("constant/boundaryData/") && name.ends_with("/U")) continue;
      return name;
    }
    if (without_length(name, core::read_file(folder / name)) !=
        without_length(name, core::read_file(fresh / name)))
      return name;
  }
  return "";
}

}  // namespace ostia::solver
