#include "ostia/session/patient_tree.h"

#include "ostia/analysis/aha_segments.h"
#include "ostia/core/error.h"
#include "ostia/core/text.h"
#include "ostia/imaging/image_axes.h"
#include "ostia/phantom/patient_heart.h"
#include "ostia/session/found_model.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace ostia::session {
namespace {

constexpr double patient_step_mm = 0.5, patient_even_mm = 1.0;

/// Of a circle as large as the section through the wall's samples about an abscissa.
double section_radius(const lumen::VesselLumen& vessel, double s_mm) {
  double sum = 0.0, all = 0.0;
  for (const lumen::SurfaceSample& sample : vessel.samples) {
    const double d = (sample.s_mm - s_mm) / patient_even_mm;
    if (std::abs(d) > 3.0 || sample.origin == lumen::SampleOrigin::cap) continue;
    const double weight = std::exp(-0.5 * d * d);
    sum += weight * (sample.position - vessel.axis->point(sample.s_mm)).squaredNorm();
    all += weight;
  }
  return all > 0.0 ? std::sqrt(sum / all) : vessel.axis->radius(s_mm);
}

phantom::PatientVessel patient_vessel(const lumen::VesselLumen& vessel, const std::string& name) {
  phantom::PatientVessel out;
  out.name = analysis::usual_name(name);
  const double from = vessel.own_from_mm, length = vessel.axis->length() - from;
  const int steps = std::max(4, static_cast<int>(std::ceil(length / patient_step_mm)));
  for (int i = 0; i <= steps; ++i) {
    const double s = from + length * i / steps;
    out.points.push_back(vessel.axis->point(s));
    out.radius_mm.push_back(std::max(0.1, section_radius(vessel, s)));
  }
  return out;
}

void take_labels(const coronary::LabelledTree& labelled, phantom::PatientTree& tree) {
  using coronary::CoronaryDominance;
  tree.long_axis = labelled.long_axis;
  if (labelled.dominance == CoronaryDominance::right) tree.dominance = phantom::Dominance::right;
  if (labelled.dominance == CoronaryDominance::left) tree.dominance = phantom::Dominance::left;
  if (labelled.dominance == CoronaryDominance::balanced) tree.dominance = phantom::Dominance::balanced;
}

phantom::PatientTree axes_and_radii(const lumen::LumenModel& model) {
  constexpr double least_mm = 2.0;
  phantom::PatientTree tree;
  const std::size_t n = model.vessels.size();
  std::map<std::int32_t, std::size_t> index;
  for (std::size_t i = 0; i < n; ++i) index[model.tree.vessels[i].id] = i;
  std::vector<std::int32_t> place(n, -1);
  // Parents first: from the root on, whoever's parent is there.
  for (bool more = true; more;) {
    more = false;
    for (std::size_t i = 0; i < n; ++i) {
      const lumen::VesselLumen& vessel = *model.vessels[i];
      if (place[i] >= 0 || vessel.axis->length() - vessel.own_from_mm < least_mm) continue;
      std::int32_t parent = -1;
      if (vessel.own_from_mm > 1e-6) {
        parent = place[index.at(lumen::owner_at(model.tree, vessel.vessel, vessel.own_from_mm - 1e-3))];
        if (parent < 0) continue;
      }
      phantom::PatientVessel one = patient_vessel(vessel, model.tree.vessels[i].name);
      one.parent = parent;
      place[i] = static_cast<std::int32_t>(tree.vessels.size());
      tree.vessels.push_back(std::move(one));
      more = true;
    }
  }
  return tree;
}

/// A file's vessels in one of the ways in which its axes may run.
struct Way {
  std::string axes;
  phantom::PatientTree tree;
  bool sure = false;  ///< its main vessels have names
  double cost = 1e9;  ///< half of what it is off, in squares of what is usual
  double probability = 0.0;
};

double cost_of(const phantom::PatientTree& tree, std::uint64_t seed) {
  constexpr double height_mm = 4.0, groove_mm = 6.0, size_share = 0.1, no_name = 2.0, no_right = 3.0;
  const phantom::PatientLie lie = phantom::lie_of(tree, phantom::draw_heart(seed));
  if (!lie.left) return 1e9;
  double cost = std::pow(lie.height_mm / height_mm, 2.0) + std::pow(lie.groove_mm / groove_mm, 2.0);
  for (int a = 0; a < 3; ++a) cost += 0.5 * std::pow(std::log(lie.size[a]) / size_share, 2.0);
  if (!lie.right) cost += no_right;
  for (const char* name : {"LCX", "RCA"})
    if (std::ranges::none_of(tree.vessels, [&](const phantom::PatientVessel& v) { return v.name == name; }))
      cost += no_name;
  return cost;
}

Way way_of(const imaging::MaskVolume& labels, std::string axes, std::uint64_t seed,
           const core::TaskContext& task) {
  Way way;
  way.axes = std::move(axes);
  const MaskModel model = model_of_mask(labels, nullptr, {}, task);
  way.tree = axes_and_radii(model.found.model);
  take_labels(model.tree.vessels, way.tree);
  way.tree.remarks = model.found.found.warnings;
  const auto has = [&](const char* name) {
    return std::ranges::any_of(way.tree.vessels,
                               [&](const phantom::PatientVessel& v) { return v.name == name; });
  };
  way.sure = has("LAD") && has("LCX") && has("RCA");
  way.cost = cost_of(way.tree, seed);
  return way;
}

/// The other seven ways in which three axes may run.
std::vector<std::string> other_axes(const std::string& axes) {
  const std::map<char, char> opposite{{'L', 'R'}, {'R', 'L'}, {'P', 'A'}, {'A', 'P'}, {'S', 'I'}, {'I', 'S'}};
  std::vector<std::string> out;
  for (unsigned which = 1; which < 8; ++which) {
    std::string other = axes;
    for (unsigned a = 0; a < 3; ++a)
      if ((which >> a) & 1U) other[a] = opposite.at(other[a]);
    out.push_back(std::move(other));
  }
  return out;
}

/// Of what a file says nine in ten are right; the others share the rest.
void set_probabilities(std::vector<Way>& ways) {
  constexpr double as_said = 0.9;
  double all = 0.0, best = 1e9;
  for (const Way& way : ways) best = std::min(best, way.cost);
  for (std::size_t i = 0; i < ways.size(); ++i) {
    const double prior = i == 0 ? as_said : (1.0 - as_said) / 7.0;
    ways[i].probability = ways[i].cost > 1e8 ? 0.0 : prior * std::exp(best - ways[i].cost);
    all += ways[i].probability;
  }
  for (Way& way : ways) way.probability /= std::max(1e-300, all);
}

}  // namespace

