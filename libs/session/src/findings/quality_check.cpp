#include "ostia/session/quality_check.h"

#include "walls/wall_outline.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/evaluation/contour_surface.h"
#include "ostia/geometry/aabb_tree.h"
#include "ostia/io/contour_file.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>

namespace ostia::session {
namespace {

using geometry::AxisCurve;
using geometry::Box3;
using geometry::Contour;
using geometry::ContourSection;

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
constexpr double off_axis_mm = 1.0;  // beyond a contour's mean radius, and yet the same vessel
constexpr std::size_t contours_at_once = 8;
constexpr double missing_reach_mm = 3.0;  // a wall that was not there may come from so far
constexpr double unmoved_mm = 1e-4;
constexpr std::size_t unmoved_points = 16, unmoved_turns = 4;  // of an outline that are asked, in turns
constexpr const char* usual_observer = "truth";

double mean_radius(const ContourSection& section) {
  double sum = 0.0;
  for (const Contour& one : section.contours)
    sum += std::sqrt(geometry::contour_area(one) / std::numbers::pi);
  return sum / static_cast<double>(section.contours.size());
}

/// Feet of the contours on an axis that runs through them; nothing where it does not.
struct Course {
  double off_mm = std::numeric_limits<double>::infinity();
  std::vector<double> s_mm;
};
Course course_of(const ContourSection& section, const AxisCurve& axis) {
  Course course;
  double off = 0.0;
  for (const Contour& one : section.contours) {
    const geometry::AxisFoot foot = axis.nearest_foot(geometry::contour_centroid(one));
    off += foot.rho_mm;
    course.s_mm.push_back(foot.s_mm);
  }
  const bool distal = course.s_mm.back() > course.s_mm.front();
  off /= static_cast<double>(section.contours.size());
  if (distal && off <= mean_radius(section) + off_axis_mm) course.off_mm = off;
  return course;
}

std::int32_t vessel_of(const ContourSection& section, const lumen::LumenModel& model,
                       std::vector<double>& s_mm) {
  std::int32_t best = Workbench::no_vessel;
  double least = std::numeric_limits<double>::infinity();
  for (const geometry::Vessel& vessel : model.tree.vessels) {
    Course course = course_of(section, *lumen::vessel(model, vessel.id).axis);
    if (!std::isfinite(course.off_mm)) continue;
    const bool named = vessel.name == section.vessel;
    if (!named && course.off_mm >= least) continue;
    least = course.off_mm;
    best = vessel.id;
    s_mm = std::move(course.s_mm);
    if (named) break;
  }
  return best;
}

bool overlap(const Box3& a, const Box3& b) {
  return !a.isEmpty() && !b.isEmpty() && a.intersects(b);
}

}  // namespace

/// What is kept of a matched section between edits.
struct QualityCheck::Section {
  std::optional<evaluation::RuledComparison> surfaces;
  std::vector<std::vector<Vec3>> outlines;
  std::vector<Box3> reach;  // of each contour: where its outline is, or might come from
  std::vector<char> stale;
  std::vector<std::size_t> measured;       // contours that `surfaces` does not know yet
  std::optional<geometry::AabbTree> tree;  // of the truth's surface, when it was asked for
  bool named = false;                      // its row of figures is of this match
};

QualityCheck::QualityCheck(Workbench& bench) : bench_(bench) {
  own_.push_back(observer.observe([this](const std::string&) { chosen(); }));
  own_.push_back(bench.case_changed.observe([this] { chosen(); }));
  own_.push_back(bench.model_changed.observe([this](const ModelEvent& event) { touched(event); }));
  const auto active = [this](const auto&...) { timer_.touch(); };
  own_.push_back(bench.vessel.observe(active));
  own_.push_back(bench.cursor_mm.observe(active));
  own_.push_back(bench.place.observe(active));
  own_.push_back(bench.theta_deg.observe(active));
  own_.push_back(bench.tool.observe(active));
  own_.push_back(bench.grey.observe(active));
  own_.push_back(bench.annotations_changed.observe(active));
}
QualityCheck::~QualityCheck() = default;

void QualityCheck::open(const std::filesystem::path& path) {
  set_truth(io::read_contours(path));
}

void QualityCheck::set_truth(geometry::ContourSet contours) {
  std::erase_if(contours.sections, [](const ContourSection& one) { return one.boundary != "lumen"; });
  if (contours.sections.empty())
    throw InvalidInput("there are no contours of a lumen; choose a file with lumen contours");
  std::vector<std::string> names;
  for (const ContourSection& one : contours.sections) {
    if (const auto fault = geometry::find_fault(one))
      throw InvalidInput("section " + one.section + " of " + one.observer + ": " + *fault);
    if (std::find(names.begin(), names.end(), one.observer) == names.end()) names.push_back(one.observer);
  }
  truth_ = std::move(contours);
  observers_ = std::move(names);
  const bool kept = std::find(observers_.begin(), observers_.end(), observer.get()) != observers_.end();
  const bool usual = std::find(observers_.begin(), observers_.end(), usual_observer) != observers_.end();
  if (kept || !observer.set(usual ? usual_observer : observers_.front())) chosen();
}

void QualityCheck::close() {
  truth_ = {};
  observers_.clear();
  chosen();
}

void QualityCheck::chosen() {
  match_stale_ = true;
  visited_.clear();
  truth_changed.tell();
  stale.tell();
}

void QualityCheck::touched(const ModelEvent& event) {
  timer_.touch();
  visited_.clear();
  if (event.tree_changed) {
    match_stale_ = true;
    truth_changed.tell();
  }
  for (std::size_t k = 0; k < states_.size(); ++k) {
    Section& state = *states_[k];
    const auto anew = std::any_of(event.change.vessels.begin(), event.change.vessels.end(),
                                  [](const auto& of) { return of.solved_anew; });
    for (std::size_t i = 0; i < state.stale.size(); ++i)
      if (anew || overlap(state.reach[i], event.change.box)) state.stale[i] = 1;
  }
  stale.tell();
}

void QualityCheck::match() {
  if (!match_stale_) return;
  match_stale_ = false;
  ++revision_;
  matched_.clear();
  states_.clear();
  const lumen::LumenModel* model = bench_.model();
  if (!model) return;
  std::vector<const ContourSection*> chosen;
  for (const ContourSection& section : truth_.sections)
    if (section.observer == observer.get()) chosen.push_back(&section);
  matched_.resize(chosen.size());
  core::parallel_for(chosen.size(), 1, [&](std::size_t i) {
    TruthSection& found = matched_[i];
    found.contours = *chosen[i];
    found.vessel = vessel_of(found.contours, *model, found.s_mm);
    found.surface = evaluation::surface_of(found.contours);
    found.ring = found.surface.points.size() / found.contours.contours.size();
    for (const Vec3& p : found.surface.points) found.box.extend(p);
  });
  for (const TruthSection& found : matched_) {
    auto state = std::make_unique<Section>();
    if (found.vessel != Workbench::no_vessel) {
      const std::size_t contours = found.contours.contours.size();
      state->outlines.resize(contours);
      state->reach.resize(contours);
      state->stale.assign(contours, 1);
    }
    states_.push_back(std::move(state));
  }
}

const std::vector<TruthSection>& QualityCheck::truth() {
  match();
  return matched_;
}
std::uint64_t QualityCheck::truth_revision() {
  match();
  return revision_;
}

namespace {

/// Means over the contours that were found.
void summarize(SectionError& error) {
  std::size_t found = 0;
  double mean = 0.0, both = 0.0, sizes = 0.0, areas = 0.0;
  error.missing = 0;
  error.max_mm = 0.0;
  for (const ContourError& one : error.contours) {
    if (!one.found) {
      ++error.missing;
      continue;
    }
    const evaluation::OutlineDifference& d = one.difference;
    ++found;
    mean += d.mean_mm;
    areas += d.area_difference_mm2();
    both += d.dice * (d.reference_mm2 + d.result_mm2);
    sizes += d.reference_mm2 + d.result_mm2;
    error.max_mm = std::max(error.max_mm, d.max_mm);
  }
  const auto count = static_cast<double>(found);
  error.mean_mm = found > 0 ? mean / count : nothing;
  error.area_difference_mm2 = found > 0 ? areas / count : nothing;
  error.dice = sizes > 0.0 ? both / sizes : nothing;
  if (found == 0) error.max_mm = nothing;
}

SectionError named_after(const TruthSection& of) {
  SectionError error;
  error.section = of.contours.section;
  error.vessel_name = of.contours.vessel;
  error.vessel = of.vessel;
  error.health = of.contours.health;
  error.mean_mm = error.max_mm = error.area_difference_mm2 = error.dice = nothing;
  if (of.s_mm.empty()) return error;
  error.from_mm = of.s_mm.front();
  error.to_mm = of.s_mm.back();
  for (const double s : of.s_mm) error.contours.push_back({s, false, {}});
  return error;
}

}  // namespace

/// Whether the wall still runs through an outline, to what is below any figure here. An edit's box is drawn
/// much wider: at 1e-6 mm.
bool QualityCheck::is_unmoved(std::size_t section, std::size_t contour) const {
  const std::vector<Vec3>& outline = states_[section]->outlines[contour];
  if (outline.empty()) return false;
  const TruthSection& of = matched_[section];
  const std::int32_t owner = lumen::owner_at(bench_.model()->tree, of.vessel, of.s_mm[contour]);
  const auto wall = bench_.session().live().surface(owner);
  const double most = unmoved_mm * wall->wall_slope();
  std::vector<Vec3> places;
  std::vector<double> values;
  // A few tell of most that moved; the rest lie between them.
  for (std::size_t first = 0; first < unmoved_turns; ++first) {
    places.clear();
    for (std::size_t k = first; k < unmoved_points; k += unmoved_turns)
      places.push_back(outline[k * outline.size() / unmoved_points]);
    values.resize(places.size());
    wall->values(places, values);
    for (const double value : values)
      if (std::abs(value) > most) return false;
  }
  return true;
}

void QualityCheck::measure(std::size_t section, const std::vector<std::size_t>& changed) {
  const TruthSection& of = matched_[section];
  Section& state = *states_[section];
  SectionError& error = errors_[section];
  const lumen::LumenModel* model = bench_.model();
  const std::shared_ptr<const AxisCurve> axis = bench_.axis(of.vessel);
  core::parallel_for(changed.size(), 1, [&](std::size_t j) {
    const std::size_t i = changed[j];
    const Contour& contour = of.contours.contours[i];
    const double s = of.s_mm[i];
    const auto wall = bench_.session().live().surface(lumen::owner_at(model->tree, of.vessel, s));
    state.outlines[i] = wall_outline(*wall, contour, axis->point(s));
    const bool found = !state.outlines[i].empty();
    Box3 reach;
    for (const Vec3& p : found ? state.outlines[i] : contour.points) reach.extend(p);
    const double about = found ? 0.0 : missing_reach_mm;
    state.reach[i] = Box3(Vec3(reach.min().array() - about), Vec3(reach.max().array() + about));
    ContourError& one = error.contours[i];
    one.found = found;
    one.difference =
        found ? evaluation::compare_outlines(contour, state.outlines[i]) : evaluation::OutlineDifference{};
  });
  for (const std::size_t i : changed) {
    state.stale[i] = 0;
    state.measured.push_back(i);
  }
}

/// Some of a section's stale contours; true when none is left and its figures are right.
bool QualityCheck::measure_some(std::size_t section, std::size_t most) {
  Section& state = *states_[section];
  if (!state.named) errors_[section] = named_after(matched_[section]);
  state.named = true;
  std::vector<char> moved(state.stale.size(), 0);
  core::parallel_for(moved.size(), 1,
                     [&](std::size_t i) { moved[i] = state.stale[i] && !is_unmoved(section, i) ? 1 : 0; });
  std::vector<std::size_t> changed;
  for (std::size_t i = 0; i < moved.size(); ++i) {
    state.stale[i] = moved[i];
    if (moved[i] != 0 && changed.size() < most) changed.push_back(i);
  }
  if (!changed.empty()) {
    measure(section, changed);
    measured_now_ += changed.size();
    return false;
  }
  if (state.measured.empty()) return true;
  if (!state.surfaces) state.surfaces.emplace(matched_[section].contours);
  state.surfaces->update(state.outlines, state.measured);
  state.measured.clear();
  errors_[section].surfaces = state.surfaces->distances();
  summarize(errors_[section]);
  return true;
}

bool QualityCheck::advance(double budget_ms) {
  const auto began = std::chrono::steady_clock::now();
  const auto spent = [&] {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - began).count();
  };
  const bool all_at_once = !(budget_ms < std::numeric_limits<double>::infinity());
  match();
  errors_.resize(matched_.size());
  const std::size_t before = measured_now_;
  bool whole = true;
  for (std::size_t k = 0; whole && k < matched_.size(); ++k)
    while (!measure_some(k, all_at_once ? states_[k]->stale.size() : contours_at_once))
      if (spent() > budget_ms) {
        whole = false;
        break;
      }
  if (measured_now_ > before) spent_now_ms_ += spent();
  if (whole && measured_now_ > 0) {
    last_update_contours_ = std::exchange(measured_now_, 0);
    last_update_ms_ = std::exchange(spent_now_ms_, 0.0);
  }
  return whole;
}

