// A view of one record that a run may have.
#pragma once

#include <filesystem>
#include <functional>
#include <initializer_list>
#include <optional>

#include "gallery/views.hpp"
#include "records/record.hpp"

namespace lobelia::gallery {

namespace detail {
std::optional<ViewPage> record_page(
    const std::filesystem::path& run, const char* file, const char* title,
    const std::function<void(ViewPage& page, const std::string& text)>& draw);
}  // namespace detail

/// Empty where RUN/file is not there, else the page that `draw` fills of its record. Where the record cannot be read,
/// or `draw` throws Error(kInput), the page says that in place of everything.
template <class T>
std::optional<ViewPage> record_page(const std::filesystem::path& run, const char* file,
                                    const char* title,
                                    const std::function<void(ViewPage&, const T&)>& draw) {
  return detail::record_page(run, file, title, [&](ViewPage& page, const std::string& text) {
    records::Origin origin;
    const T record = records::parse_record<T>(text, file, &origin);
    page.made_by = origin.made_by;
    draw(page, record);
  });
}

/// <header> with the title and a sentence below it.
void write_lead(Html& html, const char* title, const std::string& words);
/// A table's head: a column for each.
void write_columns(Html& html, std::initializer_list<std::string> columns);
/// "All of it is in FILE", with a link to it.
void write_source(Html& html, const std::string& command, const char* file);

}  // namespace lobelia::gallery
