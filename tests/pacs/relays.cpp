#include "relays.h"

#include "shared_data.h"

#include "ostia/core/files.h"

namespace ostia::testing {
namespace {

constexpr const char* relay_in_python = R"(
import select, socket, ssl, sys, threading

def relay(a, b):
    while True:
        waiting = [s for s in (a, b) if isinstance(s, ssl.SSLSocket) and s.pending()]
        for one in waiting or select.select([a, b], [], [])[0]:
            data = one.recv(65536)
            if not data:
                return
            (b if one is a else a).sendall(data)

def serve(port, welcome):
    listening = socket.create_server(('127.0.0.1', port))
    def one(raw):
        try:
            with raw:
                pair = welcome(raw)
                if pair:
                    with pair[0], pair[1]:
                        relay(*pair)
        except OSError:
            pass
    while True:
        threading.Thread(target=one, args=(listening.accept()[0],), daemon=True).start()
)";

constexpr const char* tls_front_in_python = R"(
port, behind, certificate, key, authorities = sys.argv[1:]
context = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
context.load_cert_chain(certificate, key)
if authorities:
    context.verify_mode = ssl.CERT_REQUIRED
    context.load_verify_locations(authorities)

def welcome(raw):
    secure = context.wrap_socket(raw, server_side=True, do_handshake_on_connect=False)
    try:
        secure.do_handshake()
    except OSError:
        # Closed with something unread the connection would be reset, and why it ended might be lost.
        with socket.socket(fileno=secure.detach()) as refused:
            refused.shutdown(socket.SHUT_WR)
            refused.settimeout(5)
            while refused.recv(65536):
                pass
        return
    return secure, socket.create_connection(('127.0.0.1', int(behind)))

serve(int(port), welcome)
)";

constexpr const char* tls_alarm_in_python = R"(
port, alert = int(sys.argv[1]), int(sys.argv[2])

def welcome(raw):
    raw.recv(65536)
    raw.sendall(bytes([21, 3, 3, 0, 2, 2, alert]))
    raw.shutdown(socket.SHUT_WR)
    while raw.recv(65536):
        pass

serve(port, welcome)
)";

constexpr const char* tls_back_in_python = R"(
port, behind, authorities = sys.argv[1:]
context = ssl.create_default_context(cafile=authorities)
# With 1.3 a server sends tickets behind the handshake: what is there to read is then nothing that recv gives.
context.maximum_version = ssl.TLSVersion.TLSv1_2

def welcome(raw):
    onward = socket.create_connection(('127.0.0.1', int(behind)))
    return raw, context.wrap_socket(onward, server_hostname='localhost')

serve(int(port), welcome)
)";

constexpr const char* tunnel_in_python = R"(
port, status = int(sys.argv[1]), sys.argv[2]

def welcome(raw):
    head = b''
    while b'\r\n\r\n' not in head:
        more = raw.recv(4096)
        if not more:
            return
        head += more
    line = head.split(b'\r\n')[0].decode()
    print(line, flush=True)
    if status != '200':
        raw.sendall(f'HTTP/1.1 {status} Said\r\nContent-Length: 0\r\n\r\n'.encode())
        return
    host, _, to = line.split()[1].rpartition(':')
    onward = socket.create_connection((host, int(to)))
    raw.sendall(b'HTTP/1.1 200 Connection established\r\n\r\n')
    return raw, onward

serve(port, welcome)
)";

std::vector<std::string> python(const char* script, std::vector<std::string> arguments) {
  std::vector<std::string> words{"/usr/bin/python3", "-c", std::string(relay_in_python) + script};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return words;
}

}  // namespace

TlsFront::TlsFront(int behind, const std::filesystem::path& folder, const std::filesystem::path& authorities)
    : port_(free_port()),
      program_(python(tls_front_in_python,
                      {std::to_string(port_), std::to_string(behind), (folder / "certificate.pem").string(),
                       (folder / "key.pem").string(), authorities.string()})) {
  if (!comes_to_answer(port_)) throw std::runtime_error("python3 does not take TLS off");
}

TlsAlarm::TlsAlarm(int alert)
    : port_(free_port()),
      program_(python(tls_alarm_in_python, {std::to_string(port_), std::to_string(alert)})) {
  if (!comes_to_answer(port_)) throw std::runtime_error("python3 sends no alert");
}

TlsBack::TlsBack(int behind, const std::filesystem::path& authorities)
    : port_(free_port()),
      program_(
          python(tls_back_in_python, {std::to_string(port_), std::to_string(behind), authorities.string()})) {
  if (!comes_to_answer(port_)) throw std::runtime_error("python3 does not put TLS on");
}

Tunnel::Tunnel(int status)
    : log_(temporary_folder("tunnel") / "log"),
      port_(free_port()),
      program_(python(tunnel_in_python, {std::to_string(port_), std::to_string(status)}), log_) {
  if (!comes_to_answer(port_)) throw std::runtime_error("python3 is no proxy");
}

std::string Tunnel::asked_for() const {
  return core::read_file(log_);
}

}  // namespace ostia::testing
