#include "ostia/solver/openfoam_case.h"

#include "case_text.h"
#include "openfoam_plan.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/core/parallel.h"
#include "ostia/core/text.h"
#include "ostia/geometry/element_centres.h"
#include "ostia/geometry/mixed_mesh_sides.h"
#include "ostia/io/mesh_export.h"
#include "ostia/meshing/boundary_layer.h"
#include "ostia/solver/case_record.h"
#include "ostia/solver/openfoam_launch.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostia::solver {
namespace fs = std::filesystem;
namespace {

using geometry::MixedMesh;
using geometry::Vec3;

/// Of pimpleFoam on one core, measured on a tube and a fork of about 10,000 cells
/// (docs/reference/solver-cases.md).
constexpr double seconds_per_cell_and_step = 1e-5;

void require_in(const char* what, double value, double least, double most) {
  if (!(value >= least && value <= most))
    throw InvalidInput(std::string(what) + " must be in [" + core::shortest_text(least) + ", " +
                       core::shortest_text(most) + "], not " + core::shortest_text(value));
}

/// Area vectors of an element's sides, outward.
template <class Element, class Sides>
std::vector<Vec3> side_areas(const MixedMesh& mesh, const Element& element, const Sides& sides) {
  std::vector<Vec3> areas;
  for (const std::array<int, 4>& side : sides) {
    const auto p = [&](std::size_t i) {
      return mesh.points[static_cast<std::size_t>(element[static_cast<std::size_t>(side[i])])];
    };
    areas.emplace_back(side[3] < 0 ? (p(1) - p(0)).cross(p(2) - p(0)) / 2.0
                                   : (p(2) - p(0)).cross(p(3) - p(1)) / 2.0);
  }
  return areas;
}

/// Largest over the elements of projected area over volume, 1/mm: times velocity and time step it is the
/// Courant number. In tetrahedra the largest of the projections along the sides' normals; in prisms the mean
/// over the directions along the wall, since they lie there, and the flow goes along it.
double largest_crossing_rate(const MixedMesh& mesh) {
  double largest = 0.0;
  for (const geometry::Tetrahedron& t : mesh.tetrahedra) {
    const std::vector<Vec3> areas = side_areas(mesh, t, geometry::tetrahedron_sides);
    const auto p = [&](std::size_t i) { return mesh.points[static_cast<std::size_t>(t[i])]; };
    const double volume = (p(1) - p(0)).cross(p(2) - p(0)).dot(p(3) - p(0)) / 6.0;
    for (const Vec3& along : areas) {
      double projected = 0.0;
      for (const Vec3& area : areas) projected += std::abs(area.dot(along)) / (2.0 * along.norm());
      largest = std::max(largest, projected / volume);
    }
  }
  for (const geometry::Prism& prism : mesh.prisms) {
    const std::vector<Vec3> areas = side_areas(mesh, prism, geometry::prism_sides);
    meshing::PrismCorners corners;
    for (std::size_t i = 0; i < corners.size(); ++i)
      corners[i] = mesh.points[static_cast<std::size_t>(prism[i])];
    const double around = areas[2].norm() + areas[3].norm() + areas[4].norm();
    largest = std::max(largest, around / (std::numbers::pi * meshing::prism_volume(corners)));
  }
  return largest;
}

/// In the middle of the fastest end at the largest flow, mm/s.
double largest_velocity(const BoundaryFlow& flow) {
  double most = 0.0, whole = 0.0;
  for (const Inlet& inlet : flow.inlets) {
    most = std::max(most, 2e3 * inlet.largest_flow_ml_s() / inlet.section.area_mm2);
    whole += inlet.largest_flow_ml_s();
  }
  for (const Outlet& outlet : flow.outlets)
    most = std::max(most, 2e3 * outlet.share * whole / outlet.area_mm2);
  return most;
}

struct TimeSteps {
  double first_s = 0.0;
  double count = 0.0;  ///< of all cycles, about
};

/// The Courant number goes with the flow, and so does the length of a step where it is not given.
TimeSteps time_steps(const MixedMesh& mesh, const BoundaryFlow& flow, const CasePlan& plan) {
  const OpenfoamCaseOptions& o = plan.options;
  const double interval = plan.period_s / o.results_per_cycle;
  double most_flow = 0.0;
  for (const Inlet& inlet : flow.inlets) most_flow += inlet.largest_flow_ml_s();
  const double at_most_flow = o.courant / (largest_crossing_rate(mesh) * largest_velocity(flow));
  // A whole number of steps lies between two results.
  const auto step_at = [&](double flow_ml_s) {
    const double wanted = o.time_step_s.value_or(std::min(
        plan.longest_step_s(), at_most_flow * most_flow / std::max(std::abs(flow_ml_s), 1e-9 * most_flow)));
    return interval / std::max(1.0, std::ceil(interval / wanted - 1e-9));
  };
  TimeSteps steps{step_at(most_flow), 0.0};
  constexpr int samples = 200;
  for (int i = 0; i < samples; ++i)
    steps.count += plan.end_time_s() / samples / step_at(flow.flow_ml_s(plan.period_s * i / samples));
  return steps;
}

double period_of(const OpenfoamCaseOptions& o) {
  return o.flow.waveform ? o.flow.waveform->period_s : 0.0;
}

int longest_axis(const MixedMesh& mesh) {
  geometry::Box3 box;
  for (const Vec3& p : mesh.points) box.extend(p);
  Eigen::Index axis = 0;
  box.sizes().maxCoeff(&axis);
  return static_cast<int>(axis);
}

StartFields start_fields(const MixedMesh& mesh, const BoundaryFlow& flow, const StartOf& start_of) {
  StartFields fields;
  const StartFlowAt start = start_of ? start_of(flow) : StartFlowAt();
  if (!start) return fields;
  const std::vector<Vec3> centres = geometry::element_centres(mesh);
  fields.velocity_m_s.resize(centres.size());
  fields.pressure_pa.resize(centres.size());
  constexpr std::size_t at_once = 512;
  core::parallel_for(centres.size(), at_once, [&](std::size_t i) {
    const StartFlow at = start(centres[i]);
    fields.velocity_m_s[i] = at.velocity_m_s;
    fields.pressure_pa[i] = at.pressure_pa;
  });
  return fields;
}

void write_dictionaries(const CasePlan& plan, const fs::path& folder) {
  const fs::path system = folder / "system", constant = folder / "constant";
  write_case_file(system / "controlDict", control_dict(plan));
  write_case_file(system / "fvSchemes", fv_schemes(plan));
  write_case_file(system / "fvSolution", fv_solution(plan));
  write_case_file(system / "decomposeParDict", decompose_dict(plan));
  write_case_file(constant / "transportProperties", transport_properties(plan));
  write_case_file(constant / "turbulenceProperties", turbulence_properties());
  if (coupled_steady(plan)) write_case_file(constant / "outletResistances", outlet_resistances(plan));
  if (coupled_by_cycle(plan)) write_case_file(constant / "outletWindkessels", outlet_windkessels(plan));
  if (plan.pulsatile()) write_outlet_tables(plan, folder);
  const fs::path script = folder / "Allrun";
  write_case_file(script, run_script(plan));
  fs::permissions(script, fs::perms::owner_exec | fs::perms::group_exec | fs::perms::others_exec,
                  fs::perm_options::add);
}

}  // namespace

