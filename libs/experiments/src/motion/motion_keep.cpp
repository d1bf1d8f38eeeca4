#include "motion/motion_keep.h"

#include "ostia/core/csv.h"
#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/core/text.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>

namespace ostia::experiments {
namespace fs = std::filesystem;
namespace {

using core::significant_text;
using Cells = std::vector<std::string>;

const Cells run_header{
    "heart",          "phase_percent",     "method",      "depth", "sampling",  "lost",
    "seconds",        "processor_seconds", "distance_mm", "dice",  "vertex_mm", "vertex_worst_mm",
    "inverted_cells", "new_intersections"};
const Cells branch_header{"heart",
                          "phase_percent",
                          "depth",
                          "branch",
                          "length_mm",
                          "stretch",
                          "true_stretch",
                          "torsion",
                          "true_torsion",
                          "template_torsion",
                          "torsion_size",
                          "true_torsion_size",
                          "template_torsion_size",
                          "curvature",
                          "true_curvature",
                          "template_curvature"};

std::string line_of(const MotionRun& r) {
  return core::csv_line({r.heart, significant_text(100.0 * r.phase, 9), word(r.method),
                         std::to_string(r.depth), r.sampling, r.lost, significant_text(r.seconds, 9),
                         significant_text(r.processor_seconds, 9), significant_text(r.distance_mm, 9),
                         significant_text(r.dice, 9), significant_text(r.vertex_mm, 9),
                         significant_text(r.vertex_worst_mm, 9), std::to_string(r.inverted_cells),
                         std::to_string(r.new_intersections)});
}
std::string line_of(const BranchRun& r) {
  return core::csv_line({r.heart, significant_text(100.0 * r.phase, 9), std::to_string(r.depth), r.branch,
                         significant_text(r.length_mm, 9), significant_text(r.stretch, 9),
                         significant_text(r.true_stretch, 9), significant_text(r.torsion, 9),
                         significant_text(r.true_torsion, 9), significant_text(r.template_torsion, 9),
                         significant_text(r.size, 9), significant_text(r.true_size, 9),
                         significant_text(r.template_size, 9), significant_text(r.curvature, 9),
                         significant_text(r.true_curvature, 9), significant_text(r.template_curvature, 9)});
}

/// The cells of one line, by the order of the header.
class Line {
 public:
  Line(const fs::path& file, std::size_t number, Cells cells, const Cells& header)
      : file_(file), number_(number), cells_(std::move(cells)), header_(header) {
    if (cells_.size() != header.size())
      fail("has " + std::to_string(cells_.size()) + " cells instead of " + std::to_string(header.size()));
  }
  std::string text() { return cells_[next_++]; }
  double value() {
    const std::string& cell = cells_[next_++];
    char* end = nullptr;
    const double found = std::strtod(cell.c_str(), &end);
    if (cell.empty() || *end != '\0') fail("has \"" + cell + "\" as " + header_[next_ - 1]);
    return found;
  }
  double phase() { return value() / 100.0; }
  std::size_t count() {
    const double found = value();
    if (!(found >= 0.0) || found > 1e15)
      fail("has " + significant_text(found, 9) + " as " + header_[next_ - 1]);
    return static_cast<std::size_t>(found);
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw InvalidInput(file_.string() + ", line " + std::to_string(number_) + " " + what +
                       "; take the line out, or name another folder to keep runs in");
  }

