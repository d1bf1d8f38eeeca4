#include "ostia/session/annotation.h"

#include "case_file/same_bits.h"

#include "ostia/core/error.h"
#include "ostia/session/annotation_json.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <limits>
#include <type_traits>

namespace ostia::session {
namespace {

using analysis::Measurement;
using lumen::LumenModel;

constexpr std::array<const char*, std::variant_size_v<AnnotationCommand>> op_names{
    "measure.add",     "measure.change",   "measure.delete",    "vessel.mark",
    "pressure.inputs", "pressure.what_if", "report.impression", "report.modifiers",
    "report.features", "report.sign",      "calcium.places"};

std::int32_t key_of(const Measurement& measurement) {
  return measurement.id;
}
std::int32_t key_of(const VesselMark& mark) {
  return mark.vessel;
}

/// Where a key is, or would be, in a list that is in order.
template <class Items>
auto place_of(Items& items, std::int32_t key) {
  return std::lower_bound(items.begin(), items.end(), key,
                          [](const auto& item, std::int32_t k) { return key_of(item) < k; });
}

template <class Items>
auto find(Items& items, std::int32_t key) {
  const auto found = place_of(items, key);
  return found != items.end() && key_of(*found) == key ? found : items.end();
}

bool has_vessel(const LumenModel& model, std::int32_t id) {
  return std::any_of(model.tree.vessels.begin(), model.tree.vessels.end(),
                     [&](const geometry::Vessel& vessel) { return vessel.id == id; });
}

void require_vessel(const LumenModel& model, std::int32_t id, const std::string& whose) {
  if (!has_vessel(model, id))
    throw InvalidInput(whose + " is at vessel " + std::to_string(id) +
                       ", which the model does not have; choose one of its vessels");
}

std::string shown(const Measurement& measurement) {
  return "the " + analysis::to_string(measurement.kind) +
         (measurement.name.empty() ? "" : " \"" + measurement.name + "\"");
}

void require_sound(const Measurement& measurement) {
  if (measurement.vessel < 0)
    throw InvalidInput(shown(measurement) + " is at vessel " + std::to_string(measurement.vessel) +
                       "; ids of vessels are 0 or more");
  if (const auto fault = analysis::find_fault(measurement))
    throw InvalidInput(shown(measurement) + " cannot be kept: " + *fault);
}

auto require_measurement(Annotations& annotations, std::int32_t id) {
  const auto found = find(annotations.measurements, id);
  if (found == annotations.measurements.end())
    throw InvalidInput("there is no measurement " + std::to_string(id) +
                       "; it was deleted, or is of another case");
  return found;
}

void run(Annotations& annotations, const MeasureAdd& command, const LumenModel& model) {
  if (annotations.next_measurement_id == std::numeric_limits<std::int32_t>::max())
    throw InvalidInput("the case has no ids left for measurements; begin a new case");
  Measurement added = command.measurement;
  added.id = annotations.next_measurement_id;
  require_sound(added);
  if (needs_vessel(added)) require_vessel(model, added.vessel, shown(added));
  annotations.measurements.push_back(std::move(added));
  ++annotations.next_measurement_id;
}

void run(Annotations& annotations, const MeasureChange& command, const LumenModel& model) {
  const Measurement& changed = command.measurement;
  const auto found = require_measurement(annotations, changed.id);
  require_sound(changed);
  const bool kept_vessel = needs_vessel(*found) && found->vessel == changed.vessel;
  if (needs_vessel(changed) && !kept_vessel) require_vessel(model, changed.vessel, shown(changed));
  *found = changed;
}

void run(Annotations& annotations, const MeasureDelete& command, const LumenModel&) {
  annotations.measurements.erase(require_measurement(annotations, command.id));
}

void require_sound(const std::vector<analysis::EvaluableStretch>& stretches) {
  double last = 0.0;
  for (const analysis::EvaluableStretch& one : stretches) {
    if (!(one.from_mm >= last && one.from_mm < one.to_mm && std::isfinite(one.to_mm)))
      throw InvalidInput("the stretch from " + std::to_string(one.from_mm) + " to " +
                         std::to_string(one.to_mm) +
                         " mm of a mark is none, or overlaps the one before; give them ascending");
    last = one.to_mm;
  }
}

bool lies_before(const LesionWord& a, const LesionWord& b) {
  return a.from_mm < b.from_mm || (a.from_mm == b.from_mm && a.to_mm < b.to_mm);
}

void require_sound(const std::vector<LesionWord>& words) {
  for (std::size_t i = 0; i < words.size(); ++i)
    if (!(words[i].from_mm >= 0.0 && words[i].from_mm < words[i].to_mm && std::isfinite(words[i].to_mm)) ||
        (i > 0 && !lies_before(words[i - 1], words[i])))
      throw InvalidInput("the lesion from " + std::to_string(words[i].from_mm) + " to " +
                         std::to_string(words[i].to_mm) +
                         " mm of a mark is no stretch, or out of order; give each once, ascending");
}

void run(Annotations& annotations, const MarkVessel& command, const LumenModel& model) {
  const VesselMark& mark = command.mark;
  require_sound(mark.evaluable);
  require_sound(mark.lesions);
  if (mark.color)
    for (const double part : *mark.color)
      if (!(part >= 0.0 && part <= 1.0))
        throw InvalidInput("the color of vessel " + std::to_string(mark.vessel) + " has a part of " +
                           std::to_string(part) + "; red, green and blue are 0 to 1");
  const auto found = place_of(annotations.marks, mark.vessel);
  if (found != annotations.marks.end() && found->vessel == mark.vessel) {
    *found = mark;
    return;
  }
  require_vessel(model, mark.vessel, "the mark");
  annotations.marks.insert(found, mark);
}

void run(Annotations& annotations, const SetPressureInputs& command, const LumenModel&) {
  validate(command.inputs);
  annotations.pressure.inputs = command.inputs;
}

void run(Annotations& annotations, const SetWhatIfs& command, const LumenModel& model) {
  constexpr std::size_t most = 100;
  if (command.what_ifs.size() > most)
    throw InvalidInput("a case keeps up to " + std::to_string(most) + " stretches with another calibre");
  const std::vector<WhatIf>& before = annotations.pressure.what_ifs;
  for (const WhatIf& one : command.what_ifs) {
    validate(one);
    if (std::find(before.begin(), before.end(), one) != before.end())
      continue;  // it may have lost its vessel
    require_vessel(model, one.vessel, "the stretch with another calibre");
    const double length = lumen::vessel(model, one.vessel).axis->length();
    if (one.from_mm >= length)
      throw InvalidInput("a stretch begins at " + std::to_string(one.from_mm) + " mm of a vessel of " +
                         std::to_string(length) + " mm");
  }
  annotations.pressure.what_ifs = command.what_ifs;
}

void run(Annotations& annotations, const SetReportImpression& command, const LumenModel&) {
  validate_impression(command.text);
  annotations.report.impression = command.text;
}

void run(Annotations& annotations, const SetReportModifiers& command, const LumenModel&) {
  validate(command.modifiers);
  annotations.report.modifiers = command.modifiers;
}

void run(Annotations& annotations, const SetPlaqueFeatures& command, const LumenModel& model) {
  validate(command.features);
  const std::vector<FeatureWord>& before = annotations.report.features;
  for (const FeatureWord& one : command.features)
    if (std::find(before.begin(), before.end(), one) == before.end())  // else it may have lost its vessel
      require_vessel(model, one.vessel, "the word on a plaque");
  annotations.report.features = command.features;
}

void run(Annotations& annotations, const SetCalciumPlaces& command, const LumenModel&) {
  validate(command.words);
  annotations.report.calcium = command.words;
}

void run(Annotations& annotations, const SignReport& command, const LumenModel&) {
  constexpr std::size_t most = 1000;
  std::vector<ReportVersion>& versions = annotations.report.versions;
  validate(command.version);
  if (versions.size() >= most)
    throw InvalidInput("a case keeps up to " + std::to_string(most) + " versions of its report");
  if (!versions.empty() && command.version.changes.empty())
    throw InvalidInput("version " + std::to_string(versions.size() + 1) +
                       " of the report does not say what changed; say it in a line");
  versions.push_back(command.version);
}

/// The mark of a vessel, made where there is none.
VesselMark& mark_of(Annotations& annotations, std::int32_t vessel) {
  const auto place = place_of(annotations.marks, vessel);
  if (place != annotations.marks.end() && place->vessel == vessel) return *place;
  return *annotations.marks.insert(place, mark_or_new(annotations, vessel));
}

/// So do words on lesions, each with its middle.
void hand_lesions_on(Annotations& annotations, std::int32_t vessel, double from_mm, double to_mm,
                     std::int32_t other, double by_mm) {
  const VesselMark* mark = find_mark(annotations, vessel);
  if (!mark || mark->lesions.empty()) return;
  const auto goes = [&](const LesionWord& one) {
    const double middle = 0.5 * (one.from_mm + one.to_mm);
    return middle >= from_mm && middle < to_mm;
  };
  const std::vector<LesionWord> said = mark->lesions;
  std::erase_if(mark_of(annotations, vessel).lesions, goes);
  for (LesionWord one : said) {
    if (!goes(one)) continue;
    one.from_mm = std::max(0.0, one.from_mm + by_mm), one.to_mm += by_mm;
    if (!(one.from_mm < one.to_mm)) continue;
    VesselMark& now = mark_of(annotations, other);
    now = with_lesion(std::move(now), std::move(one));
  }
}

/// And stretches of other kinds: with another calibre, words on plaque.
template <class Stretch>
void hand_stretches_on(std::vector<Stretch>& all, std::int32_t vessel, double from_mm, double to_mm,
                       std::int32_t other, double by_mm) {
  for (Stretch& one : all) {
    const double middle = 0.5 * (one.from_mm + one.to_mm);
    if (one.vessel != vessel || middle < from_mm || !(middle < to_mm)) continue;
    one.vessel = other;
    one.from_mm = std::max(0.0, one.from_mm + by_mm), one.to_mm += by_mm;
  }
  std::erase_if(all, [](const Stretch& one) { return !(one.from_mm < one.to_mm); });
}

/// The reader's word on what lies between two abscissas of one vessel goes to another, moved along.
void hand_on(Annotations& annotations, std::int32_t vessel, double from_mm, double to_mm, std::int32_t other,
             double by_mm) {
  hand_stretches_on(annotations.pressure.what_ifs, vessel, from_mm, to_mm, other, by_mm);
  hand_stretches_on(annotations.report.features, vessel, from_mm, to_mm, other, by_mm);
  hand_lesions_on(annotations, vessel, from_mm, to_mm, other, by_mm);
  const VesselMark* mark = find_mark(annotations, vessel);
  if (!mark || mark->evaluable.empty()) return;
  const std::vector<analysis::EvaluableStretch> said = mark->evaluable;
  VesselMark& left = mark_of(annotations, vessel);
  left = with_evaluability(std::move(left), from_mm, to_mm, std::nullopt);
  for (const analysis::EvaluableStretch& one : said) {
    const double from = std::max(one.from_mm, from_mm) + by_mm, to = std::min(one.to_mm, to_mm) + by_mm;
    if (!(from < to) || !(to > 0.0)) continue;
    VesselMark& now = mark_of(annotations, other);
    now = with_evaluability(std::move(now), std::max(from, 0.0), to, one.grade);
  }
}

constexpr double whole_mm = std::numeric_limits<double>::max();

/// The last place of a measurement along a vessel's axis.
double last_mm(const Measurement& measurement, const geometry::AxisCurve& axis) {
  if (measurement.kind == analysis::MeasureKind::ring_hu) return measurement.from_mm;
  if (measurement.kind != analysis::MeasureKind::diameter)
    return std::max(measurement.from_mm, measurement.to_mm);
  return axis.nearest_foot(0.5 * (measurement.points.front() + measurement.points.back())).s_mm;
}

void follow(Annotations& annotations, const lumen::BranchSplit& edit, const LumenModel& before,
            const LumenModel& after) {
  const auto made = std::find_if(after.tree.vessels.begin(), after.tree.vessels.end(),
                                 [&](const geometry::Vessel& v) { return !has_vessel(before, v.id); });
  if (made == after.tree.vessels.end()) return;
  const double seam_mm = lumen::vessel(after, edit.vessel).axis->length();
  const geometry::AxisCurve& axis = *lumen::vessel(before, edit.vessel).axis;
  for (Measurement& one : annotations.measurements)
    if (needs_vessel(one) && one.vessel == edit.vessel && last_mm(one, axis) > seam_mm) one.vessel = made->id;
  hand_on(annotations, edit.vessel, seam_mm, whole_mm, made->id, 0.0);
}

void follow(Annotations& annotations, const lumen::BranchMerge& edit, const LumenModel& before,
            const LumenModel&) {
  const auto parent = lumen::merge_parent(before.tree, edit.vessel);
  if (!parent) return;
  for (Measurement& one : annotations.measurements)
    if (needs_vessel(one) && one.vessel == edit.vessel) one.vessel = *parent;
  hand_on(annotations, edit.vessel, 0.0, whole_mm, *parent, 0.0);
}

/// A measurement's abscissas where its vessel's way has another beginning: it stays at its places, as far as
/// the way still has them.
void move_along(Measurement& measurement, double by_mm) {
  constexpr double same_place_mm = 1e-3;  // a way that has got a node is no other way
  if (std::abs(by_mm) < same_place_mm) return;
  measurement.from_mm = std::max(0.0, measurement.from_mm + by_mm);
  measurement.to_mm = std::max(0.0, measurement.to_mm + by_mm);
}

void follow(Annotations& annotations, const lumen::BranchCut& edit, const LumenModel& before,
            const LumenModel& after) {
  const double seam_mm = lumen::vessel(after, edit.vessel).axis->length();
  const geometry::AxisCurve& axis = *lumen::vessel(before, edit.vessel).axis;
  const auto made = std::find_if(after.tree.vessels.begin(), after.tree.vessels.end(),
                                 [&](const geometry::Vessel& v) { return !has_vessel(before, v.id); });
  if (made == after.tree.vessels.end()) return;
  for (Measurement& one : annotations.measurements) {
    if (!needs_vessel(one) || !has_vessel(before, one.vessel)) continue;
    if (one.vessel == edit.vessel && last_mm(one, axis) <= seam_mm) continue;  // proximal: as it was
    if (one.vessel == edit.vessel) one.vessel = made->id;
    const std::int32_t source = one.vessel == made->id ? edit.vessel : one.vessel;
    move_along(
        one, lumen::vessel(after, one.vessel).axis->length() - lumen::vessel(before, source).axis->length());
  }
  hand_on(annotations, edit.vessel, seam_mm, whole_mm, made->id,
          lumen::vessel(after, made->id).axis->length() - axis.length());
}

void follow(Annotations& annotations, const lumen::BranchConnect&, const LumenModel& before,
            const LumenModel& after) {
  for (Measurement& one : annotations.measurements)
    if (needs_vessel(one) && has_vessel(before, one.vessel))
      move_along(one, lumen::vessel(after, one.vessel).axis->length() -
                          lumen::vessel(before, one.vessel).axis->length());
}

/// Keys of what is in one of two ordered lists alone, or differs.
template <class Item>
std::vector<std::int32_t> differing(const std::vector<Item>& before, const std::vector<Item>& after) {
  std::vector<std::int32_t> keys;
  auto a = before.begin();
  auto b = after.begin();
  while (a != before.end() || b != after.end()) {
    if (b == after.end() || (a != before.end() && key_of(*a) < key_of(*b))) {
      keys.push_back(key_of(*a++));
    } else if (a == before.end() || key_of(*b) < key_of(*a)) {
      keys.push_back(key_of(*b++));
    } else {
      if (!same(*a, *b)) keys.push_back(key_of(*a));
      ++a, ++b;
    }
  }
  return keys;
}

}  // namespace

std::string op_name(const AnnotationCommand& command) {
  return op_names[command.index()];
}

bool is_annotation_op(const std::string& op) {
  return std::find(op_names.begin(), op_names.end(), op) != op_names.end();
}

VesselMark with_evaluability(VesselMark mark, double from_mm, double to_mm,
                             std::optional<analysis::Evaluability> grade) {
  std::vector<analysis::EvaluableStretch> now;
  const auto add = [&](double from, double to, analysis::Evaluability said) {
    if (!(from < to)) return;
    if (!now.empty() && now.back().grade == said && now.back().to_mm == from)
      now.back().to_mm = to;
    else
      now.push_back({from, to, said, {}, true});
  };
  for (const analysis::EvaluableStretch& one : mark.evaluable)
    add(one.from_mm, std::min(one.to_mm, from_mm), one.grade);
  if (grade) add(from_mm, to_mm, *grade);
  for (const analysis::EvaluableStretch& one : mark.evaluable)
    add(std::max(one.from_mm, to_mm), one.to_mm, one.grade);
  mark.evaluable = std::move(now);
  return mark;
}

std::string to_string(LesionState state) {
  return state == LesionState::open ? "open" : state == LesionState::accepted ? "accepted" : "rejected";
}

LesionState lesion_state(const std::string& text) {
  for (const LesionState one : {LesionState::open, LesionState::accepted, LesionState::rejected})
    if (to_string(one) == text) return one;
  throw InvalidInput("a lesion is \"" + text + "\"; it can be open, accepted or rejected");
}

const LesionWord* word_on(const VesselMark* mark, double from_mm, double to_mm) {
  const LesionWord* best = nullptr;
  double most_mm = 0.0;
  if (!mark) return best;
  for (const LesionWord& one : mark->lesions) {
    const double shared = std::min(to_mm, one.to_mm) - std::max(from_mm, one.from_mm);
    const double shorter = std::min(to_mm - from_mm, one.to_mm - one.from_mm);
    if (shared > most_mm && shared >= 0.5 * shorter) best = &one, most_mm = shared;
  }
  return best;
}

VesselMark with_lesion(VesselMark mark, LesionWord word) {
  if (const LesionWord* said = word_on(&mark, word.from_mm, word.to_mm))
    mark.lesions.erase(mark.lesions.begin() + (said - mark.lesions.data()));
  std::erase_if(mark.lesions,
                [&](const LesionWord& one) { return !lies_before(one, word) && !lies_before(word, one); });
  if (word.state == LesionState::open && word.comment.empty()) return mark;
  const auto place = std::lower_bound(mark.lesions.begin(), mark.lesions.end(), word, lies_before);
  mark.lesions.insert(place, std::move(word));
  return mark;
}

const VesselMark* find_mark(const Annotations& annotations, std::int32_t vessel) {
  const auto found = find(annotations.marks, vessel);
  return found == annotations.marks.end() ? nullptr : &*found;
}

VesselMark mark_or_new(const Annotations& annotations, std::int32_t vessel) {
  const VesselMark* found = find_mark(annotations, vessel);
  VesselMark mark = found ? *found : VesselMark{};
  mark.vessel = vessel;
  return mark;
}

const Measurement* find_measurement(const Annotations& annotations, std::int32_t id) {
  const auto found = find(annotations.measurements, id);
  return found == annotations.measurements.end() ? nullptr : &*found;
}

Annotations annotated(const Annotations& before, const AnnotationCommand& command, const LumenModel& model) {
  to_json(command);  // refuses what no file can hold
  Annotations after = before;
  std::visit([&](const auto& kind) { run(after, kind, model); }, command);
  return after;
}

Annotations following(const Annotations& before, const lumen::Edit& edit, const LumenModel& model_before,
                      const LumenModel& model_after) {
  Annotations after = before;
  if (const auto* split = std::get_if<lumen::BranchSplit>(&edit))
    follow(after, *split, model_before, model_after);
  if (const auto* merge = std::get_if<lumen::BranchMerge>(&edit))
    follow(after, *merge, model_before, model_after);
  if (const auto* cut = std::get_if<lumen::BranchCut>(&edit)) follow(after, *cut, model_before, model_after);
  if (const auto* connect = std::get_if<lumen::BranchConnect>(&edit))
    follow(after, *connect, model_before, model_after);
  return after;
}

AnnotationChange changes_between(const Annotations& before, const Annotations& after) {
  return {differing(before.measurements, after.measurements), differing(before.marks, after.marks),
          !same(before.pressure, after.pressure), !(before.report == after.report)};
}

bool same(const Measurement& a, const Measurement& b) {
  const auto same_points = [](const geometry::Vec3& p, const geometry::Vec3& q) {
    return std::memcmp(p.data(), q.data(), 3 * sizeof(double)) == 0;
  };
  return a.id == b.id && a.kind == b.kind && a.name == b.name && a.vessel == b.vessel &&
         std::equal(a.points.begin(), a.points.end(), b.points.begin(), b.points.end(), same_points) &&
         same_bits(a.from_mm, b.from_mm) && same_bits(a.to_mm, b.to_mm) &&
         same_bits(a.inner_mm, b.inner_mm) && same_bits(a.outer_mm, b.outer_mm);
}

bool same(const VesselMark& a, const VesselMark& b) {
  if (a.color.has_value() != b.color.has_value()) return false;
  if (a.color && !std::equal(a.color->begin(), a.color->end(), b.color->begin(), same_bits)) return false;
  const auto same_stretch = [](const analysis::EvaluableStretch& p, const analysis::EvaluableStretch& q) {
    return same_bits(p.from_mm, q.from_mm) && same_bits(p.to_mm, q.to_mm) && p.grade == q.grade;
  };
  const auto same_word = [](const LesionWord& p, const LesionWord& q) {
    return same_bits(p.from_mm, q.from_mm) && same_bits(p.to_mm, q.to_mm) && p.state == q.state &&
           p.comment == q.comment;
  };
  return a.vessel == b.vessel && a.visible == b.visible && a.checked == b.checked && a.note == b.note &&
         std::equal(a.lesions.begin(), a.lesions.end(), b.lesions.begin(), b.lesions.end(), same_word) &&
         std::equal(a.evaluable.begin(), a.evaluable.end(), b.evaluable.begin(), b.evaluable.end(),
                    same_stretch);
}

bool needs_vessel(const Measurement& measurement) {
  if (measurement.kind == analysis::MeasureKind::diameter) return measurement.vessel != 0;
  return analysis::traits_of(measurement.kind).of_vessel;
}

Orphans find_orphans(const Annotations& annotations, const LumenModel& model) {
  Orphans orphans;
  for (const Measurement& measurement : annotations.measurements)
    if (needs_vessel(measurement) && !has_vessel(model, measurement.vessel))
      orphans.measurements.push_back(measurement.id);
  for (const VesselMark& mark : annotations.marks)
    if (!has_vessel(model, mark.vessel)) orphans.marks.push_back(mark.vessel);
  return orphans;
}

}  // namespace ostia::session
