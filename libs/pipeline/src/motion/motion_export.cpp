#include "ostia/pipeline/motion_export.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/io/mesh_export.h"
#include "ostia/io/moving_mesh_file.h"
#include "ostia/io/surface_fields.h"
#include "ostia/io/surface_file.h"
#include "ostia/io/volume_fields.h"
#include "ostia/meshing/mixed_quality.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstdio>
#include <map>
#include <optional>

namespace ostia::pipeline {
namespace fs = std::filesystem;
namespace {

using geometry::MixedMesh;
using geometry::TriMesh;
using geometry::Vec3;
using Points = std::vector<Vec3>;

constexpr std::array<std::pair<MotionFormat, std::string_view>, 6> formats = {
    {{MotionFormat::vtp, "vtp"},
     {MotionFormat::stl, "stl"},
     {MotionFormat::vtu, "vtu"},
     {MotionFormat::openfoam, "openfoam"},
     {MotionFormat::csv, "csv"},
     {MotionFormat::json, "json"}}};

[[noreturn]] void refuse(const std::string& what) {
  throw InvalidInput("cannot export a motion: " + what);
}

bool asked(const MotionExportOptions& options, MotionFormat format) {
  return std::ranges::find(options.formats, format) != options.formats.end();
}

/// Does `work`; what it refuses is told with `name` in front.
template <class Work>
auto named(const std::string& name, const Work& work) {
  try {
    return work();
  } catch (const InvalidInput& error) {
    throw InvalidInput(name + ": " + error.what());
  }
}

template <class... Values>
std::string formatted(const char* format, Values... values) {
  std::array<char, 400> text{};
  const int size = std::snprintf(text.data(), text.size(), format, values...);
  return {text.data(), static_cast<std::size_t>(std::max(size, 0))};
}

/// "surface_007.vtp".
std::string numbered(const std::string& stem, int time, const std::string& extension) {
  return stem + formatted("_%03d", time) + extension;
}

io::FieldValues field(const Points& values, double factor) {
  io::FieldValues out;
  out.components = 3;
  out.values.reserve(3 * values.size());
  for (const Vec3& v : values)
    for (int c = 0; c < 3; ++c) out.values.push_back(factor * v[c]);
  return out;
}

/// Points that go with the cage, at one time.
struct Carried {
  Points places, displacements, rates;  ///< mm, mm, mm a cycle
};

class Travellers {
 public:
  /// `name` is in messages.
  Travellers(const geometry::CageGrid& grid, const Points& rest, const std::string& name)
      : rest_(rest),
        carried_(named(name, [&] { return motion::CarriedPoints(grid, rest); })),
        warning_(named(name, [&] { return motion::judge_outside(carried_, "its points"); })) {
    if (!warning_.empty()) warning_ = name + ": " + warning_;
  }
  const std::string& warning() const { return warning_; }  ///< of points outside of the cage
  std::size_t outside() const { return carried_.outside(); }
  Carried at(const Points& control_points, const Points& control_rates) const {
    Carried out{carried_.places(control_points), {}, carried_.rates(control_rates)};
    out.displacements.reserve(rest_.size());
    for (std::size_t i = 0; i < rest_.size(); ++i) out.displacements.push_back(out.places[i] - rest_[i]);
    return out;
  }

 private:
  const Points& rest_;
  motion::CarriedPoints carried_;
  std::string warning_;
};

void tell(const Carried& now, MotionTime& time) {
  double sum = 0.0;
  for (const Vec3& d : now.displacements) {
    sum += d.norm();
    time.max_displacement_mm = std::max(time.max_displacement_mm, d.norm());
  }
  time.mean_displacement_mm = sum / static_cast<double>(now.displacements.size());
}

/// To a nanometre, and no -0.
Vec3 rounded(const Vec3& v) {
  return (v * 1e6).array().round().matrix() / 1e6 + Vec3::Zero();
}

std::string displacement_table(const Carried& now) {
  std::string text = "point,x_mm,y_mm,z_mm,dx_mm,dy_mm,dz_mm\n";
  for (std::size_t i = 0; i < now.places.size(); ++i) {
    const Vec3 p = rounded(now.places[i]), d = rounded(now.displacements[i]);
    text += formatted("%zu,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g\n", i, p.x(), p.y(), p.z(), d.x(), d.y(), d.z());
  }
  return text;
}

std::string times_table(const std::vector<MotionTime>& times) {
  std::string text =
      "time,percent,seconds,mean_displacement_mm,max_displacement_mm,inverted,min_scaled_jacobian\n";
  for (std::size_t k = 0; k < times.size(); ++k) {
    const MotionTime& t = times[k];
    text += formatted("%zu,%.9g,%.9g,%.6g,%.6g,%zu,%.6g\n", k, 100.0 * t.phase, t.seconds,
                      t.mean_displacement_mm, t.max_displacement_mm, t.inverted, t.min_scaled_jacobian);
  }
  return text;
}

/// One export: what is written time by time.
class Export {
 public:
  Export(fs::path folder, const motion::MovingCage& cage, const TriMesh& surface, const MixedMesh* mesh,
         const MotionExportOptions& options)
      : folder_(std::move(folder)),
        cage_(cage),
        options_(options),
        surface_(surface),
        on_surface_(cage.grid(), surface.points, options.surface_name) {
    if (mesh == nullptr) return;
    mesh_ = *mesh;
    rest_ = mesh->points;
    in_mesh_.emplace(cage.grid(), rest_, options.mesh_name);
  }

