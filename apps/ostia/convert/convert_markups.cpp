#include "convert/convert_markups.h"

#include "output/outputs.h"
#include "output/refusal.h"
#include "tree/tree_input.h"

#include "ostia/core/log.h"
#include "ostia/geometry/graph_tree.h"
#include "ostia/io/centerline_file.h"
#include "ostia/io/markups_file.h"
#include "ostia/session/case_file.h"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <string>
#include <utility>
#include <vector>

namespace ostia::app {
namespace {

using MarkupsJson = nlohmann::ordered_json;

bool asks_for_repair(const ConvertCommand& o) {
  return o.tree.repair || !o.input.units.empty() || !o.tree.radius_units.empty();
}

void check_options(const ConvertCommand& o, bool of_trees) {
  if (o.keep_parts || o.largest_part || o.fill_holes_mm > 0.0 || o.smooth > 0 || o.subdivide > 0)
    throw UsageError(
        "--fill-holes, --keep-parts, --smooth and --subdivide are for surfaces, which are no markups");
  if (!of_trees && (asks_for_repair(o) || !o.tree.roots.empty()))
    throw UsageError("--repair, --root, --units and --radius-units are for trees read from files of lines");
}

/// The places of a case's measurements, each list labelled by what was measured.
std::vector<io::Markup> measured_places(const session::Annotations& annotations) {
  io::Markup list;
  list.name = "measurements";
  for (const analysis::Measurement& one : annotations.measurements) {
    const std::string name = one.name.empty() ? to_string(one.kind) + " " + std::to_string(one.id) : one.name;
    for (std::size_t i = 0; i < one.points.size(); ++i) {
      list.points.push_back(one.points[i]);
      list.labels.push_back(one.points.size() > 1 ? name + ", " + std::to_string(i + 1) : name);
    }
  }
  if (list.points.empty()) return {};
  return {std::move(list)};
}

std::vector<io::Markup> markups_of(const geometry::VesselTree& tree, bool landmarks) {
  return landmarks ? io::landmarks_of(tree) : io::curves_of(tree);
}

std::vector<io::Markup> from_case(const ConvertCommand& o, bool landmarks) {
  check_options(o, false);
  const auto opened = session::CaseFile::open(o.input.input, session::OpenMode::read_only);
  std::vector<io::Markup> all = markups_of(opened.model()->tree, landmarks);
  if (!landmarks) return all;
  for (io::Markup& list : measured_places(*opened.annotations())) all.push_back(std::move(list));
  return all;
}

std::vector<io::Markup> from_markups(const ConvertCommand& o, bool landmarks) {
  check_options(o, false);
  io::MarkupsFile file = io::read_markups(o.input.input);
  for (const std::string& warning : file.warnings)
    core::log_warning(own_name(o.input.input) + ": " + warning);
  if (!o.landmarks) return std::move(file.markups);
  return markups_of(io::tree_of(file.markups, own_name(o.input.input)), landmarks);
}

std::vector<io::Markup> from_lines(const ConvertCommand& o, bool landmarks, MarkupsJson& done,
                                   const core::TaskContext& task) {
  check_options(o, true);
  require_repair(o.tree);
  if (!asks_for_repair(o)) return markups_of(io::read_centerlines(o.input.input), landmarks);
  io::LoadedGraph loaded = read_tree(o.input, o.tree, done, task);
  join_lines_side_by_side(loaded, task);
  return markups_of(geometry::tree_of(loaded.graph), landmarks);
}

}  // namespace

bool converts_to_markups(const ConvertCommand& o) {
  return io::is_markups_file(o.output);
}

ExitCode convert_to_markups(const ConvertCommand& o, const core::TaskContext& task) {
  require_output(o.output, {".mrk.json", ".fcsv"});
  const bool landmarks = o.landmarks || has_extension(o.output, {".fcsv"});
  MarkupsJson done{{"v", 1}, {"kind", "conversion"}};
  const std::vector<io::Markup> markups = o.input.input.extension() == ".ostia" ? from_case(o, landmarks)
                                          : io::is_markups_file(o.input.input)
                                              ? from_markups(o, landmarks)
                                              : from_lines(o, landmarks, done, task);
  io::write_markups(o.output, markups);
  done["lists"] = markups.size();
  std::size_t points = 0;
  for (const io::Markup& markup : markups) points += markup.points.size();
  done["points"] = points;
  if (o.json) std::fputs((done.dump(2) + "\n").c_str(), stdout);
  return ExitCode::ok;
}

}  // namespace ostia::app
