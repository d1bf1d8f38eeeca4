// Cases of the pressure experiment, drawn from seeds.

#include "ostia/experiments/pressure_plan.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"
#include "ostia/hemodynamics/conditions.h"
#include "ostia/hemodynamics/stenosis_formulas.h"
#include "ostia/phantom/noise.h"
#include "ostia/solver/boundary_conditions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

namespace ostia::experiments {
namespace {

constexpr double most_reynolds = 600.0;
constexpr double before_mm = 7.0, behind_mm = 28.0;  // of the narrowings
constexpr double least_throat_mm = 0.45;
constexpr double split_exponent = 2.27;
constexpr double axis_bend_share = 0.6;  // of what would fold the wall, that an axis is moved aside

constexpr std::array<std::pair<PressureKind, std::string_view>, 8> kind_names{
    {{PressureKind::tube, "tube"},
     {PressureKind::concentric, "concentric"},
     {PressureKind::eccentric, "eccentric"},
     {PressureKind::tapered, "tapered"},
     {PressureKind::bend, "bend"},
     {PressureKind::series, "series"},
     {PressureKind::fork, "fork"},
     {PressureKind::patient, "patient"}}};
/// Trunk, main branch, side branch.
constexpr std::array<std::string_view, 7> medina_kinds{"1,1,1", "1,1,0", "1,0,1", "0,1,1",
                                                       "1,0,0", "0,1,0", "0,0,1"};

/// Numbers of one seed, one after the other.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : seed_(seed) {}
  double in(double low, double high) {
    return low + (high - low) * phantom::uniform(seed_ ^ 0x7072657373757265ULL, next_++);
  }

 private:
  std::uint64_t seed_, next_ = 0;
};

/// Within the `strip`-th of n even strips of a range.
double spread(Draw& draw, double low, double high, int strip, int n) {
  const double width = (high - low) / n;
  return draw.in(low + width * strip, low + width * (strip + 1));
}

/// Another order of n strips, the same for every plan.
int shuffled(int i, int n) {
  const auto key = [](int k) { return phantom::uniform(0x666c6f77, static_cast<std::uint64_t>(k)); };
  int rank = 0;
  for (int k = 0; k < n; ++k) rank += key(k) < key(i) ? 1 : 0;
  return rank;
}

/// The digits of i to base 3, mirrored at the point: 0, 1/3, 2/3, 1/9, 4/9, ...
double mirrored(int i) {
  double sum = 0.0, digit = 1.0;
  for (; i > 0; i /= 3) sum += (digit /= 3.0) * (i % 3);
  return sum;
}

/// 0 to n - 1 in an order whose beginnings lie evenly in it, odd and even in turn.
std::vector<int> even_order(int n) {
  std::vector<int> order(static_cast<std::size_t>(n));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [](int a, int b) { return mirrored(a) < mirrored(b); });
  return order;
}

PlannedStenosis stenosis_of(Draw& draw, double severity, double least_mm, double most_mm) {
  PlannedStenosis one;
  one.severity = severity;
  one.length_mm = draw.in(least_mm, most_mm);
  one.shoulder_mm = one.length_mm * draw.in(0.25, 0.5);
  return one;
}

double calibre_at(const PressureCase& one, int vessel, double s_mm) {
  if (one.fork_mm > 0.0 && s_mm > one.fork_mm) return vessel == 0 ? one.main_mm : one.side_mm;
  return one.diameter_mm * (1.0 - one.taper * std::clamp(s_mm / one.length_mm, 0.0, 1.0));
}

double throat_mm(const PressureCase& one, const PlannedStenosis& stenosis) {
  return calibre_at(one, stenosis.vessel, stenosis.at_mm) * (1.0 - stenosis.severity);
}

/// No throat is narrower than what CT tells, nor its middle so far aside that the wall would fold.
void keep_within_reason(PressureCase& one) {
  for (PlannedStenosis& s : one.stenoses) {
    const double calibre = calibre_at(one, s.vessel, s.at_mm);
    s.severity = std::min(s.severity, 1.0 - least_throat_mm / calibre);
    const double bend =
        std::pow(std::numbers::pi / s.shoulder_mm, 2);  // of a shift by 2 mm along the shoulder
    s.aside_mm = std::min(s.aside_mm, axis_bend_share * 2.0 / (bend * 0.5 * calibre));
  }
}

/// Share of the root's flow that passes a narrowing.
double share_of(const PressureCase& one, const PlannedStenosis& s) {
  if (one.fork_mm <= 0.0 || s.at_mm < one.fork_mm) return 1.0;
  const double main = std::pow(one.main_mm, split_exponent), side = std::pow(one.side_mm, split_exponent);
  return (s.vessel == 0 ? main : side) / (main + side);
}

