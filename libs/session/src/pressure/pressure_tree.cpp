#include "ostia/session/pressure_tree.h"

#include "pressure/pressure_branches.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/core/text.h"
#include "ostia/geometry/frame.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostia::session {
namespace {

using geometry::Vec2;
using geometry::Vec3;
using hemodynamics::SectionShape;

/// The form of one section; of the circle where there is none.
SectionShape form_of(const lumen::LumenModel& model, const analysis::SurfaceOfVessel& surface_of,
                     std::int32_t vessel, double s_mm, const analysis::ProfileOptions& options) {
  const analysis::MeasuredSection section =
      analysis::measured_section(model, surface_of, vessel, s_mm, options);
  if (!section.measures.found || section.contour.size() < 8) return {};
  const Vec3 normal = section.measures.normal;
  const Vec3 x = (section.contour.front() - section.measures.centroid -
                  normal * normal.dot(section.contour.front() - section.measures.centroid))
                     .normalized();
  const Vec3 y = normal.cross(x);
  std::vector<Vec2> flat;
  double twice = 0.0;
  for (const Vec3& p : section.contour)
    flat.emplace_back((p - section.measures.centroid).dot(x), (p - section.measures.centroid).dot(y));
  for (std::size_t i = 0; i < flat.size(); ++i) {
    const Vec2 &a = flat[i], &b = flat[(i + 1) % flat.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  if (twice < 0.0) std::reverse(flat.begin(), flat.end());
  return twice == 0.0 ? SectionShape() : hemodynamics::shape_of_contour(flat);
}

/// So little that its form is the same, too: a wall that is pulled moves far away by next to nothing.
bool looks_the_same(const analysis::SectionMeasures& a, const analysis::SectionMeasures& b) {
  constexpr double share = 1e-4;
  const auto near = [](double x, double y) { return std::abs(x - y) <= share * std::abs(x); };
  return a.found == b.found && a.open == b.open && near(a.area_mm2, b.area_mm2) &&
         near(a.perimeter_mm, b.perimeter_mm) && near(a.least_diameter_mm, b.least_diameter_mm) &&
         near(a.largest_diameter_mm, b.largest_diameter_mm);
}

/// `former`: sections with the forms that the vessel has; those that look as they did keep them.
void measure_forms(PressureVessel& vessel, const lumen::LumenModel& model,
                   const analysis::SurfaceOfVessel& surface_of, double from_mm, double to_mm,
                   const PressureTreeOptions& options,
                   const std::vector<analysis::SectionMeasures>& former = {}) {
  const auto& sections = vessel.profile.sections;
  vessel.shapes.resize(sections.size());
  std::vector<std::size_t> wanted;
  for (std::size_t i = 0; i < sections.size(); ++i)
    if (sections[i].found && sections[i].s_mm >= std::max(from_mm, vessel.ostium_mm) - 1e-6 &&
        sections[i].s_mm <= to_mm + 1e-6 && !(i < former.size() && looks_the_same(former[i], sections[i])))
      wanted.push_back(i);
  // Of its own part the wall is its own: no other is asked for, and none from another thread.
  const auto wall = surface_of(vessel.vessel);
  const analysis::SurfaceOfVessel own = [&](std::int32_t) { return wall; };
  core::parallel_for(wanted.size(), 4, [&](std::size_t k) {
    const std::size_t i = wanted[k];
    vessel.shapes[i] = form_of(model, own, vessel.vessel, sections[i].s_mm, options.profile);
  });
}

/// Sections of a tube with the axis' radii.
analysis::LumenProfile round_profile(std::int32_t vessel, const geometry::AxisCurve& axis,
                                     const analysis::ProfileOptions& options) {
  analysis::LumenProfile profile;
  profile.vessel = vessel;
  profile.options = options;
  profile.length_mm = axis.length();
  const auto steps =
      std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(axis.length() / options.step_mm - 1e-9)));
  for (std::size_t i = 0; i <= steps; ++i) {
    analysis::SectionMeasures section;
    section.s_mm = axis.length() * static_cast<double>(i) / static_cast<double>(steps);
    const double radius = axis.radius(section.s_mm);
    section.found = radius > 0.0;
    section.diameter_mm = section.least_diameter_mm = section.largest_diameter_mm = 2.0 * radius;
    section.area_mm2 = std::numbers::pi * radius * radius;
    section.perimeter_mm = 2.0 * std::numbers::pi * radius;
    section.centroid = axis.point(section.s_mm);
    section.normal = axis.frame(section.s_mm).tangent;
    profile.sections.push_back(section);
  }
  return profile;
}

/// Where a way is out of its parent's tube.
double leaves_tube_at(const geometry::AxisCurve& axis, double joint_mm, const geometry::AxisCurve& parent) {
  const double most = std::min(joint_mm + 4.0 * parent.radius(parent.nearest_foot(axis.point(joint_mm)).s_mm),
                               0.5 * (joint_mm + axis.length()));
  for (double s = joint_mm; s <= most; s += 0.05) {
    const geometry::AxisFoot foot = parent.nearest_foot(axis.point(s));
    if (foot.rho_mm >= parent.radius(foot.s_mm)) return s;
  }
  return joint_mm;
}

bool has_sections(const hemodynamics::Network& network, std::int32_t vessel) {
  return std::any_of(network.branches.begin(), network.branches.end(),
                     [=](const hemodynamics::Branch& branch) {
                       return branch.vessel == vessel && branch.stations.size() > 1;
                     });
}

analysis::ReferenceLine reference_of(const PressureVessel& vessel, const lumen::LumenModel& model,
                                     const analysis::SurfaceOfVessel& surface_of,
                                     const PressureTreeOptions& options) {
  const auto ostia = analysis::ostia_of(model, surface_of, vessel.vessel);
  return analysis::reference_line(vessel.profile, analysis::branch_abscissas(model, vessel.vessel),
                                  analysis::reading_from_ostium(ostia, options.reference));
}

void add_pressure_lesions(PressureTree& tree, const geometry::VesselTree& vessels,
                          const PressureTreeOptions& options) {
  int number = 0;
  for (const geometry::Vessel& one : vessels.vessels) {
    const auto found = tree.vessels.find(one.id);
    if (found == tree.vessels.end()) continue;
    const PressureVessel& vessel = found->second;
    for (const analysis::Stenosis& stenosis :
         analysis::find_stenoses(vessel.profile, vessel.reference, options.stenosis)) {
      if (stenosis.throat_mm < vessel.own_from_mm) continue;
      ++number;
      const auto on = [&](double s_mm) { return place_on(tree.network, vessel.vessel, s_mm); };
      if (!has_sections(tree.network, vessel.vessel)) continue;
      // At a vessel's very ends a wall is cut, not narrowed: no section of the network lies there.
      if (std::abs(on(stenosis.throat_mm).s_mm - stenosis.throat_mm) > options.profile.step_mm) continue;
      tree.lesions.push_back(
          {"S" + std::to_string(number), on(stenosis.from_mm), on(stenosis.throat_mm), on(stenosis.to_mm)});
    }
  }
}

}  // namespace

