// Reads the finishes of POV-Ray's scene and include files.
//
// Source: POV-Ray 3.7, section 3.4.5.3.5: phong is (R.L)^phong_size, specular (N.H)^(1 / roughness), both without N.L. The
//         defaults are phong 0, phong_size 40, specular 0, roughness 0.05.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>

#include "base/words/text.hpp"
#include "studies/convert/assets/assets.hpp"

namespace lobelia::conversion {
namespace {

constexpr std::string_view kPovrayMeaning =
    "POV-Ray: phong_size is the exponent of R.L, 1/roughness that of N.H, without the cosine N.L";

/// Names, numbers and single characters. Comments and texts are left out.
class PovTokens {
 public:
  explicit PovTokens(std::string_view text) : text_(text) { next(); }

  std::string_view token() const { return token_; }  ///< empty at the end
  int line() const { return line_; }                 ///< of the token
  void next() {
    skip_blank();
    const std::size_t begin = at_;
    if (at_ == text_.size()) {
      token_ = {};
      return;
    }
    const auto is_word = [&](char c) {
      return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '.';
    };
    ++at_;
    // The sign of an exponent belongs to its number.
    const bool is_number = is_word(text_[begin]) && !is_letter(text_[begin]);
    if (is_word(text_[begin]) || text_[begin] == '#')
      while (at_ < text_.size() &&
             (is_word(text_[at_]) || (is_number && is_sign(at_) && is_exponent(at_ - 1))))
        ++at_;
    token_ = text_.substr(begin, at_ - begin);
  }

 private:
  static bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) || c == '_'; }
  bool is_sign(std::size_t i) const { return text_[i] == '-' || text_[i] == '+'; }
  bool is_exponent(std::size_t i) const { return text_[i] == 'e' || text_[i] == 'E'; }
  void skip_to(std::string_view end) {
    const std::size_t found = text_.find(end, at_);
    skip(found == text_.npos ? text_.size() - at_ : found + end.size() - at_);
  }
  void skip(std::size_t count) {
    line_ += int(std::count(text_.begin() + std::ptrdiff_t(at_),
                            text_.begin() + std::ptrdiff_t(at_ + count), '\n'));
    at_ += count;
  }
  /// POV-Ray nests comments.
  void skip_comment() {
    int depth = 0;
    do {
      const std::string_view here = text_.substr(at_, 2);
      depth += here == "/*" ? 1 : here == "*/" ? -1 : 0;
      skip(here == "/*" || here == "*/" ? 2 : 1);
    } while (depth > 0 && at_ < text_.size());
  }
  void skip_blank() {
    while (at_ < text_.size()) {
      const std::string_view here = text_.substr(at_, 2);
      if (here == "//") {
        skip_to("\n");
      } else if (here == "/*") {
        skip_comment();
      } else if (here[0] == '"') {
        skip(1);
        skip_to("\"");
      } else if (std::isspace(static_cast<unsigned char>(here[0]))) {
        skip(1);
      } else {
        return;
      }
    }
  }

  std::string_view text_, token_;
  std::size_t at_ = 0;
  int line_ = 1;
};

/// The texts of values that stand in a finish.
using Finish = std::map<std::string_view, std::string>;

/// Between blanks.
constexpr std::string_view kFinishWords =
    " ambient brilliance conserve_energy crand diffuse emission fresnel irid metallic phong "
    "phong_size reflection reflection_exponent roughness specular subsurface use_alpha ";

bool is_finish_word(std::string_view token) {
  return kFinishWords.find(fmt::format(" {} ", token)) != kFinishWords.npos;
}

class PovReader {
 public:
  explicit PovReader(std::string_view text) : tokens_(text) {}

  Assets read() {
    for (; !tokens_.token().empty(); tokens_.next()) {
      const std::string_view token = tokens_.token();
      if (token == "#declare" || token == "#local" || token == "#default") {
        if (token != "#default") tokens_.next();
        name_ = tokens_.token();
        depth_of_name_ = depth_;
      } else if (token == "finish") {
        read_finish();
      } else if (token == ";") {
        if (depth_ == depth_of_name_) name_ = {};
      } else if (token == "{") {
        ++depth_;
      } else if (token == "}") {
        if (--depth_ <= depth_of_name_) name_ = {};
      } else if (token == "#include" || token == "#if" || token == "#while" || token == "#macro") {
        has_directives_ = true;
      }
    }
    if (has_directives_)
      assets_.remarks.emplace_back(
          "directives are not run: each finish that stands in the file is read");
    return std::move(assets_);
  }

