#include "ostia/analysis/ostial_way.h"

#include "lesions/mouth.h"
#include "names/vessel_way.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <cmath>

namespace ostia::analysis {
namespace {

constexpr double ostium_step_mm = 0.05, farthest_radii = 3.0, least_way_mm = 2.0;

// The axis begins to turn so far before the joint: a section there is oblique to the parent, and too large.
constexpr double turn_mm = 0.25;

/// A straight line over a mouth; nothing where a side of it is not measured.
void lead_over(LumenProfile& profile, const Mouth& mouth) {
  const SectionMeasures before = profile.sections[mouth.before], behind = profile.sections[mouth.behind];
  if (!before.found || !behind.found) return;
  for (std::size_t i = mouth.before + 1; i < mouth.behind; ++i) {
    SectionMeasures& one = profile.sections[i];
    const double t = (one.s_mm - before.s_mm) / (behind.s_mm - before.s_mm);
    const auto mix = [t](double a, double b) { return (1.0 - t) * a + t * b; };
    one.found = true;
    one.open = false;
    one.diameter_mm = mix(before.diameter_mm, behind.diameter_mm);
    one.least_diameter_mm = mix(before.least_diameter_mm, behind.least_diameter_mm);
    one.largest_diameter_mm = mix(before.largest_diameter_mm, behind.largest_diameter_mm);
    one.perimeter_mm = mix(before.perimeter_mm, behind.perimeter_mm);
    one.area_mm2 = 0.25 * M_PI * one.diameter_mm * one.diameter_mm;
  }
}

}  // namespace

std::optional<Mouth> mouth_of(const LumenProfile& profile, const WayJoint& joint) {
  const auto& all = profile.sections;
  const auto [joint_mm, ostium_mm] = joint;
  if (!(ostium_mm > joint_mm) || !(joint_mm > 0.0) || all.size() < 3) return std::nullopt;
  const auto at_or_behind = [&](double s_mm) {
    return std::lower_bound(all.begin(), all.end(), s_mm - 1e-6,
                            [](const SectionMeasures& one, double s) { return one.s_mm < s; });
  };
  const auto first = at_or_behind(joint_mm), behind = at_or_behind(ostium_mm);
  if (first == all.begin() || behind == all.end()) return std::nullopt;
  auto before = first - 1;
  while (before != all.begin() && before->s_mm > joint_mm - turn_mm + 1e-6) --before;
  return Mouth{static_cast<std::size_t>(before - all.begin()),
               static_cast<std::size_t>(behind - all.begin())};
}

std::vector<Mouth> mouths_of(const LumenProfile& profile, const std::vector<WayJoint>& joints) {
  std::vector<Mouth> mouths;
  for (const WayJoint& joint : joints)
    if (const auto mouth = mouth_of(profile, joint)) mouths.push_back(*mouth);
  return mouths;
}

std::vector<JointGroup> joint_groups(std::vector<WayJoint> joints) {
  std::erase_if(joints, [](const WayJoint& one) { return !(one.joint_mm > 0.0); });
  std::sort(joints.begin(), joints.end(),
            [](const WayJoint& a, const WayJoint& b) { return a.joint_mm < b.joint_mm; });
  std::vector<JointGroup> groups;
  for (const WayJoint& one : joints) {
    const double ostium = std::max(one.joint_mm, one.ostium_mm);
    if (groups.empty() || one.joint_mm > groups.back().ostium_mm)
      groups.push_back({one.joint_mm, one.joint_mm, ostium});
    groups.back().last_joint_mm = one.joint_mm;
    groups.back().ostium_mm = std::max(groups.back().ostium_mm, ostium);
  }
  return groups;
}

std::vector<WayStretch> ostial_way(const lumen::LumenModel& model, std::int32_t vessel) {
  std::vector<WayStretch> way;
  for (const std::int32_t segment : path_of(model.tree, vessel).segments) {
    const std::int32_t owner = owner_of_segment(model.tree, segment).id;
    if (!way.empty() && way.back().vessel == owner) continue;
    const double from = way.empty() ? 0.0 : lumen::vessel(model, owner).own_from_mm;
    if (!way.empty()) way.back().to_mm = from;
    way.push_back({owner, from, 0.0});
  }
  if (!way.empty()) way.back().to_mm = lumen::vessel(model, vessel).axis->length();
  return way;
}

Ostium ostium_of(const lumen::LumenModel& model, const SurfaceOfVessel& surface_of, std::int32_t vessel) {
  if (!surface_of) throw InvalidInput("an ostium can only be found with the walls: surface_of is empty");
  const std::vector<WayStretch> way = ostial_way(model, vessel);
  Ostium out;
  if (way.size() < 2) return out;
  out.parent = way[way.size() - 2].vessel;
  out.joint_mm = out.ostium_mm = way.back().from_mm;
  const auto wall = surface_of(out.parent);
  if (!wall) throw InvalidInput("vessel " + std::to_string(out.parent) + " has no solved wall");
  const geometry::AxisCurve& axis = *lumen::vessel(model, vessel).axis;
  const double radius = lumen::vessel(model, out.parent).axis->radius(out.joint_mm);
  const double last = std::min(out.joint_mm + std::max(least_way_mm, farthest_radii * radius),
                               0.5 * (out.joint_mm + axis.length()));
  for (double s = out.joint_mm; s <= last; s += ostium_step_mm)
    if (!(wall->value(axis.point(s)) < 0.0)) {
      out.ostium_mm = s;
      break;
    }
  return out;
}

std::vector<Ostium> ostia_of(const lumen::LumenModel& model, const SurfaceOfVessel& surface_of,
                             std::int32_t vessel) {
  std::vector<Ostium> ostia;
  const std::vector<WayStretch> way = ostial_way(model, vessel);
  for (std::size_t i = 1; i < way.size(); ++i) ostia.push_back(ostium_of(model, surface_of, way[i].vessel));
  return ostia;
}

ReferenceOptions reading_from_ostium(const std::vector<Ostium>& ostia, ReferenceOptions options) {
  options.joints.clear();
  for (const Ostium& one : ostia)
    if (one.parent >= 0) options.joints.push_back({one.joint_mm, one.ostium_mm});
  return options;
}

LumenProfile read_through(const LumenProfile& profile, const ReferenceLine& reference) {
  LumenProfile out = profile;
  for (const Mouth& mouth : mouths_of(profile, reference.joints)) lead_over(out, mouth);
  return out;
}

}  // namespace ostia::analysis
