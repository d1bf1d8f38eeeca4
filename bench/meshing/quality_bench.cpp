// Second order, the quality of all elements, and the forecast.
#include "shape_tree.h"

#include "ostia/geometry/mixed_mesh_split.h"
#include "ostia/meshing/mesh_forecast.h"
#include "ostia/meshing/mixed_quality.h"
#include "ostia/meshing/quadratic.h"

#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include <cmath>
#include <numbers>

namespace ostia::meshing {
namespace {

using geometry::MixedMesh;
using geometry::Vec3;

constexpr double radius = 1.5;
constexpr std::int32_t layers = 4;

/// A disc's points: `rings` of them, 6 k points on the k-th.
std::int32_t ring_start(std::int32_t ring) {
  return ring == 0 ? 0 : 1 + 3 * ring * (ring - 1);
}

std::vector<geometry::Triangle> disc_triangles(std::int32_t rings) {
  std::vector<geometry::Triangle> triangles;
  for (std::int32_t k = 1; k <= rings; ++k)
    for (std::int32_t sector = 0; sector < 6; ++sector)
      for (std::int32_t i = 0; i < k; ++i) {
        const auto outer = [&](std::int32_t n) { return ring_start(k) + (sector * k + n) % (6 * k); };
        const auto inner = [&](std::int32_t n) {
          return k == 1 ? 0 : ring_start(k - 1) + (sector * (k - 1) + n) % (6 * (k - 1));
        };
        triangles.push_back({inner(i), outer(i), outer(i + 1)});
        if (i + 1 < k) triangles.push_back({inner(i), outer(i + 1), inner(i + 1)});
      }
  return triangles;
}

struct Tube {
  std::int32_t rings, slices;
  std::int32_t around() const { return 6 * rings; }
  std::int32_t in_slice() const { return ring_start(rings + 1); }
  double step() const { return 2.0 * std::numbers::pi * radius / around(); }
  double core() const { return radius - 0.5 * step(); }
  /// The i-th point on the rim of the core's slice s.
  std::int32_t rim(std::int32_t s, std::int32_t i) const {
    return s * in_slice() + ring_start(rings) + i % around();
  }
};

Vec3 on_circle(double r, std::int32_t i, std::int32_t of, double z) {
  const double angle = 2.0 * std::numbers::pi * i / of;
  return {r * std::cos(angle), r * std::sin(angle), z};
}

void add(MixedMesh& mesh, const geometry::Triangle& t, std::int32_t id) {
  mesh.triangles.push_back(t);
  mesh.triangle_face_ids.push_back(id);
}

void add(MixedMesh& mesh, const geometry::Quad& q, std::int32_t id) {
  mesh.quads.push_back(q);
  mesh.quad_face_ids.push_back(id);
}

/// Slices of prisms, each cut into three tetrahedra.
MixedMesh core_of(const Tube& tube) {
  MixedMesh mesh;
  for (std::int32_t s = 0; s <= tube.slices; ++s)
    for (std::int32_t k = 0; k <= tube.rings; ++k)
      for (std::int32_t i = 0; i < std::max(1, 6 * k); ++i)
        mesh.points.push_back(
            on_circle(tube.core() * k / tube.rings, i, std::max(1, 6 * k), s * tube.step()));
  const std::int32_t top = tube.slices * tube.in_slice();
  for (const auto& [a, b, c] : disc_triangles(tube.rings)) {
    for (std::int32_t low = 0; low < top; low += tube.in_slice()) {
      const std::int32_t high = low + tube.in_slice();
      mesh.prisms.push_back({low + a, low + b, low + c, high + a, high + b, high + c});
    }
    add(mesh, geometry::Triangle{a, c, b}, 2);
    add(mesh, geometry::Triangle{top + a, top + b, top + c}, 3);
  }
  for (std::int32_t s = 0; s < tube.slices; ++s)
    for (std::int32_t i = 0; i < tube.around(); ++i)
      add(mesh, {tube.rim(s, i), tube.rim(s, i + 1), tube.rim(s + 1, i + 1), tube.rim(s + 1, i)}, 1);
  mesh.faces = {{1, "wall", geometry::FaceKind::wall},
                {2, "inlet_tube", geometry::FaceKind::inlet},
                {3, "outlet_tube", geometry::FaceKind::outlet}};
  return geometry::split_prisms(mesh);
}

/// A tube of tetrahedra with four layers of prisms at its wall.
MixedMesh layered_tube(const Tube& tube) {
  MixedMesh mesh = core_of(tube);
  const auto core_points = static_cast<std::int32_t>(mesh.points.size());
  const std::int32_t in_layer = tube.around() * (tube.slices + 1);
  // The k-th layer's point over a point of the rim, which is layer 0.
  const auto layer = [&](std::int32_t k, std::int32_t rim_point) {
    const std::int32_t s = rim_point / tube.in_slice(),
                       i = rim_point % tube.in_slice() - ring_start(tube.rings);
    return k == 0 ? rim_point : core_points + (k - 1) * in_layer + s * tube.around() + i;
  };
  for (std::int32_t k = 1; k <= layers; ++k)
    for (std::int32_t s = 0; s <= tube.slices; ++s)
      for (std::int32_t i = 0; i < tube.around(); ++i)
        mesh.points.push_back(
            on_circle(tube.core() + (radius - tube.core()) * k / layers, i, tube.around(), s * tube.step()));
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    if (mesh.triangle_face_ids[f] != 1) continue;
    const auto [a, b, c] = mesh.triangles[f];
    for (std::int32_t k = 0; k < layers; ++k)
      mesh.prisms.push_back(
          {layer(k, a), layer(k, b), layer(k, c), layer(k + 1, a), layer(k + 1, b), layer(k + 1, c)});
    mesh.triangles[f] = {layer(layers, a), layer(layers, b), layer(layers, c)};
  }
  for (std::int32_t k = 0; k < layers; ++k)
    for (std::int32_t i = 0; i < tube.around(); ++i)
      for (const std::int32_t s : {0, tube.slices}) {
        const std::int32_t p = tube.rim(s, i), q = tube.rim(s, i + 1);
        const std::int32_t a = layer(k, p), b = layer(k, q), c = layer(k + 1, q), d = layer(k + 1, p);
        if (s == 0)
          add(mesh, {a, b, c, d}, 2);
        else
          add(mesh, {a, d, c, b}, 3);
      }
  return mesh;
}

geometry::TriMesh cylinder(double length_mm) {
  return geometry::structured_surface(geometry::straight_tube(length_mm, radius).tubes[0], 400, 0.5);
}

double peak_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

void second_order(benchmark::State& state, std::int32_t rings, std::int32_t slices) {
  const MixedMesh linear = layered_tube({rings, slices});
  const double length = linear.points.back().z();
  const geometry::TriMesh reference = cylinder(length);
  QuadraticReport report;
  MixedQuality quality;
  for (auto _ : state) {
    const QuadraticMesh made = make_quadratic(linear, reference);
    quality = mixed_quality(made.mesh);
    report = made.report;
  }
  state.counters["tetrahedra"] = static_cast<double>(quality.tetrahedra.count);
  state.counters["prisms"] = static_cast<double>(quality.prisms.count);
  state.counters["nodes"] = static_cast<double>(quality.points);
  state.counters["inverted"] = static_cast<double>(quality.inverted());
  state.counters["boundary_mismatches"] = static_cast<double>(quality.boundary_mismatches);
  state.counters["min_jacobian_ratio"] = report.min_jacobian_ratio;
  state.counters["moved_back"] = static_cast<double>(report.moved_back);
  state.counters["peak_mb"] = peak_mb();
}

void quality_of_linear(benchmark::State& state, std::int32_t rings, std::int32_t slices) {
  const MixedMesh linear = layered_tube({rings, slices});
  MixedQuality quality;
  for (auto _ : state) quality = mixed_quality(linear);
  state.counters["elements"] = static_cast<double>(quality.tetrahedra.count + quality.prisms.count);
  state.counters["inverted"] = static_cast<double>(quality.inverted());
  state.counters["peak_mb"] = peak_mb();
}

void forecast_coronary(benchmark::State& state) {
  const geometry::AnalyticShape shape = geometry::coronary_like_tree();
  const geometry::VesselTree tree = tree_of(shape);
  const geometry::FacedSurface surface{geometry::surface_of(shape, 0.195, true), {}, {}};
  ForecastOptions options;
  options.tree = &tree;
  options.layers = BoundaryLayerOptions{};
  MeshForecast forecast;
  for (auto _ : state) forecast = mesh_forecast(surface, options);
  state.counters["triangles"] = static_cast<double>(surface.mesh.triangles.size());
  state.counters["places"] = static_cast<double>(forecast.places.size());
  state.SetLabel(forecast.summary());
}

}  // namespace

BENCHMARK(forecast_coronary)
    ->Name("forecast of 100k triangles, sized by the tree, with layers")
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK_CAPTURE(quality_of_linear, 0, 12, 140)
    ->Name("quality of 0.4M linear elements")
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK_CAPTURE(second_order, 0, 12, 140)
    ->Name("second order and its quality, 0.4M elements")
    ->Unit(benchmark::kSecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Iterations(1);
BENCHMARK_CAPTURE(second_order, 1, 20, 280)
    ->Name("second order and its quality, 2.3M elements")
    ->Unit(benchmark::kSecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Iterations(1);

}  // namespace ostia::meshing
