// The schedule as a drawing: on the left the steps from top to bottom with their ports and wires,
// on the right one lane per physical texture with the lifetimes of the values in it.
#include <fmt/format.h>

#include <algorithm>

#include "core/html.hpp"
#include "graph/print_parts.hpp"

namespace lucerna::graph {
namespace {

// Pixels.
constexpr int kMargin = 24, kTitle = 56, kWireSpace = 220, kBoxWidth = 300, kPortHeight = 18;
constexpr int kBoxHead = 26, kBoxGap = 22, kLaneWidth = 34, kLaneGap = 6, kLaneHead = 24;
constexpr int kWireStep = 9, kLegendLine = 18;

struct Box {
  int top = 0, height = 0;
};

class Drawing {
 public:
  Drawing(const Pipeline& pipeline, const Plan& plan, const Schedule& schedule)
      : pipeline_(pipeline), plan_(plan), schedule_(schedule) {}

  std::string draw() {
    layOut();
    for (const Wire& wire : wiresOf(plan_, schedule_)) drawWire(wire);
    for (std::size_t s = 0; s < schedule_.steps.size(); ++s) drawBox(s);
    drawOutput();
    for (std::size_t t = 0; t < schedule_.textures.size(); ++t) drawLane(t);
    drawLegend();
    return head() + body_ + "</svg>\n";
  }

 private:
  const std::vector<PortDescription>& ports(const Step& step) const {
    return plan_.rows[step.row].description.ports;
  }
  std::size_t portCount(const Step& step, Direction other) const {
    if (step.kind != Step::Kind::Pass) return 0;
    const auto& all = ports(step);
    return static_cast<std::size_t>(std::count_if(
        all.begin(), all.end(), [&](const PortDescription& p) { return p.direction != other; }));
  }

  void layOut() {
    int y = kMargin + kTitle + kLaneHead;
    for (const Step& step : schedule_.steps) {
      const auto lines = std::max(portCount(step, Direction::Out), portCount(step, Direction::In));
      const int height = kBoxHead + static_cast<int>(lines) * kPortHeight + (lines ? 6 : 0);
      boxes_.push_back({y, height});
      y += height + kBoxGap;
    }
    bottom_ = y;
    lanesLeft_ = kMargin + kWireSpace + kBoxWidth + 60;
    const int lanes = static_cast<int>(schedule_.textures.size());
    width_ = std::max(lanesLeft_ + lanes * (kLaneWidth + kLaneGap) + 160, 760);
    height_ = bottom_ + 40 + (lanes + 2) * kLegendLine + kMargin;
  }

  std::string head() const {
    std::string text = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} "
        "{1}\" font-family=\"sans-serif\" font-size=\"12\">\n"
        "<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n",
        width_, height_);
    text += fmt::format(
        "<text x=\"{}\" y=\"{}\" font-size=\"20\" font-weight=\"bold\">{}</text>\n"
        "<text x=\"{}\" y=\"{}\" fill=\"#555\">{} x {}, output {}</text>\n",
        kMargin, kMargin + 16, escapedXml(pipeline_.name), kMargin, kMargin + 38,
        schedule_.outputSize.x, schedule_.outputSize.y,
        escapedXml(sourceText(plan_, plan_.output)));
    return text;
  }

  int boxLeft() const { return kMargin + kWireSpace; }

  // The middle of a port's line; of the box's head if there is no such port.
  int portY(std::size_t s, std::string_view name, Direction other) const {
    const Step& step = schedule_.steps[s];
    int line = 0;
    if (step.kind == Step::Kind::Pass)
      for (const PortDescription& port : ports(step)) {
        if (port.direction == other) continue;
        if (port.name == name) return boxes_[s].top + kBoxHead + line * kPortHeight + 8;
        ++line;
      }
    return boxes_[s].top + kBoxHead / 2;
  }

