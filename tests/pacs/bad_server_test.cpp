// Servers that refuse, hang, send garbage, too much, or what was not asked for.

#include "fake_server.h"
#include "shared_data.h"
#include "small_series.h"
#include "started_program.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/pacs/archive.h"

#include <gmock/gmock.h>
#include <sys/resource.h>

#include <chrono>
#include <csignal>
#include <thread>

namespace ostia::pacs {
namespace {

using testing::FakeServer;
using ::testing::HasSubstr;
using testing::http_answer;
using testing::multipart_body;
using ::testing::Not;
using testing::small_series;
using testing::SmallSeries;

ServerDescription web_at(int port) {
  ServerDescription server;
  server.name = "fake";
  server.transport = Transport::dicomweb;
  server.url = "http://127.0.0.1:" + std::to_string(port) + "/dicom-web";
  server.connect_timeout_s = server.idle_timeout_s = 1.0;
  server.attempts = 1;
  return server;
}

ServerDescription dimse_at(int port) {
  ServerDescription server;
  server.name = "fake";
  server.host = "127.0.0.1";
  server.port = port;
  server.title = "FAKE";
  server.connect_timeout_s = server.idle_timeout_s = 1.0;
  server.attempts = 1;
  return server;
}

template <class Thrown>
std::string refused(const std::function<void()>& call) {
  try {
    call();
  } catch (const Thrown& error) {
    return error.what();
  }
  return "nothing of this kind was thrown";
}

Query planted_query() {
  Query query;
  query.patient_name = "PLANTED^NAME";
  query.patient_id = "PLANTED-ID";
  return query;
}

TEST(BadServer, NobodyListens) {
  const int port = testing::free_port();
  for (const ServerDescription& server : {web_at(port), dimse_at(port)})
    EXPECT_THAT(refused<NetworkError>([&] { open_archive(server)->echo(); }), HasSubstr("does not answer"));
}

TEST(BadServer, OneThatIsSilentIsGivenUp) {
  const FakeServer silent;
  EXPECT_THAT(refused<NetworkError>([&] { open_archive(web_at(silent.port()))->echo(); }),
              HasSubstr("silent"));
  EXPECT_THAT(refused<NetworkError>([&] { open_archive(dimse_at(silent.port()))->echo(); }),
              HasSubstr("'fake'"));
}

TEST(BadServer, ACancelEndsTheWaitForOneThatIsSilent) {
  const FakeServer silent;
  for (ServerDescription server : {web_at(silent.port()), dimse_at(silent.port())}) {
    server.connect_timeout_s = server.idle_timeout_s = 300.0;
    const core::TaskContext task;
    std::thread cancelling([task] {
      std::this_thread::sleep_for(std::chrono::milliseconds(200));
      task.cancel();
    });
    EXPECT_THROW(open_archive(server)->find(planted_query(), task), Cancelled);
    cancelling.join();
  }
}

TEST(BadServer, GarbageIsNoAnswer) {
  const FakeServer garbage([](const std::string&) { return std::string(5000, '\x7f'); });
  EXPECT_THROW(open_archive(web_at(garbage.port()))->echo(), InvalidInput);
  EXPECT_THROW(open_archive(dimse_at(garbage.port()))->echo(), Error);
  const FakeServer html(
      [](const std::string&) { return http_answer(200, "text/html", "<html>please log in</html>"); });
  EXPECT_THAT(refused<InvalidInput>([&] { open_archive(web_at(html.port()))->find({}); }),
              HasSubstr("no DICOM JSON"));
  const FakeServer half(
      [](const std::string&) { return std::string("HTTP/1.1 200 OK\r\nContent-Length: 1000\r\n\r\n[{"); });
  EXPECT_THROW(open_archive(web_at(half.port()))->find({}), NetworkError);
}

TEST(BadServer, AnExpiredTokenIsSaidAndNotShown) {
  const FakeServer closed(
      [](const std::string&) { return http_answer(401, "text/plain", "token of PLANTED^NAME"); });
  ServerDescription server = web_at(closed.port());
  server.login = Login::bearer;
  const std::string said = refused<InvalidInput>([&] {
    open_archive(server, {"planted-token", {}})->find(planted_query());
  });
  EXPECT_THAT(said, HasSubstr("has expired"));
  EXPECT_THAT(said, Not(HasSubstr("lanted-token")));
  EXPECT_THAT(said, Not(HasSubstr("PLANTED")));
  ASSERT_EQ(closed.requests().size(), 1u);
  EXPECT_THAT(closed.requests()[0], HasSubstr("Authorization: Bearer planted-token"));
}

TEST(BadServer, NoMessageNamesThePatient) {
  for (const int status : {302, 400, 403, 404, 407, 429, 500, 501}) {
    const FakeServer server(
        [status](const std::string&) { return http_answer(status, "text/plain", "PLANTED^NAME"); });
    EXPECT_THAT(refused<Error>([&] { open_archive(web_at(server.port()))->find(planted_query()); }),
                Not(HasSubstr("PLANTED")))
        << status;
  }
}

TEST(BadServer, AMoveElsewhereIsNotFollowed) {
  const FakeServer other([](const std::string&) { return http_answer(200, "application/dicom+json", "[]"); });
  const FakeServer moving([&](const std::string&) {
    return "HTTP/1.1 302 Found\r\nLocation: http://127.0.0.1:" + std::to_string(other.port()) +
           "/\r\nContent-Length: 0\r\nConnection: close\r\n\r\n";
  });
  EXPECT_THROW(open_archive(web_at(moving.port()))->echo(), InvalidInput);
  EXPECT_TRUE(other.requests().empty());
}

std::string studies(std::size_t first, std::size_t count) {
  std::string body = "[";
  for (std::size_t n = 0; n < count; ++n)
    body += std::string(n > 0 ? "," : "") + R"({"0020000D":{"vr":"UI","Value":["1.2.)" +
            std::to_string(first + n) + R"("]}})";
  return body + "]";
}

