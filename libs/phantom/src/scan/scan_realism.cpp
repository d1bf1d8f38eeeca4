#include "ostia/phantom/scan_realism.h"

#include "ostia/core/error.h"

#include <cmath>
#include <string>
#include <variant>

namespace ostia::phantom {
namespace {

struct NamedMember {
  RealismMember is;
  std::variant<double ScanRealism::*, int ScanRealism::*, bool ScanRealism::*> at;
};

const std::vector<NamedMember>& named_members() {
  static const std::vector<NamedMember> members{
      {{"noise_structure", 0.0, 1.0}, &ScanRealism::noise_structure},
      {{"iterative", 0.0, 0.95}, &ScanRealism::iterative},
      {{"undershoot", 0.0, 0.15}, &ScanRealism::undershoot},
      {{"tail", 0.0, 0.4}, &ScanRealism::tail},
      {{"tail_fwhm_mm", 1.5, 10.0}, &ScanRealism::tail_fwhm_mm},
      {{"streaks", 0.0, 5.0}, &ScanRealism::streaks},
      {{"half_scan_motion_mm", 0.0, 10.0}, &ScanRealism::half_scan_motion_mm},
      {{"mixing", 0.0, 1.0}, &ScanRealism::mixing},
      {{"cava_hu", 0.0, 3000.0}, &ScanRealism::cava_hu},
      {{"sternal_wires", 0, 8, true}, &ScanRealism::sternal_wires},
      {{"clips", 0, 30, true}, &ScanRealism::clips},
      {{"ecg_leads", 0, 6, true}, &ScanRealism::ecg_leads},
      {{"pacemaker_leads", 0, 2, true}, &ScanRealism::pacemaker_leads},
      {{"stent_struts", 0, 1, true}, &ScanRealism::stent_struts}};
  return members;
}

const NamedMember& member_named(const std::string& name) {
  std::string all;
  for (const NamedMember& member : named_members()) {
    if (member.is.name == name) return member;
    all += (all.empty() ? "" : ", ") + member.is.name;
  }
  throw InvalidInput("scan: " + name + " is not known; there are " + all);
}

double value_at(const ScanRealism& realism, const NamedMember& member) {
  return std::visit([&](auto at) { return static_cast<double>(realism.*at); }, member.at);
}

std::string range_of(const RealismMember& member) {
  if (member.whole)
    return "whole and in [" + std::to_string(static_cast<int>(member.least)) + ", " +
           std::to_string(static_cast<int>(member.most)) + "]";
  return "in [" + std::to_string(member.least) + ", " + std::to_string(member.most) + "]";
}

void require_within(const RealismMember& member, double value) {
  const bool fits =
      value >= member.least && value <= member.most && (!member.whole || value == std::floor(value));
  if (!fits)
    throw InvalidInput("scan: " + member.name + " is " + std::to_string(value) + "; it must be " +
                       range_of(member));
}

}  // namespace

void validate(const ScanRealism& realism) {
  for (const NamedMember& member : named_members()) require_within(member.is, value_at(realism, member));
  if (realism.cava_hu > 0.0 && realism.cava_hu < 100.0)
    throw InvalidInput("scan: cava_hu is " + std::to_string(realism.cava_hu) +
                       "; contrast is 100 HU or more, 0: as drawn");
}

const std::vector<RealismMember>& realism_members() {
  static const std::vector<RealismMember> members = [] {
    std::vector<RealismMember> out;
    for (const NamedMember& member : named_members()) out.push_back(member.is);
    return out;
  }();
  return members;
}

double value_of(const ScanRealism& realism, const std::string& name) {
  return value_at(realism, member_named(name));
}

void set_value(ScanRealism& realism, const std::string& name, double value) {
  const NamedMember& member = member_named(name);
  require_within(member.is, value);
  std::visit(
      [&](auto at) {
        using Value = std::decay_t<decltype(realism.*at)>;
        realism.*at = static_cast<Value>(value);
      },
      member.at);
}

}  // namespace ostia::phantom
