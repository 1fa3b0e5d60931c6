#include "gallery/preview_server.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <microhttpd.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstring>
#include <ranges>
#include <regex>
#include <unordered_map>

#include "core/descriptor.hpp"
#include "core/error.hpp"
#include "core/host.hpp"
#include "core/interrupt.hpp"
#include "core/module.hpp"
#include "core/open_beneath.hpp"
#include "core/text.hpp"
#include "gallery/byte_range.hpp"
#include "gallery/page.hpp"

namespace lobelia::gallery {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

LOBELIA_MODULE_FUNCTION(server_module, MHD_add_response_header);
LOBELIA_MODULE_FUNCTION(server_module, MHD_create_response_from_buffer);
LOBELIA_MODULE_FUNCTION(server_module, MHD_create_response_from_fd_at_offset64);
LOBELIA_MODULE_FUNCTION(server_module, MHD_destroy_response);
LOBELIA_MODULE_FUNCTION(server_module, MHD_get_connection_info);
LOBELIA_MODULE_FUNCTION(server_module, MHD_get_connection_values);
LOBELIA_MODULE_FUNCTION(server_module, MHD_queue_response);
LOBELIA_MODULE_FUNCTION(server_module, MHD_run_wait);
LOBELIA_MODULE_FUNCTION(server_module, MHD_start_daemon);
LOBELIA_MODULE_FUNCTION(server_module, MHD_stop_daemon);

/// Connections at once. Each may take kRequestBytes and, while it gets a file, two descriptors.
constexpr unsigned kMaxClients = 4000;
/// For a request's first line and headers, and the library's own data about them.
constexpr std::size_t kRequestBytes = 16 << 10;
constexpr int kMaxHeaders = 100;
/// Seconds without any byte sent or received after which a connection is closed.
constexpr unsigned kSilence = 20;
/// Time in which a client has to complete its next request.
constexpr std::chrono::seconds kPatience{30};
/// How often Ctrl-C and idle clients are checked.
constexpr int kLookMilliseconds = 50;
/// Descriptors for everything but clients.
constexpr rlim_t kOwnDescriptors = 32;

const char* content_type(const std::string& name) {
  static constexpr const char* kTypes[][2] = {{".html", "text/html; charset=utf-8"},
                                              {".css", "text/css; charset=utf-8"},
                                              {".js", "text/javascript; charset=utf-8"},
                                              {".json", "application/json"},
                                              {".png", "image/png"},
                                              {".svg", "image/svg+xml"},
                                              {".exr", "image/x-exr"},
                                              {".xml", "text/xml; charset=utf-8"},
                                              {".csv", "text/csv; charset=utf-8"},
                                              {".log", "text/plain; charset=utf-8"},
                                              {".txt", "text/plain; charset=utf-8"},
                                              {".wasm", "application/wasm"}};
  for (const auto& [ending, type] : kTypes)
    if (name.ends_with(ending)) return type;
  return "application/octet-stream";
}

bool is_our_host(const std::string& host, bool is_open) {
  static const std::regex kHere(R"re((127(\.[0-9]{1,3}){3}|localhost)(:[0-9]{1,5})?)re");
  static const std::regex kNumbers(R"re([0-9]{1,3}(\.[0-9]{1,3}){3}(:[0-9]{1,5})?)re");
  if (std::regex_match(host, kHere)) return true;
  if (!is_open) return false;
  const std::string name = host.substr(0, host.find(':')), ours = host_name();
  return std::regex_match(host, kNumbers) ||
         (!ours.empty() && ::strcasecmp(name.c_str(), ours.c_str()) == 0);
}

/// Decodes percent signs: "%2e" is ".". Empty if one is not followed by two hexadecimal digits.
std::optional<std::string> decoded(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    result += text[i];
    if (text[i] != '%') continue;
    const std::string_view digits = text.substr(i + 1, 2);
    unsigned byte = 0;
    if (digits.size() < 2 ||
        std::from_chars(digits.begin(), digits.end(), byte, 16).ptr != digits.end())
      return std::nullopt;
    result.back() = char(byte);
    i += 2;
  }
  return result;
}

/// The names between the slashes of a request's path; empty if one of them is not plain.
std::optional<std::vector<std::string>> names_of(std::string_view path) {
  std::vector<std::string> names;
  for (const auto& part : std::views::split(path, '/')) {
    if (part.empty()) continue;
    auto name = decoded({part.begin(), part.end()});
    if (!name || !is_plain_name(*name)) return std::nullopt;
    names.push_back(std::move(*name));
  }
  return names;
}