void validate(const PressureTreeOptions& options) {
  analysis::validate(options.profile);
  if (!(options.bend_chord_mm >= 0.2 && options.bend_chord_mm <= 20.0))
    throw InvalidInput("bends are measured over " + core::mm_text(options.bend_chord_mm, 6) +
                       "; choose 0.2 to 20 mm");
}

PressureTree pressure_tree(const lumen::LumenModel& model, const analysis::SurfaceOfVessel& surface_of,
                           const PressureTreeOptions& options, const core::TaskContext& task) {
  validate(options);
  if (const auto fault = geometry::find_fault(model.tree))
    throw InvalidInput("the model's tree has no flow: " + *fault);
  PressureTree tree;
  const auto owners = owners_of(model.tree);
  double done = 0.0;
  for (const geometry::Vessel& one : model.tree.vessels) {
    done += 1.0;
    if (!owns_a_segment(owners, one.id)) continue;
    PressureVessel vessel;
    vessel.vessel = one.id;
    vessel.name = one.name;
    vessel.axis = lumen::vessel(model, one.id).axis;
    vessel.of_walls = true;
    const auto ostia = analysis::ostia_of(model, surface_of, one.id);
    vessel.own_from_mm = lumen::own_from_mm(model.tree, one.id);
    vessel.ostium_mm =
        ostia.empty() ? vessel.own_from_mm : std::max(vessel.own_from_mm, ostia.back().ostium_mm);
    vessel.profile =
        analysis::lumen_profile(model, surface_of, one.id, options.profile,
                                task.sub((done - 1.0) / static_cast<double>(model.tree.vessels.size()),
                                         done / static_cast<double>(model.tree.vessels.size())));
    vessel.reference = analysis::reference_line(vessel.profile, analysis::branch_abscissas(model, one.id),
                                                analysis::reading_from_ostium(ostia, options.reference));
    measure_forms(vessel, model, surface_of, 0.0, vessel.profile.length_mm, options);
    tree.vessels[one.id] = std::move(vessel);
  }
  make_branches(tree, model.tree, owners, options.bend_chord_mm);
  add_pressure_lesions(tree, model.tree, options);
  return tree;
}

