#include "ostia/meshing/field_sizing.h"

#include "boundary_layer_shapes.h"
#include "sizing/hessian_recovery.h"
#include "tetrahedra_samples.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/meshing/boundary_layer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <numeric>
#include <string>

namespace ostia::meshing {
namespace {

using geometry::Vec3;
using ::testing::HasSubstr;

MeshField at_nodes(const geometry::MixedMesh& mesh, const std::function<double(const Vec3&)>& f) {
  MeshField field;
  for (const Vec3& p : mesh.points) field.values.push_back(f(p));
  return field;
}

MeshField at_centroids(const geometry::MixedMesh& mesh, const std::function<double(const Vec3&)>& f) {
  MeshField field;
  field.at_elements = true;
  const auto add = [&](const auto& element) {
    Vec3 sum = Vec3::Zero();
    for (const std::int32_t v : element) sum += mesh.points[static_cast<std::size_t>(v)];
    field.values.push_back(f(sum / static_cast<double>(element.size())));
  };
  for (const auto& t : mesh.tetrahedra) add(t);
  for (const auto& p : mesh.prisms) add(p);
  return field;
}

const geometry::FacedSurface& tube_surface() {
  static const auto made = remeshed(geometry::straight_tube(12.0, 1.5), 0.3, 0.3);
  return made;
}
const geometry::MixedMesh& tube() {
  static const auto made = geometry::mixed(tetrahedralize(tube_surface()).mesh);
  return made;
}
const geometry::MixedMesh& layered_tube() {
  static const auto made = [] {
    BoundaryLayerOptions options;
    options.layers = 3;
    options.thickness = 0.5;
    return fill_with_layers(tube_surface(), options).mesh;
  }();
  return made;
}

/// 3 x^2 - y^2 + 2 y z + x z, whose second derivatives are the same everywhere.
double quadratic(const Vec3& p) {
  return 7.0 + p.x() - 2.0 * p.z() + 3.0 * p.x() * p.x() - p.y() * p.y() + 2.0 * p.y() * p.z() +
         p.x() * p.z();
}
constexpr Symmetric3 hessian_of_quadratic{6.0, -2.0, 0.0, 2.0, 1.0, 0.0};

void expect_exact(const geometry::MixedMesh& mesh, const MeshField& field) {
  const auto hessians = recovered_hessians(mesh, ring_of(mesh), field, core::no_task());
  double worst = 0.0;
  for (const Symmetric3& h : hessians)
    for (std::size_t k = 0; k < 6; ++k) worst = std::max(worst, std::abs(h[k] - hessian_of_quadratic[k]));
  EXPECT_LT(worst, 1e-6);
}

TEST(FieldSizing, RecoversTheHessianOfAQuadraticFieldExactly) {
  expect_exact(geometry::mixed(random_box(5, 1)), at_nodes(geometry::mixed(random_box(5, 1)), quadratic));
  expect_exact(tube(), at_nodes(tube(), quadratic));
  expect_exact(tube(), at_centroids(tube(), quadratic));
  expect_exact(layered_tube(), at_nodes(layered_tube(), quadratic));
  expect_exact(layered_tube(), at_centroids(layered_tube(), quadratic));
}

TEST(FieldSizing, TheLargestCurvatureIsTheEigenvalueOfLargestSize) {
  EXPECT_NEAR(largest_curvature({1.0, -5.0, 2.0, 0.0, 0.0, 0.0}), 5.0, 1e-12);
  EXPECT_NEAR(largest_curvature({0.0, 0.0, 0.0, 0.0, 0.0, 3.0}), 3.0, 1e-12);
}

TEST(FieldSizing, LengthsAreWhatTheErrorAllows) {
  const auto mesh = tube();
  const auto field = at_nodes(mesh, [](const Vec3& p) { return 2.0 * p.z() * p.z(); });
  FieldSizingOptions options;
  options.most_refinement = 0.05;
  options.error_share = 1e-4;
  const FieldSizing made = sizes_from_field(mesh, field, options);
  // The ends are cut one radius inside.
  EXPECT_NEAR(made.range, 2.0 * (10.5 * 10.5 - 1.5 * 1.5), 1e-6);
  EXPECT_DOUBLE_EQ(made.target_error, 1e-4 * made.range);
  // 3/16 h^2 4 = e
  const double edge = std::sqrt(16.0 / 3.0 * made.target_error / 4.0);
  for (const double got : made.sizes.edge_mm) EXPECT_NEAR(got, edge, 1e-4 * edge);
  EXPECT_NEAR(made.reached_error, made.target_error, 1e-3 * made.target_error);
  EXPECT_DOUBLE_EQ(made.refined_share, 1.0);
  EXPECT_DOUBLE_EQ(made.held_share, 0.0);
}

TEST(FieldSizing, VectorsHaveTheNormOfTheirComponentsCurvatures) {
  const auto mesh = tube();
  MeshField field;
  field.components = 3;
  for (const Vec3& p : mesh.points)
    for (const double factor : {2.0, -3.0, 6.0}) field.values.push_back(0.5 * factor * p.z() * p.z());
  FieldSizingOptions options;
  options.most_refinement = 0.05;
  options.error_share = 2e-4;
  const FieldSizing made = sizes_from_field(mesh, field, options);
  const double edge = std::sqrt(16.0 / 3.0 * made.target_error / 7.0);
  for (const double got : made.sizes.edge_mm) EXPECT_NEAR(got, edge, 1e-4 * edge);
}

TEST(FieldSizing, ALinearFieldRefinesNothing) {
  const auto mesh = layered_tube();
  const FieldSizing made = sizes_from_field(mesh, at_nodes(mesh, [](const Vec3& p) { return 3.0 * p.z(); }));
  EXPECT_EQ(made.refined_share, 0.0);
  EXPECT_NEAR(made.elements, made.elements_before, 0.02 * made.elements_before);
  for (std::size_t i = 0; i < made.sizes.edge_mm.size(); ++i) {
    EXPECT_LE(made.sizes.edge_mm[i], made.old_edge_mm[i] * (1.0 + 1e-12));
    EXPECT_GE(made.sizes.edge_mm[i], made.old_edge_mm[i] * 0.95);
  }
}

// A jet's shear layer, tanh((r - r0) / d): its second derivative is largest, 4 / (3 sqrt 3) / d^2, where
// tanh^2 is 1/3, at r0 -+ 0.658 d.
constexpr double jet_radius_mm = 0.75, layer_mm = 0.2;
double jet(const Vec3& p) {
  return -std::tanh((std::hypot(p.x(), p.y()) - jet_radius_mm) / layer_mm);
}

TEST(FieldSizing, FindsAJetsLayerAndItsThickness) {
  const auto mesh =
      geometry::mixed(tetrahedralize(remeshed(geometry::straight_tube(4.2, 1.5), 0.15, 0.067)).mesh);
  FieldSizingOptions options;
  options.error_share = 0.0015;
  options.gradation = 2.0;
  options.most_refinement = 0.1;
  const FieldSizing made = sizes_from_field(mesh, at_nodes(mesh, jet), options);
  const double steepest = 4.0 / (3.0 * std::sqrt(3.0)) / (layer_mm * layer_mm);
  const double shortest = std::sqrt(16.0 / 3.0 * made.target_error / steepest);
  double least = 1.0, place = 0.0, in_core = 0.0;
  std::size_t nodes_in_core = 0;
  for (std::size_t i = 0; i < made.sizes.points.size(); ++i) {
    const double r = std::hypot(made.sizes.points[i].x(), made.sizes.points[i].y());
    if (made.sizes.edge_mm[i] < least) least = made.sizes.edge_mm[i], place = r;
    if (r < 0.1) in_core += made.sizes.edge_mm[i] / made.old_edge_mm[i], ++nodes_in_core;
  }
  EXPECT_NEAR(least, shortest, 0.15 * shortest);
  EXPECT_NEAR(std::abs(place - jet_radius_mm), 0.658 * layer_mm, 0.08);
  ASSERT_GT(nodes_in_core, 10U);
  EXPECT_GT(in_core / static_cast<double>(nodes_in_core), 0.9);
}

TEST(FieldSizing, GrowthInTheVolumeIsBounded) {
  const auto mesh = tube();
  FieldSizingOptions options;
  options.error_share = 1e-3;
  options.most_refinement = 0.05;
  options.gradation = 0.2;
  const FieldSizing made = sizes_from_field(
      mesh, at_nodes(mesh, [](const Vec3& p) { return std::exp(-(p - Vec3(0, 0, 6)).squaredNorm() / 0.2); }),
      options);
  EXPECT_GT(made.refined_share, 0.02);
  EXPECT_LT(made.refined_share, 0.6);
  const MeshRing ring = ring_of(mesh);
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
    for (std::size_t k = ring.first_node[i]; k < ring.first_node[i + 1]; ++k) {
      const auto j = static_cast<std::size_t>(ring.nodes[k]);
      EXPECT_LE(made.sizes.edge_mm[i],
                made.sizes.edge_mm[j] + 0.2 * (mesh.points[i] - mesh.points[j]).norm() + 1e-12);
    }
}

TEST(FieldSizing, BoundsHold) {
  const auto mesh = tube();
  const auto field = at_nodes(mesh, jet);
  FieldSizingOptions options;
  options.error_share = 1e-6;
  const FieldSizing halved = sizes_from_field(mesh, field, options);
  EXPECT_GT(halved.held_share, 0.3);
  for (std::size_t i = 0; i < halved.sizes.edge_mm.size(); ++i)
    EXPECT_GE(halved.sizes.edge_mm[i], 0.5 * halved.old_edge_mm[i] * 0.9);
  options.min_edge_mm = 0.3;
  const FieldSizing bounded = sizes_from_field(mesh, field, options);
  for (std::size_t i = 0; i < bounded.sizes.edge_mm.size(); ++i)
    EXPECT_GE(bounded.sizes.edge_mm[i], std::min(0.3, 0.9 * bounded.old_edge_mm[i]));
  options.error_share = 1.0;
  options.min_edge_mm = 0.0;
  options.most_coarsening = 3.0;
  options.max_edge_mm = 0.9;
  const FieldSizing coarse = sizes_from_field(mesh, field, options);
  EXPECT_LT(coarse.elements, 0.6 * coarse.elements_before);
  for (const double edge : coarse.sizes.edge_mm) EXPECT_LE(edge, 0.9);
}

std::size_t elements_of(const geometry::MixedMesh& mesh) {
  return mesh.tetrahedra.size() + mesh.prisms.size();
}

/// Surface and inside meshed anew with the lengths.
geometry::MixedMesh meshed_with(const FieldSizing& made, bool layers) {
  const auto shape = geometry::straight_tube(12.0, 1.5);
  const geometry::FacedSurface input = capped(shape, 0.3, false);
  SizingOptions sizing;
  sizing.edge_ratio = 0.3;
  sizing.field = std::make_shared<SizeField>(made.sizes);
  const auto surface =
      remesh(input, target_edge_lengths(input.mesh, TubeFunction(tree_of(shape)), sizing)).surface;
  TetrahedralizeOptions inside;
  inside.field = sizing.field;
  if (!layers) return geometry::mixed(tetrahedralize(surface, inside).mesh);
  BoundaryLayerOptions options;
  options.layers = 3;
  options.thickness = 0.5;
  return fill_with_layers(surface, options, inside).mesh;
}

/// A jet that is there from the middle on.
double half_jet(const Vec3& p) {
  return jet(p) / (1.0 + std::exp(-4.0 * (p.z() - 6.0)));
}

TEST(FieldSizing, TheMesherMakesAsManyElementsAsForetold) {
  for (const bool layers : {false, true}) {
    const geometry::MixedMesh& mesh = layers ? layered_tube() : tube();
    FieldSizingOptions options;
    options.elements = 2.5 * static_cast<double>(elements_of(mesh));
    const FieldSizing made = sizes_from_field(mesh, at_nodes(mesh, half_jet), options);
    EXPECT_NEAR(made.elements, *options.elements, 0.01 * *options.elements);
    const geometry::MixedMesh fine = meshed_with(made, layers);
    const double got = static_cast<double>(elements_of(fine));
    EXPECT_NEAR(got, made.elements, 0.2 * made.elements)
        << "layers " << layers << ", before " << made.elements_before;
  }
}

TEST(FieldSizing, NothingToRefineMakesAsManyElementsAgain) {
  for (const bool layers : {false, true}) {
    const geometry::MixedMesh& mesh = layers ? layered_tube() : tube();
    const FieldSizing made = sizes_from_field(mesh, at_nodes(mesh, [](const Vec3& p) { return p.z(); }));
    const double before = static_cast<double>(elements_of(mesh));
    EXPECT_NEAR(static_cast<double>(elements_of(meshed_with(made, layers))), before, 0.15 * before)
        << "layers " << layers;
  }
}

TEST(FieldSizing, TheSameForAnyNumberOfThreads) {
  const auto mesh = tube();
  const auto field = at_nodes(mesh, jet);
  const auto many = sizes_from_field(mesh, field);
  core::set_max_threads(1);
  const auto one = sizes_from_field(mesh, field);
  core::set_max_threads(0);
  EXPECT_EQ(one.sizes.edge_mm, many.sizes.edge_mm);
  EXPECT_EQ(one.elements, many.elements);
}

TEST(FieldSizing, MoreElementsThanOneRoundMakesAreTold) {
  const auto mesh = tube();
  FieldSizingOptions options;
  options.elements = 100.0 * static_cast<double>(elements_of(mesh));
  const auto made = sizes_from_field(mesh, at_nodes(mesh, quadratic), options);
  ASSERT_EQ(made.warnings.size(), 1U);
  EXPECT_THAT(made.warnings[0], HasSubstr("out of reach in one round"));
  EXPECT_LT(made.elements, 9.0 * made.elements_before);
}

std::string refusal(const geometry::MixedMesh& mesh, const MeshField& field,
                    const FieldSizingOptions& options = {}) {
  try {
    sizes_from_field(mesh, field, options);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "";
}

TEST(FieldSizing, BadInputIsNamed) {
  const auto mesh = tube();
  auto field = at_nodes(mesh, jet);
  FieldSizingOptions options;
  options.error_share = 0.0;
  EXPECT_THAT(refusal(mesh, field, options), HasSubstr("share of the field's range"));
  options = {};
  options.elements = 3.0;
  EXPECT_THAT(refusal(mesh, field, options), HasSubstr("100 or more"));
  options = {};
  options.min_edge_mm = 2.0;
  options.max_edge_mm = 1.0;
  EXPECT_THAT(refusal(mesh, field, options), HasSubstr("max_edge_mm"));
  field.values[5] = std::nan("");
  EXPECT_THAT(refusal(mesh, field), HasSubstr("not finite at node 5"));
  field.values.pop_back();
  EXPECT_THAT(refusal(mesh, field), HasSubstr("numbers for"));
  EXPECT_THAT(refusal({}, {}), HasSubstr("no tetrahedra"));
}

TEST(FieldSizing, CanBeCancelled) {
  const core::TaskContext task;
  task.cancel();
  EXPECT_THROW(sizes_from_field(tube(), at_nodes(tube(), jet), {}, task), Cancelled);
}

}  // namespace
}  // namespace ostia::meshing
