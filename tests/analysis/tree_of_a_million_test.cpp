// A tree of 1.4 million segments against the published tables, and against itself.

#include "growth_stubs.h"
#include "published_sizes.h"

#include "ostia/analysis/graph_overlaps.h"

namespace {

using namespace ostia;
using namespace ostia::analysis;

TEST(TreeOfAMillion, HasThePublishedSizesAndMeetsNothing) {
  const GrownTree tree = grow_tree(analysis::testing::stubs(181, 0.231), domain_of(MyocardialShell{}));
  EXPECT_GT(tree.graph.edges.size(), 1'300'000U);
  analysis::testing::expect_published_sizes(tree, true);
  EXPECT_EQ(find_overlaps(tree.graph, geometry::GraphIncidence(tree.graph)).size(), 0U);
}

}  // namespace
