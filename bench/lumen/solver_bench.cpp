// One edit of a wall solved up to date, the fresh solution beside it, and kernels compared on walls known
// exactly.

#include "interpolation/constraints.h"
#include "tube_samples.h"

#include "ostia/lumen/incremental_surface.h"

#include <Eigen/Dense>
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <optional>
#include <random>
#include <string>

namespace {

using namespace ostia::lumen;
namespace geometry = ostia::geometry;
namespace testing = ostia::lumen::testing;
using geometry::AxisCurve;
using testing::Radius;

double cpu_ms() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

double tapering(double s, double) {
  return 1.9 - 0.009 * s;
}

/// A vessel of 100 mm with about so many samples.
VesselLumen vessel_of(double spacing_mm) {
  return testing::tube_vessel(testing::bent_axis(100.0), tapering, spacing_mm);
}

struct Edit {
  std::vector<std::int64_t> removed;
  std::vector<SurfaceSample> added;
};
/// Twelve samples about a random place of the wall, pushed in or out by up to 0.15 mm.
Edit random_edit(const std::vector<SurfaceSample>& samples, const AxisCurve& axis, std::mt19937& random,
                 std::int64_t& id) {
  const auto unit = [&] { return static_cast<double>(random()) / 4294967296.0; };
  const double s = unit() * axis.length();
  const Vec3 at = axis.place(s, 6.2832 * unit(), tapering(s, 0.0));
  const double by = 0.3 * unit() - 0.15;
  std::vector<std::pair<double, std::size_t>> near;
  for (std::size_t i = 0; i < samples.size(); ++i) near.emplace_back((samples[i].position - at).norm(), i);
  std::partial_sort(near.begin(), near.begin() + 12, near.end());
  Edit edit;
  for (std::size_t i = 0; i < 12; ++i) {
    SurfaceSample sample = samples[near[i].second];
    edit.removed.push_back(sample.id);
    sample.id = id++;
    sample.position += by * sample.normal;
    sample.origin = SampleOrigin::edit;
    edit.added.push_back(sample);
  }
  return edit;
}

/// Counters: p50 and p95 of the CPU time of edits, ms; greatest residual and difference to the fresh
/// solution, mm; mean length along the vessel that is told as changed, mm.
void one_edit(benchmark::State& state, double spacing_mm, Kernel kernel, FarField far_field) {
  VesselLumen vessel = vessel_of(spacing_mm);
  vessel.interpolation.kernel = kernel;
  vessel.interpolation.far_field = far_field;
  IncrementalSurface live(vessel);
  std::mt19937 random(7);
  std::int64_t id = 1'000'000;
  std::vector<double> times;
  double residual = 0.0, told = 0.0;
  for (auto _ : state) {
    state.PauseTiming();
    const Edit edit = random_edit(live.samples(), *vessel.axis, random, id);
    state.ResumeTiming();
    const double start = cpu_ms();
    const IncrementalReport report = live.change(edit.removed, edit.added);
    times.push_back(cpu_ms() - start);
    residual = std::max(residual, report.residual);
    told += report.changed_to_mm - report.changed_from_mm;
  }
  vessel.samples = live.samples();
  const ImplicitSurface fresh = solve(vessel);
  double difference = 0.0;
  for (int i = 0; i < 4000; ++i) {
    const Vec3 p = vessel.axis->place(0.025 * i, 0.7 * i, 0.2 + 0.1 * (i % 31));
    difference = std::max(difference, std::abs(fresh.value(p) - live.surface()->value(p)));
  }
  std::sort(times.begin(), times.end());
  state.counters["samples"] = static_cast<double>(vessel.samples.size());
  state.counters["constraints"] = static_cast<double>(fresh.coefficients().centres.size());
  state.counters["alpha_mm"] = vessel.interpolation.support_radius_mm;
  state.counters["p50_ms"] = times[times.size() / 2];
  state.counters["p95_ms"] = times[times.size() * 95 / 100];
  state.counters["residual_mm"] = residual;
  state.counters["difference_mm"] = difference;
  state.counters["told_mm"] = told / static_cast<double>(times.size());
}

void fresh_solution(benchmark::State& state, double spacing_mm) {
  const VesselLumen vessel = vessel_of(spacing_mm);
  for (auto _ : state) benchmark::DoNotOptimize(solve(vessel));
  state.counters["samples"] = static_cast<double>(vessel.samples.size());
}

/// The baselines of [Wels] 2.1: all constraints, a dense matrix, a linear polynomial.
class DenseField final : public ScalarField {
 public:
  DenseField(std::vector<Constraint> constraints, int power)
      : constraints_(std::move(constraints)), power_(power) {
    const auto n = static_cast<Eigen::Index>(constraints_.size());
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n + 4, n + 4);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(n + 4);
    for (Eigen::Index i = 0; i < n; ++i) {
      const Constraint& c = constraints_[static_cast<std::size_t>(i)];
      for (Eigen::Index j = 0; j < n; ++j)
        matrix(i, j) = std::pow((c.place - constraints_[static_cast<std::size_t>(j)].place).norm(), power_);
      matrix.block(i, n, 1, 4) << 1.0, c.place.x(), c.place.y(), c.place.z();
      matrix.block(n, i, 4, 1) = matrix.block(i, n, 1, 4).transpose();
      right[i] = c.value;
    }
    weights_ = matrix.partialPivLu().solve(right);
  }
  double value(const Vec3& p) const override {
    const auto n = static_cast<Eigen::Index>(constraints_.size());
    double sum = weights_[n] + weights_.tail<3>().dot(p);
    for (Eigen::Index i = 0; i < n; ++i)
      sum += weights_[i] * std::pow((p - constraints_[static_cast<std::size_t>(i)].place).norm(), power_);
    return sum;
  }
  Vec3 gradient(const Vec3& p) const override {
    constexpr double h = 1e-5;
    Vec3 slope;
    for (int k = 0; k < 3; ++k)
      slope[k] = (value(p + h * Vec3::Unit(k)) - value(p - h * Vec3::Unit(k))) / (2.0 * h);
    return slope;
  }
  void values(std::span<const Vec3> places, std::span<double> out) const override {
    for (std::size_t i = 0; i < places.size(); ++i) out[i] = value(places[i]);
  }
  geometry::Box3 box() const override { return {}; }

