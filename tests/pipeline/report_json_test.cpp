#include "builtin_model.h"

#include "ostia/pipeline/report.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <set>

namespace ostia::pipeline {
namespace {

using nlohmann::json;

TEST(ReportJson, HoldsTheFiguresThatScriptsRead) {
  const TruthErrors errors = compare_with_truth(builtin_case(), builtin_model());
  const json report = json::parse(report_json(builtin_model(), builtin_options(), errors));
  EXPECT_EQ(report["v"], 1);
  EXPECT_EQ(report["axes"], "LPS");
  EXPECT_EQ(report["vessels"].size(), 2u);
  EXPECT_EQ(report["faces"].size(), 4u);
  EXPECT_EQ(report["volume"]["inverted"], 0);
  EXPECT_EQ(report["truth"]["lumen"]["msd_mm"].get<double>(), errors.lumen.msd_mm);
  EXPECT_TRUE(report["verdict"]["passed"].get<bool>());
  EXPECT_GT(report["vessels"][0]["least_diameter_mm"].get<double>(), 1.0);
}

TEST(ReportJson, ParametersAreCanonical) {
  ModelOptions options = builtin_options();
  EXPECT_EQ(parameters_json(options), parameters_json(builtin_options()));
  options.sizing.edge_ratio = 0.31;
  EXPECT_NE(parameters_json(options), parameters_json(builtin_options()));
  const auto another = [](const auto& change) {
    ModelOptions changed = builtin_options();
    change(changed.volume);
    return parameters_json(changed);
  };
  std::set<std::string> all{parameters_json(builtin_options())};
  all.insert(another([](VolumeOptions& v) { v.order = 2; }));
  all.insert(another([](VolumeOptions& v) { v.formats = {io::MeshFormat::openfoam}; }));
  for (const double thickness : {0.25, 0.5})
    for (const bool split : {false, true})
      all.insert(another([&](VolumeOptions& v) {
        v.layers.emplace().thickness = thickness;
        v.split_prisms = split;
      }));
  for (const double flow : {0.5, 0.6})
    all.insert(another([&](VolumeOptions& v) {
      solver::OpenfoamCaseOptions openfoam;
      openfoam.flow.flow_ml_s = flow;
      v.solver_case = openfoam;
    }));
  all.insert(another([](VolumeOptions& v) { v.solver_case = solver::SvmultiphysicsCaseOptions(); }));
  EXPECT_EQ(all.size(), 10u);
  options = builtin_options();
  options.clip.planes = {{"inlet_LAD", {1, 2, 3}, {0, 0, 1}}};
  EXPECT_NE(parameters_json(options), parameters_json(builtin_options()));
  SourceOptions reading;
  reading.unit_mm = 10.0;
  EXPECT_NE(parameters_json(builtin_options(), reading), parameters_json(builtin_options()));
}

}  // namespace
}  // namespace ostia::pipeline
