// The preview server, as a browser, a careless client and an attacker meet it: `lobelia gallery serve` and raw sockets.
#include <arpa/inet.h>
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <charconv>
#include <filesystem>
#include <vector>

#include "core/files.hpp"
#include "core/host.hpp"
#include "gallery/byte_range.hpp"
#include "lobelia_paths.hpp"

namespace lobelia::gallery {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

/// Milliseconds that only a hang takes.
constexpr int kHang = 600'000;
constexpr std::size_t kManyClients = 2000;
constexpr char kAlone[] = "Host: 127.0.0.1\r\nConnection: close\r\n";

/// A connection to the server.
class Client {
 public:
  explicit Client(int port) : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(std::uint16_t(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (::connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0)
      ADD_FAILURE() << "connect: " << errno;
    const timeval hang{kHang / 1000, 0};
    ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &hang, sizeof hang);
  }
  Client(Client&& other) noexcept : socket_(std::exchange(other.socket_, -1)) {}
  Client& operator=(Client&&) = delete;
  ~Client() {
    if (socket_ >= 0) ::close(socket_);
  }
  /// False once the server does not listen any more.
  bool send(std::string_view text) const {
    while (!text.empty()) {
      const ssize_t n = ::send(socket_, text.data(), text.size(), MSG_NOSIGNAL);
      if (n <= 0) return false;
      text.remove_prefix(std::size_t(n));
    }
    return true;
  }
  /// At most `size` bytes, and fewer once the server has closed.
  std::string receive(std::size_t size) const {
    std::string all;
    std::vector<char> piece(1 << 16);
    while (all.size() < size) {
      const ssize_t n = ::recv(socket_, piece.data(), std::min(piece.size(), size - all.size()), 0);
      if (n < 0 && errno == EAGAIN) ADD_FAILURE() << "the server hangs";
      if (n <= 0) break;
      all.append(piece.data(), std::size_t(n));
    }
    return all;
  }
  /// Goes without a good-bye.
  void reset() const {
    const linger at_once{1, 0};
    ::setsockopt(socket_, SOL_SOCKET, SO_LINGER, &at_once, sizeof at_once);
  }

 private:
  int socket_;
};

struct Answer {
  std::string head, body;
  int status() const {
    int value = 0;
    if (head.size() > 12) std::from_chars(head.data() + 9, head.data() + 12, value);
    return value;
  }
};

class PreviewServer : public ::testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(path("site/cells/a"));
    write_file(path("site/index.html"), "<p>index</p>");
    write_file(path("site/cells/a/index.html"), "<p>cell</p>");
    write_file(path("site/empty.txt"), "");
    write_file(path("site/ten.txt"), "0123456789");
    write_file(path("secret.txt"), "secret");
    start();
  }
  void TearDown() override {
    if (pid_ > 0) {
      EXPECT_EQ(stop(), 0);
    }
  }

  fs::path path(const std::string& name) const { return directory_.path() / name; }

  void start(const char* address = "127.0.0.1") {
    int ends[2];
    ASSERT_EQ(::pipe2(ends, O_CLOEXEC), 0);
    pid_ = ::fork();
    if (pid_ == 0) {
      ::dup2(ends[1], 1);
      ::dup2(::open(path("stderr").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), 2);
      ::execl(LOBELIA_PROGRAM, LOBELIA_PROGRAM, "gallery", "serve", path("site").c_str(), "--port",
              "0", "--listen", address, nullptr);
      ::_exit(99);
    }
    ::close(ends[1]);
    std::string line;
    for (char c = 0; ::read(ends[0], &c, 1) == 1 && c != '\n';) line += c;
    ::close(ends[0]);
    const auto colon = line.rfind(':');
    ASSERT_NE(colon, line.npos) << line;
    port_ = std::stoi(line.substr(colon + 1));
  }
  /// Its exit code.
  int stop() {
    ::kill(pid_, SIGINT);
    int status = 0;
    ::waitpid(pid_, &status, 0);
    pid_ = 0;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }

  Answer raw(std::string_view request) const {
    const Client client(port_);
    client.send(request);
    const std::string all = client.receive(std::string::npos);
    const auto end = all.find("\r\n\r\n");
    return end == all.npos ? Answer{all, ""} : Answer{all.substr(0, end + 2), all.substr(end + 4)};
  }
  Answer get(const std::string& target, const std::string& headers = "",
             const std::string& method = "GET") const {
    return raw(method + " " + target + " HTTP/1.1\r\n" + kAlone + headers + "\r\n");
  }
  void expect_it_serves() const { EXPECT_EQ(get("/").body, "<p>index</p>"); }

  TemporaryDirectory directory_;
  pid_t pid_ = 0;
  int port_ = 0;
};