std::size_t number_behind(const std::string& request, const std::string& word) {
  return std::stoul(request.substr(request.find(word) + word.size()));
}

TEST(BadServer, TenThousandResultsAreCutOffOrPaged) {
  const FakeServer server([](const std::string& request) {
    const std::size_t offset = number_behind(request, "offset="),
                      limit = std::min<std::size_t>(number_behind(request, "limit="), 100);
    return http_answer(200, "application/dicom+json",
                       studies(offset, std::min(limit, 10000 - std::min<std::size_t>(offset, 10000))));
  });
  Query query;
  query.most = 250;
  const FindResult some = open_archive(web_at(server.port()))->find(query);
  EXPECT_EQ(some.found.size(), 250u);
  EXPECT_TRUE(some.cut_off);
  query.most = 20000;
  const FindResult all = open_archive(web_at(server.port()))->find(query);
  EXPECT_EQ(all.found.size(), 10000u);
  EXPECT_FALSE(all.cut_off);
}

TEST(BadServer, OneThatKnowsNoPagesIsAskedTwiceAtMost) {
  const FakeServer server(
      [](const std::string&) { return http_answer(200, "application/dicom+json", studies(0, 7)); });
  EXPECT_EQ(open_archive(web_at(server.port()))->find({}).found.size(), 7u);
  EXPECT_EQ(server.requests().size(), 2u);
}

TEST(BadServer, EntriesThatAreNoneAreCounted) {
  const FakeServer server([](const std::string&) {
    return http_answer(
        200, "application/dicom+json",
        R"([{"0020000D":{"vr":"UI","Value":["1.2.3"]},"00100010":{"vr":"PN","Value":[{"Alphabetic":"M\u00fcller^J\u00fcrgen","Ideographic":"x"}]}},
                           {"0020000D":{"vr":"UI","Value":["../../x"]}}, 7, {"0020000D":{"vr":"UI"}}])");
  });
  const FindResult result = open_archive(web_at(server.port()))->find({});
  ASSERT_EQ(result.found.size(), 1u);
  EXPECT_EQ(result.found[0].patient_name, "M\xC3\xBCller^J\xC3\xBCrgen");
  EXPECT_THAT(result.warnings, ::testing::ElementsAre(HasSubstr("3 entries")));
}

/// Lists a series and hands over whatever it is told to.
class WebArchive {
 public:
  WebArchive(const SmallSeries& series, std::function<std::string()> handed)
      : server_([&series, handed = std::move(handed)](const std::string& request) {
          if (request.find("/instances?") != std::string::npos)
            return http_answer(200, "application/dicom+json", listed(series));
          if (request.find("/series?") != std::string::npos)
            return http_answer(200, "application/dicom+json", counted(series));
          if (request.find("/studies?") != std::string::npos)
            return http_answer(
                200, "application/dicom+json",
                R"([{"0020000D":{"Value":[")" + series.study_uid + R"("]},"00100020":{"Value":["PID-1"]}}])");
          return handed();
        }) {}
  int port() const { return server_.port(); }

