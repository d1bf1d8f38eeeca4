#include "ostia/phantom/patient_heart.h"

#include "body/body_organs.h"
#include "coronaries/axis_place.h"
#include "coronaries/coronary_calibre.h"
#include "coronaries/coronary_disease.h"
#include "coronaries/coronary_segments.h"
#include "patient/patient_axes.h"
#include "patient/patient_growth.h"
#include "patient/patient_marks.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"
#include "ostia/geometry/polyline.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ostia::phantom {
namespace {

using core::rounded_text;

constexpr double least_size = 0.7, most_size = 1.4;
constexpr double most_off_mm = 20.0;
constexpr double end_radius_mm = 0.55;
constexpr double apart_mm = 2.4;  // of two lumina away from forks: both walls and 1.2 mm
constexpr double kin_apart_from_mm = 11.0;

/// A vessel before it has a wall.
struct Draft {
  std::string name;
  std::int32_t parent = -1;
  std::vector<Vec3> points;
  std::vector<double> radius;
  double measured_mm = 0.0;
};

void require_plausible(const HeartFit& fit) {
  const double size = std::cbrt(fit.size.prod());
  if (size < least_size || size > most_size)
    throw InvalidInput("these arteries would lie on a heart " + rounded_text(size, 2) +
                       " times as large as usual; is the mask's voxel size right?");
  if (fit.height_mm > most_off_mm || fit.groove_mm > most_off_mm)
    throw InvalidInput(
        "these arteries lie on no heart: they are " + rounded_text(fit.height_mm, 0) +
        " mm from its surface and " + rounded_text(fit.groove_mm, 0) +
        " mm from its grooves; is the mask one of coronary arteries, and do its axes run as its file says?");
}

/// An artery opens into the aorta: its line begins 0.6 mm within it.
void begin_in_aorta(Draft& draft, const HeartShape& heart, const HeartWarp& warp) {
  const Distance aorta = aortic_root(heart.root, 0.0);
  constexpr double within = -0.25, deep = -0.9;  // the function falls by less than 1 a mm
  constexpr double step_mm = 0.5, most_mm = 9.0;
  while (draft.points.size() > 8 && aorta(warp.to_own(draft.points[1])) < deep) {
    draft.points.erase(draft.points.begin());
    draft.radius.erase(draft.radius.begin());
  }
  std::vector<Vec3> before;
  Vec3 own = warp.to_own(draft.points.front());
  for (double way = 0.0; way < most_mm && aorta(own) > within; way += step_mm) {
    const Vec3 d = own - heart.root.annulus;
    const double height = std::clamp(d.dot(heart.root.axis), 0.45 * heart.root.sinus_height_mm,
                                     0.9 * heart.root.sinus_height_mm);
    own += step_mm * (heart.root.annulus + height * heart.root.axis - own).normalized();
    before.push_back(warp.to_world(own));
  }
  std::reverse(before.begin(), before.end());
  draft.radius.insert(draft.radius.begin(), before.size(), draft.radius.front());
  draft.points.insert(draft.points.begin(), before.begin(), before.end());
}

/// Whether a place is clear of all other drafts than `own` and its kin there.
bool is_clear(const std::vector<Draft>& drafts, std::size_t own, const Vec3& place, double radius_mm) {
  for (std::size_t i = 0; i < drafts.size(); ++i) {
    if (i == own) continue;
    for (std::size_t k = 0; k < drafts[i].points.size(); ++k) {
      const double reach = radius_mm + drafts[i].radius[k] + apart_mm;
      if ((drafts[i].points[k] - place).squaredNorm() < reach * reach) return false;
    }
  }
  return true;
}

/// Goes on where the patient's vessel stops, as far as no other vessel is in the way.
void grow(std::vector<Draft>& drafts, std::size_t which, const Ground& ground) {
  Draft& draft = drafts[which];
  const double from = draft.radius.back();
  std::vector<Vec3> more = grown_end(ground, draft.name, draft.points, from);
  std::size_t clear = 0;
  while (clear < more.size() && is_clear(drafts, which, more[clear], from)) ++clear;
  if (clear < 2) return;
  more.resize(clear);
  std::vector<Vec3> line{draft.points.back()};
  line.insert(line.end(), more.begin(), more.end());
  line = geometry::resample(line, 1.0);
  const double to = std::min(from, end_radius_mm);
  // The line's first millimetres would make a corner at the joint.
  for (std::size_t i = 3; i < line.size(); ++i) {
    draft.points.push_back(line[i]);
    draft.radius.push_back(from +
                           (to - from) * static_cast<double>(i) / static_cast<double>(line.size() - 1));
  }
}

/// A draft's axis and walls; its parent's are there already.
CoronaryVessel vessel_of_draft(const Draft& draft, std::int32_t id, const CoronaryTree& tree,
                               std::uint64_t seed) {
  CoronaryVessel vessel;
  vessel.id = id;
  vessel.name = draft.name;
  vessel.parent = draft.parent;
  std::vector<Vec3> points = draft.points;
  Vec3 normal = Vec3::Zero();
  double widest = 1e9;
  if (draft.parent >= 0) {
    const CoronaryVessel& parent = tree.vessels[static_cast<std::size_t>(draft.parent)];
    const auto foot = geometry::closest(parent.axis.points, points.front());
    vessel.parent_s_mm = foot.abscissa;
    points.front() = foot.point;
    // Its first points lie where the parent's axis was before it was made smooth.
    constexpr double led_mm = 4.0;
    const Vec3 off = foot.point - draft.points.front();
    const std::vector<double> s = geometry::abscissas(draft.points);
    for (std::size_t i = 1; i < points.size() && s[i] < led_mm; ++i) points[i] += (1.0 - s[i] / led_mm) * off;
    normal = parent.axis.frames[foot.segment].normal;
    widest = 0.97 * radius_before_branch(parent, foot.abscissa);
  }
  vessel.axis = smooth_axis(points, draft.radius, normal);
  const std::vector<double> s = geometry::abscissas(points);
  const double stretch = s.back() / vessel.axis.abscissa.back();
  const auto healthy = [&](double at) {
    const double x = at * stretch;
    const auto after = std::upper_bound(s.begin(), s.end(), x) - s.begin();
    const auto j = std::clamp<std::size_t>(static_cast<std::size_t>(after), 1, s.size() - 1);
    const double t = std::clamp((x - s[j - 1]) / std::max(1e-9, s[j] - s[j - 1]), 0.0, 1.0);
    return std::min(widest, (1.0 - t) * draft.radius[j - 1] + t * draft.radius[j]);
  };
  set_profiles(vessel, healthy, seed);
  return vessel;
}

const CoronaryVessel* vessel_named(const CoronaryTree& tree, const std::string& name) {
  for (const CoronaryVessel& vessel : tree.vessels)
    if (vessel.name == name) return &vessel;
  return nullptr;
}

double lcx_abscissa(const CoronaryTree& tree, std::int32_t lad) {
  constexpr double usual_mm = 11.0;
  for (const CoronaryVessel& vessel : tree.vessels)
    if (vessel.name == "LCX" && vessel.parent == lad) return vessel.parent_s_mm;
  return usual_mm;
}

/// Whether a drawn vessel keeps clear of all vessels, but of its parent and those beside its origin for a
/// while.
bool keeps_clear(const CoronaryTree& tree, const CoronaryVessel& vessel) {
  for (const CoronaryVessel& other : tree.vessels) {
    const bool kin = other.id == vessel.parent || (other.parent == vessel.parent && vessel.parent >= 0 &&
                                                   std::abs(other.parent_s_mm - vessel.parent_s_mm) < 6.0);
    for (std::size_t i = 0; i < vessel.axis.size(); i += 5) {
      if (kin && vessel.axis.abscissa[i] < kin_apart_from_mm) continue;
      for (std::size_t j = 0; j < other.axis.size(); j += 5) {
        const double reach = vessel.axis.radius[i] + other.axis.radius[j] + apart_mm;
        if ((vessel.axis.points[i] - other.axis.points[j]).squaredNorm() < reach * reach) return false;
      }
    }
  }
  return true;
}

/// Whether the parent has a branch of its own where one would be drawn.
bool is_taken(const CoronaryTree& tree, std::int32_t parent, double s_mm) {
  constexpr double near_mm = 10.0;
  return std::any_of(tree.vessels.begin(), tree.vessels.end(), [&](const CoronaryVessel& vessel) {
    return vessel.parent == parent && vessel.name != "LCX" && std::abs(vessel.parent_s_mm - s_mm) < near_mm;
  });
}

/// Draws a usual vessel that the patient lacks, where there is room for it.
bool draw(CoronaryTree& tree, const Ground& ground, const std::string& name, const std::string& parent_name) {
  const CoronaryVessel* parent = parent_name.empty() ? nullptr : vessel_named(tree, parent_name);
  if (parent == nullptr && !parent_name.empty()) return false;
  const double lcx = parent == nullptr ? 0.0 : lcx_abscissa(tree, parent->id);
  const auto usual = usual_vessel(ground, name, parent == nullptr ? nullptr : &parent->axis, lcx);
  if (!usual) return false;
  const bool main = name == "LCX" || name == "RCA";
  if (!main && is_taken(tree, parent->id, usual->parent_s_mm)) return false;
  CoronaryVessel vessel;
  vessel.id = static_cast<std::int32_t>(tree.vessels.size());
  vessel.name = name;
  vessel.parent = parent == nullptr ? -1 : parent->id;
  vessel.parent_s_mm = usual->parent_s_mm;
  const double start = usual->course.start_radius_mm *
                       (parent == nullptr ? 1.0 : radius_before_branch(*parent, usual->parent_s_mm));
  if (start < end_radius_mm) return false;
  vessel.axis = smooth_axis(
      usual->points, std::vector<double>(usual->points.size(), start),
      parent == nullptr ? Vec3(Vec3::Zero()) : place_at(parent->axis, usual->parent_s_mm).frame.normal);
  set_calibre(vessel, start, std::min(start, usual->course.end_radius_mm), usual->course.taper_power, {},
              ground.seed);
  if (!main && !keeps_clear(tree, vessel)) return false;
  tree.vessels.push_back(std::move(vessel));
  return true;
}

void draw_missing(CoronaryTree& tree, const Ground& ground, std::vector<std::string>& remarks) {
  const char* const last = ground.dominance == Dominance::left ? "LCX" : "RCA";
  const std::pair<const char*, const char*> usual[] = {
      {"RCA", ""},   {"LCX", "LAD"}, {"PDA", last}, {"D1", "LAD"}, {"OM1", "LCX"},
      {"S1", "LAD"}, {"AM", "RCA"},  {"CB", "RCA"}, {"D2", "LAD"}, {"OM2", "LCX"}};
  std::string drawn;
  for (const auto& [name, parent] : usual) {
    if (vessel_named(tree, name) != nullptr || !draw(tree, ground, name, parent)) continue;
    drawn += (drawn.empty() ? "" : ", ") + std::string(name);
  }
  if (!drawn.empty()) remarks.push_back("not in the patient's tree, and drawn: " + drawn);
}

/// How far the marks are from where arteries usually run, after the heart was bent.
void measure_left(PatientRecord& record, const HeartShape& heart, const HeartWarp& warp,
                  const LaidOut& laid) {
  double height = 0.0, groove = 0.0, n = 0.0, in_grooves = 0.0;
  for (const CourseMark& mark : laid.marks) {
    const HeartPlace place = heart_place(heart, warp.to_own(laid.fit.placed(mark.world)));
    const double above = place.outwards_mm - usual_height_mm(heart, mark.groove, place);
    height += above * above;
    n += 1.0;
    if (mark.groove == Groove::none) continue;
    const HeartPlace in = in_groove(heart, mark.groove, place);
    const double off =
        (heart.epicardium(in.phi_rad, in.depth) - heart.epicardium(place.phi_rad, place.depth)).norm();
    groove += off * off;
    in_grooves += 1.0;
  }
  record.height_left_mm = std::sqrt(height / std::max(1.0, n));
  record.groove_left_mm = std::sqrt(groove / std::max(1.0, in_grooves));
}

PatientRecord record_of(const PatientTree& patient, const KeptTree& kept, const LaidOut& laid,
                        const HeartWarp& warp) {
  PatientRecord record;
  record.digest = patient.digest;
  record.rim_mm = patient.rim_mm;
  record.rotation = laid.fit.rotation;
  record.shift_mm = laid.fit.shift;
  record.size = laid.fit.size;
  record.height_mm = laid.fit.height_mm;
  record.groove_mm = laid.fit.groove_mm;
  record.least_jacobian = warp.least_jacobian();
  record.largest_jacobian = warp.largest_jacobian();
  record.longest_mm = warp.longest_mm();
  record.smoothings = warp.smoothings();
  record.remarks = patient.remarks;
  record.remarks.insert(record.remarks.end(), kept.remarks.begin(), kept.remarks.end());
  return record;
}

/// A tree needs a left one, with its main vessel: nothing else tells where the heart is.
void require_lad(const KeptTree& kept) {
  if (kept.lad) return;
  throw InvalidInput(
      "no vessel of these is surely a left anterior descending artery: a heart cannot be laid under them; "
      "name it in the workstation and give the case");
}

std::vector<Draft> drafts_of(const KeptTree& kept, const HeartFit& fit, double rim_mm) {
  std::vector<Draft> drafts;
  for (const PatientVessel& vessel : kept.vessels) {
    Draft draft;
    draft.name = vessel.name;
    draft.parent = vessel.parent;
    for (const Vec3& p : vessel.points) draft.points.push_back(fit.placed(p));
    draft.radius = healthy_calibre(draft.points, vessel.radius_mm, rim_mm);
    draft.measured_mm = geometry::length(draft.points);
    drafts.push_back(std::move(draft));
  }
  return drafts;
}

}  // namespace

