#pragma once
/// \file Pictures of files that differ between two runs.

#include "suite_files.h"

#include "ostia/figure/picture.h"

#include <string>
#include <vector>

namespace ostia::evaluation {

struct CaptionedPicture {
  figure::Picture picture;
  std::string caption;
};

/// What there is to see of one pair of files, by its kind; nothing for kinds without a picture.
std::vector<CaptionedPicture> pictures_of(const FilePair& pair, FileKind kind, const core::TaskContext& task);

/// A JSON figure over all files that have it: golden and result side by side, file by file.
figure::Picture figure_plot(const std::string& key, const std::vector<const ComparedFile*>& files);

}  // namespace ostia::evaluation
