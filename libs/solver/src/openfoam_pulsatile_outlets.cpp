// Outlets of a pulsatile case: tables of one cycle, and Windkessels that are coupled from cycle to cycle.

#include "case_text.h"
#include "openfoam_plan.h"

#include "ostia/core/text.h"

#include <complex>
#include <numbers>

namespace ostia::solver {
namespace fs = std::filesystem;
namespace {

using core::shortest_text;

constexpr double m3_in_ml = 1e-6;
constexpr int coupled_harmonics = 12;

Windkessel windkessel(const CasePlan& plan, std::size_t outlet) {
  return windkessel_of(plan.flow.outlets[outlet], plan.options.total_compliance_ml_mmhg.value_or(0.0));
}

/// Pressure over the density of the largest outlet at a time, when it has its share of the flow.
double first_pressure(const CasePlan& plan, double time_s) {
  const Windkessel largest = windkessel(plan, 0);
  const double share = plan.flow.outlets[0].share;
  double pressure = 0.0;
  for (const Inlet& inlet : plan.flow.inlets) {
    pressure += largest.impedance(0.0).real() * share * inlet.mean_flow_ml_s;
    for (std::size_t k = 1; inlet.harmonics && k <= inlet.harmonics->amplitude_ml_s.size(); ++k) {
      const double omega = inlet.harmonics->angular_frequency(k);
      pressure += (largest.impedance(omega) * share * inlet.harmonics->amplitude_ml_s[k - 1] *
                   std::polar(1.0, omega * time_s))
                      .real();
    }
  }
  return pressure * m3_in_ml / plan.density();
}

template <class ValueAt>
std::string table_of_cycle(const CasePlan& plan, const ValueAt& value_at) {
  std::string text = "(\n";
  const int samples = plan.options.samples_per_cycle;
  for (int i = 0; i <= samples; ++i)
    text += "(" + shortest_text(plan.period_s * i / samples) + " " +
            shortest_text(value_at(plan.period_s * (i % samples) / samples)) + ")\n";
  return text + ")\n";
}

/// New tables by the last cycle's flows and pressures. Lines of `name proximal distal compliance`, and series
/// of the cycle as `time value` in files `<name>.flow` and `<name>.pressure` of $1, `inlet.*` those of the
/// inlets together. Each is resampled, taken apart into harmonics, and for each harmonic
///
///   q_i = (P - e_i) / (Z_i + z_i)   with   e_i = (P' - p_i') - z_i q_i'   and P such that the flows sum up,
///
/// z_i = r_i + i omega l_i the model's mean resistance and its inertia on the way to outlet i, primes the
/// last cycle's. Without the inertia it does not settle: it is more than a Windkessel's proximal resistance.
constexpr const char* balance_awk = R"awk(
function series(file, v,    n, line, part, i, j, t) {
  n = 0
  while ((getline line < file) > 0) { split(line, part, " "); at[n] = part[1] + 0; of[n] = part[2] + 0; n++ }
  close(file)
  if (n < 4) { none = 1; return }
  j = 0
  for (i = 0; i < samples; i++) {
    t = start + period * i / samples
    while (j < n - 2 && at[j + 1] < t) j++
    v[i] = of[j] + (of[j + 1] - of[j]) * (t - at[j]) / (at[j + 1] - at[j])
  }
}
function harmonics(v, re, im, name,    k, i) {
  for (k = 0; k <= most; k++) {
    re[name, k] = im[name, k] = 0
    for (i = 0; i < samples; i++) {
      re[name, k] += v[i] * cos(2 * pi * k * i / samples) / samples
      im[name, k] -= v[i] * sin(2 * pi * k * i / samples) / samples
    }
  }
}
function table(file, re, im, name,    i, k, v) {
  printf "(\n" > file
  for (i = 0; i <= samples; i++) {
    v = re[name, 0]
    for (k = 1; k <= most; k++)
      v += 2 * (re[name, k] * cos(2 * pi * k * i / samples) - im[name, k] * sin(2 * pi * k * i / samples))
    printf "(%.10g %.10e)\n", period * i / samples, v > file
  }
  printf ")\n" > file
  close(file)
}
{ n++; name[n] = $1; near[n] = $2; far[n] = $3; store[n] = $4 }
END {
  pi = 3.14159265358979
  series(folder "/inlet.pressure", v); harmonics(v, pr, pi_, "in")
  for (i = 1; i <= n; i++) {
    series(folder "/" name[i] ".flow", v); harmonics(v, qr, qi, i)
    series(folder "/" name[i] ".pressure", v); harmonics(v, pr, pi_, i)
    if (qr[i, 0] + 0 == 0) none = 1
  }
  if (none) { print "change none"; exit }
  for (i = 1; i <= n; i++) {
    own[i] = (pr["in", 0] - pr[i, 0]) / qr[i, 0]
    if (own[i] < 0) own[i] = 0
    # What it has of inertia, by all harmonics.
    turned = square = 0
    for (k = 1; k <= most; k++) {
      omega = 2 * pi * k / period
      dr = pr["in", k] - pr[i, k]; di = pi_["in", k] - pi_[i, k]
      turned += omega * (di * qr[i, k] - dr * qi[i, k]); square += omega ^ 2 * (qr[i, k] ^ 2 + qi[i, k] ^ 2)
    }
    mass[i] = square > 0 && turned > 0 ? turned / square : 0
  }
  for (k = 0; k <= most; k++) {
    omega = 2 * pi * k / period
    ar = ai = br = bi = 0 # the sums of e / z + q and of 1 / z
    for (i = 1; i <= n; i++) {
      w = omega * far[i] * store[i]
      zr[i] = near[i] + far[i] / (1 + w * w) + own[i]; zi[i] = -far[i] * w / (1 + w * w) + omega * mass[i]
      er[i] = pr["in", k] - pr[i, k] - own[i] * qr[i, k] + omega * mass[i] * qi[i, k]
      ei[i] = pi_["in", k] - pi_[i, k] - own[i] * qi[i, k] - omega * mass[i] * qr[i, k]
      s = zr[i] * zr[i] + zi[i] * zi[i]
      ar += (er[i] * zr[i] + ei[i] * zi[i]) / s + qr[i, k]; ai += (ei[i] * zr[i] - er[i] * zi[i]) / s + qi[i, k]
      br += zr[i] / s; bi -= zi[i] / s
    }
    s = br * br + bi * bi
    Pr = (ar * br + ai * bi) / s; Pi = (ai * br - ar * bi) / s
    for (i = 1; i <= n; i++) {
      s = zr[i] * zr[i] + zi[i] * zi[i]
      dr = Pr - er[i]; di = Pi - ei[i]
      nr[i, k] = (dr * zr[i] + di * zi[i]) / s; ni[i, k] = (di * zr[i] - dr * zi[i]) / s
      d = (nr[i, k] - qr[i, k]) ^ 2 + (ni[i, k] - qi[i, k]) ^ 2
      off[i] += d; all[i] += qr[i, k] ^ 2 + qi[i, k] ^ 2
      # The largest holds the pressure that belongs to its flow.
      if (i == 1) {
        tr = zr[1] - own[1]; ti = zi[1] - omega * mass[1]
        fr[1, k] = tr * nr[1, k] - ti * ni[1, k]; fi[1, k] = tr * ni[1, k] + ti * nr[1, k]
      }
    }
  }
  table(folder "/" name[1] ".pressure.new", fr, fi, 1)
  for (i = 1; i <= n; i++) {
    if (i > 1) table(folder "/" name[i] ".flow.new", nr, ni, i)
    by = sqrt(off[i] / all[i])
    if (by > change) change = by
    printf "%s mean flow %.6e, pressure %.6e, changed by %.6f\n", name[i], nr[i, 0], pr[i, 0], by
  }
  if (change "" ~ /n/) print "change none"; else printf "change %.6f\n", change
})awk";

}  // namespace

