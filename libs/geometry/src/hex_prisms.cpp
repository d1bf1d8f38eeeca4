#include "ostia/geometry/hex_prisms.h"

#include "ostia/core/error.h"
#include "ostia/geometry/faces.h"
#include "ostia/geometry/mixed_mesh_sides.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace ostia::geometry {
namespace {

using Diagonal = std::array<std::int32_t, 2>;  // ascending
constexpr int unset = -1;

/// Sides as in hexahedron_sides; a row runs through both sides of one axis.
constexpr std::array<std::array<std::size_t, 2>, 3> sides_of_axis = {{{0, 1}, {2, 4}, {3, 5}}};
constexpr std::array<int, 6> axis_of_side = {0, 0, 1, 2, 1, 2};

/// For each axis a side, counter-clockwise seen from the opposite one, and the corners across.
using Across = std::array<std::array<std::size_t, 4>, 2>;
constexpr std::array<Across, 3> across = {
    {{{{0, 1, 2, 3}, {4, 5, 6, 7}}}, {{{0, 4, 5, 1}, {3, 7, 6, 2}}}, {{{0, 3, 7, 4}, {1, 2, 6, 5}}}}};

std::int32_t prism_corner(const Prism& prism, int place) {
  return prism[static_cast<std::size_t>(place)];
}

Quad quad_key(Quad corners) {
  std::ranges::sort(corners);
  return corners;
}

Diagonal both_ascending(std::int32_t a, std::int32_t b) {
  return {std::min(a, b), std::max(a, b)};
}

struct SideOfHexahedron {
  std::size_t hexahedron, side;
};

class Cutter {
 public:
  Cutter(const std::vector<Hexahedron>& hexahedra, const MixedMesh& mesh)
      : hexahedra_(hexahedra), mesh_(mesh), axis_(hexahedra.size(), unset) {
    for (std::size_t h = 0; h < hexahedra.size(); ++h)
      for (std::size_t s = 0; s < hexahedron_sides.size(); ++s) sides_[key(h, s)].push_back({h, s});
    for (const Prism& prism : mesh.prisms)
      for (const auto& side : prism_sides)
        if (side[3] >= 0)
          whole_.insert(quad_key({prism_corner(prism, side[0]), prism_corner(prism, side[1]),
                                  prism_corner(prism, side[2]), prism_corner(prism, side[3])}));
  }

  void cut_all() {
    for (const std::size_t h : at_caps()) {
      if (axis_[h] != unset) continue;
      for (const int axis : cap_axes_[h])
        if (cut_row(h, axis)) break;
    }
    for (std::size_t h = 0; h < hexahedra_.size(); ++h) {
      if (axis_[h] != unset) continue;
      if (cut_row(h, 0) || cut_row(h, 1) || cut_row(h, 2)) continue;
      throw GeometryError("the hexahedra cannot be cut into prisms: rows of them cross at number " +
                          std::to_string(h));
    }
  }

  /// Of a side that is cut.
  std::optional<Diagonal> diagonal(const Quad& corners) const {
    const auto found = cuts_.find(quad_key(corners));
    return found == cuts_.end() ? std::nullopt : std::optional(found->second);
  }

  void add_prisms(std::vector<Prism>& prisms) const {
    for (std::size_t h = 0; h < hexahedra_.size(); ++h) {
      const Hexahedron& c = hexahedra_[h];
      const auto& [base, top] = across[static_cast<std::size_t>(axis_[h])];
      const auto prism = [&](std::size_t i, std::size_t j, std::size_t k) {
        prisms.push_back({c[base[i]], c[base[j]], c[base[k]], c[top[i]], c[top[j]], c[top[k]]});
      };
      const std::optional<Diagonal> cut = diagonal({c[base[0]], c[base[1]], c[base[2]], c[base[3]]});
      if (*cut == both_ascending(c[base[0]], c[base[2]])) {
        prism(0, 1, 2);
        prism(0, 2, 3);
      } else {
        prism(0, 1, 3);
        prism(1, 2, 3);
      }
    }
  }

 private:
  Quad key(std::size_t h, std::size_t s) const {
    const auto& side = hexahedron_sides[s];
    Quad corners{};
    for (std::size_t k = 0; k < 4; ++k) corners[k] = hexahedra_[h][static_cast<std::size_t>(side[k])];
    return quad_key(corners);
  }

  double length(const Diagonal& d) const {
    return (mesh_.points[static_cast<std::size_t>(d[0])] - mesh_.points[static_cast<std::size_t>(d[1])])
        .norm();
  }

  /// Hexahedra with a side on an inlet or outlet, in their order.
  std::vector<std::size_t> at_caps() {
    const FacesByKind kinds(mesh_.faces);
    std::vector<std::size_t> found;
    for (std::size_t q = 0; q < mesh_.quads.size(); ++q) {
      if (!kinds.cap(mesh_.quad_face_ids[q])) continue;
      const auto at = sides_.find(quad_key(mesh_.quads[q]));
      if (at == sides_.end()) continue;
      for (const SideOfHexahedron& one : at->second) {
        cap_axes_[one.hexahedron].push_back(axis_of_side[one.side]);
        found.push_back(one.hexahedron);
      }
    }
    std::ranges::sort(found);
    return found;
  }

