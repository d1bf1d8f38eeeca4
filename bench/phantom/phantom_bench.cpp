// The cost of a synthetic scan: painting, noise, and a whole image of 512 x 512 x 300 voxels.

#include "ostia/core/parallel.h"
#include "ostia/phantom/body.h"
#include "ostia/phantom/coronary_tree.h"
#include "ostia/phantom/patient_heart.h"
#include "ostia/phantom/presets.h"
#include "ostia/phantom/scan.h"
#include "ostia/phantom/scene.h"

#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include <cmath>

namespace {

using namespace ostia;
using geometry::Vec3;
using phantom::Label;
using phantom::Material;

/// A chest of simple shapes: lungs full of small vessels, a heart, a spine.
class SimpleChest : public phantom::Scene {
 public:
  class Part : public phantom::ScenePart {
   public:
    explicit Part(const geometry::Box3& box) {
      const double reach = 0.5 * box.diagonal().norm();
      const Vec3 c = box.center();
      if (body(c) > reach) uniform_ = Material{Label::outside_air, -1000.0f};
    }
    static double body(const Vec3& p) { return std::hypot(p.x(), 1.3 * p.y()) - 120.0; }
    Material at(const Vec3& p) const override {
      if (body(p) > 0.0) return {Label::outside_air, -1000.0f};
      const Vec3 heart(p.x() / 55.0, p.y() / 45.0, p.z() / 60.0);
      const double r = heart.squaredNorm();
      if (r < 0.5) return {Label::left_ventricle, 380.0f};
      if (r < 1.0) return {Label::myocardium, 100.0f};
      if (r < 1.2) return {Label::epicardial_fat, -90.0f};
      if (std::hypot(p.x(), p.y() - 70.0) < 18.0) return {Label::bone, 300.0f};
      if (std::abs(p.x()) < 95.0 && std::abs(p.y()) < 70.0) {
        // Vessels along z, one in each square of 6 mm, 1.5 mm thick.
        const double x = p.x() - 6.0 * std::round(p.x() / 6.0), y = p.y() - 6.0 * std::round(p.y() / 6.0);
        return x * x + y * y < 0.56 ? Material{Label::pulmonary_vessel, 300.0f}
                                    : Material{Label::lung, -850.0f};
      }
      return {Label::muscle, 50.0f};
    }
    std::optional<Material> uniform() const override { return uniform_; }
    bool fine_near(const Vec3&, double) const override { return false; }