double formula_drop_pa(const PressureCase& one, double flow_ml_s) {
  double drop = 0.0;
  for (const PlannedStenosis& s : one.stenoses) {
    hemodynamics::StenosisCase formula;
    formula.vessel_diameter_mm = calibre_at(one, s.vessel, s.at_mm);
    formula.throat_diameter_mm = throat_mm(one, s);
    formula.length_mm = s.length_mm - s.shoulder_mm;
    formula.flow_ml_s = flow_ml_s * share_of(one, s);
    drop += hemodynamics::stenosis_formulas(formula).front().pa;
  }
  return drop;
}

/// What the bed draws through the narrowings as a published formula has them, so that the plan owes nothing
/// to the model that is judged; and no more than the largest Reynolds number.
void set_flow(PressureCase& one) {
  const hemodynamics::Conditions c;
  const double head = (c.mean_aortic_mmhg() - c.venous_mmhg) * hemodynamics::pa_of_mmhg;
  const double bed = one.dilation * head / solver::usual_flow_ml_s(one.diameter_mm);
  double low = 0.0, high = head / bed;
  for (int i = 0; i < 60; ++i) {
    const double flow = 0.5 * (low + high);
    (bed * flow + formula_drop_pa(one, flow) < head ? low : high) = flow;
  }
  const double per_flow = 4.0 * c.density_kg_m3 * 1e-6 / (std::numbers::pi * 1e-3 * c.viscosity_mpa_s * 1e-3);
  double of_one_ml_s = one.stenoses.empty() ? per_flow / one.diameter_mm : 0.0;
  for (const PlannedStenosis& s : one.stenoses)
    of_one_ml_s = std::max(of_one_ml_s, per_flow * share_of(one, s) / throat_mm(one, s));
  one.flow_ml_s = std::min(0.5 * (low + high), most_reynolds / of_one_ml_s);
  one.reynolds = one.flow_ml_s * of_one_ml_s;
}

void make_single(PressureCase& one, Draw& draw, double severity) {
  PlannedStenosis first = stenosis_of(draw, severity, one.kind == PressureKind::eccentric ? 6.0 : 3.0, 25.0);
  one.diameter_mm = draw.in(2.4, 4.0);
  if (one.kind == PressureKind::tapered) one.taper = draw.in(0.15, 0.4);
  if (one.kind == PressureKind::eccentric) {
    const double radius = 0.5 * one.diameter_mm;
    first.aside_mm = draw.in(0.4, 0.95) * radius * severity;
    first.aside_deg = draw.in(0.0, 360.0);
    first.oval = draw.in(1.0, 1.35);
  }
  first.at_mm = before_mm + 0.5 * first.length_mm;
  double end = before_mm + first.length_mm;
  one.stenoses = {first};
  if (one.kind == PressureKind::series) {
    PlannedStenosis second = stenosis_of(draw, draw.in(0.3, 0.7), 3.0, 12.0);
    second.at_mm = end + draw.in(3.0, 12.0) + 0.5 * second.length_mm;
    end = second.at_mm + 0.5 * second.length_mm;
    one.stenoses.push_back(second);
  }
  one.length_mm = end + behind_mm;
  if (one.kind == PressureKind::bend) {
    one.bend_radius_mm = draw.in(8.0, 25.0);
    const double turn = draw.in(40.0, 120.0) * std::numbers::pi / 180.0;
    one.bend_length_mm = std::min(one.bend_radius_mm * turn, one.length_mm - 4.0);
  }
}

void make_fork(PressureCase& one, Draw& draw, double severity, std::string_view medina) {
  one.medina = medina;
  one.diameter_mm = draw.in(3.0, 4.0);
  one.side_mm = one.diameter_mm * draw.in(0.55, 0.78);
  constexpr double murray = 2.33;
  one.main_mm = std::pow(std::pow(one.diameter_mm, murray) - std::pow(one.side_mm, murray), 1.0 / murray);
  one.main_deg = draw.in(8.0, 30.0);
  one.side_deg = draw.in(35.0, 65.0);
  PlannedStenosis trunk = stenosis_of(draw, severity, 3.0, 8.0);
  PlannedStenosis main = stenosis_of(draw, std::clamp(severity * draw.in(0.8, 1.2), 0.30, 0.85), 3.0, 8.0);
  PlannedStenosis side = stenosis_of(draw, std::clamp(severity * draw.in(0.8, 1.2), 0.30, 0.75), 3.0, 8.0);
  side.vessel = 1;
  one.fork_mm = before_mm + trunk.length_mm + 0.5;
  trunk.at_mm = before_mm + 0.5 * trunk.length_mm;
  main.at_mm = one.fork_mm + 0.7 * one.diameter_mm + 0.5 * main.length_mm;
  side.at_mm = one.fork_mm + 1.2 * one.diameter_mm + 0.5 * side.length_mm;
  one.length_mm = main.at_mm + 0.5 * main.length_mm + behind_mm;
  one.side_length_mm = side.at_mm + 0.5 * side.length_mm + behind_mm;
  if (medina[0] == '1') one.stenoses.push_back(trunk);
  if (medina[2] == '1') one.stenoses.push_back(main);
  if (medina[4] == '1') one.stenoses.push_back(side);
}

