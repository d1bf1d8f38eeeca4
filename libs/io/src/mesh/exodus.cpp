// Exodus II (Sandia, "EXODUS II: A Finite Element Data Model", appendix A: its place in netCDF): one block
// for each kind of element, a side set and a node set for each face.

#include "mesh/formats.h"
#include "mesh/text.h"

#include "ostia/core/error.h"

#include <netcdf.h>

#include <algorithm>
#include <cerrno>

namespace ostia::io {
namespace fs = std::filesystem;
namespace {

using Numbers = std::vector<std::int32_t>;
constexpr std::size_t name_length = 33;  // with its closing 0

/// A netCDF file: define everything, then fill it.
class NetCdf {
 public:
  explicit NetCdf(fs::path path) : path_(std::move(path)) {
    require(nc_create(path_.c_str(), NC_CLOBBER | NC_64BIT_OFFSET, &file_));
    open_ = true;
  }
  ~NetCdf() {
    if (open_) nc_close(file_);
  }
  NetCdf(const NetCdf&) = delete;
  NetCdf& operator=(const NetCdf&) = delete;

  int dimension(const std::string& name, std::size_t length) {
    int id = 0;
    require(nc_def_dim(file_, name.c_str(), length, &id));
    return id;
  }
  int variable(const std::string& name, nc_type type, const std::vector<int>& dimensions) {
    int id = 0;
    require(
        nc_def_var(file_, name.c_str(), type, static_cast<int>(dimensions.size()), dimensions.data(), &id));
    return id;
  }
  void text(int variable, const char* name, const std::string& value) {
    require(nc_put_att_text(file_, variable, name, value.size(), value.c_str()));
  }
  void number(const char* name, int value) {
    require(nc_put_att_int(file_, NC_GLOBAL, name, NC_INT, 1, &value));
  }
  void number(const char* name, float value) {
    require(nc_put_att_float(file_, NC_GLOBAL, name, NC_FLOAT, 1, &value));
  }
  void end_definitions() { require(nc_enddef(file_)); }
  void put(int variable, const Numbers& values) { require(nc_put_var_int(file_, variable, values.data())); }
  void put(int variable, const std::vector<double>& values) {
    require(nc_put_var_double(file_, variable, values.data()));
  }
  void put(int variable, const std::vector<std::string>& names) {
    std::string block;
    for (const std::string& name : names) {
      block += name;
      block.resize(block.size() + name_length - name.size(), '\0');
    }
    require(nc_put_var_text(file_, variable, block.data()));
  }
  void close() {
    open_ = false;
    require(nc_close(file_));
  }

