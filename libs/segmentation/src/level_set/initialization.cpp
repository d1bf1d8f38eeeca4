#include "level_set/initialization.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <exception>
#include <map>
#include <utility>

namespace ostia::segmentation::detail {
namespace {

/// Which branches hang together: a number for each of `members`, the same for those that share seeds.
std::map<std::size_t, std::size_t> groups_of(const std::vector<BranchSeeds>& all,
                                             const std::vector<std::size_t>& members, double same_mm) {
  const auto touch = [&](const BranchSeeds& a, const BranchSeeds& b) {
    for (const Vec3& p : {a.from, a.to})
      for (const Vec3& q : {b.from, b.to})
        if ((p - q).norm() <= same_mm) return true;
    return false;
  };
  std::map<std::size_t, std::size_t> group;
  for (const std::size_t one : members) group[one] = one;
  for (bool changed = true; changed;) {
    changed = false;
    for (const std::size_t a : members)
      for (const std::size_t b : members)
        if (group[a] < group[b] && touch(all[a], all[b])) {
          group[b] = group[a];
          changed = true;
        }
  }
  return group;
}

void require_within(const imaging::ImageVolume& image, const std::vector<BranchSeeds>& branches) {
  for (std::size_t b = 0; b < branches.size(); ++b)
    for (const Vec3& seed : {branches[b].from, branches[b].to})
      if (!image.geometry.contains(seed))
        throw InvalidInput("branch " + std::to_string(b + 1) + ": seed " + std::to_string(seed.x()) + "," +
                           std::to_string(seed.y()) + "," + std::to_string(seed.z()) +
                           " mm lies outside the image");
}

template <class Call>
auto with_branch_number(std::size_t number, std::size_t count, const Call& call) {
  const std::string head = count > 1 ? "branch " + std::to_string(number + 1) + ": " : "";
  try {
    return call();
  } catch (const InvalidInput& e) {
    throw InvalidInput(head + e.what());
  } catch (const GeometryError& e) {
    throw GeometryError(head + e.what());
  }
}

void leave_out_cut_off(const std::vector<BranchSeeds>& all, std::vector<std::size_t>& kept,
                       InitializedBranches& out) {
  for (const std::size_t branch : cut_off(all, kept)) {
    const auto at = std::find(kept.begin(), kept.end(), branch);
    out.parts.erase(out.parts.begin() + (at - kept.begin()));
    kept.erase(at);
    out.left_out.push_back(
        {branch, "branch " + std::to_string(branch + 1) + ": it hangs on a branch that is left out"});
  }
}

}  // namespace

std::vector<std::size_t> cut_off(const std::vector<BranchSeeds>& all, const std::vector<std::size_t>& kept,
                                 double same_mm) {
  std::vector<std::size_t> everyone(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) everyone[i] = i;
  const std::map<std::size_t, std::size_t> before = groups_of(all, everyone, same_mm);
  std::map<std::size_t, std::size_t> now = groups_of(all, kept, same_mm);
  std::map<std::size_t, std::size_t> members;
  for (const auto& [branch, group] : now) ++members[group];
  // Of each group of those asked for, what is left of it and has most branches (of two as large the first).
  std::map<std::size_t, std::size_t> main;
  for (const auto& [group, count] : members) {
    const std::size_t whole = before.at(group);
    if (main.count(whole) == 0 || count > members.at(main.at(whole))) main[whole] = group;
  }
  std::vector<std::size_t> out;
  for (const auto& [branch, group] : now)
    if (main.at(before.at(branch)) != group) out.push_back(branch);
  return out;
}

InitializedBranches initialize_branches(const imaging::ImageVolume& image,
                                        const std::vector<BranchSeeds>& branches,
                                        const CollidingFrontsOptions& fronts, bool leave_out,
                                        const core::TaskContext& task) {
  leave_out = leave_out && branches.size() > 1;
  if (leave_out) require_within(image, branches);
  InitializedBranches out;
  std::vector<std::size_t> kept;
  std::exception_ptr first;
  const auto count = static_cast<double>(branches.size());
  const auto failed = [&](std::size_t branch, const char* why) {
    if (!leave_out) throw;
    if (!first) first = std::current_exception();
    out.left_out.push_back({branch, why});
  };
  for (std::size_t b = 0; b < branches.size(); ++b) {
    try {
      out.parts.push_back(with_branch_number(b, branches.size(), [&] {
        return colliding_fronts(image, branches[b], fronts,
                                task.sub(static_cast<double>(b) / count, static_cast<double>(b + 1) / count));
      }));
      kept.push_back(b);
    } catch (const InvalidInput& error) {
      failed(b, error.what());
    } catch (const GeometryError& error) {
      failed(b, error.what());
    }
  }
  if (kept.empty()) std::rethrow_exception(first);
  if (!out.left_out.empty()) leave_out_cut_off(branches, kept, out);
  for (const std::size_t b : kept) out.branches.push_back(branches[b]);
  out.index = std::move(kept);
  return out;
}

}  // namespace ostia::segmentation::detail