bool flow_is_given(const CasePlan& plan, std::size_t outlet) {
  return plan.options.flow.outlets != OutletModel::zero_pressure && outlet > 0;
}

bool coupled_by_cycle(const CasePlan& plan) {
  return plan.options.flow.outlets == OutletModel::resistance && plan.pulsatile();
}

std::string outlet_windkessels(const CasePlan& plan) {
  std::string text;
  for (std::size_t i = 0; i < plan.flow.outlets.size(); ++i) {
    const Windkessel w = windkessel(plan, i);
    text += plan.flow.outlets[i].name + " " + shortest_text(w.proximal_pa_s_m3 / plan.density()) + " " +
            shortest_text(w.distal_pa_s_m3 / plan.density()) + " " +
            shortest_text(w.compliance_m3_pa * plan.density()) + "\n";
  }
  return text;
}

std::string outlet_table(const std::string& outlet, const std::string& quantity) {
  return "tableFile;\n        " + std::string(quantity == "flow" ? "volumetricFlowRate" : "p0") +
         "Coeffs\n        {\n            file            \"$FOAM_CASE/constant/outletTables/" + outlet + "." +
         quantity + "\";\n            outOfBounds     repeat;\n        }\n";
}

void write_outlet_tables(const CasePlan& plan, const fs::path& folder) {
  const fs::path tables = folder / "constant" / "outletTables";
  for (std::size_t i = 0; i < plan.flow.outlets.size(); ++i) {
    const Outlet& outlet = plan.flow.outlets[i];
    if (flow_is_given(plan, i))
      write_case_file(tables / (outlet.name + ".flow"), table_of_cycle(plan, [&](double time_s) {
                        return outlet.share * plan.flow.flow_ml_s(time_s) * m3_in_ml;
                      }));
    else if (coupled_by_cycle(plan))
      write_case_file(tables / (outlet.name + ".pressure"),
                      table_of_cycle(plan, [&](double time_s) { return first_pressure(plan, time_s); }));
  }
}

