// Abaqus' input file: nodes, elements, and for each face a node set and a surface of element sides
// (Abaqus Analysis User's Guide, "Element Library": C3D4, C3D10, C3D6 and the numbers of their sides).

#include "mesh/abaqus_end.h"
#include "mesh/formats.h"
#include "mesh/text.h"

#include <algorithm>
#include <charconv>

namespace ostia::io {
namespace {

using Numbers = std::vector<std::int32_t>;

/// 13 digits: Abaqus reads at most 20 characters a number.
void put_coordinate(TextFile& out, double value) {
  std::array<char, 32> digits{};
  const auto end =
      std::to_chars(digits.data(), digits.data() + digits.size(), value, std::chars_format::scientific, 12)
          .ptr;
  out << std::string_view(digits.data(), static_cast<std::size_t>(end - digits.data()));
}

void put_lines(TextFile& out, const Numbers& numbers) {
  constexpr std::size_t a_line = 16;
  for (std::size_t i = 0; i < numbers.size(); ++i)
    out << numbers[i] << (i % a_line == a_line - 1 || i + 1 == numbers.size() ? "\n" : ", ");
}

std::string_view type_of(Shape shape, bool quadratic) {
  if (shape == Shape::prism) return "C3D6";
  return quadratic ? "C3D10" : "C3D4";
}

void put_elements(TextFile& out, const PreparedMesh& mesh) {
  std::int32_t number = 0;
  std::string sets;
  for (const ElementBlock& block : mesh.blocks()) {
    const std::size_t n = mesh.nodes(block.shape);
    const Numbers nodes = mesh.connectivity(block);  // Abaqus' orders are ours
    const std::string set = mesh.name(block);
    sets += (sets.empty() ? "" : ", ") + set;
    out << "*ELEMENT, TYPE=" << type_of(block.shape, mesh.mesh.quadratic()) << ", ELSET=" << set << '\n';
    for (std::size_t i = 0; i < nodes.size(); i += n) {
      out << ++number;
      for (std::size_t k = 0; k < n; ++k) out << ", " << nodes[i + k] + 1;
      out << '\n';
    }
  }
  out << "*ELSET, ELSET=" << mesh.title << '\n' << sets << '\n';
}

void put_node_set(TextFile& out, const PreparedMesh& mesh, std::size_t f) {
  Numbers nodes;
  for (const Shape shape : facet_shapes) {
    const Numbers more = mesh.connectivity(shape, mesh.facets[f].of(shape));
    nodes.insert(nodes.end(), more.begin(), more.end());
  }
  std::ranges::sort(nodes);
  nodes.erase(std::ranges::unique(nodes).begin(), nodes.end());
  for (std::int32_t& node : nodes) ++node;
  out << "*NSET, NSET=" << mesh.names[f] << '\n';
  put_lines(out, nodes);
}

void put_surface(TextFile& out, const PreparedMesh& mesh, std::size_t f) {
  std::array<Numbers, 5> elements;  // by the number of their side
  for (const Shape shape : facet_shapes) {
    for (const std::int32_t facet : mesh.facets[f].of(shape)) {
      const ElementSide& side = mesh.parent(shape, facet);
      elements[static_cast<std::size_t>(side.side)].push_back(side.element + 1);  // S1 ... are our order
    }
  }
  const auto set = [&](std::size_t side) { return "_" + mesh.names[f] + "_S" + std::to_string(side + 1); };
  for (std::size_t side = 0; side < elements.size(); ++side) {
    if (elements[side].empty()) continue;
    std::ranges::sort(elements[side]);
    out << "*ELSET, ELSET=" << set(side) << ", INTERNAL\n";
    put_lines(out, elements[side]);
  }
  out << "*SURFACE, TYPE=ELEMENT, NAME=" << mesh.names[f] << '\n';
  for (std::size_t side = 0; side < elements.size(); ++side) {
    if (!elements[side].empty()) out << set(side) << ", S" << side + 1 << '\n';
  }
}

}  // namespace

void write_abaqus(const PreparedMesh& mesh, const std::filesystem::path& file) {
  TextFile out(file);
  out << "*HEADING\n" << mesh.title << ", axes LPS, unit mm\n** " << abaqus_end_announced << '\n';
  for (std::size_t f = 0; f < mesh.names.size(); ++f)
    out << "** face " << mesh.mesh.faces[f].id << ' ' << mesh.names[f] << '\n';
  out << "*NODE\n";
  for (std::size_t i = 0; i < mesh.mesh.points.size(); ++i) {
    out << i + 1;
    for (const double value : mesh.mesh.points[i]) {
      out << ", ";
      put_coordinate(out, value);
    }
    out << '\n';
  }
  put_elements(out, mesh);
  for (std::size_t f = 0; f < mesh.names.size(); ++f) {
    put_node_set(out, mesh, f);
    put_surface(out, mesh, f);
  }
  out << "** " << abaqus_end << '\n';
  out.close();
}

}  // namespace ostia::io
