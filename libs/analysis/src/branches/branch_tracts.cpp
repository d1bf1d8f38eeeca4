#include "branches/branch_tracts.h"

#include <algorithm>

namespace ostia::analysis {
namespace {

constexpr double same_end_mm = 1e-6;

bool same_ends(const geometry::Centerline& a, const geometry::Centerline& b) {
  return (a.points.front() - b.points.front()).norm() < same_end_mm &&
         (a.points.back() - b.points.back()).norm() < same_end_mm;
}

}  // namespace

BranchTracts::BranchTracts(const geometry::BranchedLines& lines) : lines_(lines) {
  for (std::size_t l = 0; l < lines.lines.size(); ++l) {
    const geometry::BranchedLine& line = lines.lines[l];
    for (std::size_t t = 0; t < line.tracts.size(); ++t) {
      const geometry::Tract& tract = line.tracts[t];
      std::vector<BranchTract>& group = tracts_[tract.group];
      if (group.empty()) (tract.blanked ? blanked_ : branches_).push_back(tract.group);
      group.push_back({l, t, geometry::tract_axis(line, tract)});
    }
  }
  for (const auto& [group, tracts] : tracts_) {
    std::vector<const BranchTract*>& own = distinct_[group];
    for (const BranchTract& one : tracts) {
      if (std::none_of(own.begin(), own.end(),
                       [&](const BranchTract* other) { return same_ends(other->axis, one.axis); }))
        own.push_back(&one);
    }
  }
}

std::vector<std::int32_t> BranchTracts::neighbours(std::int32_t group, geometry::LineWay way) const {
  std::vector<std::int32_t> found;
  for (const BranchTract& one : all(group)) {
    const std::vector<geometry::Tract>& tracts = lines_.lines[one.line].tracts;
    const bool up = way == geometry::LineWay::upstream;
    if (up ? one.tract == 0 : one.tract + 1 == tracts.size()) continue;
    const std::int32_t next = tracts[up ? one.tract - 1 : one.tract + 1].group;
    if (std::find(found.begin(), found.end(), next) == found.end()) found.push_back(next);
  }
  return found;
}

}  // namespace ostia::analysis
