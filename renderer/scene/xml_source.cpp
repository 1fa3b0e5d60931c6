#include "renderer/scene/xml_source.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/system/error.hpp"
#include "base/words/text.hpp"

namespace lobelia {
namespace {

constexpr std::size_t kMaxErrors = 20;  // more would hide the first
/// Editors find the schema by these, on the root element.
constexpr std::string_view kSchemaAttributes[] = {"xmlns:xsi", "xsi:noNamespaceSchemaLocation"};

}  // namespace

XmlSource::XmlSource(std::string text, std::string file_name, std::size_t max_bytes)
    : original_(std::move(text)), parsed_(original_), file_name_(std::move(file_name)) {
  if (original_.size() > max_bytes)
    throw Error(ExitCode::kInput, "{}: {} bytes; at most {} are read", file_name_, original_.size(),
                max_bytes);
  // In place, so that names and values point into parsed_ and give their positions.
  const auto result =
      document_.load_buffer_inplace(parsed_.data(), parsed_.size(),
                                    pugi::parse_default | pugi::parse_doctype, pugi::encoding_utf8);
  if (!result)
    throw Error(ExitCode::kInput, "{}: broken XML: {}", place(result.offset), result.description());
  for (const auto node : document_.children())
    if (node.type() == pugi::node_doctype)
      throw Error(ExitCode::kInput, "{}: a DOCTYPE is not allowed: entities are not read",
                  file_name_);
}

std::string XmlSource::place(std::ptrdiff_t offset) const {
  if (offset < 0 || std::size_t(offset) > original_.size()) return file_name_;
  const std::string_view before(original_.data(), std::size_t(offset));
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const auto start = before.rfind('\n');
  return fmt::format("{}:{}:{}", file_name_, line,
                     before.size() - (start == before.npos ? 0 : start + 1) + 1);
}

void XmlSource::note(std::ptrdiff_t offset, const std::string& message) {
  if (errors_.size() < kMaxErrors) errors_.emplace_back(offset, place(offset) + ": " + message);
  ++error_count_;
}

void XmlSource::error(pugi::xml_node where, const std::string& message) {
  note(where.offset_debug(), message);
}

void XmlSource::error(pugi::xml_attribute where, pugi::xml_node of, const std::string& message) {
  const char* value = where.value();
  const bool inside = value >= parsed_.data() && value <= parsed_.data() + parsed_.size();
  note(inside ? value - parsed_.data() : of.offset_debug(), message);
}

bool XmlSource::full() const { return errors_.size() >= kMaxErrors; }

std::vector<std::string> XmlSource::error_lines() const {
  auto sorted = errors_;
  std::ranges::stable_sort(sorted, {}, &decltype(sorted)::value_type::first);
  std::vector<std::string> lines;
  for (const auto& [offset, line] : sorted) lines.push_back(line);
  if (error_count_ > errors_.size())
    lines.push_back(
        fmt::format("{}: {} further errors", file_name_, error_count_ - errors_.size()));
  return lines;
}

void XmlSource::throw_if_errors() const {
  if (!errors_.empty()) throw Error(ExitCode::kInput, error_lines());
}

void XmlSource::check_attributes(pugi::xml_node node,
                                 std::initializer_list<std::string_view> allowed) {
  check_attributes(node, std::span(allowed.begin(), allowed.size()));
}

void XmlSource::check_attributes(pugi::xml_node node, std::span<const std::string_view> allowed) {
  for (const auto attribute : node.attributes()) {
    const std::string_view name = attribute.name();
    if (std::ranges::find(allowed, name) != allowed.end()) continue;
    if (node == root() && std::ranges::find(kSchemaAttributes, name) != std::end(kSchemaAttributes))
      continue;
    if (full()) {
      count_error();
      continue;
    }
    error(attribute, node,
          fmt::format("<{}> has no attribute '{}'; allowed: {}{}", node.name(), printable(name),
                      join(allowed), did_you_mean(name, allowed)));
  }
}

std::string XmlSource::required(pugi::xml_node node, const char* attribute) {
  if (const auto found = node.attribute(attribute)) return found.value();
  error(node, fmt::format("<{}> needs the attribute '{}'", printable(node.name()), attribute));
  return "";
}

}  // namespace lobelia
