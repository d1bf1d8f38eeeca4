// Exodus II, read: blocks of tetrahedra and wedges, and the side sets that name the boundary.

#include "mesh/builder.h"
#include "mesh/classic_netcdf.h"
#include "mesh/readers.h"
#include "mesh/tagged_sides.h"
#include "surface_formats.h"

#include <netcdf.h>

#include <algorithm>
#include <array>

namespace ostia::io {
namespace fs = std::filesystem;
namespace {

class NetCdfInput {
 public:
  explicit NetCdfInput(const fs::path& path) : path_(path) {
    require_whole_netcdf(path);
    require(nc_open(path.c_str(), NC_NOWRITE, &file_));
  }
  ~NetCdfInput() { nc_close(file_); }
  NetCdfInput(const NetCdfInput&) = delete;
  NetCdfInput& operator=(const NetCdfInput&) = delete;

  /// 0 where there is none.
  std::size_t dimension(const std::string& name) const {
    int id = 0;
    std::size_t length = 0;
    if (nc_inq_dimid(file_, name.c_str(), &id) != NC_NOERR) return 0;
    require(nc_inq_dimlen(file_, id, &length));
    return length;
  }
  bool has(const std::string& name) const {
    int id = 0;
    return nc_inq_varid(file_, name.c_str(), &id) == NC_NOERR;
  }
  std::vector<std::int32_t> integers(const std::string& name) const {
    const int id = variable(name);
    std::vector<std::int32_t> values(size(id, name));
    require(nc_get_var_int(file_, id, values.data()));
    return values;
  }
  std::vector<double> numbers(const std::string& name) const {
    const int id = variable(name);
    std::vector<double> values(size(id, name));
    require(nc_get_var_double(file_, id, values.data()));
    return values;
  }
  /// Rows of characters, each up to its first 0; none where there is no such variable.
  std::vector<std::string> names(const std::string& name, std::size_t rows) const {
    if (rows == 0 || !has(name)) return {};
    const int id = variable(name);
    std::string text(size(id, name), '\0');
    require(nc_get_var_text(file_, id, text.data()));
    std::vector<std::string> names;
    const std::size_t width = text.size() / rows;
    for (std::size_t r = 0; r < rows; ++r) {
      std::string one = text.substr(r * width, width);
      one.resize(std::min(one.find('\0'), one.size()));
      while (!one.empty() && one.back() == ' ') one.pop_back();
      names.push_back(one);
    }
    return names;
  }
  std::string text(const std::string& name, const char* attribute) const {
    const int id = variable(name);
    std::size_t length = 0;
    if (nc_inq_attlen(file_, id, attribute, &length) != NC_NOERR) return {};
    std::string value(length, '\0');
    require(nc_get_att_text(file_, id, attribute, value.data()));
    return value.c_str();
  }

