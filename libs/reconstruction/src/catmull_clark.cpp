#include "catmull_clark.h"

#include "ostia/core/parallel.h"

#include <algorithm>
#include <utility>

namespace ostia::reconstruction {
namespace {

struct Edge {
  std::int32_t a = 0, b = 0;  // a < b
  std::int32_t quads[2] = {-1, -1};
};

struct Edges {
  std::vector<Edge> all;
  std::vector<std::array<std::int32_t, 4>> of_quad;  // from corner k to k + 1
};

/// Edges in the order of their lower corner, found by counting.
Edges edges_of(const QuadMesh& mesh) {
  struct Half {
    std::int32_t other, quad, corner;
  };
  std::vector<std::int64_t> first(mesh.points.size() + 1, 0);
  for (const geometry::Quad& q : mesh.quads)
    for (std::size_t k = 0; k < 4; ++k) ++first[static_cast<std::size_t>(std::min(q[k], q[(k + 1) % 4])) + 1];
  for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
  std::vector<Half> halves(4 * mesh.quads.size());
  std::vector<std::int64_t> next(first.begin(), first.end() - 1);
  for (std::size_t i = 0; i < mesh.quads.size(); ++i)
    for (std::size_t k = 0; k < 4; ++k) {
      const auto [a, b] = std::minmax(mesh.quads[i][k], mesh.quads[i][(k + 1) % 4]);
      halves[static_cast<std::size_t>(next[static_cast<std::size_t>(a)]++)] = {
          b, static_cast<std::int32_t>(i), static_cast<std::int32_t>(k)};
    }
  Edges edges;
  edges.of_quad.resize(mesh.quads.size());
  edges.all.reserve(2 * mesh.quads.size());
  for (std::size_t a = 0; a + 1 < first.size(); ++a) {
    const auto from = static_cast<std::size_t>(edges.all.size());
    for (std::int64_t h = first[a]; h < first[a + 1]; ++h) {
      const Half& half = halves[static_cast<std::size_t>(h)];
      std::size_t e = from;
      while (e < edges.all.size() && !(edges.all[e].b == half.other && edges.all[e].quads[1] < 0)) ++e;
      if (e == edges.all.size()) {
        edges.all.push_back({static_cast<std::int32_t>(a), half.other, {half.quad, -1}});
      } else {
        edges.all[e].quads[1] = half.quad;
      }
      edges.of_quad[static_cast<std::size_t>(half.quad)][static_cast<std::size_t>(half.corner)] =
          static_cast<std::int32_t>(e);
    }
  }
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

/// The moved old points: (Q + 2 R + (n - 3) S) / n, and (a + 6 S + b) / 8 along creases.
void move_old(const QuadMesh& mesh, const Edges& edges, QuadMesh& fine, std::size_t first_face) {
  const std::size_t count = mesh.points.size();
  std::vector<Vec3> faces(count, Vec3::Zero()), middles(count, Vec3::Zero()), crease(count, Vec3::Zero());
  std::vector<std::int32_t> valence(count, 0);
  for (std::size_t i = 0; i < mesh.quads.size(); ++i)
    for (const std::int32_t v : mesh.quads[i]) {
      faces[static_cast<std::size_t>(v)] += fine.points[first_face + i];
      ++valence[static_cast<std::size_t>(v)];
    }
  for (const Edge& edge : edges.all) {
    const auto a = static_cast<std::size_t>(edge.a), b = static_cast<std::size_t>(edge.b);
    const Vec3 middle = 0.5 * (mesh.points[a] + mesh.points[b]);
    middles[a] += middle;
    middles[b] += middle;
    if (!is_crease(mesh, edge)) continue;
    crease[a] += mesh.points[b];
    crease[b] += mesh.points[a];
  }
  for (std::size_t v = 0; v < count; ++v) {
    const double n = valence[v];
    fine.points[v] = mesh.tags[v].place == Place::rim
                         ? Vec3((6.0 * mesh.points[v] + crease[v]) / 8.0)
                         : Vec3((faces[v] / n + 2.0 * middles[v] / n + (n - 3.0) * mesh.points[v]) / n);
  }
}

}  // namespace

QuadMesh subdivided(const QuadMesh& mesh) {
  const Edges edges = edges_of(mesh);
  const std::size_t first_edge = mesh.points.size(), first_face = first_edge + edges.all.size();
  QuadMesh fine;
  fine.points.resize(first_face + mesh.quads.size());
  fine.tags = mesh.tags;
  fine.tags.resize(fine.points.size());
  const auto point = [&](std::int32_t v) -> const Vec3& { return mesh.points[static_cast<std::size_t>(v)]; };
  for (std::size_t i = 0; i < mesh.quads.size(); ++i) {
    const geometry::Quad& q = mesh.quads[i];
    fine.points[first_face + i] = 0.25 * (point(q[0]) + point(q[1]) + point(q[2]) + point(q[3]));
    fine.tags[first_face + i] = tag_of(mesh, q.data(), 4, false);
    if (mesh.face_of_quad[i] != 0) fine.tags[first_face + i].place = Place::cap;
  }
  for (std::size_t e = 0; e < edges.all.size(); ++e) {
    const Edge& edge = edges.all[e];
    const bool crease = is_crease(mesh, edge);
    const Vec3 middle = 0.5 * (point(edge.a) + point(edge.b));
    const Vec3 beside = 0.5 * (fine.points[first_face + static_cast<std::size_t>(edge.quads[0])] +
                               fine.points[first_face + static_cast<std::size_t>(edge.quads[1])]);
    fine.points[first_edge + e] = crease ? middle : Vec3(0.5 * (middle + beside));
    const std::int32_t ends[2] = {edge.a, edge.b};
    fine.tags[first_edge + e] = tag_of(mesh, ends, 2, crease);
  }
  move_old(mesh, edges, fine, first_face);
  for (std::size_t i = 0; i < mesh.quads.size(); ++i) {
    const auto middle = static_cast<std::int32_t>(first_face + i);
    for (std::size_t k = 0; k < 4; ++k) {
      const auto after = static_cast<std::int32_t>(first_edge) + edges.of_quad[i][k];
      const auto before = static_cast<std::int32_t>(first_edge) + edges.of_quad[i][(k + 3) % 4];
      fine.quads.push_back({mesh.quads[i][k], after, middle, before});
      fine.branch_of_quad.push_back(mesh.branch_of_quad[i]);
      fine.face_of_quad.push_back(mesh.face_of_quad[i]);
    }
  }
  return fine;
}

void place(QuadMesh& mesh, const std::vector<Tube>& tubes, const std::vector<Joint>& joints, double scale) {
  core::parallel_for(mesh.points.size(), 1024, [&](std::size_t i) {
    const Tag& tag = mesh.tags[i];
    Vec3& point = mesh.points[i];
    if (tag.place == Place::joint) {
      point = joints[static_cast<std::size_t>(tag.owner)].field->onto(point, scale);
    } else if (tag.place != Place::cap) {
      const TubePlace on = at(tubes[static_cast<std::size_t>(tag.owner)], tag.abscissa);
      Vec3 out = point - on.point;
      out -= out.dot(on.frame.tangent) * on.frame.tangent;
      const double length = out.norm();
      point = on.point + scale * on.radius * (length > 0.0 ? Vec3(out / length) : on.frame.normal);
    }
  });
}

}  // namespace ostia::reconstruction
