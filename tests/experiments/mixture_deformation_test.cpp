#include "ostia/experiments/mixture_deformation.h"

#include "moved_tree.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/geometry/thin_plate_spline.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ostia::experiments {
namespace {

using geometry::TriMesh;
using geometry::Vec3;

constexpr DeformationKind kinds[] = {DeformationKind::thin_plate_spline, DeformationKind::gaussian_basis};
constexpr MixtureCost costs[] = {MixtureCost::l2, MixtureCost::kernel_correlation};

const TriMesh& mixture_deformation_tree() {
  static const TriMesh mesh = geometry::surface_of(geometry::coronary_like_tree(), 1.2, false);
  return mesh;
}

MixtureOptions coarse() {
  MixtureOptions options;
  options.depth = 2;
  options.widths_mm = {8.0, 4.0, 2.0, 1.0};
  return options;
}

template <class Motion>
TriMesh moved(TriMesh mesh, const Motion& motion) {
  for (Vec3& p : mesh.points) p = motion(p);
  return mesh;
}

double mean_error(const TriMesh& result, const TriMesh& truth) {
  double sum = 0.0;
  for (std::size_t i = 0; i < truth.points.size(); ++i) sum += (result.points[i] - truth.points[i]).norm();
  return sum / static_cast<double>(truth.points.size());
}

TEST(MixtureDeformation, ThinPlatesFindAnAffineMotion) {
  const TriMesh target = moved(mixture_deformation_tree(), [](const Vec3& p) {
    return Vec3(0.95 * p.x() + 1.0, 0.9 * p.y() + 0.05 * p.x() + 2.0, 1.05 * p.z() - 1.5);
  });
  ASSERT_GT(mean_error(mixture_deformation_tree(), target), 2.0);
  for (const MixtureCost cost : costs) {
    MixtureOptions options = coarse();
    options.cost = cost;
    const MixtureDeformation found = deform_by_mixtures(mixture_deformation_tree(), target, options);
    EXPECT_LT(mean_error(found.surface, target), 0.1);
    EXPECT_TRUE(found.report.converged);
    EXPECT_LT(found.report.cost, 0.05);
  }
}

TEST(MixtureDeformation, AllFourFindASmoothBending) {
  geometry::Box3 box;
  for (const Vec3& p : mixture_deformation_tree().points) box.extend(p);
  std::vector<Vec3> from, to;
  for (int c = 0; c < 8; ++c) {
    from.push_back(box.corner(static_cast<geometry::Box3::CornerType>(c)));
    to.push_back(from.back() + 5.0 * Vec3(std::sin(c), std::cos(2.0 * c), std::sin(3.0 * c)));
  }
  const geometry::ThinPlateSpline bend(from, to);
  const TriMesh target = moved(mixture_deformation_tree(), bend);
  const double before = mean_error(mixture_deformation_tree(), target);
  ASSERT_GT(before, 1.0);
  for (const DeformationKind kind : kinds)
    for (const MixtureCost cost : costs) {
      MixtureOptions options = coarse();
      options.kind = kind;
      options.cost = cost;
      const MixtureDeformation found = deform_by_mixtures(mixture_deformation_tree(), target, options);
      EXPECT_LT(mean_error(found.surface, target), 0.25 * before);
      EXPECT_GT(found.report.iterations, 4);
      EXPECT_GE(found.report.evaluations, found.report.iterations);
    }
}

TEST(MixtureDeformation, OfASurfaceOntoItselfIsRest) {
  for (const DeformationKind kind : kinds) {
    MixtureOptions options = coarse();
    options.kind = kind;
    const MixtureDeformation found =
        deform_by_mixtures(mixture_deformation_tree(), mixture_deformation_tree(), options);
    EXPECT_LT(mean_error(found.surface, mixture_deformation_tree()), 1e-6);
    EXPECT_TRUE(found.report.converged);
    EXPECT_EQ(found.surface.triangles, mixture_deformation_tree().triangles);
  }
}

TEST(MixtureDeformation, TellsThatItWasStopped) {
  MixtureOptions options = coarse();
  options.most_iterations = 2;
  const MixtureDeformation found = deform_by_mixtures(
      mixture_deformation_tree(), motion::testing::moved(mixture_deformation_tree(), 0.3), options);
  EXPECT_FALSE(found.report.converged);
  EXPECT_EQ(found.report.iterations, 8);
}

TEST(MixtureDeformation, DoesNotDependOnThreads) {
  MixtureOptions options = coarse();
  options.most_iterations = 10;
  const TriMesh target = motion::testing::moved(mixture_deformation_tree(), 0.3);
  core::set_max_threads(1);
  const MixtureDeformation one = deform_by_mixtures(mixture_deformation_tree(), target, options);
  core::set_max_threads(2);
  const MixtureDeformation two = deform_by_mixtures(mixture_deformation_tree(), target, options);
  core::set_max_threads(0);
  EXPECT_EQ(one.surface.points, two.surface.points);
}

TEST(MixtureDeformation, RefusesAndCancels) {
  const auto refused = [](auto change) {
    MixtureOptions options;
    change(options);
    EXPECT_THROW(deform_by_mixtures(mixture_deformation_tree(), mixture_deformation_tree(), options),
                 InvalidInput);
  };
  refused([](MixtureOptions& o) { o.depth = 0; });
  refused([](MixtureOptions& o) { o.depth = 5; });
  refused([](MixtureOptions& o) { o.margin = 0.0; });
  refused([](MixtureOptions& o) { o.widths_mm.clear(); });
  refused([](MixtureOptions& o) { o.widths_mm = {1.0, 2.0}; });
  refused([](MixtureOptions& o) { o.widths_mm = {1.0, std::nan("")}; });
  refused([](MixtureOptions& o) { o.stiffness = -1.0; });
  refused([](MixtureOptions& o) { o.basis_width_cells = 0.0; });
  refused([](MixtureOptions& o) { o.most_iterations = 0; });
  refused([](MixtureOptions& o) { o.tolerance = 0.0; });
  EXPECT_THROW(deform_by_mixtures({}, mixture_deformation_tree()), InvalidInput);
  EXPECT_THROW(deform_by_mixtures(mixture_deformation_tree(), {}), InvalidInput);
  core::TaskContext task;
  task.cancel();
  EXPECT_THROW(deform_by_mixtures(mixture_deformation_tree(), mixture_deformation_tree(), coarse(), task),
               Cancelled);
}

}  // namespace
}  // namespace ostia::experiments
