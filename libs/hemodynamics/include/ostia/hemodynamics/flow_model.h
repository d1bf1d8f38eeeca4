#pragma once
/// \file What blood and its flow are taken to be.

namespace ostia::hemodynamics {

enum class JunctionLaw {
  none,     ///< the same static pressure in all branches of a fork
  unified,  ///< Mynard and Valen-Sendstad 2015 (junction_loss.h)
};

/// Momentum coefficient of the developed profile, a parabola.
constexpr double developed_momentum = 4.0 / 3.0;

struct FlowModel {
  double density_kg_m3 = 1060.0;  ///< [900, 1200]
  double viscosity_mpa_s = 3.5;   ///< [0.5, 20]
  /// Terms in the square of the flow: momentum, separation, developing profiles, bends. Without them pressure
  /// falls by developed friction alone.
  bool inertia = true;
  /// Friction rises with Dean's number (White 1929), and where the lumen turns away from it a jet leans on
  /// the wall.
  bool bends = true;
  JunctionLaw junctions = JunctionLaw::unified;
  /// The pressure that is told is that of blood at rest, as in the aorta: at a root static pressure is less
  /// by what sets it in motion. False: it is the static one at the root's first section.
  bool from_rest = false;
  /// Momentum coefficient at the aorta, [1, 4/3]: 1 is flat, 4/3 developed.
  double root_momentum = 1.0;
  /// Length over Reynolds number and diameter in which a profile, or a jet, comes e times nearer to the
  /// developed one: the centre has 99 % of its speed after 0.056 Re D (Shah and London 1978). [0.001, 0.1]
  double development = 0.0122;
  /// Friction of a thin layer on the wall: with `development` the entrance takes 1.21 of rho U^2 / 2 above
  /// developed friction (Shah and London: 1.25). [0, 2]
  double layer_friction = 0.5;
  /// What the wall rubs less where the lumen widens, over the developed friction and the widening within the
  /// length in which a profile develops. Fitted on computations of round stenoses. [0, 1.5]
  double adverse_friction = 1.0;
  /// Friction of the dead water beside a jet, backwards, over the developed one, at most. Fitted as that.
  /// [0, 3]
  double backflow = 1.2;
  /// Far from the developed profile a jet's momentum coefficient falls by this over the length that
  /// `development` stands for: it spreads through dead water first. Fitted as those. [0.1, 20]
  double jet_spread = 1.6;
  double step_mm = 0.25;  ///< of the integration along s, at most, [0.01, 2]
  /// Scales all terms in the square of the flow, [0, 1]: the solver's way from linear to whole. 1 for
  /// results.
  double inertia_scale = 1.0;
};
void validate(const FlowModel& model);  ///< throws InvalidInput

/// 4 density flow / (pi viscosity diameter).
double reynolds(const FlowModel& model, double flow_ml_s, double diameter_mm);
/// Above it at a throat the laminar model does not hold: jets break up.
constexpr double trusted_reynolds = 1000.0;

}  // namespace ostia::hemodynamics
