#include "ostia/solver/flow_result.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/core/text.h"
#include "ostia/io/mesh_export.h"
#include "ostia/io/volume_mesh_file.h"
#include "ostia/solver/openfoam_result.h"
#include "ostia/solver/section.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

namespace ostia::solver {
namespace fs = std::filesystem;
namespace {

using geometry::FaceKind;
using geometry::MixedMesh;

constexpr double ml = 1e6;              // in a cubic metre
constexpr double same_point_mm = 1e-6;  // of coordinates around 1 m, in double precision
constexpr double no_stress_pa = 1e-6;   // below which a direction means nothing
constexpr double same_time = 1e-6;      // of a period
constexpr const char* velocity = "U";   // m/s
constexpr const char* pressure = "pressureInPascal";
constexpr const char* shear = "wallShearStress";  // kinematic, against the flow

/// Points of each facet, rising, of each face, in the order of its patch: triangles first.
std::map<std::string, std::vector<geometry::Quad>> facets_of(const MixedMesh& mesh) {
  const std::vector<std::string> names = io::safe_face_names(mesh.faces);
  std::map<std::int32_t, std::string> name_of;
  for (std::size_t f = 0; f < names.size(); ++f) name_of[mesh.faces[f].id] = names[f];
  std::map<std::string, std::vector<geometry::Quad>> facets;
  const auto add = [&](const auto& all, const std::vector<std::int32_t>& ids) {
    for (std::size_t i = 0; i < all.size(); ++i) {
      geometry::Quad facet{-1, -1, -1, -1};
      std::ranges::copy(all[i], facet.begin());
      std::ranges::sort(facet);
      facets[name_of[ids[i]]].push_back(facet);
    }
  };
  add(mesh.triangles, mesh.triangle_face_ids);
  add(mesh.quads, mesh.quad_face_ids);
  return facets;
}

/// The number of the first element of other points, if any.
template <class Element>
std::optional<std::size_t> first_other(const std::vector<Element>& a, const std::vector<Element>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    Element one = a[i], other = b[i];
    std::ranges::sort(one);
    std::ranges::sort(other);
    if (one != other) return i;
  }
  return std::nullopt;
}

void require_same_points(const MixedMesh& of_case, const MixedMesh& mesh, const std::string& other) {
  const std::vector<Vec3>& points = of_case.points;
  if (points.size() != mesh.points.size())
    throw InvalidInput(other + "it has " + std::to_string(mesh.points.size()) + " points, the case " +
                       std::to_string(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double away = (points[i] - mesh.points[i]).norm();
    if (!(away <= same_point_mm * (1.0 + mesh.points[i].norm())))
      throw InvalidInput(other + "its point " + std::to_string(i) + " is " + core::shortest_text(away) +
                         " mm away from the case's");
  }
}

/// Values are told by place: elements and facets must be those of the case, in its order.
void require_same_mesh(const fs::path& case_folder, const MixedMesh& mesh, const fs::path& mesh_file) {
  const std::string other = mesh_file.string() + " is not the mesh of " + case_folder.string() + ": ";
  const MixedMesh of_case = io::read_volume_mesh(case_folder);
  require_same_points(of_case, mesh, other);
  if (of_case.tetrahedra.size() != mesh.tetrahedra.size() || of_case.prisms.size() != mesh.prisms.size())
    throw InvalidInput(other + "it has " + std::to_string(mesh.tetrahedra.size()) + " tetrahedra and " +
                       std::to_string(mesh.prisms.size()) + " prisms, the case " +
                       std::to_string(of_case.tetrahedra.size()) + " and " +
                       std::to_string(of_case.prisms.size()));
  const auto refuse = [&](const std::string& what) {
    throw InvalidInput(other + what + " the case's, or in another order");
  };
  if (const auto i = first_other(mesh.tetrahedra, of_case.tetrahedra))
    refuse("its tetrahedron " + std::to_string(*i) + " is not");
  if (const auto i = first_other(mesh.prisms, of_case.prisms))
    refuse("its prism " + std::to_string(*i) + " is not");
  const auto patches = facets_of(of_case);
  for (const auto& [name, facets] : facets_of(mesh)) {
    const auto patch = patches.find(name);
    if (patch == patches.end() || patch->second != facets)
      refuse("the facets of its face " + name + " are not");
  }
}

MixedMesh mesh_of(const fs::path& case_folder, const fs::path& given) {
  const fs::path file = given.empty() ? case_folder / "mesh.vtu" : given;
  std::error_code error;
  if (!fs::exists(file, error))
    throw InvalidInput("there is no " + file.string() +
                       (given.empty() ? "; name the mesh that the case was made of with --mesh" : ""));
  MixedMesh mesh = io::read_volume_mesh(file);
  if (mesh.quadratic()) throw InvalidInput(file.string() + " is of quadratic elements, which no case is");
  require_same_mesh(case_folder, mesh, file);
  return mesh;
}

/// Reads the fields of one time after another.
class Reader {
 public:
  Reader(const FlowResult& result) : result_(result) {
    const MixedMesh& mesh = result.mesh;
    elements_ = mesh.tetrahedra.size() + mesh.prisms.size();
    for (const WallSurface::Part& part : result.wall.parts) facets_[part.name] = part.count;
  }

  FlowState read(const fs::path& time) const {
    FlowState state;
    state.velocity_m_s = field(time, velocity, 3).cells;
    const OpenfoamField p = field(time, pressure, 1), tau = field(time, shear, 3);
    state.pressure_pa = p.cells;
    state.wall_pressure_pa = on_wall(p, time / pressure);
    state.wall_shear_pa = on_wall(tau, time / shear);
    // Of OpenFOAM's it is the force on the fluid.
    for (double& value : state.wall_shear_pa) value *= -result_.record.density_kg_m3;
    return state;
  }

 private:
  OpenfoamField field(const fs::path& time, const char* name, std::size_t components) const {
    std::error_code error;
    if (!fs::exists(time / name, error))
      throw InvalidInput(time.string() + " holds no " + name +
                         ": the case's solver and its functions (system/controlDict) write it; run ./Allrun "
                         "as `ostia case` has written it");
    OpenfoamField read = read_openfoam_field(time / name, elements_, facets_);
    if (read.components != components)
      throw InvalidInput((time / name).string() + " has " + std::to_string(read.components) +
                         " components, not " + std::to_string(components));
    return read;
  }
  std::vector<double> on_wall(const OpenfoamField& read, const fs::path& file) const {
    std::vector<double> values;
    for (const WallSurface::Part& part : result_.wall.parts) {
      const auto patch = read.patches.find(part.name);
      if (patch == read.patches.end())
        throw InvalidInput(file.string() + " has no values at the wall " + part.name);
      values.insert(values.end(), patch->second.begin(), patch->second.end());
    }
    return values;
  }
  const FlowResult& result_;
  std::size_t elements_ = 0;
  std::map<std::string, std::size_t> facets_;
};

void add_scaled(const std::vector<double>& values, double weight, std::vector<double>& sums) {
  sums.resize(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) sums[i] += weight * values[i];
}

/// The times of the last cycle, of which the mean is taken.
std::vector<OpenfoamTime> last_cycle(const fs::path& case_folder, const std::vector<OpenfoamTime>& times,
                                     double period) {
  const double last = times.back().time, slack = same_time * period;
  if (last < period - slack)
    throw InvalidInput(case_folder.string() + " has come to " + core::shortest_text(last) +
                       " s of a cycle of " + core::shortest_text(period) +
                       " s: let it run through one at least");
  std::vector<OpenfoamTime> of_cycle;
  for (const OpenfoamTime& time : times)
    if (time.time > last - period + slack) of_cycle.push_back(time);
  if (of_cycle.size() < 4)
    throw InvalidInput(case_folder.string() + " holds " + std::to_string(of_cycle.size()) +
                       " times of its last cycle; four at least make a mean");
  return of_cycle;
}

void read_cycle(const std::vector<OpenfoamTime>& times, const Reader& reader, FlowResult& result,
                const core::TaskContext& task) {
  std::vector<double> at;
  for (const OpenfoamTime& time : times) at.push_back(time.time);
  const std::vector<double> weights = periodic_weights(at, result.record.period_s);
  FlowState mean;
  for (std::size_t i = 0; i < times.size(); ++i) {
    task.throw_if_cancelled();
    result.last = reader.read(times[i].folder);
    add_scaled(result.last.velocity_m_s, weights[i], mean.velocity_m_s);
    add_scaled(result.last.pressure_pa, weights[i], mean.pressure_pa);
    add_scaled(result.last.wall_shear_pa, weights[i], mean.wall_shear_pa);
    add_scaled(result.last.wall_pressure_pa, weights[i], mean.wall_pressure_pa);
    add_scaled(magnitudes(result.last.wall_shear_pa), weights[i], result.mean_shear_pa);
    task.set_progress(static_cast<double>(i + 1) / static_cast<double>(times.size()));
  }
  result.mean = std::move(mean);
  result.times = times.size();
}

std::vector<EndFlow> ends_of(const fs::path& case_folder, const FlowResult& result) {
  std::vector<EndFlow> ends;
  const std::vector<std::string> names = io::safe_face_names(result.mesh.faces);
  const auto value = [&](const std::string& function) {
    const OpenfoamSeries series = read_openfoam_series(case_folder, function);
    if (result.record.pulsatile()) return cycle_mean(series, result.run.last, result.record.period_s);
    return series.rbegin()->second;
  };
  for (const FaceKind kind : {FaceKind::inlet, FaceKind::outlet}) {
    for (std::size_t f = 0; f < result.mesh.faces.size(); ++f) {
      if (result.mesh.faces[f].kind != kind) continue;
      EndFlow end{names[f], kind, section_of(result.mesh, result.mesh.faces[f].id).area_mm2, 0.0, 0.0};
      end.flow_ml_s = ml * value("flow_" + names[f]) * (kind == FaceKind::inlet ? -1.0 : 1.0);
      end.pressure_pa = result.record.density_kg_m3 * value("pressure_" + names[f]);
      ends.push_back(end);
    }
  }
  return ends;
}

std::vector<std::string> inlets_of(const MixedMesh& mesh) {
  std::vector<std::string> inlets;
  const std::vector<std::string> names = io::safe_face_names(mesh.faces);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    if (mesh.faces[f].kind == FaceKind::inlet) inlets.push_back(names[f]);
  return inlets;
}

}  // namespace

double FlowResult::mass_balance_error() const {
  double in = 0.0, out = 0.0;
  for (const EndFlow& end : ends) (end.kind == FaceKind::inlet ? in : out) += end.flow_ml_s;
  return std::abs(in - out) / std::max(std::abs(in), std::numeric_limits<double>::min());
}

std::vector<double> magnitudes(const std::vector<double>& vectors) {
  std::vector<double> lengths(vectors.size() / 3);
  for (std::size_t i = 0; i < lengths.size(); ++i) lengths[i] = Vec3(vectors.data() + 3 * i).norm();
  return lengths;
}

std::vector<double> velocity_at_points(const FlowResult& result, const FlowState& state) {
  std::vector<double> velocities = at_mesh_points(result.mesh, state.velocity_m_s, 3);
  for (const std::int32_t point : result.wall.mesh_points)
    for (std::size_t c = 0; c < 3; ++c) velocities[3 * static_cast<std::size_t>(point) + c] = 0.0;
  return velocities;
}

std::vector<double> periodic_weights(const std::vector<double>& times, double period) {
  const std::size_t n = times.size();
  std::vector<double> weights(n, 1.0);
  for (std::size_t i = 0; n > 1 && i < n; ++i) {
    const double before = i > 0 ? times[i - 1] : times[n - 1] - period;
    const double after = i + 1 < n ? times[i + 1] : times[0] + period;
    weights[i] = (after - before) / (2.0 * period);
  }
  return weights;
}

std::vector<double> oscillatory_shear_index(const std::vector<double>& mean_vectors,
                                            const std::vector<double>& mean_magnitudes) {
  std::vector<double> indices = magnitudes(mean_vectors);
  for (std::size_t i = 0; i < indices.size(); ++i)
    indices[i] =
        mean_magnitudes[i] > 0.0 ? std::clamp(0.5 * (1.0 - indices[i] / mean_magnitudes[i]), 0.0, 0.5) : 0.0;
  return indices;
}

std::vector<double> relative_residence_time(const std::vector<double>& mean_magnitudes,
                                            const std::vector<double>& indices) {
  std::vector<double> times(indices.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double mean = (1.0 - 2.0 * indices[i]) * mean_magnitudes[i];
    if (mean >= no_stress_pa) times[i] = 1.0 / mean;
  }
  return times;
}

fs::path result_time(const fs::path& case_folder) {
  const std::vector<OpenfoamTime> times = times_of(case_folder);
  std::error_code error;
  if (fs::is_directory(case_folder / "processor0", error)) {
    const std::vector<OpenfoamTime> parts = times_of(case_folder / "processor0");
    if (!parts.empty() && (times.empty() || times.back().time < parts.back().time))
      throw InvalidInput(case_folder.string() + " holds the results of several processes in parts: run " +
                         "reconstructPar there first");
  }
  return last_time(case_folder);
}

FlowResult read_flow_result(const fs::path& case_folder, const fs::path& mesh_file,
                            const core::TaskContext& task) {
  FlowResult result;
  result.record = read_case_record(case_folder);
  if (result.record.solver != "openfoam")
    throw InvalidInput(case_folder.string() + " is a case of " + result.record.solver +
                       ", whose results are not read; look at them with ParaView");
  const fs::path last = result_time(case_folder);
  result.mesh = mesh_of(case_folder, mesh_file);
  result.wall = wall_surface(result.mesh);
  task.set_progress(0.2);
  task.throw_if_cancelled();
  result.run = read_openfoam_outcome(case_folder, result.record, inlets_of(result.mesh));
  const Reader reader(result);
  if (result.record.pulsatile())
    read_cycle(last_cycle(case_folder, times_of(case_folder), result.record.period_s), reader, result,
               task.sub(0.2, 0.95));
  else
    result.last = reader.read(last);
  result.ends = ends_of(case_folder, result);
  task.set_progress(1.0);
  return result;
}

}  // namespace ostia::solver
