// Fields at the start with the conditions at the patches (User Guide v1912, 4.2), and the velocities at a
// pulsatile inlet over time.

#include "case_text.h"
#include "openfoam_plan.h"

#include "ostia/core/text.h"
#include "ostia/solver/velocity_profile.h"

#include <algorithm>
#include <cmath>

namespace ostia::solver {
namespace fs = std::filesystem;
namespace {

using core::shortest_text;
using geometry::Vec3;

constexpr double metres = 1e-3;
constexpr double m3_per_ml = 1e-6;

/// An inlet's profile with those of its harmonics.
class InletVelocity {
 public:
  InletVelocity(const Inlet& inlet, double viscosity_mm2_s)
      : inlet_(inlet), steady_(developed_profile(inlet.section)) {
    if (!inlet.harmonics) return;
    for (std::size_t k = 1; k <= inlet.harmonics->amplitude_ml_s.size(); ++k)
      modes_.push_back(oscillating_profile(inlet.section, steady_, inlet.harmonics->angular_frequency(k),
                                           viscosity_mm2_s));
  }

  /// At each facet, m/s.
  std::vector<Vec3> at(double time_s) const {
    std::vector<double> values = steady_.relative;
    for (double& value : values) value *= inlet_.mean_flow_ml_s;
    for (std::size_t k = 0; k < modes_.size(); ++k) {
      const std::complex<double> now = inlet_.harmonics->amplitude_ml_s[k] *
                                       std::polar(1.0, inlet_.harmonics->angular_frequency(k + 1) * time_s);
      for (std::size_t f = 0; f < values.size(); ++f) values[f] += (now * modes_[k][f]).real();
    }
    std::vector<Vec3> velocities = inward_velocities(inlet_.section, values, 1e3);
    for (Vec3& v : velocities) v *= metres;
    return velocities;
  }

