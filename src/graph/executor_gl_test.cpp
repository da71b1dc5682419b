// The executor on a driver, with the passes of executor_test_passes.hpp.
#include "graph/executor.hpp"

#include "gpu/gl_test_fixture.hpp"
#include "graph/executor_test_passes.hpp"
#include "graph/fake_pass.hpp"

namespace lucerna::graph {
namespace {

using namespace sums;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

class ExecutorGlTest : public gpu::GlTest {
 protected:
  void SetUp() override {
    GlTest::SetUp();
    if (HasFatalFailure()) return;
    registry_.add<Constant>();
    registry_.add<Once>();
    registry_.add<Add>();
    registry_.add<AddInPlace>();
    registry_.add<AddOrStart>();
    registry_.add<Sum>();
    registry_.add<Accumulate>();
    registry_.add<MakeNumber>();
    registry_.add<ShowNumber>();
    registry_.add<Broken>();
    registry_.add<BrokenLater>();
    registry_.addResource<Number>("number", "A number for every view.", true);
    executor_ = std::make_unique<Executor>(device(), registry_);
    executed = 0;
  }
  void TearDown() override {
    executor_.reset();
    EXPECT_EQ(alive, 0);
    GlTest::TearDown();
  }

  void set(std::vector<FakeRow> rows, const std::vector<std::string>& kept = {}) {
    const std::string output = rows.back().row.name + ".a";
    const Status status = executor_->setPipeline(pipelineOf(std::move(rows), output), {8, 4}, kept);
    ASSERT_TRUE(status) << status.error().message;
  }

  // The output of each view.
  std::vector<float> frame(bool cut = false, bool sceneChanged = false,
                           const std::vector<float>& numbers = {0}) {
    std::vector<Number> data;
    for (const float number : numbers) data.push_back({number});
    std::vector<Imports> views(data.size());
    for (std::size_t i = 0; i < views.size(); ++i) views[i].set("number", data[i]);
    std::vector<float> values;
    const Status status =
        executor_->execute({.cut = cut, .sceneChanged = sceneChanged, .views = views},
                           [&](int, const Texture& output) {
                             values.push_back(valueOf(device(), output));
                             return Status();
                           });
    EXPECT_TRUE(status) << status.error().message;
    return values;
  }

  static FakeRow row(const char* type, std::string name, float amount = 1) {
    return FakeRow(type).named(std::move(name)).with("amount", Value(decimalOf(amount)));
  }

