#include "ostia/session/edit_json.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

namespace ostia::session {
namespace {

using Json = nlohmann::ordered_json;
using geometry::Vec3;
using lumen::Edit;
using lumen::ReformationMode;

constexpr std::size_t most_points = 100000;

enum class Need { required, optional };

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
template <class E, class V>
requires std::is_same_v<std::remove_const_t<E>, lumen::BranchAdd>
void fields(E& e, V& v) {
  v("parent", e.parent);
  v("name", e.name);
  v("points", e.points);
  v("radius_mm", e.radius_mm);
}
template <class E, class V>
requires std::is_same_v<std::remove_const_t<E>, lumen::BranchDelete>
void fields(E& e, V& v) {
  v("vessel", e.vessel);
}
template <class E, class V>
requires std::is_same_v<std::remove_const_t<E>, lumen::BranchAttach>
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

class Writer {
 public:
  Writer(Json& out, std::string op) : out_(&out), op_(std::move(op)) {}
  template <class Value>
  void operator()(const char* name, const Value& value, Need = Need::required) {
    name_ = name;
    (*out_)[name] = json(value);
  }

 private:
  Json json(std::int32_t value) const { return value; }
  Json json(bool value) const { return value; }
  Json json(double value) const {
    if (!std::isfinite(value))
      throw InvalidInput("the edit " + op_ + " cannot be written: \"" + name_ + "\" is not a finite number");
    return value;
  }
  Json json(const std::string& value) const { return value; }
  Json json(const Vec3& v) const { return Json::array({json(v.x()), json(v.y()), json(v.z())}); }
  Json json(ReformationMode mode) const {
    return mode == ReformationMode::straightened ? "straightened" : "stretched";
  }
  template <class Value>
  Json json(const std::vector<Value>& values) const {
    Json list = Json::array();
    for (const Value& value : values) list.push_back(json(value));
    return list;
  }
  Json* out_;
  std::string op_, name_;
};

class Reader {
 public:
  Reader(const Json& in, std::string op) : in_(&in), op_(std::move(op)) {}
  template <class Value>
  void operator()(const char* name, Value& value, Need need = Need::required) {
    known_.insert(name);
    const auto found = in_->find(name);
    if (found == in_->end()) {
      if (need == Need::required) fail(std::string("it has no \"") + name + "\"");
      return;
    }
    read(*found, name, value);
  }
  void require_no_others() const {
    for (const auto& [key, value] : in_->items()) {
      if (key == "v" || key == "op" || known_.contains(key)) continue;
      std::string choices;
      for (const std::string& name : known_) choices += (choices.empty() ? "" : ", ") + name;
      fail("it has an unknown field \"" + key + "\"; it may have " + choices);
    }
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw InvalidInput("the edit " + op_ + ": " + what);
  }
  [[noreturn]] void fail(const std::string& name, const Json& value, const std::string& wanted) const {
    fail("\"" + name + "\" is " + std::string(value.type_name()) + "; it must be " + wanted);
  }
  void read(const Json& in, const std::string& name, std::int32_t& out) const {
    if (!in.is_number_integer()) fail(name, in, "a whole number");
    const bool fits = in.is_number_unsigned()
                          ? in.get<std::uint64_t>() <= std::numeric_limits<std::int32_t>::max()
                          : in.get<std::int64_t>() >= 0;
    if (!fits) fail("\"" + name + "\" is " + in.dump() + "; ids are 0 to 2147483647");
    out = in.get<std::int32_t>();
  }
  void read(const Json& in, const std::string& name, double& out) const {
    if (!in.is_number()) fail(name, in, "a number");
    out = in.get<double>();
    if (!std::isfinite(out)) fail("\"" + name + "\" is not a finite number");
  }
  void read(const Json& in, const std::string& name, bool& out) const {
    if (!in.is_boolean()) fail(name, in, "true or false");
    out = in.get<bool>();
  }
  void read(const Json& in, const std::string& name, std::string& out) const {
    if (!in.is_string()) fail(name, in, "a text");
    out = in.get<std::string>();
  }
  void read(const Json& in, const std::string& name, ReformationMode& out) const {
    const std::string mode = in.is_string() ? in.get<std::string>() : "";
    if (mode != "straightened" && mode != "stretched")
      fail("\"" + name + "\" must be \"straightened\" or \"stretched\"");
    out = mode == "straightened" ? ReformationMode::straightened : ReformationMode::stretched;
  }
  void read(const Json& in, const std::string& name, Vec3& out) const {
    if (!in.is_array() || in.size() != 3) fail("\"" + name + "\" must be a point [x, y, z] in mm");
    for (std::size_t k = 0; k < 3; ++k)
      read(in[k], name + "[" + std::to_string(k) + "]", out[static_cast<Eigen::Index>(k)]);
  }
  template <class Value>
  void read(const Json& in, const std::string& name, std::vector<Value>& out) const {
    if (!in.is_array()) fail(name, in, "a list");
    if (in.size() > most_points)
      fail("\"" + name + "\" has " + std::to_string(in.size()) + " entries; the limit is " +
           std::to_string(most_points));
    out.clear();
    for (std::size_t i = 0; i < in.size(); ++i) {
      out.emplace_back();
      if constexpr (std::is_same_v<Value, Vec3>) out.back().setZero();
      read(in[i], name + "[" + std::to_string(i) + "]", out.back());
    }
  }
  const Json* in_;
  std::string op_;
  std::set<std::string> known_;
};

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

/// The line as an object; refuses keys that are there twice.
Json object_of(std::string_view line) {
  std::set<std::string> seen;
  std::string repeated;
  const auto watch = [&](int depth, Json::parse_event_t event, Json& parsed) {
    if (event == Json::parse_event_t::key && depth == 1 && !seen.insert(parsed.get<std::string>()).second)
      repeated = parsed.get<std::string>();
    return true;
  };
  Json object;
  try {
    object = Json::parse(line.begin(), line.end(), watch);
  } catch (const Json::exception& e) {
    throw InvalidInput(std::string("an edit is not JSON (") + e.what() + "); write one object a line");
  }
  if (!object.is_object()) throw InvalidInput("an edit must be a JSON object {\"v\":1,\"op\":...}");
  if (!repeated.empty()) throw InvalidInput("an edit has \"" + repeated + "\" twice");
  return object;
}

}  // namespace

std::string to_json(const Edit& edit) {
  const std::string op = lumen::op_name(edit);
  Json out{{"v", 1}, {"op", op}};
  Writer writer(out, op);
  std::visit([&](const auto& kind) { fields(kind, writer); }, edit);
  try {
    return out.dump();
  } catch (const Json::exception&) {
    throw InvalidInput("the edit " + op + " cannot be written: its name is not UTF-8");
  }
}

Edit edit_of_json(std::string_view line) {
  const Json in = object_of(line);
  const auto version = in.find("v");
  if (version == in.end() || !version->is_number_integer() || *version != 1)
    throw InvalidInput("an edit has \"v\" " + (version == in.end() ? "missing" : version->dump()) +
                       "; this program reads version 1");
  const auto op = in.find("op");
  if (op == in.end() || !op->is_string()) throw InvalidInput("an edit has no text \"op\"");
  Edit edit = edit_named(op->get<std::string>());
  Reader reader(in, op->get<std::string>());
  std::visit([&](auto& kind) { fields(kind, reader); }, edit);
  reader.require_no_others();
  return edit;
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
