// What waits to be sent survives whatever happens to the program.

#include "ostia/pacs/send_queue.h"

#include "shared_data.h"
#include "small_series.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"

#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <set>

namespace ostia::pacs {
namespace {

using ::testing::HasSubstr;
using testing::small_series;
using testing::SmallSeries;

/// Stores by SOP instance UID, as archives do, in a folder that outlives the program.
class FolderArchive : public Archive {
 public:
  FolderArchive(std::filesystem::path folder, SendResult answer)
      : Archive(once()), folder_(std::move(folder)), answer_(std::move(answer)) {}
  void echo(const core::TaskContext&) override {}
  FindResult find(const Query&, const core::TaskContext&) override { return {}; }

 protected:
  void retrieve(const SeriesWanted&, const std::vector<std::string>&, Intake&,
                const core::TaskContext&) override {}
  void store(const std::vector<std::filesystem::path>& files, std::vector<SendResult>& results,
             const core::TaskContext&) override {
    for (const auto& file : files) {
      if (answer_.state == SendState::unreachable) throw NetworkError(answer_.reason);
      if (answer_.state == SendState::sent)
        core::write_file(folder_ / core::sha256_file(file), core::read_file(file));
      results.push_back(answer_);
    }
  }

 private:
  static ServerDescription once() {
    ServerDescription server;
    server.attempts = 1;
    return server;
  }
  std::filesystem::path folder_;
  SendResult answer_;
};

struct Queue : ::testing::Test {
  std::filesystem::path folder = testing::temporary_folder("queue") / "outbox",
                        store = testing::temporary_folder("store");
  SmallSeries series = small_series("queue");

  SendQueue::ArchiveOf answering(const SendResult& answer) {
    return [this, answer](const std::string&) {
      auto archive = std::make_unique<FolderArchive>(store, answer);
      return archive;
    };
  }
  /// Objects in the archive, without what a killed program had half written there.
  std::size_t stored() const {
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(store))
      count += entry.path().filename().string().front() != '.' ? 1 : 0;
    return count;
  }
  static std::multiset<std::string> states(const SendQueue& queue) {
    std::multiset<std::string> all;
    for (const QueueItem& item : queue.items()) all.insert(to_string(item.state));
    return all;
  }
  std::multiset<std::string> states() const { return states(SendQueue(folder)); }
};

TEST_F(Queue, TheSameObjectForTheSameServerIsOneItem) {
  SendQueue queue(folder);
  EXPECT_EQ(queue.add(series.files[0], "a"), queue.add(series.files[0], "a"));
  queue.add(series.files[0], "b");
  queue.add(series.files[1], "a");
  EXPECT_EQ(queue.items().size(), 3u);
  EXPECT_EQ(std::filesystem::status(folder).permissions(), std::filesystem::perms::owner_all);
}

TEST_F(Queue, ItsNotesNameNobody) {
  SendQueue queue(folder);
  queue.add(series.files[0], "a");
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    EXPECT_EQ(entry.path().string().find(series.sop_uids[0]), std::string::npos);
    if (entry.path().extension() == ".json") {
      EXPECT_EQ(core::read_file(entry.path()).find("DOE"), std::string::npos);
    }
  }
}

TEST_F(Queue, WhatIsSentIsGoneAndRemembered) {
  {
    SendQueue queue(folder);
    for (const auto& file : series.files) queue.add(file, "a");
    queue.send_waiting(answering({}));
    EXPECT_EQ(stored(), 5u);
    for (const auto& entry : std::filesystem::directory_iterator(folder))
      EXPECT_NE(entry.path().extension(), ".dcm");
  }
  EXPECT_EQ(states(), (std::multiset<std::string>{"sent", "sent", "sent", "sent", "sent"}));
  SendQueue queue(folder);
  queue.send_waiting(
      [](const std::string&) -> std::unique_ptr<Archive> { throw InvalidInput("nothing was to be sent"); });
  queue.forget_sent();
  EXPECT_TRUE(queue.items().empty());
}

TEST_F(Queue, AServerThatIsNotReachedLeavesItsItemsWaiting) {
  SendQueue queue(folder);
  queue.add(series.files[0], "a");
  queue.send_waiting(answering({SendState::unreachable, "no answer"}));
  ASSERT_EQ(queue.items().size(), 1u);
  EXPECT_EQ(queue.items()[0].state, QueueState::waiting);
  EXPECT_EQ(queue.items()[0].reason, "no answer");
  queue.send_waiting(answering({}));
  EXPECT_EQ(queue.items()[0].state, QueueState::sent);
  EXPECT_EQ(queue.items()[0].attempts, 2);
}

TEST_F(Queue, WhatIsRefusedWaitsForAPerson) {
  SendQueue queue(folder);
  queue.add(series.files[0], "a");
  queue.send_waiting(answering({SendState::refused, "not this kind"}));
  EXPECT_EQ(queue.items()[0].state, QueueState::failed);
  queue.send_waiting(answering({}));
  EXPECT_EQ(stored(), 0u) << "a refused object was sent again";
  queue.retry_failed();
  queue.send_waiting(answering({}));
  EXPECT_EQ(stored(), 1u);
}

TEST_F(Queue, OneItemIsTriedAgainOrTakenOutAndSaysWhatItIs) {
  SendQueue queue(folder);
  const std::string one = queue.add(series.files[0], "a", "pdf"), other = queue.add(series.files[1], "a");
  queue.send_waiting(answering({SendState::refused, "no"}));
  queue.retry(one);
  queue.retry("nobody's");
  EXPECT_EQ(states(queue), (std::multiset<std::string>{"failed", "waiting"}));
  queue.remove(other);
  ASSERT_EQ(queue.items().size(), 1u);
  EXPECT_EQ(queue.items()[0].what, "pdf");
  EXPECT_EQ(queue.items()[0].attempts, 1);
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    EXPECT_EQ(entry.path().string().find(other), std::string::npos) << "the object goes, too";
}

TEST_F(Queue, OneProgramAtATime) {
  const SendQueue queue(folder);
  const pid_t child = ::fork();
  if (child == 0) {
    try {
      SendQueue second(folder);
    } catch (const ResourceError&) {
      ::_exit(7);
    }
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 7);
}

TEST_F(Queue, KilledAtAnyMomentNothingIsLostAndNothingIsThereTwice) {
  {
    SendQueue queue(folder);
    for (const auto& file : series.files) queue.add(file, "a");
  }
  for (int moment = 0; moment < 25; ++moment) {
    const pid_t child = ::fork();
    if (child == 0) {
      SendQueue queue(folder);
      queue.add(series.files[static_cast<std::size_t>(moment % 5)], "b");
      queue.send_waiting(answering({}));
      ::_exit(0);
    }
    ::usleep(static_cast<useconds_t>(moment * 400));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    EXPECT_NO_THROW(SendQueue(folder).items()) << "moment " << moment;
  }
  SendQueue queue(folder);
  for (const auto& file : series.files) queue.add(file, "b");
  queue.send_waiting(answering({}));
  EXPECT_EQ(queue.items().size(), 10u);
  for (const QueueItem& item : queue.items()) EXPECT_EQ(item.state, QueueState::sent);
  EXPECT_EQ(stored(), 5u);
}

TEST_F(Queue, WhatIsNoObjectIsNotTaken) {
  SendQueue queue(folder);
  core::write_file(store / "note.txt", "hello");
  EXPECT_THROW(queue.add(store / "note.txt", "a"), InvalidInput);
  EXPECT_TRUE(queue.items().empty());
}

}  // namespace
}  // namespace ostia::pacs
