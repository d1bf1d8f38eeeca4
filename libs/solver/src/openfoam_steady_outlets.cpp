// Outlets of a steady case: resistances whose flows are found by running again and again.

#include "openfoam_plan.h"

#include "ostia/core/text.h"

namespace ostia::solver {
namespace {

/// Names of the inlets, for the shell.
std::string inlets(const CasePlan& plan) {
  std::string names;
  for (const Inlet& inlet : plan.flow.inlets) names += (names.empty() ? "" : " ") + inlet.name;
  return names;
}

/// Shell functions of the coupling: q_i = P / (R_i + r_i), where r_i = (P' - p_i) / q_i' is what the model
/// itself resisted on the way to outlet i in the run before (P' is the pressure at the inlets), and P such
/// that the flows sum to the inlets'.
std::string coupling_functions(const CasePlan& plan) {
  return R"sh(# The last value that a function of system/controlDict has written.
value() {
  awk '!/^#/ && $1 + 0 >= t { t = $1 + 0; v = $2 } END { print v == "" ? "none" : v }' "postProcessing/$1"/*/surfaceFieldValue.dat
}
# New flows and pressures of the outlets as `name flow pressure`, then `change` and the largest relative change.
balance() {
  {
    for inlet in )sh" +
         inlets(plan) + R"sh(; do echo "in $(value "flow_$inlet") $(value "pressure_$inlet")"; done
    while read -r outlet resistance; do
      echo "$outlet $resistance $(value "flow_$outlet") $(value "pressure_$outlet")"
    done < constant/outletResistances
  } | awk '
    $2 $3 $4 ~ /n/ { none = 1 } # none, nan, inf: they compare as if they were any number
    $1 == "in" { whole -= $2; above -= $2 * $3; next }
    { n++; name[n] = $1; resistance[n] = $2; flow[n] = $3; pressure[n] = $4 }
    END {
      if (none || whole + 0 == 0) { print "change none"; exit }
      above /= whole
      for (i = 1; i <= n; i++) {
        if (flow[i] + 0 == 0) { print "change none"; exit }
        all[i] = resistance[i] + (above - pressure[i]) / flow[i]
        sum += 1 / all[i]
      }
      for (i = 1; i <= n; i++) {
        new = whole / sum / all[i]
        by = new / flow[i] - 1
        if (by < 0) by = -by
        if (by > most) most = by
        if (by "" !~ /^[0-9]/) none = 1
        printf "%s %.10e %.10e\n", name[i], new, resistance[i] * new
      }
      if (none) print "change none"; else printf "change %.6f\n", most
    }'
}
# Another value of an entry of a patch: entry FILE PATCH KEY VALUE
entry() {
  awk -v patch="$2" -v key="$3" -v value="$4" '
    $1 == patch { inside = 1 }
    inside && $1 == key { print "        " key " " value ";"; next }
    /}/ { inside = 0 }
    { print }' "$1" > "$1.new" && mv "$1.new" "$1"
}
)sh";
}

/// Runs, looks at the outlets, sets them anew and goes on, until their flows stay.
std::string coupled_run(const CasePlan& plan) {
  return R"sh(: > log.outlets
for round in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20; do
  before=$(newest)
  solve
  time=$(newest)
  # One result stays: the last.
  if [ "$before" != "$time" ] && [ "$before" != 0 ]; then rm -r "./$before"; fi
  balance > log.round
  { echo "round $round, iteration $time"; cat log.round; } >> log.outlets
  change=$(tail -n 1 log.round)
  # Where there is no number (an outlet without flow), going on finds none.
  case "${change#change }" in *[!0-9.e+-]* | "") break ;; esac
  if awk -v change="${change#change }" 'BEGIN { exit !(change < 0.001) }'; then rm log.round; exit 0; fi
  if [ "$before" = "$time" ] || [ "$time" -ge )sh" +
         std::to_string(plan.options.iterations) + R"sh( ]; then break; fi
  first=1
  while read -r outlet flow pressure; do
    if [ "$outlet" = change ]; then break; fi
    if [ "$first" = 1 ]; then # the largest holds the pressure, and takes what is left
      entry "$time/p" "$outlet" p0 "uniform $pressure"
    else
      entry "$time/U" "$outlet" volumetricFlowRate "constant $flow"
    fi
    first=0
  done < log.round
done
rm log.round # log.outlets holds it
echo "the flows of the outlets have not settled: see log.outlets" >&2
exit 1
)sh";
}

}  // namespace

bool coupled_steady(const CasePlan& plan) {
  return plan.options.flow.outlets == OutletModel::resistance && !plan.pulsatile() &&
         plan.flow.outlets.size() > 1;
}

std::string outlet_resistances(const CasePlan& plan) {
  std::string text;
  for (const Outlet& outlet : plan.flow.outlets)
    text += outlet.name + " " + core::shortest_text(outlet.resistance_pa_s_m3 / plan.density()) + "\n";
  return text;
}

std::string steady_coupling(const CasePlan& plan) {
  return coupling_functions(plan) + coupled_run(plan);
}

}  // namespace ostia::solver
