#include "output/told.h"
#include "pacs/pacs_server.h"

#include "ostia/core/log.h"
#include "ostia/imaging/dicom_texts.h"
#include "ostia/imaging/files_below.h"
#include "ostia/pacs/send_queue.h"

#include <algorithm>
#include <cstdio>
#include <set>

namespace ostia::app {
namespace {

/// Files as they are given; of folders, the DICOM objects below them, by name.
std::vector<std::filesystem::path> objects_of(const std::vector<std::filesystem::path>& inputs) {
  std::vector<std::filesystem::path> all;
  for (const std::filesystem::path& input : inputs) {
    if (!std::filesystem::exists(input)) throw IoError(input.string() + " is not there");
    if (!std::filesystem::is_directory(input)) {
      all.push_back(input);
      continue;
    }
    for (const std::filesystem::path& file : imaging::files_below(input)) {
      imaging::DicomTexts none;
      if (imaging::read_dicom_texts(file, none)) all.push_back(file);
    }
  }
  if (all.empty()) throw InvalidInput("there is no DICOM object to send");
  return all;
}

struct Tally {
  std::size_t sent = 0, refused = 0, waiting = 0;
  std::set<std::string> reasons{};
};

Tally counted_items(const std::vector<pacs::QueueItem>& items) {
  Tally tally;
  for (const pacs::QueueItem& item : items) {
    ++(item.state == pacs::QueueState::sent     ? tally.sent
       : item.state == pacs::QueueState::failed ? tally.refused
                                                : tally.waiting);
    if (item.state != pacs::QueueState::sent && !item.reason.empty()) tally.reasons.insert(item.reason);
  }
  return tally;
}

std::string told_tally(const Tally& tally) {
  return std::to_string(tally.sent) + " sent, " + std::to_string(tally.refused) + " refused, " +
         std::to_string(tally.waiting) + " not sent yet";
}

/// Through a queue: what cannot be sent now waits there.
Tally send_queued(const PacsSendCommand& o, const std::vector<std::filesystem::path>& files,
                  const core::TaskContext& task) {
  pacs::SendQueue queue(o.queue);
  std::set<std::string> ids;
  for (const std::filesystem::path& file : files) ids.insert(queue.add(file, o.at.server));
  queue.send_waiting([&](const std::string& server) { return archive_at(o.at, server); }, task);
  std::vector<pacs::QueueItem> these = queue.items();
  these.erase(std::remove_if(these.begin(), these.end(),
                             [&](const pacs::QueueItem& one) { return ids.count(one.id) == 0; }),
              these.end());
  return counted_items(these);
}

Tally send_now(const PacsSendCommand& o, const std::vector<std::filesystem::path>& files,
               const core::TaskContext& task) {
  Tally tally;
  for (const pacs::SendResult& one : archive_at(o.at)->send(files, task)) {
    ++(one.state == pacs::SendState::sent      ? tally.sent
       : one.state == pacs::SendState::refused ? tally.refused
                                               : tally.waiting);
    if (!one.reason.empty()) tally.reasons.insert(one.reason);
  }
  return tally;
}

}  // namespace

ExitCode run_pacs_send(const PacsSendCommand& o, const core::TaskContext& task) {
  const std::vector<std::filesystem::path> files = objects_of(o.inputs);
  const Tally tally = o.queue.empty() ? send_now(o, files, task) : send_queued(o, files, task);
  task.set_progress(1.0);
  for (const std::string& reason : tally.reasons) core::log_warning(reason);
  tell("pacs-send", {{"sent", tally.sent}, {"refused", tally.refused}, {"not_sent", tally.waiting}},
       told_tally(tally), o.json);
  return sending_code(tally.refused, tally.waiting);
}

ExitCode run_pacs_queue(const PacsQueueCommand& o, const core::TaskContext& task) {
  if (!std::filesystem::is_directory(o.queue)) throw IoError("there is no queue in " + o.queue.string());
  pacs::SendQueue queue(o.queue);
  if (o.retry) queue.retry_failed();
  if (o.send || o.retry)
    queue.send_waiting([&](const std::string& server) { return archive_at(o.at, server); }, task);
  const std::vector<pacs::QueueItem> items = queue.items();
  if (o.forget) queue.forget_sent();
  task.set_progress(1.0);
  ToldJson told = ToldJson::array();
  for (const pacs::QueueItem& item : items) {
    told.push_back({{"id", item.id},
                    {"server", item.server},
                    {"state", pacs::to_string(item.state)},
                    {"reason", item.reason},
                    {"attempts", item.attempts}});
    if (!o.json)
      std::printf("%s  %s  %s  %s\n", item.id.c_str(), item.server.c_str(),
                  pacs::to_string(item.state).c_str(), item.reason.c_str());
  }
  const Tally tally = counted_items(items);
  tell("pacs-queue", {{"items", std::move(told)}}, told_tally(tally), o.json);
  return o.send || o.retry ? sending_code(tally.refused, tally.waiting) : ExitCode::ok;
}

}  // namespace ostia::app
