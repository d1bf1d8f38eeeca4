#include "catmull_clark.h"

#include "ostia/core/parallel.h"

#include <algorithm>
#include <utility>

namespace ostia::reconstruction {
namespace {

constexpr std::size_t grain = 2048;

struct Edge {
  std::int32_t a = 0, b = 0;  // a < b
  std::int32_t quads[2] = {-1, -1};
};

/// A corner of a quadrilateral.
struct Corner {
  std::size_t quad = 0, k = 0;
};

/// The corners at each point, ascending.
class Corners {
 public:
  explicit Corners(const QuadMesh& mesh)
      : first_(mesh.points.size() + 1, 0), corners_(4 * mesh.quads.size()) {
    for (const geometry::Quad& q : mesh.quads)
      for (const std::int32_t v : q) ++first_[static_cast<std::size_t>(v) + 1];
    for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for (std::size_t c = 0; c < corners_.size(); ++c)
      corners_[next[static_cast<std::size_t>(mesh.quads[c / 4][c % 4])]++] = static_cast<std::uint32_t>(c);
  }
  std::size_t count(std::size_t point) const { return first_[point + 1] - first_[point]; }
  Corner at(std::size_t point, std::size_t i) const {
    const std::uint32_t corner = corners_[first_[point] + i];
    return {corner / 4, corner % 4};
  }

 private:
  std::vector<std::size_t> first_;
  std::vector<std::uint32_t> corners_;
};

/// Calls use(other, corner) with each side of a quadrilateral from corner k to k + 1 of which `point` is the
/// lower end, ascending.
template <class Use>
void for_sides(const QuadMesh& mesh, const Corners& corners, std::size_t point, const Use& use) {
  for (std::size_t i = 0; i < corners.count(point); ++i) {
    const Corner here = corners.at(point, i);
    const geometry::Quad& q = mesh.quads[here.quad];
    const std::size_t before = (here.k + 3) % 4;
    for (const std::size_t k : {std::min(before, here.k), std::max(before, here.k)}) {
      const std::int32_t other = k == here.k ? q[(k + 1) % 4] : q[k];
      if (static_cast<std::size_t>(other) > point) use(other, Corner{here.quad, k});
    }
  }
}

struct Edges {
  std::vector<Edge> all;
  std::vector<std::array<std::int32_t, 4>> of_quad;  // from corner k to k + 1
};

/// Where the edges of each lower end begin: the mesh is closed, so that each has two sides.
std::vector<std::size_t> first_edges(const QuadMesh& mesh, const Corners& corners) {
  std::vector<std::size_t> first(mesh.points.size() + 1, 0);
  core::parallel_for(mesh.points.size(), grain, [&](std::size_t a) {
    std::size_t sides = 0;
    for_sides(mesh, corners, a, [&](std::int32_t, const Corner&) { ++sides; });
    first[a + 1] = sides / 2;
  });
  for (std::size_t a = 1; a < first.size(); ++a) first[a] += first[a - 1];
  return first;
}

/// Edges in the order of their lower end.
Edges edges_of(const QuadMesh& mesh, const Corners& corners) {
  const std::vector<std::size_t> first = first_edges(mesh, corners);
  Edges edges;
  edges.of_quad.resize(mesh.quads.size());
  edges.all.resize(first.back());
  core::parallel_for(mesh.points.size(), grain, [&](std::size_t a) {
    std::size_t end = first[a];
    for_sides(mesh, corners, a, [&](std::int32_t other, const Corner& side) {
      const auto quad = static_cast<std::int32_t>(side.quad);
      std::size_t e = first[a];
      while (e < end && !(edges.all[e].b == other && edges.all[e].quads[1] < 0)) ++e;
      if (e == end)
        edges.all[end++] = {static_cast<std::int32_t>(a), other, {quad, -1}};
      else
        edges.all[e].quads[1] = quad;
      edges.of_quad[side.quad][side.k] = static_cast<std::int32_t>(e);
    });
  });
  return edges;
}

/// The joint's where one is among them, the cap's before the wall's; wall points share the mean abscissa.
Tag tag_of(const QuadMesh& mesh, const std::int32_t* points, std::size_t count, bool crease) {
  const Tag* found = nullptr;
  double sum = 0.0;
  const Tag* cap = nullptr;
  for (std::size_t i = 0; i < count; ++i) {
    const Tag& tag = mesh.tags[static_cast<std::size_t>(points[i])];
    sum += tag.abscissa;
    if (tag.place == Place::joint && (found == nullptr || tag.owner < found->owner)) found = &tag;
    if (tag.place == Place::cap) cap = &tag;
  }
  if (found != nullptr) return *found;
  const Tag& first = mesh.tags[static_cast<std::size_t>(points[0])];
  if (crease) return {Place::rim, first.owner, first.abscissa};
  if (cap != nullptr) return {Place::cap, cap->owner, cap->abscissa};
  return {Place::wall, first.owner, sum / static_cast<double>(count)};
}

bool is_crease(const QuadMesh& mesh, const Edge& edge) {
  return mesh.face_of_quad[static_cast<std::size_t>(edge.quads[0])] !=
         mesh.face_of_quad[static_cast<std::size_t>(edge.quads[1])];
}

/// The mesh with what is fixed in it: nothing before level 1; then what touches a flat joint, and what it
/// becomes.
struct Flat {
  std::vector<std::uint8_t> quads, points;

