#include "gallery/preview_server.hpp"

#include <fmt/format.h>
#include <httplib.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <memory>
#include <optional>
#include <regex>
#include <string>
#include <thread>
#include <vector>

#include "core/error.hpp"
#include "core/interrupt.hpp"
#include "gallery/names.hpp"
#include "gallery/page.hpp"

namespace lobelia::gallery {
namespace {

namespace fs = std::filesystem;

constexpr char kLoopback[] = "127.0.0.1";

std::string content_type(const fs::path& file) {
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
  const std::string extension = file.extension().string();
  for (const auto& [ending, type] : kTypes)
    if (extension == ending) return type;
  return "application/octet-stream";
}

/// The names between the slashes of a request's path (decoded); empty if one of them is not plain.
std::optional<std::vector<std::string>> names_of(const std::string& path) {
  std::vector<std::string> names;
  for (std::size_t from = 0; from < path.size();) {
    const std::size_t slash = std::min(path.find('/', from), path.size());
    if (slash > from) names.push_back(path.substr(from, slash - from));
    if (slash > from && !is_plain_name(names.back())) return std::nullopt;
    from = slash + 1;
  }
  return names;
}

/// The file that they name below `root` (canonical); empty if there is none to be seen.
std::optional<fs::path> file_of(const fs::path& root, const std::vector<std::string>& names) {
  fs::path file = root;
  for (const std::string& name : names) file /= name;
  std::error_code error;
  if (fs::is_directory(file, error)) file /= "index.html";
  file = fs::canonical(file, error);
  if (error || !fs::is_regular_file(file, error)) return std::nullopt;
  const auto [in_root, ignored] = std::mismatch(root.begin(), root.end(), file.begin(), file.end());
  return in_root == root.end() ? std::optional(file) : std::nullopt;
}

void refuse(httplib::Response& response, int status, const char* words) {
  response.status = status;
  response.set_content(words, "text/plain; charset=utf-8");
}

void answer(const fs::path& root, const httplib::Request& request, httplib::Response& response) {
  const auto names = names_of(request.path);
  const auto file = names ? file_of(root, *names) : std::nullopt;
  if (!file) return refuse(response, 404, "There is no such file.\n");
  if (!names->empty() && request.path.back() != '/' && file->filename() != names->back()) {
    // A directory's own page: its links are relative to the directory.
    std::string url;
    for (const std::string& name : *names) url += "/" + link_to({name});
    return response.set_redirect(url + "/");
  }
  std::error_code error;
  const auto bytes = fs::file_size(*file, error);
  auto in = std::make_shared<std::ifstream>(*file, std::ios::binary);
  if (error || !*in) return refuse(response, 404, "There is no such file.\n");
  if (bytes == 0) return response.set_content("", content_type(*file));
  response.set_content_provider(
      bytes, content_type(*file),
      [in](std::size_t offset, std::size_t length, httplib::DataSink& sink) {
        std::vector<char> piece(std::min<std::size_t>(length, 1 << 16));
        in->seekg(static_cast<std::streamoff>(offset));
        in->read(piece.data(), static_cast<std::streamsize>(piece.size()));
        return in->gcount() > 0 && sink.write(piece.data(), static_cast<std::size_t>(in->gcount()));
      });
}

}  // namespace

void serve_site(const fs::path& site, int port,
                const std::function<void(const std::string&)>& ready) {
  std::error_code error;
  const fs::path root = fs::canonical(site, error);
  if (error || !fs::is_directory(root, error))
    throw Error(ExitCode::kInput, site.string() + ": no such directory");

  httplib::Server server;
  server.set_default_headers({{"Content-Security-Policy", kContentSecurityPolicy},
                              {"X-Content-Type-Options", "nosniff"},
                              {"Referrer-Policy", "no-referrer"},
                              {"Cross-Origin-Resource-Policy", "same-origin"},
                              {"Cache-Control", "no-cache"}});
  server.set_pre_routing_handler([](const httplib::Request& request, httplib::Response& response) {
    static const std::regex kHost(R"re((127\.0\.0\.1|localhost)(:[0-9]{1,5})?)re");
    if (!std::regex_match(request.get_header_value("Host"), kHost)) {
      refuse(response, 403, "This preview answers to 127.0.0.1 and localhost alone.\n");
    } else if (request.method != "GET" && request.method != "HEAD") {
      response.set_header("Allow", "GET, HEAD");
      refuse(response, 405, "Only GET and HEAD.\n");
    } else {
      return httplib::Server::HandlerResponse::Unhandled;
    }
    return httplib::Server::HandlerResponse::Handled;
  });
  server.Get(".*", [&root](const httplib::Request& request, httplib::Response& response) {
    answer(root, request, response);
  });
  // Without the library's SO_REUSEPORT, by which two previews would share a port in silence.
  server.set_socket_options([](socket_t socket) {
    const int yes = 1;
    setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  });
  const int bound = port == 0                              ? server.bind_to_any_port(kLoopback)
                    : server.bind_to_port(kLoopback, port) ? port
                                                           : -1;
  if (bound < 0)
    throw Error(ExitCode::kOutput,
                fmt::format("{}:{}: the port is taken or not allowed", kLoopback, port));
  ready(fmt::format("http://{}:{}/", kLoopback, bound));
  const std::jthread watch([&server](const std::stop_token& done) {
    while (!done.stop_requested() && !interrupted())
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    server.stop();
  });
  server.listen_after_bind();
}

}  // namespace lobelia::gallery
