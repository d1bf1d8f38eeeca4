#include "ostia/session/pressure_board.h"

#include "ostia/core/error.h"
#include "ostia/session/pressure_wall_spread.h"

#include <algorithm>

namespace ostia::session {
namespace {

constexpr double stretch_about_cursor_mm = 15.0;
constexpr int trees_of_band = 400;  // drawn while somebody waits

/// Overlapping stretches of a vessel become one: a hand that pulls asks for the same places again and again.
void add_moved(std::vector<MovedWall>& all, MovedWall more) {
  for (auto one = all.begin(); one != all.end();) {
    if (one->vessel != more.vessel || one->from_mm > more.to_mm || one->to_mm < more.from_mm) {
      ++one;
      continue;
    }
    more.from_mm = std::min(more.from_mm, one->from_mm);
    more.to_mm = std::max(more.to_mm, one->to_mm);
    one = all.erase(one);
  }
  all.push_back(more);
}

}  // namespace

std::shared_ptr<const PressureReport> PressureWork::found(const core::TaskContext& task) const {
  const analysis::SurfaceOfVessel wall_of = [this](std::int32_t one) { return walls.at(one); };
  if (whole())
    return std::make_shared<const PressureReport>(
        make_pressure_report(pressure_tree(*model, wall_of, {}, task), options, task));
  if (band) {
    hemodynamics::UncertaintyOptions how;
    how.samples = trees_of_band;
    how.indices = false;
    if (image) how.wall = wall_spread_of_image(before->tree, *model, wall_of, *image, {}, {}, task);
    return std::make_shared<const PressureReport>(with_uncertainty(*before, how, task));
  }
  if (moved.empty()) return std::make_shared<const PressureReport>(with_options(*before, options));
  PressureReport start = *before;
  start.options = options;
  return std::make_shared<const PressureReport>(after_walls_moved(start, *model, wall_of, moved));
}

PressureBoard::PressureBoard(Workbench& bench) : bench_(bench) {
  own_.push_back(bench.case_changed.observe([this] { forget(); }));
  own_.push_back(bench.model_changed.observe([this](const ModelEvent& event) { walls_moved(event); }));
  own_.push_back(bench.annotations_changed.observe([this] { look_at_options(); }));
  own_.push_back(bench.image_changed.observe([this] {
    band_wanted_ = true;
    if (shown.get()) wanted.tell();
  }));
  own_.push_back(shown.observe([this](const bool& on) {
    if (!on) return;
    look_at_options();
    wanted.tell();
  }));
}

void PressureBoard::forget() {
  ++number_;
  now_ = nullptr;
  problem_.clear();
  moved_.clear();
  whole_wanted_ = true;
  edited_ = options_changed_ = false;
  band_wanted_ = true;
  options_ = {};
  look_at_options();
  changed.tell();
  if (shown.get()) wanted.tell();
}

void PressureBoard::walls_moved(const ModelEvent& event) {
  if (event.tree_changed) return forget();
  edited_ = true;
  whole_wanted_ = whole_wanted_ || (!now_ && !in_flight());
  for (const lumen::LiveChange::OfVessel& one : event.change.vessels) {
    const std::shared_ptr<const geometry::AxisCurve> axis = bench_.axis(one.vessel);
    const double length = axis ? axis->length() : one.to_mm;
    add_moved(moved_, {one.vessel, one.solved_anew ? 0.0 : std::max(0.0, one.from_mm),
                       one.solved_anew ? length : std::min(one.to_mm, length)});
  }
  if (shown.get()) wanted.tell();
}

void PressureBoard::look_at_options() {
  const PressureNotes kept = notes();
  const hemodynamics::Conditions conditions = conditions_of(kept);
  const bool same_inputs =
      hemodynamics::conditions_json(conditions) == hemodynamics::conditions_json(options_.conditions);
  if (same_inputs && kept.what_ifs == options_.what_ifs) return;
  options_.conditions = conditions;
  options_.what_ifs = kept.what_ifs;
  options_changed_ = true;
  whole_wanted_ = whole_wanted_ || (!now_ && !in_flight());
  if (shown.get()) wanted.tell();
}

bool PressureBoard::behind() const {
  return !now_ || !moved_.empty() || options_changed_ || (in_flight_ && !in_flight_->band);
}

void PressureBoard::rested() {
  if (!edited_ || !now_) return;
  whole_wanted_ = true;
  if (shown.get()) wanted.tell();
}

std::optional<PressureWork> PressureBoard::begin() {
  if (in_flight() || !shown.get() || !bench_.has_case()) return std::nullopt;
  const bool small = small_waits();
  const bool band = !small && !whole_wanted_ && !edited_ && band_wanted_ && now_;
  if (!small && !whole_wanted_ && !band) return std::nullopt;
  PressureWork work;
  work.number = number_;
  work.model = bench_.session().file().model();
  work.walls = bench_.session().solved_walls();
  work.options = options_;
  if (small) {
    work.before = now_;
    // Another blood prepares all branches anew: first the inputs, then the walls.
    if (!options_changed_) work.moved = std::exchange(moved_, {});
    options_changed_ = false;
    band_wanted_ = true;
  } else if (band) {
    work.before = now_;
    work.band = true;
    work.image = bench_.image().volume;
    band_wanted_ = false;
  } else {
    whole_wanted_ = edited_ = options_changed_ = false;
    band_wanted_ = true;
    moved_.clear();
  }
  in_flight_ = work;
  return work;
}

void PressureBoard::take(const PressureWork& work, std::shared_ptr<const PressureReport> found,
                         const std::string& why) {
  in_flight_.reset();
  if (work.number == number_ && found) {
    now_ = std::move(found);
    problem_.clear();
    changed.tell();
  } else if (work.number == number_ && !why.empty() && !work.band) {
    now_ = nullptr;
    problem_ = why;
    whole_wanted_ = !moved_.empty() || options_changed_;  // else not before something is another
    changed.tell();
  } else if (work.number == number_) {  // cancelled
    for (const MovedWall& one : work.moved) add_moved(moved_, one);
    whole_wanted_ = whole_wanted_ || work.whole();
    options_changed_ = options_changed_ || (!work.whole() && !work.band && work.moved.empty());
    band_wanted_ = band_wanted_ || (work.band && why.empty());
  }
  if (shown.get()) wanted.tell();
}

PressureNotes PressureBoard::notes() const {
  return bench_.has_case() ? bench_.session().file().annotations()->pressure : PressureNotes();
}

void PressureBoard::set_input(const std::string& key, std::optional<double> value) {
  SetPressureInputs command{notes().inputs};
  if (value)
    command.inputs[key] = *value;
  else
    command.inputs.erase(key);
  bench_.annotate(command);
}

void PressureBoard::add_what_if(const WhatIf& what_if) {
  SetWhatIfs command{notes().what_ifs};
  command.what_ifs.push_back(what_if);
  bench_.annotate(command);
}

void PressureBoard::remove_what_if(std::size_t index) {
  SetWhatIfs command{notes().what_ifs};
  if (index >= command.what_ifs.size())
    throw InvalidInput("there is no stretch " + std::to_string(index + 1) + " with another calibre");
  command.what_ifs.erase(command.what_ifs.begin() + static_cast<std::ptrdiff_t>(index));
  bench_.annotate(command);
}

void PressureBoard::clear_what_ifs() {
  bench_.annotate(SetWhatIfs{});
}

WhatIf PressureBoard::stretch_at_cursor() const {
  const std::shared_ptr<const geometry::AxisCurve> axis = bench_.axis();
  if (!axis) throw InvalidInput("no vessel is selected");
  const double s = bench_.own_mm(bench_.cursor_mm.get());
  WhatIf one;
  one.vessel = bench_.vessel.get();
  one.from_mm = std::max(0.0, s - 0.5 * stretch_about_cursor_mm);
  one.to_mm = std::min(axis->length(), s + 0.5 * stretch_about_cursor_mm);
  for (const analysis::Stenosis& lesion : bench_.known_stenoses(one.vessel))
    if (s >= lesion.from_mm && s <= lesion.to_mm) one.from_mm = lesion.from_mm, one.to_mm = lesion.to_mm;
  return one;
}

std::optional<double> PressureBoard::ffr_at_cursor() const {
  if (!now_ || !bench_.axis()) return std::nullopt;
  return ffr_at(*now_, bench_.vessel.get(), bench_.own_mm(bench_.cursor_mm.get()));
}

}  // namespace ostia::session
