#include "ostia/solver/boundary_conditions.h"

#include "pressure_units.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"
#include "ostia/geometry/faces.h"
#include "ostia/io/mesh_export.h"
#include "ostia/meshing/boundary_layer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace ostia::solver {
namespace {

using core::significant_text;
using geometry::FaceKind;
using geometry::MixedMesh;
using geometry::Vec3;

constexpr double turbulent_above = 2000.0;
constexpr double smallest_inlet_mm = 0.1, largest_inlet_mm = 100.0;
constexpr double usual_pressure_mmhg = 90.0;

void require_range(const char* what, double value, double least, double most) {
  if (!(value >= least && value <= most))
    throw InvalidInput(std::string(what) + " must be in [" + significant_text(least, 4) + ", " +
                       significant_text(most, 4) + "], not " + significant_text(value, 4));
}

void require_positive(const std::string& what, const std::optional<double>& value) {
  if (value && !(*value > 0.0 && std::isfinite(*value)))
    throw InvalidInput(what + " must be positive, not " + significant_text(*value, 4));
}

/// Throws where an element is inside out: a solver ends there, or does not converge.
void require_positive_volumes(const MixedMesh& mesh) {
  const auto at = [&](std::int32_t p) { return mesh.points[static_cast<std::size_t>(p)]; };
  const auto refuse = [](const char* kind, std::size_t i, const Vec3& place) {
    throw GeometryError(std::string(kind) + " " + std::to_string(i) + " at (" +
                        significant_text(place[0], 4) + ", " + significant_text(place[1], 4) + ", " +
                        significant_text(place[2], 4) +
                        ") mm has no positive volume; mesh again with other sizes");
  };
  for (std::size_t i = 0; i < mesh.tetrahedra.size(); ++i) {
    const auto& t = mesh.tetrahedra[i];
    const Vec3 p = at(t[0]);
    if (!((at(t[1]) - p).cross(at(t[2]) - p).dot(at(t[3]) - p) > 0.0)) refuse("tetrahedron", i, p);
  }
  for (std::size_t i = 0; i < mesh.prisms.size(); ++i) {
    meshing::PrismCorners corners;
    for (std::size_t c = 0; c < corners.size(); ++c) corners[c] = at(mesh.prisms[i][c]);
    if (!(meshing::prism_volume(corners) > 0.0)) refuse("prism", i, corners[0]);
  }
}

void require_faces(const MixedMesh& mesh, const std::vector<std::string>& names) {
  for (const FaceKind kind : {FaceKind::inlet, FaceKind::outlet, FaceKind::wall}) {
    if (std::ranges::find(mesh.faces, kind, &geometry::Face::kind) != mesh.faces.end()) continue;
    std::string there;
    for (const std::string& name : names) there += (there.empty() ? "" : ", ") + name;
    const std::string word(name_of(kind));
    throw InvalidInput("the mesh has no " + word + ", only the faces " + (there.empty() ? "(none)" : there) +
                       "; name a face " + word + (kind == FaceKind::wall ? "" : "_...") + " when meshing");
  }
}

void require_size(const std::string& name, double diameter_mm) {
  if (diameter_mm < smallest_inlet_mm)
    throw InvalidInput("the inlet " + name + " is " + significant_text(diameter_mm, 4) +
                       " mm wide: the mesh seems to be in metres; scale it to millimetres");
  if (diameter_mm > largest_inlet_mm)
    throw InvalidInput("the inlet " + name + " is " + significant_text(diameter_mm, 4) +
                       " mm wide: no vessel is; scale the mesh to millimetres");
}

double mean_flow_of(const Inlet& inlet, const std::string& own_name, const BoundaryFlowOptions& o) {
  const auto named = o.inlet_flow_ml_s.find(own_name);
  if (named != o.inlet_flow_ml_s.end()) return named->second;
  const double area = inlet.section.area_mm2, diameter = inlet.section.diameter_mm();
  if (o.flow_ml_s) return *o.flow_ml_s;
  if (o.mean_velocity_cm_s) return *o.mean_velocity_cm_s * 10.0 * area * 1e-3;
  if (o.reynolds) return *o.reynolds * o.blood.kinematic_viscosity_mm2_s() / diameter * area * 1e-3;
  if (o.waveform && !o.waveform->relative) return mean_flow(*o.waveform);
  return usual_flow_ml_s(diameter);
}

Inlet inlet_of(const MixedMesh& mesh, const geometry::Face& face, const std::string& name,
               const BoundaryFlowOptions& o, std::vector<std::string>& warnings) {
  Inlet inlet{name, section_of(mesh, face.id), 0.0, 0.0, {}};
  const double diameter = inlet.section.diameter_mm();
  require_size(name, diameter);
  inlet.mean_flow_ml_s = mean_flow_of(inlet, face.name, o);
  if (o.waveform) {
    FlowHarmonics harmonics = harmonics_of(*o.waveform, o.harmonics);
    const double scale = inlet.mean_flow_ml_s / harmonics.mean_ml_s;
    harmonics.mean_ml_s = inlet.mean_flow_ml_s;
    for (auto& amplitude : harmonics.amplitude_ml_s) amplitude *= scale;
    inlet.harmonics = std::move(harmonics);
  }
  const double velocity_mm_s = 1e3 * inlet.largest_flow_ml_s() / inlet.section.area_mm2;
  inlet.reynolds = velocity_mm_s * diameter / o.blood.kinematic_viscosity_mm2_s();
  if (inlet.reynolds > turbulent_above)
    warnings.push_back("the Reynolds number at " + name + " is " +
                       significant_text(std::round(inlet.reynolds), 4) +
                       ": above about 2000 the flow is no longer laminar, as the case assumes");
  return inlet;
}

void share_flow(BoundaryFlow& flow, const BoundaryFlowOptions& o) {
  std::ranges::stable_sort(flow.outlets, std::greater<>(), &Outlet::diameter_mm);
  double sum = 0.0;
  for (Outlet& outlet : flow.outlets) sum += outlet.share = std::pow(outlet.diameter_mm, o.split_exponent);
  for (Outlet& outlet : flow.outlets) outlet.share /= sum;
  if (o.outlets != OutletModel::resistance) return;
  const double total =
      o.total_resistance_mmhg_s_ml.value_or(usual_pressure_mmhg / flow.mean_flow_ml_s) * pa_per_mmhg * 1e6;
  for (Outlet& outlet : flow.outlets) outlet.resistance_pa_s_m3 = total / outlet.share;
}

}  // namespace

