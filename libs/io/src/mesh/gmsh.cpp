// Gmsh's MSH 2.2 and 4.1, ASCII, with physical names (Gmsh Reference Manual, "File formats").

#include "mesh/formats.h"
#include "mesh/text.h"

namespace ostia::io {
namespace fs = std::filesystem;
namespace {

int gmsh_type(Shape shape, bool quadratic) {
  constexpr std::array<std::array<int, 2>, 4> types = {{{4, 11}, {6, 13}, {2, 9}, {3, 10}}};
  return types[static_cast<std::size_t>(shape)][quadratic ? 1 : 0];
}

/// Elements of one shape that belong to one entity.
struct GmshBlock {
  int dimension, entity, type;
  std::size_t nodes;
  std::vector<std::int32_t> connectivity;
};

/// Of the volume that the tetrahedra of layers fill.
int layers_id(const PreparedMesh& mesh) {
  return volume_id(mesh) + 1;
}

std::size_t volumes_in(const PreparedMesh& mesh) {
  return mesh.layer_tetrahedra > 0 ? 2 : 1;
}

/// Faces first, then the volume, then that of layers.
std::vector<GmshBlock> gmsh_blocks(const PreparedMesh& mesh) {
  std::vector<GmshBlock> blocks;
  const auto add = [&](int dimension, int entity, Shape shape, std::vector<std::int32_t> connectivity) {
    if (connectivity.empty()) return;
    blocks.push_back({dimension, entity, gmsh_type(shape, mesh.mesh.quadratic()), mesh.nodes(shape),
                      std::move(connectivity)});
  };
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    for (const Shape shape : facet_shapes)
      add(2, mesh.mesh.faces[f].id, shape, mesh.connectivity(shape, mesh.facets[f].of(shape)));
  }
  for (const ElementBlock& block : mesh.blocks())
    add(3, block.of_layers ? layers_id(mesh) : volume_id(mesh), block.shape,
        mesh.connectivity(block, gmsh_order));
  return blocks;
}

std::size_t elements_in(const std::vector<GmshBlock>& blocks) {
  std::size_t elements = 0;
  for (const GmshBlock& block : blocks) elements += block.connectivity.size() / block.nodes;
  return elements;
}

void put_nodes_of_element(TextFile& out, const GmshBlock& block, std::size_t first) {
  for (std::size_t i = 0; i < block.nodes; ++i) out << ' ' << block.connectivity[first + i] + 1;
  out << '\n';
}

void put_names(TextFile& out, const PreparedMesh& mesh) {
  out << "$PhysicalNames\n" << mesh.names.size() + volumes_in(mesh) << '\n';
  for (std::size_t f = 0; f < mesh.names.size(); ++f)
    out << "2 " << mesh.mesh.faces[f].id << " \"" << mesh.names[f] << "\"\n";
  out << "3 " << volume_id(mesh) << " \"" << mesh.title << "\"\n";
  if (mesh.layer_tetrahedra > 0)
    out << "3 " << layers_id(mesh) << " \"" << mesh.title << layers_suffix << "\"\n";
  out << "$EndPhysicalNames\n";
}

void put_point(TextFile& out, const geometry::Vec3& p) {
  out << p[0] << ' ' << p[1] << ' ' << p[2];
}

geometry::Box3 box_of(const PreparedMesh& mesh, const std::vector<GmshBlock>& blocks, int dimension,
                      int entity) {
  geometry::Box3 box;
  for (const GmshBlock& block : blocks) {
    if (block.dimension != dimension || block.entity != entity) continue;
    for (const std::int32_t p : block.connectivity) box.extend(mesh.mesh.points[static_cast<std::size_t>(p)]);
  }
  return box;
}

void put_entities(TextFile& out, const PreparedMesh& mesh, const std::vector<GmshBlock>& blocks) {
  out << "$Entities\n0 0 " << mesh.names.size() << ' ' << volumes_in(mesh) << '\n';
  const auto put = [&](int dimension, int entity) {
    const geometry::Box3 box = box_of(mesh, blocks, dimension, entity);
    out << entity << ' ';
    put_point(out, box.min());
    out << ' ';
    put_point(out, box.max());
    out << " 1 " << entity;
  };
  for (const geometry::Face& face : mesh.mesh.faces) {
    put(2, face.id);
    out << " 0\n";
  }
  put(3, volume_id(mesh));
  out << ' ' << mesh.names.size();
  for (const geometry::Face& face : mesh.mesh.faces) out << ' ' << face.id;
  out << '\n';
  if (mesh.layer_tetrahedra > 0) {
    put(3, layers_id(mesh));
    out << " 0\n";
  }
  out << "$EndEntities\n";
}

}  // namespace

void write_gmsh2(const PreparedMesh& mesh, const fs::path& file) {
  const std::vector<GmshBlock> blocks = gmsh_blocks(mesh);
  TextFile out(file);
  out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
  put_names(out, mesh);
  out << "$Nodes\n" << mesh.mesh.points.size() << '\n';
  for (std::size_t i = 0; i < mesh.mesh.points.size(); ++i) {
    out << i + 1 << ' ';
    put_point(out, mesh.mesh.points[i]);
    out << '\n';
  }
  out << "$EndNodes\n$Elements\n" << elements_in(blocks) << '\n';
  std::size_t number = 0;
  for (const GmshBlock& block : blocks) {
    for (std::size_t i = 0; i < block.connectivity.size(); i += block.nodes) {
      out << ++number << ' ' << block.type << " 2 " << block.entity << ' ' << block.entity;
      put_nodes_of_element(out, block, i);
    }
  }
  out << "$EndElements\n";
  out.close();
}

void write_gmsh4(const PreparedMesh& mesh, const fs::path& file) {
  const std::vector<GmshBlock> blocks = gmsh_blocks(mesh);
  const std::size_t nodes = mesh.mesh.points.size();
  TextFile out(file);
  out << "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
  put_names(out, mesh);
  put_entities(out, mesh, blocks);
  out << "$Nodes\n1 " << nodes << " 1 " << nodes << "\n3 " << volume_id(mesh) << " 0 " << nodes << '\n';
  for (std::size_t i = 1; i <= nodes; ++i) out << i << '\n';
  for (const geometry::Vec3& p : mesh.mesh.points) {
    put_point(out, p);
    out << '\n';
  }
  const std::size_t elements = elements_in(blocks);
  out << "$EndNodes\n$Elements\n" << blocks.size() << ' ' << elements << " 1 " << elements << '\n';
  std::size_t number = 0;
  for (const GmshBlock& block : blocks) {
    out << block.dimension << ' ' << block.entity << ' ' << block.type << ' '
        << block.connectivity.size() / block.nodes << '\n';
    for (std::size_t i = 0; i < block.connectivity.size(); i += block.nodes) {
      out << ++number;
      put_nodes_of_element(out, block, i);
    }
  }
  out << "$EndElements\n";
  out.close();
}

}  // namespace ostia::io
