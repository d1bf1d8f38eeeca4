#include "coronaries/coronary_segments.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

namespace ostia::phantom {

void add_segments(CoronaryVessel& vessel, const CoronaryTree& tree, Dominance dominance) {
  const double length = vessel.axis.abscissa.back();
  const auto origin = [&](const std::string& child, double otherwise) {
    for (const CoronaryVessel& v : tree.vessels) {
      if (v.name == child && v.parent == vessel.id) return v.parent_s_mm;
    }
    return otherwise;
  };
  const auto span = [&](int aha, std::string name, double from, double to) {
    if (to > from + 0.5) vessel.segments.push_back({aha, std::move(name), from, std::min(to, length)});
  };
  if (vessel.name == "LAD") {
    const double main = origin("LCX", 10.0), first = origin("D1", main + 20.0);
    const double second = std::max(origin("D2", main + 45.0), first + 5.0);
    span(5, "left main", 0.0, main);
    span(6, "proximal LAD", main, first);
    span(7, "mid LAD", first, second);
    span(8, "distal LAD", second, length);
  } else if (vessel.name == "LCX") {
    const double first = origin("OM1", 15.0);
    span(11, "proximal LCX", 0.0, first);
    span(13, "distal LCX", first, length);
  } else if (vessel.name == "RCA") {
    const double crux = origin("PDA", length), half = 0.5 * std::min(origin("AM", 0.5 * crux), crux);
    span(1, "proximal RCA", 0.0, half);
    span(2, "mid RCA", half, 2.0 * half);
    span(3, "distal RCA", 2.0 * half, crux);
    span(16, "posterolateral branch", crux, length);
  } else {
    static const std::map<std::string, std::pair<int, const char*>> numbers{
        {"D1", {9, "first diagonal"}},
        {"D2", {10, "second diagonal"}},
        {"OM1", {12, "first obtuse marginal"}},
        {"OM2", {14, "second obtuse marginal"}},
        {"RI", {17, "ramus intermedius"}}};
    const auto at = numbers.find(vessel.name);
    if (at != numbers.end()) span(at->second.first, at->second.second, 0.0, length);
    if (vessel.name == "PDA") {
      const bool left = dominance == Dominance::left;
      span(left ? 15 : 4, left ? "left posterior descending" : "posterior descending", 0.0, length);
    }
  }
}

}  // namespace ostia::phantom
