#include "ostia/phantom/scan.h"

#include "body/paint.h"
#include "scan/artefacts.h"
#include "scan/iterative_noise.h"
#include "scan/plane_kernel.h"
#include "scan/point_spread.h"
#include "scan/scan_noise.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <deque>
#include <string>

namespace ostia::phantom {
namespace {

using geometry::Vec3;

constexpr std::int64_t slab_slices = 8;
constexpr std::int64_t lanes = 8;  // rows of work slices are longer by so many

void require_range(const char* name, double value, double least, double most, const char* unit) {
  if (!(value >= least && value <= most))
    throw InvalidInput(std::string("scan: ") + name + " is " + std::to_string(value) + unit +
                       "; it must lie in [" + std::to_string(least) + ", " + std::to_string(most) + "]");
}

void require_spread(const char* name, double fwhm_mm, double spacing_mm) {
  require_range(name, fwhm_mm, 0.0, 5.0, " mm");
  if (fwhm_mm > 0.0 && fwhm_mm < 0.5 * spacing_mm)
    throw InvalidInput(std::string("scan: ") + name + " is " + std::to_string(fwhm_mm) +
                       " mm, less than half a voxel of " + std::to_string(spacing_mm) +
                       " mm; ask for 0 to have the voxel's own box, or for a finer grid");
}

/// With tails the core, which is painted, is narrower than the whole.
void require_kernel(const ScanOptions& options) {
  const double base_mm = PlaneKernel(options).base_fwhm_mm(),
               voxel = options.grid.spacing.head<2>().maxCoeff();
  if (base_mm > 0.0 && base_mm < 0.5 * voxel)
    throw InvalidInput("scan: with an undershoot of " + std::to_string(options.realism.undershoot) +
                       " and tails of " + std::to_string(options.realism.tail) + " the kernel's core is " +
                       std::to_string(base_mm) +
                       " mm wide, less than half a voxel; ask for a larger psf_fwhm_mm or less of them");
}

PointSpread point_spread(const ScanOptions& options, double plane_fwhm_mm) {
  const Vec3& spacing = options.grid.spacing;
  return {AxisSpread(plane_fwhm_mm, spacing.x(), options.supersampling),
          AxisSpread(plane_fwhm_mm, spacing.y(), options.supersampling),
          AxisSpread(options.psf_fwhm_z_mm, spacing.z(), options.supersampling)};
}

/// One acquisition: slabs of the painted grid (the asked one and a margin as wide as the blur reaches) are
/// painted one after the other; a slice is finished as soon as all that it sees is there.
class Acquisition {
 public:
  Acquisition(const Scene& scene, const ScanOptions& options, const core::TaskContext& task)
      : options_(options),
        task_(task),
        kernel_(options),
        spread_(point_spread(options, kernel_.base_fwhm_mm())),
        margin_{spread_.reach(0) + kernel_.reach(0) + motion_reach(0),
                spread_.reach(1) + kernel_.reach(1) + motion_reach(1), spread_.reach(2)},
        grid_(with_margin()),
        painter_(scene, options, grid_, margin_),
        motion_(options),
        half_scan_(options),
        streaks_(options),
        noise_(scene, options, task),
        iterative_(options) {}

  Scan run() {
    const auto voxels = static_cast<std::size_t>(options_.grid.voxels());
    scan_.image = {options_.grid, std::vector<std::int16_t>(voxels)};
    scan_.labels = {options_.grid, std::vector<std::uint8_t>(voxels)};
    const std::int64_t slices = grid_.size[2];
    std::int64_t finished = 0;  // of the asked grid
    for (std::int64_t first = 0; first < slices + slab_slices; first += slab_slices) {
      task_.throw_if_cancelled();
      if (first < slices)
        slabs_.push_back(painter_.centres(first, std::min(slab_slices, slices - first), task_));
      // The slab before has all its neighbours now.
      const std::int64_t done = first - slab_slices;
      if (done < 0) continue;
      refine(done);
      const std::int64_t known = std::min(first, slices);
      const std::int64_t ready = std::min(known - 2 * margin_[2], options_.grid.size[2]);
      if (ready > finished) {
        finish(finished, ready);
        finished = ready;
      }
      while (slabs_.size() > 2 && slabs_.front().first + slabs_.front().count <= finished &&
             slabs_[1].first < done)
        slabs_.pop_front();
      task_.set_progress(static_cast<double>(known) / static_cast<double>(slices));
    }
    return std::move(scan_);
  }