/// The headers of a request that matter here.
struct Headers {
  int count = 0;
  bool has_body = false, if_range = false;
  std::vector<std::string> hosts, ranges;
  std::optional<std::string> named_host;  ///< in the request's first line
};

MHD_Result add_header(void* into, MHD_ValueKind, const char* name, const char* value) noexcept {
  try {
    auto& headers = *static_cast<Headers*>(into);
    const std::string text = value ? value : "";
    const auto is = [&](const char* other) { return ::strcasecmp(name, other) == 0; };
    if (++headers.count > kMaxHeaders) return MHD_NO;
    if (is("Host")) headers.hosts.push_back(text);
    if (is("Range")) headers.ranges.push_back(text);
    if (is("If-Range")) headers.if_range = true;
    if (is("Transfer-Encoding") || (is("Content-Length") && text != "0")) headers.has_body = true;
    return MHD_YES;
  } catch (const std::bad_alloc&) {
    return MHD_NO;
  }
}

struct Response {
  MHD_Response* response;
  explicit Response(MHD_Response* made) : response(made) {
    if (!made) throw std::bad_alloc();
    for (const auto& [name, value] : {std::pair{"Content-Security-Policy", kContentSecurityPolicy},
                                      {"X-Content-Type-Options", "nosniff"},
                                      {"Referrer-Policy", "no-referrer"},
                                      {"Cross-Origin-Resource-Policy", "same-origin"},
                                      {"Cache-Control", "no-cache"}})
      add(name, value);
  }
  ~Response() { MHD_destroy_response(response); }
  Response(const Response&) = delete;
  Response& operator=(const Response&) = delete;
  void add(const char* name, const std::string& value) {
    MHD_add_response_header(response, name, value.c_str());
  }
};

MHD_Result refuse(MHD_Connection* connection, unsigned status, std::string words,
                  const std::pair<const char*, std::string>& more = {}) {
  words += '\n';
  Response answer(
      MHD_create_response_from_buffer(words.size(), words.data(), MHD_RESPMEM_MUST_COPY));
  answer.add("Content-Type", "text/plain; charset=utf-8");
  if (more.first) answer.add(more.first, more.second);
  return MHD_queue_response(connection, status, answer.response);
}

/// Serves one directory with libmicrohttpd, on the calling thread alone.
class Server {
 public:
  Server(int site, Descriptor listening, bool is_open) : site_(site), is_open_(is_open) {
    const unsigned clients = clients_allowed();
    daemon_ = MHD_start_daemon(
        MHD_USE_EPOLL, 0, nullptr, nullptr, &Server::on_request, this,  //
        MHD_OPTION_LISTEN_SOCKET, listening.get(), MHD_OPTION_CONNECTION_LIMIT, clients,
        MHD_OPTION_CONNECTION_MEMORY_LIMIT, kRequestBytes, MHD_OPTION_CONNECTION_TIMEOUT, kSilence,
        MHD_OPTION_UNESCAPE_CALLBACK, &Server::as_it_is, nullptr,  //
        MHD_OPTION_NOTIFY_CONNECTION, &Server::on_connection, this, MHD_OPTION_NOTIFY_COMPLETED,
        &Server::on_answered, this, MHD_OPTION_STRICT_FOR_CLIENT, 1, MHD_OPTION_END);
    if (!daemon_) throw Error(ExitCode::kOutput, "the preview's server cannot be started");
    listening.release();  // the daemon closes it
    crowded_ = clients - clients / 16;
  }
  ~Server() { MHD_stop_daemon(daemon_); }
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  void run_until_interrupted() {
    while (!interrupted()) {
      if (MHD_run_wait(daemon_, kLookMilliseconds) != MHD_YES)
        throw Error(ExitCode::kInternal, "the preview's server has failed");
      close_idle_clients();
    }
  }

 private:
  struct Client {
    Clock::time_point since;  ///< when it connected, or got its last answer
    bool is_asking = false;   ///< its request is not answered completely
  };

  /// Raises the limit of open files as far as needed and allowed. Returns the clients that fit into it.
  static unsigned clients_allowed() {
    rlimit limit{};
    if (::getrlimit(RLIMIT_NOFILE, &limit) != 0) return 1;
    const rlim_t wanted = std::min<rlim_t>(limit.rlim_max, 2 * kMaxClients + kOwnDescriptors);
    if (limit.rlim_cur < wanted) {
      limit.rlim_cur = wanted;
      ::setrlimit(RLIMIT_NOFILE, &limit);
      ::getrlimit(RLIMIT_NOFILE, &limit);
    }
    const rlim_t free = limit.rlim_cur - std::min(limit.rlim_cur, kOwnDescriptors);
    return unsigned(std::clamp<rlim_t>(free / 2, 1, kMaxClients));
  }

