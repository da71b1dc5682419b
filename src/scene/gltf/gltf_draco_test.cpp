// Meshes packed by Draco, made here with its encoder.
#include <draco/compression/encode.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <optional>
#include <random>

#include "core/progress.hpp"
#include "scene/check_scene.hpp"
#include "scene/gltf/gltf_file.hpp"

namespace lucerna::scene {
namespace {

using nlohmann::json;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// Another worker while it lives: a program, or a shell script written for it.
class Worker {
 public:
  explicit Worker(const std::filesystem::path& program) {
    if (const char* before = std::getenv("LUCERNA_WORKER")) before_ = before;
    setenv("LUCERNA_WORKER", program.c_str(), 1);
  }
  Worker(const std::filesystem::path& program, const std::string& script) : Worker(program) {
    std::ofstream(program) << "#!/bin/sh\n" << script << "\n";
    std::filesystem::permissions(program, std::filesystem::perms::owner_all);
  }
  ~Worker() {
    if (before_)
      setenv("LUCERNA_WORKER", before_->c_str(), 1);
    else
      unsetenv("LUCERNA_WORKER");
  }
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

 private:
  std::optional<std::string> before_;
};

// A grid of side + 1 by side + 1 vertices in the unit square; colours are its coordinates.
std::vector<char> dracoGrid(int side, draco::MeshEncoderMethod method) {
  draco::Mesh mesh;
  const int count = (side + 1) * (side + 1);
  mesh.set_num_points(static_cast<std::uint32_t>(count));
  const auto add = [&](draco::GeometryAttribute::Type kind, std::uint8_t components,
                       draco::DataType type, int bytes) {
    draco::GeometryAttribute attribute;
    attribute.Init(kind, nullptr, components, type, false, bytes, 0);
    return mesh.attribute(mesh.AddAttribute(attribute, true, static_cast<std::uint32_t>(count)));
  };
  auto* positions = add(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32, 12);
  auto* normals = add(draco::GeometryAttribute::NORMAL, 3, draco::DT_FLOAT32, 12);
  auto* colors = add(draco::GeometryAttribute::COLOR, 4, draco::DT_UINT8, 4);
  for (int i = 0; i < count; ++i) {
    const int x = i % (side + 1), y = i / (side + 1);
    const auto inUnits = [&](int value) {
      return static_cast<float>(value) / static_cast<float>(side);
    };
    const std::array<float, 3> position{inUnits(x), inUnits(y), 0};
    const std::array<float, 3> normal{0, 0, 1};
    const std::array<std::uint8_t, 4> color{static_cast<std::uint8_t>(x),
                                            static_cast<std::uint8_t>(y), 0, 255};
    const draco::AttributeValueIndex at(static_cast<std::uint32_t>(i));
    positions->SetAttributeValue(at, position.data());
    normals->SetAttributeValue(at, normal.data());
    colors->SetAttributeValue(at, color.data());
  }
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const auto corner = [&](int dx, int dy) {
        return draco::PointIndex(static_cast<std::uint32_t>((y + dy) * (side + 1) + x + dx));
      };
      mesh.AddFace({corner(0, 0), corner(1, 0), corner(1, 1)});
      mesh.AddFace({corner(0, 0), corner(1, 1), corner(0, 1)});
    }
  draco::Encoder encoder;
  encoder.SetEncodingMethod(method);
  encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, 14);
  draco::EncoderBuffer buffer;
  EXPECT_TRUE(encoder.EncodeMeshToBuffer(mesh, &buffer).ok());
  return {buffer.data(), buffer.data() + buffer.size()};
}

class DracoFile : public GltfFile {
 protected:
  // The first primitive, a grid of 4 by 4 squares, packed.
  json& grid(draco::MeshEncoderMethod method = draco::MESH_EDGEBREAKER_ENCODING) {
    constexpr int kVertices = 25, kIndices = 96;
    root_["extensionsUsed"] = root_["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    json& primitive = root_["meshes"][0]["primitives"][0];
    primitive["attributes"] = {{"POSITION", described(5126, "VEC3", kVertices)},
                               {"NORMAL", described(5126, "VEC3", kVertices)},
                               {"COLOR_0", described(5121, "VEC4", kVertices, true)}};
    primitive["indices"] = described(5123, "SCALAR", kIndices);
    extension() = {{"bufferView", view(dracoGrid(4, method))},
                   {"attributes", {{"POSITION", 0}, {"NORMAL", 1}, {"COLOR_0", 2}}}};
    return primitive;
  }
  json& extension() {
    return root_["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"];
  }
};

TEST_F(DracoFile, IsUnpackedWhicheverWayItWasPacked) {
  for (const auto method : {draco::MESH_EDGEBREAKER_ENCODING, draco::MESH_SEQUENTIAL_ENCODING}) {
    SCOPED_TRACE(method);
    grid(method);
    const auto scene = read();
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_THAT(scene->warnings, IsEmpty());
    const Mesh& mesh = scene->meshes.at(0);
    EXPECT_EQ(mesh.triangleCount(), 32u);
    ASSERT_EQ(mesh.positions.size(), 25u);
    EXPECT_LT(glm::distance(mesh.bounds.max, vec3(1, 1, 0)), 1e-3f);
    for (std::size_t i = 0; i < 25; ++i) {  // attributes belong together
      EXPECT_NEAR(mesh.positions[i].x * 4, mesh.colors[i].x, 1e-2);
      EXPECT_NEAR(mesh.positions[i].y * 4, mesh.colors[i].y, 1e-2);
      EXPECT_GT(mesh.normals[i].z, 0.99f);
    }
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {  // counter-clockwise, half a cell
      const vec3 a = mesh.positions[mesh.indices[i]];
      const float area = glm::cross(mesh.positions[mesh.indices[i + 1]] - a,
                                    mesh.positions[mesh.indices[i + 2]] - a)
                             .z;
      EXPECT_NEAR(area, 1.f / 16, 1e-3);
    }
  }
}

TEST_F(DracoFile, OneMeshMayHoldSeveralPackedPrimitives) {
  grid();
  json second = root_["meshes"][0]["primitives"][0];
  json third = second;
  third["extensions"]["KHR_draco_mesh_compression"]["bufferView"] =
      view(dracoGrid(4, draco::MESH_SEQUENTIAL_ENCODING));
  root_["meshes"][0]["primitives"].push_back(second);
  root_["meshes"][0]["primitives"].push_back(third);
  const auto scene = read();
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->meshes.size(), 2u);  // the first two are the same
  EXPECT_EQ(scene->triangleCount(), 96u);
}

