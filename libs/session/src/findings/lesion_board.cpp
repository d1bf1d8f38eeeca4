#include "ostia/session/lesion_board.h"

#include "known_vessels.h"

#include "ostia/analysis/aha_segments.h"
#include "ostia/session/doubts.h"

#include <algorithm>
#include <utility>

namespace ostia::session {

std::optional<analysis::PlaqueProfile> PlaqueWork::found(const core::TaskContext& task) const {
  const std::shared_ptr<const VesselWalls> shared = known->of(*this, task);
  if (!shared) return std::nullopt;
  return shared->plaque;
}

LesionBoard::LesionBoard(Workbench& bench, EvaluabilityBoard& evaluability, std::shared_ptr<FoundWalls> walls)
    : bench_(bench), evaluability_(evaluability), found_(std::move(walls)) {
  own_.push_back(bench.model_changed.observe([this](const ModelEvent& event) {
    if (event.tree_changed) keep_known(known_, bench_, event);
    for (const lumen::LiveChange::OfVessel& one : event.change.vessels)
      if (const auto found = known_.find(one.vessel); found != known_.end()) found->second.stale = true;
    touch();
  }));
  own_.push_back(bench.case_changed.observe([this] {
    read_certainty();
    drop();
  }));
  own_.push_back(bench.image_changed.observe([this] { drop(); }));
  own_.push_back(bench.annotations_changed.observe([this] { touch(); }));
  own_.push_back(bench.stenoses_changed.observe([this] { touch(); }));
  own_.push_back(evaluability.changed.observe([this] { touch(); }));
  read_certainty();
}

void LesionBoard::read_certainty() {
  certainty_ =
      bench_.has_case() ? kept_certainty(bench_.session().file()) : std::vector<coronary::VesselCertainty>();
}

void LesionBoard::drop() {
  known_.clear();
  touch();
}

void LesionBoard::touch() {
  if (finding_) return;  // what is measured for the rows themselves
  fresh_ = false;
  changed.tell();
}

const std::vector<LesionRow>& LesionBoard::rows() {
  if (fresh_) return rows_;
  rows_.clear();
  fresh_ = true;
  if (!bench_.has_case()) return rows_;
  finding_ = true;
  try {
    const std::map<std::int32_t, double> unlikely =
        unlikely_vessels(certainty_, *bench_.model(), *bench_.session().file().annotations());
    for (const geometry::Vessel& vessel : bench_.model()->tree.vessels)
      add_rows(vessel, unlikely.count(vessel.id) > 0);
    const std::vector<analysis::VesselSegment> segments = analysis::segments_of(*bench_.model());
    for (LesionRow& row : rows_)
      if (const auto* segment = analysis::segment_at(segments, row.vessel, row.lesion.stenosis.throat_mm))
        row.segment = segment->label;
  } catch (...) {
    finding_ = false;
    throw;
  }
  finding_ = false;
  return rows_;
}

void LesionBoard::add_rows(const geometry::Vessel& vessel, bool unlikely) {
  if (bench_.profile_work(vessel.id)) return;  // nobody waits for that here
  const analysis::LumenProfile* profile = bench_.profile(vessel.id);
  const analysis::ReferenceLine* reference = bench_.reference(vessel.id);
  if (!profile || !reference) return;
  const auto known = known_.find(vessel.id);
  const analysis::PlaqueProfile* plaque =
      known != known_.end() && known->second.plaque ? &*known->second.plaque : nullptr;
  const double own_mm = lumen::own_from_mm(bench_.model()->tree, vessel.id);
  const std::vector<analysis::EvaluableStretch> stretches = evaluability_.stretches(vessel.id);
  const VesselMark* mark = find_mark(*bench_.session().file().annotations(), vessel.id);
  for (analysis::Lesion& lesion : analysis::find_lesions(*profile, *reference, plaque)) {
    const analysis::Stenosis& place = lesion.stenosis;
    if (!is_told(lesion, own_mm, stretches)) continue;
    LesionRow row;
    row.number = static_cast<int>(rows_.size()) + 1;
    row.vessel = vessel.id;
    row.vessel_name = vessel.name;
    row.evaluable = analysis::worst_within(stretches, place.from_mm, place.to_mm);
    row.checked = mark && mark->checked;
    row.unlikely = unlikely;
    row.has_image = bench_.image().volume != nullptr;
    if (const LesionWord* said = word_on(mark, place.from_mm, place.to_mm))
      row.state = said->state, row.comment = said->comment;
    row.lesion = std::move(lesion);
    rows_.push_back(std::move(row));
  }
}

bool LesionBoard::unknown(std::int32_t vessel) const {
  const auto found = known_.find(vessel);
  return found == known_.end() || found->second.stale;
}

int LesionBoard::missing() const {
  const lumen::LumenModel* model = bench_.model();
  if (!model || !bench_.image().volume) return 0;
  return static_cast<int>(std::count_if(model->tree.vessels.begin(), model->tree.vessels.end(),
                                        [this](const geometry::Vessel& one) { return unknown(one.id); }));
}

std::optional<PlaqueWork> LesionBoard::work() const {
  if (missing() == 0) return std::nullopt;
  std::int32_t wanted = bench_.vessel.get();
  if (wanted == Workbench::no_vessel || !unknown(wanted)) {
    const auto& vessels = bench_.model()->tree.vessels;
    wanted = std::find_if(vessels.begin(), vessels.end(), [this](const geometry::Vessel& one) {
               return unknown(one.id);
             })->id;
  }
  return PlaqueWork{
      {bench_.session().file().model(), bench_.session().solved_walls(), bench_.image().volume, wanted},
      found_};
}

bool LesionBoard::take(const PlaqueWork& work, std::optional<analysis::PlaqueProfile> found) {
  if (!bench_.has_case() || bench_.session().file().model() != work.model ||
      bench_.image().volume != work.image)
    return false;
  Known& known = known_[work.vessel];
  known.stale = false;
  known.length_mm = bench_.axis(work.vessel)->length();
  known.plaque = std::move(found);
  touch();
  return true;
}

void LesionBoard::say(const LesionRow& lesion, LesionState state, const std::string& comment) {
  VesselMark mark = mark_or_new(*bench_.session().file().annotations(), lesion.vessel);
  const analysis::Stenosis& place = lesion.lesion.stenosis;
  bench_.annotate(MarkVessel{with_lesion(std::move(mark), {place.from_mm, place.to_mm, state, comment})});
}

}  // namespace ostia::session
