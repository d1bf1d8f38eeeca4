// Allrun: the script that runs a case.

#include "openfoam_plan.h"

namespace ostia::solver {
namespace {

/// A shell function that runs the solver once, on $n processes.
std::string solve_function(const CasePlan& plan) {
  const std::string program = plan.program();
  return "solve() {\n"
         "  if [ \"$n\" -gt 1 ]; then\n"
         "    decomposePar -force > log.decomposePar 2>&1\n"
         "    ${MPIRUN:-mpirun} -np \"$n\" " +
         program + " -parallel >> log." + program + " 2>&1\n    reconstructPar " +
         (plan.pulsatile() ? "" : "-latestTime ") + "> log.reconstructPar 2>&1\n  else\n    " + program +
         " >> log." + program + " 2>&1\n  fi\n}\n";
}

/// The newest time, and measurements from it on removed: an earlier run made them that was given up before it
/// wrote its result. OpenFOAM would leave them and write beside them.
std::string fresh_measurements() {
  return R"sh(newest() {
  ls | awk '/^[0-9][0-9.e+-]*$/ && $1 + 0 >= t { t = $1 + 0; name = $1 } END { print name }'
}
# What an earlier run has measured from here on is not this one's.
ls -d postProcessing/*/* 2> /dev/null |
  awk -F / -v from="$(newest)" 'NF == 3 && $3 ~ /^[0-9][0-9.e+-]*$/ && $3 + 0 >= from + 0' |
  while read -r part; do rm -r "./$part"; done
)sh";
}

}  // namespace

std::string run_script(const CasePlan& plan) {
  const std::string program = plan.program();
  return "#!/bin/sh\n"
         "# Runs this case: ./Allrun, or decomposed on N processes: ./Allrun N. What the programs say is in "
         "log.*\n"
         "# MPIRUN names another program than mpirun, with its options.\n"
         "case \"$0\" in */*) cd \"${0%/*}\" || exit 1 ;; esac\nset -e\n"
         "# Debian's OpenFOAM finds its settings by this.\n"
         ": \"${WM_PROJECT_DIR:=/usr/share/openfoam}\"\nexport WM_PROJECT_DIR\n" +
         fresh_measurements() +
         "n=\"${1:-1}\"\n"
         "checkMesh > log.checkMesh 2>&1\n"
         "if [ \"$n\" -gt 1 ]; then\n"
         "  sed -i \"s/^numberOfSubdomains .*/numberOfSubdomains $n;/; s/^    n  .*/    n           " +
         slices(plan, "$n") + ";/\" system/decomposeParDict\nfi\n: > log." + program + "\n" +
         solve_function(plan) +
         (coupled_steady(plan)     ? steady_coupling(plan)
          : coupled_by_cycle(plan) ? cycle_coupling(plan)
                                   : std::string("solve\n"));
}

}  // namespace ostia::solver
