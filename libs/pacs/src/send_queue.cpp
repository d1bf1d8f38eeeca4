#include "ostia/pacs/send_queue.h"

#include "uid.h"

#include "ostia/core/files.h"
#include "ostia/imaging/dicom_texts.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <utility>

namespace ostia::pacs {
namespace {

using QueueJson = nlohmann::ordered_json;

constexpr std::uint32_t kQueuedInstance = 0x00080018;
constexpr std::size_t batch = 20;  // objects between two notes of what has become of them
constexpr std::size_t id_digits = 32;
constexpr std::array<std::pair<QueueState, const char*>, 3> state_words{
    {{QueueState::waiting, "waiting"}, {QueueState::sent, "sent"}, {QueueState::failed, "failed"}}};

QueueItem item_of(const std::filesystem::path& file) {
  const QueueJson json = QueueJson::parse(core::read_file(file, 1U << 20), nullptr, false);
  const auto text = [&](const char* name) {
    return json.is_object() && json.contains(name) && json[name].is_string() ? json[name].get<std::string>()
                                                                             : std::string();
  };
  QueueItem item;
  item.id = file.stem().string();
  item.server = text("server");
  item.reason = text("reason");
  const std::string state = text("state");
  const auto known = std::find_if(state_words.begin(), state_words.end(),
                                  [&](const auto& one) { return state == one.second; });
  if (item.server.empty() || known == state_words.end() || !json.contains("attempts") ||
      !json["attempts"].is_number_integer())
    throw InvalidInput("the queue's file " + file.string() +
                       " is damaged; remove it and queue the object again");
  item.state = known->first;
  item.attempts = json["attempts"].get<int>();
  item.what = text("what");
  return item;
}

}  // namespace

std::string to_string(QueueState state) {
  return std::find_if(state_words.begin(), state_words.end(),
                      [&](const auto& one) { return one.first == state; })
      ->second;
}

SendQueue::SendQueue(std::filesystem::path folder) : folder_(std::move(folder)) {
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (error) throw IoError("cannot make the queue's folder " + folder_.string() + ": " + error.message());
  std::filesystem::permissions(folder_, std::filesystem::perms::owner_all, error);
  if (error)
    throw IoError("cannot make the queue's folder " + folder_.string() + " yours alone: " + error.message());
  lock_ = std::make_unique<core::FolderLock>(folder_, folder_, "; wait until it has sent what it sends");
  core::remove_dead_parts(folder_);
  // What was killed between two files of one item: an object without a note was not added yet, one whose note
  // says that it is sent is not needed.
  std::vector<std::filesystem::path> objects;
  for (const auto& entry : std::filesystem::directory_iterator(folder_))
    if (entry.path().extension() == ".dcm") objects.push_back(entry.path());
  for (const std::filesystem::path& object : objects) {
    const std::filesystem::path told = file_of(object.stem().string(), ".json");
    if (!std::filesystem::exists(told) || item_of(told).state == QueueState::sent)
      std::filesystem::remove(object);
  }
}

std::filesystem::path SendQueue::file_of(const std::string& id, const char* extension) const {
  return folder_ / (id + extension);
}

void SendQueue::note(const QueueItem& item) const {
  QueueJson json{{"v", 1},
                 {"server", item.server},
                 {"state", to_string(item.state)},
                 {"reason", item.reason},
                 {"attempts", item.attempts}};
  if (!item.what.empty()) json["what"] = item.what;
  core::write_file(file_of(item.id, ".json"), json.dump(1) + "\n");
}

std::string SendQueue::add(const std::filesystem::path& file, const std::string& server,
                           const std::string& what) {
  imaging::DicomTexts texts{{kQueuedInstance, {}}};
  if (!imaging::read_dicom_texts(file, texts) || !is_uid(texts[kQueuedInstance]))
    throw InvalidInput(file.string() + " is no DICOM object");
  QueueItem item;
  item.id = core::sha256(server + "\n" + texts[kQueuedInstance]).substr(0, id_digits);
  item.server = server;
  item.what = what;
  if (const auto told = file_of(item.id, ".json");
      std::filesystem::exists(told) && item_of(told).state == QueueState::waiting)
    return item.id;
  core::StagedFile copy(file_of(item.id, ".dcm"));
  std::error_code error;
  std::filesystem::copy_file(file, copy.temporary(), std::filesystem::copy_options::overwrite_existing,
                             error);
  if (error == std::errc::no_space_on_device || error == std::errc::file_too_large)
    throw ResourceError("cannot queue " + file.string() + ": the disk is full");
  if (error) throw IoError("cannot queue " + file.string() + ": " + error.message());
  std::filesystem::permissions(copy.temporary(),
                               std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  copy.commit();
  note(item);
  return item.id;
}

std::vector<QueueItem> SendQueue::items() const {
  std::vector<QueueItem> all;
  for (const auto& entry : std::filesystem::directory_iterator(folder_))
    if (entry.path().extension() == ".json") all.push_back(item_of(entry.path()));
  std::sort(all.begin(), all.end(), [](const QueueItem& a, const QueueItem& b) { return a.id < b.id; });
  return all;
}

void SendQueue::retry_failed() {
  for (QueueItem& item : items()) {
    if (item.state != QueueState::failed) continue;
    item.state = QueueState::waiting;
    note(item);
  }
}

void SendQueue::retry(const std::string& id) {
  for (QueueItem& item : items()) {
    if (item.id != id || item.state != QueueState::failed) continue;
    item.state = QueueState::waiting;
    note(item);
  }
}

void SendQueue::remove(const std::string& id) {
  for (const QueueItem& item : items()) {
    if (item.id != id) continue;
    // The note first: an object without one was never added.
    std::filesystem::remove(file_of(id, ".json"));
    std::filesystem::remove(file_of(id, ".dcm"));
  }
}

void SendQueue::forget_sent() {
  for (const QueueItem& item : items())
    if (item.state == QueueState::sent) std::filesystem::remove(file_of(item.id, ".json"));
}

void SendQueue::send_waiting(const ArchiveOf& archive_of, const core::TaskContext& task) {
  std::map<std::string, std::vector<QueueItem>> by_server;
  std::size_t count = 0, done = 0;
  for (const QueueItem& item : items()) {
    if (item.state != QueueState::waiting) continue;
    by_server[item.server].push_back(item);
    ++count;
  }
  const auto conclude = [&](QueueItem& item, const SendResult& result) {
    ++item.attempts;
    item.reason = result.reason;
    item.state = result.state == SendState::sent      ? QueueState::sent
                 : result.state == SendState::refused ? QueueState::failed
                                                      : QueueState::waiting;
    note(item);
    if (item.state == QueueState::sent) std::filesystem::remove(file_of(item.id, ".dcm"));
    task.set_progress(static_cast<double>(++done) / static_cast<double>(count));
  };
  for (auto& [server, waiting] : by_server) {
    std::unique_ptr<Archive> archive;
    try {
      archive = archive_of(server);
    } catch (const InvalidInput& error) {
      for (QueueItem& item : waiting) conclude(item, {SendState::refused, error.what()});
      continue;
    }
    for (std::size_t first = 0; first < waiting.size(); first += batch) {
      const std::size_t end = std::min(first + batch, waiting.size());
      std::vector<std::filesystem::path> files;
      for (std::size_t n = first; n < end; ++n) files.push_back(file_of(waiting[n].id, ".dcm"));
      const std::vector<SendResult> results = archive->send(
          files, task.sub(static_cast<double>(done) / static_cast<double>(count),
                          static_cast<double>(done + files.size()) / static_cast<double>(count)));
      for (std::size_t n = first; n < end; ++n) conclude(waiting[n], results[n - first]);
      if (results.back().state != SendState::unreachable) continue;
      for (std::size_t n = end; n < waiting.size(); ++n) {  // not tried: it would be silent for each, too
        waiting[n].reason = results.back().reason;
        note(waiting[n]);
      }
      done += waiting.size() - end;
      break;
    }
  }
}

}  // namespace ostia::pacs
