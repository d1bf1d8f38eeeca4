// What the subcommands of `ostia evaluate` share: finding files, printing, requirements.

#include "evaluate/evaluate.h"
#include "options/model_options.h"

#include "ostia/core/log.h"
#include "ostia/core/text.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/io/centerline_file.h"
#include "ostia/io/rotterdam_file.h"
#include "ostia/io/surface_file.h"
#include "ostia/pipeline/source.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace ostia::app {
namespace fs = std::filesystem;
namespace {

std::string cell_text(const Json& value) {
  if (value.is_null()) return "-";
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number_float()) return core::significant_text(value.get<double>(), 4);
  return value.dump();
}

bool is_table(const Json& value) {
  return value.is_array() && !value.empty() && value.front().is_object();
}

void add_row_cells(const Json& object, const std::string& prefix,
                   std::vector<std::pair<std::string, std::string>>& cells) {
  for (const auto& item : object.items()) {
    if (item.value().is_object()) {
      add_row_cells(item.value(), prefix + item.key() + ".", cells);
    } else if (!item.value().is_array()) {
      cells.emplace_back(prefix + item.key(), cell_text(item.value()));
    }
  }
}

std::string rows_text(const Json& list) {
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
  for (const Json& item : list) {
    std::vector<std::pair<std::string, std::string>> cells;
    add_row_cells(item, "", cells);
    std::vector<std::string> row(header.size());
    for (const auto& [name, text] : cells) {
      auto at = std::find(header.begin(), header.end(), name);
      if (at == header.end()) {
        header.push_back(name);
        row.emplace_back();
        at = header.end() - 1;
      }
      row[static_cast<std::size_t>(at - header.begin())] = text;
    }
    rows.push_back(row);
  }
  rows.insert(rows.begin(), header);
  std::vector<std::size_t> width(header.size(), 0);
  for (auto& row : rows) {
    row.resize(header.size());
    for (std::size_t i = 0; i < row.size(); ++i) width[i] = std::max(width[i], row[i].size());
  }
  std::string out;
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i)
      line += row[i] + std::string(width[i] - row[i].size() + 2, ' ');
    out += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return out;
}

void add_text(const Json& object, const std::string& prefix, std::string& out) {
  for (const auto& item : object.items()) {
    const Json& value = item.value();
    const std::string key = prefix + item.key();
    if (value.is_object()) {
      add_text(value, key + ".", out);
    } else if (is_table(value)) {
      out += "\n" + key + "\n" + rows_text(value);
    } else if (value.is_array()) {
      for (const Json& one : value) out += key + "  " + cell_text(one) + "\n";
    } else if (key != "v") {
      out += key + std::string(key.size() < 24 ? 24 - key.size() : 1, ' ') + cell_text(value) + "\n";
    }
  }
}

/// The figure that a dotted key names, or null.
const Json* figure_of(const Json& result, const std::string& key) {
  const Json* at = &result;
  std::size_t from = 0;
  while (from <= key.size()) {
    const std::size_t to = std::min(key.find('.', from), key.size());
    const std::string part = key.substr(from, to - from);
    if (!at->is_object() || !at->contains(part)) return nullptr;
    at = &(*at)[part];
    from = to + 1;
  }
  return at;
}

bool met(const Json& result, const std::string& requirement) {
  const std::size_t sign = requirement.find_first_of("<>");
  const bool complete =
      sign != std::string::npos && sign > 0 && requirement.size() > sign + 2 && requirement[sign + 1] == '=';
  char* end = nullptr;
  const double bound = complete ? std::strtod(requirement.c_str() + sign + 2, &end) : 0.0;
  if (!complete || *end != '\0' || !std::isfinite(bound))
    throw UsageError("--require " + requirement +
                     ": write FIGURE<=NUMBER or FIGURE>=NUMBER, as in msd_mm<=0.3");
  const Json* figure = figure_of(result, requirement.substr(0, sign));
  if (!figure || !(figure->is_number() || figure->is_null()))
    throw UsageError("--require " + requirement +
                     ": this result has no figure of that name; --json shows what it has");
  if (figure->is_null()) return false;
  const double value = figure->get<double>();
  const bool ok = requirement[sign] == '<' ? value <= bound : value >= bound;
  if (!ok) core::log_warning("not met: " + requirement + ", is " + cell_text(*figure));
  return ok;
}

