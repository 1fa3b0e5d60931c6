// A second evaluator of formulas, for tests: Dijkstra's shunting-yard algorithm straight from the text, without a tree. It
// knows our language, and what the languages of shaders and of POV-Ray have of it.
#pragma once

#include <cctype>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace lobelia {

class Infix {
 public:
  using Names = std::map<std::string, double, std::less<>>;

  static double value(std::string_view text, const Names& names) {
    return Infix(text, names).run();
  }

  /// The value of statements "float NAME = ...;" and at last "return ...;".
  static double value_of_body(std::string_view body, Names names) {
    for (;;) {
      const std::size_t end = body.find(';');
      if (end == body.npos) throw std::runtime_error("a body without a return");
      std::string_view statement = body.substr(0, end);
      statement.remove_prefix(statement.find_first_not_of(" \n"));
      if (statement.starts_with("return ")) return value(statement.substr(7), names);
      if (!statement.starts_with("float ")) throw std::runtime_error(std::string(statement));
      statement.remove_prefix(6);
      const std::size_t equals = statement.find(" = ");
      const double assigned = value(statement.substr(equals + 3), names);
      names.emplace(statement.substr(0, equals), assigned);
      body.remove_prefix(end + 1);
    }
  }

 private:
  Infix(std::string_view text, const Names& names) : text_(text), names_(names) {}

  static int precedence(const std::string& what) {
    if (what == "+" || what == "-") return 1;
    if (what == "*" || what == "/") return 2;
    if (what == "negative") return 3;
    return what == "^" ? 4 : 0;  // a parenthesis or a function
  }

  double run() {
    bool after_value = false;
    for (std::size_t i = 0; i < text_.size();) {
      const char c = text_[i];
      if (std::isspace(static_cast<unsigned char>(c))) {
        ++i;
      } else if (std::isdigit(static_cast<unsigned char>(c)) || c == '.') {
        std::size_t length = 0;
        values_.push_back(std::stod(std::string(text_.substr(i)), &length));
        i += length, after_value = true;
      } else if (std::isalpha(static_cast<unsigned char>(c))) {
        std::size_t end = i;
        while (end < text_.size() && std::isalnum(static_cast<unsigned char>(text_[end]))) ++end;
        const std::string name(text_.substr(i, end - i));
        if (const auto known = names_.find(name); known != names_.end())
          values_.push_back(known->second), after_value = true;
        else
          waiting_.push_back(name);
        i = end;
      } else {
        ++i;
        if (c == '(') {
          waiting_.emplace_back("("), after_value = false;
        } else if (c == ')') {
          while (waiting_.back() != "(") apply();
          waiting_.pop_back();
          if (!waiting_.empty() && std::isalpha(static_cast<unsigned char>(waiting_.back()[0])) &&
              waiting_.back() != "negative")
            apply();
          after_value = true;
        } else if (c == ',') {
          while (waiting_.back() != "(") apply();
          after_value = false;
        } else if (!after_value) {
          if (c == '-') waiting_.emplace_back("negative");
        } else {
          const std::string what(1, c);
          const int here = precedence(what);
          while (!waiting_.empty() && precedence(waiting_.back()) > (what == "^" ? here : here - 1))
            apply();
          waiting_.push_back(what);
          after_value = false;
        }
      }
    }
    while (!waiting_.empty()) apply();
    return values_.at(0);
  }

  double pop() {
    const double value = values_.back();
    values_.pop_back();
    return value;
  }

  void apply() {
    const std::string what = waiting_.back();
    waiting_.pop_back();
    using Function = double (*)(double);
    static const std::map<std::string, Function> kFunctions{{"negative", [](double a) { return -a; }},
                                                            {"exp", [](double a) { return std::exp(a); }},
                                                            {"log", [](double a) { return std::log(a); }},
                                                            {"ln", [](double a) { return std::log(a); }},
                                                            {"sqrt", [](double a) { return std::sqrt(a); }},
                                                            {"abs", [](double a) { return std::abs(a); }},
                                                            {"sin", [](double a) { return std::sin(a); }},
                                                            {"cos", [](double a) { return std::cos(a); }},
                                                            {"tan", [](double a) { return std::tan(a); }},
                                                            {"asin", [](double a) { return std::asin(a); }},
                                                            {"acos", [](double a) { return std::acos(a); }},
                                                            {"atan", [](double a) { return std::atan(a); }}};
    if (const auto found = kFunctions.find(what); found != kFunctions.end()) {
      values_.push_back(found->second(pop()));
      return;
    }
    const double b = pop(), a = pop();
    values_.push_back(what == "+"                      ? a + b
                      : what == "-"                    ? a - b
                      : what == "*"                    ? a * b
                      : what == "/"                    ? a / b
                      : what == "^" || what == "pow"   ? std::pow(a, b)
                      : std::isnan(a) || std::isnan(b) ? std::nan("")
                      : what == "min"                  ? std::min(a, b)
                      : what == "max"                  ? std::max(a, b)
                                      : throw std::runtime_error("unknown '" + what + "'"));
  }

  std::string_view text_;
  const Names& names_;
  std::vector<double> values_;
  std::vector<std::string> waiting_;
};

}  // namespace lobelia
