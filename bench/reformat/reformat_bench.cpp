// Curved reformations of 512 x 512 pixels from a CT-sized image (512 x 512 x 300 voxels) with a curved
// vessel.

#include "ostia/core/parallel.h"
#include "ostia/reformat/curved_reformation.h"
#include "ostia/reformat/plane_image.h"

#include <benchmark/benchmark.h>

#include <cmath>
#include <numbers>

namespace {

using namespace ostia;
using geometry::Vec3;

/// A coronary-like course: 128 mm around a quarter of a heart, winding by a few millimetres.
std::shared_ptr<const geometry::AxisCurve> axis() {
  static const auto curve = [] {
    geometry::Centerline line;
    for (int i = 0; i <= 256; ++i) {
      const double t = i / 256.0, angle = 0.15 + 1.9 * t;
      const double wind = 3.0 * std::sin(7.0 * std::numbers::pi * t);
      line.points.emplace_back((52.0 + wind) * std::cos(angle), (52.0 - wind) * std::sin(angle) - 20.0,
                               30.0 - 80.0 * t + 2.0 * wind);
    }
    return std::make_shared<const geometry::AxisCurve>(line);
  }();
  return curve;
}

const imaging::ImageVolume& image() {
  static const imaging::ImageVolume volume = [] {
    imaging::ImageVolume ct;
    ct.geometry.size = {512, 512, 300};
    ct.geometry.spacing = {0.36, 0.36, 0.5};
    ct.geometry.origin = {-92.0, -92.0, -75.0};
    ct.voxels.resize(static_cast<std::size_t>(ct.geometry.voxels()));
    std::uint32_t noise = 1;
    for (std::int16_t& voxel : ct.voxels) {
      noise = noise * 1664525U + 1013904223U;
      voxel = static_cast<std::int16_t>(static_cast<int>(noise >> 23) - 206);
    }
    for (double s = 0.0; s < axis()->length(); s += 0.2) {
      const Vec3 at = ct.geometry.index(axis()->point(s));
      for (int k = -4; k <= 4; ++k)
        for (int j = -5; j <= 5; ++j)
          for (int i = -5; i <= 5; ++i)
            ct(std::lround(at[0]) + i, std::lround(at[1]) + j, std::lround(at[2]) + k) = 400;
    }
    return ct;
  }();
  return volume;
}

reformat::CurvedOptions view_options() {
  reformat::CurvedOptions options;
  options.theta_deg = 30.0;
  options.pixel_mm = 0.25;
  return options;
}

void curved(benchmark::State& state, reformat::CurvedOptions options, imaging::Interpolation how) {
  const imaging::ImageVolume& ct = image();
  core::set_max_threads(2);
  std::size_t inside = 0;
  for (auto _ : state) {
    const reformat::CurvedReformation view(axis(), options);
    const reformat::CurvedImage picture = reformat::reformatted(ct, view, how);
    benchmark::DoNotOptimize(picture.values.data());
    state.PauseTiming();
    inside = 0;
    for (const float value : picture.values) inside += std::isnan(value) ? 0U : 1U;
    state.ResumeTiming();
  }
  core::set_max_threads(0);
  state.counters["inside"] = static_cast<double>(inside) / (512.0 * 512.0);
}

void rotated(benchmark::State& state) {
  const imaging::ImageVolume& ct = image();
  core::set_max_threads(2);
  const reformat::CurvedReformation view(axis(), view_options());
  double theta = 0.0;
  for (auto _ : state) {
    theta += 3.0;
    const reformat::CurvedImage picture = reformat::reformatted(ct, view.rotated(theta));
    benchmark::DoNotOptimize(picture.values.data());
  }
  core::set_max_threads(0);
}

void round_trip(benchmark::State& state, reformat::CurvedMode mode) {
  reformat::CurvedOptions options = view_options();
  options.mode = mode;
  const reformat::CurvedReformation view(axis(), options);
  double row = 0.0;
  for (auto _ : state) {
    row = std::fmod(row + 17.3, 512.0);
    benchmark::DoNotOptimize(view.project(view.world({260.0, row})));
  }
}

void section(benchmark::State& state, reformat::Slab slab) {
  const imaging::ImageVolume& ct = image();
  core::set_max_threads(2);
  double s = 0.0;
  for (auto _ : state) {
    s = std::fmod(s + 1.7, axis()->length());
    const reformat::Plane plane = reformat::cross_section_plane(*axis(), s, 25.6, 0.05);
    const double thick = slab == reformat::Slab::none ? 0.0 : 2.0;
    benchmark::DoNotOptimize(reformat::slab_slice(ct, plane, slab, thick).values.data());
  }
  core::set_max_threads(0);
}

/// A view of three linked planes: 512 x 512 pixels over the whole image, of 20 mm; axial, or turned twice.
void planes(benchmark::State& state, bool oblique, bool draft) {
  const imaging::ImageVolume& ct = image();
  core::set_max_threads(2);
  reformat::Plane plane;
  if (oblique) {
    const Eigen::Matrix3d turned =
        (Eigen::AngleAxisd(0.6, Vec3::UnitX()) * Eigen::AngleAxisd(0.4, Vec3::UnitZ())).toRotationMatrix();
    plane.u = turned.col(0);
    plane.v = turned.col(1);
  }
  plane.width = plane.height = 512;
  plane.pixel_mm = 0.36;
  double depth = -20.0;
  for (auto _ : state) {
    depth = depth > 20.0 ? -20.0 : depth + 0.7;
    plane.origin = depth * plane.normal() - 256.0 * plane.pixel_mm * (plane.u + plane.v);
    const auto made = draft ? reformat::slab_draft(ct, plane, reformat::Slab::maximum, 20.0)
                            : reformat::slab_slice(ct, plane, reformat::Slab::maximum, 20.0);
    benchmark::DoNotOptimize(made.values.data());
  }
  core::set_max_threads(0);
}

benchmark::internal::Benchmark* timed(benchmark::internal::Benchmark* bench) {
  return bench->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();
}

}  // namespace

