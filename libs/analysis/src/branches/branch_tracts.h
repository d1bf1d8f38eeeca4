#pragma once
/// \file Branched lines by their groups.

#include "ostia/geometry/branch_groups.h"

#include <map>
#include <vector>

namespace ostia::analysis {

/// A tract of a vessel, as a line of its own.
struct BranchTract {
  std::size_t line = 0, tract = 0;
  geometry::Centerline axis;
};

class BranchTracts {
 public:
  explicit BranchTracts(const geometry::BranchedLines& lines);
  BranchTracts(const BranchTracts&) = delete;  // it points into itself
  BranchTracts& operator=(const BranchTracts&) = delete;

  /// In the order in which the lines come upon them.
  const std::vector<std::int32_t>& groups(bool blanked) const { return blanked ? blanked_ : branches_; }
  /// One for each vessel.
  const std::vector<BranchTract>& all(std::int32_t group) const { return tracts_.at(group); }
  /// Those whose ends are not both another's (1e-6 mm).
  const std::vector<const BranchTract*>& distinct(std::int32_t group) const { return distinct_.at(group); }
  /// The groups of the tracts before or behind, each once.
  std::vector<std::int32_t> neighbours(std::int32_t group, geometry::LineWay way) const;

 private:
  const geometry::BranchedLines& lines_;
  std::vector<std::int32_t> blanked_, branches_;
  std::map<std::int32_t, std::vector<BranchTract>> tracts_;
  std::map<std::int32_t, std::vector<const BranchTract*>> distinct_;
};

/// Means of places and radii, weighted by the radii's squares as VMTK weights them.
class WeightedPlace {
 public:
  void add(const geometry::Vec3& place, double radius) {
    sum_ += radius * radius * place;
    weight_ += radius * radius;
  }
  bool empty() const { return weight_ == 0.0; }
  geometry::Vec3 mean() const { return sum_ / weight_; }

 private:
  geometry::Vec3 sum_ = geometry::Vec3::Zero();
  double weight_ = 0.0;
};

}  // namespace ostia::analysis
