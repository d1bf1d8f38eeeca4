// Descriptions of servers, and where secrets come from.

#include "ostia/pacs/server.h"

#include "shared_data.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"

#include <gmock/gmock.h>

#include <cstdlib>

namespace ostia::pacs {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

ServerDescription web_server() {
  ServerDescription server;
  server.name = "web";
  server.transport = Transport::dicomweb;
  server.url = "https://pacs.example/dicom-web";
  server.login = Login::bearer;
  server.idle_timeout_s = 12.5;
  return server;
}

ServerDescription dimse_server() {
  ServerDescription server;
  server.name = "hospital";
  server.host = "pacs.example";
  server.title = "ARCHIVE";
  server.retrieval = Retrieval::move;
  server.tls = true;
  server.certificate = "/etc/ours.pem";
  server.key = "/etc/ours.key";
  return server;
}

std::string refusal(const std::function<void()>& call) {
  try {
    call();
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return {};
}

TEST(Servers, AreReadAsTheyWereWritten) {
  const auto file = testing::temporary_folder("servers") / "pacs.json";
  write_servers(file, {web_server(), dimse_server()});
  const std::vector<ServerDescription> read = read_servers(file);
  ASSERT_EQ(read.size(), 2u);
  EXPECT_EQ(read[0].url, web_server().url);
  EXPECT_EQ(read[0].login, Login::bearer);
  EXPECT_EQ(read[0].idle_timeout_s, 12.5);
  EXPECT_EQ(read[1].retrieval, Retrieval::move);
  EXPECT_EQ(read[1].key, "/etc/ours.key");
  EXPECT_TRUE(read[1].tls);
  EXPECT_EQ(server_named(read, "hospital").title, "ARCHIVE");
  EXPECT_THAT(refusal([&] { server_named(read, "other"); }), HasSubstr("web, hospital"));
}

TEST(Servers, APasswordInTheFileIsRefused) {
  const auto file = testing::temporary_folder("servers") / "pacs.json";
  core::write_file(file,
                   R"({"servers": [{"name": "a", "host": "h", "title": "T", "password": "hush-hush"}]})");
  const std::string said = refusal([&] { read_servers(file); });
  EXPECT_THAT(said, HasSubstr("\"password\""));
  EXPECT_THAT(said, Not(HasSubstr("hush-hush")));
}

TEST(Servers, WrongMembersAreNamed) {
  const auto file = testing::temporary_folder("servers") / "pacs.json";
  for (
      const auto& [text, named] :
      {std::pair{R"({"name": "a", "host": "h", "title": "T", "port": "x"})", "port"},
       {R"({"name": "a", "host": "h", "title": "T", "port": 70000})", "port"},
       {R"({"name": "a", "host": "h", "title": ""})", "title"},
       {R"({"name": "a", "host": "h", "title": "TOO-LONG-A-TITLE-17"})", "title"},
       {R"({"name": "a", "transport": "ftp"})", "transport"},
       {R"({"name": "a", "transport": "dicomweb", "url": "ftp://x"})", "url"},
       {R"({"name": "a", "transport": "dicomweb", "url": "https://u:p@x"})", "url"},
       {R"({"name": "a", "transport": "dicomweb", "url": "http://x/y", "login": "bearer"})", "https"},
       {R"({"name": "a", "transport": "dicomweb", "url": "http://127.x/y", "login": "bearer"})", "https"},
       {R"({"name": "a", "transport": "dicomweb", "url": "http://localhost/y", "login": "bearer", "proxy": "p:1"})",
        "https"},
       {R"({"name": "a", "host": "h", "title": "T", "key": "k"})", "certificate"}}) {
    core::write_file(file, R"({"servers": [)" + std::string(text) + "]}");
    EXPECT_THAT(refusal([&] { read_servers(file); }), HasSubstr(named)) << text;
  }
  core::write_file(file, "[]");
  EXPECT_THAT(refusal([&] { read_servers(file); }), HasSubstr("servers"));
}

TEST(Servers, APasswordFileIsItsOwnersAlone) {
  const auto file = testing::temporary_folder("secret") / "password";
  core::write_file(file, "open sesame\nsecond line\n");
  std::filesystem::permissions(file, std::filesystem::perms(0600));
  EXPECT_EQ(secrets_from(file).password, "open sesame");
  std::filesystem::permissions(file, std::filesystem::perms(0644));
  EXPECT_THAT(refusal([&] { secrets_from(file); }), HasSubstr("chmod 600"));
}

}  // namespace
}  // namespace ostia::pacs