 private:
  const Inlet& inlet_;
  DevelopedProfile steady_;
  std::vector<std::vector<std::complex<double>>> modes_;
};

std::string vector_list(const std::vector<Vec3>& vectors) {
  std::string text = std::to_string(vectors.size()) + "\n(\n";
  for (const Vec3& v : vectors) text += foam_vector(v) + "\n";
  return text + ")\n";
}

std::string patch(const std::string& name, const std::string& entries) {
  return "    " + name + "\n    {\n" + entries + "    }\n";
}

std::string field(const std::string& type, const std::string& object, const std::string& dimensions,
                  const std::string& values, const std::string& patches) {
  return foam_head(type, "0", object) + "dimensions      " + dimensions + ";\ninternalField   " + values +
         ";\nboundaryField\n{\n" + patches + "}\n";
}

std::string outlet_velocity(const CasePlan& plan, std::size_t i) {
  const Outlet& outlet = plan.flow.outlets[i];
  if (!flow_is_given(plan, i))
    return "        type            pressureInletOutletVelocity;\n        value           uniform (0 0 0);\n";
  const std::string flow =
      plan.pulsatile()
          ? outlet_table(outlet.name, "flow")
          : "constant " + shortest_text(outlet.share * plan.flow.mean_flow_ml_s * m3_per_ml) + ";\n";
  return "        type            flowRateOutletVelocity;\n        volumetricFlowRate " + flow +
         "        value           uniform (0 0 0);\n";
}

/// Kinematic pressure at the largest outlet over the whole flow, m2/s2 per m3/s.
double outlet_resistance(const CasePlan& plan) {
  const Outlet& largest = plan.flow.outlets[0];
  return largest.resistance_pa_s_m3 * largest.share / plan.density();
}

/// At the start, m2/s2.
double outlet_pressure_now(const CasePlan& plan) {
  return outlet_resistance(plan) * plan.flow.flow_ml_s(0.0) * m3_per_ml;
}

std::string first_velocities(const CasePlan& plan) {
  if (plan.start.velocity_m_s.empty()) return "uniform (0 0 0)";
  return "nonuniform List<vector>\n" + vector_list(plan.start.velocity_m_s);
}

std::string first_pressures(const CasePlan& plan) {
  const double outlet = outlet_pressure_now(plan);
  if (plan.start.pressure_pa.empty()) return "uniform " + shortest_text(outlet);
  std::string text = "nonuniform List<scalar>\n" + std::to_string(plan.start.pressure_pa.size()) + "\n(\n";
  for (const double pa : plan.start.pressure_pa) text += shortest_text(outlet + pa / plan.density()) + "\n";
  return text + ")\n";
}

std::string outlet_pressure(const CasePlan& plan, std::size_t i) {
  if (flow_is_given(plan, i)) return "        type            zeroGradient;\n";
  const std::string now = shortest_text(outlet_pressure_now(plan));
  if (coupled_by_cycle(plan))
    return "        type            uniformTotalPressure;\n        p0              " +
           outlet_table(plan.flow.outlets[i].name, "pressure") + "        value           uniform " + now +
           ";\n";
  return "        type            totalPressure;\n        p0              uniform " + now +
         ";\n        value           uniform " + now + ";\n";
}

std::string inlet_velocity(const CasePlan& plan, const InletVelocity& velocity) {
  const std::string now = "nonuniform List<vector>\n" + vector_list(velocity.at(0.0));
  if (!plan.pulsatile())
    return "        type            fixedValue;\n        value           " + now + "        ;\n";
  return "        type            timeVaryingMappedFixedValue;\n        setAverage      false;\n"
         "        perturb         0;\n        mapMethod       nearest;\n        offset          (0 0 0);\n"
         "        value           " +
         now + "        ;\n";
}

void write_boundary_data(const CasePlan& plan, const Inlet& inlet, const InletVelocity& velocity,
                         const fs::path& folder, const core::TaskContext& task) {
  const fs::path own = folder / "constant" / "boundaryData" / inlet.name;
  std::vector<Vec3> centres = inlet.section.centres;
  for (Vec3& p : centres) p *= metres;
  write_case_file(own / "points", vector_list(centres));
  const int per_cycle = plan.options.samples_per_cycle;
  std::vector<std::string> cycle;
  for (int i = 0; i < per_cycle; ++i)
    cycle.push_back(vector_list(velocity.at(plan.period_s * i / per_cycle)));
  const int samples = plan.options.cycles * per_cycle;
  for (int i = 0; i <= samples; ++i) {
    task.throw_if_cancelled();
    task.set_progress(static_cast<double>(i) / samples);
    write_case_file(own / shortest_text(plan.period_s * i / per_cycle) / "U",
                    cycle[static_cast<std::size_t>(i % per_cycle)]);
  }
}

}  // namespace

void write_boundaries(const CasePlan& plan, const fs::path& folder, const core::TaskContext& task) {
  std::string velocity, pressure;
  const double parts = static_cast<double>(plan.flow.inlets.size());
  for (std::size_t i = 0; i < plan.flow.inlets.size(); ++i) {
    const Inlet& inlet = plan.flow.inlets[i];
    const InletVelocity own(inlet, plan.options.flow.blood.kinematic_viscosity_mm2_s());
    velocity += patch(inlet.name, inlet_velocity(plan, own));
    pressure += patch(inlet.name, "        type            zeroGradient;\n");
    if (plan.pulsatile())
      write_boundary_data(plan, inlet, own, folder,
                          task.sub(static_cast<double>(i) / parts, static_cast<double>(i + 1) / parts));
  }
  for (std::size_t i = 0; i < plan.flow.outlets.size(); ++i) {
    velocity += patch(plan.flow.outlets[i].name, outlet_velocity(plan, i));
    pressure += patch(plan.flow.outlets[i].name, outlet_pressure(plan, i));
  }
  for (const std::string& wall : plan.flow.walls) {
    velocity += patch(wall, "        type            noSlip;\n");
    pressure += patch(wall, "        type            zeroGradient;\n");
  }
  write_case_file(folder / "0" / "U",
                  field("volVectorField", "U", "[0 1 -1 0 0 0 0]", first_velocities(plan), velocity));
  write_case_file(folder / "0" / "p",
                  field("volScalarField", "p", "[0 2 -2 0 0 0 0]", first_pressures(plan), pressure));
}

}  // namespace ostia::solver
