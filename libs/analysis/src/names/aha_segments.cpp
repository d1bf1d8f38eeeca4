#include "ostia/analysis/aha_segments.h"

#include "names/vessel_names.h"
#include "names/vessel_way.h"

#include <algorithm>
#include <cmath>

namespace ostia::analysis {
namespace {

constexpr double large_branch_mm = 1.5;   // wide
constexpr double branch_begin_mm = 10.0;  // over which a branch's width is taken
constexpr double apart_mm = 5.0;          // of the two branches that bound the mid LAD
constexpr double least_segment_mm = 0.5;

const AhaSegment& aha(int number) {
  return aha_segments()[static_cast<std::size_t>(number - 1)];
}

struct Branch {
  double s_mm = 0.0;
  double diameter_mm = 0.0;
  ParsedName name;
};

double begin_diameter(const geometry::TreeSegment& segment) {
  std::vector<double> radii;
  for (std::size_t i = 0; i < segment.axis.radius.size(); ++i) {
    if (i < segment.axis.abscissa.size() && segment.axis.abscissa[i] > branch_begin_mm) break;
    radii.push_back(segment.axis.radius[i]);
  }
  if (radii.empty()) return 0.0;
  const auto middle = radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2);
  std::nth_element(radii.begin(), middle, radii.end());
  return 2.0 * *middle;
}

/// Cuts one vessel's own stretch.
class Cutter {
 public:
  Cutter(const lumen::LumenModel& model, const geometry::Vessel& vessel, double main_mm)
      : vessel_(vessel), name_(parsed(vessel.name)), main_mm_(main_mm) {
    const lumen::VesselLumen& wall = lumen::vessel(model, vessel.id);
    at_ = wall.own_from_mm;
    end_ = wall.axis->length();
    for (const Leaving& leaving : leaving_branches(model, vessel.id)) {
      if (leaving.s_mm < at_) continue;
      branches_.push_back({leaving.s_mm, begin_diameter(geometry::segment(model.tree, leaving.segment)),
                           parsed(owner_of_segment(model.tree, leaving.segment).name)});
    }
    from_left_ = leaves_left(model);
  }

  std::vector<VesselSegment> cut() {
    if (at_ < main_mm_) add(5, main_mm_);
    switch (name_.kind) {
      case VesselKind::lad:
        cut_lad();
        break;
      case VesselKind::lcx:
        cut_lcx();
        break;
      case VesselKind::rca:
        cut_rca();
        break;
      default:
        add(number_of_side_branch(), end_);
    }
    if (!segments_.empty()) segments_.back().to_mm = end_;
    return std::move(segments_);
  }

 private:
  void cut_lad() {
    const auto bounds = [&](const Branch& b) {
      return b.name.kind == VesselKind::diagonal ||
             (b.name.kind != VesselKind::lcx && b.name.kind != VesselKind::ramus &&
              b.diameter_mm >= large_branch_mm);
    };
    const double first = first_branch(at_ + least_segment_mm, bounds, at_ + (end_ - at_) / 3.0);
    add(6, first);
    add(7, first_branch(first + apart_mm, bounds, 0.5 * (first + end_)));
    add(8, end_);
  }
  void cut_lcx() {
    const auto bounds = [&](const Branch& b) {
      if (b.name.kind == VesselKind::lad || b.name.kind == VesselKind::ramus || posterior(b)) return false;
      return b.name.kind == VesselKind::marginal || b.diameter_mm >= large_branch_mm;
    };
    add(11, first_branch(at_ + least_segment_mm, bounds, 0.5 * (at_ + end_)));
    add(13, end_);
  }
  void cut_rca() {
    const double begin = at_;
    const double crux = first_branch(
        begin, [](const Branch& b) { return b.name.kind == VesselKind::pda; }, end_);
    const auto marginal = [](const Branch& b) { return b.name.kind == VesselKind::acute; };
    const double margin = std::min(first_branch(begin, marginal, begin + 0.5 * (crux - begin)), crux);
    add(1, 0.5 * (begin + margin));
    add(2, margin);
    add(3, crux);
    add(16, end_);
  }
  static bool posterior(const Branch& b) {
    return b.name.kind == VesselKind::pda || b.name.kind == VesselKind::left_pda ||
           b.name.kind == VesselKind::plb || b.name.kind == VesselKind::left_plb;
  }

  int number_of_side_branch() const {
    const bool first = name_.number <= 1, second = name_.number == 2;
    switch (name_.kind) {
      case VesselKind::lm:
        return 5;
      case VesselKind::diagonal:
        return first ? 9 : second ? 10 : 0;
      case VesselKind::marginal:
        return first ? 12 : second ? 14 : 0;
      case VesselKind::ramus:
        return 17;
      case VesselKind::pda:
        return from_left_ ? 15 : 4;
      case VesselKind::plb:
        return from_left_ ? 18 : 16;
      case VesselKind::left_pda:
        return 15;
      case VesselKind::left_plb:
        return 18;
      default:
        return 0;
    }
  }
  /// Whether the vessel that this one leaves is of the left tree.
  bool leaves_left(const lumen::LumenModel& model) const {
    for (std::size_t i = vessel_.segments.size(); i-- > 0;) {
      const geometry::Vessel& owner = owner_of_segment(model.tree, vessel_.segments[i]);
      if (owner.id == vessel_.id) continue;
      const std::string main = main_vessel_of(owner.name);
      return main == "LCX" || main == "LAD" || main == "LM";
    }
    return false;
  }

