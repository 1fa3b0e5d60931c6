#include "base/records/manifest.hpp"

#include <charconv>
#include <nlohmann/json.hpp>
#include <utility>

namespace lobelia::records {
namespace {

/// Takes the texts of an object, as long as they are nothing but texts.
class ManifestNames : public nlohmann::json_sax<nlohmann::json> {
 public:
  explicit ManifestNames(std::map<std::uint32_t, std::string>& names) : names_(names) {}
  bool key(std::string& name) override {
    name_ = name.substr(0, kLongestObjectName);
    return true;
  }
  bool string(std::string& hash) override {
    std::uint32_t id = 0;
    const auto [end, error] = std::from_chars(hash.data(), hash.data() + hash.size(), id, 16);
    if (is_open_ && error == std::errc() && end == hash.data() + hash.size())
      names_.try_emplace(id, name_);
    return is_open_;
  }
  bool start_object(std::size_t) override { return !std::exchange(is_open_, true); }
  bool end_object() override { return false; }
  bool start_array(std::size_t) override { return false; }
  bool end_array() override { return false; }
  bool null() override { return false; }
  bool boolean(bool) override { return false; }
  bool number_integer(number_integer_t) override { return false; }
  bool number_unsigned(number_unsigned_t) override { return false; }
  bool number_float(number_float_t, const string_t&) override { return false; }
  bool binary(binary_t&) override { return false; }
  bool parse_error(std::size_t, const std::string&, const nlohmann::json::exception&) override {
    return false;
  }

 private:
  std::map<std::uint32_t, std::string>& names_;
  std::string name_;
  bool is_open_ = false;
};

}  // namespace

std::map<std::uint32_t, std::string> object_names(const std::string& manifest) {
  std::map<std::uint32_t, std::string> names;
  ManifestNames reader(names);
  static_cast<void>(nlohmann::json::sax_parse(manifest, &reader));
  return names;
}

}  // namespace lobelia::records
