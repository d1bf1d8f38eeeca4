#pragma once
/// \file The series of one study beside the image on the table: phases of the heart and reconstructions.

#include "ostia/imaging/dicom.h"
#include "ostia/imaging/volume.h"
#include "ostia/session/phase_images.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ostia::session {

/// One image of the study, not read yet.
struct StackEntry {
  PhaseSource source;                                  ///< its phase is 0 where `has_phase` is not set
  bool has_phase = false;                              ///< the phase of the heart is known
  std::string description{};                           ///< for the window alone: never saved
  std::int64_t slices = 0;                             ///< 0: not known before it is read
  geometry::Vec3 spacing_mm = geometry::Vec3::Zero();  ///< as `slices`
  std::size_t bytes = 0;                               ///< in memory; as `slices`
  std::string fault{};                                 ///< why it cannot be read; empty where it may be
  bool uneven = false;                                 ///< needs consent to be read (DicomReadOptions)
};

struct SeriesStack {
  /// Phases rising, then what has none, then what cannot be read.
  std::vector<StackEntry> entries;
  std::optional<std::size_t> own;  ///< the image on the table
  std::size_t of_others = 0;       ///< series of other patients and studies: left out
  std::size_t readable() const;
};

/// Both are of one patient and one study, as far as their files say; where neither says whose it is, the
/// study must be said and the same. What cannot be told is no.
bool same_study(const imaging::DicomSeries& a, const imaging::DicomSeries& b);

/// What lies in the folder of the study of the series `own_uid`. The phase is that of its files, of the label
/// by which it was split, or a percent in its description. Throws InvalidInput where the folder has no such
/// series.
SeriesStack stack_beside(const imaging::DicomFolder& folder, const std::string& own_uid);
/// Of images in files, which say of nobody: the person chose them. `own`: the one whose file it is.
SeriesStack stack_of_files(const std::vector<PhaseSource>& sources, const std::filesystem::path& own);

/// The entries that a cine goes through: one of each phase, rising, of the same voxels as the one on the
/// table (of most, where that has no phase). Below two there is no cine: empty.
std::vector<std::size_t> cine_of(const SeriesStack& stack);

/// The images of a stack that are held in memory, within a bound: whole ones as long as they have room, the
/// last shown longest, and for a cine that has not room for all of them coarser ones of all.
class StackImages {
 public:
  using Image = std::shared_ptr<const imaging::ImageVolume>;
  static constexpr std::size_t default_budget = std::size_t{2} << 30U;  ///< bytes, or a quarter of memory
  static std::size_t usual_budget();                                    ///< the smaller of the two
  /// `bytes`: of each image whole; 0 where it cannot be read. All 0: not known, then as much as the first
  /// that is taken.
  explicit StackImages(const std::vector<std::size_t>& bytes = {}, std::size_t budget = usual_budget());
  std::size_t count() const { return whole_.size(); }
  std::size_t budget() const { return budget_; }
  std::size_t needed() const { return needed_; }  ///< of all, whole
  bool all_fit() const { return needed_ <= budget_; }
  /// An image for the cine may have so many voxels.
  std::int64_t frame_voxels() const;
  Image whole(std::size_t n) const { return whole_.at(n); }         ///< null: not held
  Image frame(std::size_t n) const;                                 ///< whole, else coarser, else null
  void take(std::size_t n, Image image);                            ///< as the last shown
  void take_frame(std::size_t n, Image image);                      ///< as `take` where all fit
  void shown(std::size_t n);                                        ///< is kept longest
  void forget(std::size_t n) { whole_.at(n) = frame_.at(n) = {}; }  ///< it is held elsewhere
  std::size_t held() const;                                         ///< bytes

 private:
  void learn(const Image& image);
  void make_room(std::size_t keep);
  std::vector<Image> whole_, frame_;
  std::vector<std::uint64_t> last_;
  std::uint64_t clock_ = 0;
  std::size_t budget_, needed_ = 0;
};

}  // namespace ostia::session
