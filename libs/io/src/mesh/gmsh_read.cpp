// Gmsh's MSH 2.2 and 4.1, ASCII, read (Gmsh Reference Manual, "File formats").

#include "mesh/builder.h"
#include "mesh/readers.h"
#include "surface_formats.h"

#include "ostia/core/files.h"

#include <map>
#include <set>
#include <unordered_map>
#include <utility>

namespace ostia::io {
namespace fs = std::filesystem;
namespace {

struct GmshElement {
  Shape shape;
  std::size_t nodes;
};

/// Of Gmsh's number of a type; nothing for those that are no part of a mesh here.
std::optional<GmshElement> element_of(int type) {
  switch (type) {
    case 2:
      return GmshElement{Shape::triangle, 3};
    case 9:
      return GmshElement{Shape::triangle, 6};
    case 3:
      return GmshElement{Shape::quad, 4};
    case 10:
      return GmshElement{Shape::quad, 9};
    case 4:
      return GmshElement{Shape::tetrahedron, 4};
    case 11:
      return GmshElement{Shape::tetrahedron, 10};
    case 6:
      return GmshElement{Shape::prism, 6};
    case 13:
      return GmshElement{Shape::prism, 18};
    default:
      return std::nullopt;
  }
}

/// Points, lines and curves of second order lie on the mesh without being part of it.
bool is_below_facets(int type) {
  return type == 15 || type == 1 || type == 8;
}

class GmshFile {
 public:
  explicit GmshFile(const fs::path& path)
      : path_(path), text_(core::read_file(path)), words_(text_), mesh_(path) {}

  LayeredMesh read() {
    while (!words_.empty()) {
      const std::string section(words_.next());
      if (section == "$MeshFormat") read_format();
      if (section == "$PhysicalNames") read_names();
      if (section == "$Entities") read_entities();
      if (section == "$Nodes") read_nodes();
      if (section == "$Elements") read_elements(), open_ = true;
      if (section == "$EndElements") open_ = false;
    }
    if (version_ == 0.0) refuse(path_, "it is no Gmsh mesh (no $MeshFormat)");
    if (open_) refuse(path_, "it is cut short: $EndElements is missing; copy it again");
    std::vector<geometry::Face> faces;
    const std::vector<std::int32_t> ids = mesh_.face_ids();
    for (const std::int32_t id : std::set<std::int32_t>(ids.begin(), ids.end())) {
      const auto found = names_.find(id);
      faces.push_back(found != names_.end() ? face_named(id, found->second) : face_without_name(id));
    }
    return mesh_.finish(std::move(faces));
  }

 private:
  template <class T>
  T next(const char* what) {
    const std::string_view word = words_.next();
    const std::optional<T> value = number<T>(word);
    if (!value) refuse(path_, std::string(what) + " \"" + std::string(word) + "\" is no number");
    return *value;
  }
  /// How many follow; each takes two characters or more.
  std::size_t count(const char* what) {
    const auto n = next<std::int64_t>(what);
    if (n < 0 || static_cast<std::size_t>(n) > text_.size() / 2)
      refuse(path_, std::string(what) + " " + std::to_string(n) + " is more than its bytes can hold");
    return static_cast<std::size_t>(n);
  }

  void read_format() {
    version_ = next<double>("the format's version");
    if (next<int>("the format's kind") != 0)
      refuse(path_, "it is a binary Gmsh mesh; write it as ASCII (gmsh -format msh41 -save)");
    if (version_ != 2.2 && version_ != 4.1)
      refuse(path_, "it is of Gmsh's format " + std::to_string(version_) + "; 2.2 and 4.1 are read");
  }

  void read_names() {
    const std::size_t n = count("the number of names");
    words_.line();
    for (std::size_t i = 0; i < n; ++i) {
      const std::string line(words_.line());
      Words in_line(line);
      const auto dimension = number<int>(in_line.next());
      const auto id = number<std::int32_t>(in_line.next());
      const std::size_t first = line.find('"'), last = line.rfind('"');
      if (!dimension || !id || first == std::string::npos || last <= first)
        refuse(path_, "\"" + line + "\" is no physical name");
      const std::string name = line.substr(first + 1, last - first - 1);
      if (*dimension == 2) names_[*id] = name;
      if (*dimension == 3 && name.ends_with(layers_suffix)) layers_.insert(*id);
    }
  }