void QualityCheck::refresh() {
  advance(std::numeric_limits<double>::infinity());
}

const std::vector<SectionError>& QualityCheck::sections() {
  refresh();
  return errors_;
}

namespace {

void add(WholeError& sum, const SectionError& one, double missing_mm, double& both, double& sizes) {
  ++sum.sections;
  if (!one.matched()) {
    ++sum.unmatched;
    return;
  }
  sum.length_mm += one.to_mm - one.from_mm;
  sum.missing_mm += missing_mm;
  sum.surfaces += one.surfaces;
  for (const ContourError& c : one.contours) {
    if (!c.found) continue;
    both += c.difference.dice * (c.difference.reference_mm2 + c.difference.result_mm2);
    sizes += c.difference.reference_mm2 + c.difference.result_mm2;
  }
}

}  // namespace

WholeError QualityCheck::of_vessel(std::int32_t vessel) {
  refresh();
  WholeError sum;
  double both = 0.0, sizes = 0.0;
  for (std::size_t k = 0; k < errors_.size(); ++k)
    if (errors_[k].vessel == vessel)
      add(sum, errors_[k], states_[k]->surfaces ? states_[k]->surfaces->missing_mm() : 0.0, both, sizes);
  sum.dice = sizes > 0.0 ? both / sizes : nothing;
  return sum;
}

