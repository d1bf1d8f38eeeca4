#include "ostia/session/calcium_board.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace ostia::session {

void CalciumBoard::take(CalciumReading reading, const std::filesystem::path& case_file) {
  std::optional<CaseFile> file;
  std::error_code ignored;
  if (std::filesystem::exists(case_file, ignored)) {
    if (file_ && path_ == case_file) file_.reset();  // one program opens it once
    file = CaseFile::open(case_file, can_be_edited(case_file) ? OpenMode::read_write : OpenMode::read_only);
    file->check_image(reading.reference);
  }
  reading_ = std::move(reading);
  path_ = case_file;
  file_ = std::move(file);
  recount();
  chosen.set(0);
}

void CalciumBoard::close() {
  reading_.reset();
  file_.reset();
  score_ = {};
  ++revision_;
  chosen.set(0);
  changed.tell();
}

void CalciumBoard::recount() {
  analysis::CalciumScore score = reading_->scored->score;
  if (file_) {
    const auto places = places_said(file_->annotations()->report.calcium, score.lesions);
    score = analysis::with_places(std::move(score), places);
  }
  score_ = std::move(score);
  ++revision_;
  changed.tell();
}

const analysis::CalciumLesion* CalciumBoard::lesion(int number) const {
  const auto found = std::find_if(score_.lesions.begin(), score_.lesions.end(),
                                  [&](const analysis::CalciumLesion& one) { return one.number == number; });
  return found == score_.lesions.end() ? nullptr : &*found;
}

int CalciumBoard::lesion_at(const geometry::Vec3& place, double reach_mm) const {
  if (!reading_) return 0;
  const imaging::Volume<std::int32_t>& numbers = reading_->scored->lesion_numbers;
  const imaging::Geometry& grid = numbers.geometry;
  const geometry::Vec3 at = grid.index(place);
  if (!at.allFinite()) return 0;
  std::array<std::int64_t, 3> low{}, high{};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    const double last = static_cast<double>(grid.size[k] - 1);
    const double reach = std::max(reach_mm / grid.spacing[axis], 0.5);
    low[k] = static_cast<std::int64_t>(std::clamp(std::ceil(at[axis] - reach), 0.0, last + 1.0));
    high[k] = static_cast<std::int64_t>(std::clamp(std::floor(at[axis] + reach), -1.0, last));
  }
  int nearest = 0;
  double least = std::numeric_limits<double>::max();
  for (std::int64_t k = low[2]; k <= high[2]; ++k)
    for (std::int64_t j = low[1]; j <= high[1]; ++j)
      for (std::int64_t i = low[0]; i <= high[0]; ++i) {
        const std::int32_t number = numbers(i, j, k);
        if (number == 0) continue;
        const geometry::Vec3 index(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k));
        const geometry::Vec3 off = (index - at).cwiseProduct(grid.spacing);
        // In its own voxel it is at the lesion, however large voxels are.
        const bool within = (index - at).cwiseAbs().maxCoeff() <= 0.5;
        const double mm = within ? 0.0 : off.norm();
        if (mm <= reach_mm && mm < least) least = mm, nearest = number;
      }
  return nearest;
}

bool CalciumBoard::is_of(const std::shared_ptr<const imaging::ImageVolume>& image) const {
  return reading_ && image && reading_->scan == image;
}

void CalciumBoard::say(int number, analysis::CalciumPlace place) {
  const analysis::CalciumLesion* said = lesion(number);
  if (said == nullptr)
    throw InvalidInput("there is no lesion " + std::to_string(number) +
                       " of calcium; choose one of the list");
  if (said->assigned && said->place == place) return;
  if (!file_) {
    std::filesystem::create_directories(path_.parent_path());
    file_ = CaseFile::create(path_, {}, reading_->reference);
  }
  file_->set_author(author_);
  file_->annotate(SetCalciumPlaces{with_word(file_->annotations()->report.calcium, {said->centre, place})});
  recount();
}

bool CalciumBoard::can_undo() const {
  return file_ && file_->editable() && file_->next_undo().has_value();
}

bool CalciumBoard::can_redo() const {
  return file_ && file_->editable() && file_->next_redo().has_value();
}

bool CalciumBoard::undo() {
  if (!file_ || !file_->undo()) return false;
  recount();
  return true;
}

bool CalciumBoard::redo() {
  if (!file_ || !file_->redo()) return false;
  recount();
  return true;
}

}  // namespace ostia::session
