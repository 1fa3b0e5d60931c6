// A shader's text before a compiler sees it, and what a compiler says of it afterwards.
#include "studies/shader_check/program_text.hpp"

#include "base/system/error.hpp"
#include "studies/shader_check/declarations.hpp"
#include "tests/program/run_lobelia.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

constexpr char kMark[] = "\xef\xbb\xbf";

ShaderProgram program_of(const std::string& text, ShaderText language = ShaderText::kGlsl) {
  const ShaderApi api = language == ShaderText::kGlsl   ? ShaderApi::kEgl
                        : language == ShaderText::kHlsl ? ShaderApi::kVulkan
                                                        : ShaderApi::kWebGpu;
  return program_text({language, "mine", text, {"0.0"}}, api, 1, 1);
}

/// Why the text is bad input; "" if it is not.
std::string refusal(const std::string& text, ShaderText language = ShaderText::kGlsl) {
  try {
    program_of(text, language);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kInput);
    return error.what();
  }
  return "";
}

TEST(PlainText, EveryWayToWriteAnIncludeIsRefusedByItsLine) {
  const std::pair<std::string, int> ways[] = {
      {"#include \"../pipe\"\nfloat x;\n", 1},
      {"float x;\n  #\tinclude <a.h>\n", 2},
      {"float x;\r#include \"a\"", 2},
      {"float x;\r\n\r\n#include \"a\"\r\n", 3},
      {"/* a\n b */ #include \"a\"\n", 2},
      {"#/* a\n */include \"a\"\n", 1},
      {"#in\\\nclude \"a\"\n", 1},
      {"\n#\\\r\ninclude \"a\"\n", 2},
      {"/\\\n* a */ #include \"a\"\n", 1},
      {"// a \\\n b\n#include \"a\"\n", 3},
      {"#if 0\n#include \"a\"\n#endif\n", 2},
      {std::string(kMark) + "#include \"a\"\n", 1},
  };
  for (const ShaderText language : {ShaderText::kGlsl, ShaderText::kHlsl})
    for (const auto& [text, line] : ways)
      EXPECT_THAT(refusal(text, language),
                  HasSubstr("mine:" + std::to_string(line) + ": #include is not allowed"))
          << text;
}

TEST(PlainText, RefusesOnlyIncludes) {
  for (const char* text :
       {"// #include \"a\"\n", "/* #include \"a\"\n#include \"b\" */\n", "#define include 1\n",
        "float include;\n", "// a \\\n#include \"a\"\n", "#define included\n#define f(x) #x\n"}) {
    EXPECT_EQ(refusal(text, ShaderText::kHlsl), "") << text;
    EXPECT_THAT(program_of(text, ShaderText::kHlsl).bytes, Not(HasSubstr("#include"))) << text;
  }
}

TEST(PlainText, AStringOfHlslHasNoComments) {
  const auto text = [](const std::string& line, ShaderText language = ShaderText::kHlsl) {
    return plain_text({language, "mine", line + "\n", {}});
  };
  EXPECT_EQ(text("a(\"//b\"); // c"), "a(\"//b\");  \n");
  EXPECT_EQ(text("#define S \"/* x */\" /* y */"), "#define S \"/* x */\"  \n");
  EXPECT_EQ(text("'\"' // c"), "'\"'  \n");
  EXPECT_EQ(text("\"a\\\" // c"), "\"a\\\"  \n") << "glslang knows no escapes";
  EXPECT_EQ(text("\"open // c\n/* d */"), "\"open // c\n \n") << "none goes beyond its line";
  EXPECT_EQ(text("\"// c", ShaderText::kGlsl), "\" \n");
  // Whether or not a compiler sees a string here, it finds no directive behind it.
  EXPECT_THAT(refusal("string s = \"/*\";\n#include \"a\"\n/* */\n", ShaderText::kHlsl),
              HasSubstr("mine:2: #include is not allowed"));
  EXPECT_THAT(refusal("x \"/*\n*/ #include \"a\"\n", ShaderText::kHlsl),
              HasSubstr("mine:2: #include is not allowed"));
}

