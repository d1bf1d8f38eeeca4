#pragma once
/// \file The images of a heart's phases: where they lie, and which of them are held in memory.

#include "ostia/core/task_context.h"
#include "ostia/imaging/dicom.h"
#include "ostia/session/beating.h"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ostia::session {

/// The image of one phase, not read yet.
struct PhaseSource {
  double phase = 0.0;                          ///< share of the cycle, [0, 1)
  std::filesystem::path file;                  ///< an image file, or
  std::optional<imaging::DicomSeries> series;  ///< of a DICOM folder
};

/// "35 %", "35%", "35pct", or else the last number of a name without its ending: phase_35.nrrd is 0.35.
/// Nothing for a name without a number from 0 to 100 (100 is 0).
std::optional<double> phase_of_name(const std::string& name);
/// Of several labels of imaging::DicomSeries::phase, in the same order: percents as they are, trigger times
/// against the cycle that their even steps make, "phase 3 of 10" as 20 %. Empty where they are none of these.
/// Throws InvalidInput for trigger times that begin half a step after the R peak or later: a part of a cycle.
std::vector<double> phases_of_labels(const std::vector<std::string>& labels);

/// The images in a folder by phase, rising: image files (.nrrd .mhd .mha .nii .nii.gz) by their names, else
/// those one folder down by their folders' (phase-35/image00.nrrd), else DICOM series by the percent of the
/// cycle in their files, those that were told apart by the heart's phase, or whose descriptions have a
/// percent. Throws InvalidInput that names the folder's trouble (no image with a phase, two of one phase),
/// IoError.
std::vector<PhaseSource> find_phase_images(const std::filesystem::path& folder,
                                           const core::TaskContext& task = core::no_task());
/// Reads one. Throws what the readers throw.
PhaseImage read_phase_image(const PhaseSource& source, const core::TaskContext& task = core::no_task());

/// Which images are held: those nearest to the phase that is shown, as many as the budget has room for; at
/// least the nearest one. No reading here: `wanted` says what to read, `take` is given it.
class PhaseImages {
 public:
  static constexpr std::size_t default_budget = std::size_t{2} << 30U;  ///< bytes
  explicit PhaseImages(std::vector<PhaseSource> sources, std::size_t budget_bytes = default_budget);
  const std::vector<PhaseSource>& sources() const { return sources_; }
  /// The source that is nearest to a phase in time, whether it is held or not.
  std::size_t nearest(double phase) const;
  /// Null where it is not held.
  std::shared_ptr<const PhaseImage> held(std::size_t source) const { return held_[source]; }
  /// Of the sources that are not held and did not fail, the one to read next while `phase` is shown: the
  /// nearest, as long as it has room with those that are nearer. Nothing where all that has room is held.
  std::optional<std::size_t> wanted(double phase) const;
  /// Holds it; what is farther from `phase` than all that has room goes.
  void take(std::size_t source, PhaseImage image, double phase);
  void failed(std::size_t source) { failed_[source] = true; }  ///< is not wanted again
  std::size_t bytes() const;                                   ///< that are held

 private:
  std::vector<std::size_t> by_distance(double phase) const;
  std::vector<PhaseSource> sources_;
  std::size_t budget_;
  std::vector<std::shared_ptr<const PhaseImage>> held_;
  std::vector<bool> failed_;
  std::size_t one_image_ = 0;  // bytes of the largest that was taken
};

}  // namespace ostia::session
