#include "marching_cubes.h"
#include "open_ends.h"

#include "ostia/core/error.h"
#include "ostia/geometry/analytic_shapes.h"
#include "ostia/geometry/zero_crossing.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostia::geometry {
namespace {

// Exact vertices stay this far (in grid steps) from the grid's nodes: shorter edges help nobody.
constexpr double exact_clearance = 0.05;
constexpr std::int64_t block = 8;

/// Samples the distance on a grid, only near the surface: it changes by no more than a step's length in a
/// step.
class Sampling {
 public:
  Sampling(const AnalyticShape& shape, const TubeDistance& f, double spacing_mm) : f_(f), h_(spacing_mm) {
    if (!(spacing_mm > 0.0) || !std::isfinite(spacing_mm)) {
      throw InvalidInput("the spacing of the surface is " + std::to_string(spacing_mm) +
                         " mm; it must be above 0");
    }
    // Off the round numbers where axes and ends like to lie, so that no grid node is on the surface by
    // design.
    origin_ = shape.box.min() - spacing_mm * Vec3(0.137, 0.259, 0.381);
    for (int a = 0; a < 3; ++a) {
      size_[static_cast<std::size_t>(a)] =
          static_cast<std::int64_t>(std::ceil((shape.box.max()[a] - origin_[a]) / spacing_mm)) + 1;
    }
  }

  const std::array<std::int64_t, 3>& size() const { return size_; }

  Vec3 at(std::int64_t i, std::int64_t j, std::int64_t k) const {
    return origin_ + h_ * Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k));
  }

  void fill(std::int64_t first, std::int64_t count, float* out) const {
    const auto [nx, ny, nz] = size_;
    for (std::int64_t j = 0; j < ny; j += block) {
      for (std::int64_t i = 0; i < nx; i += block) {
        fill_block({i, j, first}, {std::min(i + block, nx), std::min(j + block, ny), first + count}, first,
                   out);
      }
    }
  }

 private:
  using Index = std::array<std::int64_t, 3>;

  void fill_block(const Index& from, const Index& to, std::int64_t first_slice, float* out) const {
    const Vec3 low = at(from[0], from[1], from[2]), high = at(to[0] - 1, to[1] - 1, to[2] - 1);
    const double middle = f_(0.5 * (low + high));
    // One step beyond the block's nodes too: no edge that leaves the block is crossed.
    const bool far = std::abs(middle) > 0.5 * (high - low).norm() + 2.0 * h_;
    for (std::int64_t k = from[2]; k < to[2]; ++k) {
      for (std::int64_t j = from[1]; j < to[1]; ++j) {
        float* row = out + size_[0] * (j + size_[1] * (k - first_slice));
        for (std::int64_t i = from[0]; i < to[0]; ++i)
          row[i] = static_cast<float>(far ? middle : f_(at(i, j, k)));
      }
    }
  }

  const TubeDistance& f_;
  double h_;
  Vec3 origin_;
  Index size_{};
};

/// The zero of f between two points of opposite sign, as a fraction.
double root_fraction(const TubeDistance& f, const Vec3& a, const Vec3& b) {
  return zero_crossing([&](double t) { return f(a + t * (b - a)); });
}

/// Follows the gradient, whose length is one, to the surface; false where creases keep it from arriving.
bool project(const TubeDistance& f, Vec3& p, double reach) {
  const Vec3 start = p;
  for (int iteration = 0; iteration < 30; ++iteration) {
    const TubeDistance::Nearest nearest = f.nearest(p);
    if (std::abs(nearest.distance) < 1e-12) return (p - start).norm() <= reach;
    p -= nearest.distance * (p - nearest.axis_point).normalized();
  }
  return false;
}

/// The crossing of an edge, on the surface: on the edge itself, but where that is next to a node on the
/// surface beside it.
Vec3 exact_crossing(const TubeDistance& f, const Vec3& a, const Vec3& b) {
  const double t = root_fraction(f, a, b);
  const double inner = std::clamp(t, exact_clearance, 1.0 - exact_clearance);
  if (inner != t) {
    Vec3 p = a + inner * (b - a);
    if (project(f, p, 2.0 * exact_clearance * (b - a).norm())) return p;
  }
  return a + t * (b - a);
}