TEST(ByteRangeOfAFile, IsWhatRfc9110Says) {
  using Kind = ByteRange::Kind;
  struct Case {
    const char* range;
    std::uint64_t size;
    Kind kind;
    std::uint64_t first, count;
  };
  constexpr Kind kWhole = Kind::kWhole, kPart = Kind::kPart, kNone = Kind::kUnsatisfiable;
  for (const auto& [range, size, kind, first, count] : {
           Case{"bytes=0-0", 10, kPart, 0, 1},
           {"bytes=0-9", 10, kPart, 0, 10},
           {"Bytes= 2-3 ", 10, kPart, 2, 2},
           {"bytes=0-10", 10, kPart, 0, 10},
           {"bytes=9-", 10, kPart, 9, 1},
           {"bytes=10-", 10, kNone, 0, 0},
           {"bytes=11-12", 10, kNone, 0, 0},
           {"bytes=-1", 10, kPart, 9, 1},
           {"bytes=-11", 10, kPart, 0, 10},
           {"bytes=-0", 10, kNone, 0, 0},
           {"bytes=0-", 0, kNone, 0, 0},
           {"bytes=-1", 0, kWhole, 0, 0},
           {"bytes=3-18446744073709551615", 10, kPart, 3, 7},
           {"bytes=3-99999999999999999999999", 10, kPart, 3, 7},
           {"bytes=18446744073709551615-", 10, kNone, 0, 0},
           {"bytes=99999999999999999999999-", 10, kNone, 0, 0},
           {"bytes=-99999999999999999999999", 10, kPart, 0, 10},
           {"bytes=0-1,4-5", 10, kWhole, 0, 0},
           {"bytes=4-3", 10, kWhole, 0, 0},
           {"bytes=", 10, kWhole, 0, 0},
           {"bytes=-", 10, kWhole, 0, 0},
           {"bytes=--1", 10, kWhole, 0, 0},
           {"bytes=+1-2", 10, kWhole, 0, 0},
           {"bytes=0x1-2", 10, kWhole, 0, 0},
           {"lines=0-1", 10, kWhole, 0, 0},
           {"", 10, kWhole, 0, 0},
       }) {
    const ByteRange found = byte_range(range, size);
    EXPECT_EQ(found.kind, kind) << range << " of " << size;
    EXPECT_EQ(found.first, first) << range << " of " << size;
    EXPECT_EQ(found.size, count) << range << " of " << size;
  }
}