  std::size_t outside() const { return (in_mesh_ ? *in_mesh_ : on_surface_).outside(); }
  std::vector<std::string> warnings() const {
    std::vector<std::string> all;
    for (const Travellers* one : {&on_surface_, in_mesh_ ? &*in_mesh_ : nullptr})
      if (one != nullptr && !one->warning().empty()) all.push_back(one->warning());
    return all;
  }

  void begin() {
    if (!asked(options_, MotionFormat::openfoam)) return;
    named(options_.mesh_name, [&] {
      io::export_mesh(*mesh_, io::MeshFormat::openfoam, folder_ / "openfoam",
                      {.layer_tetrahedra = options_.layer_tetrahedra});
    });
    const double step = options_.rr_seconds / options_.times;
    io::write_openfoam_times(folder_ / "openfoam", step, step * (options_.times - 1));
  }

  MotionTime write(int number, const core::TaskContext& task) {
    MotionTime time;
    time.phase = static_cast<double>(number) / options_.times;
    time.seconds = time.phase * options_.rr_seconds;
    const Points places = cage_.at(time.phase), rates = cage_.rate(time.phase);
    const Carried surface = on_surface_.at(places, rates);
    write_surface(number, time.seconds, surface);
    task.set_progress(0.1);
    task.throw_if_cancelled();
    if (in_mesh_) {
      const Carried inside = in_mesh_->at(places, rates);
      write_mesh(number, time, inside, task);
      task.set_progress(0.8);
      task.throw_if_cancelled();
      write_points(number, time, inside);
    } else {
      write_points(number, time, surface);
    }
    return time;
  }

  void end(const std::vector<MotionTime>& times) const {
    core::write_file(folder_ / "times.csv", times_table(times));
    if (asked(options_, MotionFormat::vtp)) io::write_pvd(folder_ / "surface.pvd", surfaces_);
    if (asked(options_, MotionFormat::vtu)) io::write_pvd(folder_ / "mesh.pvd", meshes_);
    if (!asked(options_, MotionFormat::json)) return;
    const nlohmann::ordered_json all{{"v", 1}, {"unit", "mm"}, {"axes", "LPS"}, {"phases", points_}};
    core::write_file(folder_ / "points.json", all.dump() + "\n");
  }

 private:
  std::map<std::string, io::FieldValues> fields(const Carried& now) const {
    return {{"displacement_mm", field(now.displacements, 1.0)},
            {"velocity_mm_s", field(now.rates, 1.0 / options_.rr_seconds)}};
  }

  /// The cell array that export_mesh writes, so that it is read back.
  std::map<std::string, io::FieldValues> layers() const {
    if (options_.layer_tetrahedra == 0) return {};
    io::FieldValues layer;
    layer.values.assign(mesh_->tetrahedra.size() + mesh_->prisms.size(), 0.0);
    const auto end = layer.values.begin() + static_cast<std::ptrdiff_t>(mesh_->tetrahedra.size());
    std::fill(end - static_cast<std::ptrdiff_t>(options_.layer_tetrahedra), end, 1.0);
    return {{"layer", std::move(layer)}};
  }

  void write_surface(int number, double seconds, const Carried& now) {
    const TriMesh moved{now.places, surface_.triangles};
    if (asked(options_, MotionFormat::vtp)) {
      const std::string name = numbered("surface", number, ".vtp");
      io::write_vtp_with_fields(folder_ / name, {moved, {}, {}}, fields(now));
      surfaces_.push_back({seconds, name});
    }
    if (asked(options_, MotionFormat::stl))
      io::write_surface(folder_ / numbered("surface", number, ".stl"), moved);
  }

