#include "ostia/reconstruction/hexahedra.h"

#include "hex_relaxation.h"
#include "ring_grid.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

namespace ostia::reconstruction {
namespace {

using geometry::HexMesh;
using geometry::Quad;
using geometry::Vec3;
using Ring = std::vector<std::int32_t>;

/// The nodes of a section: layers from the wall (0) inwards, each as long as the ring, and of each side of
/// level 0 a square of nodes (0 to `half` both ways) from the centre (0, 0) to the middle of the side.
struct Section {
  std::vector<Ring> layers;
  std::vector<Ring> squares;
};

/// What sections that meet have in common, by the surface's points: at forks the sections of all branches.
struct Shared {
  std::map<std::int32_t, std::int32_t> centres;
  std::map<std::int32_t, Ring> spokes;
  std::map<std::pair<std::int32_t, std::int32_t>, Ring> squares;
};

/// How far each layer's end lies from the wall, as a part of the shell.
std::vector<double> depths_of(int layers, double growth) {
  std::vector<double> depth{0.0};
  for (int i = 0; i < layers; ++i) depth.push_back(depth.back() + std::pow(growth, i));
  for (double& d : depth) d /= depth.back();
  return depth;
}

class Sweep {
 public:
  Sweep(const ReconstructedSurface& surface, const HexahedraOptions& options)
      : surface_(surface),
        shell_(options.shell),
        half_(std::size_t{1} << (surface.level - 1)),
        depths_(depths_of(options.layers > 0 ? options.layers : static_cast<int>(half_), options.growth)),
        grids_(ring_grids(surface)),
        inner_(surface.points.size()),
        tubes_at_(surface.points.size(), 0) {
    for (const RingGrid& grid : grids_) {
      if (grid.empty()) continue;
      for (const Ring* ring : {&grid.front(), &grid.back()})
        for (const std::int32_t point : *ring) ++tubes_at_[static_cast<std::size_t>(point)];
    }
    mesh_.faces = surface.surface.faces;
  }

  HexMesh swept(const core::TaskContext& task) {
    for (std::size_t b = 0; b < grids_.size(); ++b) {
      task.throw_if_cancelled();
      if (!grids_[b].empty()) sweep(b);
      task.set_progress(static_cast<double>(b + 1) / static_cast<double>(grids_.size()));
    }
    return std::move(mesh_);
  }

  /// What was swept has.
  LayerLines layers() && { return {std::move(inner_), std::move(depths_)}; }

 private:
  const Vec3& wall_point(std::int32_t point) const {
    return surface_.points[static_cast<std::size_t>(point)];
  }
  Vec3 mean(const Ring& ring) const {
    Vec3 sum = Vec3::Zero();
    for (const std::int32_t point : ring) sum += wall_point(point);
    return sum / static_cast<double>(ring.size());
  }
  bool at_joint(const Ring& ring) const {
    return std::any_of(ring.begin(), ring.end(),
                       [&](std::int32_t p) { return tubes_at_[static_cast<std::size_t>(p)] > 1; });
  }

  /// Rings' means, which a ring at a fork has at the fork's centre instead, and those between it and the next
  /// ring of level 0 ever less so.
  std::vector<Vec3> centres(std::size_t branch) const {
    const RingGrid& grid = grids_[branch];
    const Vec3 before = at_joint(grid.front()) ? Vec3(surface_.axis_ends[branch][0] - mean(grid.front()))
                                               : Vec3(Vec3::Zero());
    const Vec3 behind =
        at_joint(grid.back()) ? Vec3(surface_.axis_ends[branch][1] - mean(grid.back())) : Vec3(Vec3::Zero());
    const double fade = 2.0 * static_cast<double>(half_);
    const std::size_t last = grid.size() - 1;
    std::vector<Vec3> out;
    for (std::size_t r = 0; r <= last; ++r)
      out.push_back(mean(grid[r]) + std::max(0.0, 1.0 - static_cast<double>(r) / fade) * before +
                    std::max(0.0, 1.0 - static_cast<double>(last - r) / fade) * behind);
    // To the last bit: branches share it.
    if (at_joint(grid.front())) out.front() = surface_.axis_ends[branch][0];
    if (at_joint(grid.back())) out.back() = surface_.axis_ends[branch][1];
    return out;
  }

  std::int32_t add(const Vec3& point) {
    mesh_.points.push_back(point);
    return static_cast<std::int32_t>(mesh_.points.size() - 1);
  }

  /// How much nearer to the centre the shell ends than at the middle of a side: on the straight line between
  /// the middles of two sides, so that the squares have no flat corners there.
  double shrinking(std::size_t place_in_ring) const {
    const double half = static_cast<double>(half_), angle = std::numbers::pi / surface_.sides;
    const double off = std::abs(static_cast<double>(place_in_ring % (2 * half_)) - half) / half;
    return std::cos(angle) / std::cos(angle * (1.0 - off));
  }

