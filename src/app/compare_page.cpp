#include "app/compare_page.hpp"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/compare_page_parts.hpp"
#include "core/html.hpp"
#include "image/image_file.hpp"

namespace lucerna::app {
namespace {

Result<std::string> pngUri(const Image& image) {
  LUCERNA_TRY(png, encodeImage("page.png", image));
  return dataUri("image/png", png);
}

// What a screen shows of it: sRGB-encoded bytes, brighter than white cut off.
Image forShow(const Image& image, bool linear) {
  Image encoded = image;
  if (linear)
    for (float& value : encoded.as<float>()) value = srgbFromLinear(value);
  return converted(encoded, ComponentType::U8, 3);
}

// From 0 at the left to 1.
Image errorRamp() {
  Image ramp(256, 1, 1, ComponentType::F32);
  float value = 0;
  for (float& at : ramp.as<float>()) at = value++ / 255.f;
  return heatMap(ramp);
}

// <figure> with a picture that the script finds by its id.
Result<std::string> figure(const char* id, const std::string& caption, const Image& image) {
  LUCERNA_TRY(uri, pngUri(image));
  return fmt::format(
      "<figure><img id=\"{}\" alt=\"{}\" src=\"{}\">\n<figcaption>{}</figcaption>"
      "</figure>\n",
      id, id, uri, caption);
}

Result<std::string> figures(const Comparison& c, const Image& heatMap) {
  LUCERNA_TRY(ramp, pngUri(errorRamp()));
  LUCERNA_TRY(reference, figure("reference", "Reference: " + escapedXml(c.referenceName),
                                forShow(c.reference, c.hdr)));
  LUCERNA_TRY(test, figure("test", "Test: " + escapedXml(c.testName), forShow(c.test, c.hdr)));
  const std::string legend = fmt::format(
      "FLIP error, 0 <img id=\"legend\" alt=\"from black to pale yellow\" style=\"width: 50%\" "
      "src=\"{}\"> 1",
      ramp);
  LUCERNA_TRY(error, figure("error", legend, heatMap));
  return "<div class=\"pictures\">\n" + reference + test + error + "</div>\n";
}

// What the script reads the values from, not to be seen.
Result<std::string> valuePictures(const Comparison& c) {
  std::string text;
  const auto add = [&](const char* id, const Image& image) -> Status {
    LUCERNA_TRY(uri, pngUri(halvesAsBytes(image)));
    text += fmt::format("<img id=\"{}\" alt=\"\" hidden src=\"{}\">\n", id, uri);
    return {};
  };
  LUCERNA_TRY_VOID(add("flip-values", c.flip.error));
  if (c.eightBit) return text;
  LUCERNA_TRY_VOID(add("reference-values", c.reference));
  LUCERNA_TRY_VOID(add("test-values", c.test));
  return text;
}

std::string metricsTable(const Comparison& c) {
  std::string rows;
  const auto add = [&](const char* name, const std::string& value, const char* meaning) {
    rows += fmt::format("<tr><td>{}</td><td>{}</td><td class=\"quiet\">{}</td></tr>\n", name, value,
                        meaning);
  };
  add("FLIP, mean", fmt::format("{:.6f}", c.flip.mean), "0: no difference; 1: the greatest");
  add("FLIP, weighted median", fmt::format("{:.6f}", c.flip.weightedMedian),
      "half of the whole error lies in pixels of at most this error");
  add("FLIP, 95th percentile", fmt::format("{:.6f}", c.flip.p95),
      "95 % of the pixels have at most this error");
  add("FLIP, largest", fmt::format("{:.6f}", c.flip.max), "");
  add("PSNR", fmt::format("{:.3f} dB", c.pixels.psnr), "peak 1; infinite for equal pictures");
  add("SSIM", fmt::format("{:.6f}", c.pixels.ssim), "1: no difference");
  add("RMSE", fmt::format("{:.6f}", c.pixels.rmse), "of the RGB components");
  return "<table id=\"metrics\">\n" + rows + "</table>\n";
}

}  // namespace

Image halvesAsBytes(const Image& image) {
  const Image halves = converted(image, ComponentType::Half, image.channels());
  Image bytes(image.width(), 2 * image.height(), image.channels(), ComponentType::U8);
  const auto from = halves.as<std::uint16_t>();
  const auto to = bytes.as<std::uint8_t>();
  for (std::size_t i = 0; i < from.size(); ++i) {
    to[i] = static_cast<std::uint8_t>(from[i] >> 8);
    to[from.size() + i] = static_cast<std::uint8_t>(from[i] & 255);
  }
  return bytes;
}

Result<std::string> comparePage(const Comparison& c, const Image& heatMap) {
  LUCERNA_TRY(pictures, figures(c, heatMap));
  LUCERNA_TRY(valueImages, valuePictures(c));
  const char* values = c.hdr ? "linear" : c.eightBit ? "bytes" : "encoded";
  const nlohmann::ordered_json data{
      {"width", c.reference.width()}, {"height", c.reference.height()}, {"values", values}};
  const auto fileName = [](const std::string& path) {
    return std::filesystem::path(path).filename().string();
  };
  const std::string title =
      fmt::format("{} beside {}", fileName(c.testName), fileName(c.referenceName));
  std::string body = fmt::format(
      "<h1>{}</h1>\n<p class=\"quiet\">{} x {} pixels, {}-FLIP; values are {}</p>\n",
      escapedXml(title), c.reference.width(), c.reference.height(), c.hdr ? "HDR" : "LDR",
      c.hdr        ? "linear, shown sRGB-encoded and cut off at 1"
      : c.eightBit ? "the files' bytes, sRGB-encoded"
                   : "sRGB-encoded, 0 to 1");
  body += kComparePageStage;
  body += "<h2>Difference</h2>\n" + metricsTable(c) + "<h2>Pictures</h2>\n" + pictures +
          valueImages +
          fmt::format("<script type=\"application/json\" id=\"data\">{}</script>\n", data.dump());
  return htmlText(
      {.title = title, .style = kComparePageStyle, .body = body, .script = kComparePageScript});
}

}  // namespace lucerna::app