  Registry registry_;
  std::unique_ptr<Executor> executor_;
};

TEST_F(ExecutorGlTest, ReuseKeepsValuesApart) {
  set({row("Constant", "C", 1), row("Add", "A1", 10), row("Add", "A2", 100), row("Add", "A3", 1000),
       FakeRow("Sum").reads("b", "A1.a")});
  EXPECT_LT(executor_->schedule().textures.size(), executor_->schedule().versions.size());
  EXPECT_EQ(device().objectCounts().textures,
            static_cast<int>(executor_->schedule().textures.size()));
  EXPECT_THAT(frame(), ElementsAre(1111 + 11));
  EXPECT_THAT(frame(), ElementsAre(1111 + 11));
}

TEST_F(ExecutorGlTest, UpdatesAndCopies) {
  set({row("Constant", "C", 1), row("AddInPlace", "U1", 10), row("AddInPlace", "U2", 100),
       FakeRow("Sum").reads("b", "C.a")},
      {"C.a", "U1.a"});
  std::vector<float> kept;
  const std::vector<Imports> views(1);
  const Status status = executor_->execute({.views = views}, [&](int, const Texture& output) {
    kept = {valueOf(device(), output), valueOf(device(), *executor_->kept("C.a")),
            valueOf(device(), *executor_->kept("U1.a"))};
    EXPECT_EQ(executor_->kept("U2.a"), nullptr);
    return Status();
  });
  ASSERT_TRUE(status);
  EXPECT_THAT(kept, ElementsAre(112, 1, 11));
}

struct Other {
  static constexpr const char* kPortName = "Other";
};

TEST_F(ExecutorGlTest, KeptDataIsGivenByItsType) {
  set({row("MakeNumber", "M", 7), FakeRow("ShowNumber")}, {"M.data"});
  const std::vector<Imports> views(1);
  int seen = 0;
  const Status status = executor_->execute({.views = views}, [&](int, const Texture& output) {
    const Number* number = executor_->keptData<Number>("M.data");
    EXPECT_TRUE(number && number->value == valueOf(device(), output));
    EXPECT_EQ(executor_->keptData<Other>("M.data"), nullptr);
    EXPECT_EQ(executor_->keptData<Number>("M.other"), nullptr);
    EXPECT_EQ(executor_->kept("M.data"), nullptr);
    ++seen;
    return Status();
  });
  ASSERT_TRUE(status);
  EXPECT_EQ(seen, 1);
}

TEST_F(ExecutorGlTest, AnOptionalUpdateStartsWhereThereIsNothing) {
  set({row("AddOrStart", "S", 10), row("AddInPlace", "U", 100)});
  EXPECT_THAT(frame(), ElementsAre(110));
  EXPECT_THAT(frame(), ElementsAre(110)) << "nothing is left from the last frame";
  set({row("Constant", "C", 1), row("AddOrStart", "S", 10)});
  EXPECT_THAT(frame(), ElementsAre(11));
  set({row("AddOrStart", "S1", 10), row("AddOrStart", "S2", 20)});
  EXPECT_THAT(frame(), ElementsAre(30));
  set({row("AddOrStart", "S", 10).off(), row("AddInPlace", "U", 100)});
  EXPECT_THAT(frame(), ElementsAre(107));
}

TEST_F(ExecutorGlTest, DisabledRowsGiveTheirStandIn) {
  set({row("Constant", "C", 1).off(), row("Add", "A1", 10).off(), row("Add", "A2", 2)});
  EXPECT_THAT(frame(), ElementsAre(502));
  EXPECT_THAT(frame(), ElementsAre(502));
  EXPECT_EQ(executed, 0);
  set({row("Constant", "C", 1), row("Add", "A1", 10).off(), row("Add", "A2", 2)});
  EXPECT_THAT(frame(), ElementsAre(3));
}

TEST_F(ExecutorGlTest, HistoryIsLastFramesAndEndsAtACut) {
  set({FakeRow("Accumulate").reads("past", "Accumulate.a")});
  EXPECT_THAT(frame(true, true, {10}), ElementsAre(9));  // nothing before: -1
  EXPECT_THAT(frame(false, false, {10}), ElementsAre(19));
  EXPECT_THAT(frame(false, false, {1}), ElementsAre(20));
  EXPECT_THAT(frame(true, false, {5}), ElementsAre(4));
  EXPECT_THAT(frame(false, false, {5}), ElementsAre(9));
}

TEST_F(ExecutorGlTest, EveryViewHasItsOwnHistory) {
  set({FakeRow("Accumulate").reads("past", "Accumulate.a")});
  EXPECT_THAT(frame(false, false, {10, 100}), ElementsAre(9, 99));
  EXPECT_THAT(frame(false, false, {10, 100}), ElementsAre(19, 199));
  EXPECT_THAT(frame(false, false, {10, 100, 1000}), ElementsAre(29, 299, 999));
}

TEST_F(ExecutorGlTest, HistorySurvivesAChangeOfOtherRows) {
  set({FakeRow("Accumulate").reads("past", "Accumulate.a"), row("Add", "A", 0)});
  frame(false, false, {10});
  set({FakeRow("Accumulate").reads("past", "Accumulate.a"), row("Add", "A", 0),
       row("Add", "B", 1000)});
  EXPECT_THAT(frame(false, false, {10}), ElementsAre(1019));
}

TEST_F(ExecutorGlTest, PerSceneStepsRunWhenTheSceneOrThePipelineChanged) {
  set({row("Once", "O", 1), row("AddInPlace", "U", 10)});
  EXPECT_THAT(frame(), ElementsAre(11));
  EXPECT_THAT(frame(), ElementsAre(11)) << "content is kept, and updates work on a copy";
  EXPECT_THAT(frame(false, true), ElementsAre(12));
  ASSERT_TRUE(executor_->setParam("O", "amount", Value(2.0)));
  EXPECT_THAT(frame(), ElementsAre(16));
}

TEST_F(ExecutorGlTest, TypedDataIsOneObjectThatStays) {
  set({row("MakeNumber", "M", 1), FakeRow("ShowNumber")});
  EXPECT_THAT(frame(), ElementsAre(1));
  EXPECT_THAT(frame(), ElementsAre(2));
  set({row("MakeNumber", "M", 10), FakeRow("ShowNumber"), row("Add", "A", 100)});
  EXPECT_THAT(frame(), ElementsAre(112));
}

TEST_F(ExecutorGlTest, ParametersChangeWithoutRebuilding) {
  set({row("Constant", "C", 1)});
  EXPECT_THAT(frame(), ElementsAre(1));
  ASSERT_TRUE(executor_->setParam("C", "amount", Value(7.0)));
  EXPECT_THAT(frame(), ElementsAre(7));
  for (const Status& status : {executor_->setParam("C", "amuont", Value(1.0)),
                               executor_->setParam("D", "amount", Value(1.0)),
                               executor_->setParam("C", "amount", Value(-1.0)),
                               executor_->setParam("C", "amount", Value("x"))}) {
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().kind, ErrorKind::Usage);
  }
  EXPECT_THAT(frame(), ElementsAre(7));
}

TEST_F(ExecutorGlTest, AFaultyPipelineRendersNothingUntilTheNextSoundOne) {
  set({row("Constant", "C", 1)});
  const Status status = executor_->setPipeline(pipelineOf({"Constnat", "Add"}), {8, 4});
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().kind, ErrorKind::Pipeline);
  EXPECT_THAT(status.error().message, HasSubstr("did you mean 'Constant'"));
  EXPECT_FALSE(executor_->execute({}, nullptr));
  EXPECT_TRUE(executor_->plan().rows.empty());
  set({row("Constant", "C", 2)});
  EXPECT_THAT(frame(), ElementsAre(2));
}