int main(int argc, char** argv) {
  using imaging::Interpolation;
  reformat::CurvedOptions options = view_options();
  timed(benchmark::RegisterBenchmark("StraightenedTrilinear512", curved, options, Interpolation::trilinear));
  timed(benchmark::RegisterBenchmark("StraightenedCubic512", curved, options, Interpolation::cubic));
  timed(benchmark::RegisterBenchmark("StraightenedRotated512", rotated));
  reformat::CurvedOptions stretched = options;
  stretched.mode = reformat::CurvedMode::stretched;
  timed(benchmark::RegisterBenchmark("Stretched", curved, stretched, Interpolation::trilinear));
  reformat::CurvedOptions thick = options;
  thick.slab = reformat::Slab::maximum;
  thick.slab_mm = 3.0;
  timed(benchmark::RegisterBenchmark("SlabMaximum", curved, thick, Interpolation::trilinear));
  timed(benchmark::RegisterBenchmark("CrossSection512", section, reformat::Slab::none));
  timed(benchmark::RegisterBenchmark("CrossSectionMean2mm512", section, reformat::Slab::mean));
  timed(benchmark::RegisterBenchmark("PlaneMip20mm512Axial", planes, false, false));
  timed(benchmark::RegisterBenchmark("PlaneMip20mm512Oblique", planes, true, false));
  timed(benchmark::RegisterBenchmark("PlaneMip20mm512AxialMoving", planes, false, true));
  timed(benchmark::RegisterBenchmark("PlaneMip20mm512ObliqueMoving", planes, true, true));
  benchmark::RegisterBenchmark("RoundTripStraightened", round_trip, reformat::CurvedMode::straightened);
  benchmark::RegisterBenchmark("RoundTripStretched", round_trip, reformat::CurvedMode::stretched);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
