#include "ostia/phantom/anatomy.h"

#include "coronaries/coronary_courses.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace ostia::phantom {
namespace {

constexpr std::array<std::pair<Anatomy, const char*>, 6> words{{
    {Anatomy::usual, "usual"},
    {Anatomy::left_ostium_closed, "left-ostium-closed"},
    {Anatomy::right_ostium_closed, "right-ostium-closed"},
    {Anatomy::rca_from_left, "rca-from-left"},
    {Anatomy::lcx_from_right, "lcx-from-right"},
    {Anatomy::bypass, "bypass"},
}};

constexpr double closed_mm = 6.0;
constexpr double height_share = 0.62;  // of the sinuses, where they are widest and the ostia are

Course* find(CoursePlan& plan, const char* name) {
  const auto at = std::find_if(plan.courses.begin(), plan.courses.end(),
                               [&](const Course& course) { return course.name == name; });
  return at == plan.courses.end() ? nullptr : &*at;
}

/// Beside the root: `out_mm` beyond the widest sinus, at an angle from the left sinus towards the
/// right one (the short way where `share` runs from 0 to 1).
Vec3 beside_root(const AorticRoot& root, double angle, double out_mm) {
  const Vec3 side = root.axis.cross(root.left_sinus);
  return root.annulus + height_share * root.sinus_height_mm * root.axis +
         (root.sinus_radius_mm + out_mm) * (std::cos(angle) * root.left_sinus + std::sin(angle) * side);
}

/// From the left sinus to the right one about the root's axis: in (-pi, pi], the way in front of the root.
double right_angle(const AorticRoot& root) {
  const Vec3 side = root.axis.cross(root.left_sinus);
  return std::atan2(root.right_sinus.dot(side), root.right_sinus.dot(root.left_sinus));
}

/// Begins behind its closed ostium.
void close(Course& course) {
  const Vec3 first = course.beginning.front(), second = course.beginning.back();
  const Vec3 out = (second - first).normalized();
  const Vec3 begin = first + (0.6 + closed_mm) * out;
  course.beginning = {begin, begin + 2.5 * out, begin + 5.0 * out};
}

/// Along the root from an ostium in one sinus to the other side, `clear_mm` off the wall.
std::vector<Vec3> about_root(const AorticRoot& root, double from, double to, double clear_mm) {
  std::vector<Vec3> way{beside_root(root, from, -1.2)};
  constexpr int steps = 4;
  for (int i = 0; i <= steps; ++i)
    way.push_back(beside_root(root, from + (to - from) * (0.12 + 0.88 * i / steps), clear_mm));
  return way;
}

void from_other_sinus(CoursePlan& plan, const AorticRoot& root, Anatomy anatomy) {
  const double right = right_angle(root);
  if (anatomy == Anatomy::rca_from_left) {
    // In front of the root, between it and the pulmonary trunk; its ostium beside the left main's.
    find(plan, "RCA")->beginning = about_root(root, 0.28 * right, right, 3.0);
    return;
  }
  // Behind the root: on from the right sinus, away from the left one, the long way round.
  Course& lcx = *find(plan, "LCX");
  const double turn = right > 0.0 ? 2.0 * std::numbers::pi : -2.0 * std::numbers::pi;
  lcx.beginning = about_root(root, right + 0.12 * turn, 0.93 * turn, 3.4);
  // Its radius was a share of the left main's, which is the LAD's alone now.
  Course& lad = *find(plan, "LAD");
  const double radius = lcx.start_radius_mm * lad.start_radius_mm;
  lad.start_radius_mm = std::cbrt(std::pow(lad.start_radius_mm, 3.0) - std::pow(radius, 3.0));
  lcx.start_radius_mm = radius;
  lcx.parent.clear();
  lcx.parent_s_mm = 0.0;
}

/// A vein graft of 4 mm, over the right ventricle's outflow tract to the middle of the LAD.
Course graft(const HeartShape& heart) {
  const AorticRoot& root = heart.root;
  const double anterior = heart.anterior_groove_rad * 180.0 / std::numbers::pi;
  Vec3 front = -Vec3::UnitY();
  front = (front - front.dot(root.axis) * root.axis).normalized();
  const Vec3 begin = root.annulus + (root.sinus_height_mm + 22.0) * root.axis;
  const double r = root.ascending_radius_mm;
  Course course;
  course.name = "SVG";
  course.beginning = {begin + (r - 0.6) * front, begin + (r + 2.5) * front, begin + (r + 6.0) * front};
  course.way = {{anterior - 8.0, 0.0, 17.0}, {anterior - 6.0, 0.2, 11.0}, {anterior - 4.0, 0.34, 6.0}};
  course.joins = "LAD";
  course.start_radius_mm = 2.0;
  course.end_radius_mm = 1.8;
  return course;
}

}  // namespace

const char* word(Anatomy anatomy) {
  for (const auto& [one, text] : words)
    if (one == anatomy) return text;
  return "";
}

Anatomy anatomy_of(const std::string& text) {
  for (const auto& [one, known] : words)
    if (text == known) return one;
  std::string all;
  for (const auto& [one, known] : words)
    all += (all.empty() ? "" : one == words.back().first ? " or " : ", ") + std::string(known);
  throw InvalidInput("the anatomy \"" + text + "\" is not known; it is " + all);
}

std::vector<std::string> anatomy_words() {
  std::vector<std::string> all;
  for (const auto& [one, known] : words) all.emplace_back(known);
  return all;
}

void change_origins(CoursePlan& plan, const HeartShape& heart, Anatomy anatomy) {
  switch (anatomy) {
    case Anatomy::usual:
      return;
    case Anatomy::left_ostium_closed:
      return close(*find(plan, "LAD"));
    case Anatomy::right_ostium_closed:
      return close(*find(plan, "RCA"));
    case Anatomy::rca_from_left:
    case Anatomy::lcx_from_right:
      return from_other_sinus(plan, heart.root, anatomy);
    case Anatomy::bypass:
      plan.courses.push_back(graft(heart));
      return;
  }
}

}  // namespace ostia::phantom