WholeError QualityCheck::of_case() {
  refresh();
  WholeError sum;
  double both = 0.0, sizes = 0.0;
  for (std::size_t k = 0; k < errors_.size(); ++k)
    add(sum, errors_[k], states_[k]->surfaces ? states_[k]->surfaces->missing_mm() : 0.0, both, sizes);
  sum.dice = sizes > 0.0 ? both / sizes : nothing;
  return sum;
}

std::optional<std::size_t> QualityCheck::next_worst() {
  refresh();
  const auto worst = [&] {
    std::optional<std::size_t> found;
    for (std::size_t k = 0; k < errors_.size(); ++k) {
      if (!(errors_[k].surfaces.area_mm2 > 0.0)) continue;
      if (std::find(visited_.begin(), visited_.end(), k) != visited_.end()) continue;
      if (!found || errors_[k].surfaces.mean_mm() > errors_[*found].surfaces.mean_mm()) found = k;
    }
    return found;
  };
  std::optional<std::size_t> next = worst();
  if (!next) {
    visited_.clear();
    next = worst();
  }
  if (!next) return next;
  visited_.push_back(*next);
  go_to(*next);
  return next;
}

void QualityCheck::go_to(std::size_t section) {
  refresh();
  if (section >= errors_.size() || !errors_[section].matched()) return;
  const SectionError& one = errors_[section];
  double worst = -1.0, s = 0.5 * (one.from_mm + one.to_mm);
  for (const ContourError& c : one.contours)
    if (c.found && c.difference.mean_mm > worst) {
      worst = c.difference.mean_mm;
      s = c.s_mm;
    }
  bench_.vessel.set(one.vessel);
  bench_.cursor_mm.set(bench_.here_mm(s));
}

