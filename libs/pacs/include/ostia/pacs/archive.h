#pragma once
/// \file An image archive (PACS) on the network: search, fetch, send.

#include "ostia/core/error.h"
#include "ostia/core/task_context.h"
#include "ostia/pacs/server.h"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace ostia::pacs {

class Intake;

/// The server is not reached, does not answer in time or went away: the same call may succeed later.
class NetworkError : public ResourceError {
 public:
  using ResourceError::ResourceError;
};

enum class Level { study, series, image };

/// What is looked for; what is empty is not asked about. Texts in UTF-8, `*` and `?` stand for any
/// characters.
struct Query {
  Level level = Level::study;
  std::string patient_name;        ///< "DOE^J*"; of level study
  std::string patient_id;          ///< of level study
  std::string from_date, to_date;  ///< of the study, YYYYMMDD; of level study
  std::string description;         ///< of the study, or of the series at level series
  std::string modality;            ///< "CT"
  std::string study_uid;           ///< levels series and image need it
  std::string series_uid;          ///< level image needs it
  std::size_t most = 1000;         ///< results; what is beyond is cut off, and said
};
/// Throws InvalidInput naming the member.
void validate(const Query& query);

/// One study, series or image. UTF-8, whatever the server's character set; what is not known is empty.
struct Found {
  std::string study_uid, series_uid, sop_uid, sop_class;
  std::string patient_name;  ///< "DOE^JANE", the alphabetic part
  std::string patient_id, birth_date, study_date, study_time, accession, study_description, modality,
      series_description;
  std::string series_number;
  long images = -1;  ///< of the series or study; -1: not said
};
struct FindResult {
  std::vector<Found> found;
  bool cut_off = false;               ///< there was more
  std::vector<std::string> warnings;  ///< entries that could not be read; nobody is named
};

/// One series of one study.
struct SeriesWanted {
  std::string study_uid, series_uid;
};
struct Fetched {
  std::vector<std::filesystem::path> files;  ///< by SOP instance UID
  std::size_t announced = 0;                 ///< images that the server says it has
  std::size_t duplicates = 0;                ///< came again, and were dropped
  std::vector<std::string> warnings;
};

enum class SendState { sent, refused, unreachable };
struct SendResult {
  SendState state = SendState::sent;
  std::string reason;  ///< why it was not sent, or what the server remarked; nobody is named
};

/// One server. Every call opens and closes its own connections, is cancelled within a second, throws
/// NetworkError where the server does not answer, InvalidInput where it refuses (titles, login, certificates)
/// or answers what cannot be understood, and Cancelled. Messages name the server as it is called here, and
/// nobody. Calls of one object: one at a time.
class Archive {
 public:
  explicit Archive(ServerDescription server) : server_(std::move(server)) {}
  virtual ~Archive() = default;
  Archive(const Archive&) = delete;
  Archive& operator=(const Archive&) = delete;
  const ServerDescription& server() const { return server_; }

  /// That it is there and lets us in.
  virtual void echo(const core::TaskContext& task = core::no_task()) = 0;
  virtual FindResult find(const Query& query, const core::TaskContext& task = core::no_task()) = 0;

  /// The series' files in `folder`, which must not exist and appears whole or not at all, readable by its
  /// owner alone; memory does not grow with the series. Each object is written to disk as it comes and must
  /// be of this series, study and patient. What a broken connection left out is asked for again (`attempts`).
  /// Throws also NetworkError where objects are missing in the end, ResourceError (disk full), IoError.
  Fetched fetch(const SeriesWanted& wanted, const std::filesystem::path& folder,
                const core::TaskContext& task = core::no_task());

  /// One image out of the middle of the series, of those that the server lists: a file in `folder`, which
  /// must not exist, is readable by its owner alone and appears with it or not at all. No second attempt.
  /// Throws as `fetch` does.
  std::filesystem::path fetch_middle(const SeriesWanted& wanted, const std::filesystem::path& folder,
                                     const core::TaskContext& task = core::no_task());

  /// DICOM files, each by itself: one result a file, in their order. What the server has already it is sent
  /// again under the same SOP instance UID, which makes no copy. Throws Cancelled alone.
  std::vector<SendResult> send(const std::vector<std::filesystem::path>& files,
                               const core::TaskContext& task = core::no_task());

 protected:
  /// Asks for the series (`missing` empty) or these of its images and puts them into `intake`. A connection
  /// that breaks is a NetworkError; what was whole until then stays.
  virtual void retrieve(const SeriesWanted& wanted, const std::vector<std::string>& missing, Intake& intake,
                        const core::TaskContext& task) = 0;
  /// Sends files over one connection and appends a result for each. NetworkError: what has no result yet was
  /// not sent.
  virtual void store(const std::vector<std::filesystem::path>& files, std::vector<SendResult>& results,
                     const core::TaskContext& task) = 0;

 private:
  /// Asks for what is not there yet, and for a list of it where that is needed or `list_first`. Returns why
  /// the connection broke; empty: it did not.
  std::string attempted(const SeriesWanted& wanted, Intake& intake, bool list_first,
                        const core::TaskContext& task);
  ServerDescription server_;
};

/// Throws InvalidInput (validate).
std::unique_ptr<Archive> open_archive(const ServerDescription& server, const Secrets& secrets = {});

}  // namespace ostia::pacs