 private:
  static std::string counted(const SmallSeries& series) {
    return R"([{"0020000D":{"Value":[")" + series.study_uid + R"("]},"0020000E":{"Value":[")" +
           series.series_uid + R"("]},"00201209":{"Value":[)" + std::to_string(series.sop_uids.size()) +
           "]}}]";
  }
  static std::string listed(const SmallSeries& series) {
    std::string body = "[";
    for (const std::string& uid : series.sop_uids)
      body += (body.size() > 1 ? "," : "") + (R"({"00080018":{"Value":[")" + uid + R"("]}})");
    return body + "]";
  }
  FakeServer server_;
};

struct BadSeries : ::testing::Test {
  SmallSeries series = small_series("bad");
  std::filesystem::path folder = testing::temporary_folder("from-bad");
  std::string refusal(const std::function<std::string()>& handed) {
    const WebArchive server(series, handed);
    const std::string said = refused<Error>([&] {
      open_archive(web_at(server.port()))->fetch({series.study_uid, series.series_uid}, folder / "CT");
    });
    EXPECT_TRUE(std::filesystem::is_empty(folder)) << "something was left behind";
    return said;
  }
  std::string answer_with(const std::vector<std::string>& files) {
    return http_answer(200, "multipart/related; type=\"application/dicom\"; boundary=b",
                       multipart_body(files));
  }
};

TEST_F(BadSeries, TwiceAndInAnyOrderIsFine) {
  std::vector<std::string> files(series.bytes.rbegin(), series.bytes.rend());
  files.push_back(series.bytes[2]);
  const WebArchive server(series, [&] { return answer_with(files); });
  const Fetched fetched =
      open_archive(web_at(server.port()))->fetch({series.study_uid, series.series_uid}, folder / "CT");
  EXPECT_EQ(fetched.files.size(), 5u);
  EXPECT_EQ(fetched.duplicates, 1u);
  for (const auto& file : fetched.files) {
    const std::string bytes = core::read_file(file);
    EXPECT_NE(std::find(series.bytes.begin(), series.bytes.end(), bytes), series.bytes.end())
        << "not what was sent";
  }
}

TEST_F(BadSeries, AnotherPatientsIsRefused) {
  EXPECT_THAT(refusal([&] {
                std::vector<std::string> files = series.bytes;
                files[3] = testing::replaced(files[3], "PID-1", "PID-2");
                return answer_with(files);
              }),
              HasSubstr("'fake' sent an object of another patient"));
}

TEST_F(BadSeries, HalfASeriesIsNotHandedOver) {
  EXPECT_THAT(refusal([&] { return answer_with({series.bytes[0], series.bytes[1]}); }), HasSubstr("sent 2"));
  EXPECT_THAT(refusal([&] {
                const std::string whole = answer_with(series.bytes);
                return whole.substr(0, whole.size() / 2);
              }),
              HasSubstr("try again"));
}

TEST_F(BadSeries, WhatIsNoSeriesIsRefused) {
  EXPECT_THAT(refusal([&] { return http_answer(200, "text/html", "<html>please log in</html>"); }),
              HasSubstr("multipart"));
  EXPECT_THAT(refusal([&] { return answer_with({"garbage"}); }), HasSubstr("no DICOM object"));
}

TEST_F(BadSeries, AFullDiskIsSaidAndNothingStays) {
  const auto before = std::signal(SIGXFSZ, SIG_IGN);
  rlimit usual{};
  ::getrlimit(RLIMIT_FSIZE, &usual);
  const rlimit small{600, usual.rlim_max};
  const WebArchive server(series, [&] { return answer_with(series.bytes); });
  ::setrlimit(RLIMIT_FSIZE, &small);
  std::string said;
  try {
    open_archive(web_at(server.port()))->fetch({series.study_uid, series.series_uid}, folder / "CT");
  } catch (const NetworkError&) {
    said = "taken for a fault of the network";
  } catch (const ResourceError& error) {
    said = error.what();
  }
  ::setrlimit(RLIMIT_FSIZE, &usual);
  std::signal(SIGXFSZ, before);
  EXPECT_THAT(said, HasSubstr("cannot be written"));
  EXPECT_TRUE(std::filesystem::is_empty(folder));
}

}  // namespace
}  // namespace ostia::pacs