PressureTree pressure_tree(const geometry::VesselTree& vessels, const PressureTreeOptions& options,
                           const core::TaskContext& task) {
  validate(options);
  if (const auto fault = geometry::find_fault(vessels)) throw InvalidInput("the tree has no flow: " + *fault);
  PressureTree tree;
  const auto owners = owners_of(vessels);
  for (const geometry::Vessel& one : vessels.vessels) {
    task.throw_if_cancelled();
    if (!owns_a_segment(owners, one.id)) continue;
    PressureVessel vessel;
    vessel.vessel = one.id;
    vessel.name = one.name;
    vessel.axis = std::make_shared<const geometry::AxisCurve>(geometry::vessel_axis(vessels, one));
    const WayOnAxis way = way_on_axis(vessels, one, *vessel.axis);
    const auto shared = shared_segments(owners, one);
    vessel.own_from_mm = vessel.ostium_mm = way.node_mm[shared];
    if (shared > 0) {
      const std::int32_t parent = owners.at(one.segments[shared - 1]);
      vessel.ostium_mm = leaves_tube_at(*vessel.axis, vessel.own_from_mm, *tree.vessels.at(parent).axis);
    }
    vessel.profile = round_profile(one.id, *vessel.axis, options.profile);
    vessel.shapes.resize(vessel.profile.sections.size());
    analysis::ReferenceOptions reference = options.reference;
    if (shared > 0) reference.joints = {{vessel.own_from_mm, vessel.ostium_mm}};
    vessel.reference =
        analysis::reference_line(vessel.profile, {way.node_mm.begin() + 1, way.node_mm.end() - 1}, reference);
    tree.vessels[one.id] = std::move(vessel);
  }
  make_branches(tree, vessels, owners, options.bend_chord_mm);
  add_pressure_lesions(tree, vessels, options);
  task.set_progress(1.0);
  return tree;
}

std::vector<std::size_t> update_pressure_tree(PressureTree& tree, const lumen::LumenModel& model,
                                              const analysis::SurfaceOfVessel& surface_of,
                                              std::int32_t vessel, double from_mm, double to_mm,
                                              const PressureTreeOptions& options) {
  const auto found = tree.vessels.find(vessel);
  if (found == tree.vessels.end())
    throw InvalidInput("vessel " + std::to_string(vessel) + " owns no part of the tree");
  PressureVessel& measured = found->second;
  const std::vector<analysis::SectionMeasures> former = measured.profile.sections;
  analysis::update_profile(measured.profile, model, surface_of, from_mm, to_mm);
  const double step = measured.profile.length_mm / static_cast<double>(measured.profile.sections.size() - 1);
  measure_forms(measured, model, surface_of, from_mm - step, to_mm + step, options, former);
  measured.reference = reference_of(measured, model, surface_of, options);
  auto changed = remake_branches(tree, vessel, from_mm - step, to_mm + step, options.bend_chord_mm);
  tree.lesions.clear();
  add_pressure_lesions(tree, model.tree, options);
  return changed;
}

hemodynamics::TreePlace place_on(const hemodynamics::Network& network, std::int32_t vessel, double s_mm) {
  hemodynamics::TreePlace best;
  double least = HUGE_VAL;
  for (std::size_t b = 0; b < network.branches.size(); ++b) {
    const hemodynamics::Branch& branch = network.branches[b];
    if (branch.vessel != vessel || branch.stations.size() < 2) continue;
    const double s = std::clamp(s_mm, branch.stations.front().s_mm, branch.stations.back().s_mm);
    if (std::abs(s - s_mm) >= least) continue;
    least = std::abs(s - s_mm);
    best = {b, s};
  }
  if (!(least < HUGE_VAL))
    throw InvalidInput("vessel " + std::to_string(vessel) + " has no measured sections");
  return best;
}

}  // namespace ostia::session
