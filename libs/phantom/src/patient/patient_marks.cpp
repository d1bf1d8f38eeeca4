#include "patient/patient_marks.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"
#include "ostia/geometry/polyline.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostia::phantom {
namespace {

constexpr double mark_every_mm = 3.0, behind_ostium_mm = 15.0, behind_fork_mm = 6.0;
constexpr double within_muscle_mm = 6.0;

/// The chest about the heart (body_thorax.cpp): middle and half widths of the inside of the ribs, the spine.
constexpr double chest_x = -8.0, chest_y = 16.0, half_x = 120.0, half_y = 87.5, chest_spine_y = 84.0;

std::size_t root_of(const std::vector<PatientVessel>& vessels, std::size_t i) {
  while (vessels[i].parent >= 0) i = static_cast<std::size_t>(vessels[i].parent);
  return i;
}

constexpr std::size_t nowhere = static_cast<std::size_t>(-1);

bool is_named(const std::vector<PatientVessel>& vessels, const std::string& name) {
  return std::ranges::find(vessels, name, &PatientVessel::name) != vessels.end();
}

/// The root of the tree with a vessel of a name.
std::size_t root_of_named(const std::vector<PatientVessel>& vessels, const std::string& name) {
  for (std::size_t i = 0; i < vessels.size(); ++i)
    if (vessels[i].name == name) return root_of(vessels, i);
  return nowhere;
}

/// A landmark unless another one is near.
class Sparse {
 public:
  explicit Sparse(WarpLandmarks& all) : all_(all) {}
  void add(const Vec3& world, const Vec3& own, double clear_mm) {
    for (const Vec3& known : all_.world)
      if ((known - world).squaredNorm() < clear_mm * clear_mm) return;
    all_.add(world, own);
  }

 private:
  WarpLandmarks& all_;
};

/// The root goes with its two ostia: turned by 12 degrees at most, 0.8 to 1.25 times as large.
void add_root(Sparse& sparse, const HeartShape& heart, const HeartFit& fit, const Ostia& patient) {
  const Ostia usual = usual_ostia(heart.root);
  const Vec3 left = fit.placed(patient.left), right = fit.placed(patient.right);
  sparse.add(left, usual.left, 0.0);
  sparse.add(right, usual.right, 3.0);
  constexpr double most_turn = 12.0 * std::numbers::pi / 180.0;
  Eigen::AngleAxisd turn(Eigen::Quaterniond::FromTwoVectors(usual.right - usual.left, right - left));
  turn.angle() = std::min(turn.angle(), most_turn);
  const double size = std::clamp((right - left).norm() / (usual.right - usual.left).norm(), 0.8, 1.25);
  const Vec3 from = 0.5 * (usual.left + usual.right), to = 0.5 * (left + right);
  const AorticRoot& root = heart.root;
  const Vec3 side = root.axis.cross(root.left_sinus);
  for (const double height : {0.0, 0.62, 1.3}) {
    for (int k = 0; k < 6; ++k) {
      const double angle = k * std::numbers::pi / 3.0;
      const double radius = height > 1.0   ? root.ascending_radius_mm
                            : height > 0.0 ? root.sinus_radius_mm
                                           : root.annulus_radius_mm;
      const Vec3 own = root.annulus + height * root.sinus_height_mm * root.axis +
                       radius * (std::cos(angle) * root.left_sinus + std::sin(angle) * side);
      sparse.add(to + size * (turn * (own - from)), own, 8.0);
    }
  }
}

/// Along the arteries: to their grooves and their usual height, by no more than 14 mm.
void add_courses(Sparse& sparse, const HeartShape& heart, const LaidOut& laid) {
  constexpr double clear_mm = 7.0, most_mm = 14.0;
  for (const bool grooves : {true, false}) {
    for (const CourseMark& mark : laid.marks) {
      if ((mark.groove != Groove::none) != grooves) continue;
      const Vec3 world = laid.fit.placed(mark.world), own = resized(heart, laid.fit, world);
      HeartPlace place = in_groove(heart, mark.groove, heart_place(heart, own));
      place.outwards_mm = usual_height_mm(heart, mark.groove, place);
      Vec3 way = heart.epicardium(place.phi_rad, place.depth, place.outwards_mm) - own;
      if (way.norm() > most_mm) way *= most_mm / way.norm();
      sparse.add(world, own + way, clear_mm);
    }
  }
}

/// Where no artery says anything the heart is as it was, only larger or smaller.
void add_between(Sparse& sparse, const HeartShape& heart, const HeartFit& fit) {
  constexpr double clear_mm = 20.0;
  const auto add = [&](const Vec3& own) { sparse.add(unresized(heart, fit, own), own, clear_mm); };
  for (const double depth : {-0.15, 0.1, 0.35, 0.6, 0.82, 0.97})
    for (int k = 0; k < 12; ++k) add(heart.epicardium(k * std::numbers::pi / 6.0, depth));
  for (const double depth : {0.1, 0.4, 0.7})
    for (const double aside : {-0.3, 0.35})
      add(heart.base + depth * heart.length_mm * heart.long_axis +
          aside * (1.0 - depth) * heart.half_width_right_mm * heart.right);
}

/// Ribs, spine and skin stay.
void add_chest(Sparse& sparse) {
  constexpr double clear_mm = 14.0;
  for (const double z : {-150.0, -100.0, -50.0, 0.0, 50.0, 100.0, 150.0}) {
    sparse.add({chest_x, chest_spine_y, z}, {chest_x, chest_spine_y, z}, clear_mm);
    for (int k = 0; k < 12; ++k) {
      const double angle = k * std::numbers::pi / 6.0;
      const Vec3 p(chest_x + (half_x + 22.0) * std::cos(angle), chest_y + (half_y + 22.0) * std::sin(angle),
                   z);
      sparse.add(p, p, clear_mm);
    }
  }
  for (const double z : {-185.0, 185.0})
    for (const double x : {-90.0, 0.0, 90.0})
      for (const double y : {-50.0, 40.0}) sparse.add({x, y, z}, {x, y, z}, clear_mm);
}

}  // namespace

