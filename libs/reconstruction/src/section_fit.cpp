#include "tubes.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/geometry/aabb_tree.h"
#include "ostia/geometry/graph_faults.h"
#include "ostia/reconstruction/elliptic_sections.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

namespace ostia::reconstruction {
namespace {

using geometry::Vec2;
using Mat2 = Eigen::Matrix2d;
using std::numbers::pi;

struct Ellipse {
  double radius = 0.0;  // of the circle with its area
  Stretch stretch;
};

struct Sample {
  double abscissa = 0.0;
  Ellipse ellipse;
};

/// The corners of the section about a place, in its frame; nothing where a ray meets no wall.
std::optional<std::vector<Vec2>> section_at(const TubePlace& place, const geometry::AabbTree& wall,
                                            int rays) {
  std::vector<Vec2> corners;
  for (int k = 0; k < rays; ++k) {
    const double angle = 2.0 * pi * k / rays;
    const Vec2 on(std::cos(angle), std::sin(angle));
    const auto hit = wall.first_hit(place.point, on.x() * place.frame.normal + on.y() * place.frame.binormal);
    if (!hit) return std::nullopt;
    corners.push_back(hit->t * on);
  }
  return corners;
}

struct Moments {
  double area = 0.0;
  Vec2 centre = Vec2::Zero();
  Mat2 second = Mat2::Zero();  // about the centre, by area
};

/// Of the polygon, by the triangles that its sides make with the origin.
Moments moments_of(const std::vector<Vec2>& corners) {
  Moments sum;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2 &p = corners[i], &q = corners[(i + 1) % corners.size()];
    const double area = 0.5 * (p.x() * q.y() - p.y() * q.x());
    const Vec2 both = p + q;
    sum.area += area;
    sum.centre += area / 3.0 * both;
    sum.second += area / 12.0 * (p * p.transpose() + q * q.transpose() + both * both.transpose());
  }
  sum.centre /= sum.area;
  sum.second = Mat2(sum.second / sum.area - sum.centre * sum.centre.transpose());
  return sum;
}

/// With the polygon's area and second moments; those of an ellipse are the squared semi-axes by four.
Ellipse ellipse_of(const Moments& moments, int corners) {
  const double side = 2.0 * pi / corners;
  const Eigen::SelfAdjointEigenSolver<Mat2> axes(moments.second);
  const double h = 0.25 * std::log(axes.eigenvalues()[1] / std::max(axes.eigenvalues()[0], 1e-12));
  const Vec2 major = axes.eigenvectors().col(1);
  return {std::sqrt(moments.area / (pi * std::sin(side) / side)),
          {h * (major.x() * major.x() - major.y() * major.y()), h * 2.0 * major.x() * major.y()}};
}

/// RMS of the corners' distances from the ellipse, in radii.
double roughness(const std::vector<Vec2>& corners, const Moments& moments, const Ellipse& ellipse) {
  double squares = 0.0;
  for (const Vec2& corner : corners) {
    const double off = unstretched(ellipse.stretch, corner - moments.centre).norm() / ellipse.radius - 1.0;
    squares += off * off;
  }
  return std::sqrt(squares / static_cast<double>(corners.size()));
}

std::optional<Ellipse> good_ellipse(const TubePlace& place, const geometry::AabbTree& wall,
                                    const SectionFitOptions& options) {
  const auto corners = section_at(place, wall, options.rays);
  if (!corners) return std::nullopt;
  const Moments moments = moments_of(*corners);
  const Ellipse ellipse = ellipse_of(moments, options.rays);
  const bool good = std::abs(ellipse.radius / place.radius - 1.0) <= options.most_off &&
                    roughness(*corners, moments, ellipse) <= options.most_rough;
  return good ? std::optional(ellipse) : std::nullopt;
}

std::vector<Sample> samples_of(const Tube& tube, const geometry::AabbTree& wall,
                               const SectionFitOptions& options, std::size_t& cut) {
  std::vector<Sample> samples;
  for (double s = 0.0; s < tube.length();) {
    const TubePlace place = at(tube, s);
    if (s > 0.0) {  // not at the very end, which may be closed
      ++cut;
      if (const auto ellipse = good_ellipse(place, wall, options)) samples.push_back({s, *ellipse});
    }
    s += std::max(options.step * place.radius, 1e-4 * tube.length());
  }
  return samples;
}

/// The mean about a place, falling to nothing at `before` and `after`; the nearest where there is none.
Ellipse mean_about(const std::vector<Sample>& samples, double before, double here, double after) {
  Ellipse sum;
  double weight = 0.0;
  const Sample* nearest = nullptr;
  for (const Sample& sample : samples) {
    const double away = sample.abscissa - here, reach = away < 0.0 ? here - before : after - here;
    if (nearest == nullptr || std::abs(away) < std::abs(nearest->abscissa - here)) nearest = &sample;
    const double near = reach > 0.0 ? std::max(0.0, 1.0 - std::abs(away) / reach) : 0.0;
    sum.radius += near * sample.ellipse.radius;
    sum.stretch = sum.stretch + sample.ellipse.stretch * near;
    weight += near;
  }
  if (weight < 1e-9) return nearest->ellipse;
  return {sum.radius / weight, sum.stretch * (1.0 / weight)};
}

void fit_branch(const Tube& tube, const geometry::GraphBranch& branch, const std::vector<Sample>& samples,
                FittedSections& out) {
  const std::size_t last = tube.knots.size() - 1;
  for (std::size_t k = 0; k <= last; ++k) {
    const geometry::Frame& frame = tube.frames[tube.knots[k]];
    const double here = tube.abscissa[tube.knots[k]];
    const double before = k > 0 ? tube.abscissa[tube.knots[k - 1]] : here,
                 after = k < last ? tube.abscissa[tube.knots[k + 1]] : here;
    std::optional<Ellipse> ellipse;
    if (!samples.empty()) ellipse = mean_about(samples, before, here, after);
    const EllipticSection section = section_of(ellipse ? ellipse->stretch : Stretch(), frame);
    const auto set = [&](std::size_t edge, std::size_t end) {
      const auto index = static_cast<std::size_t>(branch.edges[edge]);
      geometry::GraphEdge& changed = out.graph.edges[index];
      out.sections.of_edge[index][end] = section;
      if (ellipse) (end == 0 ? changed.radius_from : changed.radius_to) = ellipse->radius;
    };
    if (k > 0) set(k - 1, 1);
    if (k < last) set(k, 0);
  }
}

}  // namespace