phantom::PatientTree patient_of_mask(const imaging::MaskVolume& labels, std::uint64_t seed,
                                     const core::TaskContext& task) {
  constexpr double good_cost = 14.0, least_probability = 0.8;
  const std::string axes = imaging::axes_of(labels.geometry);
  std::vector<Way> ways{way_of(labels, axes, seed, task.sub(0.0, 0.4))};
  if (ways.front().sure && ways.front().cost < good_cost) return std::move(ways.front().tree);
  const imaging::AxesGiven as_read{labels.geometry, false};
  for (const std::string& other : other_axes(axes)) {
    task.throw_if_cancelled();
    try {
      ways.push_back(way_of(imaging::laid(labels, as_read, imaging::given_axes(labels.geometry, other)),
                            other, seed, task.sub(0.4, 1.0)));
    } catch (const Error&) {
      continue;  // no tree that way round
    }
  }
  set_probabilities(ways);
  const auto best = std::ranges::max_element(ways, {}, &Way::probability);
  if (!(best->probability > 0.0))
    throw GeometryError(
        "none of its vessels is a left anterior descending artery, whichever way its axes run; is it a "
        "mask of coronary arteries, with the right voxel size?");
  const std::string sure = core::rounded_text(best->probability, 2);
  if (best == ways.begin()) {
    if (!best->sure || best->probability < least_probability)
      best->tree.remarks.push_back(
          "its main arteries are in doubt; that its axes run as the file says has a probability of " + sure);
    return std::move(best->tree);
  }
  if (best->probability < least_probability)
    throw GeometryError("its arteries lie on no heart as its axes (" + axes +
                        ") say, and which way they do is not sure (" + best->axes +
                        " with a probability of " + sure + "); turn it, or name its vessels in a case");
  best->tree.remarks.push_back("its arteries lie on no heart as its axes (" + axes + ") say; it was " +
                               (imaging::mirrored(axes, best->axes) ? "mirrored" : "turned") + " to " +
                               best->axes + " (probability " + sure + ")");
  return std::move(best->tree);
}

phantom::PatientTree patient_of(const lumen::LumenModel& model) {
  phantom::PatientTree tree = axes_and_radii(model);
  take_labels(coronary::label_branches(model.tree), tree);
  return tree;
}

}  // namespace ostia::session
