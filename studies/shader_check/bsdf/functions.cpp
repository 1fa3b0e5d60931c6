#include "studies/shader_check/bsdf/functions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

#include "base/system/error.hpp"
#include "base/words/text.hpp"

namespace lobelia::shader_check::bsdf {
namespace {

int components_of(std::string_view type) {
  for (const std::string_view word : {"float", "half", "min16float"})
    if (type.starts_with(word)) {
      const std::string_view rest = type.substr(word.size());
      if (rest.empty()) return 1;
      return rest.size() == 1 && rest[0] >= '1' && rest[0] <= '4' ? rest[0] - '0' : 0;
    }
  if (type.size() == 4 && type.starts_with("vec") && type[3] >= '2' && type[3] <= '4')
    return type[3] - '0';
  return 0;
}

bool has_one_of(std::string_view word, std::initializer_list<std::string_view> parts) {
  return std::ranges::any_of(parts,
                             [&](std::string_view part) { return word.find(part) != word.npos; });
}

BsdfValue value_of(const Declared& declared, bool is_out) {
  return {BsdfRole::kUnused, declared.type, declared.name,
          declared.dimensions.empty() ? components_of(declared.type) : 0, is_out};
}

/// The functions with a body, with parameters that have no role yet.
std::vector<BsdfFunction> functions_of(const Declarations& declared) {
  std::vector<BsdfFunction> functions;
  for (const FunctionDeclaration& one : declared.functions) {
    if (!one.has_body) continue;
    BsdfFunction& function = functions.emplace_back();
    function.name = one.name;
    function.result.type = one.result;
    function.result.components = components_of(one.result);
    for (const Declared& parameter : one.parameters)
      if (parameter.type != "void")
        function.parameters.push_back(value_of(parameter, parameter.is_out));
    if (const StructDeclaration* result = declared.find_struct(one.result))
      for (const Declared& member : result->members)
        function.members.push_back(value_of(member, true));
  }
  return functions;
}

std::string with_room(const ShaderSource& source, std::string_view words) {
  return fmt::format("{}: {}", source.name, words);
}

/// "mySample(V,u1)" is a name and a list.
struct Asked {
  std::string name;
  std::optional<std::vector<std::string>> list = {};
};
Asked asked_of(const std::string& option, const std::string& given) {
  const std::size_t open = given.find('(');
  if (open == given.npos) return {given};
  if (open == 0 || given.back() != ')')
    throw Error(ExitCode::kUsage, "{} '{}': NAME or NAME(LIST) is expected", option,
                printable(given));
  Asked asked{given.substr(0, open), std::vector<std::string>{}};
  const std::string inside = given.substr(open + 1, given.size() - open - 2);
  if (!inside.empty()) asked.list = split(inside, ",");
  return asked;
}

BsdfFunction found_function(const ShaderSource& source, const std::vector<BsdfFunction>& functions,
                            const std::string& option, const std::string& name) {
  const std::string part = option.substr(2);
  std::vector<std::string_view> all, fitting;
  const BsdfFunction* found = nullptr;
  for (const BsdfFunction& function : functions) {
    all.push_back(function.name);
    const std::string lower = lower_case(function.name);
    if (name.empty() ? has_one_of(lower, {part}) : function.name == name) {
      if (!found || found->name != function.name) fitting.push_back(function.name);
      if (!found || lower == part) found = &function;
    }
  }
  const bool is_clear = found && (fitting.size() == 1 || lower_case(found->name) == part);
  if (is_clear) return *found;
  if (!name.empty())
    throw Error(ExitCode::kInput, "{}{}",
                with_room(source, fmt::format("has no function '{}' that can be called; it has {}",
                                              printable(name), join(all))),
                did_you_mean(name, all));
  throw Error(
      ExitCode::kUsage, "{}; type {} NAME",
      with_room(source,
                found ? fmt::format("several functions may be {}: {}", part, join(fitting))
                      : fmt::format("no function has {} in its name; it has {}", part, join(all))),
      option);
}

/// Sets the role by a word of a list, such as "u1".
bool set_by_word(BsdfValue& value, const std::string& word) {
  static const std::map<std::string_view, BsdfRole> roles{
      {"N", BsdfRole::kNormal},   {"V", BsdfRole::kEye},       {"L", BsdfRole::kLight},
      {"n", BsdfRole::kExponent}, {"alpha", BsdfRole::kAlpha}, {"roughness", BsdfRole::kRoughness},
      {"u", BsdfRole::kRandom},   {"u1", BsdfRole::kRandom},   {"u2", BsdfRole::kRandom},
      {"u3", BsdfRole::kRandom}};
  if (parse_number(word, value.number)) {
    value.role = BsdfRole::kNumber;
    return true;
  }
  const auto found = roles.find(word);
  if (found == roles.end()) return false;
  value.role = found->second;
  if (word.size() == 2 && word[0] == 'u') value.first_random = word[1] - '1';
  return true;
}

/// By type and name; `sample_eye` is the name of the eye where sample() says it.
void set_by_name(BsdfValue& value, std::string_view sample_eye, int& randoms) {
  const std::string name = lower_case(value.name);
  const auto set = [&](BsdfRole role, double number = 0) {
    value.role = role;
    value.number = number;
  };
  if (has_one_of(name, {"u1", "u2", "u3", "rand", "xi", "rnd", "r1", "r2"}) ||
      is_one_of(name, {"u", "u0", "uv", "ra", "rb", "sample2"})) {
    set(BsdfRole::kRandom);
    value.first_random = randoms;
    randoms += value.components;
  } else if (value.components == 3) {
    if (is_one_of(name, {"n", "ns", "ng", "normal", "nrm", "norm"}))
      set(BsdfRole::kNormal);
    else if (has_one_of(name, {"color", "colour", "albedo", "f0", "spec", "tint", "ks", "kd"}))
      set(BsdfRole::kNumber, 1);
    else if (!sample_eye.empty())
      set(value.name == sample_eye ? BsdfRole::kEye : BsdfRole::kLight);
    else if (is_one_of(name, {"l", "wi", "light", "lightdir", "tolight", "to_light", "incoming"}))
      set(BsdfRole::kLight);
    else
      set(BsdfRole::kEye);
  } else if (value.components == 1) {
    if (has_one_of(name, {"rough"}))
      set(BsdfRole::kRoughness);
    else if (has_one_of(name, {"alpha"}) || is_one_of(name, {"a", "ax", "ay"}))
      set(BsdfRole::kAlpha);
    else if (has_one_of(name, {"exp", "shin", "pow", "gloss"}) || is_one_of(name, {"n", "e", "s"}))
      set(BsdfRole::kExponent);
    else if (has_one_of(name, {"metal", "f0", "ks", "albedo", "color", "weight"}))
      set(BsdfRole::kNumber, 1);
    else if (has_one_of(name, {"aniso"}))
      set(BsdfRole::kNumber, 0);
    else if (is_one_of(name, {"ior", "eta"}))
      set(BsdfRole::kNumber, 1.5);
  }
}

/// Sets the role of an out parameter or of a result's member.
void set_out(BsdfValue& value, bool of_sample) {
  const std::string name = lower_case(value.name);
  if (value.type == "bool") {
    value.role = BsdfRole::kValid;
  } else if (value.components == 1) {
    value.role = has_one_of(name, {"pdf", "density", "prob"}) ? BsdfRole::kPdf
                 : of_sample && has_one_of(name, {"weight", "throughput", "atten", "beta"})
                     ? BsdfRole::kWeight
                     : BsdfRole::kUnused;
  } else if (value.components >= 3) {
    value.role = !of_sample ? (has_one_of(name, {"pdf"}) ? BsdfRole::kUnused : BsdfRole::kEval)
                 : has_one_of(name, {"weight", "throughput", "atten", "beta"})   ? BsdfRole::kWeight
                 : is_one_of(name, {"f", "fr", "value", "eval", "brdf", "bsdf"}) ? BsdfRole::kEval
                 : is_one_of(name, {"h", "wh", "m", "wm", "half"})               ? BsdfRole::kUnused
                                                                   : BsdfRole::kDirection;
  }
}

void set_inputs(const ShaderSource& source, const std::string& option, BsdfFunction& function,
                const Asked& asked, std::string_view sample_eye) {
  int randoms = 0;
  std::size_t at = 0;
  for (BsdfValue& value : function.parameters) {
    if (value.is_out) continue;
    if (asked.list) {
      const std::string word = at < asked.list->size() ? (*asked.list)[at] : "";
      ++at;
      if (!set_by_word(value, word))
        throw Error(ExitCode::kUsage,
                    "{}: '{}' for the parameter {} of {}; allowed: N, V, L, u, u1, u2, u3, n, "
                    "alpha, roughness and numbers, one for each that is not out",
                    option, printable(word), printable(value.name), printable(function.name));
    } else {
      set_by_name(value, sample_eye, randoms);
    }
    const bool is_vector = value.role == BsdfRole::kNormal || value.role == BsdfRole::kEye ||
                           value.role == BsdfRole::kLight;
    const bool is_number = value.role == BsdfRole::kExponent || value.role == BsdfRole::kAlpha ||
                           value.role == BsdfRole::kRoughness;
    if (value.role == BsdfRole::kUnused || value.components == 0 ||
        (is_vector && value.components != 3) || (is_number && value.components != 1) ||
        (value.role == BsdfRole::kRandom && value.first_random + value.components > 3))
      throw Error(
          ExitCode::kUsage,
          "{}: {} takes '{} {}', which is not known to be one of N, V, L, random numbers, an "
          "exponent or a roughness; type {} '{}(LIST)' with a word or a number for each",
          source.name, printable(function.name), printable(value.type), printable(value.name),
          option, printable(function.name));
  }
  if (asked.list && asked.list->size() > at)
    throw Error(ExitCode::kUsage, "{}: {} takes {} values", option, printable(function.name), at);
}

bool gives(const BsdfFunction& function, BsdfRole role) {
  const auto is_it = [&](const BsdfValue& value) { return value.role == role && value.is_out; };
  return function.result.role == role || std::ranges::any_of(function.parameters, is_it) ||
         std::ranges::any_of(function.members, is_it);
}

void set_outputs(BsdfFunction& function, bool of_sample) {
  for (BsdfValue& value : function.parameters)
    if (value.is_out) set_out(value, of_sample);
  for (BsdfValue& value : function.members) set_out(value, of_sample);
  BsdfValue& result = function.result;
  if (result.type == "bool") result.role = BsdfRole::kValid;
  if (result.components == 0) return;
  if (!of_sample)
    result.role = BsdfRole::kEval;
  else if (!gives(function, BsdfRole::kDirection))
    result.role = result.components >= 3 ? BsdfRole::kDirection : BsdfRole::kUnused;
  else if (!gives(function, BsdfRole::kWeight) && result.components != 2)
    result.role = BsdfRole::kWeight;
}

}  // namespace

bool BsdfFunction::takes(BsdfRole role) const {
  return std::ranges::any_of(
      parameters, [&](const BsdfValue& value) { return value.role == role && !value.is_out; });
}

std::string BsdfFunction::words() const {
  constexpr std::string_view kWords[] = {"N", "V", "L", "u", "n", "alpha", "roughness"};
  std::string text;
  for (const BsdfValue& value : parameters) {
    if (value.is_out) continue;
    text += text.empty() ? "" : ",";
    if (value.role == BsdfRole::kNumber)
      text += fmt::format("{:g}", value.number);
    else
      text += kWords[std::size_t(value.role)];
    if (value.role == BsdfRole::kRandom && value.components == 1)
      text += std::to_string(value.first_random + 1);
  }
  return fmt::format("{}({})", name, text);
}

BsdfFunctions bsdf_functions(const ShaderSource& source, const Declarations& declared,
                             const std::string& eval, const std::string& sample,
                             const std::string& pdf) {
  const std::vector<BsdfFunction> functions = functions_of(declared);
  BsdfFunctions found;
  const Asked asked_sample = asked_of("--sample", sample), asked_eval = asked_of("--eval", eval),
              asked_pdf = asked_of("--pdf", pdf);
  found.sample = found_function(source, functions, "--sample", asked_sample.name);
  set_outputs(found.sample, true);
  set_inputs(source, "--sample", found.sample, asked_sample, "");
  std::string eye;
  for (BsdfValue& value : found.sample.parameters)
    if (!value.is_out && (value.role == BsdfRole::kEye || value.role == BsdfRole::kLight)) {
      // The one direction that sample() takes is the eye's, by whatever name: "wi" in Mitsuba, "wo" in pbrt.
      value.role = BsdfRole::kEye;
      eye = value.name;
    }
  if (eye.empty() || !gives(found.sample, BsdfRole::kDirection) ||
      !found.sample.takes(BsdfRole::kRandom))
    throw Error(
        ExitCode::kUsage,
        "{}: {} is no sample(): it takes the direction to the eye and random numbers, and gives "
        "a direction",
        source.name, printable(found.sample.name));
  const auto set = [&](const std::string& option, BsdfFunction& function, const Asked& asked) {
    set_outputs(function, false);
    const bool has_eye = std::ranges::any_of(
        function.parameters, [&](const BsdfValue& value) { return value.name == eye; });
    set_inputs(source, option, function, asked, has_eye ? std::string_view(eye) : "");
    if (!function.takes(BsdfRole::kLight))
      throw Error(ExitCode::kUsage,
                  "{}: which parameter of {} is the light's direction? Type {} '{}(LIST)'",
                  source.name, printable(function.name), option, printable(function.name));
  };
  found.eval = found_function(source, functions, "--eval", asked_eval.name);
  set("--eval", found.eval, asked_eval);
  if (pdf.empty() && gives(found.eval, BsdfRole::kPdf)) {
    found.pdf = found.eval;
    found.pdf_is_of_eval = true;
    return found;
  }
  found.pdf = found_function(source, functions, "--pdf", asked_pdf.name);
  set("--pdf", found.pdf, asked_pdf);
  if (found.pdf.result.components != 1)
    throw Error(ExitCode::kUsage, "{}: {} is no pdf: it gives {}, not a number", source.name,
                printable(found.pdf.name), printable(found.pdf.result.type));
  return found;
}

}  // namespace lobelia::shader_check::bsdf