PatientHeart patient_heart(const PatientTree& patient, const HeartShape& heart,
                           const CoronaryOptions& options) {
  validate(patient);
  if (options.anatomy != Anatomy::usual)
    throw InvalidInput(std::string("the anatomy \"") + word(options.anatomy) +
                       "\" is of drawn trees; a patient's arteries leave the aorta where they do");
  const KeptTree kept = kept_tree(patient);
  require_lad(kept);
  const LaidOut laid = lay_out(patient, kept, heart);
  require_plausible(laid.fit);
  PatientHeart out;
  out.warp = std::make_shared<const HeartWarp>(landmarks(heart, laid));
  out.record = record_of(patient, kept, laid, *out.warp);
  measure_left(out.record, heart, *out.warp, laid);
  const Dominance dominance = patient.dominance.value_or(Dominance::right);
  const Ground ground{heart, *out.warp, dominance, options.seed};
  out.tree.dominance = dominance;
  std::vector<Draft> drafts = drafts_of(kept, laid.fit, patient.rim_mm);
  for (Draft& draft : drafts)
    if (draft.parent < 0) begin_in_aorta(draft, heart, *out.warp);
  for (std::size_t i = 0; i < drafts.size(); ++i) grow(drafts, i, ground);
  for (std::size_t i = 0; i < drafts.size(); ++i)
    out.tree.vessels.push_back(
        vessel_of_draft(drafts[i], static_cast<std::int32_t>(i), out.tree, options.seed));
  draw_missing(out.tree, ground, out.record.remarks);
  for (CoronaryVessel& vessel : out.tree.vessels) {
    const auto i = static_cast<std::size_t>(vessel.id);
    const double length = vessel.axis.abscissa.back(),
                 measured = i < drafts.size() ? std::min(length, drafts[i].measured_mm) : 0.0;
    out.record.parts.push_back({vessel.name, measured, length - measured});
    if (vessel.parent >= 0)
      vessel.s_free_mm = free_abscissa(vessel, out.tree.vessels[static_cast<std::size_t>(vessel.parent)]);
    add_segments(vessel, out.tree, dominance);
  }
  draw_disease(out.tree, options.disease, options.seed);
  return out;
}

PatientLie lie_of(const PatientTree& patient, const HeartShape& heart) {
  validate(patient);
  const KeptTree kept = kept_tree(patient);
  PatientLie lie;
  lie.left = kept.lad.has_value();
  lie.right = kept.rca.has_value();
  if (!lie.left) return lie;
  const HeartFit fit = lay_out(patient, kept, heart).fit;
  lie.height_mm = fit.height_mm;
  lie.groove_mm = fit.groove_mm;
  lie.size = fit.size;
  return lie;
}

}  // namespace ostia::phantom