void validate(const PatientTree& patient) {
  const auto require = [](bool good, const std::string& what) {
    if (!good) throw InvalidInput("a patient's tree: " + what);
  };
  require(!patient.vessels.empty(), "there is no vessel in it");
  require(patient.rim_mm >= 0.0 && patient.rim_mm <= 1.0, "the rim must be 0 to 1 mm");
  for (std::size_t i = 0; i < patient.vessels.size(); ++i) {
    const PatientVessel& vessel = patient.vessels[i];
    const std::string which = "vessel " + std::to_string(i + 1);
    require(vessel.points.size() >= 4, which + " has fewer than four points");
    require(vessel.points.size() == vessel.radius_mm.size(), which + " has not one radius a point");
    require(vessel.parent < static_cast<std::int32_t>(i), which + " comes before its parent");
    for (std::size_t k = 0; k < vessel.points.size(); ++k)
      require(vessel.points[k].allFinite() && std::isfinite(vessel.radius_mm[k]) && vessel.radius_mm[k] > 0.0,
              which + " has a place or a radius that is none");
  }
}

KeptTree kept_tree(const PatientTree& patient) {
  KeptTree kept;
  std::vector<PatientVessel> all = patient.vessels;
  const std::size_t left = root_of_named(all, "LAD");
  std::size_t right = root_of_named(all, "RCA");
  if (right == left) right = nowhere;
  // Of two trees the one without an LAD is the right one, whatever could be said of its branches.
  if (left != nowhere && right == nowhere) {
    double longest = 25.0;
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (all[i].parent >= 0 || i == left) continue;
      const double length = geometry::length(all[i].points);
      if (length <= longest) continue;
      longest = length;
      right = i;
    }
    if (right != nowhere && root_of_named(all, "RCA") == nowhere) {
      all[right].name = "RCA";
      kept.remarks.push_back(
          "the other tree's main vessel was not sure to be the right coronary artery; it was taken for it");
    }
  }
  std::vector<std::int32_t> place(all.size(), -1);
  std::size_t dropped = 0;
  double dropped_mm = 0.0;
  int number = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::size_t root = root_of(all, i);
    if (root != left && root != right) {
      ++dropped;
      dropped_mm += geometry::length(all[i].points);
      continue;
    }
    PatientVessel vessel = all[i];
    if (vessel.parent >= 0) vessel.parent = place[static_cast<std::size_t>(vessel.parent)];
    if (vessel.name.empty() || is_named(kept.vessels, vessel.name))
      vessel.name = "V" + std::to_string(++number);
    place[i] = static_cast<std::int32_t>(kept.vessels.size());
    kept.vessels.push_back(std::move(vessel));
  }
  if (left != nowhere) kept.lad = static_cast<std::size_t>(place[left]);
  if (right != nowhere) kept.rca = static_cast<std::size_t>(place[right]);
  if (dropped > 0)
    kept.remarks.push_back(std::to_string(dropped) + (dropped == 1 ? " vessel" : " vessels") + " of " +
                           core::rounded_text(dropped_mm, 0) + " mm in all that " +
                           (dropped == 1 ? "hangs" : "hang") + " on neither ostium " +
                           (dropped == 1 ? "was" : "were") + " left out");
  return kept;
}