 private:
  std::vector<Constraint> constraints_;
  int power_;
  Eigen::VectorXd weights_;
};

struct Shape {
  const char* name;
  bool helix;
  Radius radius;
};
const std::vector<Shape>& shapes() {
  static const std::vector<Shape> all{
      {"straight", false, [](double, double) { return 1.5; }},
      {"tapered", false, [](double s, double) { return 2.0 - 0.04 * s; }},
      {"stenosis65", false,
       [](double s, double) { return 1.5 - 0.975 * std::exp(-std::pow((s - 12.5) / 3.5, 2)); }},
      {"helix", true, [](double, double) { return 1.2; }}};
  return all;
}

std::shared_ptr<const AxisCurve> axis_of(const Shape& shape) {
  if (!shape.helix) return testing::straight_axis(25.0);
  geometry::Centerline line;
  for (double s = 0.0; s <= 25.0 + 1e-9; s += 0.25) {
    const double a = s / std::hypot(5.0, 2.0);
    line.points.push_back({5.0 * std::cos(a), 5.0 * std::sin(a), 2.0 * a});
  }
  return std::make_shared<const AxisCurve>(line);
}

/// Counters: distance of f's zero from the exact wall along rays from the axis (mean, maximum), um; angle of
/// the gradient there to the exact normal (root of the mean square), degrees; rays with more than one wall.
void measure(benchmark::State& state, const Shape& shape, const VesselLumen& vessel, const ScalarField& f) {
  const AxisCurve& axis = *vessel.axis;
  double sum = 0.0, most = 0.0, turned = 0.0;
  int count = 0, ghosts = 0;
  for (double s = 2.3; s < axis.length() - 2.3; s += 0.37) {
    for (double theta = 0.05; theta < 6.28; theta += 0.29) {
      const double exact = shape.radius(s, theta);
      double low = std::max(0.05, exact - 0.3), high = exact + 0.3;
      for (int i = 0; i < 40; ++i) {
        const double middle = 0.5 * (low + high);
        (f.value(axis.place(s, theta, middle)) < 0.0 ? low : high) = middle;
      }
      const Vec3 normal = testing::wall_normal(axis, shape.radius, s, theta);
      const double angle =
          std::acos(std::clamp(f.gradient(axis.place(s, theta, low)).normalized().dot(normal), -1.0, 1.0));
      sum += std::abs(low - exact);
      most = std::max(most, std::abs(low - exact));
      turned += angle * angle;
      ++count;
      for (double rho = exact + 0.5; rho < exact + 8.0; rho += 0.5)
        if (f.value(axis.place(s, theta, rho)) <= 0.0 && !shape.helix) {
          ++ghosts;
          break;
        }
    }
  }
  state.counters["samples"] = static_cast<double>(vessel.samples.size());
  state.counters["mean_um"] = 1e3 * sum / count;
  state.counters["max_um"] = 1e3 * most;
  state.counters["normal_deg"] = std::sqrt(turned / count) * 57.29577951;
  state.counters["ghost_rays_percent"] = 100.0 * ghosts / count;
}