TEST_F(PreviewServer, GivesPartsOfAFile) {
  const Answer end = get("/ten.txt", "Range: bytes=7-\r\n");
  EXPECT_EQ(end.status(), 206);
  EXPECT_EQ(end.body, "789");
  EXPECT_THAT(end.head, HasSubstr("\r\nContent-Range: bytes 7-9/10\r\n"));
  EXPECT_THAT(end.head, HasSubstr("\r\nContent-Length: 3\r\n"));
  const Answer beyond = get("/ten.txt", "Range: bytes=10-\r\n");
  EXPECT_EQ(beyond.status(), 416);
  EXPECT_THAT(beyond.head, HasSubstr("\r\nContent-Range: bytes */10\r\n"));
  for (const char* headers :
       {"Range: bytes=0-1,4-5\r\n", "Range: bytes=0-1\r\nRange: bytes=4-5\r\n",
        "Range: bytes=0-1\r\nIf-Range: \"x\"\r\n", "Range: bytes=2-1\r\n"}) {
    EXPECT_EQ(get("/ten.txt", headers).status(), 200) << headers;
    EXPECT_EQ(get("/ten.txt", headers).body, "0123456789") << headers;
  }
  EXPECT_EQ(get("/empty.txt", "Range: bytes=0-\r\n").status(), 416);
  EXPECT_EQ(get("/empty.txt").status(), 200);
  const Answer head = get("/ten.txt", "Range: bytes=0-1\r\n", "HEAD");
  EXPECT_EQ(head.status(), 200);
  EXPECT_THAT(head.head, HasSubstr("\r\nContent-Length: 10\r\n"));
  EXPECT_EQ(head.body, "");
}

TEST_F(PreviewServer, GivesFilesOfTheSiteWithTheirTypesAndPolicyAndNoOthers) {
  for (const char* name : {"gallery.js", "gallery.css", "gallery.json", "a.png", "a.exr"})
    write_file(path("site") / name, "x");
  for (const auto& [target, type] : {std::pair("/", "text/html"),
                                     {"/index.html", "text/html"},
                                     {"/cells/a/", "text/html"},
                                     {"/gallery.js", "text/javascript"},
                                     {"/gallery.css", "text/css"},
                                     {"/gallery.json", "application/json"},
                                     {"/a.png", "image/png"},
                                     {"/a.exr", "image/x-exr"}}) {
    const Answer answer = get(target);
    EXPECT_EQ(answer.status(), 200) << target;
    EXPECT_THAT(answer.head, HasSubstr(std::string("\r\nContent-Type: ") + type)) << target;
    EXPECT_THAT(answer.head, HasSubstr("\r\nContent-Security-Policy: default-src 'none'"));
    EXPECT_THAT(answer.head, HasSubstr("\r\nX-Content-Type-Options: nosniff\r\n"));
    EXPECT_NE(answer.body, "") << target;
  }
  write_file(path("site/.hidden"), "secret");
  fs::create_symlink("../secret.txt", path("site/leak.txt"));
  for (const char* target :
       {"/.hidden", "/leak.txt", "/../secret.txt", "/cells/../../secret.txt",
        "/cells\\..\\..\\secret.txt", "//etc/passwd", "/%00", "/cells/", "/no"}) {
    const Answer answer = get(target);
    EXPECT_THAT(answer.status(), testing::AnyOf(400, 404)) << target;
    EXPECT_THAT(answer.body, Not(HasSubstr("secret"))) << target;
  }
}

TEST_F(PreviewServer, RefusesOddRequestsAndGoesOn) {
  struct Case {
    std::string request;
    int status;
  };
  const std::string host = "Host: 127.0.0.1\r\nConnection: close\r\n";
  const auto line = [&](const std::string& first, const std::string& more = "") {
    return first + " HTTP/1.1\r\n" + host + more + "\r\n";
  };
  for (const auto& [request, status] : {
           Case{line("GET http://127.0.0.1/ten.txt"), 200},
           {line("GET http://localhost"), 200},
           {line("GET http://attacker.example/ten.txt"), 403},
           {line("GET /ten.txt%00.html"), 404},
           {line("GET /%2e%2e/secret.txt"), 404},
           {line("GET /..%2fsecret.txt"), 404},
           {line("GET /%zz"), 404},
           {line("GET /%2"), 404},
           {line("GET /ten.txt/"), 404},
           {line("GET ten.txt"), 404},
           {line("GET /ten.txt?a=%00&b"), 200},
           {line("GET /", "Host: 127.0.0.1\r\n"), 400},
           {line("GET /", "Transfer-Encoding: chunked\r\n\r\n5\r\nhello\r\n0\r\n"), 413},
           {line("GET /", "Content-Length: 5\r\n\r\nhello"), 413},
           {line("GET /", "Content-Length: 999999999999\r\n"), 413},
           {line("GET /", "Content-Length: 0\r\n"), 200},
           {line("POST /"), 405},
           {line("PUT /"), 405},
           {line("DELETE /"), 405},
           {line("OPTIONS *"), 405},
           {"GET / HTTP/1.1\r\n\r\n", 400},
           {"GET /\r\n", 400},
           {"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n", 505},
           {line("GET /" + std::string(100000, 'a')), 414},
       })
    EXPECT_EQ(raw(request).status(), status) << request.substr(0, 200);
  EXPECT_THAT(get("/cells/a").head, HasSubstr("\r\nLocation: /cells/a/\r\n"));
  expect_it_serves();
}

