#include "ostia/coronary/axes.h"

#include "axis_beside_calcium.h"

#include "ostia/centerline/tree_builder.h"
#include "ostia/core/error.h"
#include "ostia/core/text.h"
#include "ostia/geometry/polyline.h"
#include "ostia/geometry/tree_parts.h"
#include "ostia/segmentation/minimal_path.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

namespace ostia::coronary {
namespace {

void check_centring_option(const char* name, double value, double low, double high, const char* unit) {
  if (!(value >= low && value <= high))
    throw InvalidInput(std::string("centring of the coronary tree: ") + name + " is " +
                       std::to_string(value) + unit + "; give " + std::to_string(low) + " to " +
                       std::to_string(high));
}

void require_tree(const GrownTree& grown, const std::vector<Ostium>& ostia) {
  if (grown.branches.empty()) throw InvalidInput("centring of the coronary tree: it has no branch");
  for (std::size_t b = 0; b < grown.branches.size(); ++b) {
    const GrownBranch& branch = grown.branches[b];
    const std::string name = "centring of the coronary tree: branch " + std::to_string(b + 1);
    if (branch.points.size() < 2) throw InvalidInput(name + " has fewer than two points");
    if (branch.parent >= static_cast<std::int32_t>(b)) throw InvalidInput(name + " precedes its parent");
    if (branch.ostium >= ostia.size()) throw InvalidInput(name + " comes from an unknown ostium");
  }
}

/// The branch from its ostium: a front may begin some way beyond it, or inside the aorta.
std::vector<Vec3> from_ostium(const GrownBranch& branch, const Ostium& ostium) {
  constexpr double apart_mm = 0.25, near_mm = 5.0;
  if ((branch.points.front() - ostium.place).norm() > near_mm) return branch.points;
  auto first = branch.points.begin();
  while (first + 2 < branch.points.end() && (*first - ostium.place).dot(ostium.direction) < apart_mm) ++first;
  std::vector<Vec3> line{ostium.place};
  line.insert(line.end(), first, branch.points.end());
  return line;
}

/// Where the vessel was found again behind a stretch that shows no lumen.
void tell_gaps(const GrownBranch& branch, segmentation::MinimalPath& path) {
  const auto abscissa = [&](std::size_t point) {
    return geometry::closest(path.points, branch.points[std::min(point, branch.points.size() - 1)]).abscissa;
  };
  for (const auto& [first, last] : branch.gaps) {
    const double from = abscissa(first);
    path.warnings.push_back(
        "no lumen is seen for " + core::mm_text(abscissa(last) - from, 1) + ", " + core::mm_text(from, 1) +
        " from its start, and a vessel goes on behind: a tight or closed stretch, if it is "
        "the same one");
  }
}

/// An artery that does not come from the aorta.
void tell_lost_beginning(const Ostium& ostium, segmentation::MinimalPath& path) {
  if (ostium.beyond_mm > 0.0)
    path.warnings.push_back("it begins " + core::mm_text(ostium.beyond_mm, 1) +
                            " beyond the aorta's lumen, and none is seen between them: its ostium is closed, "
                            "or the way from it was lost");
}

/// Follows the branches one after the other.
class Centring {
 public:
  Centring(const imaging::ImageVolume& image, const GrownTree& grown, const std::vector<Ostium>& ostia,
           const AxesOptions& options)
      : image_(image), grown_(grown), ostia_(ostia), options_(options) {
    along_.corridor_mm = 0.0;  // grown branches lie within the lumen
    along_.path.step_mm = options.step_mm;
    along_.path.largest_radius_mm = options.largest_radius_mm;
    along_.path.blur_sigma_mm = options.blur_sigma_mm;
    along_.path.wall_hu = options.wall_hu;
  }

  CentredTree run(const core::TaskContext& task) {
    const double all = static_cast<double>(grown_.branches.size());
    for (std::size_t b = 0; b < grown_.branches.size(); ++b) {
      task.throw_if_cancelled();
      try {
        follow(grown_.branches[b], task);
      } catch (const InvalidInput& error) {
        lose(grown_.branches[b], error.what());
      } catch (const GeometryError& error) {
        lose(grown_.branches[b], error.what());
      }
      task.set_progress(static_cast<double>(b + 1) / all);
    }
    if (chains_.empty())
      throw GeometryError("no branch of the coronary tree could be followed: " + result_.warnings.front());
    build();
    return std::move(result_);
  }

 private:
  /// Within a fifth of a second: stage and progress stay those of the whole tree.
  void follow(const GrownBranch& branch, const core::TaskContext& task) {
    segmentation::MinimalPath path;
    if (branch.parent < 0) {
      segmentation::PathAlongOptions along = along_;
      along.fixed_start_mm = options_.ostium_mm;
      path = segmentation::path_along(image_, from_ostium(branch, ostia_[branch.ostium]), along);
    } else {
      path = segmentation::path_along_to_tree(image_, from_axis(branch.points), flat_, along_);
    }
    centre_beside_calcium(image_, options_.ostium_mm, options_, path, task);
    if (path.length_mm < options_.least_branch_mm) {
      leave_out(branch, "it is " + core::mm_text(path.length_mm, 1) + " long");
      return;
    }
    if (branch.parent < 0) tell_lost_beginning(ostia_[branch.ostium], path);
    tell_gaps(branch, path);
    add(std::move(path));
  }