VesselLumen vessel_of(const Shape& shape) {
  return testing::tube_vessel(axis_of(shape), shape.radius, 0.9);
}

void compact(benchmark::State& state, const Shape& shape, Kernel kernel, FarField far_field,
             double alpha_share) {
  VesselLumen vessel = vessel_of(shape);
  vessel.interpolation.kernel = kernel;
  vessel.interpolation.far_field = far_field;
  vessel.interpolation.support_radius_mm *= alpha_share;
  std::optional<ImplicitSurface> f;
  for (auto _ : state) f.emplace(solve(vessel));
  measure(state, shape, vessel, *f);
}

void dense(benchmark::State& state, const Shape& shape, int power) {
  const VesselLumen vessel = vessel_of(shape);
  std::optional<DenseField> f;
  for (auto _ : state) f.emplace(ConstraintSet(vessel).all(), power);
  measure(state, shape, vessel, *f);
}

template <class Function>
benchmark::internal::Benchmark* add(const std::string& name, const Function& function) {
  return benchmark::RegisterBenchmark(name.c_str(), function)
      ->Unit(benchmark::kMillisecond)
      ->MeasureProcessCPUTime();
}

bool register_all() {
  const auto edit = [](const std::string& name, double spacing_mm, Kernel kernel, FarField far_field,
                       int count) {
    add("one_edit/" + name, [=](benchmark::State& s) {
      one_edit(s, spacing_mm, kernel, far_field);
    })->Iterations(count);
  };
  edit("1000_samples", 1.0, Kernel::wendland_c2, FarField::constant, 300);
  edit("4000_samples", 0.49, Kernel::wendland_c2, FarField::constant, 100);
  edit("1000_samples/morse-c0", 1.0, Kernel::morse_c0, FarField::constant, 100);
  edit("1000_samples/wendland-c4", 1.0, Kernel::wendland_c4, FarField::constant, 100);
  edit("1000_samples/linear", 1.0, Kernel::wendland_c2, FarField::linear, 100);
  add("fresh/1000_samples", [](benchmark::State& s) { fresh_solution(s, 1.0); });
  add("fresh/4000_samples", [](benchmark::State& s) { fresh_solution(s, 0.49); });
  for (const Shape& shape : shapes()) {
    const std::string of = std::string("wall/") + shape.name + "/";
    for (const Kernel kernel : {Kernel::morse_c0, Kernel::wendland_c2, Kernel::wendland_c4})
      add(of + name(kernel), [=](benchmark::State& s) {
        compact(s, shape, kernel, FarField::constant, 1.0);
      })->Iterations(1);
    add(of + "wendland-c2/linear", [=](benchmark::State& s) {
      compact(s, shape, Kernel::wendland_c2, FarField::linear, 1.0);
    })->Iterations(1);
    for (const double share : {0.67, 1.5})
      add(of + "wendland-c2/alpha*" + std::to_string(share).substr(0, 4), [=](benchmark::State& s) {
        compact(s, shape, Kernel::wendland_c2, FarField::constant, share);
      })->Iterations(1);
    add(of + "dense-biharmonic", [=](benchmark::State& s) { dense(s, shape, 1); })->Iterations(1);
    add(of + "dense-triharmonic", [=](benchmark::State& s) { dense(s, shape, 3); })->Iterations(1);
  }
  return true;
}
[[maybe_unused]] const bool registered = register_all();

}  // namespace
