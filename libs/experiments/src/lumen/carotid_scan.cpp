#include "ostia/experiments/carotid_scan.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/geometry/aabb_tree.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/phantom/noise.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostia::experiments {
namespace {

using geometry::Vec3;
using Kind = AxisResponse::Kind;
using Matrix = Eigen::MatrixXd;

/// The response of one axis: a point's and, integrated, an edge's.
class Response {
 public:
  Response(const AxisResponse& how, double period_mm) : how_(how), period_(period_mm) {
    // Frequencies m / period below the cut; that of the cut itself, where there is one, counts half.
    const double cut = period_ / (2.0 * how.width_mm);
    last_ = static_cast<int>(std::floor(cut + 1e-9));
    half_ = std::abs(cut - last_) < 1e-6 ? 0.5 : 1.0;
    if (how.kind == Kind::k_space) tabulate();
  }

  double point(double x) const {
    if (how_.kind == Kind::gaussian) {
      const double t = x / sigma();
      return std::exp(-0.5 * t * t) / (sigma() * std::sqrt(2.0 * std::numbers::pi));
    }
    double sum = 1.0;
    for (int m = 1; m <= last_; ++m)
      sum += 2.0 * share(m) * std::cos(2.0 * std::numbers::pi * m * x / period_);
    return sum / period_;
  }

  /// The integral of `point` from some fixed place to x, |x| at most a period.
  double edge(double x) const {
    if (how_.kind == Kind::gaussian) return 0.5 * std::erfc(-x / (sigma() * std::numbers::sqrt2));
    const double at = (x / period_ + 1.0) * 0.5 * (static_cast<double>(table_.size()) - 1.0);
    const auto n = static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(table_.size()) - 2.0));
    const double t = at - static_cast<double>(n);
    return (1.0 - t) * table_[n] + t * table_[n + 1];
  }

 private:
  double sigma() const { return how_.width_mm / 2.3548200450309493; }
  double share(int m) const { return m == last_ ? half_ : 1.0; }

  void tabulate() {
    constexpr int steps_a_wave = 400;  // linear between: wrong by less than 1e-4 of an edge's height
    table_.resize(static_cast<std::size_t>(2 * std::max(1, last_) * steps_a_wave + 1));
    for (std::size_t n = 0; n < table_.size(); ++n) {
      const double x = 2.0 * static_cast<double>(n) / (static_cast<double>(table_.size()) - 1.0) - 1.0;
      double sum = x;
      for (int m = 1; m <= last_; ++m)
        sum += share(m) * std::sin(2.0 * std::numbers::pi * m * x) / (std::numbers::pi * m);
      table_[n] = sum;
    }
  }

  AxisResponse how_;
  double period_;
  int last_ = 0;
  double half_ = 1.0;
  std::vector<double> table_;  ///< of `edge`, from -period to period
};

/// One axis of the scan, in mm from half a voxel before its first voxel.
struct Axis {
  Axis(const SurfaceScanOptions& options, int d)
      : voxels(options.grid.size[d]),
        step(options.grid.spacing[d]),
        response(options.response[static_cast<std::size_t>(d)], length()),
        kind(options.response[static_cast<std::size_t>(d)].kind),
        width(options.response[static_cast<std::size_t>(d)].width_mm) {
    const int parts = static_cast<int>(std::ceil(step / options.fine_mm - 1e-9));
    fine = step / parts;
    cells = voxels * parts;
  }
  double length() const { return static_cast<double>(voxels) * step; }
  double at(std::int64_t voxel) const { return (static_cast<double>(voxel) + 0.5) * step; }

  /// What each cell gives each voxel.
  Matrix cell_weights() const {
    Matrix weights(voxels, cells);
    for (std::int64_t m = 0; m < voxels; ++m) {
      double before = response.edge(at(m));
      for (std::int64_t c = 0; c < cells; ++c) {
        const double after = response.edge(at(m) - static_cast<double>(c + 1) * fine);
        weights(m, c) = before - after;
        before = after;
      }
    }
    return weights;
  }

  /// White noise on the acquired samples to correlated noise of deviation 1 on the voxels.
  Matrix noise_weights() const {
    const double apart = kind == Kind::k_space ? width : step;
    const auto samples = static_cast<std::int64_t>(std::llround(length() / apart));
    Matrix weights(voxels, samples);
    for (std::int64_t m = 0; m < voxels; ++m) {
      for (std::int64_t s = 0; s < samples; ++s)
        weights(m, s) = response.point(at(m) - (static_cast<double>(s) + 0.5) * apart);
    }
    weights.rowwise().normalize();
    return weights;
  }

  std::int64_t voxels;
  double step;
  Response response;
  Kind kind;
  double width;
  double fine = 0.1;
  std::int64_t cells = 0;
};

/// The surface in mm along the grid's axes, from the outer corner of its first voxel.
geometry::TriMesh on_grid(const geometry::TriMesh& surface, const imaging::Geometry& grid) {
  geometry::TriMesh out = surface;
  for (Vec3& p : out.points) p = (grid.index(p) + Vec3::Constant(0.5)).cwiseProduct(grid.spacing);
  return out;
}

/// Adds what lies inside along a line parallel to the first axis.
void add_chords(const geometry::AabbTree& surface, double start, double y, double z, const Axis& axis,
                Eigen::Ref<Eigen::VectorXd> row) {
  const auto hits = surface.all_hits(Vec3(start, y, z), Vec3::UnitX());
  for (std::size_t h = 0; h + 1 < hits.size(); h += 2) {
    const double from = start + hits[h].t, to = start + hits[h + 1].t;
    for (std::int64_t m = 0; m < axis.voxels; ++m)
      row[m] += axis.response.edge(axis.at(m) - from) - axis.response.edge(axis.at(m) - to);
  }
}