 private:
  const fs::path& file_;
  std::size_t number_, next_ = 0;
  Cells cells_;
  const Cells& header_;
};

MotionRun run_of(Line& line) {
  MotionRun r;
  r.heart = line.text();
  r.phase = line.phase();
  const std::string method = line.text();
  try {
    r.method = motion_method_of(method);
  } catch (const InvalidInput&) {
    line.fail("has \"" + method + "\" as method");
  }
  r.depth = static_cast<int>(line.count());
  r.sampling = line.text();
  r.lost = line.text();
  for (double* value :
       {&r.seconds, &r.processor_seconds, &r.distance_mm, &r.dice, &r.vertex_mm, &r.vertex_worst_mm})
    *value = line.value();
  r.inverted_cells = line.count();
  r.new_intersections = line.count();
  return r;
}
BranchRun branch_of(Line& line) {
  BranchRun r;
  r.heart = line.text();
  r.phase = line.phase();
  r.depth = static_cast<int>(line.count());
  r.branch = line.text();
  for (double* value :
       {&r.length_mm, &r.stretch, &r.true_stretch, &r.torsion, &r.true_torsion, &r.template_torsion, &r.size,
        &r.true_size, &r.template_size, &r.curvature, &r.true_curvature, &r.template_curvature})
    *value = line.value();
  return r;
}

/// Calls `take` for each whole line but the first, which must be the header. A last line without its end is
/// what a stopped run was writing: it is cut off.
template <class Take>
void read_table(const fs::path& file, const Cells& header, const Take& take) {
  if (!fs::exists(file)) return;
  std::string content = core::read_file(file);
  const std::size_t whole = content.rfind('\n') + 1;  // 0 where there is none
  if (whole < content.size()) {
    content.resize(whole);
    core::write_file(file, content);
  }
  std::string_view rest = content;
  for (std::size_t number = 1; !rest.empty(); ++number) {
    Cells cells;
    for (bool last = false; !last;) {
      core::CsvCell cell = core::take_csv_cell(rest);
      cells.push_back(std::move(cell.text));
      last = cell.last;
    }
    if (number > 1) {
      Line line(file, number, std::move(cells), header);
      take(line);
    } else if (cells != header) {
      throw InvalidInput(file.string() +
                         " is no table of this experiment: name another folder to keep runs in");
    }
  }
}

template <class Run>
void append(const fs::path& file, const Cells& header, const std::vector<Run>& runs) {
  if (runs.empty()) return;
  std::string text = fs::exists(file) && fs::file_size(file) > 0 ? "" : core::csv_line(header);
  for (const Run& run : runs) text += line_of(run);
  std::ofstream out(file, std::ios::app | std::ios::binary);
  out << text << std::flush;
  if (!out) throw IoError("cannot write " + file.string());
}

std::string hearts_json(const BeatingHeartOptions& o, double dice_resolution_mm) {
  return nlohmann::ordered_json{{"phases", o.phases},
                                {"template_points", o.template_points},
                                {"target_points", o.target_points},
                                {"noise_mm", o.noise_mm},
                                {"noise_length_mm", o.noise_length_mm},
                                {"phases_with_loss", o.phases_with_loss},
                                {"dice_resolution_mm", dice_resolution_mm}}
             .dump() +
         "\n";
}

bool near(double a, double b) {
  return std::abs(a - b) < 1e-6;
}

}  // namespace

std::string runs_csv(std::span<const MotionRun> runs) {
  std::string text = core::csv_line(run_header);
  for (const MotionRun& run : runs) text += line_of(run);
  return text;
}

std::string branches_csv(std::span<const BranchRun> branches) {
  std::string text = core::csv_line(branch_header);
  for (const BranchRun& run : branches) text += line_of(run);
  return text;
}

MotionKeep::MotionKeep(const MotionOptions& options) : folder_(options.keep) {
  if (folder_.empty()) return;
  std::error_code fault;
  fs::create_directories(folder_, fault);
  if (fault) throw IoError("cannot make the folder " + folder_.string() + ": " + fault.message());
  const std::string hearts = hearts_json(options.heart, options.dice_resolution_mm);
  const fs::path made_of = folder_ / "hearts.json";
  if (!fs::exists(made_of)) core::write_file(made_of, hearts);
  if (const std::string before = core::read_file(made_of); before != hearts)
    throw InvalidInput("the runs kept in " + folder_.string() +
                       " are of other hearts: " + before.substr(0, before.find('\n')) +
                       "; give the same --phases, --noise and --loss, or another folder to keep runs in");
  read_table(folder_ / "runs.csv", run_header, [&](Line& line) { put(run_of(line)); });
  read_table(folder_ / "branches.csv", branch_header, [&](Line& line) { put(branch_of(line)); });
}

std::size_t MotionKeep::count(const std::string& heart, MotionMethod method, int depth,
                              const std::string& sampling, double phase) const {
  return static_cast<std::size_t>(
      std::count_if(results_.runs.begin(), results_.runs.end(), [&](const MotionRun& r) {
        return r.heart == heart && r.method == method && r.depth == depth && r.sampling == sampling &&
               (phase < 0.0 || near(r.phase, phase));
      }));
}

bool MotionKeep::has_branches(const std::string& heart, int depth) const {
  return std::any_of(results_.branches.begin(), results_.branches.end(),
                     [&](const BranchRun& r) { return r.heart == heart && r.depth == depth; });
}

void MotionKeep::add(const std::vector<MotionRun>& runs, const std::vector<BranchRun>& branches) {
  // Branches first: a heart's cages count as done by their runs.
  if (!folder_.empty()) {
    append(folder_ / "branches.csv", branch_header, branches);
    append(folder_ / "runs.csv", run_header, runs);
  }
  for (const BranchRun& run : branches) put(run);
  for (const MotionRun& run : runs) put(run);
}

void MotionKeep::put(const MotionRun& run) {
  const auto same = std::find_if(results_.runs.begin(), results_.runs.end(), [&](const MotionRun& r) {
    return r.heart == run.heart && r.method == run.method && r.depth == run.depth &&
           r.sampling == run.sampling && near(r.phase, run.phase);
  });
  if (same == results_.runs.end())
    results_.runs.push_back(run);
  else
    *same = run;
}

void MotionKeep::put(const BranchRun& run) {
  const auto same = std::find_if(results_.branches.begin(), results_.branches.end(), [&](const BranchRun& r) {
    return r.heart == run.heart && r.depth == run.depth && r.branch == run.branch && near(r.phase, run.phase);
  });
  if (same == results_.branches.end())
    results_.branches.push_back(run);
  else
    *same = run;
}

}  // namespace ostia::experiments
