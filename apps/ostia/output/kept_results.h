#pragma once
/// \file What a command has made until it failed, kept for a person to look at.

#include "ostia/core/error.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace ostia::app {

/// The results between the steps of a command: on failure they are written into a folder, which the message
/// then names. Not for a command that was cancelled.
class KeptResults {
 public:
  /// `keep` left empty: the hidden folder `.unfinished-NAME` beside the output.
  KeptResults(const std::filesystem::path& keep, const std::filesystem::path& output);
  /// `write` is called with the result's file when the command fails, and never otherwise; it writes nothing
  /// where the result was not there yet. What it refers to must live as long as this.
  void add(const std::string& name, std::function<void(const std::filesystem::path&)> write);
  /// Does `work`; what it throws is thrown on, with the same exit code, when all that was added is written.
  template <class Work>
  auto guard(const Work& work) {
    try {
      auto result = work();
      forget();
      return result;
    } catch (const Cancelled&) {
      throw;
    } catch (const Error& error) {
      keep_and_throw(error);
    }
  }

 private:
  [[noreturn]] void keep_and_throw(const Error& error) const;
  /// An earlier failure's folder is of no use any more; one that was named stays.
  void forget() const;

  struct Result {
    std::string name;
    std::function<void(const std::filesystem::path&)> write;
  };
  std::filesystem::path folder_;
  bool hidden_;
  std::vector<Result> results_;
};

}  // namespace ostia::app
