#include "studies/shader_check/shader_call.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/system/error.hpp"
#include "base/words/text.hpp"
#include "studies/shader_check/meanings.hpp"
#include "studies/shader_check/read_shader.hpp"
#include "studies/shader_check/shader_values.hpp"

namespace lobelia::shader_check {
namespace {

using Kind = GlobalVariable::Kind;

constexpr std::string_view kSet = "--set", kArgumentsOption = "--arguments";

/// Whether `path` is `within` or a part of it.
bool is_within(std::string_view path, std::string_view within) {
  return path.starts_with(within) &&
         (path.size() == within.size() || path[within.size()] == '.' || path[within.size()] == '[');
}

class Binder {
 public:
  /// `list`: what the parameters take. `is_tried`: it is one of several.
  Binder(const Request& request, const ReadShader& shader, const FunctionDeclaration& function,
         const std::string& list, bool is_tried, Arguments& arguments)
      : request_(request),
        file_(printable_path(request.file)),
        language_(request.language),
        shader_(&shader),
        function_(function),
        reach_(reach_of(function_.name, shader_->tokens, shader_->declared, shader_->dropped)),
        arguments_(arguments),
        is_tried_(is_tried),
        call_{{language_, file_, shader_->text, {}}, function.name, list, false, {}, {}} {}