std::string_view name_of(Rheology rheology) {
  return rheology == Rheology::carreau ? "carreau" : "newton";
}

std::span<const OutletTraits> outlet_models() {
  static constexpr std::array<OutletTraits, 3> all{
      {{OutletModel::zero_pressure, "zero", "the same pressure at each"},
       {OutletModel::split, "split", "a share of the flow each"},
       {OutletModel::resistance, "resistance", "pressure is resistance times flow"}}};
  return all;
}

std::string_view name_of(OutletModel outlets) {
  const auto found = std::ranges::find(outlet_models(), outlets, &OutletTraits::model);
  if (found == outlet_models().end()) throw std::logic_error("outlets that are in no table");
  return found->name;
}

OutletModel outlet_model(std::string_view name) {
  std::string there;
  for (const OutletTraits& one : outlet_models()) {
    if (one.name == name) return one.model;
    there += (there.empty() ? "" : ", ") + std::string(one.name);
  }
  throw InvalidInput("outlets \"" + std::string(name) + "\": there are " + there);
}

double usual_flow_ml_s(double diameter_mm) {
  return 1e6 * 1.43 * std::pow(1e-3 * diameter_mm, 2.55);
}

void validate(const BoundaryFlowOptions& o) {
  require_range("density_kg_m3", o.blood.density_kg_m3, 500.0, 2000.0);
  require_range("viscosity_mpa_s", o.blood.viscosity_mpa_s, 0.1, 100.0);
  require_range("split_exponent", o.split_exponent, 1.0, 4.0);
  require_range("harmonics", o.harmonics, 1, 60);
  require_positive("flow_ml_s", o.flow_ml_s);
  require_positive("mean_velocity_cm_s", o.mean_velocity_cm_s);
  require_positive("reynolds", o.reynolds);
  require_positive("total_resistance_mmhg_s_ml", o.total_resistance_mmhg_s_ml);
  for (const auto& [name, flow] : o.inlet_flow_ml_s) require_positive("the flow of " + name, flow);
  const int told =
      int(o.flow_ml_s.has_value()) + int(o.mean_velocity_cm_s.has_value()) + int(o.reynolds.has_value());
  if (told > 1) throw InvalidInput("give one of flow, mean velocity and Reynolds number, not several");
  if (o.total_resistance_mmhg_s_ml && o.outlets != OutletModel::resistance)
    throw InvalidInput("a total resistance needs outlets with resistance");
  if (o.waveform) validate(*o.waveform);
}

double BoundaryFlow::flow_ml_s(double time_s) const {
  double sum = 0.0;
  for (const Inlet& inlet : inlets) sum += inlet.flow_ml_s(time_s);
  return sum;
}

std::complex<double> Windkessel::impedance(double angular_frequency) const {
  return proximal_pa_s_m3 +
         distal_pa_s_m3 / std::complex<double>(1.0, angular_frequency * distal_pa_s_m3 * compliance_m3_pa);
}

Windkessel windkessel_of(const Outlet& outlet, double total_compliance_ml_mmhg) {
  const double r = outlet.resistance_pa_s_m3;
  return {Windkessel::proximal_share * r, (1.0 - Windkessel::proximal_share) * r,
          1e-6 * total_compliance_ml_mmhg * outlet.share / pa_per_mmhg};
}

BoundaryFlow boundary_flow(const MixedMesh& mesh, const BoundaryFlowOptions& o) {
  validate(o);
  const std::vector<std::string> names = io::safe_face_names(mesh.faces);
  require_faces(mesh, names);
  for (const auto& [name, value] : o.inlet_flow_ml_s) {
    const auto face = std::ranges::find(mesh.faces, name, &geometry::Face::name);
    if (face == mesh.faces.end() || face->kind != FaceKind::inlet)
      throw InvalidInput("there is no inlet \"" + name + "\" to give a flow of " +
                         significant_text(value, 4) + " ml/s");
  }
  require_positive_volumes(mesh);
  BoundaryFlow flow;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const geometry::Face& face = mesh.faces[f];
    if (is_wall(face)) {
      flow.walls.push_back(names[f]);
    } else if (face.kind == FaceKind::inlet) {
      flow.inlets.push_back(inlet_of(mesh, face, names[f], o, flow.warnings));
      flow.mean_flow_ml_s += flow.inlets.back().mean_flow_ml_s;
    } else {
      const Section section = section_of(mesh, face.id);
      flow.outlets.push_back({names[f], section.area_mm2, section.diameter_mm(), 0.0, 0.0});
    }
  }
  share_flow(flow, o);
  return flow;
}

}  // namespace ostia::solver