std::optional<double> unit_of(const std::string& units) {
  if (units.empty()) return std::nullopt;
  return units == "m" ? 1000.0 : units == "cm" ? 10.0 : 1.0;
}

/// A single line of the challenge's text files as a tree of one vessel.
geometry::VesselTree tree_of(const std::vector<geometry::Vec3>& as_read, const std::string& name) {
  const std::vector<geometry::Vec3> points = io::without_repeated({as_read, {}, {}}).points;
  geometry::VesselTree tree;
  geometry::TreeSegment segment;
  segment.to = 1;
  segment.axis.points = points;
  segment.axis.radius.assign(points.size(), 0.0);
  geometry::complete(segment.axis);
  tree.nodes = {{0, points.front()}, {1, points.back()}};
  tree.segments.push_back(std::move(segment));
  tree.vessels.push_back({0, name, {0}});
  return tree;
}

void scale(geometry::VesselTree& tree, double factor) {
  for (auto& node : tree.nodes) node.position *= factor;
  for (auto& segment : tree.segments) {
    for (auto& p : segment.axis.points) p *= factor;
    for (double& r : segment.axis.radius) r *= factor;
    for (double& s : segment.axis.abscissa) s *= factor;
  }
}

}  // namespace

std::vector<CasePair> case_pairs(const fs::path& reference, const fs::path& result) {
  for (const fs::path& path : {reference, result})
    if (!fs::exists(path))
      throw IoError("cannot read " + path.string() + ": there is no such file or folder");
  std::vector<CasePair> pairs;
  if (fs::is_directory(reference)) {
    for (const auto& entry : fs::directory_iterator(reference)) {
      const std::string name = entry.path().filename().string();
      if (!entry.is_directory() || name.rfind("dataset", 0) != 0) continue;
      const fs::path own = result / name;
      pairs.push_back({name, entry.path(), own, !fs::exists(own)});
    }
  }
  if (pairs.empty()) return {{"", reference, result, false}};
  std::sort(pairs.begin(), pairs.end(), [](const CasePair& a, const CasePair& b) { return a.name < b.name; });
  if (std::all_of(pairs.begin(), pairs.end(), [](const CasePair& p) { return p.missing; }))
    throw InvalidInput(result.string() + " has no folder " + pairs.front().name +
                       ": results of a suite lie in folders named as the reference's");
  return pairs;
}

void require_pair(const EvaluateCommand& command) {
  if (command.reference.empty() || command.result.empty())
    throw UsageError("`ostia evaluate` needs REFERENCE and RESULT");
}

fs::path file_in(const fs::path& path, const std::vector<std::string>& names, const std::string& what) {
  if (!fs::exists(path)) throw IoError("cannot read " + path.string() + ": there is no such file or folder");
  if (!fs::is_directory(path)) return path;
  std::string all;
  for (const std::string& name : names) {
    if (fs::is_regular_file(path / name)) return path / name;
    all += (all.empty() ? "" : ", ") + name;
  }
  throw InvalidInput("no " + what + " in the folder " + path.string() + ": none of " + all + " is there");
}

std::vector<fs::path> files_in(const fs::path& path, const std::vector<std::string>& names,
                               const std::string& what) {
  std::vector<fs::path> parts;
  if (fs::is_directory(path)) {
    const auto has_one = [&](const fs::path& folder) {
      return std::any_of(names.begin(), names.end(),
                         [&](const std::string& name) { return fs::is_regular_file(folder / name); });
    };
    if (!has_one(path))
      for (const auto& entry : fs::directory_iterator(path))
        if (entry.is_directory() && has_one(entry.path()))
          parts.push_back(file_in(entry.path(), names, what));
    std::sort(parts.begin(), parts.end());
  }
  if (parts.empty()) parts.push_back(file_in(path, names, what));
  return parts;
}