  /// The whole row of a hexahedron along one of its axes; false, and nothing cut, where it crosses another.
  bool cut_row(std::size_t first, int axis) {
    std::map<std::size_t, int> row;
    std::map<Quad, Diagonal> cuts;
    std::vector<std::size_t> open{first};
    row[first] = axis;
    while (!open.empty()) {
      const std::size_t h = open.back();
      open.pop_back();
      if (!cut_pair(h, row[h], cuts)) return false;
      for (const std::size_t s : sides_of_axis[static_cast<std::size_t>(row[h])]) {
        const Quad side = key(h, s);
        if (whole_.contains(side)) return false;
        for (const SideOfHexahedron& next : sides_.at(side)) {
          if (next.hexahedron == h) continue;
          const int wanted = axis_of_side[next.side];
          if (axis_[next.hexahedron] != unset) return false;
          const auto [at, fresh] = row.try_emplace(next.hexahedron, wanted);
          if (at->second != wanted) return false;
          if (fresh) open.push_back(next.hexahedron);
        }
      }
    }
    for (const auto& [h, own] : row) axis_[h] = own;
    cuts_.insert(cuts.begin(), cuts.end());
    return true;
  }

  /// Both opposite sides along the same diagonal; false where one is cut along the other already.
  bool cut_pair(std::size_t h, int axis, std::map<Quad, Diagonal>& cuts) const {
    const Hexahedron& c = hexahedra_[h];
    const auto& [base, top] = across[static_cast<std::size_t>(axis)];
    const auto on = [&](const std::array<std::size_t, 4>& side, std::size_t i, std::size_t j) {
      return both_ascending(c[side[i]], c[side[j]]);
    };
    const auto cut_of = [&](const std::array<std::size_t, 4>& side) {
      return cuts.find(quad_key({c[side[0]], c[side[1]], c[side[2]], c[side[3]]}));
    };
    const auto below = cut_of(base), above = cut_of(top);
    bool even = length(on(base, 0, 2)) <= length(on(base, 1, 3));  // along 0-2
    if (below != cuts.end()) even = below->second == on(base, 0, 2);
    if (above != cuts.end()) {
      const bool even_above = above->second == on(top, 0, 2);
      if (below != cuts.end() && even_above != even) return false;
      even = even_above;
    }
    for (const auto& side : {base, top})
      cuts[quad_key({c[side[0]], c[side[1]], c[side[2]], c[side[3]]})] =
          even ? on(side, 0, 2) : on(side, 1, 3);
    return true;
  }

  const std::vector<Hexahedron>& hexahedra_;
  const MixedMesh& mesh_;
  std::map<Quad, std::vector<SideOfHexahedron>> sides_;
  std::set<Quad> whole_;
  std::map<std::size_t, std::vector<int>> cap_axes_;
  std::vector<int> axis_;
  std::map<Quad, Diagonal> cuts_;
};

/// The boundary's quadrilaterals that are cut.
void cut_boundary(const Cutter& cutter, MixedMesh& mesh) {
  std::vector<Quad> quads;
  std::vector<std::int32_t> ids;
  for (std::size_t i = 0; i < mesh.quads.size(); ++i) {
    const Quad& q = mesh.quads[i];
    const std::optional<Diagonal> cut = cutter.diagonal(q);
    if (!cut) {
      quads.push_back(q);
      ids.push_back(mesh.quad_face_ids[i]);
      continue;
    }
    const std::size_t from = *cut == both_ascending(q[0], q[2]) ? 0 : 1;
    const auto at = [&](std::size_t k) { return q[(from + k) % 4]; };
    mesh.triangles.push_back({at(0), at(1), at(2)});
    mesh.triangles.push_back({at(0), at(2), at(3)});
    mesh.triangle_face_ids.insert(mesh.triangle_face_ids.end(), 2, mesh.quad_face_ids[i]);
  }
  mesh.quads = std::move(quads);
  mesh.quad_face_ids = std::move(ids);
}

}  // namespace

void add_as_prisms(const std::vector<Hexahedron>& hexahedra, MixedMesh& mesh) {
  const auto points = static_cast<std::int64_t>(mesh.points.size());
  for (std::size_t h = 0; h < hexahedra.size(); ++h)
    for (const std::int32_t p : hexahedra[h])
      if (p < 0 || p >= points)
        throw InvalidInput("hexahedron " + std::to_string(h) + " names point " + std::to_string(p) + " of " +
                           std::to_string(points));
  Cutter cutter(hexahedra, mesh);
  cutter.cut_all();
  cut_boundary(cutter, mesh);
  cutter.add_prisms(mesh.prisms);
}

MixedMesh as_prisms(HexMesh mesh) {
  MixedMesh out;
  out.points = std::move(mesh.points);
  out.quads = std::move(mesh.quads);
  out.quad_face_ids = std::move(mesh.quad_face_ids);
  out.faces = std::move(mesh.faces);
  add_as_prisms(mesh.hexahedra, out);
  return out;
}

}  // namespace ostia::geometry
