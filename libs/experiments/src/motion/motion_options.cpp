// What the motion experiment may be asked.
#include "ostia/core/error.h"
#include "ostia/experiments/motion.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ostia::experiments {
namespace {

struct Word {
  MotionMethod method;
  const char* text;
};
constexpr std::array<Word, 9> words{{{MotionMethod::none, "none"},
                                     {MotionMethod::cage, "cage"},
                                     {MotionMethod::cage_rest, "cage-rest"},
                                     {MotionMethod::descent, "descent"},
                                     {MotionMethod::descent_free, "descent-free"},
                                     {MotionMethod::tps_l2, "tps-l2"},
                                     {MotionMethod::tps_kc, "tps-kc"},
                                     {MotionMethod::grbf_l2, "grbf-l2"},
                                     {MotionMethod::grbf_kc, "grbf-kc"}}};

}  // namespace

const char* word(MotionMethod method) {
  for (const Word& one : words)
    if (one.method == method) return one.text;
  return "";
}

MotionMethod motion_method_of(const std::string& text) {
  std::string known;
  for (const Word& one : words) {
    if (text == one.text) return one.method;
    known += (known.empty() ? "" : ", ") + std::string(one.text);
  }
  throw InvalidInput("there is no method " + text + "; there are " + known);
}

void validate(const MotionOptions& o) {
  validate(o.heart);
  if (o.hearts < 1 || o.hearts > 100)
    throw InvalidInput("motion of " + std::to_string(o.hearts) + " hearts: 1 to 100 can be studied");
  for (const MotionMethod method : o.methods)
    if (method <= MotionMethod::cage)
      throw InvalidInput(std::string("the method ") + word(method) + " is run anyway: leave it out");
  const bool mixtures = std::any_of(o.methods.begin(), o.methods.end(),
                                    [](MotionMethod method) { return method >= MotionMethod::tps_l2; });
  if (mixtures && o.depth > 4)
    throw InvalidInput("thin-plate splines and Gaussian basis functions go to depth 4, not " +
                       std::to_string(o.depth));
  for (const double phase : o.methods.empty() ? std::vector<double>() : o.compared_phases) {
    const double number = phase * o.heart.phases;
    if (!(phase >= 0.0 && phase < 1.0) || std::abs(number - std::round(number)) > 1e-6 ||
        std::lround(number) >= o.heart.phases)
      throw InvalidInput("methods cannot be compared at " + std::to_string(100.0 * phase) + " %: there are " +
                         std::to_string(o.heart.phases) + " phases, from 0 % on");
  }
  for (const int depth : o.depths)
    if (depth < 1 || depth > 5) throw InvalidInput("a cage's depth must lie in [1, 5]");
  if (std::find(o.depths.begin(), o.depths.end(), o.depth) == o.depths.end())
    throw InvalidInput("the depth " + std::to_string(o.depth) + " that is compared must be among all depths");
}

}  // namespace ostia::experiments
