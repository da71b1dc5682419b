#include "core/json.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/text.hpp"

namespace lucerna {
namespace {

using Library = nlohmann::json;

// Walks through the text and leaves in `reached` how far the parser has come.
class Tracked {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  Tracked(const char* at, const char*& reached) : at_(at), reached_(&reached) {}
  reference operator*() const { return *at_; }
  Tracked& operator++() {
    *reached_ = ++at_;
    return *this;
  }
  bool operator==(const Tracked& other) const { return at_ == other.at_; }
  bool operator!=(const Tracked& other) const { return at_ != other.at_; }

 private:
  const char* at_;
  const char** reached_;
};

// The number or name that the byte at `at` belongs to; one that is neither by itself.
std::string_view wordAt(std::string_view text, std::size_t at) {
  const auto inWord = [&](std::size_t i) {
    const auto c = static_cast<unsigned char>(text[i]);
    return std::isalnum(c) || c == '_' || c == '.' || c == '+' || c == '-';
  };
  if (at >= text.size()) return {};
  if (!inWord(at)) return text.substr(at, 1);
  std::size_t first = at, end = at + 1;
  while (first > 0 && inWord(first - 1)) --first;
  while (end < text.size() && inWord(end)) ++end;
  return text.substr(first, end - first);
}

bool isNoFiniteNumber(std::string_view word) {
  const std::string_view name = word.substr(word.starts_with('-') || word.starts_with('+') ? 1 : 0);
  return equalIgnoringCase(name, "nan") || equalIgnoringCase(name, "inf") ||
         equalIgnoringCase(name, "infinity");
}

bool isBeyondAscii(std::string_view word) {
  return !word.empty() && static_cast<unsigned char>(word[0]) >= 0x80;
}

// "[json.exception.parse_error.101] parse error at line 1, column 2: syntax error while parsing
// value - unexpected '}'; expected ...; last read: '}'": the part that says what is wrong.
std::string complaintOf(std::string_view what) {
  if (const auto start = what.find(" - "); start != what.npos)
    what.remove_prefix(start + 3);
  else if (const auto colon = what.find(": "); colon != what.npos)
    what.remove_prefix(colon + 2);
  return std::string(what.substr(0, what.find("; last read")));
}

// Takes the parser's events and builds the values.
class Builder final : public nlohmann::json_sax<Library> {
 public:
  explicit Builder(std::string_view text) : text_(text), counted_(text.data()) {}

  ParsedJson take() { return std::move(result_); }
  const char*& reached() { return reached_; }
  // Where the parser stopped and why; none if it came to the end.
  const std::optional<std::string>& complaint() const { return complaint_; }
  std::size_t stoppedAt() const { return at_; }

  bool null() override { return add(nullptr); }
  bool boolean(bool value) override { return add(value); }
  bool number_integer(number_integer_t value) override { return add(std::int64_t{value}); }
  bool number_unsigned(number_unsigned_t value) override {
    if (value > INT64_MAX) return add(static_cast<double>(value));
    return add(static_cast<std::int64_t>(value));
  }
  bool number_float(number_float_t value, const string_t&) override { return add(value); }
  bool string(string_t& value) override { return add(std::move(value)); }
  bool binary(binary_t&) override { return false; }  // not in texts
  bool start_object(std::size_t) override { return open(JsonNode::Members{}); }
  bool start_array(std::size_t) override { return open(JsonNode::List{}); }
  bool end_array() override { return close(); }
  bool end_object() override {
    findDuplicates(std::get<JsonNode::Members>(open_.back()->value));
    return close();
  }
  bool key(string_t& key) override {
    std::get<JsonNode::Members>(open_.back()->value).push_back({std::move(key), {}});
    return true;
  }
  bool parse_error(std::size_t, const std::string& token,
                   const nlohmann::detail::exception& fault) override {
    constexpr int kNumberOverflow = 406;
    at_ = reached_ > text_.data() ? static_cast<std::size_t>(reached_ - text_.data()) - 1 : 0;
    const std::string_view word = wordAt(text_, at_);
    if (fault.id == kNumberOverflow)
      return stop(fmt::format("found the number {}, wanted at most 1.7e308", token));
    if (isNoFiniteNumber(word))
      return stop(fmt::format("found {}, wanted a finite number; JSON has no others", word));
    const std::string complaint = complaintOf(fault.what());
    const bool strayWord = complaint == "invalid literal";
    if (complaint.find("UTF-8") != std::string::npos || (strayWord && isBeyondAscii(word)))
      return stopAtForeignByte();
    if (strayWord) return stop(fmt::format("is no JSON: found {}; texts need double quotes", word));
    return stop("is no JSON: " + complaint);
  }