  /// A line that begins on the nearest axis: the voxels of its parent lay beside the middle of the lumen.
  std::vector<Vec3> from_axis(const std::vector<Vec3>& line) const {
    constexpr double same_place_mm = 0.05;
    double least_mm = 4.0;  // farther away is no parent
    std::vector<Vec3> result = line;
    std::optional<Vec3> foot;
    for (const centerline::Chain& chain : chains_) {
      const Vec3 near = geometry::closest(chain.axis.points, line.front()).point;
      if ((near - line.front()).norm() >= least_mm) continue;
      least_mm = (near - line.front()).norm();
      foot = near;
    }
    if (foot && least_mm > same_place_mm) result.insert(result.begin(), *foot);
    return result;
  }

  void leave_out(const GrownBranch& branch, const std::string& why) {
    result_.warnings.push_back("a branch of " + core::mm_text(geometry::length(branch.points), 1) +
                               " was left out: " + why);
  }

  void lose(const GrownBranch& branch, const std::string& why) {
    leave_out(branch, why);
    result_.left_out.push_back(result_.warnings.back());
  }

  void add(segmentation::MinimalPath&& path) {
    centerline::Chain chain;
    const auto id = static_cast<std::int32_t>(chains_.size());
    if (path.junction) {
      chain.parent = path.junction->vessel;
      const std::vector<Vec3>& parent = chains_[static_cast<std::size_t>(chain.parent)].axis.points;
      const auto nearest = std::min_element(parent.begin(), parent.end(), [&](const Vec3& a, const Vec3& b) {
        return (a - path.junction->point).squaredNorm() < (b - path.junction->point).squaredNorm();
      });
      chain.at = static_cast<std::size_t>(nearest - parent.begin());
      path.points.front() = *nearest;
    }
    chain.axis = {path.points, path.radius_mm};
    chains_.push_back(std::move(chain));
    geometry::Centerline axis;
    axis.points = path.points;
    axis.radius = path.radius_mm;
    geometry::complete(axis);
    flat_.nodes.push_back({2 * id, axis.points.front()});
    flat_.nodes.push_back({2 * id + 1, axis.points.back()});
    flat_.segments.push_back({id, 2 * id, 2 * id + 1, std::move(axis)});
    flat_.vessels.push_back({id, "V" + std::to_string(id + 1), {id}});
    found_.push_back({id + 1, path.evidence, std::move(path.warnings)});
  }

  std::int32_t root_of(std::size_t chain) const {
    while (chains_[chain].parent >= 0) chain = static_cast<std::size_t>(chains_[chain].parent);
    return static_cast<std::int32_t>(chain);
  }

  /// The chains of each root are cut where others leave, and put into one tree.
  void build() {
    std::map<std::int32_t, std::vector<std::size_t>> of_root;
    for (std::size_t c = 0; c < chains_.size(); ++c) of_root[root_of(c)].push_back(c);
    for (const auto& [root, members] : of_root) {
      centerline::ChainTree part;
      std::map<std::int32_t, std::int32_t> index{{-1, -1}};
      std::vector<std::string> names;
      for (const std::size_t c : members) {
        index[static_cast<std::int32_t>(c)] = static_cast<std::int32_t>(part.chains.size());
        part.ends.emplace_back(static_cast<std::int32_t>(part.chains.size()),
                               chains_[c].axis.points.size() - 1);
        part.chains.push_back(chains_[c]);
        part.chains.back().parent = index.at(chains_[c].parent);
        names.push_back(flat_.vessels[c].name);
      }
      geometry::append_tree(result_.tree, centerline::split_tree(part, options_.step_mm, names).tree, 1,
                            [&](std::int32_t id) {
                              return static_cast<std::int32_t>(members[static_cast<std::size_t>(id)]) + 1;
                            });
    }
    for (const geometry::Vessel& vessel : result_.tree.vessels)
      result_.notes.push_back(found_[static_cast<std::size_t>(vessel.id - 1)]);
  }

  const imaging::ImageVolume& image_;
  const GrownTree& grown_;
  const std::vector<Ostium>& ostia_;
  const AxesOptions& options_;
  segmentation::PathAlongOptions along_;
  std::vector<centerline::Chain> chains_;
  geometry::VesselTree flat_;  // each chain a vessel of its own
  std::vector<AxisNotes> found_;
  CentredTree result_;
};

}  // namespace

void validate(const AxesOptions& options) {
  check_centring_option("the step", options.step_mm, 0.1, 2.0, " mm");
  check_centring_option("the largest radius", options.largest_radius_mm, 0.5, 10.0, " mm");
  check_centring_option("the blur", options.blur_sigma_mm, 0.0, 1.5, " mm");
  check_centring_option("the wall's intensity", options.wall_hu, -100.0, 200.0, " HU");
  check_centring_option("the least branch", options.least_branch_mm, 1.0, 50.0, " mm");
  check_centring_option("the stretch behind the ostium", options.ostium_mm, 0.5, 10.0, " mm");
}

CentredTree centred_tree(const imaging::ImageVolume& image, const GrownTree& grown,
                         const std::vector<Ostium>& ostia, const AxesOptions& options,
                         const core::TaskContext& task) {
  validate(options);
  require_tree(grown, ostia);
  return Centring(image, grown, ostia, options).run(task);
}

}  // namespace ostia::coronary
