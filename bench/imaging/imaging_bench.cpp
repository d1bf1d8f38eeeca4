#include "shared_data.h"

#include "ostia/imaging/dicom.h"
#include "ostia/imaging/dicom_writer.h"
#include "ostia/imaging/filters.h"
#include "ostia/imaging/image_file.h"
#include "ostia/imaging/sampling.h"
#include "ostia/imaging/series_preview.h"

#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include <cmath>

namespace ostia::imaging {
namespace {

/// A smooth image with some texture: 256 x 256 x 128 voxels (8.4 million) of 0.4 x 0.4 x 0.5 mm.
const ImageVolume& image() {
  static const ImageVolume made = [] {
    ImageVolume volume;
    volume.geometry.size = {256, 256, 128};
    volume.geometry.spacing = Vec3(0.4, 0.4, 0.5);
    volume.voxels.resize(static_cast<std::size_t>(volume.geometry.voxels()));
    std::uint32_t state = 1;
    for (std::size_t i = 0; i < volume.voxels.size(); ++i) {
      state = state * 1664525U + 1013904223U;
      volume.voxels[i] = static_cast<std::int16_t>(300.0 * std::sin(1e-4 * static_cast<double>(i)) +
                                                   static_cast<double>(state >> 27));
    }
    return volume;
  }();
  return made;
}

void count_voxels(benchmark::State& state, std::size_t voxels) {
  state.SetItemsProcessed(static_cast<std::int64_t>(voxels) * static_cast<std::int64_t>(state.iterations()));
}

void bm_sample(benchmark::State& state) {
  const auto how = static_cast<Interpolation>(state.range(0));
  double sum = 0.0;
  for (auto _ : state)
    for (int i = 0; i < 100000; ++i)
      sum += sample(image(), Vec3(20.0 + 1e-4 * i, 90.0 - 5e-4 * i, 5.0 + 5e-4 * i), how);
  benchmark::DoNotOptimize(sum);
  count_voxels(state, 100000);
}
BENCHMARK(bm_sample)->Arg(0)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond);

void bm_sample_gradient(benchmark::State& state) {
  const auto how = static_cast<Interpolation>(state.range(0));
  Vec3 sum = Vec3::Zero();
  for (auto _ : state)
    for (int i = 0; i < 100000; ++i)
      sum += sample_gradient(image(), Vec3(20.0 + 1e-4 * i, 90.0 - 5e-4 * i, 5.0 + 5e-4 * i), how);
  benchmark::DoNotOptimize(sum);
  count_voxels(state, 100000);
}
BENCHMARK(bm_sample_gradient)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond);

void bm_resampled(benchmark::State& state) {
  Geometry grid = image().geometry;
  grid.spacing *= 0.99;
  for (auto _ : state)
    benchmark::DoNotOptimize(
        resampled(image(), grid, static_cast<Interpolation>(state.range(0)), std::int16_t{0}));
  count_voxels(state, image().voxels.size());
}
BENCHMARK(bm_resampled)->Arg(0)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();

void bm_gaussian_blurred(benchmark::State& state) {
  FloatVolume floats{image().geometry, std::vector<float>(image().voxels.begin(), image().voxels.end())};
  for (auto _ : state)
    benchmark::DoNotOptimize(gaussian_blurred(floats, 0.1 * static_cast<double>(state.range(0))));
  count_voxels(state, image().voxels.size());
}
BENCHMARK(bm_gaussian_blurred)->Arg(4)->Arg(10)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();

void bm_write(benchmark::State& state, const char* name) {
  const std::filesystem::path path = testing::temporary_folder("bench") / name;
  for (auto _ : state) write_image(path, image());
  count_voxels(state, image().voxels.size());
}
BENCHMARK_CAPTURE(bm_write, nrrd, "a.nrrd")->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();
BENCHMARK_CAPTURE(bm_write, mha, "a.mha")->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();

void bm_read(benchmark::State& state, const char* name) {
  const std::filesystem::path path = testing::temporary_folder("bench") / name;
  write_image(path, image());
  for (auto _ : state) benchmark::DoNotOptimize(read_image(path));
  count_voxels(state, image().voxels.size());
}
BENCHMARK_CAPTURE(bm_read, nrrd, "a.nrrd")->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();
BENCHMARK_CAPTURE(bm_read, mha, "a.mha")->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();

/// A series of 512 x 512 x 300 slices in a folder with nothing else.
const std::filesystem::path& large_series() {
  static const std::filesystem::path folder = [] {
    ImageVolume volume;
    volume.geometry.size = {512, 512, 300};
    volume.geometry.spacing = Vec3(0.35, 0.35, 0.45);
    volume.voxels.resize(static_cast<std::size_t>(volume.geometry.voxels()));
    std::uint32_t state = 1;
    for (std::int16_t& voxel : volume.voxels) {
      state = state * 1664525U + 1013904223U;
      voxel = static_cast<std::int16_t>(static_cast<int>(state >> 21) - 1000);
    }
    const auto path = testing::temporary_folder("series") / "images";
    write_dicom_series(path, volume);
    return path;
  }();
  return folder;
}

/// Largest memory so far, in MiB: of this process with its image, and of the largest child.
void tell_memory(benchmark::State& state) {
  struct rusage own {
  }, children{};
  getrusage(RUSAGE_SELF, &own);
  getrusage(RUSAGE_CHILDREN, &children);
  state.counters["own_mib"] = static_cast<double>(own.ru_maxrss) / 1024.0;
  state.counters["child_mib"] = static_cast<double>(children.ru_maxrss) / 1024.0;
}

void first_slice_of_a_series(benchmark::State& state) {
  large_series();
  for (auto _ : state) benchmark::DoNotOptimize(first_slice(scan_dicom(large_series()).series.at(0)));
}
BENCHMARK(first_slice_of_a_series)->Unit(benchmark::kMillisecond)->UseRealTime();

void preview_of_a_series(benchmark::State& state) {
  const DicomSeries series = scan_dicom(large_series()).series.at(0);
  for (auto _ : state) benchmark::DoNotOptimize(preview(series));
}
BENCHMARK(preview_of_a_series)->Unit(benchmark::kMillisecond)->UseRealTime();

void open_dicom_series(benchmark::State& state) {
  large_series();
  for (auto _ : state) {
    const DicomFolder folder = scan_dicom(large_series());
    benchmark::DoNotOptimize(read_dicom_series(folder.series.at(0)));
  }
  tell_memory(state);
}
BENCHMARK(open_dicom_series)->Unit(benchmark::kMillisecond)->UseRealTime()->Iterations(3);

}  // namespace
}  // namespace ostia::imaging

BENCHMARK_MAIN();