using Planes = std::vector<Matrix>;  ///< along the last axis; x down, y across

/// planes[m] = sum over n of weights(m, n) given[n].
Planes along_last(const Planes& given, const Matrix& weights) {
  Planes out(static_cast<std::size_t>(weights.rows()));
  core::parallel_for(out.size(), 1, [&](std::size_t m) {
    out[m] = Matrix::Zero(given.front().rows(), given.front().cols());
    for (std::size_t n = 0; n < given.size(); ++n) {
      const double w = weights(static_cast<Eigen::Index>(m), static_cast<Eigen::Index>(n));
      if (std::abs(w) > 1e-12 && given[n].size() > 0) out[m] += w * given[n];
    }
  });
  return out;
}

Planes share_inside(const geometry::TriMesh& closed, const std::array<Axis, 3>& axes,
                    const core::TaskContext& task) {
  const geometry::AabbTree surface(closed);
  const geometry::Box3 box = geometry::bounds(closed.points);
  const double start = box.min()[0] - 1.0;
  const Matrix across = axes[1].cell_weights().transpose();
  Planes cells(static_cast<std::size_t>(axes[2].cells));
  core::parallel_for(cells.size(), 4, [&](std::size_t k) {
    task.throw_if_cancelled();
    const double z = (static_cast<double>(k) + 0.5) * axes[2].fine;
    Matrix rows = Matrix::Zero(axes[0].voxels, axes[1].cells);
    if (z > box.min()[2] && z < box.max()[2]) {
      for (std::int64_t j = 0; j < axes[1].cells; ++j) {
        const double y = (static_cast<double>(j) + 0.5) * axes[1].fine;
        if (y > box.min()[1] && y < box.max()[1]) add_chords(surface, start, y, z, axes[0], rows.col(j));
      }
    }
    cells[k] = rows * across;
  });
  return along_last(cells, axes[2].cell_weights());
}

Planes noise_of(const std::array<Axis, 3>& axes, std::uint64_t seed) {
  const Matrix x = axes[0].noise_weights();
  const Matrix y = axes[1].noise_weights().transpose();
  const Matrix z = axes[2].noise_weights();
  Planes white(static_cast<std::size_t>(z.cols()));
  core::parallel_for(white.size(), 1, [&](std::size_t k) {
    Eigen::MatrixXf drawn(x.cols(), y.rows());
    const auto count = static_cast<std::size_t>(drawn.size());
    phantom::fill_normal(seed, k * count, {drawn.data(), count});
    white[k] = x * drawn.cast<double>() * y;
  });
  return along_last(white, z);
}

}  // namespace

void validate(const SurfaceScanOptions& o) {
  const auto require = [](bool good, const char* what) {
    if (!good) throw InvalidInput(std::string("scan of a surface: ") + what);
  };
  for (int d = 0; d < 3; ++d) {
    require(o.grid.size[d] >= 4 && o.grid.size[d] <= 4096 && o.grid.spacing[d] > 0.0,
            "the grid needs 4 to 4,096 voxels of a size above 0 along each axis");
    const AxisResponse& r = o.response[static_cast<std::size_t>(d)];
    require(std::isfinite(r.width_mm) && r.width_mm > 0.0, "each response needs a width above 0");
    const double samples = static_cast<double>(o.grid.size[d]) * o.grid.spacing[d] / r.width_mm;
    require(r.kind != Kind::k_space || (samples > 3.5 && std::abs(samples - std::round(samples)) < 1e-6),
            "an axis of k-space must be as long as a whole number of its samples");
  }
  require(std::isfinite(o.inside) && std::isfinite(o.outside) && std::abs(o.inside) < 2e4 &&
              std::abs(o.outside) < 2e4,
          "the signals must be within +-20,000");
  require(o.noise >= 0.0 && o.noise <= 5e3, "noise must be in [0, 5000]");
  require(o.fine_mm > 0.0 && o.fine_mm <= 1.0, "fine_mm must be in (0, 1]");
}

imaging::ImageVolume scan_surface(const geometry::TriMesh& closed, const SurfaceScanOptions& options,
                                  const core::TaskContext& task) {
  validate(options);
  if (closed.triangles.empty() || geometry::find_faults(closed, false).open_edges > 0)
    throw InvalidInput("scan of a surface: it has open edges, so nothing is inside; close it first");
  const std::array<Axis, 3> axes{Axis(options, 0), Axis(options, 1), Axis(options, 2)};
  const Planes share = share_inside(on_grid(closed, options.grid), axes, task);
  Planes real, imaginary;
  if (options.noise > 0.0) real = noise_of(axes, 2 * options.seed);
  if (options.noise > 0.0 && options.magnitude) imaginary = noise_of(axes, 2 * options.seed + 1);
  imaging::ImageVolume image;
  image.geometry = options.grid;
  image.voxels.resize(static_cast<std::size_t>(options.grid.voxels()));
  const auto plane = static_cast<std::size_t>(options.grid.size[0] * options.grid.size[1]);
  core::parallel_for(image.voxels.size(), 65536, [&](std::size_t n) {
    const std::size_t k = n / plane;
    const auto i = static_cast<Eigen::Index>(n % plane);
    double value = options.outside + (options.inside - options.outside) * share[k].data()[i];
    if (!real.empty()) value += options.noise * real[k].data()[i];
    if (options.magnitude)
      value = std::hypot(value, imaginary.empty() ? 0.0 : options.noise * imaginary[k].data()[i]);
    image.voxels[n] = static_cast<std::int16_t>(std::lround(std::clamp(value, -32768.0, 32767.0)));
  });
  return image;
}

}  // namespace ostia::experiments