 private:
  std::int64_t motion_reach(int axis) const {
    const double path_mm = options_.motion_mm + options_.realism.half_scan_motion_mm;
    return static_cast<std::int64_t>(std::ceil(0.5 * path_mm / options_.grid.spacing[axis]));
  }
  imaging::Geometry with_margin() const {
    imaging::Geometry grid = options_.grid;
    grid.origin = grid.world(-Vec3(static_cast<double>(margin_[0]), static_cast<double>(margin_[1]),
                                   static_cast<double>(margin_[2])));
    for (std::size_t axis = 0; axis < 3; ++axis) grid.size[axis] += 2 * margin_[axis];
    return grid;
  }
  const Slab& slab_of(std::int64_t k) const {
    return *std::find_if(slabs_.begin(), slabs_.end(),
                         [&](const Slab& slab) { return k >= slab.first && k < slab.first + slab.count; });
  }

  /// Partial volumes of a slab, and the blur within its slices.
  void refine(std::int64_t first) {
    const auto at =
        std::find_if(slabs_.begin(), slabs_.end(), [&](const Slab& s) { return s.first == first; });
    const Slab* before = at == slabs_.begin() ? nullptr : &*std::prev(at);
    const Slab* after = std::next(at) == slabs_.end() ? nullptr : &*std::next(at);
    painter_.refine(*at, before, after, task_);
    const std::int64_t plane = grid_.size[0] * grid_.size[1];
    core::parallel_for(static_cast<std::size_t>(at->count), 1, [&](std::size_t k) {
      task_.throw_if_cancelled();
      spread_.blur_in_plane({at->mean_hu.data() + static_cast<std::int64_t>(k) * plane, grid_.size[0],
                             grid_.size[1], grid_.size[0]});
    });
  }

  void finish(std::int64_t first, std::int64_t last) {
    noise_.prepare(first, last, task_);
    core::parallel_for(static_cast<std::size_t>(last - first), 1, [&](std::size_t n) {
      task_.throw_if_cancelled();
      finish_slice(first + static_cast<std::int64_t>(n));
    });
  }

  /// What slice k of the painted grid shows before artefacts and noise.
  void spread_slice(std::int64_t k, const SliceView& out) const {
    const std::int64_t width = grid_.size[0], plane = width * grid_.size[1];
    const int reach = spread_.reach(2);
    for (int d = -reach; d <= reach; ++d) {
      const Slab& slab = slab_of(k + d);
      const float* from = slab.mean_hu.data() + (k + d - slab.first) * plane;
      for (std::ptrdiff_t j = 0; j < out.height; ++j) {
        Eigen::Map<Eigen::ArrayXf, Eigen::Unaligned>(out.row(j), width) +=
            spread_.z().voxel(d) *
            Eigen::Map<const Eigen::ArrayXf, Eigen::Unaligned>(from + j * width, width);
      }
    }
    const auto pieces = static_cast<std::size_t>(std::pow(options_.supersampling, 3) + 0.5);
    for (const Slab& slab : slabs_) {
      if (slab.first + slab.count <= k - reach || slab.first > k + reach) continue;
      for (std::size_t block = 0; block < slab.fine.size(); ++block) {
        for (std::size_t v = 0; v < slab.fine[block].size(); ++v) {
          const FineVoxel& voxel = slab.fine[block][v];
          const auto offset = static_cast<int>(voxel.k - k);
          if (std::abs(offset) > reach) continue;
          spread_.add_pieces({voxel.i, voxel.j, slab.differences[block].data() + v * pieces}, offset, out);
        }
      }
    }
  }
  void finish_slice(std::int64_t k) {
    // Room for the spread of voxels at the painted grid's border.
    const std::int64_t width = grid_.size[0], height = grid_.size[1], room_i = spread_.reach(0),
                       room_j = spread_.reach(1), stride = width + 2 * room_i + lanes;
    std::vector<float> work(static_cast<std::size_t>(stride * (height + 2 * room_j) + lanes), 0.0f);
    const SliceView painted{work.data() + room_j * stride + room_i, width, height, stride};
    spread_slice(k + margin_[2], painted);
    const std::int64_t nx = options_.grid.size[0], ny = options_.grid.size[1];
    kernel_.apply(painted);
    if (!motion_.none()) motion_.blur(painted, margin_[0], margin_[1], k);
    half_scan_.blur(painted, margin_[0], margin_[1], k);
    const SliceView slice{painted.row(margin_[1]) + margin_[0], nx, ny, stride};
    add_beam_hardening(slice, options_.grid.spacing, options_.beam_hardening);
    streaks_.add(slice, k);
    add_noise(slice, k);
    const Slab& slab = slab_of(k + margin_[2]);
    for (std::int64_t j = 0; j < ny; ++j) {
      const auto to = static_cast<std::size_t>(options_.grid.offset(0, j, k));
      for (std::int64_t i = 0; i < nx; ++i)
        scan_.image.voxels[to + static_cast<std::size_t>(i)] =
            static_cast<std::int16_t>(std::lrint(std::clamp(slice.row(j)[i], -1024.0f, 3071.0f)));
      const std::int64_t from =
          margin_[0] + width * (j + margin_[1] + height * (k + margin_[2] - slab.first));
      std::copy_n(slab.labels.begin() + from, nx,
                  scan_.labels.voxels.begin() + static_cast<std::ptrdiff_t>(to));
    }
  }