  bool quad(std::size_t i) const { return !quads.empty() && quads[i] != 0; }
  bool point(std::size_t i) const { return !points.empty() && points[i] != 0; }
  bool edge(const Edge& edge) const {
    return quad(static_cast<std::size_t>(edge.quads[0])) || quad(static_cast<std::size_t>(edge.quads[1]));
  }
};

Flat flat_in(const QuadMesh& mesh) {
  if (mesh.level == 0 || std::none_of(mesh.flat_joints.begin(), mesh.flat_joints.end(),
                                      [](std::uint8_t flat) { return flat != 0; }))
    return {};
  if (mesh.level > 1) return {mesh.flat_quads, mesh.fixed_points};
  Flat flat{std::vector<std::uint8_t>(mesh.quads.size(), 0),
            std::vector<std::uint8_t>(mesh.points.size(), 0)};
  for (std::size_t i = 0; i < mesh.quads.size(); ++i) {
    const geometry::Quad& q = mesh.quads[i];
    const bool touches = std::any_of(q.begin(), q.end(), [&](std::int32_t v) {
      const Tag& tag = mesh.tags[static_cast<std::size_t>(v)];
      return tag.place == Place::joint && mesh.flat_joints[static_cast<std::size_t>(tag.owner)] != 0;
    });
    if (!touches) continue;
    flat.quads[i] = 1;
    for (const std::int32_t v : q) flat.points[static_cast<std::size_t>(v)] = 1;
  }
  return flat;
}

/// What is summed up about an old point.
struct Around {
  Vec3 faces = Vec3::Zero(), middles = Vec3::Zero(), crease = Vec3::Zero();
};

/// `ids` is a place to work in. The sums are made in the order of quadrilaterals and edges.
Around around(std::size_t v, const QuadMesh& mesh, const Corners& corners, const Edges& edges,
              const Vec3* faces, std::vector<std::int32_t>& ids) {
  Around sum;
  ids.clear();
  for (std::size_t i = 0; i < corners.count(v); ++i) {
    const Corner corner = corners.at(v, i);
    sum.faces += faces[corner.quad];
    ids.push_back(edges.of_quad[corner.quad][corner.k]);
    ids.push_back(edges.of_quad[corner.quad][(corner.k + 3) % 4]);
  }
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  for (const std::int32_t id : ids) {
    const Edge& edge = edges.all[static_cast<std::size_t>(id)];
    const Vec3 &a = mesh.points[static_cast<std::size_t>(edge.a)],
               &b = mesh.points[static_cast<std::size_t>(edge.b)];
    sum.middles += 0.5 * (a + b);
    if (is_crease(mesh, edge)) sum.crease += static_cast<std::size_t>(edge.a) == v ? b : a;
  }
  return sum;
}

/// The moved old points: (Q + 2 R + (n - 3) S) / n, and (a + 6 S + b) / 8 along creases.
void move_old(const QuadMesh& mesh, const Corners& corners, const Edges& edges, const Flat& flat,
              QuadMesh& fine, std::size_t first_face) {
  core::parallel_chunks(mesh.points.size(), grain, [&](std::size_t first, std::size_t last) {
    std::vector<std::int32_t> ids;
    for (std::size_t v = first; v < last; ++v) {
      if (flat.point(v)) {
        fine.points[v] = mesh.points[v];
        continue;
      }
      const double n = static_cast<double>(corners.count(v));
      const Around sum = around(v, mesh, corners, edges, fine.points.data() + first_face, ids);
      fine.points[v] = mesh.tags[v].place == Place::rim
                           ? Vec3((6.0 * mesh.points[v] + sum.crease) / 8.0)
                           : Vec3((sum.faces / n + 2.0 * sum.middles / n + (n - 3.0) * mesh.points[v]) / n);
    }
  });
}

void add_faces(const QuadMesh& mesh, const Flat& flat, QuadMesh& fine, std::size_t first_face) {
  core::parallel_for(mesh.quads.size(), grain, [&](std::size_t i) {
    const geometry::Quad& q = mesh.quads[i];
    const auto point = [&](std::size_t k) -> const Vec3& {
      return mesh.points[static_cast<std::size_t>(q[k])];
    };
    const std::size_t k = along_first_diagonal(mesh, q) ? 0 : 1;
    fine.points[first_face + i] = flat.quad(i) ? Vec3(0.5 * (point(k) + point(k + 2)))
                                               : Vec3(0.25 * (point(0) + point(1) + point(2) + point(3)));
    fine.tags[first_face + i] = tag_of(mesh, q.data(), 4, false);
    if (mesh.face_of_quad[i] != 0) fine.tags[first_face + i].place = Place::cap;
  });
}

void add_edges(const QuadMesh& mesh, const Edges& edges, const Flat& flat, QuadMesh& fine,
               std::size_t first_edge, std::size_t first_face) {
  core::parallel_for(edges.all.size(), grain, [&](std::size_t e) {
    const Edge& edge = edges.all[e];
    const bool crease = is_crease(mesh, edge);
    const Vec3 middle =
        0.5 * (mesh.points[static_cast<std::size_t>(edge.a)] + mesh.points[static_cast<std::size_t>(edge.b)]);
    const Vec3 beside = 0.5 * (fine.points[first_face + static_cast<std::size_t>(edge.quads[0])] +
                               fine.points[first_face + static_cast<std::size_t>(edge.quads[1])]);
    fine.points[first_edge + e] = crease || flat.edge(edge) ? middle : Vec3(0.5 * (middle + beside));
    const std::int32_t ends[2] = {edge.a, edge.b};
    fine.tags[first_edge + e] = tag_of(mesh, ends, 2, crease);
  });
}

/// Four of each, the one at its corner k in place k.
void divide(const QuadMesh& mesh, const Edges& edges, QuadMesh& fine, std::size_t first_edge,
            std::size_t first_face) {
  const std::size_t count = 4 * mesh.quads.size();
  fine.quads.resize(count);
  fine.branch_of_quad.resize(count);
  fine.face_of_quad.resize(count);
  core::parallel_for(count, grain, [&](std::size_t c) {
    const std::size_t i = c / 4, k = c % 4;
    const auto middle = static_cast<std::int32_t>(first_face + i);
    const auto after = static_cast<std::int32_t>(first_edge) + edges.of_quad[i][k];
    const auto before = static_cast<std::int32_t>(first_edge) + edges.of_quad[i][(k + 3) % 4];
    fine.quads[c] = {mesh.quads[i][k], after, middle, before};
    fine.branch_of_quad[c] = mesh.branch_of_quad[i];
    fine.face_of_quad[c] = mesh.face_of_quad[i];
  });
}

/// What is fixed in the finer mesh.
void pass_on(const QuadMesh& mesh, const Edges& edges, const Flat& flat, QuadMesh& fine,
             std::size_t first_edge, std::size_t first_face) {
  if (flat.quads.empty()) return;
  fine.flat_quads.resize(fine.quads.size());
  for (std::size_t c = 0; c < fine.quads.size(); ++c) fine.flat_quads[c] = flat.quads[c / 4];
  fine.fixed_points = flat.points;
  fine.fixed_points.resize(fine.points.size());
  for (std::size_t e = 0; e < edges.all.size(); ++e)
    fine.fixed_points[first_edge + e] = flat.edge(edges.all[e]) ? 1 : 0;
  for (std::size_t i = 0; i < mesh.quads.size(); ++i) fine.fixed_points[first_face + i] = flat.quads[i];
}

/// How long a vector across the vessel would be if the ellipse were a circle.
double unstretched_length(const Stretch& stretch, const Vec3& out, const geometry::Frame& frame) {
  if (stretch.round()) return out.norm();
  return unstretched(stretch, {out.dot(frame.normal), out.dot(frame.binormal)}).norm();
}

}  // namespace

QuadMesh subdivided(const QuadMesh& mesh) {
  const Corners corners(mesh);
  const Edges edges = edges_of(mesh, corners);
  const std::size_t first_edge = mesh.points.size(), first_face = first_edge + edges.all.size();
  QuadMesh fine;
  fine.clear = mesh.clear;
  fine.flat_joints = mesh.flat_joints;
  fine.level = mesh.level + 1;
  fine.points.resize(first_face + mesh.quads.size());
  fine.tags = mesh.tags;
  fine.tags.resize(fine.points.size());
  const Flat flat = flat_in(mesh);
  add_faces(mesh, flat, fine, first_face);
  add_edges(mesh, edges, flat, fine, first_edge, first_face);
  move_old(mesh, corners, edges, flat, fine, first_face);
  divide(mesh, edges, fine, first_edge, first_face);
  pass_on(mesh, edges, flat, fine, first_edge, first_face);
  return fine;
}

void place(QuadMesh& mesh, const std::vector<Tube>& tubes, const std::vector<Joint>& joints, double scale) {
  core::parallel_for(mesh.points.size(), 1024, [&](std::size_t i) {
    const Tag& tag = mesh.tags[i];
    Vec3& point = mesh.points[i];
    if (!mesh.fixed_points.empty() && mesh.fixed_points[i] != 0) return;
    if (tag.place == Place::joint) {
      point = joints[static_cast<std::size_t>(tag.owner)].field->onto(point, scale);
    } else if (tag.place != Place::cap) {
      const TubePlace on = at(tubes[static_cast<std::size_t>(tag.owner)], tag.abscissa);
      Vec3 out = point - on.point;
      out -= out.dot(on.frame.tangent) * on.frame.tangent;
      const Stretch stretch =
          clear_stretch(on, tag.abscissa, mesh.clear[static_cast<std::size_t>(tag.owner)]);
      const double length = unstretched_length(stretch, out, on.frame);
      point = on.point + scale * on.radius * (length > 0.0 ? Vec3(out / length) : on.frame.normal);
    }
  });
}

}  // namespace ostia::reconstruction
