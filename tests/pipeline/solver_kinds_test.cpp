#include "ostia/core/error.h"
#include "ostia/pipeline/solver_case.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <string_view>

namespace ostia::pipeline {
namespace {

using ::testing::HasSubstr;

TEST(SolverKinds, NamesGoThereAndBack) {
  std::set<std::string_view> names, titles, folders;
  for (const SolverKind kind : solver_kinds) {
    const SolverTraits& traits = traits_of(kind);
    EXPECT_EQ(traits.kind, kind);
    EXPECT_EQ(solver_kind(traits.name), kind);
    EXPECT_TRUE(names.insert(traits.name).second) << traits.name;
    EXPECT_TRUE(titles.insert(traits.title).second) << traits.title;
    EXPECT_TRUE(folders.insert(traits.folder).second) << traits.folder;
    EXPECT_FALSE(traits.run.empty()) << traits.name;
  }
  EXPECT_THAT(names, ::testing::UnorderedElementsAre("openfoam", "svmultiphysics"));
}

TEST(SolverKinds, AnUnknownNameIsToldTheKnownOnes) {
  try {
    solver_kind("fluent");
    FAIL() << "nothing was thrown";
  } catch (const InvalidInput& error) {
    EXPECT_THAT(error.what(), HasSubstr("fluent"));
    EXPECT_THAT(error.what(), HasSubstr("openfoam, svmultiphysics"));
  }
}

TEST(SolverKinds, ACaseIsOfTheSolverAndTheFlowThatWereAskedFor) {
  solver::BoundaryFlowOptions flow;
  flow.flow_ml_s = 0.7;
  for (const SolverKind kind : solver_kinds) {
    const SolverTraits& traits = traits_of(kind);
    const SolverCase made = solver_case(kind, flow);
    EXPECT_EQ(kind_of(made), kind);
    EXPECT_EQ(flow_of(made).flow_ml_s, 0.7);
    EXPECT_EQ(name_in_folder(made), traits.folder);
    EXPECT_THAT(parameters_json(made), HasSubstr("\"solver\":\"" + std::string(traits.name) + "\""));
  }
}

TEST(SolverKinds, TakesWhatTheTableSays) {
  solver::BoundaryFlowOptions shares;
  shares.outlets = solver::OutletModel::split;
  for (const SolverKind kind : solver_kinds) {
    const SolverTraits& traits = traits_of(kind);
    EXPECT_NO_THROW(require_takes(solver_case(kind), false, false)) << traits.name;
    if (traits.prisms) {
      EXPECT_NO_THROW(require_takes(solver_case(kind), true, false)) << traits.name;
    } else {
      EXPECT_THROW(require_takes(solver_case(kind), true, false), InvalidInput) << traits.name;
    }
    if (traits.shares) {
      EXPECT_NO_THROW(validate(solver_case(kind, shares))) << traits.name;
    } else {
      EXPECT_THROW(validate(solver_case(kind, shares)), InvalidInput) << traits.name;
    }
  }
}

}  // namespace
}  // namespace ostia::pipeline
