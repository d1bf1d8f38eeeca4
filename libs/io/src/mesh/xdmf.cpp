// XDMF 3 with HDF5, as FEniCS reads it: mesh.xdmf has the elements, facets.xdmf the boundary, both with the
// tags `CellEntityIds` and the points of mesh.h5.

#include "mesh/formats.h"
#include "mesh/hdf5.h"
#include "mesh/text.h"

namespace ostia::io {
namespace fs = std::filesystem;
namespace {

struct Topology {
  std::string_view name;
  int number;  ///< in a list of mixed cells
};

Topology topology_of(Shape shape, bool quadratic) {
  constexpr std::array<std::array<Topology, 2>, 4> topologies = {
      {{{{"Tetrahedron", 6}, {"Tetrahedron_10", 38}}},
       {{{"Wedge", 8}, {"Wedge_18", 41}}},
       {{{"Triangle", 4}, {"Triangle_6", 36}}},
       {{{"Quadrilateral", 5}, {"Quadrilateral_9", 35}}}}};
  return topologies[static_cast<std::size_t>(shape)][quadratic ? 1 : 0];
}

void put_item(TextFile& out, const char* type, const std::string& dimensions, int precision,
              const char* set) {
  out << "<DataItem NumberType=\"" << type << "\" Precision=\"" << precision << "\" Dimensions=\""
      << dimensions << "\" Format=\"HDF\">mesh.h5:" << set << "</DataItem>\n";
}

/// Cells of one grid: one shape, or several as XDMF's mixed list.
class Grid {
 public:
  Grid(const PreparedMesh& mesh, Hdf5File& data, std::string name)
      : mesh_(mesh), data_(data), name_(std::move(name)) {}

  template <std::size_t N>
  void put_topology(TextFile& out, const std::array<Shape, N>& shapes) {
    std::vector<Shape> present;
    std::size_t cells = 0;
    for (const Shape shape : shapes) {
      if (mesh_.count(shape) > 0) present.push_back(shape);
      cells += mesh_.count(shape);
    }
    const std::string set = "/" + name_ + "/topology";
    if (present.size() == 1) {
      const std::size_t n = mesh_.nodes(present[0]);
      data_.write(set, mesh_.connectivity(present[0], vtk_order), n);
      out << "<Topology TopologyType=\"" << topology_of(present[0], mesh_.mesh.quadratic()).name
          << "\" NumberOfElements=\"" << cells << "\" NodesPerElement=\"" << n << "\">\n";
      put_item(out, "Int", std::to_string(cells) + " " + std::to_string(n), 4, set.c_str());
    } else {
      const std::vector<std::int32_t> list = mixed_list(present);
      data_.write(set, list, 1);
      out << "<Topology TopologyType=\"Mixed\" NumberOfElements=\"" << cells << "\">\n";
      put_item(out, "Int", std::to_string(list.size()), 4, set.c_str());
    }
    out << "</Topology>\n";
  }

  /// One number a cell.
  void put_attribute(TextFile& out, const std::string& name, const std::vector<std::int32_t>& values) {
    const std::string set = "/" + name_ + "/" + name;
    data_.write(set, values, 1);
    out << "<Attribute Name=\"" << name << "\" AttributeType=\"Scalar\" Center=\"Cell\">\n";
    put_item(out, "Int", std::to_string(values.size()), 4, set.c_str());
    out << "</Attribute>\n";
  }

 private:
  std::vector<std::int32_t> mixed_list(const std::vector<Shape>& shapes) const {
    std::vector<std::int32_t> list;
    for (const Shape shape : shapes) {
      const std::vector<std::int32_t> nodes = mesh_.connectivity(shape, vtk_order);
      const std::size_t n = mesh_.nodes(shape);
      for (std::size_t i = 0; i < nodes.size(); i += n) {
        list.push_back(topology_of(shape, mesh_.mesh.quadratic()).number);
        list.insert(list.end(), nodes.begin() + static_cast<std::ptrdiff_t>(i),
                    nodes.begin() + static_cast<std::ptrdiff_t>(i + n));
      }
    }
    return list;
  }

  const PreparedMesh& mesh_;
  Hdf5File& data_;
  std::string name_;
};

/// Names and ids, in the way meshio keeps its field data.
void put_names(TextFile& out, const PreparedMesh& mesh, bool facets) {
  out << "<Information Name=\"names\"><![CDATA[<main>";
  if (facets) {
    for (std::size_t f = 0; f < mesh.names.size(); ++f)
      out << "<map key=\"" << mesh.names[f] << "\" dim=\"2\">" << mesh.mesh.faces[f].id << "</map>";
  } else {
    out << "<map key=\"" << mesh.title << "\" dim=\"3\">0</map>";
  }
  out << "</main>]]></Information>\n";
}

/// 1 for the tetrahedra of layers, 0 for the others and for prisms.
std::vector<std::int32_t> layer_of_elements(const PreparedMesh& mesh) {
  std::vector<std::int32_t> layer(mesh.elements(), 0);
  const auto end = layer.begin() + static_cast<std::ptrdiff_t>(mesh.mesh.tetrahedra.size());
  std::fill(end - static_cast<std::ptrdiff_t>(mesh.layer_tetrahedra), end, 1);
  return layer;
}

template <std::size_t N>
void write_grid(const PreparedMesh& mesh, Hdf5File& data, const fs::path& file, const char* name,
                const std::array<Shape, N>& shapes, const std::vector<std::int32_t>& tags) {
  TextFile out(file);
  Grid grid(mesh, data, name);
  out << "<?xml version=\"1.0\"?>\n<!-- axes LPS, unit mm -->\n<Xdmf Version=\"3.0\">\n<Domain>\n<Grid "
         "Name=\""
      << name << "\" GridType=\"Uniform\">\n";
  put_names(out, mesh, N > 0 && shapes[0] == Shape::triangle);
  out << "<Geometry GeometryType=\"XYZ\">\n";
  put_item(out, "Float", std::to_string(mesh.mesh.points.size()) + " 3", 8, "/geometry");
  out << "</Geometry>\n";
  grid.put_topology(out, shapes);
  grid.put_attribute(out, "CellEntityIds", tags);
  if (mesh.layer_tetrahedra > 0 && N > 0 && shapes[0] == Shape::tetrahedron)
    grid.put_attribute(out, layer_array, layer_of_elements(mesh));
  out << "</Grid>\n</Domain>\n</Xdmf>\n";
  out.close();
}

}  // namespace

void write_xdmf(const PreparedMesh& mesh, const fs::path& folder) {
  Hdf5File data(folder / "mesh.h5");
  data.write("/geometry", mesh.mesh.points);
  data.make_group("/mesh");
  data.make_group("/facets");
  write_grid(mesh, data, folder / "mesh.xdmf", "mesh", volume_shapes,
             std::vector<std::int32_t>(mesh.elements(), 0));
  std::vector<std::int32_t> tags = mesh.mesh.triangle_face_ids;
  tags.insert(tags.end(), mesh.mesh.quad_face_ids.begin(), mesh.mesh.quad_face_ids.end());
  write_grid(mesh, data, folder / "facets.xdmf", "facets", facet_shapes, tags);
  data.close();
}

}  // namespace ostia::io
