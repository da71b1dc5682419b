#include <JavaScriptCore/JavaScript.h>
#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>

#include "script/script.hpp"
#include "script/shipped.hpp"

namespace lucerna::script {
namespace {

using Json = nlohmann::json;

// Owner of an engine string.
class JsText {
 public:
  explicit JsText(const std::string& text) : ref_(JSStringCreateWithUTF8CString(text.c_str())) {}
  explicit JsText(JSStringRef owned) : ref_(owned) {}
  ~JsText() { JSStringRelease(ref_); }
  JsText(const JsText&) = delete;
  JsText& operator=(const JsText&) = delete;
  operator JSStringRef() const { return ref_; }
  std::string text() const {
    std::string result(JSStringGetMaximumUTF8CStringSize(ref_), '\0');
    result.resize(JSStringGetUTF8CString(ref_, result.data(), result.size()) - 1);
    return result;
  }

 private:
  JSStringRef ref_;
};

std::string textOf(JSContextRef context, JSValueRef value) {
  JSStringRef copy = JSValueToStringCopy(context, value, nullptr);
  return copy ? JsText(copy).text() : "(a value without text)";
}

std::string propertyText(JSContextRef context, JSObjectRef object, const char* name) {
  const JSValueRef value = JSObjectGetProperty(context, object, JsText(name), nullptr);
  return value && !JSValueIsUndefined(context, value) ? textOf(context, value) : "";
}

// The line of the innermost stack frame in `file`: an exception thrown by the prelude's checks
// belongs to the script's call. Frames read "name@file:line:column".
std::string lineInFile(const std::string& stack, const std::string& file) {
  const std::string key = file + ":";
  const std::size_t at = stack.find(key);
  if (at == std::string::npos) return "";
  const std::size_t first = at + key.size();
  return stack.substr(first, stack.find_first_not_of("0123456789", first) - first);
}

std::string describeException(JSContextRef context, JSValueRef exception, const std::string& file) {
  if (!JSValueIsObject(context, exception))
    return fmt::format("{}: the script threw {}", file, textOf(context, exception));
  JSObjectRef object = JSValueToObject(context, exception, nullptr);
  std::string line = lineInFile(propertyText(context, object, "stack"), file);
  if (line.empty()) line = propertyText(context, object, "line");
  const std::string type = propertyText(context, object, "name");
  return fmt::format("{}:{}: {}: {}", file, line.empty() ? "0" : line,
                     type.empty() ? "Error" : type, propertyText(context, object, "message"));
}

JSValueRef printToStderr(JSContextRef context, JSObjectRef, JSObjectRef, std::size_t count,
                         const JSValueRef values[], JSValueRef*) {
  if (count > 0) std::fprintf(stderr, "%s\n", textOf(context, values[0]).c_str());
  return JSValueMakeUndefined(context);
}

// Runs the prelude, the script, then the function that the prelude left. Returns the answer's text.
std::string answerTo(const Json& request) {
  const std::string file = request.at("file");
  const auto failure = [](const std::string& message) {
    return Json{{"error", message}}.dump(-1, ' ', false, Json::error_handler_t::replace);
  };
  JSGlobalContextRef context = JSGlobalContextCreate(nullptr);
  JSValueRef exception = nullptr;

  const JsText preludeText{std::string(prelude())};
  const JsText preludeName("lucerna-prelude");
  const JSValueRef setUp =
      JSEvaluateScript(context, preludeText, nullptr, preludeName, 1, &exception);
  if (exception) return failure(describeException(context, exception, "lucerna-prelude"));

  const Json hostData{
      {"file", file}, {"seed", request.at("seed")}, {"overrides", request.at("params")}};
  JSObjectRef host = JSValueToObject(
      context, JSValueMakeFromJSONString(context, JsText(hostData.dump())), nullptr);
  const JsText printName("print");
  JSObjectSetProperty(context, host, printName,
                      JSObjectMakeFunctionWithCallback(context, printName, printToStderr),
                      kJSPropertyAttributeNone, nullptr);
  const JSValueRef hostValue = host;
  const JSValueRef finish = JSObjectCallAsFunction(
      context, JSValueToObject(context, setUp, nullptr), nullptr, 1, &hostValue, &exception);
  if (exception) return failure(describeException(context, exception, "lucerna-prelude"));
  JSValueProtect(context, finish);

  JSEvaluateScript(context, JsText(request.at("source").get<std::string>()), nullptr, JsText(file),
                   1, &exception);
  if (exception) return failure(describeException(context, exception, file));
  const JSValueRef answer = JSObjectCallAsFunction(
      context, JSValueToObject(context, finish, nullptr), nullptr, 0, nullptr, &exception);
  if (exception) return failure(describeException(context, exception, file));
  return textOf(context, answer);
}

}  // namespace

int scriptWorker() {
  // A pipeline is a page of code: the interpreter starts faster and needs less memory.
  setenv("JSC_useJIT", "0", 1);
  const std::string text{std::istreambuf_iterator<char>(std::cin), {}};
  const Json request = Json::parse(text, nullptr, false);
  if (!request.is_object() || !request.contains("source")) {
    std::fprintf(stderr,
                 "lucerna_worker script wants a request on stdin: Lucerna itself starts it\n");
    return static_cast<int>(ErrorKind::Usage);
  }
  const std::string answer = answerTo(request);
  std::fwrite(answer.data(), 1, answer.size(), stdout);
  // The engine's threads need no goodbye.
  std::fflush(nullptr);
  std::_Exit(0);
}

}  // namespace lucerna::script
