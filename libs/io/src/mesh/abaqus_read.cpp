// Abaqus' input file, read: nodes, elements C3D4, C3D10 and C3D6, element sets, and surfaces of element
// sides.

#include "mesh/abaqus_end.h"
#include "mesh/builder.h"
#include "mesh/readers.h"
#include "mesh/tagged_sides.h"
#include "surface_formats.h"

#include "ostia/core/files.h"

#include <algorithm>
#include <map>
#include <unordered_map>

namespace ostia::io {
namespace fs = std::filesystem;
namespace {

std::string_view trimmed_word(std::string_view text) {
  const std::size_t from = text.find_first_not_of(" \t\r");
  if (from == std::string_view::npos) return {};
  return text.substr(from, text.find_last_not_of(" \t\r") - from + 1);
}

std::vector<std::string_view> parts_of(std::string_view line) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t comma = std::min(line.find(','), line.size());
    parts.push_back(trimmed_word(line.substr(0, comma)));
    if (comma == line.size()) break;
    line.remove_prefix(comma + 1);
  }
  if (parts.back().empty()) parts.pop_back();
  return parts;
}

/// "*SURFACE, TYPE=ELEMENT, NAME=wall".
struct Keyword {
  std::string name;
  std::map<std::string, std::string> parameters;  // names in capitals
};

Keyword keyword_of(std::string_view line) {
  Keyword keyword;
  for (const std::string_view part : parts_of(line)) {
    const std::size_t equals = part.find('=');
    if (keyword.name.empty())
      keyword.name = upper(part);
    else if (equals != std::string_view::npos)
      keyword.parameters[upper(trimmed_word(part.substr(0, equals)))] = trimmed_word(part.substr(equals + 1));
    else
      keyword.parameters[upper(part)] = "";
  }
  return keyword;
}

struct AbaqusKind {
  Shape shape;
  std::size_t nodes;
};
const std::map<std::string, AbaqusKind> abaqus_kinds = {{"C3D4", {Shape::tetrahedron, 4}},
                                                        {"C3D10", {Shape::tetrahedron, 10}},
                                                        {"C3D10M", {Shape::tetrahedron, 10}},
                                                        {"C3D6", {Shape::prism, 6}}};

/// Numbers of elements, as GENERATE has them; one alone from itself to itself.
struct Range {
  std::int64_t first = 0, last = 0, step = 1;
};

/// Element sets by their sides, "S1" from 0.
struct Surface {
  std::string name;
  std::vector<std::pair<std::string, std::int32_t>> sides;
};

class AbaqusFile {
 public:
  explicit AbaqusFile(const fs::path& path) : path_(path), text_(core::read_file(path)), mesh_(path) {}

  LayeredMesh read() {
    Words lines(text_);
    while (!lines.empty()) {
      const std::string_view line = trimmed_word(lines.line());
      if (line.starts_with("**")) {
        take_comment(line);
      } else if (line.starts_with("*")) {
        keyword_ = keyword_of(line);
        begin();
      } else if (!line.empty()) {
        take(parts_of(line));
      }
    }
    require_no_element_begun();
    if (end_announced_ && !ended_) refuse(path_, "it is cut short: its last line is missing; copy it again");
    LayeredMesh read = mesh_.finish({});
    name_faces(read.mesh);
    return read;
  }

 private:
  /// "** face 2 inlet_a": the ids that the format has no place for.
  void take_comment(std::string_view line) {
    const std::string_view text = trimmed_word(line.substr(2));
    end_announced_ = end_announced_ || text == abaqus_end_announced;
    ended_ = ended_ || text == abaqus_end;
    Words words(line.substr(2));
    if (words.next() != "face") return;
    const std::optional<std::int32_t> id = number<std::int32_t>(words.next());
    if (id) ids_[std::string(words.next())] = *id;
  }

  void require_no_element_begun() const {
    if (!left_.empty()) refuse(path_, "element " + std::to_string(left_[0]) + " has too few nodes");
  }

  void begin() {
    require_no_element_begun();
    if (keyword_.name == "*ELEMENT") {
      const std::string type = upper(keyword_.parameters["TYPE"]);
      const auto kind = abaqus_kinds.find(type);
      if (kind == abaqus_kinds.end())
        refuse(path_, "it has elements of type " + type + "; C3D4, C3D10 and C3D6 are read");
      kind_ = kind->second;
      mesh_.set_in_layers(upper(keyword_.parameters["ELSET"]).ends_with(upper(layers_suffix)));
    }
    if (keyword_.name == "*SURFACE") surfaces_.push_back({keyword_.parameters["NAME"], {}});
  }

  void take(const std::vector<std::string_view>& parts) {
    if (keyword_.name == "*NODE") take_node(parts);
    if (keyword_.name == "*ELEMENT") take_element(parts);
    if (keyword_.name == "*ELSET") take_set(parts);
    if (keyword_.name == "*SURFACE" && !parts.empty()) take_side(parts);
  }

  template <class T>
  T value(std::string_view text, const char* what) const {
    const std::optional<T> read = number<T>(text);
    if (!read) refuse(path_, std::string(what) + " \"" + std::string(text) + "\" is no number");
    return *read;
  }

