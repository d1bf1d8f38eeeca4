// An archive that is killed at any moment of fetching and sending: nothing is lost, nothing is there twice,
// and no half series is handed over.

#include "local_orthanc.h"
#include "shared_data.h"
#include "small_series.h"

#include "ostia/core/error.h"
#include "ostia/pacs/send_queue.h"

#include <gtest/gtest.h>

#include <chrono>
#include <random>
#include <thread>

namespace ostia::pacs {
namespace {

using testing::LocalOrthanc;
using testing::small_series;
using testing::SmallSeries;

constexpr int kills = 25;  // of fetching, and as many of sending

/// Kills it `after_ms` from now.
std::thread killing(LocalOrthanc& server, int after_ms) {
  return std::thread([&server, after_ms] {
    std::this_thread::sleep_for(std::chrono::milliseconds(after_ms));
    server.kill();
  });
}

ServerDescription way_to(const LocalOrthanc& server, int turn) {
  ServerDescription way = turn % 3 == 0   ? server.by_get()
                          : turn % 3 == 1 ? server.by_web()
                                          : server.by_move();
  way.attempts = 1;
  way.idle_timeout_s = 3.0;
  return way;
}

std::size_t images_at(const LocalOrthanc& server, const SmallSeries& series) {
  Query query;
  query.level = Level::image;
  query.study_uid = series.study_uid;
  query.series_uid = series.series_uid;
  return open_archive(server.by_get())->find(query).found.size();
}

TEST(KilledOrthanc, NoHalfSeriesIsHandedOver) {
  OSTIA_REQUIRE_ORTHANC();
  const SmallSeries series = small_series("killed", 60);
  const auto store = testing::temporary_folder("store"), folder = testing::temporary_folder("fetched");
  open_archive(LocalOrthanc({false, store}).by_get())->send(series.files);
  std::mt19937 random(1);
  int whole = 0;
  for (int turn = 0; turn < kills; ++turn) {
    LocalOrthanc server({false, store});
    ASSERT_TRUE(server.running());
    std::thread killer = killing(server, static_cast<int>(random() % 900));
    const auto target = folder / std::to_string(turn);
    try {
      EXPECT_EQ(open_archive(way_to(server, turn), server.secrets())
                    ->fetch({series.study_uid, series.series_uid}, target)
                    .files.size(),
                60u);
      ++whole;
      std::filesystem::remove_all(target);
    } catch (const Error&) {
    }
    killer.join();
    EXPECT_TRUE(std::filesystem::is_empty(folder)) << "half a series at turn " << turn;
  }
  RecordProperty("whole", whole);
}

TEST(KilledOrthanc, WhatIsSentIsThereOnce) {
  OSTIA_REQUIRE_ORTHANC();
  const SmallSeries series = small_series("sent", kills * 2);
  const auto store = testing::temporary_folder("store"),
             folder = testing::temporary_folder("queue") / "outbox";
  std::mt19937 random(2);
  SendQueue queue(folder);
  const auto send_to = [&](const LocalOrthanc& server, int turn) {
    queue.send_waiting(
        [&](const std::string&) { return open_archive(way_to(server, turn), server.secrets()); });
  };
  for (int turn = 0; turn < kills; ++turn) {
    for (int n = 0; n < 2; ++n) queue.add(series.files[static_cast<std::size_t>(2 * turn + n)], "archive");
    LocalOrthanc server({false, store});
    ASSERT_TRUE(server.running());
    std::thread killer = killing(server, static_cast<int>(random() % 150));
    send_to(server, turn);
    killer.join();
  }
  const LocalOrthanc server({false, store});
  queue.retry_failed();
  send_to(server, 0);
  for (const QueueItem& item : queue.items()) EXPECT_EQ(item.state, QueueState::sent) << item.reason;
  EXPECT_EQ(queue.items().size(), series.files.size());
  EXPECT_EQ(images_at(server, series), series.files.size());
}

}  // namespace
}  // namespace ostia::pacs