TriMesh marched(const AnalyticShape& shape, double spacing_mm, bool open_ends, bool exact) {
  const TubeDistance f(shape);
  const Sampling sampling(shape, f, spacing_mm);
  MarchingCubes job;
  job.size = sampling.size();
  job.fill = [&](std::int64_t first, std::int64_t count, float* out) { sampling.fill(first, count, out); };
  job.place = [&](const CrossedEdge& e) -> Vec3 {
    const Vec3 a = sampling.at(e.node[0], e.node[1], e.node[2]);
    Vec3 b = a;
    b[e.axis] += spacing_mm;
    return exact ? exact_crossing(f, a, b) : Vec3(a + crossing_fraction(e.from, e.to, 0.0f) * (b - a));
  };
  TriMesh mesh = march(job, core::no_task());
  if (open_ends) {
    for (const FreeEnd& end : free_ends(shape)) cut_flat(mesh, end, f, spacing_mm, exact);
  }
  return mesh;
}

}  // namespace

TriMesh surface_of(const AnalyticShape& shape, double spacing_mm, bool open_ends) {
  return marched(shape, spacing_mm, open_ends, true);
}

TriMesh raw_surface_of(const AnalyticShape& shape, double spacing_mm, bool open_ends) {
  return marched(shape, spacing_mm, open_ends, false);
}

TriMesh structured_surface(const AnalyticTube& tube, int around, double step_mm) {
  if (around < 3) {
    throw InvalidInput("a structured surface has " + std::to_string(around) +
                       " vertices a ring; it needs at least 3");
  }
  if (!(step_mm > 0.0)) {
    throw InvalidInput("the step of the structured surface is " + std::to_string(step_mm) +
                       " mm; it must be above 0");
  }
  const Centerline& axis = tube.axis;
  const TubeDistance f(AnalyticShape{{tube}, Box3()});
  const bool closed = (axis.points.front() - axis.points.back()).norm() < 1e-9;
  const double length = axis.abscissa.back();
  const auto pieces =
      std::max<std::size_t>(closed ? 3 : 1, static_cast<std::size_t>(std::ceil(length / step_mm - 1e-9)));
  const std::size_t rings = closed ? pieces : pieces + 1;
  const auto n = static_cast<std::size_t>(around);
  TriMesh mesh;
  for (std::size_t ring = 0, i = 0; ring < rings; ++ring) {
    const double s = length * static_cast<double>(ring) / static_cast<double>(pieces);
    while (i + 2 < axis.size() && axis.abscissa[i + 1] <= s) ++i;
    const double t = std::clamp((s - axis.abscissa[i]) / (axis.abscissa[i + 1] - axis.abscissa[i]), 0.0, 1.0);
    const Vec3 centre = (1.0 - t) * axis.points[i] + t * axis.points[i + 1];
    const double reach = 2.0 * ((1.0 - t) * axis.radius[i] + t * axis.radius[i + 1]);
    const Vec3 tangent = ((1.0 - t) * axis.frames[i].tangent + t * axis.frames[i + 1].tangent).normalized();
    Vec3 normal = (1.0 - t) * axis.frames[i].normal + t * axis.frames[i + 1].normal;
    normal = (normal - normal.dot(tangent) * tangent).normalized();
    const Vec3 binormal = tangent.cross(normal);
    for (int v = 0; v < around; ++v) {
      const double angle = 2.0 * std::numbers::pi * v / around;
      const Vec3 far = centre + reach * (std::cos(angle) * normal + std::sin(angle) * binormal);
      mesh.points.push_back(centre + root_fraction(f, centre, far) * (far - centre));
    }
  }
  const auto index = [&](std::size_t ring, std::size_t v) {
    return static_cast<std::int32_t>((ring % rings) * n + v % n);
  };
  for (std::size_t ring = 0; ring < pieces; ++ring) {
    for (std::size_t v = 0; v < n; ++v) {
      const std::int32_t a = index(ring, v), b = index(ring, v + 1), c = index(ring + 1, v + 1),
                         d = index(ring + 1, v);
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, d});
    }
  }
  return mesh;
}

}  // namespace ostia::geometry