  void take_node(const std::vector<std::string_view>& parts) {
    if (parts.size() != 4) refuse(path_, "a node has other than a number and three coordinates");
    points_[value<std::int64_t>(parts[0], "a node's number")] =
        static_cast<std::int32_t>(mesh_.points().size());
    mesh_.points().emplace_back(value<double>(parts[1], "a coordinate"),
                                value<double>(parts[2], "a coordinate"),
                                value<double>(parts[3], "a coordinate"));
  }

  /// An element may run over several lines.
  void take_element(const std::vector<std::string_view>& parts) {
    for (const std::string_view part : parts) left_.push_back(value<std::int64_t>(part, "an element's node"));
    if (left_.size() < kind_.nodes + 1) return;
    std::vector<std::int32_t> nodes;
    for (std::size_t i = 1; i < left_.size(); ++i) {
      const auto found = points_.find(left_[i]);
      if (found == points_.end())
        refuse(path_, "element " + std::to_string(left_[0]) + " names node " + std::to_string(left_[i]) +
                          ", which is not there");
      nodes.push_back(found->second);
    }
    if (!mesh_.add(kind_.shape, nodes, 0, NodeOrder()))
      refuse(path_,
             "element " + std::to_string(left_[0]) + " has " + std::to_string(nodes.size()) + " nodes");
    elements_[left_[0]] = counts_.next(kind_.shape == Shape::prism);
    left_.clear();
  }

  /// Names of other sets in a set are of no use to surfaces of sides here.
  void take_set(const std::vector<std::string_view>& parts) {
    const std::string& name = keyword_.parameters["ELSET"];
    std::vector<Range>& set = sets_[name];
    std::vector<std::int64_t> numbers;
    for (const std::string_view part : parts) {
      const auto one = number<std::int64_t>(part);
      if (one && (*one < INT32_MIN || *one > INT32_MAX))
        refuse(path_, "set " + name + " has the number " + std::string(part) + ", which is out of range");
      if (one) numbers.push_back(*one);
    }
    if (!keyword_.parameters.contains("GENERATE"))
      for (const std::int64_t one : numbers) set.push_back({one, one});
    else if (numbers.size() >= 2 && numbers[0] <= numbers[1])
      set.push_back({numbers[0], numbers[1], numbers.size() > 2 ? std::max<std::int64_t>(numbers[2], 1) : 1});
  }

  void take_side(const std::vector<std::string_view>& parts) {
    const std::string side = upper(parts.back());
    const std::optional<std::int32_t> number_of_side =
        side.starts_with("S") ? number<std::int32_t>(std::string_view(side).substr(1)) : std::nullopt;
    if (parts.size() != 2 || !number_of_side || *number_of_side < 1 || *number_of_side > 5)
      refuse(path_, "surface " + surfaces_.back().name + " is not of sides of elements (SET, S1 to S5)");
    surfaces_.back().sides.emplace_back(parts[0], *number_of_side - 1);
  }

  void name_faces(geometry::MixedMesh& mesh) {
    if (surfaces_.empty()) return;
    mesh.faces.clear();
    for (const Surface& surface : surfaces_) {
      const auto known = ids_.find(surface.name);
      mesh.faces.push_back(face_named(known != ids_.end() ? known->second : 0, surface.name));
    }
    make_ids_unique(mesh.faces);
    TaggedSides tagged;
    std::size_t left = text_.size();  // a file that names more sides than it has bytes names them again
    for (std::size_t f = 0; f < surfaces_.size(); ++f)
      for (const auto& [set, side] : surfaces_[f].sides)
        for (const Range& range : ranges_of(set))
          for (std::int64_t e = range.first; e <= range.last; e += range.step) {
            if (left-- == 0) refuse(path_, "its surfaces name the same sides many times");
            tagged.add(mesh, {element_at(e, set, mesh), side}, mesh.faces[f].id, path_);
          }
    tagged.apply(mesh);
  }

  /// Counted as ElementSide does.
  std::int32_t element_at(std::int64_t e, const std::string& set, const geometry::MixedMesh& mesh) const {
    const auto found = elements_.find(e);
    if (found == elements_.end())
      refuse(path_, "set " + set + " names element " + std::to_string(e) + ", which is not there");
    return index_of(found->second, mesh);
  }

  /// Of a set, or the one element that is named instead.
  std::vector<Range> ranges_of(const std::string& set) const {
    if (const auto found = sets_.find(set); found != sets_.end()) return found->second;
    if (const auto one = number<std::int32_t>(set)) return {{*one, *one}};
    refuse(path_, "there is no element set " + set);
  }

  fs::path path_;
  std::string text_;
  MeshBuilder mesh_;
  Keyword keyword_;
  AbaqusKind kind_{Shape::tetrahedron, 4};
  std::vector<std::int64_t> left_;
  ElementCounts counts_;
  std::unordered_map<std::int64_t, std::int32_t> points_;
  std::unordered_map<std::int64_t, CountedElement> elements_;
  std::map<std::string, std::vector<Range>> sets_;
  std::map<std::string, std::int32_t> ids_;
  std::vector<Surface> surfaces_;
  bool end_announced_ = false, ended_ = false;
};

}  // namespace

LayeredMesh read_abaqus(const fs::path& path) {
  return AbaqusFile(path).read();
}

}  // namespace ostia::io