 private:
  void require(int status) const {
    if (status == NC_NOERR) return;
    if (status > 0) throw_cannot_write(path_, status);  // the system's own
    throw IoError("cannot write " + path_.string() + ": " + nc_strerror(status));
  }
  fs::path path_;
  int file_ = -1;
  bool open_ = false;
};

struct ExodusBlock {
  std::string name, type;
  Numbers nodes;
  std::size_t per_element;
};

/// Entities of one kind, numbered from 1: element blocks (eb), side sets (ss), node sets (ns).
struct ExodusKind {
  int names, status, ids;
};

struct Set {
  Numbers elements, sides, nodes;
  int element_variable, side_variable, node_variable;
};

Numbers plus_one(Numbers numbers) {
  for (std::int32_t& number : numbers) ++number;
  return numbers;
}

std::vector<ExodusBlock> exodus_blocks(const PreparedMesh& mesh) {
  const std::vector<ElementBlock> parts = mesh.blocks();
  const bool second = mesh.mesh.quadratic();
  std::vector<ExodusBlock> blocks;
  for (const ElementBlock& part : parts) {
    const bool prism = part.shape == Shape::prism;
    const std::string type = prism ? (second ? "WEDGE18" : "WEDGE") : (second ? "TETRA10" : "TETRA");
    const std::string name = parts.size() > 1 || part.of_layers ? mesh.name(part) : mesh.title;
    blocks.push_back(
        {name, type, plus_one(mesh.connectivity(part, uprights_second_order)), mesh.nodes(part.shape)});
  }
  return blocks;
}

/// Exodus counts a tetrahedron's sides 124 234 143 132, a prism's 1254 2365 1463 132 456.
Set set_of(const PreparedMesh& mesh, std::size_t f) {
  constexpr std::array<std::int32_t, 4> of_tetrahedron = {4, 1, 2, 3};
  constexpr std::array<std::int32_t, 5> of_prism = {4, 5, 1, 2, 3};
  const auto tetrahedra = static_cast<std::int32_t>(mesh.mesh.tetrahedra.size());
  Set set{};
  for (const Shape shape : facet_shapes) {
    const std::vector<std::int32_t>& facets = mesh.facets[f].of(shape);
    for (const std::int32_t facet : facets) {
      const ElementSide& side = mesh.parent(shape, facet);
      const auto s = static_cast<std::size_t>(side.side);
      set.elements.push_back(side.element + 1);
      set.sides.push_back(side.element < tetrahedra ? of_tetrahedron[s] : of_prism[s]);
    }
    const Numbers nodes = plus_one(mesh.connectivity(shape, facets));
    set.nodes.insert(set.nodes.end(), nodes.begin(), nodes.end());
  }
  std::ranges::sort(set.nodes);
  set.nodes.erase(std::ranges::unique(set.nodes).begin(), set.nodes.end());
  return set;
}

ExodusKind define_kind(NetCdf& file, const std::string& prefix, int count, int name_dimension) {
  const ExodusKind kind{file.variable(prefix + "_names", NC_CHAR, {count, name_dimension}),
                        file.variable(prefix + "_status", NC_INT, {count}),
                        file.variable(prefix + "_prop1", NC_INT, {count})};
  file.text(kind.ids, "name", "ID");
  return kind;
}

void put_kind(NetCdf& file, const ExodusKind& kind, const std::vector<std::string>& names,
              const Numbers& ids) {
  file.put(kind.names, names);
  file.put(kind.status, Numbers(ids.size(), 1));
  file.put(kind.ids, ids);
}

std::vector<double> coordinates(const PreparedMesh& mesh, int axis) {
  std::vector<double> values;
  values.reserve(mesh.mesh.points.size());
  for (const geometry::Vec3& p : mesh.mesh.points) values.push_back(p[axis]);
  return values;
}

void put_globals(NetCdf& file, const PreparedMesh& mesh) {
  file.number("api_version", 5.1f);
  file.number("version", 5.1f);
  file.number("floating_point_word_size", 8);
  file.number("file_size", 1);
  file.number("maximum_name_length", 32);
  file.text(NC_GLOBAL, "title", mesh.title + ", axes LPS, unit mm");
}

std::vector<int> define_blocks(NetCdf& file, const std::vector<ExodusBlock>& blocks) {
  std::vector<int> variables;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const std::string n = std::to_string(b + 1);
    const int elements = file.dimension("num_el_in_blk" + n, blocks[b].nodes.size() / blocks[b].per_element);
    const int nodes = file.dimension("num_nod_per_el" + n, blocks[b].per_element);
    variables.push_back(file.variable("connect" + n, NC_INT, {elements, nodes}));
    file.text(variables.back(), "elem_type", blocks[b].type);
  }
  return variables;
}

void define_sets(NetCdf& file, std::vector<Set>& sets) {
  for (std::size_t f = 0; f < sets.size(); ++f) {
    const std::string n = std::to_string(f + 1);
    const int sides = file.dimension("num_side_ss" + n, sets[f].sides.size());
    const int nodes = file.dimension("num_nod_ns" + n, sets[f].nodes.size());
    sets[f].element_variable = file.variable("elem_ss" + n, NC_INT, {sides});
    sets[f].side_variable = file.variable("side_ss" + n, NC_INT, {sides});
    sets[f].node_variable = file.variable("node_ns" + n, NC_INT, {nodes});
  }
}

}  // namespace

void write_exodus(const PreparedMesh& mesh, const fs::path& path) {
  const std::vector<ExodusBlock> blocks = exodus_blocks(mesh);
  std::vector<Set> sets;
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) sets.push_back(set_of(mesh, f));
  NetCdf file(path);
  put_globals(file, mesh);
  file.dimension("len_string", name_length);
  file.dimension("len_line", 81);
  file.dimension("four", 4);
  const int name = file.dimension("len_name", name_length), axes = file.dimension("num_dim", 3);
  const int time = file.dimension("time_step", NC_UNLIMITED);
  file.variable("time_whole", NC_DOUBLE, {time});
  const int points = file.dimension("num_nodes", mesh.mesh.points.size());
  file.dimension("num_elem", mesh.elements());
  const ExodusKind block_kind = define_kind(file, "eb", file.dimension("num_el_blk", blocks.size()), name);
  const ExodusKind side_kind = define_kind(file, "ss", file.dimension("num_side_sets", sets.size()), name);
  const ExodusKind node_kind = define_kind(file, "ns", file.dimension("num_node_sets", sets.size()), name);
  const int axis_names = file.variable("coor_names", NC_CHAR, {axes, name});
  std::array<int, 3> coordinate{};
  for (std::size_t a = 0; a < 3; ++a)
    coordinate[a] = file.variable(std::string("coord") + "xyz" [a], NC_DOUBLE, { points });
  const std::vector<int> connect = define_blocks(file, blocks);
  define_sets(file, sets);
  file.end_definitions();

  file.put(axis_names, std::vector<std::string>{"x", "y", "z"});
  for (int a = 0; a < 3; ++a) file.put(coordinate[static_cast<std::size_t>(a)], coordinates(mesh, a));
  std::vector<std::string> block_names;
  Numbers block_ids, face_ids;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    file.put(connect[b], blocks[b].nodes);
    block_names.push_back(blocks[b].name);
    block_ids.push_back(static_cast<std::int32_t>(b) + 1);
  }
  put_kind(file, block_kind, block_names, block_ids);
  for (std::size_t f = 0; f < sets.size(); ++f) {
    file.put(sets[f].element_variable, sets[f].elements);
    file.put(sets[f].side_variable, sets[f].sides);
    file.put(sets[f].node_variable, sets[f].nodes);
    face_ids.push_back(mesh.mesh.faces[f].id);
  }
  put_kind(file, side_kind, mesh.names, face_ids);
  put_kind(file, node_kind, mesh.names, face_ids);
  file.close();
}

}  // namespace ostia::io