  /// From the wall to the shell's end; each point of the surface has one such line, whatever it belongs to.
  const Ring& line_of(const Ring& ring, std::size_t k, const Vec3& centre) {
    Ring& line = inner_[static_cast<std::size_t>(ring[k])];
    const Vec3 wall = wall_point(ring[k]);
    const double thickness = 1.0 - (1.0 - shell_) * shrinking(k);
    if (line.empty())
      for (const double depth : depths_) line.push_back(add(wall + depth * thickness * (centre - wall)));
    return line;
  }

  /// The centre's node: one a ring, and one for all the rings of a fork.
  std::int32_t centre_node(const Ring& ring, const Vec3& centre, Shared& shared) {
    std::int32_t found = -1;
    for (const std::int32_t point : ring)
      if (const auto at = shared.centres.find(point); at != shared.centres.end()) found = at->second;
    if (found < 0) found = add(centre);
    for (const std::int32_t point : ring) shared.centres.emplace(point, found);
    return found;
  }

  /// From the centre to the shell's end below a corner of level 0.
  const Ring& spoke_of(std::int32_t point, std::int32_t middle, Shared& shared) {
    Ring& spoke = shared.spokes[point];
    if (!spoke.empty()) return spoke;
    const std::int32_t end = inner_[static_cast<std::size_t>(point)].back();
    spoke.push_back(middle);
    const Vec3 a = node(middle), b = node(end);
    for (std::size_t i = 1; i < half_; ++i)
      spoke.push_back(add(a + (static_cast<double>(i) / static_cast<double>(half_)) * (b - a)));
    spoke.push_back(end);
    return spoke;
  }

  Vec3 node(std::int32_t id) const { return mesh_.points[static_cast<std::size_t>(id)]; }
  std::size_t place(std::size_t a, std::size_t b) const { return a * (half_ + 1) + b; }

  /// The square over the side from ring[first] on; neighbours at a fork see it from both sides.
  Ring square_of(const Ring& ring, std::size_t first, std::int32_t middle, Shared& shared) {
    const std::int32_t p = ring[first], q = ring[(first + 2 * half_) % ring.size()];
    const auto key = std::minmax(p, q);
    const auto found = shared.squares.find(key);
    if (found != shared.squares.end()) return p == key.first ? found->second : transposed(found->second);
    Ring square((half_ + 1) * (half_ + 1));
    const Ring along_p = spoke_of(p, middle, shared), along_q = spoke_of(q, middle, shared);
    for (std::size_t i = 0; i <= half_; ++i) {
      square[place(i, 0)] = along_p[i];
      square[place(0, i)] = along_q[i];
      square[place(half_, i)] = inner_[static_cast<std::size_t>(ring[first + i])].back();
      square[place(i, half_)] =
          inner_[static_cast<std::size_t>(ring[(first + 2 * half_ - i) % ring.size()])].back();
    }
    for (std::size_t a = 1; a < half_; ++a)
      for (std::size_t b = 1; b < half_; ++b) square[place(a, b)] = add(coons(square, a, b));
    shared.squares.emplace(key, p == key.first ? square : transposed(square));
    return square;
  }

  Vec3 coons(const Ring& square, std::size_t a, std::size_t b) const {
    const double u = static_cast<double>(a) / static_cast<double>(half_),
                 w = static_cast<double>(b) / static_cast<double>(half_);
    const auto at = [&](std::size_t i, std::size_t j) { return node(square[place(i, j)]); };
    return (1.0 - u) * at(0, b) + u * at(half_, b) + (1.0 - w) * at(a, 0) + w * at(a, half_) -
           (1.0 - u) * ((1.0 - w) * at(0, 0) + w * at(0, half_)) -
           u * ((1.0 - w) * at(half_, 0) + w * at(half_, half_));
  }

  Ring transposed(const Ring& square) const {
    Ring out(square.size());
    for (std::size_t a = 0; a <= half_; ++a)
      for (std::size_t b = 0; b <= half_; ++b) out[place(b, a)] = square[place(a, b)];
    return out;
  }

  Section section_of(const Ring& ring, const Vec3& centre) {
    Section section;
    section.layers.assign(depths_.size(), Ring(ring.size()));
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Ring& line = line_of(ring, k, centre);
      for (std::size_t i = 0; i < line.size(); ++i) section.layers[i][k] = line[i];
    }
    Shared own;
    Shared& shared = at_joint(ring) ? shared_ : own;
    const std::int32_t middle = centre_node(ring, centre, shared);
    for (std::size_t first = 0; first < ring.size(); first += 2 * half_)
      section.squares.push_back(square_of(ring, first, middle, shared));
    return section;
  }