TEST_F(PreviewServer, AnswersRequestsThatComeTogether) {
  std::string many;
  for (int i = 0; i < 99; ++i) many += "GET /ten.txt HTTP/1.1\r\nHost: localhost\r\n\r\n";
  const std::string all = raw(many + "GET / HTTP/1.1\r\n" + kAlone + "\r\n").body;
  std::size_t found = 0;
  for (std::size_t at = 0; (at = all.find("HTTP/1.1 200 OK", at)) != all.npos; ++at) ++found;
  EXPECT_EQ(found, 99u) << "and the first";
}

TEST_F(PreviewServer, TakesNoMoreMemoryForHeadersWithoutEnd) {
  expect_it_serves();
  const std::uint64_t before = peak_memory_of(pid_);
  ASSERT_GT(before, 0u);
  std::string hundred, long_ones;
  for (int i = 0; i < 101; ++i) hundred += "X: y\r\n";
  EXPECT_EQ(get("/", hundred).status(), 431);
  for (int i = 0; i < 100; ++i) long_ones += "X-Long: " + std::string(1000, 'x') + "\r\n";
  for (const std::string& block : {long_ones, std::string(100000, 'x')}) {
    const Client client(port_);
    client.send("GET / HTTP/1.1\r\nHost: localhost\r\nX-Long: x\r\n" + block.substr(0, 6));
    std::size_t sent = 0;
    while (sent < 91'000'000 && client.send(block)) sent += block.size();
    EXPECT_LT(sent, 91'000'000u) << "it has listened to the end";
  }
  EXPECT_LT(peak_memory_of(pid_) - before, 16u << 20);
  expect_it_serves();
}

TEST_F(PreviewServer, AnswersAtOnceBesideThousandsOfSlowClientsAndStops) {
  rlimit files{};
  ::getrlimit(RLIMIT_NOFILE, &files);
  files.rlim_cur = std::min<rlim_t>(files.rlim_max, kManyClients + 200);
  ::setrlimit(RLIMIT_NOFILE, &files);
  const std::size_t many = std::min<std::size_t>(kManyClients, files.rlim_cur - 200);
  const std::uint64_t before = peak_memory_of(pid_);
  std::vector<Client> slow;
  for (std::size_t i = 0; i < many; ++i) {
    slow.emplace_back(port_);
    if (i % 2 == 0) slow.back().send("GET / HTTP/1.1\r\nHo");
    if (i == 200) expect_it_serves();
  }
  for (int round = 0; round < 3; ++round) {
    for (const Client& client : slow) client.send("x");
    expect_it_serves();
  }
  EXPECT_LT(peak_memory_of(pid_) - before, 64u << 20);
  EXPECT_EQ(stop(), 0) << "while all of them hang";
}

