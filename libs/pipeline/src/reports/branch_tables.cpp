// The tables of a branch report.

#include "reports/branch_report_files.h"

#include "ostia/core/csv.h"
#include "ostia/core/text.h"

#include <numbers>

namespace ostia::pipeline {
namespace {

using analysis::BifurcationSection;
using analysis::BifurcationVector;
using analysis::BranchSection;
using core::shortest_text;
using geometry::Vec3;

double degrees_of(double radians) {
  return radians * 180.0 / std::numbers::pi;
}

/// Comma-separated, a line at a time.
class TableText {
 public:
  explicit TableText(const std::string& header) : text_(header + "\n") {}
  TableText& whole(std::int64_t value) { return cell(std::to_string(value)); }
  TableText& number(double value) { return cell(shortest_text(value)); }
  TableText& place(const Vec3& v) { return number(v.x()).number(v.y()).number(v.z()); }
  void end() {
    text_ += '\n';
    fresh_ = true;
  }
  const std::string& text() const { return text_; }

 private:
  TableText& cell(const std::string& value) {
    if (!fresh_) text_ += ',';
    text_ += value;
    fresh_ = false;
    return *this;
  }
  std::string text_;
  bool fresh_ = true;
};

std::string branch_table(const BranchReport& report) {
  TableText table("branch,length_mm,mean_radius_mm,curvature_per_mm,torsion_per_mm,tortuosity");
  for (const analysis::BranchGeometry& b : report.bifurcations->branches)
    table.whole(b.group)
        .number(b.length_mm)
        .number(b.mean_radius_mm)
        .number(b.curvature)
        .number(b.torsion)
        .number(b.tortuosity)
        .end();
  return table.text();
}

std::string system_table(const BranchReport& report) {
  TableText table(
      "bifurcation,x_mm,y_mm,z_mm,normal_x,normal_y,normal_z,up_x,up_y,up_z,angle_between_deg,area_ratio");
  for (const analysis::BifurcationSystem& one : report.bifurcations->systems)
    table.whole(one.group)
        .place(one.origin)
        .place(one.normal)
        .place(one.up_normal)
        .number(degrees_of(analysis::angle_between_branches(*report.bifurcations, one.group)))
        .number(area_ratio(report, one.group))
        .end();
  return table.text();
}

std::string vector_table(const BranchReport& report) {
  TableText table(
      "bifurcation,branch,downstream,x_mm,y_mm,z_mm,vector_x_mm,vector_y_mm,vector_z_mm,in_plane_deg,"
      "out_of_plane_deg");
  for (const BifurcationVector& one : report.bifurcations->vectors)
    table.whole(one.bifurcation)
        .whole(one.group)
        .whole(one.downstream)
        .place(one.point)
        .place(one.vector)
        .number(degrees_of(one.in_plane_rad))
        .number(degrees_of(one.out_of_plane_rad))
        .end();
  return table.text();
}

void add_section(const BranchSection& one, TableText& table) {
  table.whole(one.spheres)
      .place(one.point)
      .place(one.normal)
      .number(one.area_mm2)
      .number(one.perimeter_mm)
      .number(one.min_mm)
      .number(one.max_mm)
      .number(one.shape())
      .whole(one.closed)
      .end();
}

constexpr const char* section_columns =
    "spheres,x_mm,y_mm,z_mm,normal_x,normal_y,normal_z,area_mm2,perimeter_mm,min_mm,max_mm,shape,closed";

std::string patch_table(const BranchReport& report) {
  std::string header = "branch,along,around,area_mm2";
  for (const std::string& name : report.patch_values) header += "," + core::csv_cell("mean " + name);
  TableText table(header);
  for (const analysis::WallPatch& patch : report.patched->patches) {
    table.whole(patch.group).whole(patch.along).whole(patch.around).number(patch.area_mm2);
    for (const double mean : patch.means) table.number(mean);
    table.end();
  }
  return table.text();
}

}  // namespace

double area_ratio(const BranchReport& report, std::int32_t bifurcation) {
  if (!report.sections) return 0.0;
  double before = 0.0, behind = 0.0;
  for (const BifurcationSection& one : report.sections->bifurcations) {
    if (one.bifurcation != bifurcation) continue;
    if (!one.section.closed) return 0.0;
    (one.downstream ? behind : before) += one.section.area_mm2;
  }
  return before > 0.0 ? behind / before : 0.0;
}

std::vector<std::pair<std::string, std::string>> branch_tables(const BranchReport& report) {
  std::vector<std::pair<std::string, std::string>> tables{{"branch-geometry.csv", branch_table(report)}};
  if (!report.bifurcations->systems.empty()) {
    tables.emplace_back("bifurcations.csv", system_table(report));
    tables.emplace_back("bifurcation-vectors.csv", vector_table(report));
  }
  if (report.sections) {
    TableText branches(std::string("branch,") + section_columns);
    for (const BranchSection& one : report.sections->branches) add_section(one, branches.whole(one.group));
    tables.emplace_back("branch-sections.csv", branches.text());
    TableText beside(std::string("bifurcation,branch,downstream,") + section_columns);
    for (const BifurcationSection& one : report.sections->bifurcations)
      add_section(one.section, beside.whole(one.bifurcation).whole(one.section.group).whole(one.downstream));
    tables.emplace_back("bifurcation-sections.csv", beside.text());
  }
  if (report.patched) tables.emplace_back("patches.csv", patch_table(report));
  return tables;
}

}  // namespace ostia::pipeline
