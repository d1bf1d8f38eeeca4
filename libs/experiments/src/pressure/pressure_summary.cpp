// What the pressure experiment's rows say together.

#include "pressure/pressure_compare.h"

#include "ostia/hemodynamics/conditions.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostia::experiments {
namespace {

constexpr double decided_at = 0.80;

}  // namespace

PressureHalf half_of(const PressureCase& one) {
  if (one.kind == PressureKind::patient) return PressureHalf::patients;
  return one.judged ? PressureHalf::judging : PressureHalf::fitting;
}

std::string_view name_of(PressureHalf half) {
  switch (half) {
    case PressureHalf::fitting:
      return "fit";
    case PressureHalf::judging:
      return "judge";
    case PressureHalf::patients:
      break;
  }
  return "patient";
}

bool counts(const PressureRow& row) {
  return row.planned.kind != PressureKind::tube && row.failure.empty() && row.run.converged;
}

void extrapolate(ConvergenceRow& row) {
  if (row.drops_mmhg.size() != 3) return;
  const double fine = row.drops_mmhg[1] - row.drops_mmhg[0], coarse = row.drops_mmhg[2] - row.drops_mmhg[1];
  if (!(fine * coarse > 0.0) || std::abs(coarse) <= std::abs(fine)) return;
  const double ratio = std::sqrt(row.edge_ratios[2] / row.edge_ratios[0]);
  row.order = std::log(coarse / fine) / std::log(ratio);
  row.richardson_mmhg = row.drops_mmhg[0] - fine / (std::pow(ratio, *row.order) - 1.0);
}

PressureSummary summarize(const PressureResults& results, PressureHalf half, bool fitted) {
  PressureSummary sum;
  std::vector<double> off;
  std::size_t alike = 0;
  double squares = 0.0;
  for (const PressureRow& row : results.rows) {
    if (half_of(row.planned) != half || !counts(row)) continue;
    ++sum.cases;
    squares += row.rms_mmhg * row.rms_mmhg;
    sum.worst_rms_mmhg = std::max(sum.worst_rms_mmhg, row.rms_mmhg);
    for (const PressureReading& reading : row.readings) {
      const double ffr = fitted ? reading.fitted : reading.ffr_1d;
      off.push_back(ffr - reading.ffr_3d);
      alike += (ffr <= decided_at) == (reading.ffr_3d <= decided_at) ? 1 : 0;
      if (std::abs(off.back()) <= std::abs(sum.worst) && !sum.worst_id.empty()) continue;
      sum.worst = off.back();
      sum.worst_id = row.planned.id;
    }
  }
  sum.readings = off.size();
  if (off.empty()) return sum;
  const auto n = static_cast<double>(off.size());
  for (const double one : off) sum.bias += one / n;
  double spread = 0.0;
  for (const double one : off) spread += (one - sum.bias) * (one - sum.bias);
  sum.sd = off.size() > 1 ? std::sqrt(spread / (n - 1.0)) : 0.0;
  sum.alike = static_cast<double>(alike) / n;
  sum.rms_mmhg = std::sqrt(squares / static_cast<double>(sum.cases));
  return sum;
}

std::optional<double> poiseuille_error(const PressureResults& results) {
  for (const PressureRow& row : results.rows) {
    if (row.planned.kind != PressureKind::tube || row.curves.empty()) continue;
    const PressureCurve& curve = row.curves.front();
    if (curve.s_mm.size() < 2) return std::nullopt;
    const hemodynamics::Conditions blood;
    const double radius_m = 0.5e-3 * row.planned.diameter_mm;
    const double pa_m = 8.0 * 1e-3 * blood.viscosity_mpa_s * 1e-6 * row.run.inlet_ml_s /
                        (std::numbers::pi * std::pow(radius_m, 4));
    const double length_m = 1e-3 * (curve.s_mm.back() - curve.s_mm.front());
    const double fall = (curve.mmhg_3d.front() - curve.mmhg_3d.back()) * hemodynamics::pa_of_mmhg;
    return fall / (pa_m * length_m) - 1.0;
  }
  return std::nullopt;
}

}  // namespace ostia::experiments
