// The typed front end: a struct becomes a description and gets its values and ports back.
#include "graph/pass_info.hpp"

#include <gmock/gmock.h>

#include "graph/registry.hpp"

namespace lucerna::graph {
namespace {

using gpu::Format;
using gpu::Texture;

struct Lists {
  static constexpr const char* kPortName = "Lists";
  int count = 0;
};

enum class Mode { Fast, Nice };

// What the last executed instance saw.
struct Seen {
  float radius = 0;
  int samples = 0;
  Mode mode = Mode::Fast;
  vec3 tint{0};
  bool hasDepth = false;
  int listCount = 0;
} seen;

class Typed {
 public:
  struct Params {
    float radius = 0.1f;
    int samples = 4;
    bool halfSize = false;
    Mode mode = Mode::Nice;
    vec3 tint{1, 0.5f, 0};
    std::string label = "none";
  };
  struct Ports {
    In<Texture> depth;
    Out<Texture> mask, debug;
    InOut<Lists> lists;
  };
  static void describe(PassInfo<Params, Ports>& d) {
    d.pass("Typed", "A pass for tests.");
    d.runs(Frequency::PerViewGroup);
    d.needs("compute");
    d.param("radius", &Params::radius).range(0, 10).unit("m").help("How far.");
    d.param("samples", &Params::samples).range(1, 8).rebuilds(Rebuild::Shaders);
    d.param("halfSize", &Params::halfSize).rebuilds(Rebuild::Ports);
    d.param("mode", &Params::mode).choices({"Fast", "Nice"});
    d.param("tint", &Params::tint).color();
    d.param("label", &Params::label);
    d.read("depth", &Ports::depth).texture(Format::Depth32F, Format::R32Float).halo(2).optional();
    d.write("mask", &Ports::mask)
        .texture(Format::R8Unorm)
        .sizeOf("depth", d.values().halfSize ? 0.5f : 1.f)
        .whenDisabled(vec4(1));
    if (d.values().mode == Mode::Fast) d.write("debug", &Ports::debug).texture(Format::Rgba8Unorm);
    d.update("lists", &Ports::lists);
  }
  explicit Typed(gpu::Device&) {}
  void execute(PassContext&, const Params& params, const Ports& ports) {
    ports.lists->count += 1;
    seen = {params.radius, params.samples,    params.mode,
            params.tint,   bool(ports.depth), ports.lists->count};
  }
};

TEST(PassInfo, DescriptionHasWhatWasDeclared) {
  const PassDescription d = makePassType<Typed>()->describe({});
  EXPECT_EQ(d.type, "Typed");
  EXPECT_EQ(d.frequency, Frequency::PerViewGroup);
  EXPECT_THAT(d.features, testing::ElementsAre("compute"));
  ASSERT_EQ(d.params.size(), 6u);
  EXPECT_EQ(toText(d.param("radius")->defaultValue), "0.1");
  EXPECT_EQ(d.param("radius")->unit, "m");
  EXPECT_EQ(d.param("samples")->max, 8.0);
  EXPECT_EQ(d.param("mode")->type, ParamType::Choice);
  EXPECT_EQ(toText(d.param("mode")->defaultValue), "Nice");
  EXPECT_EQ(d.param("tint")->type, ParamType::Color);
  EXPECT_EQ(toText(d.param("tint")->defaultValue), "[1, 0.5, 0]");
  EXPECT_EQ(toText(d.param("label")->defaultValue), "none");
  EXPECT_EQ(d.input("depth")->type.text(), "a 2D texture (Depth32F or R32Float)");
  EXPECT_EQ(d.input("depth")->halo, 2);
  EXPECT_EQ(d.input("mask"), nullptr);
  EXPECT_EQ(d.output("mask")->standIn.kind, StandIn::Kind::Fill);
  EXPECT_EQ(d.input("lists"), d.output("lists"));
  EXPECT_EQ(d.input("lists")->type.text(), "Lists data");
}

TEST(PassInfo, PortsMayDependOnParameters) {
  const auto type = makePassType<Typed>();
  EXPECT_EQ(type->describe({}).output("debug"), nullptr);
  EXPECT_NE(type->describe({{"mode", Value("Fast")}}).output("debug"), nullptr);
  EXPECT_FLOAT_EQ(type->describe({{"halfSize", Value(true)}}).output("mask")->size.scale, 0.5f);
  // The default stays the default, whatever the row says.
  EXPECT_EQ(toText(type->describe({{"mode", Value("Fast")}}).param("mode")->defaultValue), "Nice");
}

TEST(PassInfo, ValuesAndPortsReachThePass) {
  Lists lists;
  Texture depth;
  // The pass never touches its device.
  alignas(16) static char nothing[16];
  auto& device = reinterpret_cast<gpu::Device&>(nothing);
  const auto instance = makePassType<Typed>()->create(device);
  instance->setParams({{"radius", Value(std::int64_t{3})},
                       {"mode", Value("Fast")},
                       {"tint", Value(std::vector{0.0, 1.0, 2.0})},
                       {"samples", Value("wrong type")},
                       {"unknown", Value(true)}});
  PassContext context{.device = device};
  const std::vector<BoundPort> ports = {{.texture = &depth}, {}, {}, {.data = &lists}};
  instance->execute(context, ports);
  EXPECT_EQ(seen.radius, 3.f);
  EXPECT_EQ(seen.samples, 4);
  EXPECT_EQ(seen.mode, Mode::Fast);
  EXPECT_EQ(seen.tint, vec3(0, 1, 2));
  EXPECT_TRUE(seen.hasDepth);
  EXPECT_EQ(lists.count, 1);
}

TEST(Registry, FindsTypesAndResources) {
  Registry registry;
  registry.add<Typed>();
  registry.addResource<Lists>("lists", "For tests.", true);
  EXPECT_NE(registry.find("Typed"), nullptr);
  EXPECT_EQ(registry.find("typed"), nullptr);
  EXPECT_THAT(registry.typeNames(), testing::ElementsAre("Typed"));
  ASSERT_NE(registry.resource("lists"), nullptr);
  EXPECT_TRUE(registry.resource("lists")->perView);
  EXPECT_DEATH(registry.add<Typed>(), "registered twice");
}

TEST(Ports, UnboundPortsAssert) {
  const In<Lists> in;
  EXPECT_FALSE(in);
  EXPECT_DEATH(static_cast<void>(in->count), "unbound");
}

}  // namespace
}  // namespace lucerna::graph
