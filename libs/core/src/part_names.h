#pragma once
/// \file Hidden names of what is under construction: ".part-PROCESS-NUMBER-TARGET", beside the target.

#include <sys/types.h>

#include <optional>
#include <string>

namespace ostia::core {

/// A number of this process that counts as in work until it goes out of scope.
class PartNumber {
 public:
  PartNumber();
  ~PartNumber();
  PartNumber(const PartNumber&) = delete;
  PartNumber& operator=(const PartNumber&) = delete;
  /// The hidden name for a target called `target`. Its end is kept: writers of some libraries choose the
  /// format by the extension. Long names are shortened so that the file system's limit of 255 bytes holds.
  std::string name(const std::string& target) const;

 private:
  unsigned number_;
};

/// Whether `name` is one of these whose process is gone: no process of its number runs here, or it is this
/// one's and not in work (a number that an earlier process had, too: in a container they begin anew).
bool of_dead_process(const std::string& name);
/// The target's name (its end, where that is long) in such a hidden name.
std::string target_in(const std::string& part_name);
/// As `PartNumber::name` has it in the name.
std::string shortened(const std::string& target);

}  // namespace ostia::core
