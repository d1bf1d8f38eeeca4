#include "output/kept_results.h"

#include "ostia/core/files.h"
#include "ostia/core/log.h"

#include <system_error>
#include <utility>

namespace ostia::app {
namespace fs = std::filesystem;
namespace {

/// An error with more to say, and the exit code that it had.
class FailedWithResults : public Error {
 public:
  FailedWithResults(const std::string& message, ExitCode code) : Error(message), code_(code) {}
  ExitCode exit_code() const noexcept override { return code_; }

 private:
  ExitCode code_;
};

fs::path hidden_beside(const fs::path& output) {
  const fs::path target = output.has_filename() ? output : output.parent_path();
  return target.parent_path() / (".unfinished-" + target.filename().string());
}

}  // namespace

KeptResults::KeptResults(const fs::path& keep, const fs::path& output)
    : folder_(keep.empty() ? hidden_beside(output) : keep), hidden_(keep.empty()) {}

void KeptResults::add(const std::string& name, std::function<void(const fs::path&)> write) {
  results_.push_back({name, std::move(write)});
}

void KeptResults::keep_and_throw(const Error& error) const {
  std::string names;
  try {
    forget();
    for (const Result& result : results_) {
      result.write(folder_ / result.name);
      if (!fs::exists(folder_ / result.name)) continue;
      names += (names.empty() ? "" : ", ") + result.name;
    }
  } catch (const Error& second) {
    core::log_warning(std::string("what was made until then could not be kept: ") + second.what());
  }
  if (names.empty()) throw FailedWithResults(error.what(), error.exit_code());
  throw FailedWithResults(
      std::string(error.what()) + "; what was made until then is kept in " + folder_.string() + ": " + names,
      error.exit_code());
}

void KeptResults::forget() const {
  std::error_code ignored;
  if (hidden_) fs::remove_all(folder_, ignored);
}

}  // namespace ostia::app
