// The file of server descriptions.

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/pacs/server.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <utility>

namespace ostia::pacs {
namespace {

using ServerJson = nlohmann::ordered_json;

template <class Value, std::size_t count>
using WordsOf = std::array<std::pair<const char*, Value>, count>;
constexpr WordsOf<Transport, 2> transport_words{
    {{"dimse", Transport::dimse}, {"dicomweb", Transport::dicomweb}}};
constexpr WordsOf<Retrieval, 2> retrieval_words{{{"get", Retrieval::get}, {"move", Retrieval::move}}};
constexpr WordsOf<Login, 3> login_words{
    {{"none", Login::none}, {"basic", Login::basic}, {"bearer", Login::bearer}}};

/// Members one by one, for reading and for writing: the file's order.
template <class Server, class Visitor>
void each_member(Server& s, Visitor&& visit) {
  visit("name", s.name);
  visit("transport", s.transport);
  visit("host", s.host);
  visit("port", s.port);
  visit("title", s.title);
  visit("own_title", s.own_title);
  visit("retrieval", s.retrieval);
  visit("receive_port", s.receive_port);
  visit("receive_associations", s.receive_associations);
  visit("tls", s.tls);
  visit("url", s.url);
  visit("login", s.login);
  visit("user", s.user);
  visit("proxy", s.proxy);
  visit("authorities", s.authorities);
  visit("certificate", s.certificate);
  visit("key", s.key);
  visit("connect_timeout_s", s.connect_timeout_s);
  visit("idle_timeout_s", s.idle_timeout_s);
  visit("attempts", s.attempts);
}

struct WrongMember {};

void read_member(const ServerJson& json, std::string& value) {
  if (!json.is_string()) throw WrongMember{};
  value = json.get<std::string>();
}
void read_member(const ServerJson& json, std::filesystem::path& value) {
  if (!json.is_string()) throw WrongMember{};
  value = json.get<std::string>();
}
void read_member(const ServerJson& json, int& value) {
  if (!json.is_number_integer() || json.get<double>() < -1e9 || json.get<double>() > 1e9) throw WrongMember{};
  value = json.get<int>();
}
void read_member(const ServerJson& json, double& value) {
  if (!json.is_number()) throw WrongMember{};
  value = json.get<double>();
}
void read_member(const ServerJson& json, bool& value) {
  if (!json.is_boolean()) throw WrongMember{};
  value = json.get<bool>();
}
template <class Value, std::size_t count>
void read_word(const ServerJson& json, Value& value, const WordsOf<Value, count>& words) {
  for (const auto& [word, meant] : words)
    if (json.is_string() && json.get<std::string>() == word) {
      value = meant;
      return;
    }
  throw WrongMember{};
}
void read_member(const ServerJson& json, Transport& value) {
  read_word(json, value, transport_words);
}
void read_member(const ServerJson& json, Retrieval& value) {
  read_word(json, value, retrieval_words);
}
void read_member(const ServerJson& json, Login& value) {
  read_word(json, value, login_words);
}

template <class Value, std::size_t count>
ServerJson written_word(Value value, const WordsOf<Value, count>& words) {
  for (const auto& [word, meant] : words)
    if (meant == value) return word;
  return {};
}
ServerJson written(Transport value) {
  return written_word(value, transport_words);
}
ServerJson written(Retrieval value) {
  return written_word(value, retrieval_words);
}
ServerJson written(Login value) {
  return written_word(value, login_words);
}
ServerJson written(const std::filesystem::path& value) {
  return value.string();
}
template <class Value>
ServerJson written(const Value& value) {
  return value;
}

ServerDescription server_of(const ServerJson& json, const std::string& file) {
  if (!json.is_object()) throw InvalidInput(file + ": each of \"servers\" must be an object");
  ServerDescription server;
  std::vector<std::string> known;
  const std::string called =
      json.contains("name") && json["name"].is_string() ? json["name"].get<std::string>() : std::string("?");
  each_member(server, [&](const char* name, auto& value) {
    known.emplace_back(name);
    if (!json.contains(name)) return;
    try {
      read_member(json[name], value);
    } catch (const WrongMember&) {
      throw InvalidInput(file + ": the server '" + called + "': \"" + name +
                         "\" has a value that it cannot have");
    }
  });
  for (const auto& [name, value] : json.items())
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw InvalidInput(file + ": the server '" + called + "' has a member that is not known: \"" + name +
                         "\"; passwords and tokens do not belong into this file");
  validate(server);
  return server;
}

}  // namespace

std::vector<ServerDescription> read_servers(const std::filesystem::path& file) {
  const std::string text = core::read_file(file, 1U << 20);
  const std::string shown = file.string();
  const ServerJson json = ServerJson::parse(text, nullptr, false);
  if (!json.is_object() || !json.contains("servers") || !json["servers"].is_array())
    throw InvalidInput(shown + ": is no JSON object with an array \"servers\"");
  std::vector<ServerDescription> servers;
  for (const ServerJson& one : json["servers"]) {
    servers.push_back(server_of(one, shown));
    const std::string& name = servers.back().name;
    if (std::count_if(servers.begin(), servers.end(), [&](const auto& other) { return other.name == name; }) >
        1)
      throw InvalidInput(shown + ": the server '" + name + "' is there twice");
  }
  return servers;
}

void write_servers(const std::filesystem::path& file, const std::vector<ServerDescription>& servers) {
  ServerJson all = ServerJson::array();
  const ServerDescription usual;
  for (const ServerDescription& server : servers) {
    validate(server);
    ServerJson json = ServerJson::object(), usual_json = ServerJson::object();
    each_member(usual, [&](const char* name, const auto& value) { usual_json[name] = written(value); });
    each_member(server, [&](const char* name, const auto& value) {
      if (std::string_view(name) == "transport" || written(value) != usual_json[name])
        json[name] = written(value);
    });
    all.push_back(std::move(json));
  }
  core::write_file(file, ServerJson{{"servers", std::move(all)}}.dump(1) + "\n");
}

}  // namespace ostia::pacs
