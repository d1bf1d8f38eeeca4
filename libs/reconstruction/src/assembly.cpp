#include "assembly.h"

#include "catmull_clark.h"
#include "joint_choice.h"
#include "untangle.h"

#include "ostia/core/parallel.h"
#include "ostia/geometry/aabb_tree.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <set>
#include <span>

namespace ostia::reconstruction {
namespace {

enum class Step { restyle, flatten, move };
// What is done for a joint that crosses, by how often it did; after that its branches are narrowed.
constexpr std::array coarse_steps{Step::restyle, Step::move, Step::restyle};
constexpr std::array fine_steps{Step::restyle, Step::flatten, Step::move, Step::restyle, Step::flatten};

std::span<const Step> steps_at(int level) {
  if (level < 2) return coarse_steps;
  return fine_steps;
}

/// Where the quadrilaterals of each branch begin, which stand together; and where the last one's end.
std::vector<std::size_t> starts_of(const QuadMesh& mesh, std::size_t branches) {
  std::vector<std::size_t> starts(branches + 1, 0);
  for (const std::int32_t branch : mesh.branch_of_quad) ++starts[static_cast<std::size_t>(branch) + 1];
  std::partial_sum(starts.begin(), starts.end(), starts.begin());
  return starts;
}

/// By triangle of `after`, a whole network like `before`: its branch is another than it was, or crossed.
std::vector<std::uint8_t> changed_triangles(const Made& before, const QuadMesh& after, std::size_t branches) {
  const auto old = starts_of(before.mesh, branches), now = starts_of(after, branches);
  std::vector<std::uint8_t> changed(branches, 0);
  for (const auto& [one, other] : before.crossings)
    for (const std::int32_t triangle : {one, other})
      changed[static_cast<std::size_t>(before.mesh.branch_of_quad[static_cast<std::size_t>(triangle / 2)])] =
          1;
  const auto same = [&](const geometry::Quad& a, const geometry::Quad& b) {
    for (std::size_t k = 0; k < 4; ++k)
      if (before.mesh.points[static_cast<std::size_t>(a[k])] != after.points[static_cast<std::size_t>(b[k])])
        return false;
    return true;
  };
  core::parallel_for(branches, 16, [&](std::size_t b) {
    if (changed[b] != 0) return;
    const auto from = before.mesh.quads.begin() + static_cast<std::ptrdiff_t>(old[b]),
               to = before.mesh.quads.begin() + static_cast<std::ptrdiff_t>(old[b + 1]);
    const auto at = after.quads.begin() + static_cast<std::ptrdiff_t>(now[b]);
    changed[b] = (old[b + 1] - old[b] == now[b + 1] - now[b] && std::equal(from, to, at, same)) ? 0 : 1;
  });
  std::vector<std::uint8_t> marks(2 * after.quads.size());
  core::parallel_for(marks.size(), 1 << 16, [&](std::size_t t) {
    marks[t] = changed[static_cast<std::size_t>(after.branch_of_quad[t / 2])];
  });
  return marks;
}

std::vector<std::int32_t> list(const std::set<std::int32_t>& items) {
  return {items.begin(), items.end()};
}

}  // namespace

Assembly::Assembly(const geometry::VesselGraph& graph, const EllipticSections* sections,
                   const ReconstructionOptions& options, const core::TaskContext& task)
    : sections_(sections),
      options_(options),
      task_(task),
      network_(graph),
      tubes_(tubes_of(graph, sections)),
      ends_(ends_of(tubes_, graph.points.size())),
      moved_(tubes_.size(), 0),
      rounds_(options.untangling) {}

Assembly::Part Assembly::whole() const {
  Part part;
  part.tubes.resize(tubes_.size());
  std::iota(part.tubes.begin(), part.tubes.end(), 0);
  part.points.resize(network_.graph.points.size());
  std::iota(part.points.begin(), part.points.end(), 0);
  return part;
}

/// The branches that cross, the joints at their ends and at the other ends of what meets there.
Assembly::Part Assembly::around(const Made& made) const {
  std::set<std::int32_t> tubes, points;
  const auto add_ends = [&](std::int32_t tube) {
    points.insert(tubes_[static_cast<std::size_t>(tube)].start);
    points.insert(tubes_[static_cast<std::size_t>(tube)].end);
  };
  const auto add_tubes = [&] {
    for (const std::int32_t point : points)
      for (const TubeEnd& end : ends_[static_cast<std::size_t>(point)]) tubes.insert(end.tube);
  };
  for (const auto& [one, other] : made.crossings)
    for (const std::int32_t triangle : {one, other})
      tubes.insert(made.mesh.branch_of_quad[static_cast<std::size_t>(triangle / 2)]);
  for (int ring = 0; ring < 2; ++ring) {
    for (const std::int32_t tube : list(tubes)) add_ends(tube);
    add_tubes();
  }
  return {list(tubes), list(points)};
}

QuadMesh Assembly::mesh_at(int level, const Part& part) const {
  const std::vector<Joint> joints = joints_of(tubes_, ends_, part.points, network_.graph, options_, styles_);
  task_.throw_if_cancelled();
  QuadMesh mesh = base_mesh(tubes_, part.tubes, joints, options_);
  place(mesh, tubes_, joints, polygon_scale(options_, 0));
  for (int l = 1; l <= level; ++l) {
    task_.throw_if_cancelled();
    mesh = subdivided(mesh);
    place(mesh, tubes_, joints, polygon_scale(options_, l));
  }
  task_.throw_if_cancelled();
  return mesh;
}

Made Assembly::checked(QuadMesh mesh) {
  Made made{std::move(mesh), {}};
  made.crossings = geometry::self_intersections({made.mesh.points, triangles_of(made.mesh)});
  return made;
}

/// The whole anew: only what has changed is checked.
Made Assembly::again(const Made& before, int level) const {
  Made made{mesh_at(level, whole()), {}};
  made.crossings = geometry::self_intersections({made.mesh.points, triangles_of(made.mesh)},
                                                changed_triangles(before, made.mesh, tubes_.size()));
  return made;
}

std::vector<std::int32_t> Assembly::crossed_joints(const Made& made) const {
  std::set<std::int32_t> points;
  for (const auto& [one, other] : made.crossings) {
    const auto branch = [&](std::int32_t triangle) -> const Tube& {
      return tubes_[static_cast<std::size_t>(
          made.mesh.branch_of_quad[static_cast<std::size_t>(triangle / 2)])];
    };
    const Tube &a = branch(one), &b = branch(other);
    for (const std::int32_t point : {a.start, a.end})
      if ((point == b.start || point == b.end) && !ends_[static_cast<std::size_t>(point)].empty())
        points.insert(point);
  }
  return list(points);
}

void Assembly::restyle(const std::vector<std::int32_t>& points, int level) {
  std::set<std::int32_t> with_neighbours;
  for (const std::int32_t point : points)
    for (const TubeEnd& end : ends_[static_cast<std::size_t>(point)]) {
      const Tube& tube = tubes_[static_cast<std::size_t>(end.tube)];
      with_neighbours.insert({tube.start, tube.end});
    }
  const std::vector<Joint> joints =
      joints_of(tubes_, ends_, list(with_neighbours), network_.graph, options_, {});
  for (const std::int32_t point : points) styles_.erase(point);
  styles_.merge(chosen_styles(joints, points, tubes_, options_, level, task_));
}

void Assembly::move_apart(const std::vector<std::int32_t>& points) {
  const std::vector<std::int32_t> changed = make_room(network_, tubes_, ends_, points);
  std::vector<Tube> anew = tubes_of(network_.graph, sections_);
  std::set<std::int32_t> joints(points.begin(), points.end());
  splayed_.insert(points.begin(), points.end());
  for (const std::int32_t branch : changed) {
    Tube& tube = tubes_[static_cast<std::size_t>(branch)];
    tube = std::move(anew[static_cast<std::size_t>(branch)]);
    moved_[static_cast<std::size_t>(branch)] = 1;
    for (const std::int32_t point : {tube.start, tube.end})
      if (splayed_.count(point) != 0) joints.insert(point);
  }
  splay(tubes_, ends_, list(joints));
  for (const std::int32_t point : points)
    for (const TubeEnd& end : ends_[static_cast<std::size_t>(point)])
      moved_[static_cast<std::size_t>(end.tube)] = 1;
}

/// As it was when the coarse mesh was clear, and no rounder.
void Assembly::flatten(std::int32_t point) {
  const auto before = coarse_styles_.find(point);
  JointStyle style = before == coarse_styles_.end() ? JointStyle() : before->second;
  style.flat = true;
  styles_[point] = style;
}

void Assembly::give_room(const Made& made, int level) {
  const std::vector<std::int32_t> joints = crossed_joints(made);
  const std::span<const Step> steps = steps_at(level);
  std::vector<std::int32_t> others, crowded;
  for (const std::int32_t point : joints) {
    const auto count = static_cast<std::size_t>(tried_[point]++);
    if (count >= steps.size()) continue;
    if (steps[count] == Step::move) crowded.push_back(point);
    if (steps[count] == Step::restyle) others.push_back(point);
    if (steps[count] == Step::flatten) flatten(point);
  }
  if (!crowded.empty()) move_apart(crowded);
  if (!others.empty()) restyle(others, level);
  // Pairs that are being tried another way stay as wide as they are.
  std::vector<std::pair<std::int32_t, std::int32_t>> pressed;
  for (const auto& pair : made.crossings) {
    const auto branch = [&](std::int32_t triangle) -> const Tube& {
      return tubes_[static_cast<std::size_t>(
          made.mesh.branch_of_quad[static_cast<std::size_t>(triangle / 2)])];
    };
    const Tube &a = branch(pair.first), &b = branch(pair.second);
    bool trying = false;
    for (const std::int32_t point : {a.start, a.end}) {
      const auto count = tried_.find(point);
      const bool shared = point == b.start || point == b.end;
      trying = trying || (shared && count != tried_.end() && count->second <= static_cast<int>(steps.size()));
    }
    if (!trying) pressed.push_back(pair);
  }
  give_way(tubes_, made.mesh, pressed);
}

void Assembly::clear(const Made& whole, int level) {
  Made part = whole;
  while (!part.crossings.empty() && rounds_ > 0) {
    const Part near = around(part);
    give_room(part, level);
    --rounds_;
    task_.set_progress(0.9 * (1.0 - static_cast<double>(rounds_) / (options_.untangling + 1.0)));
    part = checked(mesh_at(level, near));
  }
}

Made Assembly::made() {
  Made made = checked(mesh_at(coarse(), whole()));
  if (coarse() < options_.level) {
    clear(made, coarse());
    coarse_styles_ = styles_;
    tried_.clear();
    made = checked(mesh_at(options_.level, whole()));
  }
  while (!made.crossings.empty() && rounds_ > 0) {
    clear(made, options_.level);
    made = again(made, options_.level);
  }
  return made;
}

}  // namespace ostia::reconstruction
