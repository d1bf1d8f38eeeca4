// Grown trees as GXL: <node> with an attribute `position`, <edge from to> with `radius`. Read tag by tag, for
// such a file has half a kilobyte for each segment.

#include "graph/formats.h"
#include "surface_formats.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <unordered_map>

namespace ostia::io {
namespace fs = std::filesystem;

using geometry::Vec3;

namespace {

constexpr double no_radius = std::numeric_limits<double>::quiet_NaN();

std::string_view trimmed_text(std::string_view text) {
  const std::size_t from = text.find_first_not_of(" \t\r\n");
  if (from == std::string_view::npos) return {};
  return text.substr(from, text.find_last_not_of(" \t\r\n") + 1 - from);
}

/// The value of an attribute of a tag, without blanks; empty when it has none of that name.
std::string_view attribute(std::string_view tag, std::string_view name) {
  for (std::size_t at = tag.find(name); at != std::string_view::npos; at = tag.find(name, at + 1)) {
    if (at == 0 || (tag[at - 1] != ' ' && tag[at - 1] != '\t' && tag[at - 1] != '\n')) continue;
    const std::string_view rest = trimmed_text(tag.substr(at + name.size()));
    if (rest.empty() || rest.front() != '=') continue;
    const std::string_view quoted = trimmed_text(rest.substr(1));
    if (quoted.empty() || (quoted.front() != '"' && quoted.front() != '\'')) continue;
    const std::size_t end = quoted.find(quoted.front(), 1);
    if (end != std::string_view::npos) return trimmed_text(quoted.substr(1, end - 1));
  }
  return {};
}

class GxlReader {
 public:
  GxlReader(const fs::path& path, const core::TaskContext& task) : path_(path), reader_(path, task) {
    loaded_.reference_name = "line";
  }

  LoadedGraph read() {
    std::string_view text, tag;
    while (!ended_) {
      if (!reader_.take('<', text) || !reader_.stopped()) refuse_end();
      if (numbers_wanted_ && in_number_) take_number(trimmed_text(text));
      if (!reader_.take('>', tag) || !reader_.stopped()) refuse_end();
      if (tag.starts_with("!--"))
        skip_comment(tag);
      else
        take_tag(tag);
    }
    drop_undefined();
    name_edges_of_one_line();
    return std::move(loaded_);
  }

 private:
  enum class Inside { graph, node, edge };

  /// Points that edges name and no node is: no points, and -1 for the edges.
  void drop_undefined() {
    std::vector<std::int32_t> number(defined_.size(), -1);
    std::int32_t kept = 0;
    for (std::size_t i = 0; i < defined_.size(); ++i) {
      if (!defined_[i]) continue;
      loaded_.graph.points[static_cast<std::size_t>(kept)] = loaded_.graph.points[i];
      number[i] = kept++;
    }
    loaded_.graph.points.resize(static_cast<std::size_t>(kept));
    for (geometry::GraphEdge& edge : loaded_.graph.edges)
      for (std::int32_t* point : {&edge.from, &edge.to}) *point = number[static_cast<std::size_t>(*point)];
  }

  /// Lines tell nothing apart in a file that has only one.
  void name_edges_of_one_line() {
    std::vector<std::int64_t>& references = loaded_.graph.references;
    if (references.size() < 2 || references.front() != references.back()) return;
    loaded_.reference_name = "edge";
    std::iota(references.begin(), references.end(), 1);
  }

  std::string so_far() const {
    return std::to_string(nodes_) + " nodes and " + std::to_string(loaded_.graph.edges.size()) +
           " edges were read";
  }
  [[noreturn]] void refuse_end() const {
    if (!seen_gxl_) refuse(path_, "it is no GXL file (no <gxl>)");
    const char* where = inside_ == Inside::node   ? " within a node"
                        : inside_ == Inside::edge ? " within an edge"
                                                  : "";
    reader_.refuse_line("the file ends" + std::string(where) + " before </gxl>: it is cut short", so_far());
  }
  void skip_comment(std::string_view tag) {
    while (!tag.ends_with("--")) {
      if (!reader_.take('>', tag) || !reader_.stopped()) refuse_end();
    }
  }

