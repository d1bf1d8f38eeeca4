// Extensions kept apart: a copy of everything with the extensions a little thicker is searched for triangles
// that intersect.
#include "flow_extension/extension.h"

#include "ostia/core/error.h"
#include "ostia/geometry/aabb_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace ostia::meshing {

using geometry::Vec3;

namespace {

constexpr std::int32_t wall = -1;
constexpr int most_rounds = 60;
constexpr double bend_step_deg = 20.0, most_bend_deg = 80.0;

/// Everything closed by fans, and whose each triangle is.
struct Search {
  geometry::TriMesh mesh;
  std::vector<std::int32_t> owner;  ///< extension, or `wall`
  std::vector<std::size_t> ring;    ///< the one that the triangle leads up to, from 1
};

void close(Search& search, const std::vector<std::int32_t>& loop, const Vec3& apex, std::int32_t owner,
           std::size_t ring) {
  const auto middle = static_cast<std::int32_t>(search.mesh.points.size());
  search.mesh.points.push_back(apex);
  for (std::size_t i = 0; i < loop.size(); ++i)
    search.mesh.triangles.push_back({loop[(i + 1) % loop.size()], loop[i], middle});
  search.owner.resize(search.mesh.triangles.size(), owner);
  search.ring.resize(search.mesh.triangles.size(), ring);
}

Search search_mesh(const geometry::TriMesh& lumen, const std::vector<std::vector<std::int32_t>>& open_loops,
                   const std::vector<std::vector<std::int32_t>>& loops,
                   const std::vector<Extension>& extensions, double clearance) {
  std::vector<Extension> thick = extensions;
  for (Extension& e : thick)
    for (std::size_t k = 0; k < e.rings.rings.size(); ++k) {
      const double t = std::min(1.0, e.rings.abscissa[k] / (2.0 * e.section.radius));
      const double factor = 1.0 + clearance * t * t * (3.0 - 2.0 * t);
      for (Vec3& p : e.rings.rings[k]) p = e.rings.centres[k] + factor * (p - e.rings.centres[k]);
    }
  Joined all = joined(lumen, loops, thick);
  Search search{std::move(all.mesh), {}, {}};
  search.owner.assign(lumen.triangles.size(), wall);
  search.ring.assign(lumen.triangles.size(), 0);
  for (std::size_t e = 0; e < thick.size(); ++e)
    for (std::size_t k = 1; k <= thick[e].rings.rings.size(); ++k) {
      search.owner.insert(search.owner.end(), 2 * thick[e].section.loop.size(), static_cast<std::int32_t>(e));
      search.ring.insert(search.ring.end(), 2 * thick[e].section.loop.size(), k);
    }
  for (std::size_t e = 0; e < thick.size(); ++e) {
    const Rings& rings = thick[e].rings;
    const Vec3 tip = rings.centres.back();
    const Vec3 out = (tip - rings.centres[rings.centres.size() - 2]).normalized();
    close(search, all.far_loops[e], tip + clearance * thick[e].section.radius * out,
          static_cast<std::int32_t>(e), rings.rings.size());
  }
  for (const auto& loop : open_loops) {
    Vec3 middle = Vec3::Zero();
    for (const std::int32_t v : loop)
      middle += lumen.points[static_cast<std::size_t>(v)] / static_cast<double>(loop.size());
    close(search, loop, middle, wall, 0);
  }
  return search;
}

/// How two of them meet: from which ring on each, and in which direction each would have to go.
struct Meeting {
  std::size_t first[2] = {std::numeric_limits<std::size_t>::max(), std::numeric_limits<std::size_t>::max()};
  Vec3 away[2] = {Vec3::Zero(), Vec3::Zero()};
};
using Meetings = std::map<std::pair<std::int32_t, std::int32_t>, Meeting>;

Meetings meetings(const Search& search, const std::vector<Extension>& extensions) {
  Meetings found;
  const auto centre = [&](std::int32_t t) {
    const geometry::Triangle& c = search.mesh.triangles[static_cast<std::size_t>(t)];
    Vec3 sum = Vec3::Zero();
    for (const std::int32_t v : c) sum += search.mesh.points[static_cast<std::size_t>(v)] / 3.0;
    return sum;
  };
  for (const auto& [s, t] : geometry::self_intersections(search.mesh)) {
    std::int32_t one = s, other = t;
    const auto owner = [&](std::int32_t i) { return search.owner[static_cast<std::size_t>(i)]; };
    if (owner(one) > owner(other)) std::swap(one, other);
    if (owner(other) == wall) continue;
    Meeting& m = found[{owner(one), owner(other)}];
    const std::int32_t sides[2] = {one, other};
    for (std::size_t i = 0; i < 2; ++i) {
      const std::size_t ring = search.ring[static_cast<std::size_t>(sides[i])];
      m.first[i] = std::min(m.first[i], ring);
      if (owner(sides[i]) == wall || ring == 0) continue;
      const Rings& rings = extensions[static_cast<std::size_t>(owner(sides[i]))].rings;
      m.away[i] += rings.centres[ring - 1] - centre(sides[1 - i]);
    }
  }
  return found;
}

class Apart {
 public:
  Apart(std::vector<Extension>& extensions, const FlowExtensionOptions& options, double clearance)
      : extensions_(extensions), options_(options), clearance_(clearance) {}

  void resolve(const Meetings& found) {
    std::vector<bool> changed(extensions_.size(), false);
    for (const auto& [who, m] : found) {
      const auto [a, b] = who;
      if (a == b)
        throw GeometryError("flow extensions: " + name(a) +
                            " would fold onto itself; its section is too uneven or too oblique for the "
                            "length: cut the end elsewhere, or make the extension longer");
      if (options_.collision == ExtensionCollision::refuse) refuse(a, b);
      if ((a != wall && changed[index(a)]) || changed[index(b)]) continue;  // looked at again next time
      if (options_.collision == ExtensionCollision::bend) {
        const bool one = bend(a, m.away[0]), other = bend(b, m.away[1]);
        if (one) changed[index(a)] = true;
        if (other) changed[index(b)] = true;
        if (one || other) continue;
      }
      shorten(a, b, m, changed);
    }
  }

