#pragma once
/// \file A chain of commands from a JSON file (docs/reference/pipelines.md; schema
/// docs/schemas/pipeline.schema.json).

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace ostia::app {

/// One command of a chain, ready to run.
struct ChainStep {
  std::string title;               ///< "segment", "evaluate lumen"
  std::vector<std::string> words;  ///< of its command line, without the program's name
  /// The same words with "input 1", "input 2" (in the order of Chain::inputs) for what is read from outside,
  /// and bare names for results: what is done, wherever it is done.
  std::vector<std::string> meaning;
  std::vector<std::string> makes;  ///< names of its results
  std::vector<std::size_t> reads;  ///< indices of Chain::inputs
  std::vector<std::size_t> uses;   ///< earlier steps whose results it reads
  void add(const std::string& word, const std::string& means) {
    words.push_back(word);
    meaning.push_back(means);
  }
};

struct Chain {
  std::vector<ChainStep> steps;
  std::vector<std::filesystem::path> inputs;  ///< what is read from outside
};

using Variables = std::map<std::string, std::string>;

/// Reads a chain. `{name}` in its texts are variables: those of `given`, else of the file. A name that a step
/// gives as its output, or a name within it ("mesh/mesh.vtu"), lies in `folder`, any other relative name
/// beside `file`. Throws InvalidInput that names the file, the step and the member: for what is no chain, a
/// variable that is not there or is not used, an input that is neither a file nor made by an earlier step.
Chain read_chain(const std::filesystem::path& file, const Variables& given,
                 const std::filesystem::path& folder);

}  // namespace ostia::app
