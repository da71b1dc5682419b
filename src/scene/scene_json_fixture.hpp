// For tests of the scene JSON.
#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "core/test_folder.hpp"
#include "image/image_file.hpp"
#include "scene/load.hpp"

namespace lucerna::scene {

// A folder with a one-triangle file (material "paint", light "lamp" by JSON below) for each test.
class SceneJson : public testing::Test {
 protected:
  void SetUp() override {
    write("tri.obj", "mtllib tri.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl paint\nf 1 2 3\n");
    write("tri.mtl", "newmtl paint\nKd 0.5 0.5 0.5\n");
  }

  void write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
  }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  void writePicture(const std::string& name, int width, int height) {
    const Status written = writeImage(folder_ / name, Image(width, height, 4, ComponentType::U8));
    ASSERT_TRUE(written) << written.error().message;
  }
  // The messages of a JSON that is refused.
  std::string faultsOf(const std::string& text) {
    write("s.json", text);
    const Result<Scene> scene = loadScene(path("s.json"));
    if (scene) return "";
    EXPECT_EQ(scene.error().kind, ErrorKind::Input);
    return scene.error().message;
  }

  TestFolder folder_;
};

}  // namespace lucerna::scene
