#include "ostia/session/fat_board.h"

#include <utility>

namespace ostia::session {

CaseFat FatWork::found(const core::TaskContext& task) const {
  CaseFatOptions options;
  options.tube_kv = tube_kv;
  return case_fat(
      *model, [this](std::int32_t vessel) { return walls.at(vessel); }, *image, options, task);
}

FatBoard::FatBoard(Workbench& bench) : bench_(bench) {
  own_.push_back(bench.model_changed.observe([this](const ModelEvent&) { drop(); }));
  own_.push_back(bench.case_changed.observe([this] { drop(); }));
  own_.push_back(bench.image_changed.observe([this] { drop(); }));
}

void FatBoard::drop() {
  if (!known_) return;
  known_.reset();
  ++revision_;
  changed.tell();
}

const VesselFat* FatBoard::of_selected() const {
  if (!known_) return nullptr;
  for (const VesselFat& one : known_->vessels)
    if (one.vessel == bench_.vessel.get()) return &one;
  return nullptr;
}

std::optional<FatWork> FatBoard::work() const {
  if (known_ || !bench_.model() || !bench_.image().volume) return std::nullopt;
  return FatWork{bench_.session().file().model(), bench_.session().solved_walls(), bench_.image().volume};
}

bool FatBoard::take(const FatWork& work, CaseFat found) {
  if (!bench_.has_case() || bench_.session().file().model() != work.model ||
      bench_.image().volume != work.image)
    return false;
  known_ = std::move(found);
  ++revision_;
  changed.tell();
  return true;
}

}  // namespace ostia::session
