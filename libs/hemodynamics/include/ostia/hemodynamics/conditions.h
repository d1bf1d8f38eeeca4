#pragma once
/// \file What flows against what: pressures, flows and resistances of a patient, with where each comes from.

#include "ostia/hemodynamics/flow_model.h"
#include "ostia/hemodynamics/network_solver.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ostia::hemodynamics {

constexpr double pa_of_mmhg = 133.322387415;

/// All inputs. Each has an entry in condition_inputs() with unit, ranges and source.
struct Conditions {
  double systolic_mmhg = 120.0, diastolic_mmhg = 80.0;
  double mean_share = 0.40;  ///< mean pressure = diastolic + this of the pulse pressure
  double venous_mmhg = 5.0;
  double heart_rate_bpm = 70.0;
  double density_kg_m3 = 1060.0, viscosity_mpa_s = 3.5;
  std::optional<double> rest_flow_ml_min;  ///< of the whole tree; before all that follows
  std::optional<double> lv_mass_g;         ///< left ventricular mass
  double rest_flow_ml_min_g = 0.9;
  std::optional<double>
      supplied_share;  ///< of the mass, by the tree that is there; none: 1 with two roots or more
  double calibre_factor = 1.43, calibre_exponent = 2.55;  ///< flow = factor d^exponent, m3/s and m
  double split_exponent = 2.27;
  double hyperaemic_resistance = 0.24;  ///< of the resistance at rest

  double mean_aortic_mmhg() const { return diastolic_mmhg + mean_share * (systolic_mmhg - diastolic_mmhg); }
};

/// One input: what it is called in JSON and on the command line, and what is usual.
struct ConditionInput {
  std::string_view key, unit, meaning, source;
  double usual_low = 0.0, usual_high = 0.0;  ///< where most people are: for a study of uncertainty
  double least = 0.0, most = 0.0;            ///< beyond is no physiology: refused unless told to be taken
  double Conditions::*value = nullptr;       ///< either
  std::optional<double> Conditions::*optional = nullptr;  ///< or
};
std::span<const ConditionInput> condition_inputs();

/// The keys of inputs outside [least, most]; each as one sentence.
std::vector<std::string> unusual_inputs(const Conditions& conditions);
/// Throws InvalidInput with the first of these, unless `unusual`; always for what has no meaning (a number
/// that is none or not above 0, diastolic not below systolic, venous not below the mean aortic pressure).
void validate(const Conditions& conditions, bool unusual = false);

/// {"systolic_mmhg": {"value": 120, "unit": "mmHg", "usual": [...], "allowed": [...], "source": "...",
/// "told": false}, ...}
std::string conditions_json(const Conditions& conditions);
/// Of that, or of plain numbers by key; what is left out keeps its value in `given`. Throws InvalidInput that
/// names the key.
Conditions conditions_of_json(std::string_view text, const Conditions& given = {});

/// Flow model with the conditions' blood.
FlowModel flow_model_of(const Conditions& conditions, FlowModel model = {});

/// Of the circle of equal area. At a root: what three quarters of its first 15 mm are no wider than, so that
/// a stenosis at the ostium has no say; at an outlet: the median of its last 5 mm. 0 without stations.
double root_diameter_mm(const Branch& branch);
double outlet_diameter_mm(const Branch& branch);

enum class FlowSource { told, mass, calibre };
std::string_view name_of(FlowSource source);  ///< "told", "mass", "calibre"

/// What the tree would carry at rest without any stenosis.
struct RestingFlow {
  double total_ml_s = 0.0;
  FlowSource source = FlowSource::calibre;
  std::vector<double> outlets_ml_s;  ///< in the order of PreparedNetwork::outlets; by diameter^split_exponent
  std::vector<std::string> notes;    ///< one sentence each: what was assumed
};
/// The total by what is told, else by mass, else by the calibre of each root. Throws InvalidInput where no
/// diameter is known (branches without stations).
RestingFlow resting_flow(const Network& network, const Conditions& conditions);

/// Resistance of the bed behind each outlet, and the least it can have.
struct Microcirculation {
  std::vector<double> rest_pa_s_ml, hyperaemic_pa_s_ml;
};
/// (mean aortic - venous) / resting flow of the outlet; hyperaemic: that times `hyperaemic_resistance`.
Microcirculation microcirculation(const RestingFlow& flow, const Conditions& conditions);

}  // namespace ostia::hemodynamics