  /// Which physical group each surface and volume belongs to.
  void read_entities() {
    std::array<std::size_t, 4> counts{};
    for (std::size_t& one : counts) one = count("the number of entities");
    for (std::size_t dimension = 0; dimension < 4; ++dimension) {
      for (std::size_t i = 0; i < counts[dimension]; ++i) {
        const auto tag = next<std::int32_t>("an entity's number");
        for (int k = 0; k < (dimension == 0 ? 3 : 6); ++k) next<double>("an entity's place");
        const std::size_t groups = count("the number of groups");
        for (std::size_t k = 0; k < groups; ++k) {
          const auto group = next<std::int32_t>("a group");
          if (k == 0) group_of_[{static_cast<int>(dimension), tag}] = group;
        }
        if (dimension == 0) continue;
        const std::size_t borders = count("the number of borders");
        for (std::size_t k = 0; k < borders; ++k) next<std::int32_t>("a border");
      }
    }
  }

  void add_point(std::int64_t tag) {
    point_of_[tag] = static_cast<std::int32_t>(mesh_.points().size());
    geometry::Vec3 p;
    for (int k = 0; k < 3; ++k) p[k] = next<double>("a coordinate");
    mesh_.points().push_back(p);
  }

  void read_nodes() {
    if (version_ < 4.0) {
      const std::size_t n = count("the number of nodes");
      for (std::size_t i = 0; i < n; ++i) add_point(next<std::int64_t>("a node's number"));
      return;
    }
    const std::size_t blocks = count("the number of blocks");
    for (int i = 0; i < 3; ++i) next<std::int64_t>("the nodes' range");
    for (std::size_t b = 0; b < blocks; ++b) {
      next<int>("a dimension");
      next<int>("an entity");
      const bool parametric = next<int>("a block's kind") != 0;
      if (parametric) refuse(path_, "its nodes have parameters; save it without (Mesh.SaveParametric=0)");
      std::vector<std::int64_t> tags(count("the number of nodes"));
      for (std::int64_t& tag : tags) tag = next<std::int64_t>("a node's number");
      for (const std::int64_t tag : tags) add_point(tag);
    }
  }

  /// The element's nodes stand next.
  void add_element(int type, std::int32_t group) {
    const std::optional<GmshElement> element = element_of(type);
    if (!element) {
      if (!is_below_facets(type))
        refuse(path_,
               "it has elements of Gmsh's type " + std::to_string(type) +
                   "; tetrahedra, prisms, triangles and quadrilaterals are read, linear or with 10, 18, "
                   "6 and 9 nodes");
      words_.line();
      return;
    }
    std::array<std::int32_t, 18> nodes{};
    for (std::size_t i = 0; i < element->nodes; ++i) {
      const auto tag = next<std::int64_t>("a node's number");
      const auto found = point_of_.find(tag);
      if (found == point_of_.end())
        refuse(path_, "an element names node " + std::to_string(tag) + ", which is not there");
      nodes[i] = found->second;
    }
    mesh_.set_in_layers(layers_.contains(group));
    mesh_.add(element->shape, std::span(nodes).first(element->nodes), group, gmsh_order);
  }

  void read_elements() {
    if (version_ < 4.0) {
      const std::size_t n = count("the number of elements");
      for (std::size_t i = 0; i < n; ++i) {
        next<std::int64_t>("an element's number");
        const int type = next<int>("an element's type");
        const std::size_t tags = count("the number of tags");
        std::int32_t group = 1;
        for (std::size_t k = 0; k < tags; ++k) {
          const auto tag = next<std::int32_t>("a tag");
          if (k == 0) group = tag;
        }
        add_element(type, group);
      }
      return;
    }
    const std::size_t blocks = count("the number of blocks");
    for (int i = 0; i < 3; ++i) next<std::int64_t>("the elements' range");
    for (std::size_t b = 0; b < blocks; ++b) {
      const int dimension = next<int>("a dimension");
      const auto entity = next<std::int32_t>("an entity");
      const int type = next<int>("an element's type");
      const std::size_t n = count("the number of elements");
      const auto group = group_of_.find({dimension, entity});
      for (std::size_t i = 0; i < n; ++i) {
        next<std::int64_t>("an element's number");
        add_element(type, group != group_of_.end() ? group->second : entity);
      }
    }
  }

  const fs::path& path_;
  std::string text_;
  Words words_;
  MeshBuilder mesh_;
  double version_ = 0.0;
  bool open_ = false;  ///< elements have begun, and their end has not come
  std::map<std::int32_t, std::string> names_;
  std::set<std::int32_t> layers_;                                  ///< groups of tetrahedra of layers
  std::map<std::pair<int, std::int32_t>, std::int32_t> group_of_;  ///< by dimension and number
  std::unordered_map<std::int64_t, std::int32_t> point_of_;
};

}  // namespace

LayeredMesh read_gmsh(const fs::path& path) {
  return GmshFile(path).read();
}

}  // namespace ostia::io
