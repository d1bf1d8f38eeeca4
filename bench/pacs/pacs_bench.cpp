// A series from an Orthanc on this machine, beside what plain clients take for the same bytes.

#include "local_orthanc.h"
#include "shared_data.h"

#include "ostia/core/files.h"
#include "ostia/imaging/dicom_texts.h"
#include "ostia/imaging/dicom_writer.h"
#include "ostia/pacs/archive.h"

#include <benchmark/benchmark.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <memory>
#include <thread>

namespace ostia::pacs {
namespace {

constexpr int slices = 300, side = 512;

/// An Orthanc that has one CT series of 512 x 512 x 300 voxels (158 MB).
struct Scene {
  testing::LocalOrthanc orthanc;
  SeriesWanted wanted;
  std::filesystem::path folder = testing::temporary_folder("fetched");

  Scene() {
    imaging::ImageVolume image;
    image.geometry.size = {side, side, slices};
    image.geometry.spacing = {0.4, 0.4, 0.5};
    std::uint32_t state = 1;
    image.voxels.resize(static_cast<std::size_t>(side) * side * slices);
    for (std::int16_t& voxel : image.voxels) {
      state = state * 1664525U + 1013904223U;
      voxel = static_cast<std::int16_t>(state >> 22);
    }
    const auto series = testing::temporary_folder("series") / "CT";
    imaging::write_dicom_series(series, image);
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(series)) files.push_back(entry.path());
    imaging::DicomTexts texts{{0x0020000D, {}}, {0x0020000E, {}}};
    imaging::read_dicom_texts(files.front(), texts);
    wanted = {texts[0x0020000D], texts[0x0020000E]};
    for (const SendResult& one : open_archive(orthanc.by_get())->send(files))
      if (one.state != SendState::sent) throw std::runtime_error(one.reason);
  }
};

Scene& scene() {
  static Scene made;
  return made;
}

void count_bytes(benchmark::State& state) {
  state.SetBytesProcessed(static_cast<std::int64_t>(2) * side * side * slices *
                          static_cast<std::int64_t>(state.iterations()));
}

/// Times the whole, and until the first image is there.
void fetch(benchmark::State& state, const ServerDescription& server) {
  const auto archive = open_archive(server, scene().orthanc.secrets());
  const auto target = scene().folder / "CT";
  double first_s = 0.0;
  for (auto _ : state) {
    const core::TaskContext task;
    std::atomic<bool> done{false};
    std::thread watching([&] {
      const auto start = std::chrono::steady_clock::now();
      while (!done && task.progress() <= 0.02) std::this_thread::sleep_for(std::chrono::milliseconds(2));
      first_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    });
    archive->fetch(scene().wanted, target, task);
    done = true;
    watching.join();
    state.PauseTiming();
    std::filesystem::remove_all(target);
    state.ResumeTiming();
  }
  state.counters["first_image_s"] = first_s;
  count_bytes(state);
}

void plain(benchmark::State& state, const std::string& command) {
  for (auto _ : state)
    if (std::system(command.c_str()) != 0) state.SkipWithError("the plain client fails");
  count_bytes(state);
}

void bm_fetch_get(benchmark::State& state) {
  fetch(state, scene().orthanc.by_get());
}
void bm_fetch_move(benchmark::State& state) {
  fetch(state, scene().orthanc.by_move());
}
void bm_fetch_web(benchmark::State& state) {
  fetch(state, scene().orthanc.by_web());
}
std::string curl_into(const std::string& body) {
  return "curl -s -f -u 'ostia:open sesame' -H 'Accept: multipart/related; type=\"application/dicom\"; "
         "transfer-syntax=*' -o '" +
         body + "' " + scene().orthanc.by_web().url + "/studies/" + scene().wanted.study_uid + "/series/" +
         scene().wanted.series_uid;
}
/// One file that nobody takes apart.
void bm_plain_curl(benchmark::State& state) {
  plain(state, curl_into((scene().folder / "body").string()));
}
/// The same until it is on the disk, where ours are when a fetch returns.
void bm_plain_curl_synced(benchmark::State& state) {
  const std::string body = (scene().folder / "body").string();
  plain(state, curl_into(body) + " && sync '" + body + "'");
}
void bm_plain_getscu(benchmark::State& state) {
  const ServerDescription server = scene().orthanc.by_get();
  std::filesystem::create_directories(scene().folder / "getscu");
  plain(state, "getscu -q -S -B -aec ORTHANC -aet OSTIA -k QueryRetrieveLevel=SERIES -k StudyInstanceUID=" +
                   scene().wanted.study_uid + " -k SeriesInstanceUID=" + scene().wanted.series_uid +
                   " -od '" + (scene().folder / "getscu").string() + "' 127.0.0.1 " +
                   std::to_string(server.port));
}
BENCHMARK(bm_fetch_get)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(bm_plain_getscu)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(bm_fetch_move)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(bm_fetch_web)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(bm_plain_curl)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(bm_plain_curl_synced)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace ostia::pacs

BENCHMARK_MAIN();