  void drawBox(std::size_t s) {
    const Step& step = schedule_.steps[s];
    const Box& box = boxes_[s];
    const bool pass = step.kind == Step::Kind::Pass;
    body_ += fmt::format(
        "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" rx=\"5\" fill=\"{}\" "
        "stroke=\"#333\"{}/>\n"
        "<text x=\"{}\" y=\"{}\" font-weight=\"bold\">{} {}</text>\n",
        boxLeft(), box.top, kBoxWidth, box.height, pass ? "#f4f4f4" : "#ffffff",
        pass ? "" : " stroke-dasharray=\"4 3\"", boxLeft() + 10, box.top + 17, s + 1,
        escapedXml(step.name));
    if (!pass) return;
    if (step.frequency != Frequency::PerView)
      body_ += fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"end\" fill=\"#777\">{}</text>\n",
                           boxLeft() + kBoxWidth - 10, box.top + 17, nameOf(step.frequency));
    for (std::size_t p = 0; p < ports(step).size(); ++p) drawPort(s, p);
  }

  void drawPort(std::size_t s, std::size_t p) {
    const Step& step = schedule_.steps[s];
    const PortDescription& port = ports(step)[p];
    if (port.direction != Direction::Out) {
      const int y = portY(s, port.name, Direction::Out);
      body_ += fmt::format(
          "<circle cx=\"{}\" cy=\"{}\" r=\"3.5\" fill=\"#fff\" stroke=\"#333\"/>\n"
          "<text x=\"{}\" y=\"{}\">{}{}</text>\n",
          boxLeft(), y, boxLeft() + 10, y + 4, escapedXml(port.name),
          port.history ? " (last)" : "");
    }
    if (port.direction != Direction::In) {
      const int y = portY(s, port.name, Direction::In);
      const bool made = step.versions[p] != kNoVersion;
      body_ += fmt::format(
          "<circle cx=\"{}\" cy=\"{}\" r=\"3.5\" fill=\"{}\" stroke=\"#333\"/>\n"
          "<text x=\"{}\" y=\"{}\" text-anchor=\"end\" fill=\"{}\">{}</text>\n",
          boxLeft() + kBoxWidth, y, made ? colorOf(step.versions[p]) : "#fff",
          boxLeft() + kBoxWidth - 10, y + 4, made ? "#000" : "#999", escapedXml(port.name));
    }
  }

  std::string_view colorOf(std::size_t version) const {
    const Version& v = schedule_.versions[version];
    return v.type.texture ? seriesColor(v.physical) : "#999999";
  }

  // Wires run left of the boxes, each in a column of its own as far as there is room; a resource is
  // a short end with its name.
  void drawWire(const Wire& wire) {
    const bool toOutput = wire.to >= schedule_.steps.size();
    const int y = toOutput ? bottom_ : portY(wire.to, wire.label, Direction::Out);
    if (wire.from == kNoVersion) {
      body_ += fmt::format(
          "<text x=\"{}\" y=\"{}\" text-anchor=\"end\" fill=\"#777\" "
          "font-style=\"italic\">{}</text>\n",
          boxLeft() - 8, y + 4, escapedXml(wire.resource));
      return;
    }
    const int columns = (kWireSpace - 76) / kWireStep;
    const int x = boxLeft() - 60 -
                  static_cast<int>(wireCount_++ % static_cast<std::size_t>(columns)) * kWireStep;
    const int fromY = boxes_[wire.from].top + boxes_[wire.from].height - 6;
    body_ += fmt::format(
        "<path d=\"M {} {} H {} V {} H {}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.5\"{}/>\n",
        boxLeft(), fromY, x, y, boxLeft(), colorOf(wire.version),
        wire.history ? " stroke-dasharray=\"3 3\"" : "");
  }

  void drawOutput() {
    body_ += fmt::format(
        "<circle cx=\"{}\" cy=\"{}\" r=\"5\" fill=\"#333\"/>\n"
        "<text x=\"{}\" y=\"{}\" font-weight=\"bold\">output</text>\n",
        boxLeft(), bottom_, boxLeft() + 12, bottom_ + 4);
  }

  void drawLane(std::size_t t) {
    const PhysicalTexture& texture = schedule_.textures[t];
    const int x = lanesLeft_ + static_cast<int>(t) * (kLaneWidth + kLaneGap);
    const int top = kMargin + kTitle + kLaneHead;
    body_ += fmt::format(
        "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"#fafafa\" stroke=\"#ddd\"/>\n"
        "<text x=\"{}\" y=\"{}\" text-anchor=\"middle\" fill=\"#555\">{}</text>\n",
        x, top, kLaneWidth, bottom_ - top, x + kLaneWidth / 2, top - 8, t);
    for (std::size_t i = 0; i < texture.versions.size(); ++i)
      drawLife(x, texture.versions[i],
               i + 1 < texture.versions.size() ? texture.versions[i + 1] : kNoVersion);
  }

  // A version that the next one updates in place ends where that begins.
  void drawLife(int x, std::size_t v, std::size_t next) {
    const Version& version = schedule_.versions[v];
    const bool survives = version.lastStep >= schedule_.steps.size();
    const Box& last = boxes_[survives ? boxes_.size() - 1 : version.lastStep];
    const int top = boxes_[version.firstStep].top;
    int bottom = survives ? bottom_ : last.top + last.height;
    if (next != kNoVersion)
      bottom = std::min(bottom, boxes_[schedule_.versions[next].firstStep].top);
    const int inset = version.standIn || schedule_.textures[version.physical].history ? 4 : 2;
    body_ += fmt::format(
        "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" rx=\"3\" fill=\"{}\" "
        "fill-opacity=\"0.55\" stroke=\"#333\"><title>{}: {}</title></rect>\n",
        x + inset, top, kLaneWidth - 2 * inset, bottom - top, colorOf(v), escapedXml(version.name),
        escapedXml(holderText(schedule_, version)));
    body_ +=
        fmt::format("<text transform=\"translate({} {}) rotate(90)\" font-size=\"10\">{}</text>\n",
                    x + kLaneWidth / 2 - 3, top + 5, escapedXml(version.name));
  }

  void drawLegend() {
    int y = bottom_ + 44;
    for (std::size_t t = 0; t < schedule_.textures.size(); ++t, y += kLegendLine) {
      const PhysicalTexture& texture = schedule_.textures[t];
      body_ += fmt::format(
          "<rect x=\"{}\" y=\"{}\" width=\"12\" height=\"12\" fill=\"{}\" fill-opacity=\"0.55\" "
          "stroke=\"#333\"/>\n<text x=\"{}\" y=\"{}\">texture {}: {}, {:.2f} MiB</text>\n",
          kMargin, y - 10, seriesColor(t), kMargin + 20, y, t, escapedXml(textureText(texture)),
          mebibytes(texture.desc.bytes() * (texture.history ? 2 : 1)));
    }
    body_ += fmt::format(
        "<text x=\"{}\" y=\"{}\">in all {:.1f} MiB; without reuse {:.1f} MiB</text>\n", kMargin, y,
        mebibytes(schedule_.bytes()), mebibytes(schedule_.bytesWithoutReuse()));
  }

  const Pipeline& pipeline_;
  const Plan& plan_;
  const Schedule& schedule_;
  std::vector<Box> boxes_;  // as Schedule::steps
  int bottom_ = 0, lanesLeft_ = 0, width_ = 0, height_ = 0;
  std::size_t wireCount_ = 0;
  std::string body_;
};

}  // namespace

std::string toSvg(const Pipeline& pipeline, const Plan& plan, const Schedule& schedule) {
  return Drawing(pipeline, plan, schedule).draw();
}

}  // namespace lucerna::graph
