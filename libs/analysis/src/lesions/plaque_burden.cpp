#include "ostia/analysis/plaque_burden.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <cmath>

namespace ostia::analysis {
namespace {

constexpr std::array burdens{PlaqueBurden::none, PlaqueBurden::p1, PlaqueBurden::p2, PlaqueBurden::p3,
                             PlaqueBurden::p4};
constexpr std::array amounts{PlaqueAmount::none, PlaqueAmount::mild, PlaqueAmount::moderate,
                             PlaqueAmount::severe};
constexpr int standard_segments = 18;

}  // namespace

std::string to_string(PlaqueBurden burden) {
  return burden == PlaqueBurden::none ? "none" : "P" + std::to_string(static_cast<int>(burden));
}

PlaqueBurden plaque_burden(const std::string& text) {
  for (const PlaqueBurden one : burdens)
    if (to_string(one) == text) return one;
  throw InvalidInput("a plaque burden is \"" + text + "\"; it can be none, P1, P2, P3 or P4");
}

std::string description(PlaqueBurden burden) {
  switch (burden) {
    case PlaqueBurden::none:
      return "no plaque";
    case PlaqueBurden::p1:
      return "mild";
    case PlaqueBurden::p2:
      return "moderate";
    case PlaqueBurden::p3:
      return "severe";
    case PlaqueBurden::p4:
      break;
  }
  return "extensive";
}

PlaqueBurden burden_by_segments(int segments) {
  if (segments < 0 || segments > standard_segments)
    throw InvalidInput("plaque in " + std::to_string(segments) + " segments; there are 0 to " +
                       std::to_string(standard_segments));
  if (segments >= 8) return PlaqueBurden::p4;
  if (segments >= 5) return PlaqueBurden::p3;
  if (segments >= 3) return PlaqueBurden::p2;
  return segments >= 1 ? PlaqueBurden::p1 : PlaqueBurden::none;
}

double whole_agatston(double agatston) {
  return agatston > 0.0 ? std::max(1.0, std::round(agatston)) : 0.0;
}

PlaqueBurden burden_by_calcium(double agatston) {
  if (!(agatston >= 0.0) || !std::isfinite(agatston))
    throw InvalidInput("a calcium score of " + std::to_string(agatston) + "; an Agatston score is 0 or more");
  if (agatston == 0.0) return PlaqueBurden::none;
  const double whole = whole_agatston(agatston);
  if (whole >= 1000.0) return PlaqueBurden::p4;
  if (whole >= 301.0) return PlaqueBurden::p3;
  return whole >= 101.0 ? PlaqueBurden::p2 : PlaqueBurden::p1;
}

std::string to_string(PlaqueAmount amount) {
  switch (amount) {
    case PlaqueAmount::none:
      return "none";
    case PlaqueAmount::mild:
      return "mild";
    case PlaqueAmount::moderate:
      return "moderate";
    case PlaqueAmount::severe:
      break;
  }
  return "severe";
}

PlaqueAmount plaque_amount(const std::string& text) {
  for (const PlaqueAmount one : amounts)
    if (to_string(one) == text) return one;
  throw InvalidInput("an amount of plaque is \"" + text + "\"; it can be none, mild, moderate or severe");
}

PlaqueBurden burden_by_sight(const std::array<PlaqueAmount, 3>& vessels) {
  const auto from = [&](PlaqueAmount least) {
    return std::count_if(vessels.begin(), vessels.end(), [=](PlaqueAmount one) { return one >= least; });
  };
  const auto severe = from(PlaqueAmount::severe), moderate = from(PlaqueAmount::moderate);
  if (severe >= 2) return PlaqueBurden::p4;
  if (severe == 1 || moderate == 3) return PlaqueBurden::p3;
  const auto any = from(PlaqueAmount::mild);
  if (moderate >= 1 || any == 3) return PlaqueBurden::p2;
  return any >= 1 ? PlaqueBurden::p1 : PlaqueBurden::none;
}

}  // namespace ostia::analysis
