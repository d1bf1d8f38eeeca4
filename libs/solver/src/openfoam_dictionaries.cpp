// OpenFOAM's dictionaries of a laminar case (User Guide v1912, chapters 4 and 6).

#include "case_text.h"
#include "openfoam_plan.h"

#include "ostia/core/text.h"

namespace ostia::solver {
namespace {

using core::shortest_text;

std::string kinematic(double viscosity_mpa_s, double density) {
  return shortest_text(viscosity_mpa_s / (1e3 * density));
}

/// A value of one patch, a line a time step or iteration, in postProcessing/<name>.
std::string of_patch(const std::string& name, const std::string& patch, const std::string& field,
                     const std::string& operation) {
  return "    " + name + "_" + patch +
         "\n    {\n        type            surfaceFieldValue;\n"
         "        libs            (\"libfieldFunctionObjects.so\");\n"
         "        regionType      patch;\n        name            " +
         patch + ";\n        operation       " + operation + ";\n        fields          (" + field +
         ");\n        writeFields     false;\n        log             false;\n"
         "        writeControl    timeStep;\n        writeInterval   1;\n    }\n";
}

std::string functions(const CasePlan& plan) {
  std::string text =
      "functions\n{\n"
      "    // Kinematic, m2/s2: times the density it is in Pa.\n"
      "    wallShearStress\n    {\n        type            wallShearStress;\n"
      "        libs            (\"libfieldFunctionObjects.so\");\n"
      "        executeControl  writeTime;\n        writeControl    writeTime;\n        log             "
      "false;\n"
      "    }\n"
      "    pressureInPascal\n    {\n        type            pressure;\n"
      "        libs            (\"libfieldFunctionObjects.so\");\n"
      "        mode            static;\n        rho             rhoInf;\n        rhoInf          " +
      shortest_text(plan.density()) +
      ";\n        result          pressureInPascal;\n"
      "        executeControl  writeTime;\n        writeControl    writeTime;\n        log             "
      "false;\n"
      "    }\n"
      "    residuals\n    {\n        type            solverInfo;\n"
      "        libs            (\"libutilityFunctionObjects.so\");\n        fields          (U p);\n    }\n";
  const auto add = [&](const std::string& patch) {
    text += of_patch("flow", patch, "phi", "sum") + of_patch("pressure", patch, "p", "areaAverage");
  };
  for (const Inlet& inlet : plan.flow.inlets) add(inlet.name);
  for (const Outlet& outlet : plan.flow.outlets) add(outlet.name);
  return text + "}\n";
}

}  // namespace

std::string control_dict(const CasePlan& plan) {
  const bool pulsatile = plan.pulsatile(), adjusted = pulsatile && !plan.options.time_step_s;
  const OpenfoamCaseOptions& o = plan.options;
  const std::string steps = adjusted
                                ? ";\nadjustTimeStep  yes;\nmaxCo           " + shortest_text(o.courant) +
                                      ";\nmaxDeltaT       " + shortest_text(plan.longest_step_s())
                                : "";
  return foam_head("dictionary", "system", "controlDict") + "application     " + plan.program() +
         ";\nstartFrom       latestTime;\nstartTime       0;\nstopAt          endTime;\nendTime         " +
         (pulsatile ? shortest_text(plan.end_time_s()) : std::to_string(o.iterations)) +
         ";\ndeltaT          " + (pulsatile ? shortest_text(plan.time_step_s) : "1") + steps +
         ";\nwriteControl    " +
         (adjusted    ? "adjustableRunTime"
          : pulsatile ? "runTime"
                      : "timeStep") +
         ";\nwriteInterval   " +
         (pulsatile ? shortest_text(plan.period_s / o.results_per_cycle) : std::to_string(o.iterations)) +
         ";\npurgeWrite      0;\nwriteFormat     ascii;\nwritePrecision  10;\nwriteCompression off;\n"
         "timeFormat      general;\ntimePrecision   9;\nrunTimeModifiable no;\n\n" +
         functions(plan);
}

std::string fv_schemes(const CasePlan& plan) {
  return foam_head("dictionary", "system", "fvSchemes") + "ddtSchemes\n{\n    default         " +
         (plan.pulsatile() ? "backward" : "steadyState") +
         ";\n}\ngradSchemes\n{\n    default         pointCellsLeastSquares;\n}\ndivSchemes\n{\n    default   "
         "      "
         "none;\n"
         "    div(phi,U)      " +
         (plan.pulsatile() ? "" : "bounded ") +
         "Gauss linearUpwind grad(U);\n"
         "    div((nuEff*dev2(T(grad(U))))) Gauss linear;\n}\nlaplacianSchemes\n{\n"
         "    default         Gauss linear corrected;\n}\ninterpolationSchemes\n{\n"
         "    default         linear;\n}\nsnGradSchemes\n{\n    default         corrected;\n}\n";
}

std::string fv_solution(const CasePlan& plan) {
  // A pulse takes many steps, each of which is corrected again.
  const std::string tolerance_of_solvers =
      std::string("        tolerance       ") + (plan.pulsatile() ? "1e-7" : "1e-9") + ";\n";
  const std::string solver_p =
      "        solver          GAMG;\n        smoother        GaussSeidel;\n" + tolerance_of_solvers;
  const std::string solver_u =
      "        solver          smoothSolver;\n        smoother        symGaussSeidel;\n" +
      tolerance_of_solvers;
  // A gradient is asked for three times and more before its field changes, and costs more than a solver. In a
  // pulse kept ones change the flow, so that coupled outlets do not settle.
  const std::string kept = plan.pulsatile() ? "" : "cache\n{\n    grad(U);\n    grad(p);\n}\n\n";
  std::string text = foam_head("dictionary", "system", "fvSolution") + kept + "solvers\n{\n    p\n    {\n" +
                     solver_p + "        relTol          0.02;\n    }\n    pFinal\n    {\n" + solver_p +
                     "        relTol          0;\n    }\n    \"(U|UFinal)\"\n    {\n" + solver_u +
                     "        relTol          " + (plan.pulsatile() ? "0" : "0.05") + ";\n    }\n}\n\n";
  if (plan.pulsatile())
    return text +
           "PIMPLE\n{\n    nOuterCorrectors 2;\n    nCorrectors     2;\n    nNonOrthogonalCorrectors 1;\n}\n";
  const std::string tolerance = shortest_text(plan.options.tolerance);
  // What meshes are not orthogonal by is taken from the iteration before: at the end it is the same.
  return text +
         "SIMPLE\n{\n    consistent      yes;\n    nNonOrthogonalCorrectors 0;\n    residualControl\n    {\n"
         "        p               " +
         tolerance + ";\n        U               " + tolerance +
         ";\n    }\n}\n\nrelaxationFactors\n{\n    equations\n    {\n        U               0.9;\n    "
         "}\n}\n";
}

std::string slices(const CasePlan& plan, const std::string& count) {
  std::string text = "(";
  for (int axis = 0; axis < 3; ++axis) text += (axis > 0 ? " " : "") + (axis == plan.long_axis ? count : "1");
  return text + ")";
}

std::string decompose_dict(const CasePlan& plan) {
  // Debian's package has no working graph partitioner (Scotch, Metis).
  const std::string processes = std::to_string(plan.options.processes);
  return foam_head("dictionary", "system", "decomposeParDict") + "numberOfSubdomains " + processes +
         ";\nmethod          simple;\nsimpleCoeffs\n{\n    n           " + slices(plan, processes) +
         ";\n    delta       0.001;\n}\n";
}

std::string transport_properties(const CasePlan& plan) {
  const Blood& blood = plan.options.flow.blood;
  const std::string head = foam_head("dictionary", "constant", "transportProperties") +
                           "// Kinematic, m2/s; density " + shortest_text(blood.density_kg_m3) + " kg/m3\n";
  if (blood.rheology == Rheology::newtonian)
    return head + "transportModel  Newtonian;\nnu              " +
           kinematic(blood.viscosity_mpa_s, blood.density_kg_m3) + ";\n";
  return head + "transportModel  BirdCarreau;\nBirdCarreauCoeffs\n{\n    nu0             " +
         kinematic(CarreauLaw::at_rest_mpa_s, blood.density_kg_m3) + ";\n    nuInf           " +
         kinematic(CarreauLaw::at_speed_mpa_s, blood.density_kg_m3) + ";\n    k               " +
         shortest_text(CarreauLaw::relaxation_s) + ";\n    n               " +
         shortest_text(CarreauLaw::power) + ";\n}\n";
}

std::string turbulence_properties() {
  return foam_head("dictionary", "constant", "turbulenceProperties") + "simulationType  laminar;\n";
}

}  // namespace ostia::solver
