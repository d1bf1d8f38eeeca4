#pragma once
/// \file Steps of a chain that were done, so that another run need not do them again.

#include "chain/chain.h"

#include "ostia/core/error.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace ostia::app {

struct DoneStep {
  std::string key;    ///< of keys_of
  std::string title;  ///< ChainStep::title
  ExitCode code = ExitCode::ok;
  double seconds = 0.0, peak_mb = 0.0;
  std::map<std::string, std::string> outputs;  ///< file, relative to the chain's folder: SHA-256
};

/// What decides a step's result, one text a step: its words, the content of what it reads from outside
/// (`digests`, of Chain::inputs in their order), the steps whose results it reads, the program's version.
std::vector<std::string> keys_of(const Chain& chain, const std::vector<std::string>& digests);

/// A JSON object, {"v": 1, "kind": "run", "steps": [...]}.
std::string text_of(const std::vector<DoneStep>& steps);
/// Reads it back; none where the text is no such object.
std::vector<DoneStep> done_steps(const std::string& text);

/// The digest of each file of these results in `folder`.
std::map<std::string, std::string> digests_of_results(const std::filesystem::path& folder,
                                                      const std::vector<std::string>& results);
/// Whether all that the step made is in `folder`, as it was made.
bool whole(const DoneStep& step, const std::filesystem::path& folder);

}  // namespace ostia::app