  static std::size_t as_it_is(void*, MHD_Connection*, char* text) { return std::strlen(text); }

  static int socket_of(MHD_Connection* connection) {
    return MHD_get_connection_info(connection, MHD_CONNECTION_INFO_CONNECTION_FD)->connect_fd;
  }

  static void on_connection(void* self, MHD_Connection* connection, void**,
                            MHD_ConnectionNotificationCode what) noexcept {
    auto& server = *static_cast<Server*>(self);
    try {
      if (what == MHD_CONNECTION_NOTIFY_CLOSED) {
        server.clients_.erase(socket_of(connection));
        return;
      }
      server.clients_[socket_of(connection)] = {.since = Clock::now()};
      if (server.clients_.size() > server.crowded_) server.dismiss_one();
    } catch (const std::bad_alloc&) {  // only the library's own limits hold for this client
    }
  }

  static void on_answered(void* self, MHD_Connection* connection, void**,
                          MHD_RequestTerminationCode) noexcept {
    auto& clients = static_cast<Server*>(self)->clients_;
    if (const auto found = clients.find(socket_of(connection)); found != clients.end())
      found->second = {.since = Clock::now()};
  }

  /// The library notices that the socket is shut down, and closes it.
  static void dismiss(int socket) { ::shutdown(socket, SHUT_RDWR); }

  void close_idle_clients() {
    const auto now = Clock::now();
    if (now - last_look_ < std::chrono::milliseconds(500)) return;
    last_look_ = now;
    for (const auto& [socket, client] : clients_)
      if (!client.is_asking && now - client.since > kPatience) dismiss(socket);
  }

  /// Dismisses the client that has been idle longest or, if none is idle, the one that has waited longest.
  void dismiss_one() {
    dismiss(std::ranges::min_element(clients_, {}, [](const auto& one) {
              return std::pair(one.second.is_asking, one.second.since);
            })->first);
  }

  static MHD_Result on_request(void* self, MHD_Connection* connection, const char* url,
                               const char* method, const char*, const char*, std::size_t*,
                               void** request) noexcept {
    try {
      return static_cast<Server*>(self)->answer(connection, url, method, request);
    } catch (const std::exception&) {  // no memory
      return MHD_NO;                   // closes the connection
    }
  }

  /// Called twice per request: with its headers, when a refusal also ends the connection, and with all of it.
  MHD_Result answer(MHD_Connection* connection, std::string_view url, std::string_view method,
                    void** request) {
    if (const auto found = clients_.find(socket_of(connection)); found != clients_.end())
      found->second.is_asking = true;
    Headers headers;
    MHD_get_connection_values(connection, MHD_HEADER_KIND, &add_header, &headers);
    constexpr std::string_view kScheme = "http://";
    if (url.starts_with(kScheme)) {  // the form for proxies: its host has to be ours too
      url.remove_prefix(kScheme.size());
      headers.named_host = url.substr(0, url.find('/'));
      url.remove_prefix(headers.named_host->size());
    }
    if (headers.count > kMaxHeaders)
      return refuse(connection, MHD_HTTP_REQUEST_HEADER_FIELDS_TOO_LARGE, "Too many headers.");
    if (headers.hosts.size() > 1)
      return refuse(connection, MHD_HTTP_BAD_REQUEST, "More than one Host.");
    if (headers.hosts.empty() || !is_our_host(headers.hosts[0], is_open_) ||
        !is_our_host(headers.named_host.value_or("localhost"), is_open_))
      return refuse(connection, MHD_HTTP_FORBIDDEN,
                    is_open_
                        ? "This preview answers to addresses in numbers and to its machine's name."
                        : "This preview answers to 127.0.0.1 and localhost alone.");
    if (method != MHD_HTTP_METHOD_GET && method != MHD_HTTP_METHOD_HEAD)
      return refuse(connection, MHD_HTTP_METHOD_NOT_ALLOWED, "Only GET and HEAD.",
                    {"Allow", "GET, HEAD"});
    if (headers.has_body)
      return refuse(connection, MHD_HTTP_CONTENT_TOO_LARGE, "Nothing is to be sent here.");
    if (!*request) {
      *request = this;
      return MHD_YES;
    }
    // Only GET has parts. Files here have no validator, so If-Range never holds.
    const bool whole =
        method != MHD_HTTP_METHOD_GET || headers.if_range || headers.ranges.size() != 1;
    return send_file(connection, url.empty() ? "/" : url, whole ? "" : headers.ranges[0]);
  }

