// A written gallery as a test sees it: pages parsed as XML, links followed.
#pragma once

#include <filesystem>
#include <map>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace lobelia::gallery {

/// Every page under `directory`, by its path relative to it; throws if one is not well-formed.
class Site {
 public:
  explicit Site(const std::filesystem::path& directory);

  const std::map<std::string, pugi::xml_document>& pages() const { return pages_; }
  const pugi::xml_document& page(const std::string& name) const { return pages_.at(name); }
  const pugi::xml_document& cell(const std::string& id) const;
  /// "PAGE: LINK" for every link or source that leads nowhere, out of the site, or to a network.
  std::vector<std::string> bad_links() const;
  /// Elements and attributes that no page of ours has: foreign scripts, event handlers.
  std::vector<std::string> active_content() const;

 private:
  std::filesystem::path directory_;
  std::map<std::string, pugi::xml_document> pages_;
};

/// All text below a node, as a person reads it.
std::string text_of(const pugi::xml_node& node);

/// The contents of all files below a directory, by their paths in it.
std::map<std::string, std::string> files_below(const std::filesystem::path& directory);

/// Up to the first character that is no digit of base64.
std::string from_base64(std::string_view text);

}  // namespace lobelia::gallery
