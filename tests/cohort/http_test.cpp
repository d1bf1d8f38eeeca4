// Requests as others send them, and as nobody should.

#include "http.h"

#include "made_results.h"

#include "ostia/cohort/page_server.h"
#include "ostia/core/error.h"

#include <gmock/gmock.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <optional>
#include <string>
#include <thread>

namespace ostia::cohort {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

/// What is read of these bytes, sent by one that then says no more.
struct ReadRequest {
  std::optional<HttpRequest> request;
  int status = 0;
};
ReadRequest request_of(const std::string& bytes) {
  std::array<int, 2> ends{};
  EXPECT_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, ends.data()), 0);
  std::jthread sender([&] {
    for (std::size_t at = 0; at < bytes.size();) {
      const ssize_t sent = ::send(ends[0], bytes.data() + at, bytes.size() - at, MSG_NOSIGNAL);
      if (sent <= 0) break;
      at += static_cast<std::size_t>(sent);
    }
    ::shutdown(ends[0], SHUT_WR);
  });
  ReadRequest out;
  out.request = read_http_request(ends[1], out.status);
  ::close(ends[1]);
  sender.join();
  ::close(ends[0]);
  return out;
}

TEST(CohortHttp, ReadsARequestWithItsBody) {
  const ReadRequest read =
      request_of("POST /k/review HTTP/1.1\r\nHost: 127.0.0.1:80\r\nContent-Length:  5 \r\n\r\n12345678");
  ASSERT_TRUE(read.request);
  EXPECT_EQ(read.request->method, "POST");
  EXPECT_EQ(read.request->target, "/k/review");
  EXPECT_EQ(read.request->header("host"), "127.0.0.1:80");
  EXPECT_EQ(read.request->body, "12345");
}

TEST(CohortHttp, RefusesWhatIsNoRequest) {
  for (const char* bytes :
       {"\r\n\r\n", "GET /\r\n\r\n", "GET /a b c HTTP/1.1\r\n\r\n", "GET / HTTP/2\r\n\r\n",
        "GET / HTTP/1.1\r\nHost\r\n\r\n", "GET / HTTP/1.1\r\nHost : a\r\n\r\n",
        "GET / HTTP/1.1\r\nHost: a\r\nHOST: b\r\n\r\n", "GET / HTTP/1.1\r\n folded: a\r\n\r\n"}) {
    const ReadRequest read = request_of(bytes);
    EXPECT_FALSE(read.request) << bytes;
    EXPECT_EQ(read.status, 400) << bytes;
  }
}

TEST(CohortHttp, RefusesWhatIsTooMuchOrOfNoLength) {
  for (const std::string& bytes :
       {"GET /" + std::string(40000, 'a'), std::string("POST / HTTP/1.1\r\nContent-Length: 99999999\r\n\r\n"),
        std::string("POST / HTTP/1.1\r\nContent-Length: -1\r\n\r\n"),
        std::string("POST / HTTP/1.1\r\nTransfer-Encoding: chunked\r\n\r\n")})
    EXPECT_EQ(request_of(bytes).status, 413) << bytes.substr(0, 60);
}

TEST(CohortHttp, ARequestThatBreaksOffIsNotAnswered) {
  const ReadRequest read = request_of("GET / HTTP/1.1\r\nHost: a");
  EXPECT_FALSE(read.request);
  EXPECT_EQ(read.status, 0);
}

TEST(CohortHttp, AnAnswerSaysWhatItIs) {
  std::array<int, 2> ends{};
  ASSERT_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, ends.data()), 0);
  const auto file = ostia::testing::temporary_folder("http_answer") / "page.js";
  core::write_file(file, "Cohort.rows();");
  send_http_answer(ends[1], {200, "", file});
  ::close(ends[1]);
  std::string answer(4096, ' ');
  answer.resize(static_cast<std::size_t>(::recv(ends[0], answer.data(), answer.size(), MSG_WAITALL)));
  ::close(ends[0]);
  EXPECT_THAT(answer, StartsWith("HTTP/1.1 200 OK\r\nContent-Type: text/javascript"));
  EXPECT_THAT(answer, HasSubstr("Content-Length: 14\r\n"));
  EXPECT_THAT(answer, ::testing::EndsWith("\r\n\r\nCohort.rows();"));
}

TEST(CohortHttp, ServesNoCohortThatHasNoPage) {
  const MadeCohort cohort("http_no_page", 1);
  EXPECT_THROW(PageServer(cohort.folder()), InvalidInput);
  EXPECT_THROW(PageServer(cohort.beside("none")), InvalidInput);
}

}  // namespace
}  // namespace ostia::cohort
