#include "motion/motion_fit_report.h"

#include "ostia/io/cage_motion_file.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>

namespace ostia::app {
namespace {

using geometry::PhaseOrigin;
using pipeline::MotionFit;
using pipeline::PhaseFit;

const char* origin_name(PhaseOrigin origin) {
  switch (origin) {
    case PhaseOrigin::at_rest:
      return "at_rest";
    case PhaseOrigin::bridged:
      return "bridged";
    default:
      return "fitted";
  }
}

Json phase_json(const PhaseFit& one, const std::vector<pipeline::ImagePhase>& images) {
  Json out{{"percent", io::percent_of(one.phase)},
           {"origin", origin_name(one.origin)},
           {"why", one.why.empty() ? Json(nullptr) : Json(one.why)},
           {"stiffness", one.stiffness},
           {"rounds", one.report.rounds},
           {"paired_share", one.report.paired_share},
           {"mean_distance_mm", one.report.mean_distance_mm},
           {"least_jacobian", one.report.least_jacobian},
           {"self_intersections", one.report.self_intersections},
           {"source_self_intersections", one.report.source_self_intersections}};
  for (const pipeline::ImagePhase& image : images)
    if (image.phase == one.phase)
      out["image"] = {{"likeness", image.likeness},
                      {"inside_share", image.inside_share},
                      {"wall_shift_mm", image.wall_shift_mm}};
  return out;
}

/// Of all phases together.
struct Sums {
  std::size_t fitted = 0, bridged = 0, gaps = 0, new_intersections = 0;
  double distance = 0.0, least_share = 1.0, least_jacobian = 1.0;
};

Sums sums_of(const MotionFit& fit) {
  Sums sums;
  for (const PhaseFit& one : fit.phases) {
    const auto& r = one.report;
    sums.least_jacobian = std::min(sums.least_jacobian, r.least_jacobian);
    if (one.origin == PhaseOrigin::bridged) {
      ++(one.gap ? sums.gaps : sums.bridged);
    } else if (one.origin == PhaseOrigin::fitted) {
      ++sums.fitted;
      sums.distance += r.mean_distance_mm;
      sums.least_share = std::min(sums.least_share, r.paired_share);
      if (r.self_intersections > r.source_self_intersections)
        sums.new_intersections += r.self_intersections - r.source_self_intersections;
    }
  }
  if (sums.fitted > 0) sums.distance /= static_cast<double>(sums.fitted);
  return sums;
}

}  // namespace

Json motion_fit_report(const MotionFit& fit, const std::vector<pipeline::ImagePhase>& images) {
  const Sums sums = sums_of(fit);
  Json out{{"v", 1},
           {"kind", "motion-fit"},
           {"template_percent", io::percent_of(fit.motion.template_phase)},
           {"template_points", fit.template_shape.points.size()},
           {"template_triangles", fit.template_shape.triangles.size()},
           {"cells", fit.motion.grid.cells},
           {"control_points", fit.motion.grid.point_count()},
           {"fitted", sums.fitted},
           {"bridged", sums.bridged},
           {"gaps", sums.gaps},
           {"mean_distance_mm", sums.distance},
           {"least_paired_share", sums.least_share},
           {"least_jacobian", sums.least_jacobian},
           {"new_self_intersections", sums.new_intersections},
           {"phases", Json::array()}};
  for (const PhaseFit& one : fit.phases) out["phases"].push_back(phase_json(one, images));
  return out;
}

std::string motion_fit_table(const Json& report) {
  const std::vector<std::string> columns{"percent",
                                         "origin",
                                         "stiffness",
                                         "rounds",
                                         "paired_share",
                                         "mean_distance_mm",
                                         "least_jacobian",
                                         "self_intersections",
                                         "source_self_intersections"};
  std::string text;
  for (const std::string& column : columns) text += (text.empty() ? "" : ",") + column;
  for (const Json& phase : report["phases"]) {
    std::string line;
    for (const std::string& column : columns) {
      const Json& value = phase[column];
      line += (line.empty() ? "" : ",") + (value.is_string() ? value.get<std::string>() : value.dump());
    }
    text += "\n" + line;
  }
  return text + "\n";
}

ExitCode verdict_of(const MotionFit& fit) {
  return pipeline::is_sound(fit) ? ExitCode::ok : ExitCode::quality_failed;
}

void print_motion_fit(const Json& report) {
  std::printf("%zu phases: %d fitted to %s %% at %d control points, %d bridged, %d gaps\n",
              report["phases"].size(), report["fitted"].get<int>(), report["template_percent"].dump().c_str(),
              report["control_points"].get<int>(), report["bridged"].get<int>(), report["gaps"].get<int>());
  std::printf("mean distance %.3f mm, least paired share %.3f, least Jacobian %.3f, %d new intersections\n",
              report["mean_distance_mm"].get<double>(), report["least_paired_share"].get<double>(),
              report["least_jacobian"].get<double>(), report["new_self_intersections"].get<int>());
}

}  // namespace ostia::app