  void write_mesh(int number, MotionTime& time, const Carried& now, const core::TaskContext& task) {
    mesh_->points = now.places;
    const CarriedQuality quality = carried_quality(*mesh_, task.sub(0.1, 0.4));
    time.inverted = quality.inverted;
    time.min_scaled_jacobian = quality.min_scaled_jacobian;
    task.set_progress(0.4);
    task.throw_if_cancelled();
    if (asked(options_, MotionFormat::vtu)) {
      const std::string name = numbered("mesh", number, ".vtu");
      io::write_vtu_with_fields(folder_ / name, *mesh_, {layers(), fields(now)});
      meshes_.push_back({time.seconds, name});
    }
    mesh_->points = rest_;
    if (asked(options_, MotionFormat::openfoam))
      io::write_openfoam_points(folder_ / "openfoam", time.seconds, *mesh_, now.places);
  }

  void write_points(int number, MotionTime& time, const Carried& now) {
    tell(now, time);
    if (asked(options_, MotionFormat::csv))
      core::write_file(folder_ / numbered("displacement", number, ".csv"), displacement_table(now));
    if (!asked(options_, MotionFormat::json)) return;
    nlohmann::ordered_json points = nlohmann::ordered_json::array();
    for (const Vec3& p : now.places) points.push_back({p.x(), p.y(), p.z()});
    points_.push_back({{"percent", 100.0 * time.phase}, {"points", std::move(points)}});
  }

  fs::path folder_;
  const motion::MovingCage& cage_;
  const MotionExportOptions& options_;
  const TriMesh& surface_;
  Travellers on_surface_;
  std::optional<MixedMesh> mesh_;
  Points rest_;
  std::optional<Travellers> in_mesh_;
  std::vector<io::MeshAtTime> surfaces_, meshes_;
  nlohmann::ordered_json points_ = nlohmann::ordered_json::array();
};

}  // namespace

MotionFormat motion_format(std::string_view name) {
  std::string known;
  for (const auto& [format, own] : formats) {
    if (own == name) return format;
    known += (known.empty() ? "" : ", ") + std::string(own);
  }
  refuse("the format " + std::string(name) + " is not known; it is one of " + known);
}

std::string_view name_of(MotionFormat format) {
  for (const auto& [one, name] : formats)
    if (one == format) return name;
  return {};
}

void validate(const MotionExportOptions& options, const MixedMesh* mesh) {
  if (options.formats.empty()) refuse("no format is named");
  if (options.times < 1 || options.times > 10000)
    refuse("the number of times is " + std::to_string(options.times) + "; it must be 1 to 10000");
  if (!(options.rr_seconds >= 0.1 && options.rr_seconds <= 10.0))
    refuse("the cycle's length must be 0.1 to 10 s");
  for (const MotionFormat format : {MotionFormat::vtu, MotionFormat::openfoam})
    if (asked(options, format) && mesh == nullptr)
      refuse("the format " + std::string(name_of(format)) + " is of a volume mesh; name one with --mesh");
  if (mesh != nullptr && asked(options, MotionFormat::openfoam))
    named(options.mesh_name,
          [&] { io::require_holds(io::MeshFormat::openfoam, !mesh->prisms.empty(), mesh->quadratic()); });
  if (mesh != nullptr && options.layer_tetrahedra > mesh->tetrahedra.size())
    refuse("it has fewer tetrahedra than those of layers");
}

std::size_t MotionExport::inverted() const {
  std::size_t sum = 0;
  for (const MotionTime& time : times) sum += time.inverted;
  return sum;
}

CarriedQuality carried_quality(const MixedMesh& mesh, const core::TaskContext& task) {
  CarriedQuality out;
  for (const double jacobian : meshing::element_scaled_jacobians(mesh, task)) {
    if (!(jacobian > 0.0)) ++out.inverted;
    out.min_scaled_jacobian = std::min(out.min_scaled_jacobian, jacobian);
  }
  return out;
}

MotionExport export_motion(const fs::path& folder, const motion::MovingCage& cage, const TriMesh& surface,
                           const MixedMesh* mesh, const MotionExportOptions& options,
                           const core::TaskContext& task) {
  validate(options, mesh);
  Export writing(folder, cage, surface, mesh, options);
  MotionExport out;
  out.outside = writing.outside();
  out.warnings = writing.warnings();
  writing.begin();
  for (int k = 0; k < options.times; ++k) {
    task.throw_if_cancelled();
    const double share = 1.0 / options.times;
    const core::TaskContext own = task.sub(k * share, std::min((k + 1) * share, 1.0));
    out.times.push_back(writing.write(k, own));
    own.set_progress(1.0);
  }
  writing.end(out.times);
  for (const MotionTime& time : out.times)
    if (time.inverted > 0)
      out.warnings.push_back(formatted("at %.4g s (%.4g %% of the cycle) %zu elements are inverted",
                                       time.seconds, 100.0 * time.phase, time.inverted));
  return out;
}

}  // namespace ostia::pipeline