  ShaderCall made() {
    refuse_derivatives();
    call_.source.prelude = shader_->prelude;
    if (shader_->has_low_precision)
      call_.remarks.push_back("its mediump and lowp numbers were compared in highp");
    for (const auto& [path, value] : request_.settings) apply(path, value);
    for (const GlobalVariable& one : shader_->declared.globals)
      if (reach_.globals.contains(one.name)) bind_global(one);
    std::string arguments = bind_parameters();
    refuse_unset();
    initialise();
    call_.source.setup = declarations_ + statements_;
    add_result(fmt::format("{}({})", inner_name(function_.name, language_), arguments));
    call_.of_roughness = is_of_roughness(words_);
    return std::move(call_);
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const {
    throw Error(ExitCode::kUsage, "{}: {}", file_, what);
  }
  void refuse_derivatives() const {
    if (!reach_.derivative.empty())
      throw Error(
          ExitCode::kInput,
          "{}: {} calls {}, which compares neighbouring pixels; the points of a check have no "
          "neighbours",
          file_, function_.name, reach_.derivative);
  }

  void assign(const std::string& target, const std::string& value) {
    statements_ += fmt::format("    {} = {};\n", target, value);
  }
  void note(std::string_view path, std::string_view type, std::string_view value,
            std::string_view how) {
    call_.bindings.push_back(
        {printable(path), printable(type), printable(value), std::string(how)});
  }

  std::vector<std::string> add(const std::string& word, std::string_view option) {
    words_.push_back(word);
    return arguments_.add(word, option);
  }

  /// Components of "1,0.5,0", of "L" or of "L,1". Numbers are written as they are.
  std::vector<std::string> components_of(const std::string& value, std::string_view option) {
    std::vector<std::string> all;
    for (const std::string& word : split(value, ",")) {
      double number = 0;
      if (parse_number(word, number)) {
        all.push_back(number_text(number));
        continue;
      }
      const std::vector<std::string> more = add(word, option);
      all.insert(all.end(), more.begin(), more.end());
    }
    return all;
  }

  // --set

  struct Target {
    std::string text;  ///< in the program
    Declared declared;
  };

  /// The parameter or the global variable of that name.
  Target root_of(const std::string& name) const {
    for (std::size_t i = 0; i < function_.parameters.size(); ++i)
      if (function_.parameters[i].name == name)
        return {fmt::format("lobelia_a{}", i), function_.parameters[i]};
    const GlobalVariable* global = shader_->declared.find_global(name);
    if (global && global->kind == Kind::kConstant)
      refuse(fmt::format("--set {}: it is a constant", printable(name)));
    if (global && global->kind == Kind::kFixed)
      refuse(fmt::format("--set {}: {} cannot be set", printable(name), printable(global->type)));
    if (global) return {inner_name(name, language_), *global};
    std::vector<std::string_view> known;
    for (const Declared& one : function_.parameters)
      if (!one.name.empty()) known.push_back(one.name);
    for (const GlobalVariable& one : shader_->declared.globals)
      if (one.kind != Kind::kConstant && known.size() < 20) known.push_back(one.name);
    refuse(fmt::format("--set {}: there is no such variable; {}{}", printable(name),
                       known.empty() ? "there is none to set" : "it has " + join(known),
                       did_you_mean(name, known)));
  }

  /// "nrm" as "input.nrm", if that is the only member of that name in a parameter or a variable.
  std::string full_path(const std::string& path) const {
    const std::vector<std::string> parts = parts_of_path(path);
    const auto is_first = [&](const Declared& one) { return one.name == parts.front(); };
    if (parts.empty() || std::ranges::any_of(function_.parameters, is_first) ||
        std::ranges::any_of(shader_->declared.globals, is_first))
      return path;
    std::vector<std::string> found;
    const auto look_in = [&](const Declared& one) {
      const StructDeclaration* made = shader_->declared.find_struct(one.type);
      if (made && !one.name.empty() && one.dimensions.empty() &&
          std::ranges::any_of(made->members, is_first))
        found.push_back(one.name + "." + path);
    };
    for (const Declared& one : function_.parameters) look_in(one);
    for (const Declared& one : shader_->declared.globals) look_in(one);
    return found.size() == 1 ? found.front() : path;
  }

  Target target_of(const std::string& path) const {
    const std::vector<std::string> parts = parts_of_path(path);
    if (parts.empty())
      refuse(
          fmt::format("--set {}: a name is expected, as in material.shininess or lights[0].color",
                      printable(path)));
    Target target = root_of(parts.front());
    for (std::size_t k = 1; k < parts.size(); ++k) {
      target.text += parts[k].starts_with('[') ? parts[k] : "." + parts[k];
      Declared& at = target.declared;
      if (parts[k].starts_with('[')) {
        at.dimensions.erase(0, at.dimensions.find(']') + 1);
        continue;
      }
      const StructDeclaration* made = shader_->declared.find_struct(at.type);
      if (!made) {  // a component
        if (!shape_of(at.type).is_number() || k + 1 < parts.size())
          refuse(fmt::format("--set {}: a {} has no {}", printable(path), printable(at.type),
                             printable(parts[k])));
        at.type = language_ == ShaderText::kWgsl ? "f32" : "float";
        continue;
      }
      const auto member = std::ranges::find(made->members, parts[k], &Declared::name);
      if (member == made->members.end()) {
        std::vector<std::string_view> known;
        for (const Declared& one : made->members) known.push_back(one.name);
        refuse(fmt::format("--set {}: {} has no {}; it has {}", printable(path),
                           printable(made->name), printable(parts[k]), join(known)));
      }
      at = *member;
    }
    return target;
  }

  void apply(const std::string& given, const std::string& value) {
    const std::string path = full_path(given);
    const Target target = target_of(path);
    const Declared& at = target.declared;
    const bool is_texture = is_texture_type(at.type, language_);
    const std::string type = !is_texture                      ? at.type
                             : language_ == ShaderText::kGlsl ? "vec4"
                             : language_ == ShaderText::kHlsl ? "float4"
                                                              : "vec4f";
    const std::string option = fmt::format("--set {}", printable(path));
    const std::string text =
        at.dimensions.empty() ? value_text(type, components_of(value, option), language_) : "";
    if (text.empty())
      refuse(fmt::format("{}: '{}' does not fit a {}{}", option, printable(value),
                         printable(at.type), printable(at.dimensions)));
    assign(target.text + (is_texture ? ".value" : ""), text);
    note(path, at.type, value, "set");
    set_.push_back(path);
  }

  // Names that tell

  void miss(const Declared& declared, const std::string& path, const std::string& suggestion) {
    missing_.push_back(printable(fmt::format("{} {}", declared.type, path)));
    if (!suggestion.empty()) suggestions_.push_back(path + "=" + suggestion);
  }

  /// Gives a variable its value: by --set, its name, or its own value.
  void bind(const Declared& declared, const std::string& path, const std::string& target,
            int depth) {
    constexpr int kDeepest = 6, kMostLeaves = 400;
    if (++leaves_ > kMostLeaves || depth > kDeepest)
      refuse(fmt::format("{} reads more variables than can be set", function_.name));
    if (std::ranges::any_of(set_, [&](const std::string& one) { return one == path; })) return;
    const TypeShape shape = shape_of(declared.type);
    const bool is_part_set =
        std::ranges::any_of(set_, [&](const std::string& one) { return is_within(one, path); });
    if (!declared.dimensions.empty() || shape.is_number())
      if (is_part_set) return;
    const StructDeclaration* made = shader_->declared.find_struct(declared.type);
    if (made) {
      const std::string element = declared.dimensions.empty() ? "" : "[0]";
      for (const Declared& member : made->members)
        if (reach_.members.contains(member.name)) {
          const std::string inner = path + element + "." + member.name;
          if (element.empty())
            bind(member, inner, target + "." + member.name, depth + 1);
          else
            miss(member, inner, suggested_value(inner, shape_of(member.type)));
        }
      return;
    }
    if (is_texture_type(declared.type, language_)) {
      const std::string low = lower_case(declared.type);
      const bool is_state = low == "samplerstate" || low.starts_with("samplercomp") ||
                            (language_ != ShaderText::kGlsl && low == "sampler") ||
                            low == "sampler_comparison";
      if (!is_state) miss(declared, path, "1,1,1,1");
      return;
    }
    if (!declared.dimensions.empty() || !shape.is_number()) {
      const bool is_list =
          shape.is_number() && declared.dimensions.find(']') + 1 == declared.dimensions.size();
      if (declared.value.empty())
        miss(declared, path + (is_list ? "[0]" : ""), is_list ? suggested_value(path, shape) : "");
      else
        note(path, declared.type, declared.value, "own value");
      return;
    }
    const Meaning meaning = meaning_of(path, shape);
    const std::string text =
        meaning.is_told
            ? value_text(declared.type, components_of(meaning.values.front(), kSet), language_)
            : "";
    if (!text.empty()) {
      assign(target, text);
      note(path, declared.type, meaning.values.front(), "name");
    } else if (!declared.value.empty()) {
      note(path, declared.type, declared.value, "own value");
    } else {
      miss(declared, path, suggested_value(path, shape));
    }
  }

  void bind_global(const GlobalVariable& global) {
    if (global.kind == Kind::kInput || global.kind == Kind::kTexture)
      bind(global, global.name, inner_name(global.name, language_), 0);
    if (global.kind == Kind::kFixed) miss(global, global.name, "");
  }

  void refuse_unset() const {
    if (missing_.empty()) return;
    constexpr std::size_t kMost = 12;
    std::string what, how;
    for (std::size_t i = 0; i < std::min(missing_.size(), kMost); ++i)
      what += (i == 0 ? "" : ", ") + missing_[i];
    if (missing_.size() > kMost) what += fmt::format(" and {} more", missing_.size() - kMost);
    for (std::size_t i = 0; i < std::min(suggestions_.size(), kMost); ++i)
      how += " --set " + printable(shell_quote(suggestions_[i]));
    refuse(fmt::format("{} reads what nothing sets: {}; {}", function_.name, what,
                       how.empty() ? "such variables cannot be set" : "set them, as in" + how));
  }

  /// A variable of the shader itself whose first value depends on those that were just set has it now.
  void initialise() {
    if (language_ == ShaderText::kWgsl) return;
    std::set<std::string_view> changed;
    for (const GlobalVariable& one : shader_->declared.globals) {
      if (one.kind == Kind::kInput || one.kind == Kind::kTexture) changed.insert(one.name);
      if (one.kind != Kind::kPrivate || one.value.empty() || !reach_.globals.contains(one.name) ||
          one.value.starts_with('{'))
        continue;
      bool depends = false;
      for (std::size_t i = one.begin; i < one.end; ++i)
        depends = depends || changed.contains(shader_->tokens.tokens[i].text);
      if (!depends) continue;
      changed.insert(one.name);
      std::vector<TextEdit> edits;
      const std::size_t from = shader_->tokens.tokens[one.begin].at;
      for (TextEdit edit : shader_->dropped)
        if (edit.begin >= from && edit.end <= from + one.value.size()) {
          edit.begin -= from;
          edit.end -= from;
          edits.push_back(std::move(edit));
        }
      assign(one.name, edited(one.value, std::move(edits)));
    }
  }

  // Parameters

  [[noreturn]] void refuse_count(std::size_t words) const {
    std::string takes;
    for (const Declared& one : function_.parameters)
      if (takes_word(one)) takes += (takes.empty() ? "" : ", ") + declared_text(one, one.name);
    refuse(fmt::format("--arguments has {} words, but {} takes: {}", words, function_.name,
                       takes.empty() ? "nothing" : takes));
  }

  std::string bind_parameters() {
    const bool are_given = !request_.arguments.empty();
    const std::vector<std::string> words = split(call_.list, ",");
    for (const std::string& word : words) add(word, kArgumentsOption);
    std::size_t used = 0;
    std::string arguments;
    for (std::size_t i = 0; i < function_.parameters.size(); ++i) {
      Declared one = function_.parameters[i];
      const std::string local = fmt::format("lobelia_a{}", i),
                        path = one.name.empty() ? local : one.name;
      const bool is_set =
          std::ranges::any_of(set_, [&](const std::string& at) { return is_within(at, path); });
      const bool may_be_left = !one.value.empty() && !is_set;
      std::string text;
      if (takes_word(one)) {
        if (may_be_left &&
            (are_given ? used == words.size() : !meaning_of(one.name, shape_of(one.type)).is_told))
          break;
        if (used == words.size()) refuse_count(words.size());
        text = argument(one, words[used]);
        if (is_tried_ && !is_set && !meaning_of(one.name, shape_of(one.type)).is_told)
          note(path, one.type, words[used], "trial");
        ++used;
      } else if (may_be_left && one.is_in) {
        break;
      }
      if (text.empty() || is_set || one.is_out) {
        std::string type = one.type;
        // WGSL's way to give more than one result.
        const bool is_pointer = type.starts_with("ptr<function,");
        if (is_pointer) type = type.substr(13, type.size() - 14);
        declarations_ +=
            "    " + variable_text(is_texture_type(type, language_) ? "LobeliaTexture" : type,
                                   local, one.dimensions, language_);
        if (!is_set && !text.empty())
          assign(local, text);
        else if (text.empty() && one.is_in && !is_pointer && reach_.names.contains(one.name))
          bind(one, path, local, 0);
        text = (is_pointer ? "&" : "") + local;
      }
      arguments += (arguments.empty() ? "" : ", ") + text;
    }
    if (used < words.size() && are_given) refuse_count(words.size());
    return arguments;
  }

  std::string argument(const Declared& parameter, const std::string& word) {
    const std::vector<std::string> components = add(word, kArgumentsOption);
    const std::string text = value_text(parameter.type, components, language_);
    if (text.empty())
      refuse(fmt::format("--arguments: '{}' has {} components, which does not fit {}",
                         printable(word), components.size(),
                         declared_text(parameter, parameter.name)));
    return text;
  }

  // The result

  struct Output {
    std::string text, type, semantic, name, dimensions;
  };
  /// How likely it is what the shader shows; 0: it is none.
  static int rank(const Output& output) {
    const TypeShape shape = shape_of(output.type);
    if (shape.columns != 1 || (shape.rows != 1 && shape.rows != 3 && shape.rows != 4)) return 0;
    const std::string name = lower_case(output.name), semantic = lower_case(output.semantic);
    const auto has = [&](std::string_view part) { return name.find(part) != name.npos; };
    if (has("depth")) return 1;
    if (semantic == "sv_target" || semantic == "sv_target0" || semantic == "location(0)" ||
        semantic == "color" || semantic == "color0" || name == "gl_fragcolor" ||
        name == "gl_fragdata")
      return 5;
    if (has("spec") || has("highlight")) return 4;
    return has("color") || has("colour") || has("radiance") || has("result") || has("frag") ||
                   has("value") || has("light")
               ? 3
               : 2;
  }

  /// WGSL makes no vector of 3 from one of 4.
  std::string colour_of(const std::string& value, const std::string& type) const {
    return language_ == ShaderText::kWgsl && shape_of(type).rows == 4 ? value + ".xyz" : value;
  }

  void add_result(const std::string& call) {
    const bool is_void = function_.result.empty() || function_.result == "void";
    if (!is_void) {
      const StructDeclaration* made = shader_->declared.find_struct(function_.result);
      if (!made) {
        const TypeShape shape = shape_of(function_.result);
        if (shape.is_number() && (shape.columns != 1 || shape.rows == 2))
          refuse(
              fmt::format("{} gives a {}; a number, a vector of 3 or 4, or a structure with one "
                          "can be compared",
                          function_.name, function_.result));
        call_.source.calls = {colour_of(call, function_.result)};
        return;
      }
      std::vector<Output> outputs;
      for (const Declared& one : made->members)
        outputs.push_back(
            {call + "." + one.name, one.type, one.semantic, one.name, one.dimensions});
      return choose(outputs);
    }
    call_.source.setup += "    " + call + ";\n";
    std::vector<Output> outputs;
    for (std::size_t i = 0; i < function_.parameters.size(); ++i) {
      const Declared& one = function_.parameters[i];
      if (one.is_out)
        outputs.push_back(
            {fmt::format("lobelia_a{}", i), one.type, one.semantic, one.name, one.dimensions});
    }
    for (const GlobalVariable& one : shader_->declared.globals)
      if (one.kind == Kind::kOutput && reach_.globals.contains(one.name))
        outputs.push_back(
            {inner_name(one.name, language_), one.type, one.semantic, one.name, one.dimensions});
    choose(outputs);
  }

  void choose(std::vector<Output> outputs) {
    std::erase_if(outputs, [](const Output& one) { return rank(one) == 0; });
    if (outputs.empty())
      refuse(
          fmt::format("{} gives nothing that can be compared: no number, no colour, and it writes "
                      "no output",
                      function_.name));
    const Output& best = *std::ranges::max_element(outputs, {}, rank);
    call_.source.calls = {colour_of(best.text + (best.dimensions.empty() ? "" : "[0]"), best.type)};
    if (outputs.size() > 1 || best.name != "gl_FragColor")
      note(best.name, best.type, "the result", "result");
  }

  const Request& request_;
  std::string file_;
  ShaderText language_;
  const ReadShader* shader_;
  const FunctionDeclaration& function_;
  Reach reach_;
  Arguments& arguments_;
  bool is_tried_;
  ShaderCall call_;
  std::string declarations_, statements_;
  std::vector<std::string> words_, set_, missing_, suggestions_;
  int leaves_ = 0;
};

}  // namespace

ShaderCalls shader_calls(const Request& request, std::size_t most) {
  const std::string file = printable_path(request.file);
  const auto shader = read_shader({request.language, file, request.text, {}});
  const FunctionDeclaration& function =
      chosen_function(*shader, file, request.function,
                      request.arguments.empty() ? -1 : int(split(request.arguments, ",").size()));
  const std::vector<std::string> lists =
      request.arguments.empty() ? likely_arguments(function, most) : std::vector{request.arguments};
  if (lists.empty())
    throw Error(ExitCode::kUsage, "{}: {} takes too many parameters", file, function.name);
  ShaderCalls all{{}, Arguments(request.highlight, request.highlights.empty())};
  std::set<std::string> texts;
  for (const std::string& list : lists) {
    if (lists.size() > 1 && !request.highlights.empty() && depends_on_model(split(list, ",")))
      continue;
    ShaderCall call =
        Binder(request, *shader, function, list, lists.size() > 1, all.arguments).made();
    if (texts.insert(call.source.setup + call.source.calls.front()).second)
      all.calls.push_back(std::move(call));
  }
  if (all.calls.empty())
    throw Error(ExitCode::kUsage, "{}: what {} takes depends on the model; give --model", file,
                function.name);
  return all;
}

}  // namespace lobelia::shader_check