  void add_noise(const SliceView& slice, std::int64_t k) const {
    if (iterative_.none() || options_.noise_hu <= 0.0) return noise_.add(slice, k);
    std::vector<float> noise(static_cast<std::size_t>(slice.width * slice.height), 0.0f);
    noise_.add({noise.data(), slice.width, slice.height, slice.width}, k);
    iterative_.add(slice, std::move(noise));
  }

  ScanOptions options_;
  core::TaskContext task_;
  PlaneKernel kernel_;
  PointSpread spread_;
  std::array<std::int64_t, 3> margin_;
  imaging::Geometry grid_;
  Painter painter_;
  MotionBlur motion_;
  HalfScanMotion half_scan_;
  ViewStreaks streaks_;
  ScanNoise noise_;
  IterativeNoise iterative_;
  std::deque<Slab> slabs_;
  Scan scan_;
};

}  // namespace

void validate(const ScanOptions& options) {
  for (int axis = 0; axis < 3; ++axis) {
    const std::int64_t size = options.grid.size[static_cast<std::size_t>(axis)];
    if (size < 1 || size > 4096)
      throw InvalidInput("scan: the grid has " + std::to_string(size) + " voxels along axis " +
                         std::to_string(axis) + "; it must have 1 to 4096");
    require_range("the grid's spacing", options.grid.spacing[axis], 0.05, 10.0, " mm");
  }
  if (!options.grid.origin.allFinite() || !options.grid.direction.allFinite() ||
      !options.grid.direction.isUnitary(1e-6))
    throw InvalidInput("scan: the grid's origin or axes are not finite, or its axes not orthonormal");
  if (options.supersampling < 1 || options.supersampling > 8)
    throw InvalidInput("scan: supersampling is " + std::to_string(options.supersampling) +
                       "; it must lie in [1, 8]");
  validate(options.realism);
  require_spread("psf_fwhm_mm", options.psf_fwhm_mm, options.grid.spacing.head<2>().maxCoeff());
  require_kernel(options);
  require_spread("psf_fwhm_z_mm", options.psf_fwhm_z_mm, options.grid.spacing.z());
  require_range("noise_hu", options.noise_hu, 0.0, 500.0, " HU");
  require_range(
      "noise_peak_per_mm", options.noise_peak_per_mm, 0.0,
      options.noise_hu > 0.0 ? std::min(2.0, 0.18 / options.grid.spacing.head<2>().maxCoeff()) : 2.0,
      " cycles/mm");
  if (options.realism.noise_structure > 0.0 && options.noise_hu > 0.0 && options.noise_peak_per_mm <= 0.0)
    throw InvalidInput("scan: noise_structure needs a noise_peak_per_mm above 0");
  require_range("noise_fwhm_z_mm", options.noise_fwhm_z_mm, 0.0, 5.0, " mm");
  require_range("stair_step_mm", options.stair_step_mm, 0.0, 10.0, " mm");
  require_range("stair_block_mm", options.stair_block_mm, 1.0, 500.0, " mm");
  require_range("motion_mm", options.motion_mm, 0.0, 10.0, " mm");
  require_range("moving_radius_mm", options.moving_radius_mm, 0.0, 1000.0, " mm");
  require_range("beam_hardening", options.beam_hardening, 0.0, 5.0, "");
  if (!options.moving_centre.allFinite()) throw InvalidInput("scan: moving_centre is not finite");
}

ScanOptions measured_scan() {
  ScanOptions options;
  options.psf_fwhm_mm = 0.9;
  options.psf_fwhm_z_mm = 0.7;
  options.noise_hu = 34.0;
  options.noise_peak_per_mm = 0.21;
  options.noise_fwhm_z_mm = 0.53;
  options.beam_hardening = 1.0;
  options.realism.noise_structure = 0.7;
  options.realism.undershoot = 0.05;
  options.realism.streaks = 1.0;
  options.realism.mixing = 0.9;
  options.realism.cava_hu = 2000.0;
  return options;
}

Scan acquire(const Scene& scene, const ScanOptions& options, const core::TaskContext& task) {
  validate(options);
  task.throw_if_cancelled();
  task.set_stage("scan");
  return Acquisition(scene, options, task).run();
}

}  // namespace ostia::phantom