  MHD_Result send_file(MHD_Connection* connection, std::string_view url,
                       const std::string& range) const {
    const auto names = url.starts_with('/') ? names_of(url) : std::nullopt;
    const auto refuse_it = [&] {
      return refuse(connection, MHD_HTTP_NOT_FOUND, "There is no such file.");
    };
    if (!names) return refuse_it();
    Descriptor found(open_beneath(site_, *names));
    struct stat status {};
    const bool is_directory =
        found.get() >= 0 && ::fstat(found.get(), &status) == 0 && S_ISDIR(status.st_mode);
    Descriptor file(is_directory ? open_beneath(found.get(), {"index.html"}) : found.release());
    if (file.get() < 0 && (errno == EMFILE || errno == ENFILE))
      return refuse(connection, MHD_HTTP_SERVICE_UNAVAILABLE, "Too many files are open.");
    if (file.get() < 0 || ::fstat(file.get(), &status) != 0 || !S_ISREG(status.st_mode))
      return refuse_it();
    if (is_directory && !url.ends_with('/')) {
      // Links on a directory's page are relative to the directory.
      std::string place = "/";
      for (const std::string& name : *names) place += link_to({name}) + "/";
      return refuse(connection, MHD_HTTP_FOUND, "It is a directory.", {"Location", place});
    }
    if (!is_directory && url.ends_with('/')) return refuse_it();

    const auto size = std::uint64_t(status.st_size);
    const ByteRange part = byte_range(range, size);
    if (part.kind == ByteRange::Kind::kUnsatisfiable)
      return refuse(connection, MHD_HTTP_RANGE_NOT_SATISFIABLE, "The file has no such part.",
                    {"Content-Range", fmt::format("bytes */{}", size)});
    const bool is_part = part.kind == ByteRange::Kind::kPart;
    Response answer(MHD_create_response_from_fd_at_offset64(is_part ? part.size : size, file.get(),
                                                            part.first));
    file.release();
    answer.add("Content-Type", content_type(is_directory ? "index.html" : names->back()));
    answer.add("Accept-Ranges", "bytes");
    if (is_part)
      answer.add("Content-Range",
                 fmt::format("bytes {}-{}/{}", part.first, part.first + part.size - 1, size));
    return MHD_queue_response(connection, is_part ? MHD_HTTP_PARTIAL_CONTENT : MHD_HTTP_OK,
                              answer.response);
  }

  int site_;
  bool is_open_;
  MHD_Daemon* daemon_ = nullptr;
  std::size_t crowded_ = 0;                  ///< with more clients, each new one replaces another
  std::unordered_map<int, Client> clients_;  ///< by socket
  Clock::time_point last_look_ = Clock::now();
};

/// A socket that listens there. With SO_REUSEADDR, so that a preview can be started
/// again at once, but without SO_REUSEPORT, with which two previews would share a port.
Descriptor listen_on(const PreviewPlace& place) {
  Descriptor one(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  const int yes = 1;
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(std::uint16_t(place.port));
  if (::inet_pton(AF_INET, place.address.c_str(), &address.sin_addr) != 1)
    throw Error(ExitCode::kUsage, fmt::format("--listen '{}': not an IPv4 address, such as 0.0.0.0",
                                              printable(place.address)));
  if (one.get() < 0 || ::setsockopt(one.get(), SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes) != 0 ||
      ::bind(one.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 ||
      ::listen(one.get(), SOMAXCONN) != 0)
    throw Error(ExitCode::kOutput, fmt::format("{}:{}: cannot listen there: {}", place.address,
                                               place.port, std::strerror(errno)));
  return one;
}

int port_of(int socket) {
  sockaddr_in address{};
  socklen_t size = sizeof address;
  ::getsockname(socket, reinterpret_cast<sockaddr*>(&address), &size);
  return ntohs(address.sin_port);
}

}  // namespace

void serve_site(const fs::path& site, const PreviewPlace& place,
                const std::function<void(const std::string&)>& ready) {
  const Descriptor root(::open(site.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (root.get() < 0)
    throw Error(ExitCode::kInput, fmt::format("{}: no directory that can be read: {}",
                                              site.string(), std::strerror(errno)));
  Descriptor listening = listen_on(place);
  const int real_port = port_of(listening.get());
  Server server(root.get(), std::move(listening), place.is_open());
  const bool is_every = place.address == "0.0.0.0";
  ready(fmt::format("http://{}:{}/", is_every ? host_name() : place.address, real_port));
  server.run_until_interrupted();
}

}  // namespace lobelia::gallery
