#include "ostia/analysis/stenosis.h"
#include "ostia/core/error.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace ostia::analysis {
namespace {

/// As a report shows it: whole percents; but only what is shut is 100 %.
int whole_percent(double percent) {
  if (!(percent <= 100.0 + 1e-9))  // also what is not a number
    throw InvalidInput("a stenosis of " + std::to_string(percent) + " % of the diameter; give at most 100 %");
  if (percent >= 100.0 - 1e-9) return 100;
  return std::clamp(static_cast<int>(std::lround(std::max(percent, 0.0))), 0, 99);
}

}  // namespace

CadRads cad_rads(double diameter_percent) {
  const int percent = whole_percent(diameter_percent);
  if (percent == 100) return CadRads::five;
  if (percent >= 70) return CadRads::four_a;
  if (percent >= 50) return CadRads::three;
  if (percent >= 25) return CadRads::two;
  return percent >= 1 ? CadRads::one : CadRads::zero;
}

CadRads cad_rads(const std::vector<GradedStenosis>& stenoses) {
  CadRads largest = CadRads::zero;
  bool left_main = false;
  std::set<std::string> severe;
  for (const GradedStenosis& stenosis : stenoses) {
    largest = std::max(largest, cad_rads(stenosis.diameter_percent));
    const int percent = whole_percent(stenosis.diameter_percent);
    const std::string& vessel = stenosis.main_vessel;
    if (vessel == "LM" && percent >= 50) left_main = true;
    if ((vessel == "LAD" || vessel == "LCX" || vessel == "RCA") && percent >= 70) severe.insert(vessel);
  }
  if (largest == CadRads::five) return largest;
  return left_main || severe.size() == 3 ? CadRads::four_b : largest;
}

PatientCategory patient_category(const std::vector<GradedStenosis>& stenoses, bool all_judged) {
  const CadRads found = cad_rads(stenoses);
  if (all_judged) return {found, false};
  if (found >= CadRads::three) return {found, true};
  return {std::nullopt, true};
}

std::string to_string(const PatientCategory& category) {
  if (!category.category) return "N";
  return to_string(*category.category) + (category.not_diagnostic ? "/N" : "");
}

std::string description(const PatientCategory& category) {
  if (!category.category) return "Not diagnostic: obstructive disease is not excluded";
  return description(*category.category) +
         (category.not_diagnostic ? "; not diagnostic elsewhere, where there may be more" : "");
}

std::string to_string(CadRads category) {
  switch (category) {
    case CadRads::zero:
      return "0";
    case CadRads::one:
      return "1";
    case CadRads::two:
      return "2";
    case CadRads::three:
      return "3";
    case CadRads::four_a:
      return "4A";
    case CadRads::four_b:
      return "4B";
    case CadRads::five:
      return "5";
  }
  throw InvalidInput("a CAD-RADS category that is none of the seven");
}

std::string description(CadRads category) {
  switch (category) {
    case CadRads::zero:
      return "No stenosis (0 %)";
    case CadRads::one:
      return "Minimal stenosis (1-24 %)";
    case CadRads::two:
      return "Mild stenosis (25-49 %)";
    case CadRads::three:
      return "Moderate stenosis (50-69 %)";
    case CadRads::four_a:
      return "Severe stenosis (70-99 %)";
    case CadRads::four_b:
      return "Left main stenosis from 50 % or severe stenoses of three vessels (70-99 %)";
    case CadRads::five:
      return "Total occlusion (100 %)";
  }
  throw InvalidInput("a CAD-RADS category that is none of the seven");
}

}  // namespace ostia::analysis
