#include "commands/search.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ostia::workstation {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

const QStringList go_to{"View", "Go to"};

int rank(const QString& typed, const QString& text, const QStringList& menus = go_to) {
  const auto found = match(typed, text, menus);
  return found ? found->rank : -1;
}

TEST(CommandSearch, NothingTypedFitsEverything) {
  for (const char* typed : {"", "  "}) {
    const auto found = match(typed, "Next stenosis", go_to);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->rank, 0);
    EXPECT_THAT(found->marks, IsEmpty());
  }
}

TEST(CommandSearch, UpperAndLowerCaseAreTheSame) {
  EXPECT_TRUE(match("NEXT", "Next stenosis", {}));
  EXPECT_TRUE(match("\u00e4ndern", "\u00c4ndern", {}));
}

TEST(CommandSearch, WordsFitInAnyOrderAndAreMarked) {
  const auto found = match("sten nex", "Next stenosis", {});
  ASSERT_TRUE(found);
  EXPECT_THAT(found->marks, ElementsAre(0, 1, 2, 5, 6, 7, 8));
}

TEST(CommandSearch, TheMenusCountAndAreNotMarked) {
  const auto found = match("go next", "Next stenosis", go_to);
  ASSERT_TRUE(found);
  EXPECT_THAT(found->marks, ElementsAre(0, 1, 2, 3));
  EXPECT_FALSE(match("file next", "Next stenosis", go_to));
}

TEST(CommandSearch, CharactersFitInTheirOrder) {
  const auto found = match("nxst", "Next stenosis", {});
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->scattered);
  EXPECT_THAT(found->marks, ElementsAre(0, 2, 5, 6));
  EXPECT_FALSE(match("stnx", "Next stenosis", {})) << "the other way round";
  EXPECT_FALSE(match("nextt stenosiss", "Next stenosis", {}));
}

TEST(CommandSearch, AWordsBeginningIsMarkedRatherThanItsMiddle) {
  EXPECT_THAT(match("me", "Volume mesh", {})->marks, ElementsAre(7, 8));
}

TEST(CommandSearch, WhatFitsBetterComesFirst) {
  const std::vector<int> ranks{rank("mesh", "Mesh of the wall"), rank("mesh", "A mesh"),
                               rank("esh", "A mesh"), rank("view", "Next stenosis"),
                               rank("nxst", "Next stenosis")};
  for (std::size_t i = 0; i + 1 < ranks.size(); ++i) EXPECT_LT(ranks[i], ranks[i + 1]) << i;
  EXPECT_GE(ranks.front(), 0);
}

}  // namespace
}  // namespace ostia::workstation
