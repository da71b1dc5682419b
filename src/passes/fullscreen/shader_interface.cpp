#include "passes/fullscreen/shader_interface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <set>
#include <string_view>

namespace lucerna::passes {
namespace {

struct Token {
  std::string_view text;
  std::size_t line = 0;  // of the expanded text, from 0
};
using Tokens = std::vector<Token>;

bool isWord(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.';
}

// Splits a shader into words (names, numbers) and single marks; keeps // comments by line and drops
// the rest: blanks, other comments, directives.
class Lexer {
 public:
  explicit Lexer(std::string_view text) : rest_(text) {}

  Tokens run() {
    Tokens tokens;
    bool lineBegins = true;
    while (!rest_.empty()) {
      const char c = rest_.front();
      if (c == '\n') {
        lineBegins = true;
        skip(1);
      } else if (std::isspace(static_cast<unsigned char>(c)) != 0) {
        skip(1);
      } else if (c == '#' && lineBegins) {
        skipDirective();
      } else if (rest_.starts_with("//")) {
        takeComment();
      } else if (rest_.starts_with("/*")) {
        skip(std::min(rest_.find("*/", 2), rest_.size() - 2) + 2);
      } else {
        std::size_t length = 0;
        while (length < rest_.size() && isWord(rest_[length])) ++length;
        length = std::max<std::size_t>(length, 1);
        tokens.push_back({rest_.substr(0, length), line_});
        skip(length);
        lineBegins = false;
      }
    }
    return tokens;
  }

  std::map<std::size_t, std::string> comments;

 private:
  void skip(std::size_t count) {
    const auto skipped = rest_.substr(0, count);
    line_ += static_cast<std::size_t>(std::count(skipped.begin(), skipped.end(), '\n'));
    rest_.remove_prefix(skipped.size());
  }
  std::string_view lineHere() const { return rest_.substr(0, rest_.find('\n')); }
  void skipDirective() {
    while (lineHere().ends_with('\\') && lineHere().size() < rest_.size())
      skip(lineHere().size() + 1);
    skip(lineHere().size());
  }
  void takeComment() {
    std::string_view text = lineHere().substr(2);
    while (text.starts_with(' ')) text.remove_prefix(1);
    while (text.ends_with(' ') || text.ends_with('\r')) text.remove_suffix(1);
    comments[line_] = text;
    skip(lineHere().size());
  }

  std::string_view rest_;
  std::size_t line_ = 0;
};

// Walks over the declarations at global scope.
class Parser {
 public:
  explicit Parser(const gpu::ExpandedShader& shader) : shader_(shader), lexer_(shader.text) {}

  ShaderInterface run() {
    tokens_ = lexer_.run();
    Tokens statement;
    for (next_ = 0; next_ < tokens_.size();) {
      const Token token = tokens_[next_++];
      if (token.text == ";") {
        if (has(statement, "uniform")) readUniforms(statement);
        statement.clear();
      } else if (token.text == "{") {
        skipBraces();
        if (has(statement, "=")) continue;  // the list of an array's values
        if (has(statement, "uniform") || has(statement, "buffer"))
          result_.blocks.push_back(
              {std::string(statement.back().text), placeOf(statement.back().line)});
        statement.clear();
      } else {
        statement.push_back(token);
      }
    }
    return std::move(result_);
  }

 private:
  static bool has(const Tokens& statement, std::string_view word) {
    return std::ranges::any_of(statement, [&](const Token& token) { return token.text == word; });
  }

  void skipBraces() {
    for (int depth = 1; depth > 0 && next_ < tokens_.size(); ++next_) {
      if (tokens_[next_].text == "{") ++depth;
      if (tokens_[next_].text == "}") --depth;
    }
  }

  std::string placeOf(std::size_t line) const {
    const gpu::ExpandedShader::Place place =
        shader_.lines[std::min(line, shader_.lines.size() - 1)];
    if (place.file < 0) return "(defines)";
    return fmt::format("{}:{}", shader_.files[static_cast<std::size_t>(place.file)], place.line);
  }

  // Index behind the bracket that closes the one at `open`.
  static std::size_t behind(const Tokens& tokens, std::size_t open) {
    int depth = 0;
    for (std::size_t i = open; i < tokens.size(); ++i) {
      const std::string_view text = tokens[i].text;
      if (text == "(" || text == "[") ++depth;
      if ((text == ")" || text == "]") && --depth == 0) return i + 1;
    }
    return tokens.size();
  }

  // "layout(...) uniform highp TYPE NAME [n] = VALUE, NAME ..."
  void readUniforms(const Tokens& tokens) {
    static const std::set<std::string_view> kQualifiers{
        "uniform",  "layout",    "highp",    "mediump",  "lowp",   "coherent",
        "readonly", "writeonly", "restrict", "volatile", "precise"};
    std::size_t i = 0;
    while (i < tokens.size() && kQualifiers.contains(tokens[i].text))
      i = i + 1 < tokens.size() && tokens[i + 1].text == "(" ? behind(tokens, i + 1) : i + 1;
    if (i >= tokens.size()) return;
    ShaderInterface::Uniform uniform{.type = std::string(tokens[i++].text), .name = {}};
    bool arrayType = false;
    if (i < tokens.size() && tokens[i].text == "[") {
      arrayType = true;
      i = behind(tokens, i);
    }
    while (i < tokens.size()) {
      uniform.name = tokens[i].text;
      uniform.place = placeOf(tokens[i].line);
      uniform.isArray = arrayType;
      const std::size_t line = tokens[i++].line;
      uniform.initial.clear();
      int depth = 0;
      bool value = false;
      for (; i < tokens.size() && (tokens[i].text != "," || depth > 0); ++i) {
        const std::string_view text = tokens[i].text;
        if (text == "(" || text == "[") ++depth;
        if (text == ")" || text == "]") --depth;
        if (text == "[" && !value) uniform.isArray = true;
        if (value) uniform.initial += text;
        value = value || text == "=";
      }
      ++i;  // the comma
      const auto comment = lexer_.comments.find(line);
      uniform.comment = comment == lexer_.comments.end() ? "" : comment->second;
      result_.uniforms.push_back(uniform);
    }
  }

  const gpu::ExpandedShader& shader_;
  Lexer lexer_;
  Tokens tokens_;
  std::size_t next_ = 0;
  ShaderInterface result_;
};

}  // namespace

ShaderInterface readInterface(const gpu::ExpandedShader& shader) {
  return Parser(shader).run();
}

}  // namespace lucerna::passes
