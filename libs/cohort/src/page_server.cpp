#include "ostia/cohort/page_server.h"

#include "http.h"
#include "page_files.h"
#include "stage_results.h"

#include "ostia/cohort/pseudonym.h"
#include "ostia/cohort/review.h"
#include "ostia/core/error.h"

#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cstring>
#include <mutex>
#include <regex>
#include <thread>
#include <utility>
#include <vector>

namespace ostia::cohort {
namespace fs = std::filesystem;
namespace {

constexpr int connections_at_once = 8;
constexpr int look_up_ms = 200;  // how often a server that waits asks whether it is to end
constexpr std::size_t longest_path = 200;

/// What the page links to. None of them can lead out of the cohort.
bool may_be_read(const std::string& path) {
  static const std::regex allowed(
      "page/index\\.html|page/data/[a-z]+(-[0-9]+)?\\.js|cases/p-[0-9a-f]+/case\\.ostia|"
      "measures/p-[0-9a-f]+/report/(report\\.(html|pdf)|images/[A-Za-z0-9-]+\\.png)|"
      "flow/p-[0-9a-f]+/pressure/pressure\\.(html|pdf)");
  return path.size() <= longest_path && std::regex_match(path, allowed);
}

class Socket {
 public:
  explicit Socket(int handle) : handle_(handle) {}
  ~Socket() {
    if (handle_ >= 0) ::close(handle_);
  }
  Socket(Socket&& other) noexcept : handle_(std::exchange(other.handle_, -1)) {}
  Socket& operator=(Socket&&) = delete;
  int get() const { return handle_; }

 private:
  int handle_;
};

sockaddr_in loopback(std::uint16_t port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return address;
}

Socket listening(std::uint16_t port) {
  Socket out(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  const int on = 1;
  const sockaddr_in address = loopback(port);
  if (out.get() < 0 || ::setsockopt(out.get(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on) != 0 ||
      ::bind(out.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 ||
      ::listen(out.get(), 64) != 0)
    throw ResourceError("cannot serve on port " + std::to_string(port) +
                        " of 127.0.0.1: " + std::strerror(errno) + "; name another port, or none");
  return out;
}

std::uint16_t port_of(const Socket& socket) {
  sockaddr_in address{};
  socklen_t size = sizeof address;
  ::getsockname(socket.get(), reinterpret_cast<sockaddr*>(&address), &size);
  return ntohs(address.sin_port);
}

}  // namespace

struct PageServer::State {
  fs::path cohort;
  Socket listener;
  std::string key = new_key();
  std::uint16_t port = port_of(listener);
  std::mutex writing{};

  std::vector<std::string> hosts() const {
    const std::string at = ":" + std::to_string(port);
    return {"127.0.0.1" + at, "localhost" + at};
  }
  bool is_for_us(const HttpRequest& request) const;
  HttpAnswer answer(const HttpRequest& request);
  HttpAnswer take(const std::string& body);
  void serve_one(int socket);
  void serve(const core::TaskContext& task);
};

/// A name that another site has pointed at 127.0.0.1 is none of ours, and nor is a page of another site.
bool PageServer::State::is_for_us(const HttpRequest& request) const {
  const std::string host = request.header("host"), origin = request.header("origin");
  for (const std::string& ours : hosts())
    if (host == ours) return origin.empty() || origin == "http://" + ours;
  return false;
}

HttpAnswer PageServer::State::take(const std::string& body) {
  const std::lock_guard lock(writing);
  try {
    const TakenReviews taken = take_reviews(cohort, parse_reviews(body, "what was sent"));
    if (!taken.left_out.empty()) return {409, "its case was made anew since; make the page anew\n"};
    return {200, "written\n"};
  } catch (const ResourceError& error) {
    return {503, error.what() + std::string("\n")};
  } catch (const Error& error) {
    return {400, error.what() + std::string("\n")};
  }
}

HttpAnswer PageServer::State::answer(const HttpRequest& request) {
  const std::string begin = "/" + key + "/";
  if (!is_for_us(request) || !request.target.starts_with(begin)) return {403, "not for this page\n"};
  const std::string path = request.target.substr(begin.size());
  if (path == "review") {
    if (request.method != "POST" || request.header("content-type") != "application/json")
      return {405, "reviews are sent by POST as application/json\n"};
    return take(request.body);
  }
  if (request.method != "GET") return {405, "files are read by GET\n"};
  if (!may_be_read(path)) return {404, "there is no such file\n"};
  return {200, "", cohort / path};
}

void PageServer::State::serve_one(int socket) {
  int status = 0;
  const std::optional<HttpRequest> request = read_http_request(socket, status);
  if (request)
    send_http_answer(socket, answer(*request));
  else if (status != 0)
    send_http_answer(socket, {status, "no request that this server takes\n"});
}

void PageServer::State::serve(const core::TaskContext& task) {
  while (!task.cancelled()) {
    pollfd waiting{listener.get(), POLLIN, 0};
    if (::poll(&waiting, 1, look_up_ms) <= 0) continue;
    const Socket one(::accept4(listener.get(), nullptr, nullptr, SOCK_CLOEXEC));
    if (one.get() < 0) continue;  // another thread was quicker
    try {
      serve_one(one.get());
    } catch (const std::exception&) {
      // One page that is not answered is no reason to end: memory, or a disk that is gone.
    }
  }
}

PageServer::PageServer(fs::path cohort, std::uint16_t port) {
  { const OpenCohort checked(cohort); }
  if (!fs::is_regular_file(cohort / page_folder / "index.html"))
    throw InvalidInput("cannot serve " + cohort.string() + ": it has no page; `ostia cohort page` makes one");
  state_.reset(new State{std::move(cohort), listening(port)});
}

PageServer::~PageServer() = default;

std::string PageServer::url() const {
  return "http://127.0.0.1:" + std::to_string(state_->port) + "/" + state_->key + "/" + page_folder +
         "/index.html";
}

void PageServer::run(const core::TaskContext& task) {
  std::vector<std::jthread> threads;
  for (int i = 0; i < connections_at_once; ++i) threads.emplace_back([&] { state_->serve(task); });
}

}  // namespace ostia::cohort
