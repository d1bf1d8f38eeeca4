#include "ostia/pipeline/branch_ends.h"

#include "ostia/core/error.h"

#include <algorithm>

namespace ostia::pipeline {
namespace {

using geometry::Vec3;

struct Joint {
  Vec3 position;
  int pairs = 0;
};

std::size_t joint_at(std::vector<Joint>& joints, const Vec3& position, double same_mm) {
  for (std::size_t i = 0; i < joints.size(); ++i) {
    if ((joints[i].position - position).norm() <= same_mm) return i;
  }
  joints.push_back({position, 0});
  return joints.size() - 1;
}

}  // namespace

BranchEnds ends_of(const std::vector<segmentation::BranchSeeds>& branches, double same_mm) {
  if (branches.empty())
    throw InvalidInput("no branch was given; a branch is two points, --branch x,y,z:x,y,z");
  std::vector<Joint> joints;
  for (const segmentation::BranchSeeds& branch : branches) {
    for (const Vec3& end : {branch.from, branch.to}) ++joints[joint_at(joints, end, same_mm)].pairs;
  }
  BranchEnds ends;
  ends.source = joints.front().position;
  for (std::size_t i = 1; i < joints.size(); ++i) {
    if (joints[i].pairs == 1) ends.targets.push_back(joints[i].position);
  }
  if (ends.targets.empty())
    throw InvalidInput("the branches form a ring: no point of theirs is an end; leave one out");
  return ends;
}

std::vector<segmentation::BranchSeeds> without(const std::vector<segmentation::BranchSeeds>& branches,
                                               const std::vector<segmentation::LeftOutBranch>& left_out) {
  std::vector<segmentation::BranchSeeds> kept;
  for (std::size_t b = 0; b < branches.size(); ++b)
    if (std::none_of(left_out.begin(), left_out.end(),
                     [&](const segmentation::LeftOutBranch& one) { return one.branch == b; }))
      kept.push_back(branches[b]);
  return kept;
}

std::vector<std::string> reasons_of(const std::vector<segmentation::LeftOutBranch>& left_out) {
  std::vector<std::string> reasons;
  for (const segmentation::LeftOutBranch& one : left_out)
    reasons.push_back("left out: " + one.why + "; the other vessels are there");
  return reasons;
}

}  // namespace ostia::pipeline