  /// Calls use(quadrilateral, same quadrilateral of the other section) over a section, counter-clockwise
  /// about the branch's direction.
  template <class Use>
  void for_cells(const Section& one, const Section& other, const Use& use) const {
    for (std::size_t i = 0; i + 1 < one.layers.size(); ++i)
      for (std::size_t k = 0; k < one.layers[i].size(); ++k) {
        const auto cell = [&](const Section& s) {
          const std::size_t next = (k + 1) % s.layers[i].size();
          return Quad{s.layers[i][k], s.layers[i][next], s.layers[i + 1][next], s.layers[i + 1][k]};
        };
        use(cell(one), cell(other));
      }
    for (std::size_t n = 0; n < one.squares.size(); ++n)
      for (std::size_t a = 0; a < half_; ++a)
        for (std::size_t b = 0; b < half_; ++b) {
          const auto cell = [&](const Section& s) {
            const Ring& q = s.squares[n];
            return Quad{q[place(a, b)], q[place(a + 1, b)], q[place(a + 1, b + 1)], q[place(a, b + 1)]};
          };
          use(cell(one), cell(other));
        }
  }

  void close(const Section& section, std::size_t branch, bool distal) {
    const std::string name = (distal ? "outlet_" : "inlet_") + std::to_string(branch);
    const auto face = std::find_if(mesh_.faces.begin(), mesh_.faces.end(),
                                   [&](const geometry::Face& f) { return f.name == name; });
    if (face == mesh_.faces.end()) throw GeometryError("the surface has no face " + name);
    for_cells(section, section, [&](const Quad& q, const Quad&) {
      mesh_.quads.push_back(distal ? q : Quad{q[3], q[2], q[1], q[0]});
      mesh_.quad_face_ids.push_back(face->id);
    });
  }

  void sweep(std::size_t branch) {
    const RingGrid& grid = grids_[branch];
    const std::vector<Vec3> centre = centres(branch);
    Section before = section_of(grid.front(), centre.front());
    if (!at_joint(grid.front())) close(before, branch, false);
    for (std::size_t r = 1; r < grid.size(); ++r) {
      Section now = section_of(grid[r], centre[r]);
      for_cells(before, now, [&](const Quad& a, const Quad& b) {
        mesh_.hexahedra.push_back({a[0], a[1], a[2], a[3], b[0], b[1], b[2], b[3]});
      });
      const Ring &low = before.layers.front(), &high = now.layers.front();
      for (std::size_t k = 0; k < low.size(); ++k) {
        const std::size_t next = (k + 1) % low.size();
        mesh_.quads.push_back({low[k], low[next], high[next], high[k]});
        mesh_.quad_face_ids.push_back(mesh_.faces.front().id);
      }
      before = std::move(now);
    }
    if (!at_joint(grid.back())) close(before, branch, true);
  }

  const ReconstructedSurface& surface_;
  double shell_;
  std::size_t half_;  ///< edges of half a side of level 0
  std::vector<double> depths_;
  std::vector<RingGrid> grids_;
  std::vector<Ring> inner_;
  std::vector<int> tubes_at_;  ///< of each point: ends of branches that have it in their ring
  Shared shared_;
  HexMesh mesh_;
};

void judge(SweptHexahedra& swept) {
  swept.least_jacobian = 1.0;
  for (const geometry::Hexahedron& hexahedron : swept.mesh.hexahedra) {
    const double jacobian = geometry::scaled_jacobian(swept.mesh, hexahedron);
    swept.volume_mm3 += geometry::volume(swept.mesh, hexahedron);
    swept.least_jacobian = std::min(swept.least_jacobian, jacobian);
    swept.mean_jacobian += jacobian;
    swept.folded += jacobian > 0.0 ? 0U : 1U;
  }
  swept.mean_jacobian /= static_cast<double>(std::max<std::size_t>(1, swept.mesh.hexahedra.size()));
}

}  // namespace

void validate(const HexahedraOptions& o) {
  const auto require = [](bool good, const char* what) {
    if (!good) throw InvalidInput(std::string("hexahedra: ") + what);
  };
  require(o.shell > 0.0 && o.shell < 1.0, "shell must lie between 0 and 1");
  require(o.layers >= 0 && o.layers <= 32, "layers must lie in [1, 32], or be 0");
  require(o.wanted_jacobian >= 0.0 && o.wanted_jacobian < 1.0, "wanted_jacobian must lie in [0, 1)");
  require(o.relaxations >= 0 && o.relaxations <= 1000, "relaxations must lie in [0, 1000]");
  require(o.growth >= 1.0 && o.growth <= 2.0, "growth must lie in [1, 2]");
}

SweptHexahedra sweep_hexahedra(const ReconstructedSurface& surface, const HexahedraOptions& options,
                               const core::TaskContext& task) {
  validate(options);
  if (surface.level < 1)
    throw InvalidInput("hexahedra: the surface must be of level 1 at least; reconstruct it with level 1");
  SweptHexahedra out;
  Sweep sweep(surface, options);
  out.mesh = sweep.swept(task.sub(0.0, 0.1));
  relax(out.mesh, std::move(sweep).layers(), options.wanted_jacobian, options.relaxations,
        task.sub(0.1, 1.0));
  task.throw_if_cancelled();
  judge(out);
  return out;
}

}  // namespace ostia::reconstruction
