#include "intake/intake_ends.h"

#include "intake/intake_mending.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"
#include "ostia/geometry/aabb_tree.h"
#include "ostia/geometry/mesh_topology.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace ostia::pipeline {
namespace {

using geometry::TriMesh;
using geometry::Vec3;
using meshing::GivenEnd;

constexpr double least_rim_mm = 0.2;  // half as wide is no vessel that is meshed
constexpr double part_is_there_radii = 2.0;
constexpr std::size_t most_named = 12;
// The triangles of a cap face one way, also of a shaken one: its vector area over its area is more than this;
// those of a tube cancel out.
constexpr double least_facing = 0.4, largest_cap_share = 0.25;

}  // namespace

std::string place_text(const Vec3& p) {
  return "(" + core::fixed_text(p.x(), 1) + ", " + core::fixed_text(p.y(), 1) + ", " +
         core::fixed_text(p.z(), 1) + ") mm";
}

std::string words_of(const GivenEnd& end) {
  return (end.name.empty() ? std::string("an end") : end.name) + " at " + place_text(end.centre) + ", " +
         core::fixed_text(2.0 * end.radius_mm, 2) + " mm wide";
}

std::vector<GivenEnd> open_rims(const TriMesh& mesh) {
  std::vector<GivenEnd> ends;
  for (const auto& loop : geometry::boundary_loops(mesh))
    if (const GivenEnd end = meshing::end_at_loop(mesh, loop); end.radius_mm >= least_rim_mm)
      ends.push_back(end);
  return ends;
}

std::vector<GivenEnd> take_caps_off(geometry::FacedSurface& surface) try {
  geometry::FacedSurface whole{geometry::oriented(geometry::welded(surface.mesh)), {}, surface.faces};
  const geometry::SurfaceFaults faults = geometry::find_faults(whole.mesh, false);
  if (faults.non_manifold_edges > 0 || faults.non_manifold_vertices > 0) return {};
  whole.face_ids = labels_on(whole.mesh, surface);
  meshing::OpenedCaps opened = meshing::without_flat_caps(whole);
  if (opened.ends.empty()) return {};
  surface.mesh = std::move(opened.wall);
  surface.face_ids = labels_on(surface.mesh, whole);
  return std::move(opened.ends);
} catch (const Error&) {
  return {};  // too broken for it: mended first
}

std::vector<GivenEnd> rims_gone(const TriMesh& came, const TriMesh& mended) try {
  std::vector<GivenEnd> gone = open_rims(geometry::oriented(geometry::welded(came)));
  if (gone.empty()) return gone;
  const std::vector<GivenEnd> left = open_rims(mended);
  const geometry::AabbTree tree(geometry::fill_holes(mended).mesh);
  std::erase_if(gone, [&](GivenEnd& end) {
    const auto same = [&](const GivenEnd& other) {
      return (other.centre - end.centre).norm() <= end.radius_mm;
    };
    if (std::ranges::any_of(left, same)) return true;
    // Far from what is left it is of a part that was left out. A part that faces inward has its ends turned.
    if (tree.closest(end.centre).distance > part_is_there_radii * end.radius_mm) return true;
    GivenEnd turned = end;
    turned.normal = -end.normal;
    return meshing::is_hole_in_wall(tree, end) || meshing::is_hole_in_wall(tree, turned);
  });
  return gone;
} catch (const Error&) {
  return {};  // it has no rims that can be told
}

std::vector<GivenEnd> labels_without_end(const geometry::FacedSurface& came,
                                         const std::vector<GivenEnd>& ends) {
  struct Sum {
    double area = 0.0;
    Vec3 moment = Vec3::Zero(), vector = Vec3::Zero();
  };
  if (came.face_ids.empty()) return {};
  const TriMesh mesh = geometry::welded(came.mesh);  // a soup of triangles would be as many parts
  const std::vector<std::int32_t> labels = labels_on(mesh, came), parts = geometry::components(mesh);
  std::map<std::pair<std::int32_t, std::int32_t>, Sum> sums;  // by part and label: parts may number alike
  std::map<std::int32_t, double> area_of_label;
  double whole = 0.0;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const auto at = [&](std::size_t k) {
      return mesh.points[static_cast<std::size_t>(mesh.triangles[i][k])];
    };
    const Vec3 vector = 0.5 * (at(1) - at(0)).cross(at(2) - at(0));
    Sum& sum = sums[{parts[i], labels[i]}];
    sum.area += vector.norm();
    sum.vector += vector;
    sum.moment += vector.norm() / 3.0 * (at(0) + at(1) + at(2));
    area_of_label[labels[i]] += vector.norm();
    whole += vector.norm();
  }
  std::vector<GivenEnd> lost;
  for (const auto& [key, sum] : sums) {
    const std::int32_t id = key.second;
    if (!(sum.area > 0.0) || area_of_label.at(id) > largest_cap_share * whole) continue;
    if (sum.vector.norm() < least_facing * sum.area) continue;
    GivenEnd end;
    const auto face = std::ranges::find(came.faces, id, &geometry::Face::id);
    end.name = face != came.faces.end() && !face->name.empty() ? face->name : "label " + std::to_string(id);
    end.centre = sum.moment / sum.area;
    end.radius_mm = std::sqrt(sum.area / std::numbers::pi);
    const bool there = std::ranges::any_of(
        ends, [&](const GivenEnd& one) { return (one.centre - end.centre).norm() <= end.radius_mm; });
    if (!there) lost.push_back(end);
  }
  return lost;
}

std::vector<std::string> warnings_of(const std::vector<meshing::LabelNotTaken>& labels) {
  std::vector<std::string> told;
  for (const meshing::LabelNotTaken& one : labels) {
    if (told.size() == most_named) {
      told.push_back("so are " + std::to_string(labels.size() - most_named) + " labels more");
      break;
    }
    told.push_back(
        "the label " + words_of(one.end) +
        ", is neither the wall's nor was it taken as an end: it stays part of the wall (cut it open "
        "there, or give --source or --target at it, if a vessel ends there)");
  }
  return told;
}

}  // namespace ostia::pipeline