 private:
  static std::size_t index(std::int32_t e) { return static_cast<std::size_t>(e); }
  std::string name(std::int32_t e) const {
    return e == wall ? "the wall of the lumen" : extensions_[index(e)].section.name;
  }
  [[noreturn]] void refuse(std::int32_t a, std::int32_t b) const {
    throw GeometryError(
        "flow extensions: " + name(b) + " would meet " + name(a) +
        "; leave an end out, let them be shorter or bent away, give one an axis of its own, or "
        "cut the ends farther inside");
  }
  bool bend(std::int32_t e, const Vec3& away) {
    if (e == wall) return false;
    Extension& x = extensions_[index(e)];
    if (!x.through.empty() || (x.bend_deg > 0.0 && !x.bent_away) ||
        x.bend_deg + bend_step_deg > most_bend_deg)
      return false;
    if (!x.bent_away) {
      const Vec3 across = away - away.dot(x.section.frame.tangent) * x.section.frame.tangent;
      x.side = across.norm() > 1e-9 * x.section.radius ? across.normalized() : x.section.frame.normal;
    }
    const double before = x.bend_deg;
    x.bend_deg += bend_step_deg;
    try {
      axis_of(x);
    } catch (const GeometryError&) {  // too tight for its length
      x.bend_deg = before;
      return false;
    }
    return x.bent_away = true;
  }
  /// The length that ends before the ring where it first meets the other.
  double free_length(std::int32_t e, std::size_t ring) const {
    const Extension& x = extensions_[index(e)];
    const double before = ring > 1 ? x.rings.abscissa[ring - 2] : 0.0;
    return std::min(before, 0.98 * x.length) - 1.2 * clearance_ * x.section.radius;
  }
  void shorten(std::int32_t a, std::int32_t b, const Meeting& m, std::vector<bool>& changed) {
    struct Cut {
      std::int32_t who;
      double length, lost;
    };
    std::vector<Cut> cuts;
    for (const auto& [who, ring] : {std::pair(a, m.first[0]), std::pair(b, m.first[1])}) {
      if (who == wall) continue;
      const double length = free_length(who, ring);
      if (length >= extensions_[index(who)].shortest)
        cuts.push_back({who, length, 1.0 - length / extensions_[index(who)].length});
    }
    if (cuts.empty()) refuse(a, b);
    const double least = std::min_element(cuts.begin(), cuts.end(), [](const Cut& x, const Cut& y) {
                           return x.lost < y.lost;
                         })->lost;
    for (const Cut& cut : cuts) {
      if (cut.lost > least + 0.1) continue;  // the other one loses much less
      extensions_[index(cut.who)].length = cut.length;
      changed[index(cut.who)] = true;
    }
  }
  std::vector<Extension>& extensions_;
  const FlowExtensionOptions& options_;
  double clearance_;
};

/// Whether they came apart with this much room; leaves `extensions` built.
void come_apart(const geometry::TriMesh& lumen, const std::vector<std::vector<std::int32_t>>& open_loops,
                const std::vector<std::vector<std::int32_t>>& loops, std::vector<Extension>& extensions,
                const FlowExtensionOptions& options, double clearance, const core::TaskContext& task) {
  Apart apart(extensions, options, clearance);
  std::vector<std::pair<double, double>> built(extensions.size(), {-1.0, -1.0});
  for (int round = 0; round < most_rounds; ++round) {
    task.throw_if_cancelled();
    task.set_progress(static_cast<double>(round) / (round + 4.0));
    for (std::size_t e = 0; e < extensions.size(); ++e) {
      const std::pair<double, double> now{extensions[e].length, extensions[e].bend_deg};
      if (now != built[e]) build(extensions[e]);
      built[e] = now;
    }
    const Meetings found = meetings(search_mesh(lumen, open_loops, loops, extensions, clearance), extensions);
    if (found.empty()) return;
    apart.resolve(found);
  }
  throw GeometryError("flow extensions: they do not come apart in " + std::to_string(most_rounds) +
                      " attempts; leave some ends out, or take shorter ones");
}

}  // namespace

void keep_apart(const geometry::TriMesh& lumen, const std::vector<std::vector<std::int32_t>>& loops,
                const std::vector<std::vector<std::int32_t>>& open_loops, std::vector<Extension>& extensions,
                const FlowExtensionOptions& options, std::vector<std::string>& warnings,
                const core::TaskContext& task) {
  const std::vector<Extension> wanted = extensions;
  try {
    come_apart(lumen, open_loops, loops, extensions, options, options.clearance, task);
  } catch (const GeometryError&) {
    if (options.clearance == 0.0) throw;
    extensions = wanted;
    come_apart(lumen, open_loops, loops, extensions, options, 0.0, task);
    warnings.push_back("flow extensions: some of them come nearer to each other or to the wall than " +
                       std::to_string(options.clearance) + " radii");
  }
  for (const Extension& e : extensions) {
    if (e.length < e.wanted)
      warnings.push_back(e.section.name + ": its extension is shortened from " + std::to_string(e.wanted) +
                         " to " + std::to_string(e.length) +
                         " mm, for it would meet another one or the wall");
    if (e.bent_away)
      warnings.push_back(e.section.name + ": its extension is bent by " + std::to_string(e.bend_deg) +
                         " degrees, away from another one or the wall");
  }
}

}  // namespace ostia::meshing
