#pragma once
/// \file One end of a lumen cut off, and where it can be where it cannot be here.

#include "cutting/cut_rim.h"

#include "ostia/meshing/clip.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace ostia::meshing {

/// A cap that meets the wall at less than this makes flat elements.
constexpr double sharp_rim_deg = 40.0;

geometry::Vec3 end_position(const geometry::VesselTree& tree, const EndPlane& plane);

/// The surface without one end.
struct Cut {
  geometry::TriMesh mesh;
  EndPlane plane;
  RimWedge rim;
};
/// `name` stands in messages. Throws GeometryError where the plane does not cut cleanly.
Cut cut_at(const geometry::TriMesh& surface, EndPlane plane, const geometry::VesselTree& tree,
           const ClipOptions& options, const std::string& name);
/// Where a plane does not cut cleanly (an end torn aslant, say), or runs along a wall that flares (into the
/// aorta, say), it is tried up to one radius farther inside; the cut whose wedge is the least sharp is taken.
/// `i` is the end's number in end_planes.
Cut best_cut(const geometry::TriMesh& surface, std::size_t i, const EndPlane& wanted,
             const geometry::VesselTree& tree, const ClipOptions& options, const std::string& name);

/// The same options where a person has said where to cut: at any distance from the axis' end.
ClipOptions anywhere(ClipOptions options);

/// An end that cannot be cut where its plane stands.
struct Uncut {
  std::size_t end;  ///< its number in end_planes
  EndPlane plane;
  std::string why;
};
/// The nearest plane farther inside that does cut cleanly, as far as the program's own planes may go and at
/// most so many radii from there; `options` say how far it may reach.
std::optional<EndPlane> clean_plane(const geometry::TriMesh& lumen, const Uncut& uncut,
                                    const geometry::VesselTree& tree, const ClipOptions& options,
                                    double farthest_radii);
/// Throws EndsNotCut where there are any: each with its place and what a person can do.
void refuse(const geometry::TriMesh& lumen, const std::vector<Uncut>& failed,
            const geometry::VesselTree& tree, const ClipOptions& options);

}  // namespace ostia::meshing
