#include "ostia/session/edit_json.h"

#include "case_file/json_fields.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"

#include <algorithm>
#include <utility>

namespace ostia::session {
namespace {

using json_fields::Json;
using json_fields::Need;
using json_fields::Reader;
using json_fields::Writer;
using lumen::Edit;

// One list of fields for an edit, for writing and for reading. What has a default in lumen/edit.h that suits
// most edits may be left out.
template <class E, class V>
requires std::is_same_v<std::remove_const_t<E>, lumen::CprStroke>
void fields(E& e, V& v) {
  v("vessel", e.vessel);
  v("points", e.points);
  v("mode", e.mode);
  v("theta_deg", e.theta_deg);
  v("beta_deg", e.beta_deg, Need::optional);
}
template <class E, class V>
requires std::is_same_v<std::remove_const_t<E>, lumen::SectionContour>
void fields(E& e, V& v) {
  v("vessel", e.vessel);
  v("s_mm", e.s_mm);
  v("eps_mm", e.eps_mm, Need::optional);
  v("closed", e.closed);
  v("points", e.points);
}
template <class E, class V>
requires std::is_same_v<std::remove_const_t<E>, lumen::WallDrag> ||
    std::is_same_v<std::remove_const_t<E>, lumen::AxisMove>
void fields(E& e, V& v) {
  v("vessel", e.vessel);
  v("from", e.from);
  v("to", e.to);
  v("reach_mm", e.reach_mm, Need::optional);
}
template <class E, class V>
requires std::is_same_v<std::remove_const_t<E>, lumen::WallPush>
void fields(E& e, V& v) {
  v("vessel", e.vessel);
  v("path", e.path);
  v("radius_mm", e.radius_mm, Need::optional);
}
template <class E, class V>
requires std::is_same_v<std::remove_const_t<E>, lumen::AxisInsert> ||
    std::is_same_v<std::remove_const_t<E>, lumen::AxisDelete>
void fields(E& e, V& v) {
  v("vessel", e.vessel);
  v("point", e.point);
}
template <class E, class V>
requires std::is_same_v<std::remove_const_t<E>, lumen::AxisExtend>
void fields(E& e, V& v) {
  v("vessel", e.vessel);
  v("points", e.points);
}
template <class E, class V>
requires std::is_same_v<std::remove_const_t<E>, lumen::AxisTrim>
void fields(E& e, V& v) {
  v("vessel", e.vessel);
  v("s_mm", e.s_mm);
}
/// The wall only where there is one: what older programs wrote has none, and is written as it was.
template <class E, class V>
void new_vessel_fields(E& e, V& v) {
  v("name", e.name);
  v("points", e.points);
  v("radius_mm", e.radius_mm);
  if constexpr (std::is_same_v<V, Writer>)
    if (e.wall.empty()) return;
  v("around", e.wall.around, Need::optional);
  v("wall_mm", e.wall.radius_mm, Need::optional);
}
template <class E, class V>
requires std::is_same_v<std::remove_const_t<E>, lumen::BranchAdd>
void fields(E& e, V& v) {
  v("parent", e.parent);
  new_vessel_fields(e, v);
}
template <class E, class V>
requires std::is_same_v<std::remove_const_t<E>, lumen::VesselAdd>
void fields(E& e, V& v) {
  new_vessel_fields(e, v);
}
template <class E, class V>
requires std::is_same_v<std::remove_const_t<E>, lumen::BranchSplit> ||
    std::is_same_v<std::remove_const_t<E>, lumen::BranchCut>
void fields(E& e, V& v) {
  v("vessel", e.vessel);
  v("s_mm", e.s_mm);
  v("name", e.name, Need::optional);
}
template <class E, class V>
requires std::is_same_v<std::remove_const_t<E>, lumen::BranchDelete> ||
    std::is_same_v<std::remove_const_t<E>, lumen::BranchMerge>
void fields(E& e, V& v) {
  v("vessel", e.vessel);
}
template <class E, class V>
requires std::is_same_v<std::remove_const_t<E>, lumen::BranchAttach> ||
    std::is_same_v<std::remove_const_t<E>, lumen::BranchConnect>
void fields(E& e, V& v) {
  v("vessel", e.vessel);
  v("parent", e.parent);
  v("at", e.at);
}
template <class E, class V>
requires std::is_same_v<std::remove_const_t<E>, lumen::VesselRename>
void fields(E& e, V& v) {
  v("vessel", e.vessel);
  v("name", e.name);
}

/// The edit of a name with its defaults.
template <std::size_t Index = 0>
Edit edit_named(const std::string& op) {
  if constexpr (Index == std::variant_size_v<Edit>) {
    std::string choices;
    const auto add = [&]<std::size_t... I>(std::index_sequence<I...>) {
      ((choices += (I == 0 ? "" : ", ") + lumen::op_name(Edit(std::in_place_index<I>))), ...);
    };
    add(std::make_index_sequence<std::variant_size_v<Edit>>());
    throw InvalidInput("an edit has the unknown \"op\" \"" + op + "\"; known are " + choices);
  } else {
    const Edit candidate(std::in_place_index<Index>);
    return lumen::op_name(candidate) == op ? candidate : edit_named<Index + 1>(op);
  }
}

}  // namespace

std::string to_json(const Edit& edit) {
  return json_fields::line_of("edit", lumen::op_name(edit), [&](Writer& writer) {
    std::visit([&](const auto& kind) { fields(kind, writer); }, edit);
  });
}

Edit edit_of_json(std::string_view line) {
  const Json in = json_fields::object_of("edit", line);
  Edit edit = edit_named(in["op"].get<std::string>());
  Reader reader(in, "edit " + in["op"].get<std::string>());
  std::visit([&](auto& kind) { fields(kind, reader); }, edit);
  reader.require_no_others();
  return edit;
}

std::string to_json(const PluginEdits& step) {
  Json edits = Json::array();
  for (const Edit& edit : step.edits) edits.push_back(Json::parse(to_json(edit)));
  return json_fields::line_of("edit", std::string(plugin_op), [&](Writer& writer) {
    writer("name", step.name);
    writer("version", step.version);
    writer.put("edits", std::move(edits));
  });
}

PluginEdits plugin_edits_of_json(std::string_view line) {
  const Json in = json_fields::object_of("edit", line);
  PluginEdits step;
  Reader reader(in, "edit plugin");
  reader("name", step.name);
  reader("version", step.version);
  if (!in.contains("edits") || !in["edits"].is_array())
    throw InvalidInput("the edit plugin: it has no array \"edits\"");
  for (const Json& one : in["edits"]) {
    try {
      step.edits.push_back(edit_of_json(one.dump()));
    } catch (const InvalidInput& error) {
      throw InvalidInput("edit " + std::to_string(step.edits.size() + 1) + ": " + error.what());
    }
  }
  return step;
}

std::string plugin_named_in(std::string_view line) {
  const Json in = Json::parse(line, nullptr, false);
  if (!in.is_object() || !in.contains("name") || !in["name"].is_string()) return {};
  const std::string version = in.value("version", "");
  return in["name"].get<std::string>() + (version.empty() ? "" : " " + version);
}

std::vector<EditLine> edit_lines(std::string_view text, const std::string& name) {
  std::vector<EditLine> lines;
  std::size_t number = 0;
  for (std::size_t first = 0; first < text.size();) {
    const std::size_t end = std::min(text.find('\n', first), text.size());
    const std::string_view line = text.substr(first, end - first);
    first = end + 1;
    ++number;
    if (line.find_first_not_of(" \t\r") == std::string_view::npos) continue;
    try {
      lines.push_back({number, edit_of_json(line)});
    } catch (const InvalidInput& e) {
      throw InvalidInput(name + ", line " + std::to_string(number) + ": " + e.what());
    }
  }
  return lines;
}

std::vector<Edit> read_edits(const std::filesystem::path& path) {
  std::vector<Edit> edits;
  for (EditLine& line : edit_lines(core::read_file(path), path.string()))
    edits.push_back(std::move(line.edit));
  return edits;
}

void write_edits(const std::filesystem::path& path, const std::vector<Edit>& edits) {
  std::string content;
  for (const Edit& edit : edits) content += to_json(edit) + "\n";
  core::write_file(path, content);
}

}  // namespace ostia::session
