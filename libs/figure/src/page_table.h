#pragma once
/// \file A table on pages: columns that fit, cells in lines, the header again on each page.

#include "page_flow.h"

#include <string>
#include <vector>

namespace ostia::figure {

struct PageTable {
  std::vector<std::string> header;  ///< none: a table of facts, whose first column is their names
  std::vector<std::vector<std::string>> rows;
  std::string caption;
};
void put_table(PageFlow& flow, const PageTable& table);

}  // namespace ostia::figure
