#include "ostia/analysis/medina.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"

#include <algorithm>
#include <cmath>

namespace ostia::analysis {
namespace {

constexpr double bifurcation_slack_mm = 1e-6;

void require_medina(double value, double low, double high, const std::string& what) {
  if (!(value >= low && value <= high))
    throw InvalidInput("a bifurcation's " + what + " is " + core::shown_text(value, 2) + "; choose " +
                       core::shown_text(low, 0) + " to " + core::shown_text(high, 0));
}

void check_line_of(const MeasuredVessel& one) {
  if (one.profile.sections.empty() || one.reference.diameter_mm.size() != one.profile.sections.size())
    throw InvalidInput("the reference line is not of the profile of vessel " +
                       std::to_string(one.profile.vessel));
}

/// The worst narrowing of the sections from one abscissa to another; where nothing is known, nothing is said.
double worst_percent(const MeasuredVessel& of, double from_mm, double to_mm) {
  double worst = 0.0;
  for (std::size_t i = 0; i < of.profile.sections.size(); ++i) {
    const SectionMeasures& one = of.profile.sections[i];
    const double reference = of.reference.diameter_mm[i];
    if (one.s_mm < from_mm - bifurcation_slack_mm || one.s_mm > to_mm + bifurcation_slack_mm || one.open)
      continue;
    if (!one.found)
      worst = 100.0;
    else if (reference > 0.0)
      worst = std::max(worst, 100.0 * (1.0 - one.diameter_mm / reference));
  }
  return worst;
}

}  // namespace

void validate(const MedinaOptions& options) {
  require_medina(options.region_mm, 1.0, 15.0, "region in mm");
  require_medina(options.least_percent, 5.0, 95.0, "least narrowing in percent");
  require_medina(options.least_side_mm, 0.0, 5.0, "least side branch in mm");
}

bool MedinaClass::holds(std::int32_t vessel, double from_mm, double to_mm) const {
  const auto meets = [&](double low, double high) { return from_mm <= high && to_mm >= low; };
  if (vessel == main)
    return (proximal && meets(joint_mm - region_mm, joint_mm)) ||
           (distal && meets(ostium_mm, ostium_mm + region_mm));
  return vessel == side && side_branch && meets(ostium_mm, ostium_mm + region_mm);
}

std::string to_string(const MedinaClass& medina) {
  const auto digit = [](bool one) { return std::string(one ? "1" : "0"); };
  return digit(medina.proximal) + "," + digit(medina.distal) + "," + digit(medina.side_branch);
}

MedinaClass medina_class(const MeasuredVessel& main, const MeasuredVessel& side, const Ostium& ostium,
                         const MedinaOptions& options) {
  validate(options);
  check_line_of(main);
  check_line_of(side);
  MedinaClass out;
  out.main = main.profile.vessel;
  out.side = side.profile.vessel;
  out.joint_mm = ostium.joint_mm;
  out.ostium_mm = ostium.ostium_mm;
  out.region_mm = options.region_mm;
  const double before = ostium.joint_mm - options.region_mm, behind = ostium.ostium_mm + options.region_mm;
  out.proximal_percent = worst_percent(main, before, ostium.joint_mm);
  out.distal_percent = worst_percent(main, ostium.ostium_mm, behind);
  out.side_percent = worst_percent(side, ostium.ostium_mm, behind);
  const auto counts = [&](double percent) { return std::round(percent) >= options.least_percent; };
  out.proximal = counts(out.proximal_percent);
  out.distal = counts(out.distal_percent);
  out.side_branch = counts(out.side_percent);
  return out;
}

double side_calibre_mm(const MeasuredVessel& side, const Ostium& ostium) {
  check_line_of(side);
  for (std::size_t i = 0; i < side.profile.sections.size(); ++i)
    if (side.profile.sections[i].s_mm >= ostium.ostium_mm - bifurcation_slack_mm)
      return side.reference.diameter_mm[i];
  return side.reference.diameter_mm.back();
}

}  // namespace ostia::analysis