std::string cycle_coupling(const CasePlan& plan) {
  std::string inlets;
  for (const Inlet& inlet : plan.flow.inlets) inlets += (inlets.empty() ? "" : " ") + inlet.name;
  const std::string period = shortest_text(plan.period_s);
  return "cycles=" + std::to_string(plan.options.cycles) + "\nperiod=" + period + R"sh(
end_at() {
  sed -i "s/^endTime .*/endTime         $1;/" system/controlDict
}
# The last cycle of a series that the functions of system/controlDict have written, by rising time.
last_cycle() {
  cat "postProcessing/$1"/*/surfaceFieldValue.dat | awk -v to="$2" -v period="$period" '
    !/^#/ && $1 + 0 > to - period * 1.02 && $1 + 0 < to * 1.000001 { print $1, $2 }' | sort -g
}
# The inlets together: pressures weighted with the flows' means.
inlet_pressure() {
  for inlet in )sh" +
         inlets + R"sh(; do
    weight=$(last_cycle "flow_$inlet" "$1" | awk '{ s += $2; n++ } END { print (n ? s / n : 0) }')
    last_cycle "pressure_$inlet" "$1" | awk -v w="$weight" '{ print $1, $2, w }'
  done | sort -g | awk '
    { if ($1 != t && NR > 1) { print t, v / w; v = w = 0 } t = $1; v += $2 * $3; w += $3 }
    END { if (w != 0) print t, v / w }'
}
# New tables for the outlets by the cycle that ends at $1. The last line is how much the flows change by.
balance_cycle() {
  mkdir -p outletCycle
  inlet_pressure "$1" > outletCycle/inlet.pressure
  while read -r outlet rest; do
    last_cycle "flow_$outlet" "$1" > "outletCycle/$outlet.flow"
    last_cycle "pressure_$outlet" "$1" > "outletCycle/$outlet.pressure"
  done < constant/outletWindkessels
  awk -v folder=outletCycle -v period="$period" -v start="$(awk -v to="$1" -v p="$period" 'BEGIN { printf "%.12g", to - p }')"     -v samples=)sh" +
         std::to_string(plan.options.samples_per_cycle) +
         " -v most=" + std::to_string(std::min(coupled_harmonics, plan.options.samples_per_cycle / 2 - 1)) +
         " '" + balance_awk + R"sh(' constant/outletWindkessels
}
if [ "$(newest)" = 0 ] || [ ! -f log.outlets ]; then : > log.outlets; fi
change=$(awk '/^change / { last = $0 } END { print last == "" ? "change none" : last }' log.outlets)
cycle=1
while [ "$cycle" -le "$cycles" ]; do
  end=$(awk -v c="$cycle" -v p="$period" 'BEGIN { printf "%.9g", c * p }')
  if awk -v now="$(newest)" -v end="$end" 'BEGIN { exit !(now + 0 < end * 0.999999) }'; then
    end_at "$end"
    solve
    balance_cycle "$end" > log.round
    { echo "cycle $cycle, to $end s"; cat log.round; } >> log.outlets
    change=$(tail -n 1 log.round)
    case "${change#change }" in *[!0-9.e+-]* | "") break ;; esac
    # They stay as they were in the last cycle, so that the case goes on from there.
    for new in outletCycle/*.new; do mv "$new" "constant/outletTables/$(basename "$new" .new)"; done
  fi
  cycle=$((cycle + 1))
done
end_at "$(awk -v c="$cycles" -v p="$period" 'BEGIN { printf "%.9g", c * p }')"
rm -rf outletCycle log.round
if awk -v change="${change#change }" 'BEGIN { exit !(change ~ /^[0-9]/ && change + 0 < 0.01) }'; then exit 0; fi
echo "the flows of the outlets have not settled: see log.outlets, and let the case run for more cycles" >&2
exit 1
)sh";
}

}  // namespace ostia::solver