TEST_F(ExecutorGlTest, AShaderThatDoesNotCompileIsAPipelineError) {
  for (int attempt = 0; attempt < 2; ++attempt) {
    const Status status = executor_->setPipeline(pipelineOf({"Broken"}, "Broken.a"), {8, 4});
    ASSERT_FALSE(status) << attempt;
    EXPECT_EQ(status.error().kind, ErrorKind::Pipeline);
    EXPECT_THAT(status.error().message, HasSubstr("no/such.frag"));
  }
}

TEST_F(ExecutorGlTest, AViewWhoseShaderDoesNotCompileIsNotHandedOver) {
  ASSERT_TRUE(executor_->setPipeline(pipelineOf({"BrokenLater"}, "BrokenLater.a"), {8, 4}));
  const Imports view;
  bool handedOver = false;
  const Status status = executor_->execute({.views = {&view, 1}}, [&](int, const Texture&) {
    handedOver = true;
    return Status();
  });
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().kind, ErrorKind::Pipeline);
  EXPECT_FALSE(handedOver);
}

TEST_F(ExecutorGlTest, AnErrorOfWhoeverTakesAViewEndsTheFrame) {
  set({row("Constant", "C", 1)});
  const std::vector<Imports> views(3);
  int taken = 0;
  const Status status = executor_->execute({.views = views}, [&](int, const Texture&) -> Status {
    if (++taken == 2) return error(ErrorKind::Cancelled, "enough");
    return {};
  });
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().kind, ErrorKind::Cancelled);
  EXPECT_EQ(taken, 2);
}

