#include "ostia/meshing/boundary_layer.h"

#include "boundary_layer/columns.h"

#include "ostia/core/error.h"
#include "ostia/meshing/quality.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <numeric>

namespace ostia::meshing {

using geometry::Vec3;

std::array<double, 9> prism_jacobian_coefficients(const PrismCorners& p) {
  const Vec3 u0 = p[1] - p[0], v0 = p[2] - p[0], u1 = p[4] - p[3], v1 = p[5] - p[3];
  const std::array<Vec3, 3> areas{u0.cross(v0), 0.5 * (u0.cross(v1) + u1.cross(v0)), u1.cross(v1)};
  std::array<double, 9> coefficients{};
  for (std::size_t level = 0; level < 3; ++level)
    for (std::size_t corner = 0; corner < 3; ++corner)
      coefficients[3 * level + corner] = areas[level].dot(p[corner + 3] - p[corner]);
  return coefficients;
}

double prism_volume(const PrismCorners& p) {
  const std::array<double, 9> c = prism_jacobian_coefficients(p);
  return std::accumulate(c.begin(), c.end(), 0.0) / 18.0;
}

double prism_scaled_jacobian(const PrismCorners& p) {
  double least = 2.0;
  for (std::size_t i = 0; i < 6; ++i) {
    const std::size_t base = i < 3 ? 0 : 3, j = base + (i + 1) % 3, k = base + (i + 2) % 3;
    const Vec3 side = p[i % 3 + 3] - p[i % 3], a = p[j] - p[i], b = p[k] - p[i];
    const double lengths = a.norm() * b.norm() * side.norm();
    least = std::min(least, lengths > 0.0 ? 2.0 / std::numbers::sqrt3 * a.cross(b).dot(side) / lengths : 0.0);
  }
  return least;
}

void validate(const BoundaryLayerOptions& o) {
  auto in = [](double value, double low, double high, const std::string& name) {
    if (!(value >= low && value <= high))
      throw InvalidInput("boundary layers: " + name + " " + std::to_string(value) + " must lie in [" +
                         std::to_string(low) + ", " + std::to_string(high) + "]");
  };
  in(o.layers, 1, 20, "layers");
  if (!(o.thickness > 0.0 && o.thickness <= 3.0))
    throw InvalidInput("boundary layers: thickness " + std::to_string(o.thickness) +
                       " must lie in (0, 3] times the local edge");
  in(o.growth, 1.0, 3.0, "growth");
  if (!(o.largest_fraction_of_radius > 0.0 && o.largest_fraction_of_radius <= 0.8))
    throw InvalidInput("boundary layers: largest_fraction_of_radius " +
                       std::to_string(o.largest_fraction_of_radius) + " must lie in (0, 0.8]");
  in(o.gradation, 0.05, 2.0, "gradation");
  in(o.min_scaled_jacobian, 0.01, 0.5, "min_scaled_jacobian");
  in(o.min_angle_deg, 0.0, 30.0, "min_angle_deg");
  in(o.max_rounds, 1, 10000, "max_rounds");
}

namespace {

std::string warning_text(const char* format, double a, double b) {
  char buffer[160];
  std::snprintf(buffer, sizeof buffer, format, a, b);
  return buffer;
}

/// As much of the thickness as there is room for.
void fit_into_room(Columns& columns, const core::TaskContext& task) {
  const double fraction = columns.options.largest_fraction_of_radius;
  std::vector<double> most;
  for (const double wanted : columns.wanted_mm) most.push_back(wanted / fraction);
  const std::vector<double> radii = room(columns.wall, columns.directions, most, task);
  for (std::size_t i = 0; i < radii.size(); ++i)
    if (radii[i] < most[i]) columns.shares[i] = radii[i] / most[i];
  limit_shares(columns.wall, columns.wanted_mm, columns.options.gradation, columns.shares);
}

void add_elements(const Columns& columns, BoundaryLayer& layer) {
  const LayerWall& wall = columns.wall;
  const auto n = static_cast<std::int32_t>(wall.mesh.points.size());
  const auto layers = static_cast<std::int32_t>(columns.options.layers);
  for (std::int32_t k = 0; k <= layers; ++k)
    for (std::int32_t v = 0; v < n; ++v) layer.points.push_back(columns.at(v, static_cast<std::size_t>(k)));
  for (const geometry::Triangle& t : wall.mesh.triangles)
    for (std::int32_t k = 0; k < layers; ++k) {
      const std::int32_t out = k * n, in = (k + 1) * n;
      layer.prisms.push_back({in + t[0], in + t[1], in + t[2], out + t[0], out + t[1], out + t[2]});
    }
  for (const WallRing& ring : wall.rings)
    for (std::size_t i = 0; i < ring.loop.size(); ++i)
      for (std::int32_t k = 0; k < layers; ++k) {
        const std::int32_t a = ring.loop[i], b = ring.loop[(i + 1) % ring.loop.size()];
        layer.quads.push_back({k * n + b, k * n + a, (k + 1) * n + a, (k + 1) * n + b});
        layer.quad_face_ids.push_back(ring.cap.id);
      }
}

/// Points thinner than all around them, the relatively thinnest first.
std::vector<ThinPlace> thin_places(const Columns& columns) {
  std::vector<std::size_t> minima;
  const std::vector<double>& share = columns.shares;
  for (std::size_t i = 0; i < share.size(); ++i) {
    bool least = share[i] < 1.0;
    for (const std::int32_t u : columns.wall.neighbours[i]) {
      const auto j = static_cast<std::size_t>(u);
      least = least && (share[i] < share[j] || (share[i] == share[j] && i < j));
    }
    if (least) minima.push_back(i);
  }
  std::stable_sort(minima.begin(), minima.end(),
                   [&](std::size_t a, std::size_t b) { return share[a] < share[b]; });
  constexpr std::size_t most = 10;
  if (minima.size() > most) minima.resize(most);
  std::vector<ThinPlace> places;
  for (const std::size_t i : minima)
    places.push_back({columns.wall.mesh.points[i], share[i] * columns.wanted_mm[i], columns.wanted_mm[i]});
  return places;
}

void judge_elements(const BoundaryLayer& layer, BoundaryLayerReport& report) {
  report.prisms = layer.prisms.size();
  report.min_scaled_jacobian = 2.0;
  for (const geometry::Prism& prism : layer.prisms) {
    PrismCorners p;
    for (std::size_t i = 0; i < 6; ++i) p[i] = layer.points[static_cast<std::size_t>(prism[i])];
    const std::array<double, 9> c = prism_jacobian_coefficients(p);
    if (!(*std::min_element(c.begin(), c.end()) > 0.0)) ++report.inverted;
    const double quality = prism_scaled_jacobian(p);
    report.min_scaled_jacobian = std::min(report.min_scaled_jacobian, quality);
    report.mean_scaled_jacobian += quality / static_cast<double>(layer.prisms.size());
  }
}

void judge_thickness(const Columns& columns, BoundaryLayerReport& report) {
  double full = 0.0, all = 0.0;
  for (const geometry::Triangle& t : columns.wall.mesh.triangles) {
    const Vec3& a = columns.wall.point(t[0]);
    const double area = (columns.wall.point(t[1]) - a).cross(columns.wall.point(t[2]) - a).norm();
    for (const std::int32_t v : t)
      if (columns.shares[static_cast<std::size_t>(v)] >= 1.0) full += area / 3.0;
    all += area;
  }
  report.full_share = std::min(1.0, full / all);  // thirds do not add up to the bit
  report.wanted_mm = columns.wanted_mm;
  for (std::size_t i = 0; i < columns.shares.size(); ++i)
    report.thickness_mm.push_back(columns.shares[i] * columns.wanted_mm[i]);
  report.thin_places = thin_places(columns);
}

void add_warnings(const Columns& columns, BoundaryLayerReport& report) {
  if (!report.thin_places.empty()) {
    const ThinPlace& place = report.thin_places[0];
    report.warnings.push_back("the layers are thinner than asked on " +
                              warning_text("%.3g %% of the wall", 100.0 * (1.0 - report.full_share), 0.0) +
                              ", where there is no room or prisms would be badly shaped; most so near " +
                              place_text(place.point) + ": " +
                              warning_text("%.3g of %.3g mm", place.thickness_mm, place.wanted_mm));
  }
  const double bound = columns.options.min_scaled_jacobian;
  if (report.min_scaled_jacobian >= bound) return;
  std::size_t worst = 0;
  for (std::size_t f = 0; f < columns.wall.mesh.triangles.size(); ++f)
    if (columns.quality(f) < columns.quality(worst)) worst = f;
  report.warnings.push_back("the wall folds so sharply, or has such a needle, near " +
                            place_text(columns.wall.point(columns.wall.mesh.triangles[worst][0])) +
                            ", that prisms there have a scaled Jacobian of " +
                            warning_text("%.3f at any thickness, less than %.3g; smooth or remesh it",
                                         report.min_scaled_jacobian, bound));
}

}  // namespace

BoundaryLayer boundary_layer(const geometry::FacedSurface& surface, const BoundaryLayerOptions& options,
                             const core::TaskContext& task) {
  validate(options);
  task.set_stage("boundary layers");
  const LayerWall wall = layer_wall(surface);
  task.throw_if_cancelled();
  task.set_progress(0.1);
  Columns columns(wall, sight_cones(wall), options);
  task.set_progress(0.2);
  fit_into_room(columns, task);
  task.set_progress(0.4);
  BoundaryLayer layer;
  layer.report.rounds = make_valid(columns, task.sub(0.4, 0.95));
  add_elements(columns, layer);
  layer.wall = wall.mesh;
  layer.wall_face_ids = wall.face_ids;
  layer.inner = columns.inner();
  layer.inner.faces = surface.faces;
  layer.report.min_inner_angle_deg = surface_quality(layer.inner.mesh, false).min_angle_deg;
  judge_elements(layer, layer.report);
  judge_thickness(columns, layer.report);
  add_warnings(columns, layer.report);
  task.set_progress(1.0);
  return layer;
}

namespace {

/// The prisms need the inner surface as it is: TetGen alone keeps it.
TetrahedralizedVolume fill_inside(const geometry::FacedSurface& inner, TetrahedralizeOptions how,
                                  const core::TaskContext& task) {
  if (how.mesher == Mesher::mesh3)
    throw InvalidInput(
        "layers of prisms cannot be filled by Mesh_3, which meshes the surface anew; take TetGen, or no "
        "layers");
  how.mesher = Mesher::tetgen;
  const std::string way_out = "; inside layers of prisms: take fewer or thinner layers";
  try {
    return tetrahedralize(inner, how, task);
  } catch (const GeometryError& error) {
    throw GeometryError(error.what() + way_out);
  } catch (const ResourceError& error) {
    throw ResourceError(error.what() + way_out);
  }
}

}  // namespace

FilledWithLayers fill_with_layers(const geometry::FacedSurface& surface, const BoundaryLayerOptions& options,
                                  const TetrahedralizeOptions& inside, const core::TaskContext& task) {
  validate(inside);
  BoundaryLayer layer = boundary_layer(surface, options, task.sub(0.0, 0.3));
  TetrahedralizedVolume filled = fill_inside(layer.inner, inside, task.sub(0.3, 1.0));
  const auto n = static_cast<std::int32_t>(layer.wall.points.size());
  const auto on_layers = static_cast<std::int32_t>(layer.points.size());
  // The inner wall's points are the last layer's; those inside caps and in the volume come after the layers.
  auto number = [&](std::int32_t v) { return v < n ? on_layers - n + v : on_layers + v - n; };

  FilledWithLayers result;
  geometry::MixedMesh& mesh = result.mesh;
  mesh.points = std::move(layer.points);
  mesh.points.insert(mesh.points.end(), filled.mesh.points.begin() + n, filled.mesh.points.end());
  mesh.tetrahedra = std::move(filled.mesh.tetrahedra);
  for (geometry::Tetrahedron& t : mesh.tetrahedra)
    for (std::int32_t& v : t) v = number(v);
  mesh.prisms = std::move(layer.prisms);
  mesh.triangles = std::move(layer.wall.triangles);
  mesh.triangle_face_ids = std::move(layer.wall_face_ids);
  for (std::size_t i = mesh.triangles.size(); i < layer.inner.mesh.triangles.size(); ++i) {
    geometry::Triangle t = layer.inner.mesh.triangles[i];
    for (std::int32_t& v : t) v = number(v);
    mesh.triangles.push_back(t);
    mesh.triangle_face_ids.push_back(layer.inner.face_ids[i]);
  }
  mesh.quads = std::move(layer.quads);
  mesh.quad_face_ids = std::move(layer.quad_face_ids);
  mesh.faces = surface.faces;
  result.layers = std::move(layer.report);
  result.tetrahedra = std::move(filled.report);
  return result;
}

}  // namespace ostia::meshing