PressureCase made(PressureKind kind, int index, int count, std::uint64_t seed) {
  Draw draw(seed);
  PressureCase one;
  one.kind = kind;
  one.seed = seed;
  one.judged = seed % 2 == 0;
  one.id = std::string(name_of(kind)) + (index < 9 ? "-0" : "-") + std::to_string(index + 1);
  const double severity = spread(draw, 0.30, 0.85, index, count);
  one.dilation = spread(draw, 0.24, 1.0, shuffled(index, count), count);
  if (kind == PressureKind::fork)
    make_fork(one, draw, severity, medina_kinds[static_cast<std::size_t>(index) % medina_kinds.size()]);
  else
    make_single(one, draw, severity);
  keep_within_reason(one);
  set_flow(one);
  return one;
}

}  // namespace

std::string_view name_of(PressureKind kind) {
  return kind_names[static_cast<std::size_t>(kind)].second;
}

PressureKind pressure_kind(std::string_view name) {
  std::string known;
  for (const auto& [kind, word] : kind_names) {
    if (word == name) return kind;
    known += (known.empty() ? "" : ", ") + std::string(word);
  }
  throw InvalidInput("there is no kind of vessel \"" + std::string(name) + "\"; there are " + known);
}

void validate(const PressurePlanOptions& options) {
  for (const int count :
       {options.concentric, options.eccentric, options.tapered, options.bend, options.series, options.fork})
    if (count < 0 || count > 1000)
      throw InvalidInput("a plan has 0 to 1000 vessels of a kind, not " + std::to_string(count));
}

std::vector<PressureCase> plan_pressure(const PressurePlanOptions& options) {
  validate(options);
  const std::array<std::pair<PressureKind, int>, 6> counts{{{PressureKind::concentric, options.concentric},
                                                            {PressureKind::eccentric, options.eccentric},
                                                            {PressureKind::tapered, options.tapered},
                                                            {PressureKind::bend, options.bend},
                                                            {PressureKind::series, options.series},
                                                            {PressureKind::fork, options.fork}}};
  PressureCase tube;
  tube.id = "tube";
  tube.length_mm = 20.0;
  set_flow(tube);
  std::vector<PressureCase> plan{tube};
  std::vector<PressureCase> all;
  std::uint64_t seed = options.first_seed;
  for (const auto& [kind, count] : counts)
    for (int i = 0; i < count; ++i) all.push_back(made(kind, i, count, seed++));
  std::vector<std::pair<double, std::size_t>> order;  // how far on in its kind a case's turn is
  std::size_t first = 0;
  for (const auto& [kind, count] : counts) {
    double turn = 0.5;
    for (const int i : even_order(count))
      order.emplace_back(turn++ / count, first + static_cast<std::size_t>(i));
    first += static_cast<std::size_t>(count);
  }
  std::stable_sort(order.begin(), order.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  for (const auto& one : order) plan.push_back(all[one.second]);
  return plan;
}

std::string text_of(const PressureCase& one) {
  constexpr int digits = 9;  // the same on processors whose last bits differ
  const auto told = [](double number) { return core::significant_text(number, digits); };
  std::string text = one.id + " seed " + std::to_string(one.seed) + " " + one.medina;
  for (const double number : {one.diameter_mm, one.taper, one.length_mm, one.bend_radius_mm,
                              one.bend_length_mm, one.fork_mm, one.main_mm, one.side_mm, one.main_deg,
                              one.side_deg, one.side_length_mm, one.dilation, one.flow_ml_s})
    text += " " + told(number);
  for (const PlannedStenosis& s : one.stenoses) {
    text += " [" + std::to_string(s.vessel);
    for (const double number :
         {s.at_mm, s.length_mm, s.shoulder_mm, s.severity, s.aside_mm, s.aside_deg, s.oval})
      text += " " + told(number);
    text += "]";
  }
  return text;
}

}  // namespace ostia::experiments
