// The tables of docs/methods/coronary-labels.md, and the curve of libs/coronary/src/name_certainty.cpp.

#include "picture.h"
#include "varied_tree.h"

#include "ostia/coronary/labels.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <map>
#include <numbers>
#include <string>
#include <vector>

namespace {

using namespace ostia;

struct Judged {
  double said = 0.0;
  bool right = false;
};

std::vector<Judged> judged_names(std::uint64_t first, std::uint64_t last) {
  std::vector<Judged> all;
  int otherwise = 0;
  for (std::uint64_t seed = first; seed <= last; ++seed) {
    const testing::VariedTree varied = testing::varied_tree(seed);
    const coronary::LabelledTree found = coronary::label_branches(varied.tree);
    otherwise += found.lie.as_given ? 0 : 1;
    for (const coronary::VesselLabel& label : found.labels) {
      const auto truth = varied.kinds.find(label.vessel);
      if (truth == varied.kinds.end() || label.likeliest.empty()) continue;
      const std::string kind = label.likeliest.substr(0, label.likeliest.find_first_of("0123456789"));
      all.push_back({label.confidence, kind == truth->second});
    }
  }
  std::printf("thought to be mirrored or turned: %d\n", otherwise);
  return all;
}

double logit(double p) {
  constexpr double least = 1e-3;
  const double bounded = std::clamp(p, least, 1.0 - least);
  return std::log(bounded / (1.0 - bounded));
}

/// Offset and slope of the logit by which names would be right as often as said (Newton's method).
void fit(const std::vector<Judged>& names) {
  double offset = 0.0, slope = 1.0;
  for (int step = 0; step < 50; ++step) {
    double g0 = 0.0, g1 = 0.0, h00 = 1e-9, h01 = 0.0, h11 = 1e-9;
    for (const Judged& one : names) {
      const double x = logit(one.said), p = 1.0 / (1.0 + std::exp(-(offset + slope * x)));
      const double off = (one.right ? 1.0 : 0.0) - p, weight = p * (1.0 - p);
      g0 += off;
      g1 += off * x;
      h00 += weight;
      h01 += weight * x;
      h11 += weight * x * x;
    }
    const double det = h00 * h11 - h01 * h01;
    offset += (h11 * g0 - h01 * g1) / det;
    slope += (h00 * g1 - h01 * g0) / det;
  }
  std::printf("offset %.3f slope %.3f\n", offset, slope);
}

void print_reliability(const std::vector<Judged>& names) {
  constexpr int bins = 10;
  double error = 0.0;
  for (int bin = 0; bin < bins; ++bin) {
    double said = 0.0, right = 0.0, count = 0.0;
    for (const Judged& one : names) {
      if (std::min(bins - 1, static_cast<int>(one.said * bins)) != bin) continue;
      said += one.said;
      right += one.right ? 1.0 : 0.0;
      count += 1.0;
    }
    if (count == 0.0) continue;
    error += std::abs(said - right) / static_cast<double>(names.size());
    std::printf("%.2f %.2f %.0f\n", said / count, right / count, count);
  }
  std::printf("expected calibration error %.3f of %zu names\n", error, names.size());
}

geometry::VesselTree turned(geometry::VesselTree tree, int axis, double degrees) {
  const geometry::Mat3 by =
      Eigen::AngleAxisd(degrees * std::numbers::pi / 180.0, geometry::Vec3::Unit(axis)).toRotationMatrix();
  for (geometry::TreeNode& node : tree.nodes) node.position = by * node.position;
  for (geometry::TreeSegment& segment : tree.segments) {
    for (geometry::Vec3& point : segment.axis.points) point = by * point;
    geometry::complete(segment.axis);
  }
  return tree;
}

const char* word(phantom::Dominance dominance) {
  return dominance == phantom::Dominance::right  ? "right"
         : dominance == phantom::Dominance::left ? "left"
                                                 : "balanced";
}

/// How often vessels get the names that they were drawn as.
struct Counted {
  int mains = 0, mains_right = 0, branches = 0, branches_right = 0, wrong = 0, trees = 0, dominance = 0;
  std::map<std::string, int> faults;
  void add(const geometry::VesselTree& truth, phantom::Dominance dominance_drawn) {
    const coronary::LabelledTree found = coronary::label_branches(truth);
    ++trees;
    dominance += std::string(coronary::word(found.dominance)) == word(dominance_drawn) ? 1 : 0;
    for (const geometry::Vessel& vessel : found.tree.vessels)
      for (const geometry::Vessel& drawn : truth.vessels) {
        if (drawn.id != vessel.id) continue;
        const bool right = drawn.name == vessel.name;
        const bool main = drawn.name == "LAD" || drawn.name == "LCX" || drawn.name == "RCA";
        (main ? mains : branches) += 1;
        (main ? mains_right : branches_right) += right ? 1 : 0;
        wrong += !right && vessel.name.front() != 'V' ? 1 : 0;
        if (!right)
          faults[drawn.name + " " + (vessel.name.front() == 'V' ? "without name" : vessel.name)] += 1;
      }
  }
  void print(const char* what) const {
    std::printf("%s: main vessels %d of %d, branches %d of %d, wrong names %d, dominance %d of %d\n", what,
                mains_right, mains, branches_right, branches, wrong, dominance, trees);
    for (const auto& [fault, times] : faults) std::printf("  %s: %d\n", fault.c_str(), times);
  }
};

template <class Change>
void count(const char* what, std::uint64_t first, std::uint64_t last, const Change& change) {
  Counted counted;
  for (std::uint64_t seed = first; seed <= last; ++seed) {
    const phantom::CoronaryTree drawn =
        phantom::draw_coronaries(phantom::draw_heart(seed), {.seed = seed, .disease = 0.0});
    change(drawn, [&](const geometry::VesselTree& truth) { counted.add(truth, drawn.dominance); });
  }
  counted.print(what);
}

void print_names() {
  const auto part = [](const char* what, double share) {
    count(what, 1, 60, [&](const phantom::CoronaryTree& drawn, const auto& add) {
      add(phantom::vessel_tree(testing::first_part(drawn, share)));
    });
  };
  const auto wide = [](const char* what, double radius_mm) {
    count(what, 1, 60, [&](const phantom::CoronaryTree& drawn, const auto& add) {
      add(phantom::vessel_tree(testing::wide_part(drawn, radius_mm)));
    });
  };
  const auto turned_by = [](const char* what, double degrees) {
    count(what, 1, 20, [&](const phantom::CoronaryTree& drawn, const auto& add) {
      for (int axis = 0; axis < 3; ++axis)
        for (const double sign : {-1.0, 1.0}) add(turned(phantom::vessel_tree(drawn), axis, sign * degrees));
    });
  };
  const auto whole = [](const phantom::CoronaryTree& drawn, const auto& add) {
    add(phantom::vessel_tree(drawn));
  };
  count("seeds 1-20", 1, 20, whole);
  count("seeds 21-140", 21, 140, whole);
  turned_by("turned by 12 degrees", 12.0);
  turned_by("turned by 20 degrees", 20.0);
  wide("wider than 1.5 mm", 0.75);
  wide("wider than 2 mm", 1.0);
  part("first 80 %", 0.8);
  part("first 60 %", 0.6);
  part("first 40 %", 0.4);
}

}  // namespace

int main(int argc, char** argv) {
  return bench::make_picture(argc, argv, "FIRST LAST", 2, [](const std::vector<std::string>& a) {
    const std::vector<Judged> names = judged_names(std::stoull(a[0]), std::stoull(a[1]));
    print_reliability(names);
    fit(names);
    print_names();
  });
}
