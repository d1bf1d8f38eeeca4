#include "ostia/analysis/cad_rads.h"
#include "ostia/core/error.h"

#include <array>
#include <cmath>

namespace ostia::analysis {
namespace {

constexpr std::array tests{Ischaemia::not_tested, Ischaemia::negative, Ischaemia::borderline,
                           Ischaemia::positive};

std::string sign_of(Ischaemia ischaemia) {
  return ischaemia == Ischaemia::positive ? "+" : ischaemia == Ischaemia::negative ? "-" : "\u00b1";
}

}  // namespace

std::string to_string(Ischaemia ischaemia) {
  switch (ischaemia) {
    case Ischaemia::not_tested:
      return "not tested";
    case Ischaemia::negative:
      return "negative";
    case Ischaemia::borderline:
      return "borderline";
    case Ischaemia::positive:
      break;
  }
  return "positive";
}

Ischaemia ischaemia(const std::string& text) {
  for (const Ischaemia one : tests)
    if (to_string(one) == text) return one;
  throw InvalidInput("a test for ischaemia is \"" + text +
                     "\"; it can be not tested, negative, borderline or positive");
}

Ischaemia ischaemia_of_ffr(double ffr_ct) {
  constexpr double largest = 1.2;  // noise lifts what is 1
  if (!(ffr_ct >= 0.0 && ffr_ct <= largest))
    throw InvalidInput("an FFR of " + std::to_string(ffr_ct) + "; it is a pressure over another, 0 to 1");
  const long hundredths = std::lround(100.0 * ffr_ct);
  if (hundredths <= 75) return Ischaemia::positive;
  return hundredths <= 80 ? Ischaemia::borderline : Ischaemia::negative;
}

std::string to_string(const CadRadsStatement& statement) {
  const PatientCategory& category = statement.category;
  std::string text = category.category ? to_string(*category.category) : "N";
  if (statement.burden != PlaqueBurden::none) text += "/" + to_string(statement.burden);
  if (category.category && category.not_diagnostic) text += "/N";
  if (statement.high_risk_plaque) text += "/HRP";
  if (statement.ischaemia != Ischaemia::not_tested) text += "/I" + sign_of(statement.ischaemia);
  if (statement.stent) text += "/S";
  if (statement.graft) text += "/G";
  if (statement.exception) text += "/E";
  return text;
}

std::string further_investigation(const PatientCategory& category) {
  if (!category.category) return "additional or other evaluation may be needed";
  switch (*category.category) {
    case CadRads::zero:
    case CadRads::one:
    case CadRads::two:
      return "none";
    case CadRads::three:
      return "functional assessment can be considered";
    case CadRads::four_a:
      return "invasive angiography or functional assessment can be considered";
    case CadRads::four_b:
      return "invasive angiography is recommended";
    case CadRads::five:
      break;
  }
  return "invasive angiography, functional assessment or assessment of viability can be considered";
}

}  // namespace ostia::analysis
