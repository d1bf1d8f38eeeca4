#include "ostia/phantom/heart_ecg.h"

#include "ostia/core/error.h"
#include "ostia/phantom/noise.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>

namespace ostia::phantom {
namespace {

constexpr std::uint64_t beat_index = 0x45434700000000, noise_index = 0x45434e00000000;
constexpr double first_beat_s = 0.45;
constexpr double breath_share = 0.03, mayer_share = 0.02, chance_share = 0.01;
constexpr double mayer_hz = 0.1, wander_mv = 0.04;

/// One wave of a beat, in leads II and V5.
struct Wave {
  double at_s, width_s;
  bool with_interval;  // its place goes with the root of the RR interval (Bazett), that of QRS does not
  std::array<double, 2> height_mv;
};
constexpr std::array<Wave, 5> waves{{{-0.165, 0.024, true, {0.14, 0.09}},
                                     {-0.030, 0.009, false, {-0.10, -0.07}},
                                     {0.0, 0.011, false, {1.10, 1.45}},
                                     {0.031, 0.010, false, {-0.22, -0.30}},
                                     {0.290, 0.052, true, {0.28, 0.36}}}};

void require_ecg(double value, double least, double most, const char* what) {
  if (!(value >= least && value <= most))
    throw InvalidInput(std::string("electrocardiogram: ") + what + " is " + std::to_string(value) +
                       "; it must lie in [" + std::to_string(least) + ", " + std::to_string(most) + "]");
}

struct Beat {
  std::size_t sample;
  double interval_s;  // to the next
};

std::vector<Beat> beats_of(double rate_per_min, std::uint64_t seed, const EcgOptions& o) {
  const double turn = 2.0 * std::numbers::pi, mean = 60.0 / rate_per_min;
  const double mayer_phase = turn * uniform(seed, beat_index);
  std::vector<Beat> out;
  double t = first_beat_s;
  // One more than the record holds: its P wave may be in it.
  for (std::uint64_t i = 1; t < o.seconds + 1.0; ++i) {
    const double share = 1.0 + breath_share * std::sin(turn * o.breathing_per_min / 60.0 * t) +
                         mayer_share * std::sin(turn * mayer_hz * t + mayer_phase) +
                         chance_share * normal(seed, beat_index + i);
    out.push_back({static_cast<std::size_t>(std::lround(t * o.samples_per_second)), mean * share});
    t += mean * share;
  }
  return out;
}

void add_beat(const Beat& beat, const EcgOptions& o, std::size_t lead, std::vector<double>& values) {
  const double root = std::sqrt(beat.interval_s);
  for (const Wave& wave : waves) {
    const double at = static_cast<double>(beat.sample) / o.samples_per_second +
                      wave.at_s * (wave.with_interval ? root : 1.0);
    const auto first = static_cast<long>(std::ceil((at - 6.0 * wave.width_s) * o.samples_per_second));
    const auto last = static_cast<long>(std::floor((at + 6.0 * wave.width_s) * o.samples_per_second));
    for (long i = std::max(0L, first); i <= last && i < static_cast<long>(values.size()); ++i) {
      const double d = (static_cast<double>(i) / o.samples_per_second - at) / wave.width_s;
      values[static_cast<std::size_t>(i)] += wave.height_mv[lead] * std::exp(-0.5 * d * d);
    }
  }
}

}  // namespace

HeartEcg draw_ecg(double heart_rate_per_min, std::uint64_t seed, const EcgOptions& o) {
  require_ecg(heart_rate_per_min, 20.0, 240.0, "the heart rate (1/min)");
  require_ecg(o.seconds, 2.0, 3600.0, "its length (s)");
  require_ecg(o.samples_per_second, 100.0, 10000.0, "the number of samples a second");
  require_ecg(o.noise_mv, 0.0, 1.0, "the noise (mV)");
  require_ecg(o.breathing_per_min, 4.0, 60.0, "the number of breaths a minute");
  const auto samples = static_cast<std::size_t>(std::lround(o.seconds * o.samples_per_second));
  const std::vector<Beat> beats = beats_of(heart_rate_per_min, seed, o);
  HeartEcg out;
  out.record.samples_per_second = o.samples_per_second;
  for (const char* name : {"II", "V5"}) {
    const std::size_t lead = out.record.leads.size();
    std::vector<double> values(samples);
    for (std::size_t i = 0; i < samples; ++i) {
      const double t = static_cast<double>(i) / o.samples_per_second;
      values[i] = wander_mv * std::sin(2.0 * std::numbers::pi * o.breathing_per_min / 60.0 * t) +
                  o.noise_mv * normal(seed, noise_index + lead * (std::uint64_t{1} << 28) + i);
    }
    for (const Beat& beat : beats) add_beat(beat, o, lead, values);
    out.record.leads.push_back({name, "mV", std::move(values)});
  }
  for (const Beat& beat : beats)
    if (beat.sample < samples) out.beats.push_back({beat.sample, 'N'});
  return out;
}

}  // namespace ostia::phantom