std::vector<CourseMark> course_marks(const KeptTree& tree) {
  std::vector<CourseMark> marks;
  for (std::size_t v = 0; v < tree.vessels.size(); ++v) {
    const PatientVessel& vessel = tree.vessels[v];
    const Groove groove = groove_of(vessel.name);
    if (groove == Groove::within) continue;
    const double length = geometry::length(vessel.points);
    for (double s = vessel.parent < 0 ? behind_ostium_mm : behind_fork_mm; s <= length; s += mark_every_mm)
      marks.push_back(
          {geometry::at_abscissa(vessel.points, s).point, groove, v, groove == Groove::none ? 0.6 : 1.0});
  }
  return marks;
}

std::vector<CourseMark> sorted_marks(const HeartShape& heart, const HeartFit& fit,
                                     std::vector<CourseMark> marks) {
  std::vector<CourseMark> out;
  for (CourseMark mark : marks) {
    const HeartPlace place = heart_place(heart, resized(heart, fit, fit.placed(mark.world)));
    if (mark.groove == Groove::none && place.outwards_mm < -within_muscle_mm) continue;
    if (mark.groove == Groove::anterior && place.depth < 0.1) mark.groove = Groove::none;
    if (mark.groove == Groove::posterior && place.depth < 0.08) mark.groove = Groove::none;
    if (mark.groove == Groove::atrioventricular && (place.depth > 0.16 || place.depth < -0.25))
      mark.groove = Groove::none;
    out.push_back(mark);
  }
  return out;
}

LaidOut lay_out(const PatientTree& patient, const KeptTree& tree, const HeartShape& heart) {
  LaidOut laid;
  const std::vector<CourseMark> all = course_marks(tree);
  if (all.size() < 12)
    throw InvalidInput("a patient's tree: its vessels are too short to tell where the heart is");
  if (tree.lad && tree.rca)
    laid.ostia = Ostia{tree.vessels[*tree.lad].points.front(), tree.vessels[*tree.rca].points.front()};
  if (tree.lad && !tree.rca) {  // the other one where it usually is beside it
    const Ostia usual = usual_ostia(heart.root);
    const Vec3 left = tree.vessels[*tree.lad].points.front();
    laid.ostia = Ostia{
        left, left + turned_to_heart(heart, patient.long_axis).transpose() * (usual.right - usual.left)};
  }
  const Ostia* ostia = laid.ostia ? &*laid.ostia : nullptr;
  laid.marks = all;
  laid.fit = fit_heart(heart, laid.marks, ostia, patient.long_axis);
  for (int round = 0; round < 2; ++round) {
    laid.marks = sorted_marks(heart, laid.fit, all);
    laid.fit = fit_heart(heart, laid.marks, ostia, patient.long_axis);
  }
  return laid;
}

WarpLandmarks landmarks(const HeartShape& heart, const LaidOut& laid) {
  WarpLandmarks out;
  Sparse sparse(out);
  if (laid.ostia) add_root(sparse, heart, laid.fit, *laid.ostia);
  add_courses(sparse, heart, laid);
  add_between(sparse, heart, laid.fit);
  add_chest(sparse);
  return out;
}

}  // namespace ostia::phantom
