#include "ostia/core/phrasebook.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

namespace ostia::core {
namespace {

const Phrasebook& book() {
  static const Phrasebook made({{"not found", "nicht gefunden"},
                                {"no clear edge", "keine klare Kante"},
                                {"limited", "eingeschränkt"},
                                {"%t1 (%l2)", "%t1 (%l2)"},
                                {"%1: %t2", "%1: %t2"},
                                {"slices %1 mm apart", "Schichten alle %1 mm"},
                                {"%t1; up to %2 is usual", "%t1; üblich sind bis %2"},
                                {"Not judged: %l1.", "Nicht beurteilt: %l1."},
                                {"%1 from %2 to %3 mm: %t4", "%1 von %2 bis %3 mm: %t4"}});
  return made;
}

TEST(Phrasebook, SaysPlainTextsAndTextsWithPlaces) {
  EXPECT_EQ(book().say("not found"), "nicht gefunden");
  EXPECT_EQ(book().say("slices 1.50 mm apart"), "Schichten alle 1.50 mm");
  EXPECT_EQ(book().say("LAD from 3 to 5 mm: limited"), "LAD von 3 bis 5 mm: eingeschränkt");
}

TEST(Phrasebook, WhatStandsAtAPlaceIsKeptOrSaidAsItsKindHasIt) {
  EXPECT_EQ(book().say("limited: limited"), "limited: eingeschränkt") << "a vessel of that name";
  EXPECT_EQ(book().say("slices 1.50 mm apart; up to 0.8 is usual"),
            "Schichten alle 1.50 mm; üblich sind bis 0.8");
}

TEST(Phrasebook, ListsAndLinesAreTakenPartByPart) {
  EXPECT_EQ(book().say("Not judged: RCA: not found; LAD from 3 to 5 mm: limited."),
            "Nicht beurteilt: RCA: nicht gefunden; LAD von 3 bis 5 mm: eingeschränkt.");
  EXPECT_EQ(book().say("limited (no clear edge, limited)"),
            "eingeschränkt (keine klare Kante, eingeschränkt)");
  EXPECT_EQ(book().say("not found\nlimited"), "nicht gefunden\neingeschränkt");
}

TEST(Phrasebook, WhatItDoesNotKnowStays) {
  for (const char* text : {"", "none", "slices  mm apart", "slices 1 mm apart ", ";", ", "})
    EXPECT_EQ(book().say(text), text);
  EXPECT_TRUE(book().knows("slices 3 mm apart"));
  EXPECT_FALSE(book().knows("slices"));
  EXPECT_EQ(Phrasebook().say("not found"), "not found");
}

TEST(Phrasebook, APercentSignIsNoPlace) {
  const Phrasebook of_percents(std::vector<Phrase>{{"%1 % of all", "%1 % von allem"}});
  EXPECT_EQ(of_percents.say("12 % of all"), "12 % von allem");
}

TEST(Phrasebook, RefusesPhrasesThatCannotBeSaid) {
  using All = std::vector<Phrase>;
  EXPECT_THROW(Phrasebook(All{{"a %1", "b"}}), InvalidInput);
  EXPECT_THROW(Phrasebook(All{{"a %1", "b %t1"}}), InvalidInput);
  EXPECT_THROW(Phrasebook(All{{"a", "b %1"}}), InvalidInput);
  EXPECT_THROW(Phrasebook(All{{"%1%2 a", "%1%2 b"}}), InvalidInput);
  EXPECT_THROW(Phrasebook(All{{"%1", "%1"}}), InvalidInput);
  EXPECT_THROW(Phrasebook(All{{"a", ""}}), InvalidInput);
  EXPECT_THROW(Phrasebook(All{{"a", "b"}, {"a", "c"}}), InvalidInput);
}

}  // namespace
}  // namespace ostia::core