 private:
  /// Begins at "finish", and ends at its last brace.
  void read_finish() {
    const int line = tokens_.line();
    tokens_.next();
    if (tokens_.token() != "{") return;
    tokens_.next();
    Finish finish = defaults_;
    if (const auto known = declared_.find(tokens_.token()); known != declared_.end())
      finish = known->second;
    else if (is_base(tokens_.token()))
      finish["base"] = tokens_.token();
    if (is_base(tokens_.token())) tokens_.next();
    read_values(finish);
    if (name_ == "#default")
      defaults_ = finish;
    else if (!name_.empty())
      declared_[name_] = finish;
    const std::string_view name = name_ == "#default" ? "" : name_;
    add(name.empty() ? fmt::format("finish of line {}", line) : std::string(name), finish);
    if (depth_ <= depth_of_name_) name_ = {};
  }

  static bool is_base(std::string_view token) {
    return !token.empty() && token != "}" && token[0] != '#' && !is_finish_word(token);
  }

  void read_values(Finish& finish) {
    std::string_view word;
    for (int depth = 0; !tokens_.token().empty(); tokens_.next()) {
      const std::string_view token = tokens_.token();
      if (token == "}" && depth-- == 0) return;
      if (token == "{") ++depth;
      if (token[0] == '#') has_directives_ = true;
      if (depth > 0) continue;
      if (is_finish_word(token)) {
        word = token;
        finish[word].clear();
      } else if (token != "albedo" && token != "}" && finish[word].size() < kMostValue) {
        std::string& value = finish[word];
        const bool is_signed = value == "-" || value == "+";
        value += fmt::format("{}{}", value.empty() || is_signed ? "" : " ", token);
      }
    }
  }

  /// A value of the finish, or POV-Ray's default with a remark.
  static double value_of(const Finish& finish, std::string_view word, double otherwise, double most,
                         FileMaterial& to) {
    const auto found = finish.find(word);
    if (found == finish.end()) {
      to.remark(fmt::format("{} is missing: POV-Ray's default {:g} is used", word, otherwise));
    } else if (const auto number = number_of(found->second, 0, most, word, to)) {
      return *number;
    } else {
      to.remark(fmt::format("POV-Ray's default {} {:g} is used", word, otherwise));
    }
    return otherwise;
  }

  void add(const std::string& name, const Finish& finish) {
    // An amount that is an expression counts as a highlight.
    const auto has = [&](std::string_view word) {
      const auto found = finish.find(word);
      double amount = 1;
      return found != finish.end() && (!parse_number(found->second, amount) || amount != 0);
    };
    const bool both = has("phong") && has("specular");
    if (has("phong")) {
      FileMaterial& to = assets_.add(both ? name + ", phong" : name);
      to.set("phong_rdf", value_of(finish, "phong_size", 40, kMaxExponent, to));
      remark_on(finish, to);
    }
    if (has("specular")) {
      FileMaterial& to = assets_.add(both ? name + ", specular" : name);
      const double roughness = value_of(finish, "roughness", 0.05, 1e100, to);
      if (roughness > 0)
        to.set("blinn_phong_rdf", 1 / roughness);
      else
        to.remark("roughness 0 has no exponent");
      remark_on(finish, to);
    }
    if (has("phong") || has("specular")) return;
    FileMaterial& to = assets_.add(name);
    to.remark("there is no highlight: phong and specular are 0, which is POV-Ray's default");
    remark_on(finish, to);
  }

  static void remark_on(const Finish& finish, FileMaterial& to) {
    if (const auto base = finish.find("base"); base != finish.end())
      to.remark(fmt::format("the finish {} it begins with is declared elsewhere, and not read",
                            printable(base->second)));
    for (const char* word : {"metallic", "irid"})
      if (finish.contains(word))
        to.remark(fmt::format("{} tints the highlight by angle, and is left out", word));
  }

  static constexpr std::size_t kMostValue = 256;

  PovTokens tokens_;
  Assets assets_{kPovrayMeaning};
  std::string_view name_;  ///< that is being declared
  std::map<std::string_view, Finish> declared_;
  Finish defaults_;
  int depth_ = 0, depth_of_name_ = 0;
  bool has_directives_ = false;
};

}  // namespace

Assets read_povray_finishes(std::string_view text) { return PovReader(text).read(); }

}  // namespace lobelia::conversion
