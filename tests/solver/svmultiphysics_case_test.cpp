#include "ostia/solver/svmultiphysics_case.h"

#include "solver_test_support.h"

#include <nlohmann/json.hpp>

namespace ostia::solver {
namespace {

namespace fs = std::filesystem;

const geometry::MixedMesh& svmultiphysics_case_fork() {
  static const geometry::MixedMesh mesh = vessel(geometry::y_junction(6.0, 6.0, 1.5, 1.2, 60.0), 0.6, 0);
  return mesh;
}

fs::path made(const SvmultiphysicsCaseOptions& options) {
  const fs::path folder = testing::temporary_folder("sv") / "case";
  write_svmultiphysics_case(svmultiphysics_case_fork(), options, folder);
  return folder;
}

nlohmann::json conditions(const fs::path& folder) {
  return nlohmann::json::parse(core::read_file(folder / "boundary_conditions.json"))
      .at("boundary_conditions");
}

TEST(SvmultiphysicsCase, NamesFlowAndWindkesselsOfEachFace) {
  SvmultiphysicsCaseOptions options;
  options.flow.flow_ml_s = 0.5;
  options.flow.outlets = OutletModel::resistance;
  options.flow.total_resistance_mmhg_s_ml = 100.0;
  options.total_compliance_ml_mmhg = 0.01;
  const nlohmann::json list = conditions(made(options));
  ASSERT_EQ(list.size(), 3u);
  EXPECT_EQ(list[0].at("bc_type"), "FLOW");
  EXPECT_EQ(list[0].at("bc_values").at("Q"), (std::vector<double>{500.0, 500.0}));  // mm3/s
  double conductance = 0.0, compliance = 0.0;
  for (const std::size_t i : {1u, 2u}) {
    EXPECT_EQ(list[i].at("bc_type"), "RCR");
    EXPECT_EQ(list[i].at("bc_name").get<std::string>().rfind("outlet_", 0), 0u);
    const auto& values = list[i].at("bc_values");
    const double proximal = values.at("Rp"), distal = values.at("Rd");
    EXPECT_NEAR(proximal / (proximal + distal), 0.09, 1e-12);
    conductance += 1.0 / (proximal + distal);
    compliance += values.at("C").get<double>();
  }
  EXPECT_NEAR(1.0 / conductance, 100.0 * 133.322387415e-3, 1e-9);  // Pa s / mm3
  EXPECT_NEAR(compliance, 0.01 * 1e3 / 133.322387415, 1e-12);      // mm3 / Pa
}

TEST(SvmultiphysicsCase, TheConditionsAreAsTheirSchemaSays) {
  if (!shell("/", "/usr/bin/python3 -c 'import jsonschema'").good) GTEST_SKIP() << "needs python3-jsonschema";
  const fs::path schema = fs::path(__FILE__).parent_path().parent_path().parent_path() / "docs" / "schemas" /
                          "boundary-conditions.schema.json";
  const auto judged = [&](const fs::path& folder) {
    return shell(
        folder,
        "/usr/bin/python3 -c 'import json, jsonschema, sys\n"
        "schema = json.load(open(sys.argv[1]))\n"
        "jsonschema.Draft202012Validator.check_schema(schema)\n"
        "jsonschema.Draft202012Validator(schema).validate(json.load(open(\"boundary_conditions.json\")))' '" +
            schema.string() + "'");
  };
  SvmultiphysicsCaseOptions options;
  for (const bool resistance : {false, true}) {
    if (resistance) options.flow.outlets = OutletModel::resistance;
    const Shell said = judged(made(options));
    EXPECT_TRUE(said.good) << said.output;
  }
  options.total_compliance_ml_mmhg = 0.01;
  const fs::path folder = made(options);
  EXPECT_TRUE(judged(folder).good);
  // The schema tells what is not so.
  std::string text = core::read_file(folder / "boundary_conditions.json");
  text.replace(text.find("\"Rp\""), 4, "\"R1\"");
  core::write_file(folder / "boundary_conditions.json", text);
  EXPECT_FALSE(judged(folder).good);
}

TEST(SvmultiphysicsCase, FlowFilesHoldTheWholeCycleInward) {
  SvmultiphysicsCaseOptions options;
  options.flow.waveform = builtin_waveform("coronary-right");
  options.flow.flow_ml_s = 0.5;
  const fs::path folder = made(options);
  const BoundaryFlow flow = boundary_flow(svmultiphysics_case_fork(), options.flow);
  std::istringstream in(core::read_file(folder / (flow.inlets[0].name + ".flow")));
  std::size_t count = 0, modes = 0;
  in >> count >> modes;
  EXPECT_EQ(modes, 12u);
  std::vector<double> values;
  for (double time = 0.0, value = 0.0; in >> time >> value;) {
    EXPECT_NEAR(value, -1e3 * flow.inlets[0].flow_ml_s(time), 1e-9);
    values.push_back(value);
  }
  ASSERT_EQ(values.size(), count);
  EXPECT_EQ(values.front(), values.back());
  EXPECT_EQ(conditions(folder)[1].at("bc_type"), "PRESSURE");
}

TEST(SvmultiphysicsCase, TheSolverFileIsXmlThatNamesFilesThatAreThere) {
  SvmultiphysicsCaseOptions options;
  options.flow.outlets = OutletModel::resistance;
  options.flow.blood.rheology = Rheology::carreau;
  const fs::path folder = made(options);
  const Shell parsed = shell(folder,
                             "/usr/bin/python3 -c 'import xml.etree.ElementTree as E, os\n"
                             "t = E.parse(\"solver.xml\").getroot()\n"
                             "files = [e.text.strip() for e in t.iter() if e.tag.endswith(\"_path\")]\n"
                             "assert all(os.path.exists(f) for f in files), files\n"
                             "faces = {e.get(\"name\") for e in t.iter(\"Add_face\")}\n"
                             "assert faces == {e.get(\"name\") for e in t.iter(\"Add_BC\")}, faces\n"
                             "print(t.tag, len(faces), len(files), t.find(\".//Density\").text.strip())'");
  EXPECT_TRUE(parsed.good) << parsed.output;
  EXPECT_EQ(parsed.output, "svMultiPhysicsFile 4 6 0.00106\n");
}

TEST(SvmultiphysicsCase, RefusesWhatTheSolverCannotTake) {
  const auto refused = [](const geometry::MixedMesh& mesh, const SvmultiphysicsCaseOptions& options,
                          const std::vector<std::string>& parts) {
    const fs::path folder = testing::temporary_folder("sv") / "case";
    expect_refusal([&] { write_svmultiphysics_case(mesh, options, folder); }, parts);
    EXPECT_TRUE(fs::is_empty(folder.parent_path())) << parts[0];
  };
  SvmultiphysicsCaseOptions options;
  options.flow.outlets = OutletModel::split;
  refused(svmultiphysics_case_fork(), options, {"svMultiPhysics", "resistances"});
  options = {};
  options.total_compliance_ml_mmhg = 0.1;
  refused(svmultiphysics_case_fork(), options, {"total compliance", "resistance"});
  options = {};
  options.steps_per_cycle = 2;
  refused(svmultiphysics_case_fork(), options, {"steps_per_cycle"});
  refused(vessel(geometry::straight_tube(6.0, 1.5), 0.6, 2, 0.3), {}, {"prisms", "split"});
}

}  // namespace
}  // namespace ostia::solver