 private:
  int variable(const std::string& name) const {
    int id = 0;
    if (nc_inq_varid(file_, name.c_str(), &id) != NC_NOERR) refuse(path_, "it has no " + name);
    return id;
  }
  /// Of its values; no more than the file's bytes can hold.
  std::size_t size(int id, const std::string& name) const {
    int count = 0;
    require(nc_inq_varndims(file_, id, &count));
    std::vector<int> dimensions(static_cast<std::size_t>(count));
    require(nc_inq_vardimid(file_, id, dimensions.data()));
    std::size_t values = 1;
    const std::uintmax_t bytes = fs::file_size(path_);
    constexpr std::uintmax_t most_compressed = 1100;  // deflate's bound
    for (const int one : dimensions) {
      std::size_t length = 0;
      require(nc_inq_dimlen(file_, one, &length));
      if (length > bytes || (length > 0 && values > most_compressed * bytes / length))
        refuse(path_, name + " is too large");
      values *= length;
    }
    return values;
  }
  void require(int status) const {
    if (status != NC_NOERR) refuse(path_, nc_strerror(status));
  }
  fs::path path_;
  int file_ = -1;
};

/// Elements are numbered through the blocks from 1.
using Numbering = std::vector<CountedElement>;

void read_block(const NetCdfInput& file, std::size_t b, const fs::path& path, MeshBuilder& mesh,
                Numbering& numbering, ElementCounts& counts) {
  const std::string name = "connect" + std::to_string(b + 1);
  const std::string type = upper(file.text(name, "elem_type"));
  const bool prism = type.starts_with("WEDGE"), tetrahedron = type.starts_with("TET");
  if (!prism && !tetrahedron)
    refuse(path, "block " + std::to_string(b + 1) + " has elements of type " + type +
                     "; tetrahedra and wedges are read");
  const std::size_t n = file.dimension("num_nod_per_el" + std::to_string(b + 1));
  std::vector<std::int32_t> nodes = file.integers(name);
  if (!nodes.empty() && (n == 0 || nodes.size() % n != 0))
    refuse(path, "block " + std::to_string(b + 1) + " ends within an element");
  for (std::int32_t& node : nodes) node = std::max(node, 0) - 1;
  for (std::size_t i = 0; i < nodes.size(); i += n) {
    if (!mesh.add(prism ? Shape::prism : Shape::tetrahedron, std::span(nodes).subspan(i, n), 0,
                  uprights_second_order))
      refuse(path, "elements of type " + type + " with " + std::to_string(n) +
                       " nodes are not read; 4 or 10, 6 or 18 are");
    numbering.push_back(counts.next(prism));
  }
}

/// Exodus counts a tetrahedron's sides 124 234 143 132, a prism's 1254 2365 1463 132 456.
std::int32_t our_side(bool prism, std::int32_t side) {
  constexpr std::array<std::int32_t, 4> of_tetrahedron = {1, 2, 3, 0};
  constexpr std::array<std::int32_t, 5> of_prism = {2, 3, 4, 0, 1};
  if (side < 1 || side > (prism ? 5 : 4)) return -1;
  const auto s = static_cast<std::size_t>(side - 1);
  return prism ? of_prism[s] : of_tetrahedron[s];
}

void read_side_sets(const NetCdfInput& file, const Numbering& numbering, const fs::path& path,
                    geometry::MixedMesh& mesh) {
  const std::size_t sets = file.dimension("num_side_sets");
  if (sets == 0) return;
  const std::vector<std::int32_t> ids = file.integers("ss_prop1");
  if (ids.size() != sets) refuse(path, "its side sets and their ids differ in number");
  const std::vector<std::string> names = file.names("ss_names", sets);
  mesh.faces.clear();
  for (std::size_t f = 0; f < sets; ++f)
    mesh.faces.push_back(face_named(ids[f], f < names.size() ? names[f] : ""));
  make_ids_unique(mesh.faces);
  for (geometry::Face& face : mesh.faces)
    if (face.name.empty()) face = face_without_name(face.id);
  TaggedSides tagged;
  for (std::size_t f = 0; f < sets; ++f) {
    const std::string n = std::to_string(f + 1);
    if (!file.has("elem_ss" + n)) continue;
    const std::vector<std::int32_t> elements = file.integers("elem_ss" + n),
                                    sides = file.integers("side_ss" + n);
    for (std::size_t i = 0; i < std::min(elements.size(), sides.size()); ++i) {
      const auto e = static_cast<std::size_t>(elements[i]) - 1;
      if (elements[i] < 1 || e >= numbering.size())
        refuse(path,
               "side set " + n + " names element " + std::to_string(elements[i]) + ", which is not there");
      tagged.add(mesh, {index_of(numbering[e], mesh), our_side(numbering[e].prism, sides[i])},
                 mesh.faces[f].id, path);
    }
  }
  tagged.apply(mesh);
}

}  // namespace

LayeredMesh read_exodus(const fs::path& path) {
  const NetCdfInput file(path);
  MeshBuilder mesh(path);
  const std::vector<double> x = file.numbers("coordx"), y = file.numbers("coordy"),
                            z = file.numbers("coordz");
  if (y.size() != x.size() || z.size() != x.size()) refuse(path, "its coordinates are of different length");
  for (std::size_t i = 0; i < x.size(); ++i) mesh.points().emplace_back(x[i], y[i], z[i]);
  Numbering numbering;
  ElementCounts counts;
  const std::size_t blocks = file.dimension("num_el_blk");
  const std::vector<std::string> names = file.names("eb_names", blocks);
  for (std::size_t b = 0; b < blocks; ++b) {
    mesh.set_in_layers(b < names.size() && names[b].ends_with(layers_suffix));
    read_block(file, b, path, mesh, numbering, counts);
  }
  LayeredMesh made = mesh.finish({});
  read_side_sets(file, numbering, path, made.mesh);
  return made;
}

}  // namespace ostia::io
