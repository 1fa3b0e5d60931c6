#include "tests/gallery/site.hpp"

#include <cstdint>
#include <stdexcept>

#include "base/system/files.hpp"

namespace lobelia::gallery {
namespace fs = std::filesystem;
namespace {

std::string percent_decoded(const std::string& link) {
  std::string result;
  for (std::size_t i = 0; i < link.size(); ++i) {
    if (link[i] != '%') {
      result += link[i];
      continue;
    }
    result += static_cast<char>(std::stoi(link.substr(i + 1, 2), nullptr, 16));
    i += 2;
  }
  return result;
}

template <class Visit>
void for_each_attribute(const pugi::xml_node& node, const Visit& visit) {
  for (const pugi::xml_attribute attribute : node.attributes()) visit(node, attribute);
  for (const pugi::xml_node child : node.children()) for_each_attribute(child, visit);
}

/// As a browser would on file://: a colon before the first slash is a scheme.
bool leads_somewhere(const fs::path& site, const fs::path& page, const pugi::xml_document& document,
                     std::string link) {
  if (const auto hash = link.find('#'); hash != std::string::npos) {
    const std::string id = link.substr(hash + 1);
    const bool is_state = hash > 0 && id.find('=') != id.npos;  // of the script of that page
    if (!is_state && !document.select_node(("//*[@id='" + id + "']").c_str())) return false;
    link.erase(hash);
    if (link.empty()) return true;
  }
  if (link.empty() || link.front() == '/' || link.find(':') != std::string::npos) return false;
  const fs::path target = (page.parent_path() / percent_decoded(link)).lexically_normal();
  return *target.begin() != ".." && fs::is_regular_file(site / target);
}

}  // namespace

Site::Site(const fs::path& directory) : directory_(directory) {
  for (const auto& entry : fs::recursive_directory_iterator(directory)) {
    if (entry.path().extension() != ".html") continue;
    const std::string name = entry.path().lexically_relative(directory).generic_string();
    const auto result = pages_[name].load_file(entry.path().c_str(), pugi::parse_default);
    if (!result) throw std::runtime_error(name + ": " + result.description());
  }
}

const pugi::xml_document& Site::cell(const std::string& id) const {
  return page("cells/" + id + "/index.html");
}

std::vector<std::string> Site::bad_links() const {
  std::vector<std::string> problems;
  for (const auto& [name, document] : pages_) {
    for_each_attribute(document,
                       [&](const pugi::xml_node& node, const pugi::xml_attribute& attribute) {
                         const std::string key = attribute.name(), value = attribute.value();
                         if (key != "href" && key != "src") return;
                         if (std::string_view(node.attribute("rel").value()) == "icon" &&
                             value.starts_with("data:image/svg"))
                           return;
                         if (!leads_somewhere(directory_, name, document, value)) {
                           problems.push_back(name + ": " + value);
                         }
                       });
  }
  return problems;
}

std::vector<std::string> Site::active_content() const {
  std::vector<std::string> problems;
  for (const auto& [name, document] : pages_) {
    for_each_attribute(document, [&](const pugi::xml_node&, const pugi::xml_attribute& attribute) {
      const std::string key = attribute.name();
      if (key.starts_with("on") || key == "style" || key == "srcset" || key == "srcdoc") {
        problems.push_back(name + ": " + key);
      }
    });
    for (const auto& script : document.select_nodes("//script"))
      if (script.node().attribute("src").empty() || script.node().first_child())
        problems.push_back(name + ": inline script");
    if (!document.select_node(
            "//head/meta[@http-equiv='Content-Security-Policy'][contains(@content, \"default-src 'none'\")]"))
      problems.push_back(name + ": no policy");
    for (const char* tag : {"iframe", "object", "embed", "style", "base", "form"}) {
      if (document.select_node((std::string("//") + tag).c_str())) {
        problems.push_back(name + ": " + tag);
      }
    }
  }
  return problems;
}

std::string text_of(const pugi::xml_node& node) {
  std::string text;
  for (const pugi::xml_node child : node.children()) {
    text += child.type() == pugi::node_pcdata ? child.value() : text_of(child);
  }
  return text;
}

std::map<std::string, std::string> files_below(const fs::path& directory) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(directory))
    if (entry.is_regular_file())
      files[entry.path().lexically_relative(directory).string()] =
          read_file(entry.path(), std::uint64_t{1} << 28);
  return files;
}

std::string from_base64(std::string_view text) {
  std::string bytes;
  std::uint32_t bits = 0, count = 0;
  for (const char c : text) {
    constexpr std::string_view kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const std::size_t digit = kDigits.find(c);
    if (digit == kDigits.npos) break;
    bits = bits << 6 | std::uint32_t(digit);
    if ((count += 6) >= 8) bytes += char(bits >> (count -= 8) & 0xff);
  }
  return bytes;
}

}  // namespace lobelia::gallery
