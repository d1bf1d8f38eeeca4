#include "stretch.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace ostia::reconstruction {

using geometry::Vec2;

namespace {

constexpr double least_ratio = 0.1;

void check(const EllipticSection& section, std::size_t edge) {
  const std::string who = "elliptic sections: edge " + std::to_string(edge) + ": ";
  if (!(section.ratio >= least_ratio && section.ratio <= 1.0))
    throw InvalidInput(who + "ratio must be the minor semi-axis by the major one, 0.1 to 1");
  if (!section.major.allFinite() || section.major.norm() == 0.0)
    throw InvalidInput(who + "major must be a direction: finite and not 0");
}

/// exp of the logarithm, times a point; det is 1.
Vec2 times_exponential(const Stretch& log, const Vec2& p) {
  const double h = std::hypot(log.c, log.s);
  const double along = h > 1e-12 ? std::sinh(h) / h : 1.0, whole = std::cosh(h);
  return {whole * p.x() + along * (log.c * p.x() + log.s * p.y()),
          whole * p.y() + along * (log.s * p.x() - log.c * p.y())};
}

}  // namespace

void validate(const EllipticSections& sections, const geometry::VesselGraph& graph) {
  if (sections.of_edge.size() != graph.edges.size())
    throw InvalidInput("elliptic sections: of_edge must have one entry for each of the network's " +
                       std::to_string(graph.edges.size()) + " edges, not " +
                       std::to_string(sections.of_edge.size()));
  for (std::size_t i = 0; i < sections.of_edge.size(); ++i)
    for (const EllipticSection& section : sections.of_edge[i]) check(section, i);
}

Stretch stretch_of(const EllipticSection& section, const geometry::Frame& frame) {
  const double x = section.major.dot(frame.normal), y = section.major.dot(frame.binormal);
  const double square = x * x + y * y;
  if (section.ratio == 1.0 || square < 1e-12 * section.major.squaredNorm()) return {};
  const double h = -0.5 * std::log(section.ratio);
  return {h * (x * x - y * y) / square, h * 2.0 * x * y / square};
}

EllipticSection section_of(const Stretch& stretch, const geometry::Frame& frame) {
  if (stretch.round()) return {1.0, frame.normal};
  const double angle = 0.5 * std::atan2(stretch.s, stretch.c);
  return {std::max(least_ratio, std::exp(-2.0 * std::hypot(stretch.c, stretch.s))),
          std::cos(angle) * frame.normal + std::sin(angle) * frame.binormal};
}

Vec2 stretched(const Stretch& stretch, const Vec2& point) {
  return times_exponential(stretch, point);
}

Vec2 unstretched(const Stretch& stretch, const Vec2& point) {
  return times_exponential(stretch * -1.0, point);
}

}  // namespace ostia::reconstruction