geometry::TriMesh surface_of_parts(const std::vector<fs::path>& parts, const std::string& units) {
  geometry::TriMesh all;
  for (const fs::path& part : parts) all = geometry::merged(all, surface_from(part, units));
  return all;
}

geometry::VesselTree lines_of_parts(const std::vector<fs::path>& parts, const std::string& units) {
  geometry::VesselTree all;
  for (const fs::path& path : parts) {
    const geometry::VesselTree part = lines_from(path, units);
    std::int32_t shift = 0;  // ids are not used twice
    for (const auto& node : all.nodes) shift = std::max(shift, node.id + 1);
    for (const auto& segment : all.segments) shift = std::max(shift, segment.id + 1);
    for (const auto& vessel : all.vessels) shift = std::max(shift, vessel.id + 1);
    for (geometry::TreeNode node : part.nodes) {
      node.id += shift;
      all.nodes.push_back(node);
    }
    for (geometry::TreeSegment segment : part.segments) {
      segment.id += shift;
      segment.from += shift;
      segment.to += shift;
      all.segments.push_back(segment);
    }
    for (geometry::Vessel vessel : part.vessels) {
      vessel.id += shift;
      for (std::int32_t& segment : vessel.segments) segment += shift;
      if (parts.size() > 1) vessel.name = path.parent_path().filename().string() + "/" + vessel.name;
      all.vessels.push_back(vessel);
    }
  }
  return all;
}

geometry::TriMesh surface_from(const fs::path& path, const std::string& units) {
  if (pipeline::classify(path) != pipeline::SourceKind::surface)
    throw InvalidInput(path.string() + " is no surface (.vtp .vtk .stl .ply .obj)");
  // As it stands: what is judged is not mended, and its caps stay on.
  geometry::TriMesh mesh = io::read_surface(path).surface.mesh;
  if (mesh.triangles.empty()) throw InvalidInput(path.string() + " holds no triangle");
  const double unit_mm = unit_of(units).value_or(1.0);
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    if (!mesh.points[i].allFinite())
      throw InvalidInput("cannot use " + path.string() + ": point " + std::to_string(i) +
                         " is not a finite place; `ostia convert --repair` drops such triangles");
    mesh.points[i] *= unit_mm;
  }
  if (!unit_of(units)) {
    constexpr double widest_mm = 100.0;  // the least extent bounds a vessel's width from above
    pipeline::check_vessel_size(std::min(geometry::bounds(mesh.points).sizes().minCoeff(), widest_mm),
                                path.string());
  }
  return mesh;
}

geometry::VesselTree lines_from(const fs::path& path, const std::string& units) {
  geometry::VesselTree tree;
  if (path.extension() == ".txt") {
    tree = tree_of(io::read_rotterdam_line(path), path.stem().string());
  } else {
    tree = io::read_centerlines(path);
  }
  if (tree.segments.empty()) throw InvalidInput(path.string() + " holds no line");
  if (const auto unit = unit_of(units)) {
    scale(tree, *unit);
    return tree;
  }
  for (const auto& segment : tree.segments)
    for (const double r : segment.axis.radius)
      if (r > 0.0) pipeline::check_vessel_size(2.0 * r, path.string());
  return tree;
}

std::string table_text(const Json& result) {
  std::string out;
  add_text(result, "", out);
  return out;
}

ExitCode finish(const EvaluateCommand& command, const Json& result) {
  bool all_met = true;
  for (const std::string& requirement : command.requirements) all_met = met(result, requirement) && all_met;
  std::fputs(command.json ? (result.dump(2) + "\n").c_str() : table_text(result).c_str(), stdout);
  return all_met ? ExitCode::ok : ExitCode::quality_failed;
}

}  // namespace ostia::app
