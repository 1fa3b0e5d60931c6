// A web server for previewing a site.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace lobelia::gallery {

inline constexpr char kThisMachine[] = "127.0.0.1";

/// Where a preview listens.
struct PreviewPlace {
  std::string address = kThisMachine;  ///< IPv4; "0.0.0.0": every address of this machine
  int port = 8080;                     ///< 0: any free one

  bool is_open() const { return !address.starts_with("127."); }
};

/// Serves the files below `site` until interrupted(): GET and HEAD, no hidden files, and no links out of the site. Answers only
/// requests for 127.0.0.1 or localhost and, if it is open to others, for an address in numbers or this machine's name, so
/// that no foreign page can reach it through a name of its own.
/// Some thousand clients may be connected, however slow; a connection without a complete request is closed after half
/// a minute. Calls `ready` with the URL once it listens. Works on the calling thread alone, and
/// raises the limit of open files.
/// Throws Error(kInput) if there is no such directory, Error(kOutput) if it cannot listen there.
void serve_site(const std::filesystem::path& site, const PreviewPlace& place,
                const std::function<void(const std::string& url)>& ready);

}  // namespace lobelia::gallery
