// Surfaces of other programs' kinds, from the file to the mesh, with nothing said about them.

#include "foreign/whole_mesh.h"
#include "shared_data.h"

namespace ostia::pipeline {
namespace {

class ForeignSurface : public ::testing::TestWithParam<ForeignKind> {};

TEST_P(ForeignSurface, IsMeshedWithNoFurtherWord) {
  const ForeignKind& kind = GetParam();
  const auto folder = testing::temporary_folder("foreign");
  expect_whole(build_model(load(write_foreign(kind, kind.make(), folder)), {}), kind);
}

INSTANTIATE_TEST_SUITE_P(Kinds, ForeignSurface, ::testing::ValuesIn(foreign_kinds()), name_of_kind);

}  // namespace
}  // namespace ostia::pipeline