std::vector<double> QualityCheck::wall_errors(const std::vector<Vec3>& points,
                                              const std::vector<WallPlace>& places, double reach_mm) {
  match();
  const lumen::LumenModel* model = bench_.model();
  if (points.size() != places.size())
    throw InvalidInput("there are " + std::to_string(points.size()) + " points of the wall and " +
                       std::to_string(places.size()) + " places");
  std::vector<double> errors(points.size(), nothing);
  if (!model) return errors;
  for (std::size_t k = 0; k < matched_.size(); ++k) {
    const TruthSection& of = matched_[k];
    if (of.vessel == Workbench::no_vessel) continue;
    if (!states_[k]->tree) states_[k]->tree.emplace(of.surface);
    const Box3 box(Vec3(of.box.min().array() - reach_mm), Vec3(of.box.max().array() + reach_mm));
    const std::int32_t owner =
        lumen::owner_at(model->tree, of.vessel, 0.5 * (of.s_mm.front() + of.s_mm.back()));
    const auto& triangles = of.surface.triangles;
    core::parallel_for(points.size(), 2048, [&](std::size_t i) {
      if (places[i].vessel != owner && places[i].vessel != of.vessel) return;
      if (places[i].s_mm < of.s_mm.front() || places[i].s_mm > of.s_mm.back()) return;
      if (!box.contains(points[i])) return;
      const auto near = states_[k]->tree->closest_within(points[i], reach_mm);
      if (!near) return;
      const auto& t = triangles[static_cast<std::size_t>(near->triangle)];
      const auto corner = [&](std::size_t c) { return of.surface.points[static_cast<std::size_t>(t[c])]; };
      const Vec3 normal = (corner(1) - corner(0)).cross(corner(2) - corner(0));
      const double side = normal.dot(points[i] - near->point) < 0.0 ? -1.0 : 1.0;
      if (std::isnan(errors[i]) || near->distance < std::abs(errors[i])) errors[i] = side * near->distance;
    });
  }
  return errors;
}

}  // namespace ostia::session