 private:
  bool stop(std::string complaint) {
    complaint_ = std::move(complaint);
    return false;
  }

  // The parser may have noticed only by what comes after it.
  bool stopAtForeignByte() {
    while (at_ > 0 && !isBeyondAscii(text_.substr(at_, 1))) --at_;
    return stop(
        fmt::format("found the byte 0x{:02X}, wanted UTF-8; the file is damaged there, or has to "
                    "be saved as UTF-8",
                    static_cast<unsigned char>(text_[at_])));
  }

  // Of what was read last. A number ends one byte before what was reached.
  int line() {
    const char* last = std::max(counted_, reached_ - 1);
    line_ += static_cast<int>(std::count(counted_, last, '\n'));
    counted_ = last;
    return line_;
  }

  JsonNode* put(JsonNode node) {
    if (open_.empty()) return &(result_.root = std::move(node));
    if (auto* list = std::get_if<JsonNode::List>(&open_.back()->value))
      return &list->emplace_back(std::move(node));
    return &(std::get<JsonNode::Members>(open_.back()->value).back().value = std::move(node));
  }

  template <typename T>
  bool add(T value) {
    at_ = static_cast<std::size_t>(reached_ - text_.data()) - 1;
    if (++count_ > kMaxJsonValues)
      return stop(fmt::format("found more than {} values, wanted fewer", kMaxJsonValues));
    JsonNode node;
    node.value = std::move(value);
    node.line = line();
    last_ = put(std::move(node));
    return true;
  }

  template <typename T>
  bool open(T container) {
    if (!add(std::move(container))) return false;
    if (open_.size() == static_cast<std::size_t>(kMaxJsonDepth))
      return stop(
          fmt::format("found more than {} lists and objects inside one another, wanted "
                      "fewer",
                      kMaxJsonDepth));
    // Stays where it is: what is around it gets nothing new before it is closed.
    open_.push_back(last_);
    return true;
  }

  bool close() {
    open_.pop_back();
    return true;
  }

  void findDuplicates(const JsonNode::Members& members) {
    std::vector<const JsonMember*> sorted;
    sorted.reserve(members.size());
    for (const JsonMember& member : members) sorted.push_back(&member);
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const auto* a, const auto* b) { return a->key < b->key; });
    for (std::size_t i = 1; i < sorted.size(); ++i)
      if (sorted[i]->key == sorted[i - 1]->key)
        result_.duplicates.push_back({sorted[i]->key, sorted[i]->value.line});
  }

  std::string_view text_;
  const char* counted_;  // lines up to here are in line_
  const char* reached_ = text_.data();
  int line_ = 1;
  std::size_t count_ = 0, at_ = 0;
  std::vector<JsonNode*> open_;  // lists and objects that have not ended, outermost first
  JsonNode* last_ = nullptr;
  std::optional<std::string> complaint_;
  ParsedJson result_;
};

std::string placeOf(std::string_view text, std::size_t at, const std::string& file) {
  const std::string_view before = text.substr(0, std::min(at, text.size()));
  const std::size_t lineStart = before.find_last_of('\n') + 1;  // 0 if there is none
  return fmt::format("{}:{}:{}", file, 1 + std::count(before.begin(), before.end(), '\n'),
                     before.size() - lineStart + 1);
}

}  // namespace

const JsonNode* JsonNode::find(std::string_view key) const {
  if (const auto* members = as<Members>())
    for (const JsonMember& member : *members)
      if (member.key == key) return &member.value;
  return nullptr;
}

Result<ParsedJson> parseJson(std::string_view text, const std::string& file, ErrorKind kind) {
  if (text.find_first_not_of(" \t\r\n") == text.npos)
    return error(kind, "{}: is empty, wanted a JSON object", file);
  Builder builder(text);
  const char* const first = text.data();
  const Tracked begin(first, builder.reached()), end(first + text.size(), builder.reached());
  if (!Library::sax_parse(begin, end, &builder, Library::input_format_t::json, /*strict=*/true,
                          /*ignore_comments=*/true))
    return error(kind, "{}: {}", placeOf(text, builder.stoppedAt(), file),
                 builder.complaint().value_or("is no JSON"));
  return builder.take();
}

}  // namespace lucerna