  /// A tree of a million segments has forty million tags: most are told by their first letters.
  void take_tag(std::string_view tag) {
    std::size_t end = std::min<std::size_t>(1, tag.size());
    while (end < tag.size() && tag[end] > ' ' && tag[end] != '/') ++end;
    const std::string_view name = tag.substr(0, end);
    in_number_ = name == "float" || name == "int" || name == "double";
    if (in_number_ || name.empty()) return;
    if (name.front() == '/')
      end_tag(name);
    else if (name.front() == '!')
      check_declaration(tag);
    else if (name == "gxl")
      seen_gxl_ = true;
    else if (name == "node")
      begin_node(tag);
    else if (name == "edge")
      begin_edge(tag);
    else if (name == "attr")
      begin_attribute(attribute(tag, "name"));
  }

  void end_tag(std::string_view name) {
    if (name == "/attr")
      end_attribute();
    else if (name == "/node" || name == "/edge")
      inside_ = Inside::graph;
    else if (name == "/gxl")
      ended_ = true;
  }

  void check_declaration(std::string_view tag) const {
    if (tag.starts_with("!ENTITY") ||
        (tag.starts_with("!DOCTYPE") && tag.find('[') != std::string_view::npos))
      reader_.refuse_line("it declares XML entities, which no tree needs", "");
  }

  std::int32_t index_of(std::string_view id) {
    const auto [at, added] =
        indices_.try_emplace(std::string(id), static_cast<std::int32_t>(loaded_.graph.points.size()));
    if (added) {
      loaded_.graph.points.emplace_back(no_radius, no_radius, no_radius);
      defined_.push_back(false);
    }
    return at->second;
  }

  void begin_node(std::string_view tag) {
    const std::string_view id = attribute(tag, "id");
    if (id.empty()) reader_.refuse_line("its node has no id", so_far());
    current_ = index_of(id);
    if (defined_[static_cast<std::size_t>(current_)])
      reader_.refuse_line("the node " + std::string(id.substr(0, 40)) + " is there a second time", so_far());
    defined_[static_cast<std::size_t>(current_)] = true;
    ++nodes_;
    if (!tag.ends_with("/")) inside_ = Inside::node;
  }

  void begin_edge(std::string_view tag) {
    const std::string_view from = attribute(tag, "from"), to = attribute(tag, "to");
    if (from.empty() || to.empty()) reader_.refuse_line("its edge lacks from or to", so_far());
    const std::int32_t a = index_of(from);
    loaded_.graph.edges.push_back({a, index_of(to), no_radius, no_radius});
    loaded_.graph.references.push_back(static_cast<std::int64_t>(reader_.line_number()));
    if (!tag.ends_with("/")) inside_ = Inside::edge;
  }

  void begin_attribute(std::string_view name) {
    numbers_wanted_ =
        (inside_ == Inside::node && name == "position") || (inside_ == Inside::edge && name == "radius");
    numbers_ = 0;
  }

  void take_number(std::string_view text) {
    const std::optional<double> value = number_or_nan(text);
    if (!value) reader_.refuse_line("\"" + std::string(text.substr(0, 40)) + "\" is no number", so_far());
    if (inside_ == Inside::node && numbers_ < 3)
      loaded_.graph.points[static_cast<std::size_t>(current_)][numbers_] = *value;
    if (inside_ == Inside::edge) {
      loaded_.graph.edges.back().radius_from = *value;
      loaded_.graph.edges.back().radius_to = *value;
    }
    ++numbers_;
  }

  void end_attribute() {
    // A tree grown in the plane has two coordinates.
    if (numbers_wanted_ && inside_ == Inside::node && numbers_ == 2)
      loaded_.graph.points[static_cast<std::size_t>(current_)].z() = 0.0;
    numbers_wanted_ = false;
  }

  fs::path path_;
  PieceReader reader_;
  LoadedGraph loaded_;
  std::unordered_map<std::string, std::int32_t> indices_;
  std::vector<bool> defined_;  // points that have a node, and no edge alone
  Inside inside_ = Inside::graph;
  std::int32_t current_ = -1;
  int numbers_ = 0;
  std::size_t nodes_ = 0;
  bool seen_gxl_ = false, ended_ = false, numbers_wanted_ = false, in_number_ = false;
};

}  // namespace

LoadedGraph read_graph_gxl(const fs::path& path, const core::TaskContext& task) {
  return GxlReader(path, task).read();
}

}  // namespace ostia::io