TEST_F(ExecutorGlTest, TexturesLargerThanTheDriversAreAnError) {
  const Status status = executor_->setPipeline(pipelineOf({"Constant"}, "Constant.a"), {100000, 4});
  ASSERT_FALSE(status);
  EXPECT_THAT(status.error().message, AllOf(HasSubstr("100000 x 4"), HasSubstr("Constant.a")));
}

TEST_F(ExecutorGlTest, ProfileHasEveryStepOfEveryView) {
  set({row("Constant", "C", 1), row("AddInPlace", "U", 10), FakeRow("Sum").reads("b", "C.a")});
  executor_->setProfiling(true);
  frame(false, false, {0, 0});
  std::vector<std::string> names;
  for (const StepProfile& step : executor_->profile().steps) {
    names.push_back(fmt::format("{} {}", step.view, step.row));
    EXPECT_GE(step.cpuMs, 0);
    EXPECT_EQ(step.textureBytes, 8u * 4 * 4);
  }
  EXPECT_THAT(names, ElementsAre("0 C", "0 (copy) C.a", "0 U", "0 Sum", "1 C", "1 (copy) C.a",
                                 "1 U", "1 Sum"));
  executor_->setProfiling(false);
  frame();
  EXPECT_TRUE(executor_->profile().steps.empty());
  EXPECT_EQ(executor_->profile().textureBytes, 0u);
}

// Views take turns with the textures, so the frame holds less than its steps wrote.
TEST_F(ExecutorGlTest, ProfileSumsUpTheFrame) {
  set({row("Constant", "C", 1), row("AddInPlace", "U", 10), FakeRow("Sum").reads("b", "C.a")});
  executor_->setProfiling(true);
  frame(false, false, {0, 0});
  const FrameProfile& profile = executor_->profile();
  double cpuMs = 0, gpuMs = 0;
  std::uint64_t stepBytes = 0;
  for (const StepProfile& step : profile.steps) {
    cpuMs += step.cpuMs;
    gpuMs += step.gpuMs;
    stepBytes += step.textureBytes;
  }
  EXPECT_GT(cpuMs, 0);
  EXPECT_DOUBLE_EQ(profile.cpuMs, cpuMs);
  EXPECT_DOUBLE_EQ(profile.gpuMs, gpuMs);
  EXPECT_EQ(profile.textureBytes, executor_->schedule().bytes());
  EXPECT_LT(profile.textureBytes, stepBytes);
}

TEST_F(ExecutorGlTest, InstancesStayWithTheirRow) {
  set({row("Once", "O"), row("Add", "A", 0)});
  frame();
  frame(false, true);
  set({row("Once", "O"), row("Add", "A", 0), row("Add", "B", 0)});
  EXPECT_EQ(alive, 3);
  EXPECT_THAT(frame(), ElementsAre(3)) << "the same instance counts on";
  set({row("Once", "Other"), row("Add", "A", 0)});
  EXPECT_EQ(alive, 2);
  EXPECT_THAT(frame(), ElementsAre(1));
}

TEST_F(ExecutorGlTest, NothingLeaksOverAThousandRecompiles) {
  const auto small = [&] {
    set({row("Constant", "C", 1), row("Add", "A1", 10), row("Add", "A2", 100)});
  };
  const auto large = [&] {
    set({row("Constant", "Off", 1).off(), row("Once", "O"), row("AddInPlace", "U"),
         FakeRow("Accumulate").reads("past", "Accumulate.a"), FakeRow("Sum").reads("b", "Off.a"),
         row("MakeNumber", "M"), FakeRow("ShowNumber"), row("Add", "A1", 10)},
        {"U.a", "Sum.a"});
  };
  large();
  frame();
  small();
  frame();
  const gpu::ObjectCounts before = device().objectCounts();
  for (int i = 0; i < 500; ++i) {
    large();
    if (i % 50 == 0) frame(false, true);
    small();
    if (i % 50 == 0) frame();
  }
  EXPECT_TRUE(device().objectCounts() == before);
  EXPECT_EQ(alive, 3);
}

}  // namespace
}  // namespace lucerna::graph
