#pragma once
// An entry of what C-FIND answers.

#include "ostia/pacs/archive.h"

class DcmDataset;

namespace ostia::pacs {

/// In UTF-8; `readable` is false where the answer's character set is not known. Converts the answer itself.
Found found_in(DcmDataset& answer, bool& readable);

}  // namespace ostia::pacs
