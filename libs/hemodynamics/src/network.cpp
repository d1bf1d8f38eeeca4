#include "ostia/hemodynamics/network.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"

#include <cmath>
#include <numbers>

namespace ostia::hemodynamics {
namespace {

std::string named(const Branch& branch) {
  return branch.name.empty() ? "branch of segment " + std::to_string(branch.segment)
                             : "branch " + branch.name;
}

bool sound(double value) {
  return std::isfinite(value) && value >= 0.0;
}

void validate_station(const Branch& branch, const Station& station) {
  if (!std::isfinite(station.s_mm) || !station.point.allFinite())
    throw InvalidInput(named(branch) + " has a section whose place is no number");
  if (sound(station.area_mm2) && sound(station.curvature_per_mm) &&
      sound(station.shape.viscous - 1.0 + 1e-6) && sound(station.shape.perimeter - 1.0 + 1e-6))
    return;
  throw InvalidInput(named(branch) + " has a section at " + core::mm_text(station.s_mm) +
                     " whose area, form or bend is no number or below the least there is");
}

}  // namespace

double Station::diameter_mm() const {
  return 2.0 * std::sqrt(area_mm2 / std::numbers::pi);
}

std::vector<std::size_t> outlets_of(const Network& network) {
  std::vector<char> left(network.branches.size(), 0);
  for (const Branch& branch : network.branches)
    if (branch.parent >= 0) left[static_cast<std::size_t>(branch.parent)] = 1;
  std::vector<std::size_t> outlets;
  for (std::size_t i = 0; i < left.size(); ++i)
    if (left[i] == 0) outlets.push_back(i);
  return outlets;
}

std::vector<std::size_t> roots_of(const Network& network) {
  std::vector<std::size_t> roots;
  for (std::size_t i = 0; i < network.branches.size(); ++i)
    if (network.branches[i].parent < 0) roots.push_back(i);
  return roots;
}

void validate(const Branch& branch) {
  if (branch.stations.size() == 1)
    throw InvalidInput(named(branch) + " has a single section; pressure along it needs two or more");
  for (std::size_t i = 0; i < branch.stations.size(); ++i) {
    validate_station(branch, branch.stations[i]);
    if (i > 0 && !(branch.stations[i].s_mm > branch.stations[i - 1].s_mm))
      throw InvalidInput(named(branch) + " has sections that do not go on downstream at " +
                         core::mm_text(branch.stations[i].s_mm));
  }
  if (!sound(branch.lumped.linear_pa_s_ml) || !std::isfinite(branch.lumped.quadratic_pa_s2_ml2) ||
      !std::isfinite(branch.angle_rad))
    throw InvalidInput(named(branch) +
                       " has a resistance or an angle that is no number, or a resistance below 0");
}

void validate(const Network& network) {
  if (network.branches.empty()) throw InvalidInput("a network without branches has no flow");
  for (std::size_t i = 0; i < network.branches.size(); ++i) {
    const Branch& branch = network.branches[i];
    if (branch.parent < -1 || branch.parent >= static_cast<int>(i))
      throw InvalidInput(named(branch) +
                         " stands before the branch that it leaves, or names one that is not there");
    validate(branch);
  }
}

}  // namespace ostia::hemodynamics
