// Names in the character sets of the world (PS3.5 H, I, J).

#include "dimse_found.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcdatset.h>
#include <dcmtk/dcmdata/dcdeftag.h>
#include <gtest/gtest.h>

namespace ostia::pacs {
namespace {

struct NamedCase {
  const char *set, *name, *expected;
  bool readable = true;
};

TEST(DimseFound, NamesComeInTheirOwnLetters) {
  const NamedCase cases[] = {
      {"", "DOE^JANE", "DOE^JANE"},
      {"ISO_IR 100", "M\xFCller^J\xFCrg", "M\xC3\xBCller^J\xC3\xBCrg"},
      {"ISO_IR 192", "M\xC3\xBCller^J\xC3\xBCrg", "M\xC3\xBCller^J\xC3\xBCrg"},
      {"ISO_IR 144", "\xBB\xEE\xDA", "\xD0\x9B\xD1\x8E\xD0\xBA"},
      // Yamada^Tarou of PS3.5 H.3.1, whose ideographs Debian's DCMTK does not know.
      {"\\ISO 2022 IR 87", "Yamada^Tarou=\x1B$B;3ED\x1B(B^\x1B$BB@O:\x1B(B", "Yamada^Tarou", false},
      // Hong^Gildong of PS3.5 I.2, whose ideographic part stands alone.
      {"\\ISO 2022 IR 149", "=\x1B$)C\xFB\xF3^\x1B$)C\xD1\xCE\xD4\xD7",
       "\xE6\xB4\xAA^\xE5\x90\x89\xE6\xB4\x9E"},
      {"NO SUCH SET", "A\xFF", "A?", false},
  };
  for (const NamedCase& one : cases) {
    DcmDataset answer;
    if (*one.set != 0) answer.putAndInsertString(DCM_SpecificCharacterSet, one.set);
    answer.putAndInsertString(DCM_PatientName, one.name);
    bool readable = false;
    EXPECT_EQ(found_in(answer, readable).patient_name, one.expected) << one.set;
    EXPECT_EQ(readable, one.readable) << one.set;
  }
}

TEST(DimseFound, CountsThatAreNoneAreNotSaid) {
  for (const auto& [text, images] : {std::pair{"12", 12L}, {"0", 0L}, {"-3", -1L}, {"x", -1L}, {"", -1L}}) {
    DcmDataset answer;
    answer.putAndInsertString(DCM_NumberOfSeriesRelatedInstances, text);
    bool readable = false;
    EXPECT_EQ(found_in(answer, readable).images, images) << text;
  }
}

}  // namespace
}  // namespace ostia::pacs
