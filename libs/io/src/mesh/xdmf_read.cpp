// XDMF 3 with HDF5 as it is written here, read: mesh.xdmf with the elements, facets.xdmf beside it with the
// boundary.

#include "mesh/builder.h"
#include "mesh/hdf5.h"
#include "mesh/readers.h"
#include "surface_formats.h"

#include "ostia/core/files.h"

#include <hdf5.h>

#include <algorithm>
#include <set>

namespace ostia::io {
namespace fs = std::filesystem;
namespace {

/// An element of the XML text: its attributes, and what stands between it and its end.
class Tag {
 public:
  Tag(std::string_view attributes, std::string_view content) : attributes_(attributes), content_(content) {}
  std::string attribute(const std::string& name) const {
    const std::size_t at = attributes_.find(" " + name + "=\"");
    if (at == std::string_view::npos) return {};
    const std::size_t from = at + name.size() + 3;
    return std::string(attributes_.substr(from, attributes_.find('"', from) - from));
  }
  std::string_view content() const { return content_; }

 private:
  std::string_view attributes_, content_;
};

/// All of a name, in their order; those within others of the same name are not looked for.
std::vector<Tag> tags_in(std::string_view text, const std::string& name) {
  std::vector<Tag> tags;
  std::size_t at = 0;
  while ((at = text.find("<" + name + " ", at)) != std::string_view::npos) {
    const std::size_t head = text.find('>', at), end = text.find("</" + name + ">", at);
    if (head == std::string_view::npos || end == std::string_view::npos || end < head) break;
    tags.emplace_back(text.substr(at + name.size() + 1, head - at - name.size() - 1),
                      text.substr(head + 1, end - head - 1));
    at = end;
  }
  return tags;
}

/// A data set of HDF5.
class Values {
 public:
  /// `where`: "mesh.h5:/mesh/topology", beside `xdmf`.
  Values(const fs::path& xdmf, std::string_view where) {
    const std::size_t colon = where.find(':');
    Words words(where.substr(0, colon));
    const fs::path name = std::string(words.next());
    if (colon == std::string_view::npos || name.empty() || name.has_parent_path())
      refuse(xdmf, "its numbers are not in an HDF5 file beside it");
    path_ = xdmf.parent_path() / name;
    Words set(where.substr(colon + 1));
    file_ = H5Fopen(path_.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    if (file_ >= 0) set_ = H5Dopen2(file_, std::string(set.next()).c_str(), H5P_DEFAULT);
    if (set_ < 0) {
      close();
      refuse(path_, "it has no " + std::string(where.substr(colon + 1)));
    }
  }
  ~Values() { close(); }
  Values(const Values&) = delete;
  Values& operator=(const Values&) = delete;

  std::vector<std::int32_t> integers() const { return read<std::int32_t>(H5T_NATIVE_INT32); }
  std::vector<double> numbers() const { return read<double>(H5T_NATIVE_DOUBLE); }

 private:
  template <class T>
  std::vector<T> read(hid_t type) const {
    const hid_t space = H5Dget_space(set_);
    const hssize_t count = H5Sget_simple_extent_npoints(space);
    H5Sclose(space);
    const hid_t stored = H5Dget_type(set_);
    const std::size_t size = std::max<std::size_t>(H5Tget_size(stored), 1);
    H5Tclose(stored);
    constexpr std::uintmax_t most_compressed = 1100;  // deflate's bound
    if (count < 0 || static_cast<std::uintmax_t>(count) > most_compressed * H5Dget_storage_size(set_) / size)
      refuse(path_, "a data set is larger than its bytes can hold");
    std::vector<T> values(static_cast<std::size_t>(count));
    if (H5Dread(set_, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
      refuse(path_, "a data set cannot be read");
    return values;
  }
  void close() {
    if (set_ >= 0) H5Dclose(set_);
    if (file_ >= 0) H5Fclose(file_);
  }
  QuietHdf5 quiet_;
  fs::path path_;
  hid_t file_ = -1, set_ = -1;
};

struct XdmfKind {
  std::string_view name;
  std::int32_t number;  ///< in a list of mixed cells
  Shape shape;
  std::size_t nodes;
};
constexpr std::array<XdmfKind, 8> xdmf_kinds = {{{"Tetrahedron", 6, Shape::tetrahedron, 4},
                                                 {"Tetrahedron_10", 38, Shape::tetrahedron, 10},
                                                 {"Wedge", 8, Shape::prism, 6},
                                                 {"Wedge_18", 41, Shape::prism, 18},
                                                 {"Triangle", 4, Shape::triangle, 3},
                                                 {"Triangle_6", 36, Shape::triangle, 6},
                                                 {"Quadrilateral", 5, Shape::quad, 4},
                                                 {"Quadrilateral_9", 35, Shape::quad, 9}}};

/// One XDMF file: a uniform grid.
class XdmfGrid {
 public:
  explicit XdmfGrid(const fs::path& path) : path_(path), text_(core::read_file(path)) {
    if (text_.find("<Xdmf") == std::string::npos) refuse(path_, "it is no XDMF file");
    if (tags_in(text_, "Topology").size() != 1) refuse(path_, "it has other than one grid; one is read");
  }

  std::vector<geometry::Vec3> points() const {
    const std::vector<Tag> geometry = tags_in(text_, "Geometry");
    const std::string type = geometry.empty() ? "" : geometry.front().attribute("GeometryType");
    if (!type.empty() && type != "XYZ") refuse(path_, "its points are of type " + type + "; XYZ is read");
    const std::vector<double> values = Values(path_, item("Geometry")).numbers();
    if (values.size() % 3 != 0) refuse(path_, "its coordinates are no triples");
    std::vector<geometry::Vec3> points;
    for (std::size_t i = 0; i + 2 < values.size(); i += 3)
      points.emplace_back(values[i], values[i + 1], values[i + 2]);
    return points;
  }

  /// `ids`: the face of each cell, or none.
  void add_cells(MeshBuilder& mesh, const std::vector<std::int32_t>& ids) const {
    const Tag topology = tags_in(text_, "Topology").front();
    const std::string type = topology.attribute("TopologyType");
    const std::vector<std::int32_t> list = Values(path_, item("Topology")).integers();
    const std::vector<std::int32_t> layer = of_cells(layer_array);
    std::size_t cell = 0;
    for (std::size_t i = 0; i < list.size(); ++cell) {
      const auto kind = type == "Mixed" ? std::ranges::find(xdmf_kinds, list[i++], &XdmfKind::number)
                                        : std::ranges::find(xdmf_kinds, type, &XdmfKind::name);
      if (kind == xdmf_kinds.end() || i + kind->nodes > list.size())
        refuse(path_, "cells of type " + (type == "Mixed" ? std::to_string(list[i - 1]) : type) +
                          " are not read; tetrahedra, wedges, triangles and quadrilaterals are");
      mesh.set_in_layers(cell < layer.size() && layer[cell] == 1);
      mesh.add(kind->shape, std::span(list).subspan(i, kind->nodes), cell < ids.size() ? ids[cell] : 1,
               vtk_order);
      i += kind->nodes;
    }
    require_one_a_cell(ids, "CellEntityIds", cell);
    require_one_a_cell(layer, std::string("numbers of ") + layer_array, cell);
  }

  /// Of the cells; none where there is no such attribute, or only one of the points.
  std::vector<std::int32_t> of_cells(const std::string& name) const {
    for (const Tag& attribute : tags_in(text_, "Attribute"))
      if (attribute.attribute("Name") == name && attribute.attribute("Center") == "Cell")
        return Values(path_, item_in(attribute)).integers();
    return {};
  }

  std::vector<geometry::Face> faces() const {
    std::vector<geometry::Face> faces;
    for (const Tag& name : tags_in(text_, "map")) {
      const std::optional<std::int32_t> id = number<std::int32_t>(name.content());
      if (!id || name.attribute("dim") != "2") continue;
      if (std::ranges::find(faces, *id, &geometry::Face::id) != faces.end())
        refuse(path_, "it names the face " + std::to_string(*id) + " twice");
      faces.push_back(face_named(*id, name.attribute("key")));
    }
    return faces;
  }

 private:
  void require_one_a_cell(const std::vector<std::int32_t>& values, const std::string& what,
                          std::size_t cells) const {
    if (!values.empty() && values.size() != cells)
      refuse(path_, "it has " + std::to_string(values.size()) + " " + what + " for " + std::to_string(cells) +
                        " cells; one a cell is needed");
  }
  std::string_view item_in(const Tag& tag) const {
    const std::vector<Tag> items = tags_in(tag.content(), "DataItem");
    if (items.size() != 1 || items[0].attribute("Format") != "HDF")
      refuse(path_, "its numbers are not in an HDF5 file beside it");
    return items[0].content();
  }
  std::string_view item(const std::string& name) const {
    const std::vector<Tag> tags = tags_in(text_, name);
    if (tags.empty()) refuse(path_, "it has no " + name);
    return item_in(tags.front());
  }
  fs::path path_;
  std::string text_;
};

/// A grid's cells; returns the faces of its facets. Without ids they are all wall.
std::vector<geometry::Face> add(const XdmfGrid& grid, MeshBuilder& mesh) {
  const std::vector<std::int32_t> tags = grid.of_cells("CellEntityIds");
  grid.add_cells(mesh, tags);
  std::vector<geometry::Face> faces;
  if (!tags.empty()) faces = grid.faces();
  const std::vector<std::int32_t> ids = mesh.face_ids();
  for (const std::int32_t id : std::set<std::int32_t>(ids.begin(), ids.end()))
    if (std::ranges::find(faces, id, &geometry::Face::id) == faces.end())
      faces.push_back(face_without_name(id));
  return faces;
}

}  // namespace

LayeredMesh read_xdmf(const fs::path& path) {
  std::error_code error;
  const fs::path file = fs::is_directory(path, error) ? path / "mesh.xdmf" : path;
  MeshBuilder mesh(path);
  const XdmfGrid elements(file);
  mesh.points() = elements.points();
  std::vector<geometry::Face> faces = add(elements, mesh);
  const fs::path beside = file.parent_path() / "facets.xdmf";
  if (!mesh.has_boundary() && fs::exists(beside, error)) faces = add(XdmfGrid(beside), mesh);
  return mesh.finish(std::move(faces));
}

}  // namespace ostia::io
