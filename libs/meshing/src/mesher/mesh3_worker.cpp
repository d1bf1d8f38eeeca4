// Delaunay refinement of the inside of a closed surface (Rineau and Yvinec; Boltcheva, Yvinec and Boissonnat
// for the curves). The only file that sees CGAL's Mesh_3.
#include "mesher/mesh3_worker.h"

#include "sizing/interior_sizes.h"

#include "ostia/core/error.h"
#include "ostia/geometry/kd_tree.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_polyhedron_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/Polyhedral_mesh_domain_with_features_3.h>
#include <CGAL/Polyhedron_incremental_builder_3.h>
#include <CGAL/make_mesh_3.h>

#include <algorithm>
#include <map>
#include <memory>
#include <unordered_map>
#include <utility>

namespace ostia::meshing {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Polyhedron = CGAL::Mesh_polyhedron_3<Kernel>::type;
using Domain = CGAL::Polyhedral_mesh_domain_with_features_3<Kernel>;
using Triangulation = CGAL::Mesh_triangulation_3<Domain>::type;
using Complex =
    CGAL::Mesh_complex_3_in_triangulation_3<Triangulation, Domain::Corner_index, Domain::Curve_index>;
using Criteria = CGAL::Mesh_criteria_3<Triangulation>;
using Point = Kernel::Point_3;
using Polyline = std::vector<Point>;

constexpr double facet_angle_deg = 25.0, cell_radius_edge_ratio = 2.0;

Point cgal_point(const geometry::Vec3& p) {
  return {p.x(), p.y(), p.z()};
}

class Builder : public CGAL::Modifier_base<Polyhedron::HalfedgeDS> {
 public:
  explicit Builder(const MesherJob& job) : job_(job) {}
  void operator()(Polyhedron::HalfedgeDS& structure) override {
    CGAL::Polyhedron_incremental_builder_3<Polyhedron::HalfedgeDS> builder(structure, false);
    builder.begin_surface(job_.points.size(), job_.triangles.size());
    for (const geometry::Vec3& p : job_.points) builder.add_vertex(cgal_point(p));
    for (const geometry::Triangle& t : job_.triangles) {
      builder.begin_facet();
      for (const std::int32_t v : t) builder.add_vertex_to_facet(static_cast<std::size_t>(v));
      builder.end_facet();
    }
    builder.end_surface();
    if (builder.error()) throw GeometryError("Mesh_3: the surface is not manifold");
  }

 private:
  const MesherJob& job_;
};

Polyhedron polyhedron_of(const MesherJob& job) {
  Polyhedron polyhedron;
  Builder builder(job);
  polyhedron.delegate(builder);
  auto face = polyhedron.facets_begin();
  for (const std::int32_t id : job.face_ids) (face++)->set_patch_id(id);
  return polyhedron;
}

/// Edges between triangles of different faces, each as the pair of its points, lower first.
std::vector<std::pair<std::int32_t, std::int32_t>> edges_between_faces(const MesherJob& job) {
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> face_of;
  std::vector<std::pair<std::int32_t, std::int32_t>> edges;
  for (std::size_t i = 0; i < job.triangles.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto edge = std::minmax(job.triangles[i][k], job.triangles[i][(k + 1) % 3]);
      const auto [at, is_new] = face_of.try_emplace(edge, job.face_ids[i]);
      if (!is_new && at->second != job.face_ids[i]) edges.emplace_back(edge);
    }
  std::sort(edges.begin(), edges.end());
  return edges;
}

/// The edges between faces as curves: closed ones, and ones between points where more than two edges meet.
std::vector<Polyline> curves_of(const MesherJob& job) {
  std::map<std::int32_t, std::vector<std::int32_t>> next;
  for (const auto& [a, b] : edges_between_faces(job)) {
    next[a].push_back(b);
    next[b].push_back(a);
  }
  std::vector<Polyline> curves;
  const auto at = [&](std::int32_t v) { return cgal_point(job.points[static_cast<std::size_t>(v)]); };
  const auto take = [&](std::int32_t a, std::int32_t b) {
    auto& ends = next[a];
    ends.erase(std::find(ends.begin(), ends.end(), b));
  };
  const auto walk = [&](std::int32_t start, const std::map<std::int32_t, std::size_t>& valence) {
    Polyline curve{at(start)};
    std::int32_t now = start;
    do {
      const std::int32_t to = next[now].front();
      take(now, to);
      take(to, now);
      curve.push_back(at(to));
      now = to;
    } while (now != start && valence.at(now) == 2 && !next[now].empty());
    curves.push_back(std::move(curve));
  };
  std::map<std::int32_t, std::size_t> valence;
  for (const auto& [v, others] : next) valence[v] = others.size();
  for (const bool junctions : {true, false})
    for (const auto& [v, count] : valence)
      while ((count != 2) == junctions && !next[v].empty()) walk(v, valence);
  return curves;
}

/// A share of the job's size at the nearest point of its surface, or of its field's.
struct MeshSize {
  using FT = Kernel::FT;
  using Point_3 = Point;
  using Index = Domain::Index;
  FT operator()(const Point_3& p, int, const Index&) const {
    const geometry::Vec3 place(p.x(), p.y(), p.z());
    if (field) return share * (*field)(place);
    return share * (*sizes)[static_cast<std::size_t>(tree->nearest(place))];
  }
  std::shared_ptr<const geometry::KdTree> tree;
  const std::vector<double>* sizes = nullptr;
  double share = 1.0;
  std::shared_ptr<const InteriorSizes> field = {};
};

/// Points get numbers as they are met; the boundary is told first.
class Numbering {
 public:
  explicit Numbering(MesherResult& result) : result_(result) {}
  std::int32_t operator()(const Complex::Vertex_handle& v) {
    const auto [at, is_new] = numbers_.try_emplace(&*v, static_cast<std::int32_t>(result_.points.size()));
    if (is_new) {
      const auto& p = v->point();
      result_.points.emplace_back(p.x(), p.y(), p.z());
    }
    return at->second;
  }

