#include "base_mesh.h"

#include "ostia/core/parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace ostia::reconstruction {
namespace {

using std::numbers::pi;
constexpr double most_gaps = 0.8;  // of what two joints leave of a branch
using Ring = std::vector<std::int32_t>;

class Builder {
 public:
  Builder(const std::vector<Tube>& tubes, const std::vector<Joint>& joints,
          const ReconstructionOptions& options)
      : tubes_(tubes), options_(options), ends_(tubes.size()) {
    const double side = 2.0 * pi / options.sides;
    scale_ = std::sqrt(side / std::sin(side));  // a polygon with the circle's area
    for (std::size_t j = 0; j < joints.size(); ++j) add_joint(joints[j], static_cast<std::int32_t>(j));
  }

  QuadMesh built(const std::vector<std::int32_t>& wanted) {
    std::vector<std::vector<double>> sections(wanted.size());
    core::parallel_for(wanted.size(), 16, [&](std::size_t i) {
      const auto tube = static_cast<std::size_t>(wanted[i]);
      sections[i] = own_sections(tubes_[tube], ends_[tube][0], ends_[tube][1]);
    });
    set_clear(wanted, sections);
    for (std::size_t i = 0; i < wanted.size(); ++i)
      add_tube(static_cast<std::size_t>(wanted[i]), sections[i]);
    return std::move(mesh_);
  }

 private:
  struct End {
    Ring ring;                          ///< counter-clockwise about the tube's tangent; empty at an open end
    double clearance = 0.0, gap = 0.0;  ///< mm, and radii
  };

  void set_clear(const std::vector<std::int32_t>& wanted, const std::vector<std::vector<double>>& sections) {
    constexpr double far = std::numeric_limits<double>::infinity();
    mesh_.clear.assign(tubes_.size(), {-far, far});
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      const auto tube = static_cast<std::size_t>(wanted[i]);
      if (!ends_[tube][0].ring.empty()) mesh_.clear[tube][0] = sections[i].front();
      if (!ends_[tube][1].ring.empty()) mesh_.clear[tube][1] = sections[i].back();
    }
  }

  std::int32_t add(const Vec3& point, const Tag& tag) {
    mesh_.points.push_back(point);
    mesh_.tags.push_back(tag);
    return static_cast<std::int32_t>(mesh_.points.size() - 1);
  }

  void add_joint(const Joint& joint, std::int32_t index) {
    const auto first = static_cast<std::int32_t>(mesh_.points.size());
    for (const Vec3& point : joint.points) add(point, {Place::joint, index, 0.0});
    mesh_.flat_joints.push_back(joint.style.flat ? 1 : 0);
    for (std::size_t i = 0; i < joint.slots.size(); ++i) {
      Ring ring = joint.rings[i];
      for (std::int32_t& point : ring) point += first;
      if (joint.slots[i].distal) std::reverse(ring.begin(), ring.end());
      End& end = ends_[static_cast<std::size_t>(joint.slots[i].tube)][joint.slots[i].distal ? 1 : 0];
      end = {std::move(ring), joint.clearance[i], joint.style.gap};
    }
  }

