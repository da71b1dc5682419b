#include "image/exr_header.hpp"

#include <algorithm>

namespace lucerna::codec {
namespace {

constexpr std::size_t kMaxNameBytes = 255;
constexpr std::uint32_t kUnsupportedFlags = 0x800;  // deep data
constexpr std::uint32_t kTiledFlag = 0x200;
constexpr std::uint32_t kPartsFlag = 0x1000;  // several headers, then an empty one

// Types whose values OpenEXR reads whatever size the file declares for them; its reading would part
// from ours if that were another.
struct FixedSize {
  std::string_view type;
  std::size_t bytes;
};
constexpr FixedSize kFixedSizes[] = {{"box2i", 16},      {"box2f", 16},   {"chromaticities", 32},
                                     {"compression", 1}, {"double", 8},   {"envmap", 1},
                                     {"float", 4},       {"int", 4},      {"keycode", 28},
                                     {"lineOrder", 1},   {"m33f", 36},    {"m33d", 72},
                                     {"m44f", 64},       {"m44d", 128},   {"rational", 8},
                                     {"tiledesc", 9},    {"timecode", 8}, {"v2i", 8},
                                     {"v2f", 8},         {"v2d", 16},     {"v3i", 12},
                                     {"v3f", 12},        {"v3d", 24},     {"deepImageState", 1}};

bool sizeFits(std::string_view type, std::size_t bytes) {
  const auto* fixed = std::ranges::find(kFixedSizes, type, &FixedSize::type);
  return fixed == std::end(kFixedSizes) || fixed->bytes == bytes;
}

// Reads forward; `failed` once anything lies beyond the end.
class Cursor {
 public:
  explicit Cursor(ByteView bytes) : bytes_(bytes) {}
  bool failed() const { return failed_; }
  bool atEnd() const { return at_ == bytes_.size(); }

  ByteView take(std::size_t count) {
    if (failed_ || count > bytes_.size() - at_) {
      failed_ = true;
      return {};
    }
    at_ += count;
    return bytes_.subspan(at_ - count, count);
  }
  std::uint32_t u32() { return little32(take(4), 0); }
  std::int32_t i32() { return static_cast<std::int32_t>(u32()); }
  std::string text() {
    std::string result;
    while (!failed_) {
      const std::uint32_t c = byteAt(take(1), 0);
      if (c == 0) break;
      result += static_cast<char>(c);
      if (result.size() > kMaxNameBytes) failed_ = true;
    }
    return result;
  }

 private:
  ByteView bytes_;
  std::size_t at_ = 0;
  bool failed_ = false;
};

bool readChannels(Cursor value, ExrHeader& header) {
  for (;;) {
    ExrChannel channel;
    channel.name = value.text();
    if (channel.name.empty()) return !value.failed() && value.atEnd();
    const std::uint32_t type = value.u32();
    value.take(12);  // linearity, reserved, sampling
    if (value.failed() || type > 2) return false;
    channel.bytes = type == 1 ? 2 : 4;  // unsigned, half, float
    header.channels.push_back(std::move(channel));
  }
}

bool readAttribute(const std::string& attribute, Cursor value, ExrHeader& header) {
  if (attribute == "channels") return readChannels(value, header);
  if (attribute == "compression") header.compression = byteAt(value.take(1), 0);
  if (attribute == "dataWindow") {
    const std::int64_t left = value.i32(), top = value.i32();
    const std::int64_t right = value.i32(), bottom = value.i32();
    header.width = right - left + 1;
    header.height = bottom - top + 1;
  }
  return !value.failed();
}

// Up to the empty name that ends the header; `attributes` counts them.
Status readAttributes(Cursor& cursor, const std::string& name, ExrHeader& header,
                      std::size_t& attributes) {
  for (attributes = 0;; ++attributes) {
    const std::string attribute = cursor.text();
    if (attribute.empty()) break;
    const std::string type = cursor.text();
    const ByteView value = cursor.take(cursor.u32());
    if (cursor.failed() || !sizeFits(type, value.size()) ||
        !readAttribute(attribute, Cursor(value), header))
      return corrupt(name, "EXR", "attribute '" + attribute + "' of the header is damaged");
  }
  if (cursor.failed()) return corrupt(name, "EXR", "the header ends too early");
  return {};
}

}  // namespace

Result<ExrHeader> readExrHeader(ByteView bytes, const std::string& name) {
  Cursor cursor(bytes);
  if (!startsWith(bytes, "\x76\x2f\x31\x01"))
    return corrupt(name, "EXR", "it does not begin with the OpenEXR signature");
  cursor.take(4);
  const std::uint32_t flags = cursor.u32();
  if (flags & kUnsupportedFlags)
    return error(ErrorKind::Input, "{}: deep EXR pictures are not read; flatten it first", name);
  ExrHeader header;
  header.tiled = (flags & kTiledFlag) != 0;
  std::size_t attributes = 0;
  LUCERNA_TRY_VOID(readAttributes(cursor, name, header, attributes));
  // OpenEXR allocates what an attribute says that it takes, in the headers of other parts too.
  while ((flags & kPartsFlag) && attributes > 0) {
    ExrHeader other;
    LUCERNA_TRY_VOID(readAttributes(cursor, name, other, attributes));
  }
  if (header.width < 1 || header.height < 1 || header.channels.empty())
    return corrupt(name, "EXR", "the header has no data window or no channels");
  return header;
}

}  // namespace lucerna::codec