TEST(PlainText, EveryLineBreakOfWgslEndsAComment) {
  for (const std::string end :
       {"\n", "\v", "\f", "\r", "\r\n", "\xc2\x85", "\xe2\x80\xa8", "\xe2\x80\xa9"}) {
    const auto has_function = [&](ShaderText language, const char* function) {
      const std::string plain = plain_text({language, "mine", "// a" + end + function, {}});
      return !declarations_of(tokens_of(plain, language), plain, language).functions.empty();
    };
    EXPECT_TRUE(has_function(ShaderText::kWgsl, "fn f() { }"));
    // In GLSL only LF and CR end a line.
    EXPECT_EQ(has_function(ShaderText::kGlsl, "float f() { }"),
              end.find_first_of("\r\n") != end.npos);
  }
  EXPECT_EQ(plain_text({ShaderText::kWgsl, "mine", "// a\xc2\xa0 fn f() { }", {}}), " ");
}

TEST(PlainText, LinesKeepTheirNumbersAndMacrosTheirLines) {
  const ShaderProgram program = program_of(
      "/* a\n b */ int c;\r\n#define A 1 /* x\n y */ + \\\n 2\n// z \\\n z\nint m = A;\n");
  const std::size_t place = program.bytes.find("int m = A;");
  ASSERT_NE(place, std::string::npos);
  const auto line =
      1 + std::count(program.bytes.begin(), program.bytes.begin() + std::ptrdiff_t(place), '\n');
  EXPECT_EQ(std::size_t(line) - program.first_line, 8u);
  EXPECT_THAT(program.bytes, HasSubstr("#define A 1   +  2\n"));
}

TEST(PlainText, AByteOrderMarkIsNoPartOfTheShader) {
  for (const ShaderText language : {ShaderText::kGlsl, ShaderText::kHlsl, ShaderText::kWgsl}) {
    const std::string text = "const float a = 1.0;\n";
    EXPECT_EQ(program_of(kMark + text, language).bytes, program_of(text, language).bytes);
  }
  EXPECT_THAT(program_of(std::string(kMark) + "#version 400\n").bytes,
              testing::StartsWith("#version 400\n"));
}

TEST(PlainText, UnreadableTextIsRefusedInOneLine) {
  EXPECT_EQ(refusal(std::string("\xff\xfe"
                                "f\0",
                                4)),
            "mine: it has zero bytes, as UTF-16 has; save it as UTF-8");
  EXPECT_EQ(refusal("float x;\n/* a\n"), "mine:2: this comment does not end");
  EXPECT_EQ(refusal("/* a /* b */ */\n/* /* */\n", ShaderText::kWgsl),
            "mine:2: this comment does not end");
}

TEST(CompilerMessage, AVersionThatTheDriverLacksIsNamedByItsLine) {
  ShaderProgram program = program_of("// mine\n#version 460 core\nfloat x;\n");
  const auto words = [&](const std::string& log) -> std::string {
    return refusal(log, program).what();
  };
  EXPECT_EQ(words("0:1(10): error: GLSL 4.60 is not supported. Supported versions "
                  "are: 4.50, and 3.20 ES\n"),
            "mine:2: GLSL 4.60 is not supported. Supported versions are: 4.50, and 3.20 ES");
  EXPECT_EQ(words("0:4(1): error: no\n"), "mine:3: no");
  EXPECT_THAT(words("0:90(1): error: no\n"), HasSubstr("the call of"));
}

TEST(CheckShaderCommandWithoutADriver, AMillionBytesOfOpenCallsAreReadInOnePass) {
  const TemporaryDirectory directory;
  std::string text;
  for (int i = 0; i < 200'000; ++i) text += "a a(\n";
  write_file(directory.path() / "mine.glsl", text);
  // Seconds of a processor, of which it takes a tenth; with a pass for each call it takes hundreds.
  expect_one_line(
      run_shell("ulimit -t 30\n\"$LOBELIA\" check-shader mine.glsl --function f --model "
                "phong_rdf",
                directory.path()),
      3, "mine.glsl:200000: syntax error: '(' is never closed");
}

TEST(CheckShaderCommandWithoutADriver, AnIncludedPipeIsNotOpened) {
  const TemporaryDirectory directory;
  write_file(directory.path() / "mine.hlsl", "#include \"pipe\"\nfloat f(float n) { return n; }\n");
  expect_one_line(run_shell("mkfifo pipe && \"$LOBELIA\" check-shader mine.hlsl --function f "
                            "--arguments n --model phong_rdf",
                            directory.path()),
                  3, "mine.hlsl:1: #include is not allowed");
}

}  // namespace
}  // namespace lobelia