TEST_F(DracoFile, RefusesWhatDoesNotFitItsAccessors) {
  json& primitive = grid();
  const int position = primitive["attributes"]["POSITION"], indices = primitive["indices"];
  root_["accessors"][indices]["count"] = 93;
  expectRefused({"/meshes/0/primitives/0/extensions/KHR_draco_mesh_compression: found Draco data",
                 "25 vertices and 96 indices, not 25 and 93", "perhaps without"});
  root_["accessors"][indices]["count"] = 96;
  root_["accessors"][position]["count"] = 24;
  expectRefused({"found an accessor with count 24", "25, as in the other packed attributes"});
  root_["accessors"][position]["count"] = 25;
  extension()["attributes"]["POSITION"] = 7;
  expectRefused({"no attribute with the id 7"});
  extension()["attributes"]["POSITION"] = 0;
  extension()["attributes"]["TEXCOORD_0"] = 1;
  expectRefused({"/attributes: found no \"TEXCOORD_0\""});
  extension()["attributes"] = json::object();
  expectRefused({"found no attribute"});
  grid();
  root_["meshes"][0]["primitives"][0]["mode"] = 6;
  expectRefused({"/meshes/0/primitives/0/mode: found 6", "4 (triangles) or 5"});
  root_["meshes"][0]["primitives"][0].erase("mode");
  root_["meshes"][0]["primitives"][0].erase("indices");
  expectRefused({"found no \"indices\""});
}

TEST_F(DracoFile, RefusesHugeCountsBeforeMemoryIsTaken) {
  json& primitive = grid();
  for (const char* name : {"POSITION", "NORMAL", "COLOR_0"})
    root_["accessors"][primitive["attributes"][name].get<int>()]["count"] = 4000000000u;
  expectRefused({"found data that expands to"});
}

// Each is read in a child: it may refuse or draw, nothing else.
TEST_F(DracoFile, DamagedDataIsRefusedOrDrawn) {
  grid();
  const std::string whole = buffer_;
  std::mt19937 random(5);
  int refused = 0;
  constexpr int kRounds = 60;
  for (int round = 0; round < kRounds; ++round) {
    SCOPED_TRACE(round);
    buffer_ = whole;
    for (int i = 0; i < 3; ++i) buffer_[random() % buffer_.size()] = static_cast<char>(random());
    auto scene = read();
    refused += !scene;
    if (!scene) {
      EXPECT_THAT(scene.error().message, HasSubstr("Draco data"));
      continue;
    }
    const Status sound = checkScene(*scene, 0);
    EXPECT_TRUE(sound) << (sound ? "" : sound.error().message);
    complete(*scene);
  }
  EXPECT_GT(refused, kRounds / 4);
}

// A file of a megabyte could ask for it a thousand times.
TEST_F(DracoFile, RefusesToUnpackTheSameDataAgainAndAgain) {
  const json primitive = grid();
  const int big = view(std::vector<char>(1 << 20, 'x'));
  for (int i = 0; i < 300; ++i) {
    json& other = root_["meshes"][0]["primitives"].emplace_back(primitive);
    other["attributes"]["POSITION"] = described(5126, "VEC3", 25);
    other["extensions"]["KHR_draco_mesh_compression"]["bufferView"] = big;
  }
  expectRefused({"found data that expands to"});
}

