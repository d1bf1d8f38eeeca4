#include "tree/tree_commands.h"
#include "tree/tree_input.h"

#include "ostia/core/files.h"
#include "ostia/core/log.h"
#include "ostia/core/text.h"
#include "ostia/geometry/graph_faults.h"
#include "ostia/geometry/graph_units.h"
#include "ostia/io/graph_file.h"
#include "ostia/io/markups_file.h"
#include "ostia/io/rotterdam_file.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <string>

namespace ostia::app {
namespace {

using core::significant_text;
using geometry::GraphFacts;
using geometry::GraphFaults;
using geometry::Vec3;
using Json = nlohmann::ordered_json;

Json json_point(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

std::string place(const Vec3& v) {
  return significant_text(v.x(), 6) + ", " + significant_text(v.y(), 6) + ", " + significant_text(v.z(), 6) +
         " mm";
}

/// Counts by key; places by the file's own references.
Json faults_json(const GraphFaults& faults, const io::LoadedGraph& loaded) {
  Json all = Json::array();
  for (const geometry::GraphFault& fault : faults.found) {
    Json places = Json::array();
    for (const std::int32_t e : fault.edges)
      places.push_back(loaded.graph.references[static_cast<std::size_t>(e)]);
    for (const std::int32_t p : fault.points) places.push_back(p);
    all.push_back({{"what", geometry::name_of(fault.kind)},
                   {"count", fault.count},
                   {"first", places},
                   {"places", fault.points.empty() ? loaded.reference_name : "point"},
                   {"text", geometry::text_of(fault, loaded.graph, loaded.reference_name)}});
  }
  return all;
}

std::string json_text(const GraphFacts& f, const GraphFaults& faults, const io::LoadedGraph& loaded) {
  Json out{{"v", 1},
           {"kind", "tree"},
           {"points", f.points},
           {"segments", f.segments},
           {"branches", f.branches},
           {"parts", f.parts},
           {"roots", f.roots},
           {"ends", f.ends},
           {"forks", f.forks},
           {"trifurcations", f.trifurcations},
           {"joins", f.joins},
           {"loops", f.loops},
           {"length_mm", f.length_mm},
           {"least_radius_mm", f.least_radius_mm},
           {"largest_radius_mm", f.largest_radius_mm},
           {"box_mm", Json::array()},
           {"is_tree", faults.sound_tree()},
           {"faults", faults_json(faults, loaded)},
           {"warnings", loaded.warnings}};
  if (!f.box.isEmpty()) out["box_mm"] = {json_point(f.box.min()), json_point(f.box.max())};
  return out.dump(2) + "\n";
}

std::string plain_text(const GraphFacts& f, const GraphFaults& faults, const io::LoadedGraph& loaded) {
  std::string out;
  const auto row = [&](const std::string& name, const std::string& value) {
    out += name + std::string(name.size() < 14 ? 14 - name.size() : 1, ' ') + value + "\n";
  };
  const auto count = [&](const char* name, std::size_t value) { row(name, std::to_string(value)); };
  row("kind", f.loops > 0 ? "network" : "tree");
  count("points", f.points);
  count("segments", f.segments);
  count("branches", f.branches);
  count("parts", f.parts);
  count("roots", f.roots);
  count("ends", f.ends);
  count("forks", f.forks);
  count("trifurcations", f.trifurcations);
  count("joins", f.joins);
  count("loops", f.loops);
  row("length", significant_text(f.length_mm, 6) + " mm");
  row("radius", f.largest_radius_mm > 0.0 ? significant_text(f.least_radius_mm, 6) + " to " +
                                                significant_text(f.largest_radius_mm, 6) + " mm"
                                          : "none");
  if (!f.box.isEmpty()) {
    row("from", place(f.box.min()));
    row("to", place(f.box.max()));
  }
  for (const std::string& warning : loaded.warnings) row("warning", warning);
  if (faults.found.empty()) row("faults", "none");
  for (const geometry::GraphFault& fault : faults.found)
    row("fault", geometry::text_of(fault, loaded.graph, loaded.reference_name));
  return out;
}

bool head_has(const std::filesystem::path& path, std::string_view words) {
  std::string head(1 << 16, '\0');
  std::ifstream in(path, std::ios::binary);
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(in.gcount()));
  return head.find(words) != std::string::npos;
}

/// Legacy files have their points' arrays behind all points.
bool legacy_points_have_radii(const std::filesystem::path& path) {
  const std::string content = core::read_file(path);
  const std::size_t points = std::min(content.find("POINT_DATA"), content.size());
  const std::string_view arrays = std::string_view(content).substr(points);
  return arrays.substr(0, arrays.find("CELL_DATA")).find("adius") != std::string_view::npos;
}

/// Files of centerlines have vessels and one radius for a point; networks have more than that.
bool is_centerline_file(const std::filesystem::path& path) {
  const std::string extension = path.extension().string();
  if (io::is_markups_file(path)) return true;
  if (extension == ".vtp")
    return head_has(path, "MaximumInscribedSphereRadius") && !head_has(path, "RadiusFrom");
  if (extension == ".vtk") return legacy_points_have_radii(path);
  if (extension == ".txt") return !io::read_rotterdam_axis(path).radius.empty();
  return extension == ".csv" && head_has(path, "radius") && !head_has(path, "x1,") &&
         !head_has(path, "parent");
}

void refuse_options_of_surfaces(const ConvertCommand& options) {
  if (options.keep_parts || options.largest_part || options.fill_holes_mm > 0.0 || options.smooth > 0 ||
      options.subdivide > 0)
    throw UsageError(
        "--fill-holes, --keep-parts, --smooth and --subdivide are for surfaces, and this is a tree");
}

}  // namespace

ExitCode tree_info(const InfoOptions& options, const core::TaskContext& task) {
  if (!options.preview.empty()) throw UsageError("--preview is for images, and this is a tree");
  io::LoadedGraph loaded = io::read_graph(options.input.input, task.sub(0.0, 0.8));
  if (const std::string told = joined_side_by_side(loaded, task.sub(0.8, 0.85)); !told.empty())
    loaded.warnings.push_back(told);
  const GraphFaults faults = geometry::find_faults(loaded.graph, task.sub(0.85, 0.9));
  const GraphFacts facts = geometry::facts_of(loaded.graph, task.sub(0.9, 1.0));
  if (const std::string doubt = geometry::unit_doubt(facts); !doubt.empty()) loaded.warnings.push_back(doubt);
  std::fputs((options.json ? json_text(facts, faults, loaded) : plain_text(facts, faults, loaded)).c_str(),
             stdout);
  return ExitCode::ok;
}

bool converts_tree(const ConvertCommand& options) {
  if (!io::is_graph_file(options.input.input)) return false;
  const std::string from = options.input.input.extension().string();
  const std::string to = options.output.extension().string();
  const TreeInputOptions& tree = options.tree;
  const bool told = tree.repair || tree.merge_mm > 0.0 || !tree.roots.empty() || tree.keep_directions ||
                    !tree.radius_units.empty();
  const bool lines = to == ".csv" || (to == ".vtp" && from != ".vtp");
  return told || !lines || !is_centerline_file(options.input.input);
}

ExitCode convert_tree(const ConvertCommand& options, const core::TaskContext& task) {
  refuse_options_of_surfaces(options);
  Json done{{"v", 1}, {"kind", "conversion"}};
  const io::LoadedGraph loaded = read_tree(options.input, options.tree, done, task.sub(0.0, 0.8));
  for (const std::string& warning : io::write_graph(options.output, loaded.graph, task.sub(0.8, 1.0)))
    core::log_warning(warning);
  done["points"] = loaded.graph.points.size();
  done["segments"] = loaded.graph.edges.size();
  if (options.json) std::fputs((done.dump(2) + "\n").c_str(), stdout);
  return ExitCode::ok;
}

}  // namespace ostia::app
