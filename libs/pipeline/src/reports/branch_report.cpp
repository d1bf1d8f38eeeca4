#include "ostia/pipeline/branch_report.h"

#include "reports/branch_report_files.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/geometry/mesh_topology.h"

#include <nlohmann/json.hpp>

#include <numbers>

namespace ostia::pipeline {
namespace {

using analysis::BranchSection;
using geometry::Vec3;
using nlohmann::json;

constexpr double in_degrees = 180.0 / std::numbers::pi;

std::vector<double> component(const std::vector<double>& values, std::size_t components, std::size_t which) {
  std::vector<double> out;
  for (std::size_t i = which; i < values.size(); i += components) out.push_back(values[i]);
  return out;
}

/// The wall's arrays and the distance from the axis at the points of each branch, as patches take them.
std::vector<std::vector<std::vector<double>>> patch_values(BranchReport& report) {
  std::vector<std::vector<std::vector<double>>> all;
  for (const analysis::MappedBranch& branch : report.mapped->branches) {
    std::vector<std::vector<double>> values{branch.distance_mm};
    report.patch_values = {"DistanceToCenterlines"};
    for (const auto& [name, field] : report.fields) {
      const auto count = static_cast<std::size_t>(field.components);
      const std::vector<double> here = analysis::mapped_values(branch, field.values, count);
      for (std::size_t c = 0; c < count; ++c) {
        values.push_back(component(here, count, c));
        report.patch_values.push_back(count == 1 ? name : name + ":" + std::to_string(c));
      }
    }
    all.push_back(std::move(values));
  }
  return all;
}

void check_fields(const BranchWall& wall) {
  for (const auto& [name, field] : wall.fields)
    if (field.values.size() != wall.mesh.points.size() * static_cast<std::size_t>(field.components))
      throw InvalidInput("the wall's array " + name + " has " + std::to_string(field.values.size()) +
                         " numbers for " + std::to_string(wall.mesh.points.size()) + " points");
}

json place_json(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

json vectors_json(const analysis::BifurcationMeasures& measures, std::int32_t bifurcation) {
  json all = json::array();
  for (const analysis::BifurcationVector& one : measures.vectors) {
    if (one.bifurcation != bifurcation) continue;
    all.push_back({{"branch", one.group},
                   {"downstream", one.downstream},
                   {"point_mm", place_json(one.point)},
                   {"vector_mm", place_json(one.vector)},
                   {"in_plane_deg", in_degrees * one.in_plane_rad},
                   {"out_of_plane_deg", in_degrees * one.out_of_plane_rad}});
  }
  return all;
}

json section_json(const BranchSection& one) {
  return {{"area_mm2", one.area_mm2},
          {"min_mm", one.min_mm},
          {"max_mm", one.max_mm},
          {"shape", one.shape()},
          {"closed", one.closed}};
}

json bifurcation_sections_json(const BranchReport& report, std::int32_t bifurcation) {
  json all = json::array();
  for (const analysis::BifurcationSection& one : report.sections->bifurcations) {
    if (one.bifurcation != bifurcation) continue;
    json section = section_json(one.section);
    section["branch"] = one.section.group;
    section["downstream"] = one.downstream;
    section["spheres"] = one.section.spheres;
    all.push_back(section);
  }
  return all;
}

json bifurcations_json(const BranchReport& report) {
  json all = json::array();
  for (const analysis::BifurcationSystem& system : report.bifurcations->systems) {
    json one{{"group", system.group},
             {"origin_mm", place_json(system.origin)},
             {"normal", place_json(system.normal)},
             {"up_normal", place_json(system.up_normal)},
             {"angle_between_deg",
              in_degrees * analysis::angle_between_branches(*report.bifurcations, system.group)},
             {"vectors", vectors_json(*report.bifurcations, system.group)}};
    if (report.sections) {
      one["sections"] = bifurcation_sections_json(report, system.group);
      const double ratio = area_ratio(report, system.group);
      one["area_ratio"] = ratio > 0.0 ? json(ratio) : json(nullptr);
    }
    all.push_back(one);
  }
  return all;
}

json branches_json(const BranchReport& report) {
  json all = json::array();
  for (const analysis::BranchGeometry& branch : report.bifurcations->branches) {
    json one{{"group", branch.group},
             {"length_mm", branch.length_mm},
             {"mean_radius_mm", branch.mean_radius_mm},
             {"curvature_per_mm", branch.curvature},
             {"torsion_per_mm", branch.torsion},
             {"tortuosity", branch.tortuosity}};
    if (report.sections) {
      std::int64_t sections = 0, closed = 0;
      for (const BranchSection& section : report.sections->branches) {
        if (section.group != branch.group) continue;
        ++sections;
        closed += section.closed ? 1 : 0;
      }
      one["sections"] = sections;
      one["closed_sections"] = closed;
    }
    all.push_back(one);
  }
  return all;
}

}  // namespace

BranchReport measured_branches(geometry::BranchedLines lines, const std::optional<BranchWall>& wall,
                               const BranchReportOptions& options, const core::TaskContext& task) {
  if ((options.sections || options.patches) && !wall)
    throw InvalidInput("sections and patches are of a lumen's surface, and there are lines alone");
  BranchReport report;
  report.lines = std::move(lines);
  const auto warn = [&](const std::vector<std::string>& more) {
    report.warnings.insert(report.warnings.end(), more.begin(), more.end());
  };
  task.set_stage("bifurcations");
  report.bifurcations = analysis::measure_bifurcations(report.lines);
  if (options.bifurcations) warn(report.bifurcations->warnings);
  if (options.sections) {
    task.set_stage("sections");
    report.sections =
        analysis::branch_sections(wall->mesh, report.lines, options.section, task.sub(0.05, 0.5));
    warn(report.sections->warnings);
  }
  if (options.patches) {
    task.set_stage("mapping");
    check_fields(*wall);
    report.fields = wall->fields;
    report.mapped = analysis::map_branches(wall->mesh, report.lines, task.sub(0.5, 0.9));
    warn(report.mapped->warnings);
    task.set_stage("patches");
    const auto values = patch_values(report);
    report.patched = analysis::patch_branches(*report.mapped, values, *options.patches, task.sub(0.9, 1.0));
  }
  if (!options.bifurcations) report.bifurcations->vectors.clear();
  if (!options.bifurcations) report.bifurcations->systems.clear();
  return report;
}

std::string branch_measures_json(const BranchReport& report) {
  json all{{"v", 1},
           {"kind", "branch-measures"},
           {"vessels", report.lines.lines.size()},
           {"branches", branches_json(report)},
           {"bifurcations", bifurcations_json(report)},
           {"warnings", report.warnings}};
  if (report.patched) {
    double area = 0.0;
    for (const analysis::WallPatch& patch : report.patched->patches) area += patch.area_mm2;
    all["patches"] = {
        {"count", report.patched->patches.size()}, {"area_mm2", area}, {"arrays", report.patch_values}};
  }
  return all.dump(1) + "\n";
}

void write_branch_report(const std::filesystem::path& folder, const BranchReport& report) {
  core::write_file(folder / "branches.json", branch_measures_json(report));
  for (const auto& [name, text] : branch_tables(report)) core::write_file(folder / name, text);
  for (const auto& [name, data] : branch_polydata(report)) io::write_polydata(folder / name, data);
}

}  // namespace ostia::pipeline