TEST_F(DracoFile, DataThatManyNameAreSentOnce) {
  const json primitive = grid();
  for (int i = 0; i < 3; ++i)
    root_["meshes"][0]["primitives"].emplace_back(primitive)["attributes"]["POSITION"] =
        described(5126, "VEC3", 25);
  EXPECT_EQ(read()->triangleCount(), 128u);
  const Worker counts(folder_ / "worker", "wc -c >&2; exit 3");  // which is a refusal in its words
  const auto refused = read();
  ASSERT_FALSE(refused);
  const std::string& message = refused.error().message;
  EXPECT_LT(std::stoul(message.substr(message.rfind(' '))), 2 * buffer_.size() + 1000) << message;
}

// What is unpacked is a list of triangles whatever the primitive's accessors would have been.
TEST_F(DracoFile, AStripIsUnpackedAsAList) {
  json& primitive = grid();
  primitive["mode"] = 5;
  root_["accessors"][primitive["indices"].get<int>()]["count"] = 43;  // of a strip, turns included
  const auto scene = read();
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->triangleCount(), 32u);
  root_["accessors"][primitive["indices"].get<int>()]["count"] = 33;
  expectRefused({"25 vertices and 96 indices, not 25 and 3 to 93"});
}

TEST_F(DracoFile, WhereItIsNotRequiredTheAccessorsStandIn) {
  json& primitive = grid();
  root_.erase("extensionsRequired");
  const Worker none("/nowhere/lucerna_worker");
  const auto refused = read();
  ASSERT_FALSE(refused);  // there is nothing beside the packed data
  EXPECT_EQ(refused.error().kind, ErrorKind::Failed);

  std::vector<float> positions(75, 0.f);
  positions[3] = positions[7] = 1.f;
  primitive["attributes"] = {{"POSITION", floats(positions, "VEC3", 3)}};
  std::vector<std::uint16_t> indices(96, 0);
  indices[1] = 1, indices[2] = 2;
  primitive["indices"] = accessor(indices, 5123, "SCALAR", 1);
  extension()["attributes"] = {{"POSITION", 0}};
  const auto scene = read();
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->meshes[0].bounds.max, vec3(1, 1, 0));
  EXPECT_THAT(scene->warnings, ElementsAre(testing::AllOf(HasSubstr("/nowhere/lucerna_worker"),
                                                          HasSubstr("are drawn"))));
}

TEST_F(DracoFile, AFaultyPrimitiveThatIsNotRequiredIsDrawnByItsAccessors) {
  json& primitive = grid();
  root_.erase("extensionsRequired");
  const json packed = primitive;
  primitive["attributes"] = {{"POSITION", floats(std::vector<float>(72, 3.f), "VEC3", 3)}};
  primitive["indices"] = accessor(std::vector<std::uint16_t>(96, 0), 5123, "SCALAR", 1);
  extension()["attributes"] = {{"POSITION", 0}};
  root_["meshes"][0]["primitives"].push_back(packed);
  const auto scene = read();
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->meshes[0].bounds.max, vec3(3, 3, 3));
  EXPECT_NEAR(scene->meshes[1].bounds.max.x, 1.f, 1e-3f);
  EXPECT_THAT(scene->warnings,
              ElementsAre(testing::AllOf(
                  HasSubstr("/meshes/0/primitives/0/extensions/KHR_draco_mesh_compression has a"),
                  HasSubstr("not 24 and 96"))));
}

TEST_F(DracoFile, ADecoderThatDoesNotAnswerIsASentence) {
  grid();
  {
    const Worker fails("/bin/false");
    expectRefused({"/meshes: the decoder of its Draco data ended with code 1; export"});
  }
  {
    const Worker saysNothing("/bin/true");
    expectRefused({"/meshes: the decoder of its Draco data answered with something else"});
  }
  const Worker missing("/nowhere/lucerna_worker");
  const auto scene = read();
  ASSERT_FALSE(scene);
  EXPECT_EQ(scene.error().kind, ErrorKind::Failed);  // the file is not to blame
  EXPECT_THAT(scene.error().message, HasSubstr("build or install it again"));
  EXPECT_THAT(scene.error().message, testing::Not(HasSubstr("export")));
}

TEST_F(DracoFile, NoProcessIsStartedWhereNothingOutsideCounts) {
  grid();
  root_["buffers"][0] = {{"byteLength", buffer_.size()},
                         {"uri", "data:;base64," + std::string(buffer_.size() / 3 * 4 + 4, 'A')}};
  const std::string text = root_.dump();
  const auto* bytes = reinterpret_cast<const std::byte*>(text.data());
  const auto scene = readGltf("a.gltf", Bytes(bytes, bytes + text.size()), OutsideFiles::Refuse);
  ASSERT_FALSE(scene);
  EXPECT_THAT(scene.error().message, HasSubstr("none may be started here"));
}

TEST_F(DracoFile, CancellingIsNoFaultOfTheFile) {
  grid();
  const Worker waits(folder_ / "worker", "sleep 30");
  // In a process of its own, since cancelling is for good.
  EXPECT_EXIT(
      {
        Progress::catchInterrupt();
        raise(SIGINT);
        const auto scene = read();
        std::fprintf(stderr, "%s", scene.error().message.c_str());
        std::_Exit(static_cast<int>(scene.error().kind));
      },
      testing::ExitedWithCode(130), "the decoder of its Draco data was cancelled");
}

}  // namespace
}  // namespace lucerna::scene