TEST_F(PreviewServer, ClosesWhoSendsNothingOrNeverEnds) {
  const Client silent(port_), half(port_), dripping(port_);
  half.send("GET / HTTP/1.1\r\nHo");
  dripping.send("GET / HTTP/1.1\r\nHost: localhost\r\nX-Slow: ");
  while (dripping.send("x")) ::usleep(200'000);  // for ever, if nobody stops it
  EXPECT_EQ(silent.receive(1), "");
  half.receive(std::string::npos);
  expect_it_serves();
}

TEST_F(PreviewServer, OutlivesAFileThatIsCutAndReadersThatGo) {
  write_file(path("site/large.bin"), "");
  fs::resize_file(path("site/large.bin"), 64 << 20);
  const std::string request = std::string("GET /large.bin HTTP/1.1\r\n") + kAlone + "\r\n";
  for (int i = 0; i < 20; ++i) {
    const Client client(port_);
    client.send(request);
    client.receive(1000);
    client.reset();
  }
  const Client client(port_);
  client.send(request);
  client.receive(1000);
  fs::resize_file(path("site/large.bin"), 10);
  EXPECT_LT(client.receive(std::string::npos).size(), 64u << 20);
  expect_it_serves();
}

TEST_F(PreviewServer, FollowsNoLinkOutOfTheSiteHoweverOftenItIsSwapped) {
  fs::create_directories(path("site/both"));
  write_file(path("site/both/secret.txt"), "public");
  fs::create_directory_symlink("..", path("site/up"));
  fs::create_symlink("../../site/ten.txt", path("site/cells/inside_by_way_of_outside"));
  fs::create_symlink("../ten.txt", path("site/cells/inside"));
  EXPECT_EQ(get("/up/secret.txt").status(), 404);
  EXPECT_EQ(get("/cells/inside_by_way_of_outside").status(), 404);
  EXPECT_EQ(get("/cells/inside").body, "0123456789");
  fs::create_directory_symlink("..", path("site/outside"));
  const pid_t swapper = ::fork();
  if (swapper == 0) {
    const std::string a = path("site/both"), b = path("site/outside");
    for (;;) ::renameat2(AT_FDCWD, a.c_str(), AT_FDCWD, b.c_str(), RENAME_EXCHANGE);
  }
  int found = 0, refused = 0;
  for (int i = 0; i < 2000 || found == 0 || refused == 0; ++i) {
    const Answer answer = get("/both/secret.txt");
    ++(answer.status() == 200 ? found : refused);
    EXPECT_THAT(answer.body, Not(HasSubstr("secret")));
    if (HasFailure()) break;
  }
  ::kill(swapper, SIGKILL);
  ::waitpid(swapper, nullptr, 0);
}

TEST_F(PreviewServer, AnswersOthersOnlyIfAskedToAndThenWarns) {
  const auto asked_for = [&](const std::string& host) {
    return raw("GET / HTTP/1.1\r\nConnection: close\r\nHost: " + host + "\r\n\r\n").status();
  };
  EXPECT_EQ(asked_for("192.0.2.7:8080"), 403);
  EXPECT_EQ(read_file(path("stderr"), 1 << 10), "");
  EXPECT_EQ(stop(), 0);
  start("0.0.0.0");
  EXPECT_EQ(asked_for("192.0.2.7:8080"), 200);
  EXPECT_EQ(asked_for(host_name() + ":80"), 200);
  EXPECT_EQ(asked_for("localhost"), 200);
  for (const char* name :
       {"rebound.example", "localhost.example", "1.2.3.4.example", "1.2.3", "1.2.3.4:", ""})
    EXPECT_EQ(asked_for(name), 403) << name;
  EXPECT_THAT(read_file(path("stderr"), 1 << 10), HasSubstr("without a password"));
}

TEST_F(PreviewServer, SaysThatItsPortIsTaken) {
  const pid_t second = ::fork();
  if (second == 0) {
    ::close(2);
    ::execl(LOBELIA_PROGRAM, LOBELIA_PROGRAM, "gallery", "serve", path("site").c_str(), "--port",
            std::to_string(port_).c_str(), nullptr);
    ::_exit(99);
  }
  int status = 0;
  ::waitpid(second, &status, 0);
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 4);
}

}  // namespace
}  // namespace lobelia::gallery
