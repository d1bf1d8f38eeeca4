#pragma once
// The parts of a WADO-RS answer as files.

#include "intake.h"
#include "multipart.h"

#include <filesystem>
#include <string_view>

namespace ostia::pacs {

/// Writes each part to a file of the intake's and has it taken. Throws ResourceError (disk full), IoError,
/// and InvalidInput where the intake has found a fault of the server's.
class PartFiles final : public PartSink {
 public:
  explicit PartFiles(Intake& intake) : intake_(intake) {}
  ~PartFiles() override;  ///< what is not whole goes
  void begin_part(std::string_view headers) override;
  void body(std::string_view bytes) override;
  void end_part() override;

 private:
  Intake& intake_;
  std::filesystem::path part_;
  int file_ = -1;
};

}  // namespace ostia::pacs