  template <class Accept>
  double first_branch(double from, const Accept& accept, double otherwise) const {
    for (const Branch& b : branches_) {
      if (b.s_mm >= from && accept(b)) return b.s_mm;
    }
    return otherwise;
  }
  /// Up to an abscissa; 0: none of the standard's. What is too short is left to the next.
  void add(int number, double to) {
    to = std::min(to, end_);
    if (!(to - at_ > least_segment_mm)) {
      if (segments_.empty() && to >= end_ && end_ > at_) push(number, to);
      return;
    }
    push(number, to);
  }
  void push(int number, double to) {
    VesselSegment segment{vessel_.id, at_, to, vessel_.name, std::nullopt};
    if (number > 0) {
      segment.aha = aha(number);
      segment.label = segment.aha->code + " (" + std::to_string(number) + ")";
    }
    segments_.push_back(std::move(segment));
    at_ = to;
  }

  const geometry::Vessel& vessel_;
  ParsedName name_;
  double main_mm_;
  double at_ = 0.0, end_ = 0.0;
  bool from_left_ = false;
  std::vector<Branch> branches_;
  std::vector<VesselSegment> segments_;
};

/// How many segments LAD and LCX share, and the vessel's abscissa there; 0 in a tree without both.
double left_main_mm(const lumen::LumenModel& model, const geometry::Vessel& vessel) {
  const geometry::Vessel *lad = nullptr, *lcx = nullptr;
  for (const geometry::Vessel& v : model.tree.vessels) {
    const VesselKind kind = parsed(v.name).kind;
    if (kind == VesselKind::lad && lad == nullptr) lad = &v;
    if (kind == VesselKind::lcx && lcx == nullptr) lcx = &v;
  }
  if (lad == nullptr || lcx == nullptr) return 0.0;
  std::size_t shared = 0;
  while (shared < std::min(lad->segments.size(), lcx->segments.size()) &&
         lad->segments[shared] == lcx->segments[shared])
    ++shared;
  if (shared == 0 || vessel.segments.size() < shared ||
      !std::equal(lad->segments.begin(), lad->segments.begin() + static_cast<std::ptrdiff_t>(shared),
                  vessel.segments.begin()))
    return 0.0;
  for (const Leaving& leaving : leaving_branches(model, vessel.id)) {
    if (leaving.behind == shared) return leaving.s_mm;
  }
  return 0.0;
}

}  // namespace

const std::vector<AhaSegment>& aha_segments() {
  static const std::vector<AhaSegment> segments{
      {1, "pRCA", "proximal RCA", "RCA"},
      {2, "mRCA", "mid RCA", "RCA"},
      {3, "dRCA", "distal RCA", "RCA"},
      {4, "R-PDA", "right posterior descending artery", "PDA"},
      {5, "LM", "left main", "LM"},
      {6, "pLAD", "proximal LAD", "LAD"},
      {7, "mLAD", "mid LAD", "LAD"},
      {8, "dLAD", "distal LAD", "LAD"},
      {9, "D1", "first diagonal branch", "D1"},
      {10, "D2", "second diagonal branch", "D2"},
      {11, "pLCX", "proximal LCX", "LCX"},
      {12, "OM1", "first obtuse marginal branch", "OM1"},
      {13, "dLCX", "mid and distal LCX", "LCX"},
      {14, "OM2", "second obtuse marginal branch", "OM2"},
      {15, "L-PDA", "left posterior descending artery", "PDA"},
      {16, "R-PLB", "right posterolateral branch", "RCA"},
      {17, "RI", "ramus intermedius", "RI"},
      {18, "L-PLB", "left posterolateral branch", "PLB"},
  };
  return segments;
}

std::vector<VesselSegment> segments_of(const lumen::LumenModel& model) {
  std::vector<VesselSegment> all;
  for (const geometry::Vessel& vessel : model.tree.vessels) {
    std::vector<VesselSegment> own = Cutter(model, vessel, left_main_mm(model, vessel)).cut();
    all.insert(all.end(), own.begin(), own.end());
  }
  return all;
}

const VesselSegment* segment_at(const std::vector<VesselSegment>& segments, std::int32_t vessel,
                                double s_mm) {
  const VesselSegment* found = nullptr;
  for (const VesselSegment& one : segments)
    if (one.vessel == vessel && (!found || one.from_mm <= s_mm)) found = &one;
  return found;
}

}  // namespace ostia::analysis
