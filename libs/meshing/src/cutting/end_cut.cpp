#include "cutting/end_cut.h"

#include "cutting/plane_cut.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"

#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace ostia::meshing {

using geometry::Vec3;

namespace {

/// As it is written after --plane: what is read back is what was tried.
std::string plane_text(const EndPlane& plane) {
  std::string text = end_name(plane) + "=";
  for (int k = 0; k < 3; ++k) text += (k ? "," : "") + core::fixed_text(plane.origin[k], 2);
  for (int k = 0; k < 3; ++k) text += (k ? "," : ":") + core::fixed_text(plane.normal[k], 3);
  return text;
}
EndPlane as_written(EndPlane plane) {
  for (int k = 0; k < 3; ++k) {
    plane.origin[k] = std::round(100.0 * plane.origin[k]) / 100.0;
    plane.normal[k] = std::round(1000.0 * plane.normal[k]) / 1000.0;
  }
  plane.normal.normalize();
  return plane;
}

}  // namespace

Vec3 end_position(const geometry::VesselTree& tree, const EndPlane& plane) {
  return geometry::node(tree, plane.node).position;
}

Cut cut_at(const geometry::TriMesh& surface, EndPlane plane, const geometry::VesselTree& tree,
           const ClipOptions& options, const std::string& name) {
  Cut cut;
  cut.mesh = cut_branch(surface, plane, end_position(tree, plane), options, name);
  cut.plane = std::move(plane);
  cut.rim = sharpest_rim(cut.mesh, cut.plane);
  return cut;
}

Cut best_cut(const geometry::TriMesh& surface, std::size_t i, const EndPlane& wanted,
             const geometry::VesselTree& tree, const ClipOptions& options, const std::string& name) {
  std::optional<Cut> best;
  std::optional<GeometryError> at_first;
  for (const double extra : {0.0, 0.25, 0.5, 0.75, 1.0}) {
    const EndPlane plane = extra > 0.0 ? end_planes(tree, options.inset_radii + extra)[i] : wanted;
    try {
      Cut cut = cut_at(surface, plane, tree, options, name);
      if (!best || cut.rim.angle_deg > best->rim.angle_deg) best = std::move(cut);
      if (best->rim.angle_deg >= sharp_rim_deg) break;
    } catch (const GeometryError& error) {
      if (!at_first) at_first = error;
    }
  }
  if (!best) throw GeometryError(*at_first);
  return std::move(*best);
}

ClipOptions anywhere(ClipOptions options) {
  options.reach_radii = std::numeric_limits<double>::infinity();
  return options;
}

std::optional<EndPlane> clean_plane(const geometry::TriMesh& lumen, const Uncut& uncut,
                                    const geometry::VesselTree& tree, const ClipOptions& options,
                                    double farthest_radii) {
  constexpr double step_radii = 0.5;
  Vec3 before = uncut.plane.origin;
  for (double extra = step_radii; extra <= farthest_radii; extra += step_radii) {
    const EndPlane plane = end_planes(tree, options.inset_radii + extra)[uncut.end];
    if ((plane.origin - before).norm() < 1e-6) return std::nullopt;  // half of its segment
    before = plane.origin;
    try {
      const EndPlane written = as_written(plane);
      if (cut_at(lumen, written, tree, options, end_name(plane)).rim.angle_deg >= sharp_rim_deg)
        return written;
    } catch (const GeometryError&) {  // nor here
    }
  }
  return std::nullopt;
}

void refuse(const geometry::TriMesh& lumen, const std::vector<Uncut>& failed,
            const geometry::VesselTree& tree, const ClipOptions& options) {
  if (failed.empty()) return;
  std::string message = failed.size() == 1 ? "" : std::to_string(failed.size()) + " ends cannot be cut:\n";
  std::vector<EndPlane> ends;
  for (const Uncut& uncut : failed) {
    if (failed.size() > 1) message += "  ";
    const EndPlane& plane = uncut.plane;
    message += uncut.why + " (at " + core::fixed_text(plane.origin.x(), 2) + "," +
               core::fixed_text(plane.origin.y(), 2) + "," + core::fixed_text(plane.origin.z(), 2) + " mm); ";
    if (const auto clean = clean_plane(lumen, uncut, tree, anywhere(options), 20.0))
      message += "it can be cut " + core::fixed_text((clean->origin - plane.origin).norm(), 1) +
                 " mm farther inside by --plane " + plane_text(*clean);
    else
      message += "no place along the first half of its vessel can be cut; place a plane by --plane " +
                 end_name(plane) + "=x,y,z:nx,ny,nz";
    if (failed.size() > 1) message += "\n";
    ends.push_back(plane);
  }
  throw EndsNotCut(message, std::move(ends));
}

}  // namespace ostia::meshing
