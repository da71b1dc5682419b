// lucerna compare REFERENCE TEST

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>

#include "app/compare_page.hpp"
#include "command_line.hpp"
#include "core/file.hpp"
#include "core/log.hpp"
#include "image/image_file.hpp"
#include "image/metrics.hpp"
#include "render_flags.hpp"

namespace lucerna::cli {
namespace {

struct Options {
  std::string reference, test, heatmap, html, mask;
  std::optional<double> failAbove;
  bool hdr = false, ldr = false;
  FlipSettings flip;
};

// F32 RGB: linear for HDR, sRGB-encoded for LDR. Integer images hold encoded values, floats linear
// ones.
Image prepared(const Image& image, bool hdr) {
  Image result = converted(image, ComponentType::F32, 3);
  const bool linear = image.type() == ComponentType::F32 || image.type() == ComponentType::Half;
  if (linear == hdr) return result;
  for (float& value : result.as<float>())
    value = hdr ? linearFromSrgb(value) : srgbFromLinear(value);
  return result;
}

Status checkSize(const Image& image, const std::string& name, const Image& reference,
                 const std::string& referenceName) {
  if (image.width() == reference.width() && image.height() == reference.height()) return {};
  return error(ErrorKind::Input,
               "{} is {}x{}, but {} is {}x{}; only pictures of one size are compared", name,
               image.width(), image.height(), referenceName, reference.width(), reference.height());
}

Result<std::optional<Image>> readMask(const Options& options, const Image& reference) {
  if (options.mask.empty()) return std::optional<Image>();
  LUCERNA_TRY(mask, readImage(options.mask));
  LUCERNA_TRY_VOID(checkSize(mask, options.mask, reference, options.reference));
  Image result = converted(mask, ComponentType::U8, 1);
  if (std::ranges::all_of(result.as<std::uint8_t>(), [](std::uint8_t v) { return v == 0; }))
    return error(ErrorKind::Input,
                 "{}: the mask is black everywhere, so no pixel would be compared", options.mask);
  return std::optional<Image>(std::move(result));
}

// What is written must not replace what is compared, or the other one.
Status checkOutput(const Options& options, const char* option, const std::string& path,
                   const std::string& other) {
  if (path.empty()) return {};
  LUCERNA_TRY_VOID(checkFolderOf(path, option));
  return checkIsNone(path, option,
                     std::vector{options.reference, options.test, options.mask, other});
}

// Encoded values have been through a tone map that linear ones have not.
void warnOfKinds(const Options& options, const Image& reference, const Image& test) {
  if ((reference.type() == ComponentType::F32) == (test.type() == ComponentType::F32)) return;
  const std::string& encoded =
      reference.type() == ComponentType::F32 ? options.test : options.reference;
  log::warning(
      "{} holds encoded values and the other picture linear ones; if a tone map made it, they are "
      "not "
      "alike: compare two EXR or two PNG files",
      encoded);
}

app::Comparison measured(const Options& options, const Image& reference, const Image& test,
                         const Image* mask) {
  const bool hdr = options.hdr || (!options.ldr && (reference.type() == ComponentType::F32 ||
                                                    test.type() == ComponentType::F32));
  app::Comparison result{.referenceName = options.reference,
                         .testName = options.test,
                         .reference = prepared(reference, hdr),
                         .test = prepared(test, hdr),
                         .hdr = hdr};
  result.eightBit =
      !hdr && reference.type() == ComponentType::U8 && test.type() == ComponentType::U8;
  result.flip = hdr ? flipHdr(result.reference, result.test, options.flip, mask).map
                    : flipLdr(result.reference, result.test, options.flip, mask);
  result.pixels = pixelMetrics(result.reference, result.test, mask);
  return result;
}

Status writePictures(const Options& options, const app::Comparison& result, const Image* mask) {
  if (options.heatmap.empty() && options.html.empty()) return {};
  const Image map = heatMap(result.flip.error, mask);
  if (!options.heatmap.empty()) LUCERNA_TRY_VOID(writeImage(options.heatmap, map));
  if (options.html.empty()) return {};
  LUCERNA_TRY(page, app::comparePage(result, map));
  return writeText(options.html, page);
}

void print(const app::Comparison& result, bool json) {
  const ErrorMap& flip = result.flip;
  const PixelMetrics& pixels = result.pixels;
  if (json)
    printJson({{"flip",
                {{"mean", flip.mean},
                 {"weighted_median", flip.weightedMedian},
                 {"p95", flip.p95},
                 {"max", flip.max}}},
               {"psnr", pixels.psnr},
               {"ssim", pixels.ssim},
               {"rmse", pixels.rmse}});
  else
    printText(fmt::format(
        "{}-FLIP  mean {:.6f}  weighted median {:.6f}  95th percentile {:.6f}  max {:.6f}\n"
        "PSNR {:.3f} dB  SSIM {:.6f}  RMSE {:.6f}\n",
        result.hdr ? "HDR" : "LDR", flip.mean, flip.weightedMedian, flip.p95, flip.max, pixels.psnr,
        pixels.ssim, pixels.rmse));
}

Result<int> compare(const Options& options, bool json) {
  LUCERNA_TRY_VOID(checkOutput(options, "--heatmap", options.heatmap, ""));
  LUCERNA_TRY_VOID(checkOutput(options, "--html", options.html, options.heatmap));
  LUCERNA_TRY(reference, readImage(options.reference));
  LUCERNA_TRY(test, readImage(options.test));
  LUCERNA_TRY_VOID(checkSize(test, options.test, reference, options.reference));
  warnOfKinds(options, reference, test);
  LUCERNA_TRY(mask, readMask(options, reference));
  const Image* maskImage = mask ? &*mask : nullptr;
  const app::Comparison result = measured(options, reference, test, maskImage);
  LUCERNA_TRY_VOID(writePictures(options, result, maskImage));
  print(result, json);
  if (!options.failAbove || result.flip.mean <= *options.failAbove) return 0;
  log::error("{} differs from {}: mean FLIP {:.6f} is above {:g}", options.test, options.reference,
             result.flip.mean, *options.failAbove);
  return static_cast<int>(ErrorKind::Failed);
}

}  // namespace

void addCompare(CommandLine& line) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      addCommand(line, line.app, "compare", "difference of two pictures: FLIP, PSNR, SSIM, RMSE",
                 [&line, options] { return compare(*options, line.talk.json); });
  command->add_option("REFERENCE", options->reference, "picture taken as true")->required();
  command->add_option("TEST", options->test, "picture to judge")->required();
  command->add_option("--heatmap", options->heatmap, "write the FLIP error as a coloured picture");
  command->add_option("--html", options->html,
                      "write a page that stands alone: flip, slider, error, values of pixels");
  command->add_option("--mask", options->mask, "picture; pixels that are black in it do not count");
  command
      ->add_option_function<double>(
          "--fail-above", [options](double value) { options->failAbove = value; },
          "exit with 1 if the mean FLIP is above this")
      ->check(between(0, 1));
  command
      ->add_option("--pixels-per-degree", options->flip.pixelsPerDegree,
                   "of the viewer's eye (67.02)")
      ->check(between(1, 1000));
  CLI::Option* hdr = command->add_flag("--hdr", options->hdr, "compare linear values by HDR-FLIP");
  command
      ->add_flag("--ldr", options->ldr,
                 "compare encoded values by LDR-FLIP (default: by file type)")
      ->excludes(hdr);
}

}  // namespace lucerna::cli
