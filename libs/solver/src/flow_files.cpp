#include "ostia/solver/flow_files.h"

#include "ostia/core/files.h"
#include "ostia/solver/flow_figures.h"

namespace ostia::solver {
namespace {

void add_state(const FlowResult& result, const FlowState& state, const std::string& prefix,
               io::VolumeFields& fields) {
  const std::string velocity = prefix + "velocity_m_s", pressure = prefix + "pressure_Pa";
  fields.cells[velocity] = {3, state.velocity_m_s};
  fields.cells[pressure] = {1, state.pressure_pa};
  fields.points[velocity] = {3, velocity_at_points(result, state)};
  fields.points[pressure] = {1, at_mesh_points(result.mesh, state.pressure_pa, 1)};
}

}  // namespace

io::VolumeFields volume_fields(const FlowResult& result) {
  io::VolumeFields fields;
  add_state(result, result.last, "", fields);
  if (result.mean) add_state(result, *result.mean, "mean_", fields);
  return fields;
}

io::PointFields wall_fields(const FlowResult& result) {
  const FlowState& last = result.last;
  io::PointFields fields;
  const auto add = [&](const char* name, const std::vector<double>& facets, int components) {
    fields[name] = {components, at_wall_points(result.wall, facets, static_cast<std::size_t>(components))};
  };
  add("wall_shear_stress_Pa", magnitudes(last.wall_shear_pa), 1);
  add("wall_shear_stress_vector_Pa", last.wall_shear_pa, 3);
  add("pressure_Pa", last.wall_pressure_pa, 1);
  if (!result.mean) return fields;
  const std::vector<double> indices =
      oscillatory_shear_index(result.mean->wall_shear_pa, result.mean_shear_pa);
  add("time_averaged_wall_shear_stress_Pa", result.mean_shear_pa, 1);
  add("oscillatory_shear_index", indices, 1);
  fields["relative_residence_time_1_Pa"] = {
      1, relative_residence_time(fields["time_averaged_wall_shear_stress_Pa"].values,
                                 fields["oscillatory_shear_index"].values)};
  return fields;
}

void write_flow_files(const FlowResult& result, const FlowReport& report, const std::filesystem::path& folder,
                      const core::TaskContext& task) {
  io::write_vtu_with_fields(folder / "result.vtu", result.mesh, volume_fields(result));
  io::write_vtp_with_fields(folder / "wall.vtp", result.wall.surface, wall_fields(result));
  core::write_file(folder / "faces.csv", faces_csv(result, report));
  core::write_file(folder / "result.json", report_json(result, report));
  task.set_progress(0.3);
  task.throw_if_cancelled();
  wall_shear_picture(result, task.sub(0.3, 0.8)).write_png(folder / "wall_shear_stress.png");
  speed_picture(result, task.sub(0.8, 1.0)).write_png(folder / "speed.png");
  task.set_progress(1.0);
}

}  // namespace ostia::solver
