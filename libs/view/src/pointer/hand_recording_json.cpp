// Recordings as JSON lines.

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/view/hand_recording.h"

#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <string_view>
#include <utility>

namespace ostia::view {
namespace {

using Json = nlohmann::ordered_json;
using session::Tool;

template <class Enum>
using Names = std::vector<std::pair<Enum, std::string_view>>;

const Names<HandAct::Kind>& act_names() {
  using Kind = HandAct::Kind;
  static const Names<Kind> names{{Kind::press, "press"},     {Kind::move, "move"},
                                 {Kind::release, "release"}, {Kind::double_click, "double"},
                                 {Kind::wheel, "wheel"},     {Kind::leave, "leave"},
                                 {Kind::cancel, "cancel"},   {Kind::erase, "erase"}};
  return names;
}
const Names<Button>& button_names() {
  static const Names<Button> names{
      {Button::none, "none"}, {Button::left, "left"}, {Button::middle, "middle"}, {Button::right, "right"}};
  return names;
}
const Names<Tool>& tool_names() {
  static const Names<Tool> names = [] {
    Names<Tool> all;
    for (const Tool tool : session::all_tools) all.emplace_back(tool, session::traits_of(tool).name);
    return all;
  }();
  return names;
}
const Names<reformat::CurvedMode>& mode_names() {
  static const Names<reformat::CurvedMode> names{{reformat::CurvedMode::straightened, "straightened"},
                                                 {reformat::CurvedMode::stretched, "stretched"}};
  return names;
}
const Names<reformat::Slab>& slab_names() {
  static const Names<reformat::Slab> names{{reformat::Slab::none, "none"},
                                           {reformat::Slab::mean, "mean"},
                                           {reformat::Slab::maximum, "maximum"},
                                           {reformat::Slab::minimum, "minimum"}};
  return names;
}

template <class Enum>
std::string name_of(const Names<Enum>& names, Enum value) {
  for (const auto& [known, name] : names)
    if (known == value) return std::string(name);
  throw InvalidInput("a recording has no name for this value");
}

const Json& field(const Json& object, const char* key) {
  if (!object.is_object() || !object.contains(key))
    throw InvalidInput(std::string("the field \"") + key + "\" is missing");
  return object.at(key);
}
double number(const Json& object, const char* key) {
  const Json& value = field(object, key);
  if (!value.is_number() || !std::isfinite(value.get<double>()))
    throw InvalidInput(std::string("the field \"") + key + "\" must be a finite number");
  return value.get<double>();
}
std::string text(const Json& object, const char* key) {
  const Json& value = field(object, key);
  if (!value.is_string()) throw InvalidInput(std::string("the field \"") + key + "\" must be a text");
  return value.get<std::string>();
}
int whole(const Json& object, const char* key, int low, int high) {
  const Json& value = field(object, key);
  if (!value.is_number_integer() || value.get<double>() < low || value.get<double>() > high)
    throw InvalidInput(std::string("the field \"") + key + "\" must be a whole number from " +
                       std::to_string(low) + " to " + std::to_string(high));
  return value.get<int>();
}
std::vector<double> numbers(const Json& object, const char* key, std::size_t least, std::size_t most) {
  const Json& value = field(object, key);
  std::vector<double> out;
  if (value.is_array())
    for (const Json& one : value)
      if (one.is_number() && std::isfinite(one.get<double>())) out.push_back(one.get<double>());
  if (!value.is_array() || out.size() != value.size() || out.size() < least || out.size() > most)
    throw InvalidInput(std::string("the field \"") + key + "\" must be " + std::to_string(least) +
                       (most > least ? " or more" : "") + " finite numbers");
  return out;
}
Vec3 point(const Json& object, const char* key) {
  const std::vector<double> p = numbers(object, key, 3, 3);
  return {p[0], p[1], p[2]};
}
template <class Enum>
Enum named(const Names<Enum>& names, const Json& object, const char* key) {
  const std::string given = text(object, key);
  std::string known;
  for (const auto& [value, name] : names) {
    if (given == name) return value;
    known += (known.empty() ? "" : ", ") + std::string(name);
  }
  throw InvalidInput(std::string("the field \"") + key + "\" is one of: " + known);
}
Json json_of(const Vec3& p) {
  return Json::array({p.x(), p.y(), p.z()});
}

Json json_of(const HandState& s) {
  return {{"vessel", s.vessel},
          {"cursor_mm", s.cursor_mm},
          {"place", json_of(s.place)},
          {"theta_deg", s.theta_deg},
          {"mode", name_of(mode_names(), s.mode)},
          {"slab", name_of(slab_names(), s.slab)},
          {"slab_mm", s.slab_mm},
          {"level_hu", s.grey.level_hu},
          {"width_hu", s.grey.width_hu},
          {"tool", name_of(tool_names(), s.tool)},
          {"brush_mm", s.brush_mm},
          {"reach_mm", s.reach_mm},
          {"beta_deg", s.beta_deg},
          {"section_eps_mm", s.section_eps_mm},
          {"marks_shown", s.marks_shown}};
}
HandState state_of(const Json& json) {
  HandState s;
  s.vessel = whole(json, "vessel", -1, 2147483647);
  s.cursor_mm = number(json, "cursor_mm");
  s.place = point(json, "place");
  s.theta_deg = number(json, "theta_deg");
  s.mode = named(mode_names(), json, "mode");
  s.slab = named(slab_names(), json, "slab");
  s.slab_mm = number(json, "slab_mm");
  s.grey = {number(json, "level_hu"), number(json, "width_hu")};
  if (!(s.grey.width_hu > 0.0)) throw InvalidInput("the field \"width_hu\" must be above 0");
  s.tool = named(tool_names(), json, "tool");
  s.brush_mm = number(json, "brush_mm");
  s.reach_mm = number(json, "reach_mm");
  s.beta_deg = number(json, "beta_deg");
  s.section_eps_mm = number(json, "section_eps_mm");
  const Json& marks = field(json, "marks_shown");
  if (!marks.is_boolean()) throw InvalidInput("the field \"marks_shown\" must be true or false");
  s.marks_shown = marks.get<bool>();
  return s;
}

Json json_of(const HandFrame& f) {
  return {{"width", f.width}, {"height", f.height}, {"density", f.density}, {"framing", f.framing}};
}
HandFrame frame_of(const Json& json) {
  HandFrame f;
  f.width = whole(json, "width", 1, 16000);
  f.height = whole(json, "height", 1, 16000);
  f.density = number(json, "density");
  if (!(f.density > 0.0)) throw InvalidInput("the field \"density\" must be above 0");
  f.framing = numbers(json, "framing", 1, 32);
  return f;
}

bool has_place(HandAct::Kind kind) {
  return kind != HandAct::Kind::leave && kind != HandAct::Kind::cancel;
}

void add_act(Json& json, const HandLine& line) {
  const PointerEvent& event = line.act.event;
  json["view"] = line.view;
  json["act"] = name_of(act_names(), line.act.kind);
  if (!has_place(line.act.kind)) return;
  json["px"] = Json::array({event.px.x(), event.px.y()});
  if (event.button != Button::none) json["button"] = name_of(button_names(), event.button);
  Json keys = Json::array();
  if (event.shift) keys.push_back("shift");
  if (event.control) keys.push_back("control");
  if (event.alt) keys.push_back("alt");
  if (!keys.empty()) json["keys"] = keys;
  if (line.act.kind == HandAct::Kind::wheel) json["steps"] = line.act.steps;
  if (line.world) json["world"] = json_of(*line.world);
  if (event.taken) json["taken"] = json_of(*event.taken);
}

HandAct act_of(const Json& json) {
  HandAct act;
  act.kind = named(act_names(), json, "act");
  if (!has_place(act.kind)) return act;
  const std::vector<double> px = numbers(json, "px", 2, 2);
  act.event.px = {px[0], px[1]};
  if (json.contains("button")) act.event.button = named(button_names(), json, "button");
  if (json.contains("keys")) {
    if (!json["keys"].is_array()) throw InvalidInput("the field \"keys\" must be a list");
    for (const Json& key : json["keys"]) {
      if (key == "shift")
        act.event.shift = true;
      else if (key == "control")
        act.event.control = true;
      else if (key == "alt")
        act.event.alt = true;
      else
        throw InvalidInput("the field \"keys\" holds shift, control or alt");
    }
  }
  if (act.kind == HandAct::Kind::wheel) act.steps = number(json, "steps");
  if (json.contains("taken")) act.event.taken = point(json, "taken");
  return act;
}

Json parsed(std::string_view line) {
  Json json = Json::parse(line, nullptr, false);
  if (!json.is_object()) throw InvalidInput("this is no JSON object");
  return json;
}

HandLine line_of(const Json& json) {
  HandLine line;
  line.t_ms = number(json, "t_ms");
  if (!(line.t_ms >= 0.0)) throw InvalidInput("the field \"t_ms\" must not be negative");
  if (json.contains("command")) {
    const Json& command = json["command"];
    if (command != "undo" && command != "redo" && !command.is_object())
      throw InvalidInput("the field \"command\" is undo, redo, or an edit or annotation");
    line.command = command.is_string() ? command.get<std::string>() : command.dump();
  } else {
    line.view = text(json, "view");
    if (line.view.empty()) throw InvalidInput("the field \"view\" must name a view");
    line.act = act_of(json);
    if (json.contains("world")) line.world = point(json, "world");
  }
  if (json.contains("state")) line.state = state_of(json["state"]);
  if (json.contains("frame")) line.frame = frame_of(json["frame"]);
  return line;
}

std::string digest_of(const Json& json, const char* key) {
  std::string digest = text(json, key);
  if (digest.size() != 64 || digest.find_first_not_of("0123456789abcdef") != std::string::npos)
    throw InvalidInput(std::string("the field \"") + key + "\" must be a SHA-256 in lower case");
  return digest;
}

void take_line(HandRecording& all, std::string_view line, bool first) {
  const Json json = parsed(line);
  if (first) {
    if (text(json, "kind") != "ostia.hand") throw InvalidInput("this is no recording of a hand");
    if (whole(json, "v", 1, 1000000) != 1)
      throw InvalidInput("the recording is of a newer version; open it with a newer program");
    all.start_digest = digest_of(json, "start_digest");
  } else if (json.contains("end_digest")) {
    all.end_digest = digest_of(json, "end_digest");
    all.duration_ms = number(json, "t_ms");
  } else {
    if (!all.end_digest.empty()) throw InvalidInput("there is something behind the recording's end");
    all.lines.push_back(line_of(json));
    if (all.lines.back().t_ms < all.duration_ms) throw InvalidInput("time runs backwards here");
    all.duration_ms = all.lines.back().t_ms;
  }
}

}  // namespace

std::string to_json(const HandLine& line) {
  Json json{{"t_ms", line.t_ms}};
  if (line.command == "undo" || line.command == "redo")
    json["command"] = line.command;
  else if (!line.command.empty())
    json["command"] = Json::parse(line.command);
  else
    add_act(json, line);
  if (line.state) json["state"] = json_of(*line.state);
  if (line.frame) json["frame"] = json_of(*line.frame);
  return json.dump();
}

HandLine hand_line_of_json(std::string_view line) {
  return line_of(parsed(line));
}

HandRecording read_hand_recording(const std::filesystem::path& path) {
  const std::string content = core::read_file(path);
  const std::string name = path.filename().string();
  HandRecording all;
  std::size_t number = 0;
  for (std::size_t at = 0; at < content.size();) {
    const std::size_t end = content.find('\n', at);
    if (end == std::string::npos && number > 0) break;  // broken off while it was written
    const std::string_view line =
        std::string_view(content).substr(at, end == std::string::npos ? end : end - at);
    ++number;
    try {
      take_line(all, line, number == 1);
    } catch (const InvalidInput& error) {
      throw InvalidInput(name + ", line " + std::to_string(number) + ": " + error.what());
    } catch (const nlohmann::json::exception& error) {
      throw InvalidInput(name + ", line " + std::to_string(number) + ": " + error.what());
    }
    at = end == std::string::npos ? content.size() : end + 1;
  }
  if (number == 0) throw InvalidInput(name + " is empty: there is no recording in it");
  return all;
}

}  // namespace ostia::view
