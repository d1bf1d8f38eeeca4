#pragma once
/// \file From surfaces at several phases to one surface that beats. See docs/methods/motion.md.

#include "ostia/core/task_context.h"
#include "ostia/geometry/cage_motion.h"
#include "ostia/geometry/tri_mesh.h"
#include "ostia/motion/cage_registration.h"

#include <string>
#include <vector>

namespace ostia::pipeline {

/// The surface of one phase, any triangles; none where the vessel is not seen.
struct PhaseSurface {
  double phase = 0.0;  ///< share of the cycle since the R peak, in [0, 1)
  std::string name;    ///< of its file, for messages
  geometry::TriMesh surface;
  /// Control points of geometry::cage_around(template, depth, margin) that are near it already; empty: its
  /// neighbour's are the start.
  std::vector<geometry::Vec3> start = {};
  std::string why = {};  ///< why there are no triangles; empty: "no vessel"
};

enum class MotionMethod {
  gauss_newton,      ///< motion::register_cage
  gradient_descent,  ///< motion::register_cage_by_descent: the paper's, for comparison; each phase from rest
};

struct MotionFitOptions {
  MotionMethod method = MotionMethod::gauss_newton;
  /// Of each phase; `start` is not used. The descent takes depth, margin, angle and energy.
  motion::RegistrationOptions registration;
  double template_phase = 0.75;  ///< the nearest that has a surface is taken
};

/// What came of one phase.
struct PhaseFit {
  double phase = 0.0;
  std::string name;  ///< may be empty
  geometry::PhaseOrigin origin = geometry::PhaseOrigin::fitted;
  std::string why;                    ///< bridged: the reason
  bool gap = false;                   ///< bridged: there was nothing of this phase
  motion::RegistrationReport report;  ///< all zero where nothing was registered
  double stiffness = 1.0;  ///< factor of the energy's weights, above 1 where a softer cage was stuck
};

struct MotionFit {
  geometry::CageMotion motion;
  std::size_t template_index = 0;    ///< into `phases`
  geometry::TriMesh template_shape;  ///< its surface
  std::vector<PhaseFit> phases;      ///< as those of the motion
  std::vector<std::string> warnings;
};

/// Whether two shares of the cycle mean one moment: within 0.2 % of the cycle, across its end as well.
bool is_same_phase(double a, double b);

/// Phases that are missing between others that are evenly spaced: they are multiples of one step, of which
/// a whole number makes the cycle and at least two thirds are there. Empty where there is no such step.
/// `phases` rise, in [0, 1).
std::vector<double> missing_phases(const std::vector<double>& phases);

/// Registers the template with every other phase. They are taken outward from it in time, both ways, each
/// from its neighbour's cage; one that is stuck (a distance above 0.1 mm, cells that cannot be pressed
/// further) with 10 and 100 times the energy's weights. A phase without triangles, one whose registration has
/// failed (paired share below half of the median, distance above four times it and 1 % of the template's
/// size), and a gap are bridged: put on the periodic spline through the others. Phases may come in any order.
/// Deterministic. Throws InvalidInput that names the phase: fewer than three that can be used, two of the
/// same phase, phases out of [0, 1), a unit that is hardly the millimetre, surfaces of another size or place
/// than the template's. Cancelled.
MotionFit fit_motion(std::vector<PhaseSurface> phases, const MotionFitOptions& options = {},
                     const core::TaskContext& task = core::no_task());

/// Whether no person need look at it: gaps are as they are; all else that was bridged, an inverted cell, and
/// triangles that intersect more often than the template's are for a person.
bool is_sound(const MotionFit& fit);

using geometry::percent_text;

}  // namespace ostia::pipeline
