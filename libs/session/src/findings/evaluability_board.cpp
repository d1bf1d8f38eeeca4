#include "ostia/session/evaluability_board.h"

#include "known_vessels.h"

#include <utility>

namespace ostia::session {

EvaluabilityWork::Found EvaluabilityWork::found(const core::TaskContext& task) const {
  Found out;
  out.noise_hu = noise_hu ? *noise_hu : noise_about(*model, *image);
  out.vessel = vessel_evaluability(
      *model, [this](std::int32_t one) { return walls.at(one); }, vessel, *image, out.noise_hu, {}, task);
  return out;
}

EvaluabilityBoard::EvaluabilityBoard(Workbench& bench) : bench_(bench) {
  own_.push_back(bench.model_changed.observe([this](const ModelEvent& event) {
    if (event.tree_changed) {
      keep_known(known_, bench_, event);
      return changed.tell();
    }
    for (const lumen::LiveChange::OfVessel& one : event.change.vessels)
      if (const auto found = known_.find(one.vessel); found != known_.end()) found->second.stale = true;
  }));
  own_.push_back(bench.case_changed.observe([this] { drop(); }));
  own_.push_back(bench.image_changed.observe([this] {
    noise_hu_.reset();
    drop();
  }));
  own_.push_back(bench.annotations_changed.observe([this] { changed.tell(); }));
}

void EvaluabilityBoard::drop() {
  if (known_.empty()) return;
  known_.clear();
  changed.tell();
}

std::vector<analysis::EvaluableStretch> EvaluabilityBoard::stretches(std::int32_t vessel) const {
  if (!bench_.has_case() || !bench_.axis(vessel)) return {};
  const auto found = known_.find(vessel);
  const analysis::EvaluableStretch whole{lumen::own_from_mm(bench_.model()->tree, vessel),
                                         bench_.axis(vessel)->length(),
                                         analysis::Evaluability::not_evaluable,
                                         {},
                                         false};
  return judged_over(
      found != known_.end() ? found->second.stretches : std::vector<analysis::EvaluableStretch>{},
      find_mark(*bench_.session().file().annotations(), vessel), whole);
}

std::optional<EvaluabilityWork> EvaluabilityBoard::work() const {
  const lumen::LumenModel* model = bench_.model();
  if (!model || !bench_.image().volume) return std::nullopt;
  const auto unknown = [this](std::int32_t vessel) {
    const auto found = known_.find(vessel);
    return found == known_.end() || found->second.stale;
  };
  std::int32_t wanted = bench_.vessel.get();
  if (wanted == Workbench::no_vessel || !unknown(wanted)) {
    wanted = Workbench::no_vessel;
    for (const geometry::Vessel& vessel : model->tree.vessels)
      if (wanted == Workbench::no_vessel && unknown(vessel.id)) wanted = vessel.id;
  }
  if (wanted == Workbench::no_vessel) return std::nullopt;
  return EvaluabilityWork{bench_.session().file().model(), bench_.session().solved_walls(),
                          bench_.image().volume, wanted, noise_hu_};
}

bool EvaluabilityBoard::take(const EvaluabilityWork& work, std::optional<EvaluabilityWork::Found> found) {
  if (!bench_.has_case() || bench_.session().file().model() != work.model ||
      bench_.image().volume != work.image)
    return false;
  Known& known = known_[work.vessel];
  known.stale = false;
  known.length_mm = bench_.axis(work.vessel)->length();
  known.stretches = found ? std::move(found->vessel.stretches) : std::vector<analysis::EvaluableStretch>{};
  if (found) noise_hu_ = found->noise_hu;
  changed.tell();
  return true;
}

void EvaluabilityBoard::judge(std::int32_t vessel, double from_mm, double to_mm,
                              std::optional<analysis::Evaluability> grade) {
  VesselMark mark = mark_or_new(*bench_.session().file().annotations(), vessel);
  bench_.annotate(MarkVessel{with_evaluability(std::move(mark), from_mm, to_mm, grade)});
}

}  // namespace ostia::session
