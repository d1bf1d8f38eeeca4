#include "scan/smooth_process.h"

#include "ostia/core/error.h"
#include "ostia/phantom/truth.h"

#include <array>
#include <cmath>

namespace ostia::phantom {
namespace {

/// Waves about the vessel from `lowest` to `highest` periods a turn.
struct ObserverWaves {
  int lowest = 0, highest = 0;
  double share = 0.0;  // of the variance
  double length_mm = 0.0;
};
constexpr std::array<ObserverWaves, 4> observer_waves{
    {{1, 1, 0.35, 8.0}, {0, 0, 0.30, 5.0}, {2, 3, 0.25, 4.0}, {4, 6, 0.10, 2.0}}};

}  // namespace

void validate(const ObserverOptions& options) {
  const auto require = [](bool good, const char* what) {
    if (!good) throw InvalidInput(std::string("observers: ") + what);
  };
  const auto deviation = [](double value) { return value >= 0.0 && value <= 2.0; };
  require(options.count >= 0 && options.count <= 9, "their number must be 0 to 9");
  require(deviation(options.healthy_mm) && deviation(options.diseased_mm) && deviation(options.axis_mm),
          "a deviation must be 0 to 2 mm");
  require(options.axis_length_mm > 0.0 && std::isfinite(options.axis_length_mm),
          "the correlation length must be above 0 mm");
}

double RadialDeviation::at(double theta) const {
  double sum = mean;
  for (int n = 1; n <= 6; ++n) sum += cosine[n] * std::cos(n * theta) + sine[n] * std::sin(n * theta);
  return sum;
}

RadialDeviation radial_deviation(const CoronaryVessel& vessel, int observer, double s_mm,
                                 const ObserverOptions& options) {
  const auto key = (static_cast<std::uint64_t>(vessel.id) << 8) + static_cast<std::uint64_t>(observer);
  const double share = disease_at(vessel, s_mm);
  const double deviation = options.healthy_mm + share * (options.diseased_mm - options.healthy_mm);
  RadialDeviation out;
  for (const ObserverWaves& group : observer_waves) {
    const double size = deviation * std::sqrt(group.share / (group.highest - group.lowest + 1));
    for (int n = group.lowest; n <= group.highest; ++n) {
      const std::uint64_t stream = (key << 4) + 2 * static_cast<std::uint64_t>(n);
      const double a = size * smooth_process(options.seed, stream, s_mm, group.length_mm);
      if (n == 0) {
        out.mean = a;
        continue;
      }
      out.cosine[n] = a;
      out.sine[n] = size * smooth_process(options.seed, stream + 1, s_mm, group.length_mm);
    }
  }
  return out;
}

double observed_radius(double radius_mm, double deviation_mm) {
  return deviation_mm >= 0.0 ? radius_mm + deviation_mm : radius_mm * std::exp(deviation_mm / radius_mm);
}

}  // namespace ostia::phantom