 private:
  MesherResult& result_;
  std::unordered_map<const void*, std::int32_t> numbers_;
};

MesherResult collect(const Complex& complex) {
  MesherResult result;
  Numbering number(result);
  const Triangulation& triangulation = complex.triangulation();
  for (auto f = complex.facets_in_complex_begin(); f != complex.facets_in_complex_end(); ++f) {
    auto [cell, opposite] = *f;
    if (!complex.is_in_complex(cell)) {
      const auto mirror = triangulation.mirror_facet(*f);
      cell = mirror.first;
      opposite = mirror.second;
    }
    geometry::Triangle t{};
    for (int k = 0; k < 3; ++k)
      t[static_cast<std::size_t>(2 - k)] =
          number(cell->vertex(Triangulation::vertex_triple_index(opposite, k)));
    result.boundary.push_back(t);  // CGAL tells it as seen from inside the cell
    result.boundary_face_ids.push_back(complex.surface_patch_index(*f));
  }
  for (auto c = complex.cells_in_complex_begin(); c != complex.cells_in_complex_end(); ++c)
    result.tetrahedra.push_back(
        {number(c->vertex(0)), number(c->vertex(1)), number(c->vertex(2)), number(c->vertex(3))});
  return result;
}

}  // namespace

MesherResult run_mesh3(const MesherJob& job) {
  CGAL::get_default_random() = CGAL::Random(1);  // the same mesh each time
  const Polyhedron polyhedron = polyhedron_of(job);
  Domain domain(polyhedron);
  const std::vector<Polyline> curves = curves_of(job);
  domain.add_features(curves.begin(), curves.end());
  MeshSize size{std::make_shared<geometry::KdTree>(job.points), &job.sizes, 1.0};
  if (!job.field_points.empty()) size.field = std::make_shared<InteriorSizes>(job);
  MeshSize deviation = size, edge = size;
  deviation.share = 0.1;  // the triangles of a vessel with 16 edges around stand off by 0.06
  edge.share = 0.75;      // finer along the curves, so that inlets and outlets keep their area
  const Criteria criteria(CGAL::parameters::edge_size = edge, CGAL::parameters::facet_angle = facet_angle_deg,
                          CGAL::parameters::facet_size = size, CGAL::parameters::facet_distance = deviation,
                          CGAL::parameters::cell_radius_edge_ratio = cell_radius_edge_ratio,
                          CGAL::parameters::cell_size = size);
  const auto complex = CGAL::make_mesh_3<Complex>(domain, criteria, CGAL::parameters::no_perturb(),
                                                  CGAL::parameters::no_exude());
  if (complex.number_of_cells_in_complex() == 0) throw GeometryError("Mesh_3 found no inside of the surface");
  return collect(complex);
}

}  // namespace ostia::meshing