  /// The mean angle by which a ring is turned against a regular one in the frame.
  double turn_of(const Ring& ring, const TubePlace& place) const {
    double c = 0.0, s = 0.0;
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Vec3 d = mesh_.points[static_cast<std::size_t>(ring[k])] - place.point;
      const double angle = std::atan2(d.dot(place.frame.binormal), d.dot(place.frame.normal)) -
                           2.0 * pi * static_cast<double>(k) / static_cast<double>(ring.size());
      c += std::cos(angle);
      s += std::sin(angle);
    }
    return std::atan2(s, c);
  }

  Ring section(std::size_t tube, double abscissa, double turn, Place kind) {
    const TubePlace place = at(tubes_[tube], abscissa);
    const Stretch stretch = clear_stretch(place, abscissa, mesh_.clear[tube]);
    Ring ring;
    for (int k = 0; k < options_.sides; ++k) {
      const double angle = turn + 2.0 * pi * k / options_.sides;
      geometry::Vec2 on(std::cos(angle), std::sin(angle));
      if (!stretch.round()) on = stretched(stretch, on);
      const Vec3 out = on.x() * place.frame.normal + on.y() * place.frame.binormal;
      ring.push_back(
          add(place.point + scale_ * place.radius * out, {kind, static_cast<std::int32_t>(tube), abscissa}));
    }
    return ring;
  }

  void add_quad(const geometry::Quad& quad, std::size_t tube, std::uint8_t face) {
    mesh_.quads.push_back(quad);
    mesh_.branch_of_quad.push_back(static_cast<std::int32_t>(tube));
    mesh_.face_of_quad.push_back(face);
  }

  void connect(const Ring& a, const Ring& b, std::size_t tube) {
    for (std::size_t k = 0; k < a.size(); ++k) {
      const std::size_t next = (k + 1) % a.size();
      add_quad({a[k], a[next], b[next], b[k]}, tube, 0);
    }
  }

  void close(const Ring& ring, std::size_t tube, bool distal) {
    const std::uint8_t face = distal ? 2 : 1;
    const auto turned = [&](geometry::Quad q) { return distal ? q : geometry::Quad{q[3], q[2], q[1], q[0]}; };
    if (ring.size() == 4) return add_quad(turned({ring[0], ring[1], ring[2], ring[3]}), tube, face);
    const double s = distal ? tubes_[tube].length() : 0.0;
    const std::int32_t middle =
        add(at(tubes_[tube], s).point, {Place::cap, static_cast<std::int32_t>(tube), s});
    for (std::size_t k = 0; k < ring.size(); k += 2)
      add_quad(turned({middle, ring[k], ring[k + 1], ring[(k + 2) % ring.size()]}), tube, face);
  }

  /// Abscissas of the rings that are the branch's own; the first and last lie clear of the joints.
  std::vector<double> own_sections(const Tube& tube, const End& start, const End& end) const {
    const double length = tube.length();
    const auto wanted = [&](const End& e, double radius) { return e.ring.empty() ? 0.0 : e.gap * radius; };
    const double first = std::max(start.clearance, 0.0), last = std::max(end.clearance, 0.0);
    const double gaps = wanted(start, tube.radius.front()) + wanted(end, tube.radius.back());
    const double fit = gaps > 0.0 ? std::min(1.0, most_gaps * (length - first - last) / gaps) : 0.0;
    const double from = first + fit * wanted(start, tube.radius.front()),
                 to = length - last - fit * wanted(end, tube.radius.back());
    std::vector<double> s, r, c;
    for (std::size_t i = 0; i < tube.points.size(); ++i) {
      const double x = tube.abscissa[i];
      if (x > from && x < to) {
        if (s.empty()) s.push_back(from), r.push_back(at(tube, from).radius), c.push_back(tube.curvature[i]);
        s.push_back(x);
        r.push_back(tube.radius[i] * tube.factor[i]);
        c.push_back(tube.curvature[i]);
      }
    }
    if (s.empty()) s.push_back(from), r.push_back(at(tube, from).radius), c.push_back(0.0);
    s.push_back(to);
    r.push_back(at(tube, to).radius);
    c.push_back(c.back());
    return section_abscissas(s, r, c, options_.spacing, options_.bending);
  }

  void add_tube(std::size_t i, const std::vector<double>& sections) {
    const Tube& tube = tubes_[i];
    End &start = ends_[i][0], &end = ends_[i][1];
    double first = start.ring.empty() ? 0.0 : turn_of(start.ring, at(tube, 0.0));
    double last = end.ring.empty() ? first : turn_of(end.ring, at(tube, tube.length()));
    if (start.ring.empty()) first = last;
    // The end's ring begins at the point that leaves the least twist, and the rest is spread evenly.
    const double step = 2.0 * pi / options_.sides;
    const auto shift = static_cast<std::ptrdiff_t>(std::lround((last - first) / step));
    last -= step * static_cast<double>(shift);
    if (!end.ring.empty()) {
      const auto n = static_cast<std::ptrdiff_t>(end.ring.size());
      std::rotate(end.ring.begin(), end.ring.begin() + (((n - shift) % n) + n) % n, end.ring.end());
    }
    Ring before = start.ring;
    for (std::size_t k = 0; k < sections.size(); ++k) {
      const bool rim = (k == 0 && start.ring.empty()) || (k + 1 == sections.size() && end.ring.empty());
      const double t = sections[k] / tube.length();
      const Ring ring = section(i, sections[k], (1.0 - t) * first + t * last, rim ? Place::rim : Place::wall);
      if (!before.empty()) connect(before, ring, i);
      if (k == 0 && start.ring.empty()) close(ring, i, false);
      if (k + 1 == sections.size() && end.ring.empty()) close(ring, i, true);
      before = ring;
    }
    if (!end.ring.empty()) connect(before, end.ring, i);
  }

  const std::vector<Tube>& tubes_;
  const ReconstructionOptions& options_;
  std::vector<std::array<End, 2>> ends_;
  double scale_ = 1.0;
  QuadMesh mesh_;
};

}  // namespace

Stretch clear_stretch(const TubePlace& place, double abscissa, const std::array<double, 2>& clear) {
  constexpr double length = 2.0;  // of the blend, in radii
  if (place.stretch.round()) return place.stretch;
  const double from_joint = std::min(abscissa - clear[0], clear[1] - abscissa);
  const double t = std::clamp(from_joint / (length * place.radius), 0.0, 1.0);
  return place.stretch * (t * t * (3.0 - 2.0 * t));
}

double polygon_scale(const ReconstructionOptions& options, int level) {
  const double side = 2.0 * std::numbers::pi / (options.sides << level);
  return std::sqrt(side / std::sin(side));
}

bool along_first_diagonal(const QuadMesh& mesh, const geometry::Quad& q) {
  const auto squared = [&](std::int32_t a, std::int32_t b) {
    return (mesh.points[static_cast<std::size_t>(a)] - mesh.points[static_cast<std::size_t>(b)])
        .squaredNorm();
  };
  return squared(q[0], q[2]) <= squared(q[1], q[3]);
}

std::vector<geometry::Triangle> triangles_of(const QuadMesh& mesh) {
  std::vector<geometry::Triangle> triangles(2 * mesh.quads.size());
  core::parallel_for(mesh.quads.size(), 4096, [&](std::size_t i) {
    const geometry::Quad& q = mesh.quads[i];
    const bool first = along_first_diagonal(mesh, q);
    triangles[2 * i] = first ? geometry::Triangle{q[0], q[1], q[2]} : geometry::Triangle{q[1], q[2], q[3]};
    triangles[2 * i + 1] =
        first ? geometry::Triangle{q[0], q[2], q[3]} : geometry::Triangle{q[1], q[3], q[0]};
  });
  return triangles;
}

QuadMesh base_mesh(const std::vector<Tube>& tubes, const std::vector<std::int32_t>& wanted,
                   const std::vector<Joint>& joints, const ReconstructionOptions& options) {
  return Builder(tubes, joints, options).built(wanted);
}

}  // namespace ostia::reconstruction
