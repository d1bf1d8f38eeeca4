// The VTP files of a branch report, with the names that VMTK's scripts give to arrays.

#include "reports/branch_report_files.h"

#include <limits>
#include <numeric>

namespace ostia::pipeline {
namespace {

using analysis::BifurcationSection;
using analysis::BifurcationVector;
using analysis::BranchSection;
using geometry::Vec3;
using io::Polydata;
using io::PolydataArrays;

void add(PolydataArrays& arrays, const std::string& name, double value) {
  arrays.numbers[name].values.push_back(value);
}
void add(PolydataArrays& arrays, const std::string& name, const Vec3& value) {
  io::FieldValues& field = arrays.numbers[name];
  field.components = 3;
  field.values.insert(field.values.end(), {value.x(), value.y(), value.z()});
}
void add_whole(PolydataArrays& arrays, const std::string& name, std::int32_t value) {
  arrays.whole[name].push_back(value);
}

Polydata systems(const BranchReport& report) {
  Polydata out;
  for (const analysis::BifurcationSystem& one : report.bifurcations->systems) {
    out.points.push_back(one.origin);
    add(out.at_points, "Normal", one.normal);
    add(out.at_points, "UpNormal", one.up_normal);
    add_whole(out.at_points, "GroupIds", one.group);
  }
  return out;
}

Polydata vectors(const BranchReport& report) {
  Polydata out;
  for (const BifurcationVector& one : report.bifurcations->vectors) {
    out.points.push_back(one.point);
    add(out.at_points, "BifurcationVectors", one.vector);
    add(out.at_points, "InPlaneBifurcationVectors", one.in_plane);
    add(out.at_points, "OutOfPlaneBifurcationVectors", one.out_of_plane);
    add(out.at_points, "InPlaneBifurcationVectorAngles", one.in_plane_rad);
    add(out.at_points, "OutOfPlaneBifurcationVectorAngles", one.out_of_plane_rad);
    add_whole(out.at_points, "BifurcationVectorsOrientation", one.downstream);
    add_whole(out.at_points, "GroupIds", one.group);
    add_whole(out.at_points, "BifurcationGroupIds", one.bifurcation);
  }
  return out;
}

void add_outline(const BranchSection& one, const std::string& kind, Polydata& out) {
  std::vector<std::int32_t> polygon(one.outline.size());
  std::iota(polygon.begin(), polygon.end(), static_cast<std::int32_t>(out.points.size()));
  out.points.insert(out.points.end(), one.outline.begin(), one.outline.end());
  out.polygons.push_back(std::move(polygon));
  add_whole(out.at_cells, kind + "GroupIds", one.group);
  add(out.at_cells, kind + "Point", one.point);
  add(out.at_cells, kind + "Normal", one.normal);
  add(out.at_cells, kind + "Area", one.area_mm2);
  add(out.at_cells, kind + "MinSize", one.min_mm);
  add(out.at_cells, kind + "MaxSize", one.max_mm);
  add(out.at_cells, kind + "Shape", one.shape());
  add_whole(out.at_cells, kind + "Closed", one.closed);
  add_whole(out.at_cells, kind + "DistanceSpheres", one.spheres);
}

Polydata branch_outlines(const BranchReport& report) {
  Polydata out;
  for (const BranchSection& one : report.sections->branches) add_outline(one, "BranchSection", out);
  return out;
}

Polydata bifurcation_outlines(const BranchReport& report) {
  Polydata out;
  for (const BifurcationSection& one : report.sections->bifurcations) {
    add_outline(one.section, "BifurcationSection", out);
    add_whole(out.at_cells, "BifurcationSectionBifurcationGroupIds", one.bifurcation);
    add_whole(out.at_cells, "BifurcationSectionOrientation", one.downstream);
  }
  return out;
}

Polydata mapped_surface(const BranchReport& report) {
  Polydata out;
  for (const analysis::MappedBranch& branch : report.mapped->branches) {
    const auto first = static_cast<std::int32_t>(out.points.size());
    out.points.insert(out.points.end(), branch.mesh.points.begin(), branch.mesh.points.end());
    for (const geometry::Triangle& t : branch.mesh.triangles)
      out.polygons.push_back({first + t[0], first + t[1], first + t[2]});
    for (std::size_t i = 0; i < branch.mesh.points.size(); ++i) {
      add_whole(out.at_points, "GroupIds", branch.group);
      add(out.at_points, "AbscissaMetric", branch.abscissa_mm[i]);
      add(out.at_points, "AngularMetric", branch.angle_rad[i]);
      add(out.at_points, "DistanceToCenterlines", branch.distance_mm[i]);
      add(out.at_points, "HarmonicMapping",
          branch.harmonic.empty() ? std::numeric_limits<double>::quiet_NaN() : branch.harmonic[i]);
      add(out.at_points, "StretchedMapping", branch.stretched_mm[i]);
    }
    for (const auto& [name, field] : report.fields) {
      const std::vector<double> here =
          analysis::mapped_values(branch, field.values, static_cast<std::size_t>(field.components));
      io::FieldValues& all = out.at_points.numbers[name];
      all.components = field.components;
      all.values.insert(all.values.end(), here.begin(), here.end());
    }
  }
  return out;
}

Polydata patches(const BranchReport& report) {
  Polydata out;
  for (const analysis::PatchTriangle& triangle : report.patched->triangles) {
    const auto first = static_cast<std::int32_t>(out.points.size());
    out.points.insert(out.points.end(), triangle.corners.begin(), triangle.corners.end());
    out.polygons.push_back({first, first + 1, first + 2});
    const analysis::WallPatch& patch = report.patched->patches[triangle.patch];
    add_whole(out.at_cells, "GroupIds", patch.group);
    add_whole(out.at_cells, "LongitudinalPatchNumber", patch.along);
    add_whole(out.at_cells, "CircularPatchNumber", patch.around);
    add(out.at_cells, "PatchArea", patch.area_mm2);
    for (std::size_t v = 0; v < report.patch_values.size(); ++v)
      add(out.at_cells, report.patch_values[v], patch.means[v]);
  }
  return out;
}

}  // namespace

std::vector<std::pair<std::string, Polydata>> branch_polydata(const BranchReport& report) {
  std::vector<std::pair<std::string, Polydata>> files;
  if (!report.bifurcations->systems.empty()) {
    files.emplace_back("bifurcation-systems.vtp", systems(report));
    files.emplace_back("bifurcation-vectors.vtp", vectors(report));
  }
  if (report.sections && !report.sections->branches.empty())
    files.emplace_back("branch-sections.vtp", branch_outlines(report));
  if (report.sections && !report.sections->bifurcations.empty())
    files.emplace_back("bifurcation-sections.vtp", bifurcation_outlines(report));
  if (report.mapped) files.emplace_back("mapped-surface.vtp", mapped_surface(report));
  if (report.patched) files.emplace_back("patches.vtp", patches(report));
  return files;
}

}  // namespace ostia::pipeline