   private:
    std::optional<Material> uniform_;
  };
  std::unique_ptr<const phantom::ScenePart> part(const geometry::Box3& box) const override {
    return std::make_unique<Part>(box);
  }
};

phantom::ScanOptions scan_of(std::array<std::int64_t, 3> size) {
  phantom::ScanOptions options;
  options.grid.size = size;
  options.grid.spacing = Vec3(0.35, 0.35, 0.45);
  for (int axis = 0; axis < 3; ++axis)
    options.grid.origin[axis] =
        -0.5 * options.grid.spacing[axis] * static_cast<double>(size[static_cast<std::size_t>(axis)] - 1);
  return options;
}

double peak_memory_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

void run(benchmark::State& state, const phantom::Scene& scene, const phantom::ScanOptions& options) {
  core::set_max_threads(2);
  for (auto _ : state) {
    const phantom::Scan scan = phantom::acquire(scene, options);
    benchmark::DoNotOptimize(scan.image.voxels.data());
  }
  state.counters["voxels"] = static_cast<double>(options.grid.voxels());
  state.counters["peak_mb"] = peak_memory_mb();
  core::set_max_threads(0);
}

void paint(benchmark::State& state) {
  phantom::ScanOptions options = scan_of({512, 512, 32});
  options.noise_hu = 0.0;
  run(state, SimpleChest(), options);
}

void noise(benchmark::State& state) {
  class Nothing : public phantom::Scene {
    class Part : public phantom::ScenePart {
      Material at(const Vec3&) const override { return {}; }
      std::optional<Material> uniform() const override { return Material{}; }
      bool fine_near(const Vec3&, double) const override { return false; }
    };
    std::unique_ptr<const phantom::ScenePart> part(const geometry::Box3&) const override {
      return std::make_unique<Part>();
    }
  };
  run(state, Nothing(), scan_of({512, 512, 32}));
}

void simple_full(benchmark::State& state) {
  run(state, SimpleChest(), scan_of({512, 512, 300}));
}

/// A drawn heart in a drawn chest, from the scene's making to the finished image.
void full_image(benchmark::State& state) {
  core::set_max_threads(2);
  const phantom::HeartShape heart = phantom::draw_heart(1);
  const phantom::CoronaryTree tree = phantom::draw_coronaries(heart);
  phantom::ScanOptions options;
  options.grid = phantom::grid_of(phantom::Preset::full, heart, &tree);
  for (auto _ : state) {
    const phantom::Body body(heart, tree, phantom::draw_body(1));
    const phantom::Scan scan = phantom::acquire(body, options);
    benchmark::DoNotOptimize(scan.image.voxels.data());
  }
  state.counters["voxels"] = static_cast<double>(options.grid.voxels());
  state.counters["peak_mb"] = peak_memory_mb();
  core::set_max_threads(0);
}

/// A drawn tree as if it were a patient's, turned and elsewhere.
phantom::PatientTree patient() {
  const phantom::CoronaryTree tree =
      phantom::draw_coronaries(phantom::draw_heart(7), {.seed = 7, .disease = 0.0});
  phantom::PatientTree out;
  out.dominance = tree.dominance;
  for (const phantom::CoronaryVessel& vessel : tree.vessels) {
    phantom::PatientVessel one{vessel.name, vessel.parent, {}, {}};
    for (std::size_t i = 0; i < vessel.axis.size(); i += 5) {
      one.points.push_back(1.05 * vessel.axis.points[i] + geometry::Vec3(30, -120, 480));
      one.radius_mm.push_back(vessel.healthy_radius_mm[i]);
    }
    out.vessels.push_back(std::move(one));
  }
  return out;
}

/// A heart laid under a patient's arteries.
void patient_heart(benchmark::State& state) {
  core::set_max_threads(2);
  const phantom::PatientTree tree = patient();
  const phantom::HeartShape heart = phantom::draw_heart(1);
  for (auto _ : state) {
    const phantom::PatientHeart built = phantom::patient_heart(tree, heart, {});
    state.counters["least_jacobian"] = built.record.least_jacobian;
  }
  core::set_max_threads(0);
}

/// The same as an image: every place goes through the map.
void patient_image(benchmark::State& state) {
  core::set_max_threads(2);
  const phantom::HeartShape heart = phantom::draw_heart(1);
  const phantom::PatientHeart built = phantom::patient_heart(patient(), heart, {});
  phantom::ScanOptions options;
  options.grid = phantom::grid_of(phantom::Preset::full, heart, &built.tree);
  for (auto _ : state) {
    const phantom::Body body(heart, built.tree, phantom::draw_body(1), built.warp);
    const phantom::Scan scan = phantom::acquire(body, options);
    benchmark::DoNotOptimize(scan.image.voxels.data());
  }
  state.counters["peak_mb"] = peak_memory_mb();
  core::set_max_threads(0);
}

void add(const char* name, void (*function)(benchmark::State&)) {
  benchmark::RegisterBenchmark(name, function)
      ->Unit(benchmark::kMillisecond)
      ->MeasureProcessCPUTime()
      ->UseRealTime();
}

}  // namespace

int main(int argc, char** argv) {
  add("paint", paint);
  add("noise", noise);
  add("simple_full_image", simple_full);
  add("full_image", full_image);
  add("patient_heart", patient_heart);
  add("patient_image", patient_image);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
