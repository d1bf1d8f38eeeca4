#pragma once
/// \file How sure a tree's pressures are, and of which input that comes
/// (docs/methods/pressure-uncertainty.md).

#include "ostia/core/task_context.h"
#include "ostia/hemodynamics/readings.h"

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace ostia::hemodynamics {

/// Inputs that are held against each other.
enum class InputGroup { wall, pressure, flow, hyperaemia, split, blood };
constexpr std::size_t input_groups = 6;
std::string_view name_of(InputGroup group);  ///< "wall", "pressure", ...

/// How a number lies about the one that is told. In all of them that one is the median.
enum class SpreadLaw {
  normal,     ///< `sd` in the number's unit
  lognormal,  ///< `sd` of its natural logarithm: a relative one
};
std::string_view name_of(SpreadLaw law);  ///< "normal", "lognormal"
/// One uncertain number beside the wall.
struct InputSpread {
  std::string_view key;  ///< of condition_inputs(), or "rest_flow": the flow at rest that the tree asks for
  InputGroup group = InputGroup::pressure;
  SpreadLaw law = SpreadLaw::normal;
  double sd = 0.0;     ///< 0: certain
  std::string source;  ///< of the spread
};

/// How far a wall may be from where it is drawn: a normal number z of deviation 1 at each place, smooth along
/// the vessels and the same on all sides of a fork, turns a section's radius r into r exp(z sd / r). What its
/// form takes of pressure above a circle's goes with 1 / r^2, as where a wall is moved alike all round.
struct WallSpread {
  double radius_sd_mm = 0.15;   ///< of a section's mean radius, where the image does not tell; [0, 1]
  double most_relative = 0.4;   ///< sd / r is no more than this, [0.01, 1]
  double correlation_mm = 2.5;  ///< along s, of a Matern 3/2 kernel, [0.5, 100]
  double common_share = 0.25;   ///< of the variance: the same for all walls of the tree, [0, 1]
  /// Of each branch, one a station; empty, or of a branch empty: `radius_sd_mm` everywhere.
  std::vector<std::vector<double>> station_sd_mm;
  /// Where `radius_sd_mm`, or that of the stations, is from.
  std::string source = "stated: edited lumina lie 0.14 to 0.20 mm from what observers drew (Wels et al.)";
};

struct UncertaintyOptions {
  int samples = 1000;      ///< trees that the distributions are of, even, [16, 10000]
  std::uint64_t seed = 1;  ///< of the scrambled sequence
  /// Also which group it comes from: half as many trees again for each group.
  bool indices = true;
  /// In the place of those of the same keys in spreads_of(what the resting flow is known by), or beside them.
  std::vector<InputSpread> spreads;
  WallSpread wall;
};
/// The usual spreads, with where each comes from. That of the flow at rest depends on what it is known by.
std::vector<InputSpread> spreads_of(FlowSource source);
/// These with `told` in their place.
std::vector<InputSpread> spreads_of(FlowSource source, const std::vector<InputSpread>& told);
/// Throws InvalidInput that names the value, or an input that is not known.
void validate(const UncertaintyOptions& options);

/// Of one result over all trees.
struct Distribution {
  bool known = false;                          ///< false behind an occlusion: what follows means nothing
  double median = 0.0, low = 0.0, high = 0.0;  ///< 50, 2.5 and 97.5 %
  double mean = 0.0, sd = 0.0;
  double probability = 0.0;  ///< of being at or below the readings' threshold
};
/// Shares of a variance, one a group in the order of InputGroup. 0 where there is no variance.
struct SobolIndices {
  std::array<double, input_groups> first{};  ///< by this group alone
  std::array<double, input_groups> total{};  ///< with all that it does together with others
};
struct UncertainReading {
  TreePlace place;
  Distribution ratio;    ///< Pd/Pa under hyperaemia: FFR
  SobolIndices indices;  ///< of that; 0 without `UncertaintyOptions::indices`
};

struct PressureUncertainty {
  double threshold = 0.80;
  int samples = 0;  ///< trees that the distributions are of
  std::uint64_t seed = 0;
  int trees = 0;                     ///< that were solved in all
  int failed = 0;                    ///< left out, since their pressures did not settle
  std::vector<InputSpread> spreads;  ///< that were used
  WallSpread wall;
  std::vector<std::vector<Distribution>> stations;  ///< FFR, of each branch
  std::vector<UncertainReading> lesions;       ///< in the order given, where the tree as it is drawn is read
  std::vector<Distribution> lesion_falls;      ///< what each takes of Pd/Pa; the probability is left at 0
  std::vector<UncertainReading> outlets;       ///< the last station, in the order of outlets_of
  std::vector<Distribution> outlet_flow_ml_s;  ///< under hyperaemia; the probability is left at 0
};

/// Monte Carlo with a scrambled quasi-random sequence over whole trees; Sobol indices after Saltelli et al.
/// 2010, Janon et al. 2014 (first order) and Jansen 1999 (total). `model`: its blood is the conditions'. The
/// same bits for any number of threads. `network` is the tree as it is drawn; occluded branches stay so.
/// Throws InvalidInput as validate, resting_flow and read_tree do, NumericalError where the tree as it is
/// drawn, or one tree in twenty, does not settle; Cancelled.
PressureUncertainty pressure_uncertainty(const Network& network, const Conditions& conditions,
                                         const std::vector<LesionPlace>& lesions, const FlowModel& model = {},
                                         const ReadingOptions& reading = {},
                                         const UncertaintyOptions& options = {},
                                         const core::TaskContext& task = core::no_task());

/// {"samples": 1000, "seed": 1, "indices": true, "inputs": {"systolic_mmhg": {"law": "normal", "sd": 8,
/// "group": "pressure", "source": "..."}, ...}, "wall": {"radius_sd_mm": 0.15, ...}}: what conditions.json
/// has as its member "uncertainty". Of the walls' stations only the median is told.
std::string uncertainty_json(const UncertaintyOptions& options);
/// Of that, or of a conditions.json with that member (without it: `given`). An input's `sd` may stand by
/// itself, {"inputs": {"systolic_mmhg": 5}}; inputs that are left out keep theirs. Throws InvalidInput that
/// names the key.
UncertaintyOptions uncertainty_of_json(std::string_view text, const UncertaintyOptions& given);

}  // namespace ostia::hemodynamics