void validate(const SectionFitOptions& o) {
  const auto require = [](bool fine, const std::string& what) {
    if (!fine) throw InvalidInput("fit of elliptic sections: " + what);
  };
  require(o.rays >= 8 && o.rays <= 256, "rays must be 8 to 256");
  require(o.step >= 0.05 && o.step <= 2.0, "step must be 0.05 to 2 radii");
  require(o.most_off > 0.0 && o.most_off < 1.0, "most_off must lie between 0 and 1");
  require(o.most_rough > 0.0 && o.most_rough < 1.0, "most_rough must lie between 0 and 1");
}

FittedSections fit_elliptic_sections(const geometry::VesselGraph& graph, const geometry::TriMesh& wall,
                                     const SectionFitOptions& options, const core::TaskContext& task) {
  validate(options);
  task.throw_if_cancelled();
  if (wall.triangles.empty())
    throw InvalidInput("fit of elliptic sections: the surface has no triangles: nothing to cut");
  geometry::require_sound(graph, "the network of vessels", false, task.sub(0.0, 0.1));
  FittedSections out{graph, {}, 0, 0};
  out.sections.of_edge.resize(graph.edges.size());
  const auto branches = geometry::branches(graph, geometry::GraphIncidence(graph));
  const std::vector<Tube> tubes = tubes_of(graph);
  const geometry::AabbTree tree(wall);
  std::vector<std::vector<Sample>> samples(tubes.size());
  std::vector<std::size_t> cut(tubes.size(), 0);
  core::parallel_for(tubes.size(), 1, [&](std::size_t b) {
    task.throw_if_cancelled();
    samples[b] = samples_of(tubes[b], tree, options, cut[b]);
  });
  for (std::size_t b = 0; b < tubes.size(); ++b) {
    fit_branch(tubes[b], branches[b], samples[b], out);
    out.cut += cut[b];
    out.used += samples[b].size();
  }
  task.set_progress(1.0);
  return out;
}

}  // namespace ostia::reconstruction
