#include "mesh_export_meshes.h"

#include "ostia/geometry/mixed_mesh_split.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <numbers>
#include <stdexcept>

namespace ostia::io {
namespace {

using geometry::FaceKind;
using geometry::MixedMesh;
using geometry::Vec3;

constexpr std::int32_t slices = 4, corners = 6;
constexpr std::int32_t wall = 1, inlet = 4, outlet = 7, core = 21;

/// Points of one slice: the axis, the core's corners, the ring's.
std::int32_t on_axis(std::int32_t slice) {
  return slice * (1 + 2 * corners);
}
std::int32_t on_core(std::int32_t slice, std::int32_t corner) {
  return on_axis(slice) + 1 + corner % corners;
}
std::int32_t on_ring(std::int32_t core_point) {
  return core_point + corners;
}

std::vector<Vec3> slice_points() {
  std::vector<Vec3> points;
  for (std::int32_t s = 0; s <= slices; ++s) {
    const double z = column_length * s / slices;
    points.emplace_back(0.0, 0.0, z);
    for (const double radius : {core_radius, column_radius}) {
      for (std::int32_t c = 0; c < corners; ++c) {
        const double angle = std::numbers::pi / 3.0 * c;
        points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
      }
    }
  }
  return points;
}

/// Sectors of the core as prisms, their boundary with the ids of wall and caps, then split.
MixedMesh core_of_tetrahedra() {
  MixedMesh mesh;
  mesh.points = slice_points();
  const auto boundary = [&](const geometry::Triangle& t, std::int32_t id) {
    mesh.triangles.push_back(t);
    mesh.triangle_face_ids.push_back(id);
  };
  for (std::int32_t c = 0; c < corners; ++c) {
    for (std::int32_t s = 0; s < slices; ++s) {
      mesh.prisms.push_back({on_axis(s), on_core(s, c), on_core(s, c + 1), on_axis(s + 1), on_core(s + 1, c),
                             on_core(s + 1, c + 1)});
      mesh.quads.push_back({on_core(s, c), on_core(s, c + 1), on_core(s + 1, c + 1), on_core(s + 1, c)});
      mesh.quad_face_ids.push_back(wall);
    }
    boundary({on_axis(0), on_core(0, c + 1), on_core(0, c)}, inlet);
    boundary({on_axis(slices), on_core(slices, c), on_core(slices, c + 1)}, outlet);
  }
  mesh.faces = {{wall, "wall", FaceKind::wall},
                {inlet, "inlet_rca", FaceKind::inlet},
                {outlet, "outlet_rca", FaceKind::outlet}};
  return geometry::split_prisms(mesh);
}

/// Only the points that are used, corners in their order.
MixedMesh compacted(MixedMesh mesh) {
  std::vector<std::int32_t> place(mesh.points.size(), -1);
  const auto mark = [&](auto& elements) {
    for (auto& element : elements) {
      for (const std::int32_t p : element) place[static_cast<std::size_t>(p)] = 0;
    }
  };
  mark(mesh.tetrahedra);
  mark(mesh.prisms);
  std::vector<Vec3> points;
  for (std::size_t p = 0; p < place.size(); ++p) {
    if (place[p] < 0) continue;
    place[p] = static_cast<std::int32_t>(points.size());
    points.push_back(mesh.points[p]);
  }
  const auto renumber = [&](auto& elements) {
    for (auto& element : elements) {
      for (std::int32_t& p : element) p = place[static_cast<std::size_t>(p)];
    }
  };
  renumber(mesh.tetrahedra);
  renumber(mesh.prisms);
  renumber(mesh.triangles);
  renumber(mesh.quads);
  mesh.points = std::move(points);
  return mesh;
}

/// One prism on each triangle of the core's wall; its sides at the caps are boundary.
void add_ring(MixedMesh& mesh, const MixedMesh& inside) {
  for (std::size_t i = 0; i < inside.triangles.size(); ++i) {
    if (inside.triangle_face_ids[i] != wall) continue;
    const auto& [a, b, c] = inside.triangles[i];
    mesh.prisms.push_back({a, b, c, on_ring(a), on_ring(b), on_ring(c)});
    mesh.triangles.push_back({on_ring(a), on_ring(b), on_ring(c)});
    mesh.triangle_face_ids.push_back(wall);
  }
  for (std::int32_t c = 0; c < corners; ++c) {
    const std::int32_t a = on_core(0, c), b = on_core(0, c + 1);
    const std::int32_t d = on_core(slices, c), e = on_core(slices, c + 1);
    mesh.quads.push_back({a, b, on_ring(b), on_ring(a)});
    mesh.quad_face_ids.push_back(inlet);
    mesh.quads.push_back({d, on_ring(d), on_ring(e), e});
    mesh.quad_face_ids.push_back(outlet);
  }
}

void drop_triangles(MixedMesh& mesh, std::int32_t id) {
  for (std::size_t i = mesh.triangles.size(); i-- > 0;) {
    if (mesh.triangle_face_ids[i] != id) continue;
    mesh.triangles.erase(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(i));
    mesh.triangle_face_ids.erase(mesh.triangle_face_ids.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

/// Nodes in the middle of corners, one for each set of them.
class Middles {
 public:
  explicit Middles(MixedMesh& mesh) : mesh_(mesh) {}
  std::int32_t operator()(std::vector<std::int32_t> between) {
    std::ranges::sort(between);
    const auto [found, added] = nodes_.try_emplace(between, static_cast<std::int32_t>(mesh_.points.size()));
    if (added) {
      Vec3 sum = Vec3::Zero();
      for (const std::int32_t p : between) sum += mesh_.points[static_cast<std::size_t>(p)];
      mesh_.points.push_back(bent(sum / static_cast<double>(between.size())));
    }
    return found->second;
  }

 private:
  static Vec3 bent(const Vec3& p) {
    return p + 0.06 * Vec3(std::sin(1.3 * p.y() + 0.9 * p.z()), std::cos(1.1 * p.x() - 0.7 * p.z()),
                           std::sin(0.8 * p.x() + 1.7 * p.y() + 0.4));
  }
  MixedMesh& mesh_;
  std::map<std::vector<std::int32_t>, std::int32_t> nodes_;
};

using Node = std::array<double, 2>;

/// Position and normal (not of unit length) at reference coordinates of a boundary facet.
struct Sample {
  Vec3 position = Vec3::Zero(), normal = Vec3::Zero();
};

Sample sample(const std::vector<Vec3>& nodes, const std::vector<std::array<double, 3>>& shape) {
  Vec3 u = Vec3::Zero(), v = Vec3::Zero();
  Sample out;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    out.position += shape[i][0] * nodes[i];
    u += shape[i][1] * nodes[i];
    v += shape[i][2] * nodes[i];
  }
  out.normal = u.cross(v);
  return out;
}

/// Value and derivatives of each node's shape function.
std::vector<std::array<double, 3>> triangle_shape(double u, double v, bool second) {
  const double w = 1.0 - u - v;
  if (!second) return {{w, -1, -1}, {u, 1, 0}, {v, 0, 1}};
  return {{w * (2 * w - 1), 1 - 4 * w, 1 - 4 * w},
          {u * (2 * u - 1), 4 * u - 1, 0},
          {v * (2 * v - 1), 0, 4 * v - 1},
          {4 * w * u, 4 * (w - u), -4 * u},
          {4 * u * v, 4 * v, 4 * u},
          {4 * v * w, -4 * v, 4 * (w - v)}};
}

std::vector<std::array<double, 3>> quad_shape(double u, double v, bool second) {
  // One direction: functions of the nodes at 0, 1 and 1/2, and their derivatives.
  const auto line = [second](double t) {
    if (!second) return std::array<std::array<double, 2>, 3>{{{1 - t, -1}, {t, 1}, {0, 0}}};
    return std::array<std::array<double, 2>, 3>{
        {{(1 - t) * (1 - 2 * t), 4 * t - 3}, {t * (2 * t - 1), 4 * t - 1}, {4 * t * (1 - t), 4 - 8 * t}}};
  };
  const auto a = line(u), b = line(v);
  constexpr std::array<std::array<std::size_t, 2>, 9> places = {
      {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {2, 0}, {1, 2}, {2, 1}, {0, 2}, {2, 2}}};
  std::vector<std::array<double, 3>> shape;
  for (std::size_t n = 0; n < (second ? 9u : 4u); ++n) {
    const auto& [i, j] = places[n];
    shape.push_back({a[i][0] * b[j][0], a[i][1] * b[j][0], a[i][0] * b[j][1]});
  }
  return shape;
}

/// Symmetric rules: 7 points, exact to degree 5; 3 x 3 points.
std::vector<std::pair<Node, double>> triangle_rule() {
  const double root = std::sqrt(15.0);
  std::vector<std::pair<Node, double>> rule = {{{1.0 / 3.0, 1.0 / 3.0}, 9.0 / 80.0}};
  for (const double sign : {-1.0, 1.0}) {
    const double a = (6.0 + sign * root) / 21.0, weight = (155.0 + sign * root) / 2400.0;
    for (const Node& at : {Node{a, a}, Node{1 - 2 * a, a}, Node{a, 1 - 2 * a}}) rule.emplace_back(at, weight);
  }
  return rule;
}

std::vector<std::pair<Node, double>> quad_rule() {
  const double d = std::sqrt(0.15);
  const std::array<std::pair<double, double>, 3> line = {
      {{0.5 - d, 5.0 / 18.0}, {0.5, 8.0 / 18.0}, {0.5 + d, 5.0 / 18.0}}};
  std::vector<std::pair<Node, double>> rule;
  for (const auto& [u, wu] : line) {
    for (const auto& [v, wv] : line) rule.push_back({{u, v}, wu * wv});
  }
  return rule;
}

std::string name_of_face(const MixedMesh& mesh, std::int32_t id) {
  return std::ranges::find(mesh.faces, id, &geometry::Face::id)->name;
}

template <std::size_t N, std::size_t M>
std::vector<Vec3> nodes_of(const MixedMesh& mesh, const std::array<std::int32_t, N>& ends,
                           const std::vector<std::array<std::int32_t, M>>& second, std::size_t i) {
  std::vector<Vec3> nodes;
  for (const std::int32_t p : ends) nodes.push_back(mesh.points[static_cast<std::size_t>(p)]);
  if (second.empty()) return nodes;
  for (const std::int32_t p : second[i]) nodes.push_back(mesh.points[static_cast<std::size_t>(p)]);
  return nodes;
}

}  // namespace

MixedMesh column_of_tetrahedra() {
  return compacted(core_of_tetrahedra());
}

MixedMesh column_with_prisms() {
  const MixedMesh inside = core_of_tetrahedra();
  MixedMesh mesh = inside;
  drop_triangles(mesh, wall);
  add_ring(mesh, inside);
  return mesh;
}

MixedMesh ring_of_prisms() {
  const MixedMesh inside = core_of_tetrahedra();
  MixedMesh mesh;
  mesh.points = inside.points;
  mesh.faces = inside.faces;
  add_ring(mesh, inside);
  for (std::size_t i = 0; i < inside.triangles.size(); ++i) {
    if (inside.triangle_face_ids[i] != wall) continue;
    const auto& [a, b, c] = inside.triangles[i];
    mesh.triangles.push_back({a, c, b});
    mesh.triangle_face_ids.push_back(core);
  }
  mesh.faces.push_back({core, "outlet_core", FaceKind::outlet});
  return compacted(std::move(mesh));
}

MixedMesh quadratic(const MixedMesh& linear) {
  MixedMesh mesh = linear;
  Middles middle(mesh);
  for (const auto& t : linear.tetrahedra) {
    mesh.tetrahedron_nodes.push_back({middle({t[0], t[1]}), middle({t[1], t[2]}), middle({t[2], t[0]}),
                                      middle({t[0], t[3]}), middle({t[1], t[3]}), middle({t[2], t[3]})});
  }
  for (const auto& p : linear.prisms) {
    mesh.prism_nodes.push_back({middle({p[0], p[1]}), middle({p[1], p[2]}), middle({p[2], p[0]}),
                                middle({p[3], p[4]}), middle({p[4], p[5]}), middle({p[5], p[3]}),
                                middle({p[0], p[3]}), middle({p[1], p[4]}), middle({p[2], p[5]}),
                                middle({p[0], p[1], p[4], p[3]}), middle({p[1], p[2], p[5], p[4]}),
                                middle({p[2], p[0], p[3], p[5]})});
  }
  for (const auto& t : linear.triangles)
    mesh.triangle_nodes.push_back({middle({t[0], t[1]}), middle({t[1], t[2]}), middle({t[2], t[0]})});
  for (const auto& q : linear.quads)
    mesh.quad_nodes.push_back({middle({q[0], q[1]}), middle({q[1], q[2]}), middle({q[2], q[3]}),
                               middle({q[3], q[0]}), middle({q[0], q[1], q[2], q[3]})});
  return mesh;
}

MeshMeasure measure(const MixedMesh& mesh) {
  MeshMeasure out{mesh.tetrahedra.size(), mesh.prisms.size(), 0.0, 0.0, {}};
  for (const geometry::Face& face : mesh.faces) out.faces[face.name].id = face.id;
  const auto add = [&](FaceMeasure& face, const std::vector<Vec3>& nodes, const auto& rule, auto shape) {
    for (const auto& [at, weight] : rule) {
      const Sample s = sample(nodes, shape(at[0], at[1], mesh.quadratic()));
      face.area += weight * s.normal.norm();
      face.vector_area += weight * s.normal;
      out.volume += weight * s.position.dot(s.normal) / 3.0;
    }
  };
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    FaceMeasure& face = out.faces[name_of_face(mesh, mesh.triangle_face_ids[i])];
    ++face.triangles;
    add(face, nodes_of(mesh, mesh.triangles[i], mesh.triangle_nodes, i), triangle_rule(), triangle_shape);
  }
  for (std::size_t i = 0; i < mesh.quads.size(); ++i) {
    FaceMeasure& face = out.faces[name_of_face(mesh, mesh.quad_face_ids[i])];
    ++face.quads;
    add(face, nodes_of(mesh, mesh.quads[i], mesh.quad_nodes, i), quad_rule(), quad_shape);
  }
  return out;
}

MeshMeasure read_measure(const std::filesystem::path& file) {
  std::ifstream in(file);
  MeshMeasure out;
  std::string word, name;
  while (in >> word) {
    if (word == "cells") {
      std::size_t count = 0;
      in >> name >> count;
      (name == "tetra" ? out.tetrahedra : out.prisms) = count;
    } else if (word == "volume") {
      in >> out.volume >> out.smallest_jacobian;
    } else {
      FaceMeasure face;
      in >> name >> face.id >> face.triangles >> face.quads >> face.area;
      for (double& value : face.vector_area) in >> value;
      out.faces[name] = face;
    }
    if (!in) throw std::runtime_error("cannot read " + file.string());
  }
  return out;
}

}  // namespace ostia::io
