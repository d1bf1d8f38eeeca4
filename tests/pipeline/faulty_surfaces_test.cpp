// The same with two faults at a time, and a tree of many outlets.

#include "foreign/whole_mesh.h"
#include "shared_data.h"

namespace ostia::pipeline {
namespace {

TEST(ForeignTree, Of46OutletsIsMeshedWithNoFurtherWord) {
  const ForeignKind kind = tree_of_46_outlets();
  const auto folder = testing::temporary_folder("foreign");
  expect_whole(build_model(load(write_foreign(kind, kind.make(), folder)), {}), kind);
}

/// Each kind with each pair of faults.
class FaultyForeignSurface : public ::testing::TestWithParam<ForeignKind> {};

TEST_P(FaultyForeignSurface, IsMendedAndMeshed) {
  const auto folder = testing::temporary_folder("foreign");
  const std::vector<Fault> all = faults();
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t k = i + 1; k < all.size(); ++k) {
      SCOPED_TRACE(all[i].name + " and " + all[k].name);
      ForeignKind kind = GetParam();
      MadeSurface made = kind.make();
      for (const Fault& fault : {all[i], all[k]}) {
        fault.add(made);
        fault.tell(kind);
      }
      if (!kind.calibre_tells_unit && kind.unit_mm != GetParam().unit_mm) continue;
      try {
        expect_whole(build_model(load(write_foreign(kind, made, folder)), {}), kind);
      } catch (const std::exception& error) {
        ADD_FAILURE() << error.what();
      }
    }
}

INSTANTIATE_TEST_SUITE_P(Kinds, FaultyForeignSurface, ::testing::ValuesIn(foreign_kinds()), name_of_kind);

}  // namespace
}  // namespace ostia::pipeline
