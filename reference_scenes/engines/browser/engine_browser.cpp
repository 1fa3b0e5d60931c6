// engine_three, engine_babylon: render by an engine for browsers, in Debian's Chromium without a window. The page is
// engine_NAME.html beside this program. It is driven by the DevTools protocol through two pipes, so no port is open, and
// neither Node nor a driver is needed.
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "reference_scenes/engines/programs/scene_program.hpp"

namespace lobelia {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr int kNotInstalled = 69;
constexpr std::size_t kMostMessage = std::size_t{1} << 30;

fs::path page_file() {
  fs::path page = fs::read_symlink("/proc/self/exe");
  page += ".html";
  return page;
}

/// A running Chromium with the page.
class Browser {
 public:
  Browser() {
    int to[2], from[2];
    if (::pipe2(to, O_CLOEXEC) != 0 || ::pipe2(from, O_CLOEXEC) != 0)
      throw std::runtime_error(std::strerror(errno));
    child_ = ::fork();
    if (child_ < 0) throw std::runtime_error(std::strerror(errno));
    if (child_ == 0) start(to[0], from[1]);
    ::close(to[0]);
    ::close(from[1]);
    to_ = to[1];
    from_ = from[0];
    const Json target = call("Target.createTarget", {{"url", url()}});
    session_ =
        call("Target.attachToTarget", {{"targetId", target.at("targetId")}, {"flatten", true}})
            .at("sessionId");
    while (evaluate("typeof renderScene") != "function") ::usleep(10'000);
  }
  ~Browser() {
    ::close(to_);
    ::close(from_);
    ::waitpid(child_, nullptr, 0);
  }
  Browser(const Browser&) = delete;
  Browser& operator=(const Browser&) = delete;

  /// The value of an expression of the page, or what its promise comes to. Throws if it throws.
  Json evaluate(const std::string& expression) {
    const Json answer =
        call("Runtime.evaluate",
             {{"expression", expression}, {"awaitPromise", true}, {"returnByValue", true}});
    if (answer.contains("exceptionDetails")) {
      const Json& details = answer["exceptionDetails"];
      const Json thrown = details.value("exception", Json::object());
      throw std::runtime_error(
          thrown.value("description", details.value("text", "the page failed")));
    }
    return answer.at("result").value("value", Json());
  }

 private:
  static std::string url() {
    std::string text = "file://";
    for (const unsigned char c : page_file().string()) {
      constexpr char kDigits[] = "0123456789ABCDEF";
      if (std::isalnum(c) || std::strchr("/._-~", c))
        text += char(c);
      else
        text += {'%', kDigits[c >> 4], kDigits[c & 15]};
    }
    return text;
  }

  [[noreturn]] static void start(int commands, int answers) {
    // 3 and 4 are where Chromium looks; the pipes may be there already.
    const int in = ::fcntl(commands, F_DUPFD, 10), out = ::fcntl(answers, F_DUPFD, 10);
    ::dup2(in, 3);
    ::dup2(out, 4);
    const int null = ::open("/dev/null", O_RDWR);
    ::dup2(null, 0);
    ::dup2(null, 1);
    ::dup2(null, 2);
    ::close_range(5, ~0u, 0);
    const char* home = std::getenv("HOME");
    const std::string profile = std::string("--user-data-dir=") + (home ? home : ".") + "/chromium";
    // The only page is ours, and asks for nothing; the farm contains the browser as it does every engine. Its own sandbox
    // would need privileges that are not to be had there. SwiftShader is the same on every machine.
    const char* const arguments[] = {"chromium",
                                     "--headless",
                                     "--no-sandbox",
                                     "--remote-debugging-pipe",
                                     profile.c_str(),
                                     "--use-gl=angle",
                                     "--use-angle=swiftshader",
                                     "--enable-unsafe-swiftshader",
                                     "--disable-dev-shm-usage",
                                     "--no-first-run",
                                     "--disable-extensions",
                                     "--disable-background-networking",
                                     "--no-proxy-server",
                                     "--mute-audio",
                                     nullptr};
    ::execvp("chromium", const_cast<char* const*>(arguments));
    ::_exit(kNotInstalled);
  }

  void send(const std::string& text) const {
    std::size_t done = 0;
    while (done <= text.size()) {  // with the final zero
      const ssize_t n = ::write(to_, text.c_str() + done, text.size() + 1 - done);
      if (n > 0)
        done += std::size_t(n);
      else if (errno != EINTR)
        throw std::runtime_error("Chromium has ended");
    }
  }
  /// Up to the next zero.
  std::string receive() {
    for (;;) {
      const std::size_t end = received_.find('\0', looked_at_);
      if (end != received_.npos) {
        std::string message = received_.substr(0, end);
        received_.erase(0, end + 1);
        looked_at_ = 0;
        return message;
      }
      looked_at_ = received_.size();
      char part[1 << 16];
      const ssize_t n = ::read(from_, part, sizeof part);
      if (n > 0)
        received_.append(part, std::size_t(n));
      else if (n == 0 || errno != EINTR)
        throw std::runtime_error("Chromium has ended");
      if (received_.size() > kMostMessage) throw std::runtime_error("Chromium answers without end");
    }
  }
  Json call(const std::string& method, const Json& parameters) {
    Json command{{"id", ++id_}, {"method", method}, {"params", parameters}};
    if (!session_.empty()) command["sessionId"] = session_;
    send(command.dump());
    for (;;) {
      Json answer = Json::parse(receive());
      if (answer.value("id", 0) != id_) continue;  // an event
      if (answer.contains("error"))
        throw std::runtime_error(answer["error"].value("message", "Chromium refuses " + method));
      return answer.at("result");
    }
  }

  pid_t child_ = 0;
  int to_ = -1, from_ = -1, id_ = 0;
  std::string session_, received_;
  std::size_t looked_at_ = 0;
};

Json json(const CameraScene& scene) {
  Json lights = Json::array();
  for (const auto& light : scene.lights)
    lights.push_back(
        {{"isDistant", light.is_distant}, {"place", light.place}, {"strength", light.strength}});
  const auto& sphere = scene.spheres.at(0);
  const auto& material = scene.materials.at(sphere.material);
  return {{"width", scene.width},
          {"height", scene.height},
          {"window", {scene.left, scene.right, scene.bottom, scene.top}},
          {"lights", lights},
          {"hasHighlight", material.kind != "none"},
          {"exponent", material.exponent},
          {"strength", material.strength},
          {"diffuse", material.diffuse},
          {"centre", sphere.centre},
          {"radius", sphere.radius}};
}

int digit_of(char c) {
  static constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const std::size_t digit = kDigits.find(c);
  if (digit == kDigits.npos) throw std::runtime_error("the page's answer is no picture");
  return int(digit);
}

/// Appends the float32 values of a text in base 64.
void append_floats(const std::string& text, std::vector<float>& values) {
  std::string bytes;
  unsigned bits = 0;
  int count = 0;
  for (const char c : text) {
    if (c == '=') break;
    bits = (bits << 6) | unsigned(digit_of(c));
    if ((count += 6) < 8) continue;
    count -= 8;
    bytes += char((bits >> count) & 0xff);
  }
  const std::size_t before = values.size();
  values.resize(before + bytes.size() / sizeof(float));
  std::memcpy(values.data() + before, bytes.data(), (values.size() - before) * sizeof(float));
}

std::vector<float> render(const CameraScene& scene) {
  static Browser browser;
  constexpr int kPixelsAtOnce = 1 << 20;
  browser.evaluate("renderScene(" + json(scene).dump() + ")");
  std::vector<float> rgb;
  const int rows = std::max(1, kPixelsAtOnce / scene.width);
  for (int row = 0; row < scene.height; row += rows)
    append_floats(browser.evaluate("rowsOfPicture(" + std::to_string(row) + "," +
                                   std::to_string(std::min(rows, scene.height - row)) + ")"),
                  rgb);
  return rgb;
}

/// "three.js 0.187.0": the title of the page. Whether there is a Chromium is seen without starting it.
std::string version() {
  std::ifstream page(page_file());
  const std::string text(std::istreambuf_iterator<char>(page), {});
  const std::size_t begin = text.find("<title>"), end = text.find("</title>");
  if (begin == text.npos || end == text.npos) {
    std::fprintf(stderr, "Lobelia was built without npm's packages, which tools/web fetches\n");
    std::exit(kNotInstalled);
  }
  if (std::system("command -v chromium > /dev/null") != 0) {
    std::fprintf(stderr, "no program 'chromium' in $PATH\n");
    std::exit(kNotInstalled);
  }
  return text.substr(begin + 7, end - begin - 7);
}

}  // namespace
}  // namespace lobelia

int main(int argc, char** argv) {
  return lobelia::run_scene_program(argc, argv, lobelia::version, lobelia::render);
}
