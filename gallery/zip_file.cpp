#include "gallery/zip_file.hpp"

#include <fmt/format.h>
#include <zip.h>

#include <algorithm>
#include <fstream>
#include <memory>
#include <vector>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/interrupt.hpp"
#include "core/module.hpp"
#include "core/removal.hpp"

namespace lobelia::gallery {
namespace {

namespace fs = std::filesystem;

LOBELIA_MODULE_FUNCTION(zip_module, zip_close);
LOBELIA_MODULE_FUNCTION(zip_module, zip_discard);
LOBELIA_MODULE_FUNCTION(zip_module, zip_error_fini);
LOBELIA_MODULE_FUNCTION(zip_module, zip_error_init_with_code);
LOBELIA_MODULE_FUNCTION(zip_module, zip_error_strerror);
LOBELIA_MODULE_FUNCTION(zip_module, zip_file_add);
LOBELIA_MODULE_FUNCTION(zip_module, zip_file_set_dostime);
LOBELIA_MODULE_FUNCTION(zip_module, zip_file_set_external_attributes);
LOBELIA_MODULE_FUNCTION(zip_module, zip_open);
LOBELIA_MODULE_FUNCTION(zip_module, zip_register_cancel_callback_with_state);
LOBELIA_MODULE_FUNCTION(zip_module, zip_set_archive_comment);
LOBELIA_MODULE_FUNCTION(zip_module, zip_set_file_compression);
LOBELIA_MODULE_FUNCTION(zip_module, zip_source_file);
LOBELIA_MODULE_FUNCTION(zip_module, zip_source_free);
LOBELIA_MODULE_FUNCTION(zip_module, zip_strerror);

constexpr std::string_view kComment = kZipComment;
constexpr zip_uint16_t kFirstDay = 1 << 5 | 1;  // 1980-01-01, the first that a zip can say
constexpr zip_uint32_t kMode = 0100644u << 16;
constexpr int kBestCompression = 9;

[[noreturn]] void fail_to_zip(const fs::path& path, const char* why) {
  throw Error(ExitCode::kOutput, fmt::format("{}: {}", path.string(), why));
}

}  // namespace

void write_zip(const fs::path& directory, const std::string& top, const fs::path& path) {
  std::vector<std::string> names;
  for (const fs::path& file : regular_files_below(directory))
    names.push_back(file.lexically_relative(directory).generic_string());
  std::ranges::sort(names);

  // In a directory of ours, because nobody would know again what a killed libzip leaves beside its file.
  const fs::path parent = path.has_parent_path() ? path.parent_path() : fs::path(".");
  remove_dead_temporaries(parent);
  const TemporaryDirectory unfinished(parent);
  const fs::path made = unfinished.path() / "zip";
  int problem = 0;
  const auto discard = [](zip_t* open) { zip_discard(open); };
  std::unique_ptr<zip_t, decltype(discard)> zip(
      zip_open(made.c_str(), ZIP_CREATE | ZIP_TRUNCATE, &problem), discard);
  if (!zip) {
    zip_error_t error;
    zip_error_init_with_code(&error, problem);
    const std::string why = zip_error_strerror(&error);
    zip_error_fini(&error);
    fail_to_zip(path, why.c_str());
  }
  const auto check = [&](bool works) {
    if (!works) fail_to_zip(path, zip_strerror(zip.get()));
  };
  for (const std::string& name : names) {
    zip_source_t* source = zip_source_file(zip.get(), (directory / name).c_str(), 0, -1);
    check(source != nullptr);
    const zip_int64_t index =
        zip_file_add(zip.get(), (top + "/" + name).c_str(), source, ZIP_FL_ENC_UTF_8);
    if (index < 0) zip_source_free(source);
    check(index >= 0);
    const auto at = zip_uint64_t(index);
    check(zip_set_file_compression(zip.get(), at, ZIP_CM_DEFLATE, kBestCompression) == 0 &&
          zip_file_set_dostime(zip.get(), at, 0, kFirstDay, 0) == 0 &&
          zip_file_set_external_attributes(zip.get(), at, 0, ZIP_OPSYS_UNIX, kMode) == 0);
  }
  check(zip_set_archive_comment(zip.get(), kComment.data(), zip_uint16_t(kComment.size())) == 0);
  zip_register_cancel_callback_with_state(
      zip.get(), [](zip_t*, void*) { return int(interrupted()); }, nullptr, nullptr);
  const bool is_written = zip_close(zip.get()) == 0;
  if (!is_written) throw_if_interrupted();
  check(is_written);
  (void)zip.release();
  const EndDelay delay;
  throw_if_interrupted();
  std::error_code error;
  fs::rename(made, path, error);
  if (error) fail_to_zip(path, error.message().c_str());
}

bool is_our_zip(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string end(kComment.size(), '\0');
  file.seekg(-std::streamoff(end.size()), std::ios::end);
  file.read(end.data(), std::streamsize(end.size()));
  return file && end == kComment;
}

}  // namespace lobelia::gallery
