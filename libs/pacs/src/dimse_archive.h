#pragma once
// An archive by DICOM's own protocol.

#include "dimse_connection.h"

#include "ostia/pacs/archive.h"

#include <utility>

namespace ostia::pacs {

class DimseArchive final : public Archive {
 public:
  DimseArchive(ServerDescription server, Secrets secrets)
      : Archive(std::move(server)), secrets_(std::move(secrets)) {}
  void echo(const core::TaskContext& task) override;
  FindResult find(const Query& query, const core::TaskContext& task) override;  // dimse_find.cpp

 protected:
  void retrieve(const SeriesWanted& wanted, const std::vector<std::string>& missing, Intake& intake,
                const core::TaskContext& task) override;  // dimse_retrieve.cpp
  void store(const std::vector<std::filesystem::path>& files, std::vector<SendResult>& results,
             const core::TaskContext& task) override;  // dimse_store.cpp

 private:
  void get(const SeriesWanted& wanted, const std::vector<std::string>& images, Intake& intake,
           const core::TaskContext& task);
  void move(const SeriesWanted& wanted, const std::vector<std::string>& images, Intake& intake,
            const core::TaskContext& task);
  Secrets secrets_;
};

}  // namespace ostia::pacs