double openfoam_hours(std::size_t cells, double steps, int processes) {
  return seconds_per_cell_and_step * static_cast<double>(cells) * steps / processes / 3600.0;
}

void validate(const OpenfoamCaseOptions& o) {
  validate(o.flow);
  require_in("processes", o.processes, 1, 4096);
  require_in("iterations", o.iterations, 1, 1e6);
  require_in("tolerance", o.tolerance, 1e-12, 1e-2);
  require_in("cycles", o.cycles, 1, 100);
  require_in("samples_per_cycle", o.samples_per_cycle, 10, 1000);
  require_in("results_per_cycle", o.results_per_cycle, 1, 1000);
  require_in("courant", o.courant, 0.01, 50.0);
  if (o.total_compliance_ml_mmhg) {
    require_in("total_compliance_ml_mmhg", *o.total_compliance_ml_mmhg, 1e-9, 1e3);
    if (o.flow.outlets != OutletModel::resistance || !o.flow.waveform)
      throw InvalidInput(
          "a compliance makes a Windkessel of outlets with resistance in a pulsatile flow: give a waveform "
          "and "
          "outlets with resistance, too");
  }
  if (o.time_step_s) require_in("time_step_s", *o.time_step_s, 1e-9, 1.0);
}

OpenfoamCaseResult write_openfoam_case(const MixedMesh& mesh, const OpenfoamCaseOptions& options,
                                       const fs::path& folder, const core::TaskContext& task) {
  validate(options);
  require_new_folder(folder);
  io::require_holds(io::MeshFormat::openfoam, !mesh.prisms.empty(), mesh.quadratic());
  OpenfoamCaseResult result;
  result.flow = boundary_flow(mesh, options.flow);
  result.warnings = result.flow.warnings;
  CasePlan plan{options, result.flow, period_of(options), 0.0, longest_axis(mesh), {}};
  if (plan.pulsatile()) {
    const TimeSteps steps = time_steps(mesh, result.flow, plan);
    result.time_step_s = plan.time_step_s = steps.first_s;
    result.steps = steps.count;
    result.hours =
        openfoam_hours(mesh.tetrahedra.size() + mesh.prisms.size(), steps.count, options.processes);
  }
  if (!plan.pulsatile()) plan.start = start_fields(mesh, result.flow, options.start);
  task.set_progress(0.1);
  core::StagedFolder staged(folder);
  const io::MeshExportResult written = io::export_mesh(mesh, io::MeshFormat::openfoam, staged.temporary());
  result.warnings.insert(result.warnings.end(), written.warnings.begin(), written.warnings.end());
  if (!openfoam_can_work_in(folder))
    result.warnings.push_back("OpenFOAM cannot work in " + fs::absolute(folder).string() +
                              ": the path has blanks or quotation marks; move the case before it is run");
  task.set_progress(0.5);
  task.throw_if_cancelled();
  write_dictionaries(plan, staged.temporary());
  write_boundaries(plan, staged.temporary(), task.sub(0.5, 0.9));
  write_case_record(case_record("openfoam", options.flow, result.flow, options.cycles,
                                options.total_compliance_ml_mmhg.value_or(0.0)),
                    mesh, staged.temporary());
  staged.commit();
  task.set_progress(1.0);
  return result;
}

}  // namespace ostia::solver
