#pragma once
/// \file A whole synthetic case for benchmarks: 512 x 512 x 300 voxels, everything known.

#include "ostia/imaging/volume.h"
#include "ostia/phantom/phantom_case.h"

#include <filesystem>
#include <string>
#include <vector>

namespace ostia::bench {

/// The first case of `ostia phantom --preset full`, as it is known before its image is made.
const phantom::CasePlan& full_plan();
/// Its folder with image00.nrrd and dicom/, made once by the program (a minute) below $OSTIA_BENCH_CASE and
/// left there for the next time; unset: below a temporary folder. Made by a program of its own, so that the
/// memory it takes is not counted to what is measured. Throws InvalidInput where it cannot be made.
const std::filesystem::path& full_case();
/// Its image, read once.
const imaging::ImageVolume& full_image();

/// What a program took.
struct Finished {
  int code = 0;
  double seconds = 0.0, cpu_seconds = 0.0;
  double peak_mb = 0.0;  ///< of its own resident memory, looked at every 2 ms
  std::string said;      ///< on standard output
};
/// Runs `ostia` with these arguments. Throws InvalidInput where it cannot be started.
Finished run_ostia(const std::vector<std::string>& arguments);

}  // namespace ostia::bench
